// save.c - the changing state of a simulation as bytes. Bytes to load may come from untrusted
// sources.
//
//   byte  0  "hairsave"
//         8  u32 version
//        12  u64 size of the whole state in bytes
//        20  the fields, in the order of walk()
//   the end  u64 FNV-1a hash of all bytes before
//
// The hash detects damage. Every field is checked as well, because an attacker can compute the hash
// too.
#include "lib/sim/sim.h"
#include "lib/sim/walk.h"

#include <string.h>

#include "lib/base/bytes.h"
#include "lib/collide/collision_mesh.h"

// Version of the fields in walk() and of their meaning. Raise it with any change of these.
#define VERSION 15
#define HEADER 20
#define TRAILER 8
#define MAGIC "hairsave"

#define MOST_PLACE 1e9 // Maximum coordinate of the head, m. hair_set_transform has this limit too.
// Maximum coordinate of an earlier pose, m. Teleports between two steps can move these poses
// farther.
#define MOST_PAST 1e12
#define LEAST_SUBSTEP 1e-6 // s
#define MOST_SUBSTEP 0.11

_Static_assert(offsetof(hair_collider, friction) == 52 && sizeof(struct hair_pose) == 40 &&
                   sizeof(struct hair_state) == 32 && sizeof(struct hair_history) == 32,
               "what is saved has changed: raise VERSION, and see that walk() has it all");

// Maximum substeps of a block of the hair-hair grid or the fluid. The shortest substeps need fewer.
#define MOST_BEAT 2000
#define MOST_CELLS 1e16 // Maximum distance of the fluid's box from the world's origin, in cells.
#define MOST_CALM 1e9 // s
#define MOST_LONGER 16 // 1 / the minimum of hair_physics.substep_rate.
// Number of words of a collider before the mark of its collision mesh and its key.
#define COLLIDER_WORDS 14
#define COLLIDER_BYTES (4 * COLLIDER_WORDS + 16)
#define KNOT_BYTES 36

// Loaded arrays, before they are checked and collision meshes are held.
struct loaded {
    struct loaded_colliders {
        hair_collider* collider;
        uint32_t count;
    } now, before;
    struct hair_knot* knot; // Pins.
    uint32_t pins;
};

// Return the collision mesh with a mark among the present colliders. Return NULL if there is none.
static const hair_collision_mesh* find_form(const struct hair_colliders* colliders, uint64_t mark)
{
    const struct hair_collider_list* lists[] = {&colliders->now, &colliders->before};
    for (int k = 0; k < 2 && mark; ++k)
        for (uint32_t i = 0; i < lists[k]->count; ++i) {
            const hair_collision_mesh* form = lists[k]->collider[i].mesh;
            if (form && form->mark == mark) return form;
        }
    return NULL;
}

// Serialize a collider as bits. hair_colliders_restore() checks the numbers that matter to its shape.
static void walk_collider(struct hair_walk* c, const struct hair_colliders* there, hair_collider* collider)
{
    for (size_t k = 0; k < COLLIDER_WORDS; ++k) {
        uint32_t bits;
        memcpy(&bits, (unsigned char*)collider + 4 * k, sizeof bits);
        hair_walk_uint(c, "collider", &bits, UINT32_MAX);
        memcpy((unsigned char*)collider + 4 * k, &bits, sizeof bits);
    }
    uint32_t marks[4] = {0, 0, (uint32_t)collider->key, (uint32_t)(collider->key >> 32)};
    if (collider->mesh) {
        marks[0] = (uint32_t)collider->mesh->mark;
        marks[1] = (uint32_t)(collider->mesh->mark >> 32);
    }
    for (int k = 0; k < 4; ++k) hair_walk_uint(c, "collider", &marks[k], UINT32_MAX);
    if (!c->read) return;
    collider->key = marks[2] | (uint64_t)marks[3] << 32;
    collider->mesh = NULL;
    if (collider->shape == HAIR_SHAPE_MESH)
        collider->mesh = find_form(there, marks[0] | (uint64_t)marks[1] << 32);
}

// Serialize a list of colliders. Read into `loaded`, and fail if the count exceeds the bytes
// available.
static void walk_colliders(struct hair_walk* c, const char* name, struct hair_colliders* there,
                           struct hair_collider_list* list, struct loaded_colliders* loaded)
{
    hair_collider* collider = list->collider;
    uint32_t count = list->count;
    hair_walk_uint(c, name, &count, HAIR_MOST_COLLIDERS);
    if (c->read && !c->result) {
        if (count > (c->end - c->at) / COLLIDER_BYTES) {
            c->result = hair_fail(c->host, HAIR_ERROR_FILE,
                                  "the %s before byte %zu of the saved state is %u, more than it holds", name,
                                  c->at, count);
            return;
        }
        collider = loaded->collider = hair_alloc(c->host, count, sizeof *collider);
        loaded->count = count;
        if (!collider) c->result = hair_fail_memory(c->host, "the colliders to load");
    }
    for (uint32_t i = 0; i < count && !c->result; ++i) walk_collider(c, there, &collider[i]);
}

static void walk_knot(struct hair_walk* c, struct hair_knot* knot)
{
    hair_walk_uint(c, "guide of a pin", &knot->guide, UINT32_MAX);
    hair_walk_uint(c, "vertex of a pin", &knot->vertex, UINT32_MAX);
    hair_walk_flag(c, "whether a pin is in the world", &knot->world);
    for (int k = 0; k < 3; ++k) hair_walk_double(c, "place of a pin", &knot->place[k], -MOST_PAST, MOST_PAST);
}

// Serialize the pins. Read into `loaded`, as for colliders.
static void walk_pins(struct hair_walk* c, struct hair_pins* pins, struct loaded* loaded)
{
    struct hair_knot* knot = pins->knot;
    uint32_t count = pins->count;
    hair_walk_uint(c, "number of pins", &count, HAIR_MOST_PINS);
    if (c->read && !c->result) {
        if (count > (c->end - c->at) / KNOT_BYTES) {
            c->result =
                hair_fail(c->host, HAIR_ERROR_FILE,
                          "the number of pins before byte %zu of the saved state is %u, more than it holds",
                          c->at, count);
            return;
        }
        if (count) knot = loaded->knot = hair_alloc(c->host, count, sizeof *knot);
        loaded->pins = count;
        if (count && !loaded->knot) c->result = hair_fail_memory(c->host, "the pins to load");
    }
    for (uint32_t i = 0; i < count && !c->result; ++i) walk_knot(c, &knot[i]);
}

// Serialize the accelerations of the hair-hair grid, which are part of the state within a block of
// substeps. An instance without cohesion and volume skips them.
static void walk_crowd(struct hair_walk* c, struct hair_crowd* crowd, uint32_t vertices)
{
    size_t size = vertices * sizeof(hair_vec4);
    hair_walk_uint(c, "number of substeps since the crowd was looked at", &crowd->beat, MOST_BEAT);
    if (crowd->beat == 0 || c->result) return;
    hair_walk_buffer(c, "crowd's accelerations", crowd->push, size);
    if (!crowd->push) hair_walk_over(c, "crowd's accelerations", size);
}

// Serialize the forces and turns of segments. An instance without the mixed scheme skips them. If
// the state lacks them, hair_sim_load() clears the buffer of the instance.
static void walk_bend(struct hair_walk* c, struct hair_sim* sim)
{
    size_t size = 3 * sim->guide_vertices * sizeof(hair_vec4);
    int there = sim->bend != 0;
    hair_walk_flag(c, "whether there are forces of segments", &there);
    c->lacks_bend = c->read && !there;
    if (!there || c->result) return;
    hair_walk_buffer(c, "forces and turns of segments", sim->bend, size);
    if (!sim->bend) hair_walk_over(c, "forces and turns of segments", size);
}

// Serialize a skinned scalp and the scalp motion. hair_sim_load() has created the buffers.
static void walk_skin(struct hair_walk* c, struct hair_sim* sim, int skinned)
{
    struct hair_skin* skin = &sim->skin;
    if (!skinned || c->result) return;
    size_t size = 3 * (size_t)skin->seats->vertex_count * sizeof(float);
    hair_walk_same(c, "number of scalp vertices", skin->seats->vertex_count);
    hair_walk_vec4(c, "turn of the scalp", &skin->rotation, 2);
    hair_walk_vec4(c, "offset of the scalp", &skin->offset, MOST_PAST);
    hair_walk_buffer(c, "rides of roots", skin->ride, sim->guides * sizeof(struct hair_ride));
    hair_walk_buffer(c, "scalp", skin->scalp[0], size);
    hair_walk_flag(c, "whether a scalp has been given since the last step", &skin->fresh);
    if (!skin->fresh || c->result) return;
    hair_walk_pose(c, "space of the scalp", &skin->space, MOST_PLACE);
    hair_walk_buffer(c, "scalp to come", skin->scalp[1], size);
}

// Serialize the sleep state and the measurements of activity.
static void walk_sleep(struct hair_walk* c, struct hair_sim* sim)
{
    struct hair_sleep* sleep = &sim->sleep;
    float* number[] = {&sleep->now.far, &sleep->now.speed, &sleep->before, &sleep->answer.far,
                       &sleep->answer.speed};
    hair_walk_flag(c, "whether hair sleeps", &sleep->asleep);
    hair_walk_flag(c, "whether hair has been stirred", &sleep->stirred);
    hair_walk_double(c, "time since hair was stirred", &sleep->calm, -MOST_CALM, MOST_CALM);
    hair_walk_double(c, "time when guides are looked at", &sleep->due, -MOST_CALM, MOST_CALM);
    hair_walk_uint(c, "number of looks at guides", &sleep->looks, UINT32_MAX);
    for (int i = 0; i < 5; ++i) hair_walk_float(c, "stirring of guides", number[i], HAIR_MOST_STATE);
    hair_walk_flag(c, "whether a look is under way", &sleep->waits);
    hair_walk_uint(c, "number of steps since a look", &sleep->steps, UINT32_MAX);
    hair_walk_double(c, "time since a look", &sleep->time, 0, MOST_CALM);
    hair_walk_double(c, "time when a round of looks began", &sleep->since, -MOST_CALM, MOST_CALM);
    hair_walk_double(c, "time that a round of looks took", &sleep->span, 0, 2 * MOST_CALM);
    hair_walk_double(c, "time that the round before took", &sleep->span_before, 0, 2 * MOST_CALM);
    hair_walk_pose(c, "head at rest", &sleep->head, MOST_PAST);
    if (c->read && sleep->looks && !c->result) c->result = hair_sleep_make(sim);
    if (sleep->looks && !c->result)
        hair_walk_buffer(c, "anchors of guides", sleep->anchor, sim->guide_vertices * sizeof(hair_vec4));
}

// Serialize the air of a fluid that has a past. An instance without a fluid, or with another fluid,
// skips the air and begins with the wind.
static void walk_blow(struct hair_walk* c, struct hair_blow* blow)
{
    struct hair_fluid* fluid = &blow->fluid;
    int there = fluid->gl && !fluid->fresh;
    uint32_t cells = fluid->desc.cells;
    float side = fluid->desc.side, *wind[] = {&fluid->wind.x, &fluid->wind.y, &fluid->wind.z};
    hair_walk_flag(c, "whether air is a fluid", &there);
    fluid->fresh |= c->read && !there;
    if (!there || c->result) return;
    hair_walk_uint(c, "number of substeps since the fluid's last", &blow->beat, MOST_BEAT);
    hair_walk_uint(c, "number of the fluid's cells", &cells, 128);
    hair_walk_float(c, "side of the fluid's box", &side, 100);
    for (int k = 0; k < 3; ++k)
        hair_walk_double(c, "place of the fluid", &fluid->origin[k], -MOST_CELLS, MOST_CELLS);
    for (int k = 0; k < 3; ++k) hair_walk_float(c, "wind", wind[k], HAIR_MOST_STATE);
    int own = fluid->gl && cells == fluid->desc.cells && side == fluid->desc.side;
    size_t size = 12 * (size_t)(cells + 1) * (cells + 1) * (cells + 1);
    if (own && !c->result) hair_walk_buffer(c, "air", fluid->velocity[fluid->now].buffer, size);
    if (!own) hair_walk_over(c, "air", size);
    if (c->read) fluid->fresh = !own;
    if (!own) blow->beat = 0;
}

// Serialize all fields in order. They identify the haircut, and hold all that the coming motion
// depends on.
static void walk(struct hair_walk* c, struct hair_sim* sim, struct loaded* loaded)
{
    int skinned = hair_skin_is_on(sim);
    // hair_sim_load() reads this field in advance, so it is the first.
    hair_walk_flag(c, "mark of a skinned scalp", &skinned);
    hair_walk_same(c, "solver", sim->solver);
    hair_walk_same(c, "substep", sim->asked_substep);
    hair_walk_same(c, "number of guides", sim->guides);
    hair_walk_same(c, "number of guide vertices", sim->guide_vertices);
    hair_walk_same(c, "hash of the vertices of each guide", sim->layout);
    hair_walk_double(c, "time since the last substep", &sim->left, 0, MOST_SUBSTEP);
    hair_walk_double(c, "length of the last substep", &sim->last_substep, LEAST_SUBSTEP, MOST_SUBSTEP);
    hair_walk_flag(c, "whether there have been colliders", &sim->struck);
    hair_walk_pose(c, "head at the start of the last substep", &sim->last_before, MOST_PAST);
    hair_walk_pose(c, "head at the end of the last substep", &sim->last_after, MOST_PAST);
    hair_walk_pose(c, "head at the last step", &sim->at_step, MOST_PAST);
    hair_walk_pose(c, "head", &sim->head, MOST_PLACE);
    for (int k = 0; k < 3; ++k)
        hair_walk_double(c, "way of gusts", &sim->air.moved[k], -MOST_PAST, MOST_PAST);
    walk_colliders(c, "number of colliders", &sim->colliders, &sim->colliders.now, &loaded->now);
    walk_colliders(c, "number of colliders at the last step", &sim->colliders, &sim->colliders.before,
                   &loaded->before);
    walk_pins(c, &sim->pins, loaded);
    hair_walk_buffer(c, "guide vertices", sim->state, sim->guide_vertices * sizeof(struct hair_state));
    hair_walk_buffer(c, "frames of segments", sim->material, sim->guide_vertices * sizeof(hair_vec4));
    hair_walk_buffer(c, "rates of guide vertices", sim->history,
                     sim->guide_vertices * sizeof(struct hair_history));
    walk_bend(c, sim);
    walk_crowd(c, &sim->crowd, sim->guide_vertices);
    walk_skin(c, sim, skinned);
    walk_sleep(c, sim);
    hair_walk_uint(c, "how many times as long substeps are", &sim->longer, MOST_LONGER);
    hair_walk_double(c, "time since hair was seen", &sim->unseen, 0, 1);
    walk_blow(c, &sim->blow);
}

size_t hair_sim_save_size(struct hair_sim* sim)
{
    struct hair_walk c = {.host = &sim->gl->host, .gl = sim->gl, .at = HEADER};
    struct loaded none = {0}; // Nothing is read.
    hair_sleep_settle(sim);
    walk(&c, sim, &none);
    HAIR_ASSERT(c.result == HAIR_OK);
    return c.at + TRAILER;
}

void hair_sim_save(struct hair_sim* sim, unsigned char* bytes)
{
    struct hair_walk c = {.host = &sim->gl->host, .gl = sim->gl, .write = bytes, .at = HEADER};
    struct loaded none = {0}; // Nothing is read.
    hair_sleep_settle(sim);
    walk(&c, sim, &none);
    HAIR_ASSERT(c.result == HAIR_OK);
    memcpy(bytes, MAGIC, 8);
    hair_write_u32(bytes + 8, VERSION);
    hair_write_u64(bytes + 12, c.at + TRAILER);
    hair_write_u64(bytes + c.at, hair_hash_bytes(HAIR_HASH_BEGIN, bytes, c.at));
}

static hair_result check_frame(const hair_host* host, const unsigned char* bytes, size_t size)
{
    if (size < HEADER + TRAILER || memcmp(bytes, MAGIC, 8) != 0)
        return hair_fail(host, HAIR_ERROR_FILE,
                         "the %zu bytes are no saved state: it is longer, with \"" MAGIC "\" at byte 0",
                         size);
    uint32_t version = hair_read_u32(bytes + 8);
    uint64_t whole = hair_read_u64(bytes + 12);
    if (version != VERSION)
        return hair_fail(host, HAIR_ERROR_FILE, "the version at byte 8 of the saved state is %u, not %d",
                         version, VERSION);
    if (whole != size)
        return hair_fail(host, HAIR_ERROR_FILE,
                         "the saved state ends at byte %zu, not at byte %llu as byte 12 says", size,
                         (unsigned long long)whole);
    if (hair_hash_bytes(HAIR_HASH_BEGIN, bytes, size - TRAILER) != hair_read_u64(bytes + size - TRAILER))
        return hair_fail(host, HAIR_ERROR_FILE,
                         "the saved state is damaged: the hash at byte %zu is not that of the bytes before",
                         size - TRAILER);
    return HAIR_OK;
}

// Read and check a state. Fill in `sim`, which is a copy, and `loaded`, `colliders` and c->own.
static hair_result read(struct hair_walk* c, struct hair_sim* sim, struct loaded* loaded,
                        struct hair_colliders* colliders)
{
    walk(c, sim, loaded);
    if (!c->result && c->at != c->end)
        c->result =
            hair_fail(c->host, HAIR_ERROR_FILE,
                      "the fields of the saved state end at byte %zu, not at byte %zu", c->at, c->end);
    if (!c->result) c->result = hair_pins_check(sim, loaded->knot, loaded->pins);
    if (c->result) return c->result;
    return hair_colliders_restore(c->host, colliders, loaded->now.collider, loaded->now.count,
                                  loaded->before.collider, loaded->before.count);
}

// Upload the buffers by GPU copies, which run in order with dispatches. One driver was seen to lose
// CPU writes into a buffer that a dispatch had just written.
static hair_result upload(const struct hair_walk* c)
{
    GLuint source = 0;
    hair_result result = hair_gl_buffer(c->gl, "hair loaded", c->end, c->own, &source);
    if (result) return result;
    for (uint32_t i = 0; i < c->buffers; ++i) HAIR_ASSERT(c->buffer[i].at + c->buffer[i].size <= c->end);
    for (uint32_t i = 0; i < c->buffers; ++i)
        c->gl->CopyNamedBufferSubData(source, c->buffer[i].buffer, (GLintptr)c->buffer[i].at, 0,
                                      (GLsizeiptr)c->buffer[i].size);
    hair_gl_free_buffer(c->gl, &source);
    return HAIR_OK;
}

hair_result hair_sim_load(struct hair_sim* sim, const unsigned char* bytes, size_t size)
{
    const hair_host* host = &sim->gl->host;
    hair_result result = check_frame(host, bytes, size);
    // The state may contain accelerations of the hair-hair grid and the air of a fluid.
    if (!result) result = hair_sim_need_crowd(sim);
    if (!result) result = hair_blow_need(sim);
    int skinned = !result && size >= HEADER + 4 + TRAILER && hair_read_u32(bytes + HEADER) == 1;
    if (skinned && !sim->skin.seats)
        result = hair_fail(
            host, HAIR_ERROR_ARGUMENT,
            "the saved state is another's: its scalp is skinned, and the instance's groom has none");
    if (!result && skinned) result = hair_skin_make(sim);
    if (result) return result;
    struct hair_sim own = *sim; // Copy that receives the loaded state.
    struct loaded loaded = {0};
    struct hair_walk c = {.host = host, .gl = sim->gl, .read = bytes, .at = HEADER, .end = size - TRAILER};
    own.sleep.fence = NULL;
    c.own = hair_alloc(host, 1, c.end);
    if (!c.own) return hair_fail_memory(host, "the state to load");
    struct hair_colliders colliders = {0};
    GLuint still = 0;
    result = read(&c, &own, &loaded, &colliders);
    if (!result && !skinned && hair_skin_is_on(sim)) result = hair_skin_make_still(sim, &still);
    if (!result) result = upload(&c);
    if (!result && sim->bend && c.lacks_bend)
        sim->gl->ClearNamedBufferData(sim->bend, GL_R32F, GL_RED, GL_FLOAT, NULL);
    if (!result && still) hair_skin_forget(&own, still);
    hair_gl_free_buffer(sim->gl, &still);
    hair_free(host, c.own);
    hair_free(host, loaded.now.collider);
    hair_free(host, loaded.before.collider);
    if (result) {
        hair_free(host, loaded.knot);
        hair_colliders_free(host, &colliders);
        if (!sim->sleep.anchor) hair_sleep_free(&own);
        return result;
    }
    hair_colliders_free(host, &sim->colliders);
    hair_sleep_load(&own, &sim->sleep);
    *sim = own;
    sim->colliders = colliders;
    hair_pins_take(sim, loaded.knot, loaded.pins);
    sim->next_substep = 0;
    hair_diagnosis_forget(sim);
    if (!sim->crowd.push) sim->crowd.beat = 0;
    if (sim->blow.fluid.gl) hair_fluid_show(&sim->blow.fluid);
    hair_sim_show(sim);
    return HAIR_OK;
}
