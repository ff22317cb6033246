// save_fields.c - the fields of a saved state, each with its range. Bytes to load may come from
// untrusted sources.
#include "lib/sim/save_fields.h"

#include <string.h>

#include "lib/collide/collision_mesh.h"

#define MAX_PLACE 1e9 // Maximum coordinate of the head, m. hair_set_transform has this limit too.
// Maximum coordinate of an earlier pose, m. Teleports between two steps can move these poses
// farther.
#define MAX_PAST 1e12
#define MIN_SUBSTEP 1e-6 // s
#define MAX_SUBSTEP 0.11

_Static_assert(
    offsetof(hair_collider, friction) == 52 && sizeof(struct hair_pose) == 40 &&
        sizeof(struct hair_state) == 32 && sizeof(struct hair_history) == 32,
    "what is saved has changed: raise HAIR_SAVE_VERSION, and see that hair_sim_serialize() has it all");

// Maximum substeps of a block of the hair-hair grid or the fluid. The shortest substeps need fewer.
#define MAX_SUBSTEPS_DONE 2000
#define MAX_CELLS 1e16 // Maximum distance of the fluid's box from the world's origin, in cells.
#define MAX_QUIET_TIME 1e9 // s
#define MAX_BLEND 11 // Maximum of hair_target_blend.blend_time and two substeps, s.
#define MAX_SUBSTEP_SCALE (uint32_t)(1 / HAIR_MIN_SUBSTEP_RATE)
// Number of words of a collider before the hash of its collision mesh and its key.
#define COLLIDER_WORDS 14
#define COLLIDER_BYTES (4 * COLLIDER_WORDS + 16)
#define RESOLVED_PIN_BYTES 36

// Return the collision mesh with a content hash among the present colliders. Return NULL if there
// is none.
static const hair_collision_mesh* find_mesh(const struct hair_colliders* colliders, uint64_t hash)
{
    const struct hair_collider_list* lists[] = {&colliders->current, &colliders->previous};
    for (int k = 0; k < 2 && hash; ++k)
        for (uint32_t i = 0; i < lists[k]->count; ++i) {
            const hair_collision_mesh* mesh = lists[k]->collider[i].mesh;
            if (mesh && mesh->content_hash == hash) return mesh;
        }
    return NULL;
}

// Serialize a collider as bits. hair_colliders_restore() checks the numbers that matter to its
// shape.
static void serialize_collider(struct hair_serializer* s, const struct hair_colliders* there,
                               hair_collider* collider)
{
    for (size_t k = 0; k < COLLIDER_WORDS; ++k) {
        uint32_t bits;
        memcpy(&bits, (unsigned char*)collider + 4 * k, sizeof bits);
        hair_serialize_uint(s, "collider", &bits, UINT32_MAX);
        memcpy((unsigned char*)collider + 4 * k, &bits, sizeof bits);
    }
    uint32_t hashes[4] = {0, 0, (uint32_t)collider->key, (uint32_t)(collider->key >> 32)};
    if (collider->mesh) {
        hashes[0] = (uint32_t)collider->mesh->content_hash;
        hashes[1] = (uint32_t)(collider->mesh->content_hash >> 32);
    }
    for (int k = 0; k < 4; ++k) hair_serialize_uint(s, "collider", &hashes[k], UINT32_MAX);
    if (!s->read) return;
    collider->key = hashes[2] | (uint64_t)hashes[3] << 32;
    collider->mesh = NULL;
    if (collider->shape == HAIR_SHAPE_MESH)
        collider->mesh = find_mesh(there, hashes[0] | (uint64_t)hashes[1] << 32);
    else if ((hashes[0] || hashes[1]) && !s->result)
        s->result =
            hair_fail(s->host, HAIR_ERROR_FILE,
                      "the collider before byte %zu of the saved state names a collision mesh, but its "
                      "shape is %u",
                      s->at, (unsigned)collider->shape);
}

// Serialize a list of colliders. Read into `loaded`, and fail if the count exceeds the bytes
// available.
static void serialize_colliders(struct hair_serializer* s, const char* name, struct hair_colliders* there,
                                struct hair_collider_list* list, struct hair_loaded_colliders* loaded)
{
    hair_collider* collider = list->collider;
    uint32_t count = list->count;
    hair_serialize_uint(s, name, &count, HAIR_MAX_COLLIDERS);
    if (s->read && !s->result) {
        if (count > (s->end - s->at) / COLLIDER_BYTES) {
            s->result = hair_fail(s->host, HAIR_ERROR_FILE,
                                  "the %s before byte %zu of the saved state is %u, more than it holds", name,
                                  s->at, count);
            return;
        }
        collider = loaded->collider = hair_alloc(s->host, count, sizeof *collider);
        loaded->count = count;
        if (!collider) s->result = hair_fail_memory(s->host, "the colliders to load");
    }
    for (uint32_t i = 0; i < count && !s->result; ++i) serialize_collider(s, there, &collider[i]);
}

static void serialize_resolved_pin(struct hair_serializer* s, struct hair_resolved_pin* resolved_pin)
{
    hair_serialize_uint(s, "guide of a pin", &resolved_pin->guide, UINT32_MAX);
    hair_serialize_uint(s, "vertex of a pin", &resolved_pin->vertex, UINT32_MAX);
    hair_serialize_flag(s, "whether a pin is in the world", &resolved_pin->world);
    for (int k = 0; k < 3; ++k)
        hair_serialize_double(s, "place of a pin", &resolved_pin->place[k], -MAX_PAST, MAX_PAST);
}

// Serialize the pins. Read into `loaded`, as for colliders.
static void serialize_pins(struct hair_serializer* s, struct hair_pins* pins, struct hair_loaded* loaded)
{
    struct hair_resolved_pin* resolved_pin = pins->resolved_pin;
    uint32_t count = pins->count;
    hair_serialize_uint(s, "number of pins", &count, HAIR_MAX_PINS);
    if (s->read && !s->result) {
        if (count > (s->end - s->at) / RESOLVED_PIN_BYTES) {
            s->result =
                hair_fail(s->host, HAIR_ERROR_FILE,
                          "the number of pins before byte %zu of the saved state is %u, more than it holds",
                          s->at, count);
            return;
        }
        if (count) resolved_pin = loaded->resolved_pin = hair_alloc(s->host, count, sizeof *resolved_pin);
        loaded->pins = count;
        if (count && !loaded->resolved_pin) s->result = hair_fail_memory(s->host, "the pins to load");
    }
    for (uint32_t i = 0; i < count && !s->result; ++i) serialize_resolved_pin(s, &resolved_pin[i]);
}

// Serialize the accelerations of the hair-hair grid, which are part of the state within a block of
// substeps. An instance without cohesion and volume skips them.
static void serialize_hair_grid(struct hair_serializer* s, struct hair_grid* hair_grid, uint32_t vertices)
{
    size_t size = vertices * sizeof(hair_vec4);
    hair_serialize_uint(s, "number of substeps since the last update of the hair grid",
                        &hair_grid->substeps_done, MAX_SUBSTEPS_DONE);
    if (hair_grid->substeps_done == 0 || s->result) return;
    hair_serialize_buffer(s, "hair grid's accelerations", hair_grid->acceleration, size);
    if (!hair_grid->acceleration)
        hair_serialize_skipped(s, "hair grid's accelerations", size, HAIR_MAX_STATE);
}

// Serialize the forces and turns of segments. An instance without the mixed scheme skips them. If
// the state lacks them, hair_sim_load() clears the buffer of the instance.
static void serialize_bend(struct hair_serializer* s, struct hair_sim* sim)
{
    size_t size = 3 * (size_t)sim->guide_vertices * sizeof(hair_vec4);
    int there = sim->bend != 0;
    hair_serialize_flag(s, "whether there are forces of segments", &there);
    s->lacks_bend = s->read && !there;
    if (!there || s->result) return;
    hair_serialize_buffer_within(s, "forces and turns of segments", sim->bend, size, HAIR_MAX_FORCE);
    if (!sim->bend) hair_serialize_skipped(s, "forces and turns of segments", size, HAIR_MAX_FORCE);
}

// Serialize a skinned scalp and the scalp motion. hair_sim_load() has created the buffers.
static void serialize_scalp_motion(struct hair_serializer* s, struct hair_sim* sim, int skinned)
{
    struct hair_scalp_motion* motion = &sim->scalp_motion;
    if (!skinned || s->result) return;
    size_t size = 3 * (size_t)motion->root_bindings->vertex_count * sizeof(float);
    hair_serialize_same(s, "number of scalp vertices", motion->root_bindings->vertex_count);
    hair_serialize_vec4(s, "turn of the scalp", &motion->rotation, 2);
    hair_serialize_vec4(s, "offset of the scalp", &motion->offset, MAX_PAST);
    hair_serialize_buffer(s, "root transforms", motion->root_transform,
                          sim->guides * sizeof(struct hair_root_transform));
    hair_serialize_buffer(s, "scalp", motion->scalp[0], size);
    hair_serialize_flag(s, "whether a scalp has been given since the last step", &motion->changed);
    if (!motion->changed || s->result) return;
    hair_serialize_pose(s, "space of the scalp", &motion->space, MAX_PLACE);
    hair_serialize_buffer(s, "scalp to come", motion->scalp[1], size);
}

// Serialize targets. hair_sim_load() has created the buffers. Weights to come are settings.
static void serialize_targets(struct hair_serializer* s, struct hair_sim* sim, bool has_targets)
{
    struct hair_targets* targets = &sim->targets;
    if (!has_targets || s->result) return;
    size_t size = 3 * (size_t)sim->guide_vertices * sizeof(float);
    hair_serialize_vec4(s, "turn of the targets", &targets->rotation, 2);
    hair_serialize_vec4(s, "offset of the targets", &targets->offset, MAX_PAST);
    hair_serialize_flag(s, "whether targets end", &targets->ends);
    hair_serialize_double(s, "time until targets are blended", &targets->blend_left, 0, MAX_BLEND);
    hair_serialize_buffer(s, "targets", targets->target, sim->guide_vertices * sizeof(hair_vec4));
    hair_serialize_buffer(s, "positions of targets", targets->position[0], size);
    hair_serialize_flag(s, "whether targets have been given since the last step", &targets->changed);
    if (!targets->changed || s->result) return;
    hair_serialize_pose(s, "space of the targets", &targets->space, MAX_PLACE);
    hair_serialize_buffer(s, "positions of targets to come", targets->position[1], size);
}

// Serialize fractions of lengths. Read into an array that is allocated.
static void serialize_fractions(struct hair_serializer* s, const char* name, uint32_t count, float* fraction,
                                float** loaded)
{
    if (s->read && !s->result) {
        if (count <= (s->end - s->at) / sizeof *fraction)
            fraction = *loaded = hair_alloc(s->host, count, sizeof *fraction);
        if (!*loaded) {
            s->result = hair_fail(s->host, HAIR_ERROR_FILE,
                                  "the %u numbers \"%s\" from byte %zu of the saved state on do not fit",
                                  count, name, s->at);
            return;
        }
    }
    for (uint32_t i = 0; i < count && !s->result; ++i) {
        hair_serialize_float(s, name, &fraction[i], 1);
        if (s->read && !s->result && !(fraction[i] >= 0))
            s->result = hair_fail(s->host, HAIR_ERROR_FILE,
                                  "the %s before byte %zu of the saved state is %g, not in [0, 1]", name,
                                  s->at, (double)fraction[i]);
    }
}

// Serialize the lengths of guides and followers.
static void serialize_lengths(struct hair_serializer* s, struct hair_sim* sim, bool has_lengths,
                              struct hair_loaded* loaded)
{
    struct hair_lengths* lengths = &sim->lengths;
    if (!has_lengths || s->result) return;
    uint32_t followers = lengths->groom ? lengths->groom->info.follower_count : 0;
    hair_serialize_same(s, "number of followers", followers);
    serialize_fractions(s, "length of a guide", sim->guides, lengths->guide_fraction,
                        &loaded->guide_fraction);
    serialize_fractions(s, "length of a follower", followers, lengths->follower_fraction,
                        &loaded->follower_fraction);
}

// Serialize the sleep state and the measurements of activity.
static void serialize_sleep(struct hair_serializer* s, struct hair_sim* sim, struct hair_loaded* loaded)
{
    struct hair_sleep* sleep = &sim->sleep;
    float* number[] = {&sleep->now.far, &sleep->now.speed, &sleep->before, &sleep->answer.far,
                       &sleep->answer.speed};
    hair_serialize_flag(s, "whether hair sleeps", &sleep->asleep);
    hair_serialize_flag(s, "whether hair has been disturbed", &sleep->disturbed);
    hair_serialize_double(s, "quiet time of hair", &sleep->quiet_time, -MAX_QUIET_TIME, MAX_QUIET_TIME);
    hair_serialize_double(s, "time when guides are looked at", &sleep->due, -MAX_QUIET_TIME, MAX_QUIET_TIME);
    hair_serialize_uint(s, "number of activity samples", &sleep->samples, UINT32_MAX);
    for (int i = 0; i < 5; ++i) hair_serialize_float(s, "activity of guides", number[i], HAIR_MAX_STATE);
    hair_serialize_flag(s, "whether an activity query is pending", &sleep->waits);
    hair_serialize_uint(s, "number of steps since the activity query", &sleep->steps, UINT32_MAX);
    hair_serialize_double(s, "time since the activity query", &sleep->time, 0, MAX_QUIET_TIME);
    hair_serialize_double(s, "start of the current round of samples", &sleep->since, -MAX_QUIET_TIME,
                          MAX_QUIET_TIME);
    hair_serialize_double(s, "duration of the last round of samples", &sleep->span, 0, 2 * MAX_QUIET_TIME);
    hair_serialize_double(s, "duration of the round before", &sleep->span_before, 0, 2 * MAX_QUIET_TIME);
    hair_serialize_pose(s, "head at rest", &sleep->head, MAX_PAST);
    if (!sleep->samples || s->result) return;
    loaded->has_anchors = s->read;
    loaded->anchors = s->buffers;
    hair_serialize_buffer(s, "anchors of guides", s->read ? HAIR_SERIALIZER_NEW : sleep->anchor,
                          sim->guide_vertices * sizeof(hair_vec4));
}

// Serialize the air of a fluid that has a past. An instance without a fluid, or with another fluid,
// skips the air and begins with the wind.
static void serialize_wind_coupling(struct hair_serializer* s, struct hair_wind_coupling* wind_coupling)
{
    struct hair_fluid* fluid = &wind_coupling->fluid;
    int there = fluid->gl && !fluid->is_reset;
    uint32_t cells = fluid->desc.cells;
    float side = fluid->desc.side, *wind[] = {&fluid->wind.x, &fluid->wind.y, &fluid->wind.z};
    hair_serialize_flag(s, "whether air is a fluid", &there);
    fluid->is_reset |= s->read && !there;
    if (!there || s->result) return;
    hair_serialize_uint(s, "number of substeps since the fluid's last", &wind_coupling->substeps_done,
                        MAX_SUBSTEPS_DONE);
    hair_serialize_uint(s, "number of the fluid's cells", &cells, 128);
    hair_serialize_float(s, "side of the fluid's box", &side, 100);
    for (int k = 0; k < 3; ++k)
        hair_serialize_double(s, "place of the fluid", &fluid->origin[k], -MAX_CELLS, MAX_CELLS);
    for (int k = 0; k < 3; ++k) hair_serialize_float(s, "wind", wind[k], HAIR_MAX_STATE);
    int own = fluid->gl && cells == fluid->desc.cells && side == fluid->desc.side;
    size_t size = 12 * (size_t)(cells + 1) * (cells + 1) * (cells + 1);
    if (own && !s->result) hair_serialize_buffer(s, "air", fluid->velocity[fluid->now].buffer, size);
    if (!own) hair_serialize_skipped(s, "air", size, HAIR_MAX_STATE);
    if (s->read) fluid->is_reset = !own;
    if (!own) wind_coupling->substeps_done = 0;
}

void hair_sim_serialize(struct hair_serializer* s, struct hair_sim* sim, struct hair_loaded* loaded)
{
    uint32_t marks = (hair_scalp_motion_is_on(sim) ? HAIR_SAVE_SKINNED : 0) |
                     (hair_targets_are_on(sim) ? HAIR_SAVE_TARGETS : 0) |
                     (sim->lengths.guides ? HAIR_SAVE_LENGTHS : 0);
    // hair_sim_load() reads this field in advance, so it is the first.
    hair_serialize_uint(s, "marks of a skinned scalp, of targets and of lengths", &marks, HAIR_SAVE_MARKS);
    hair_serialize_same(s, "solver", sim->solver);
    hair_serialize_same(s, "substep", sim->asked_substep);
    hair_serialize_same(s, "number of guides", sim->guides);
    hair_serialize_same(s, "number of guide vertices", sim->guide_vertices);
    hair_serialize_same(s, "hash of the vertices of each guide", sim->layout);
    serialize_lengths(s, sim, (marks & HAIR_SAVE_LENGTHS) != 0, loaded);
    hair_serialize_double(s, "time since the last substep", &sim->accumulator, 0, MAX_SUBSTEP);
    hair_serialize_double(s, "length of the last substep", &sim->last_substep, MIN_SUBSTEP, MAX_SUBSTEP);
    hair_serialize_flag(s, "whether there have been colliders", &sim->had_contact);
    hair_serialize_pose(s, "head at the start of the last substep", &sim->last_before, MAX_PAST);
    hair_serialize_pose(s, "head at the end of the last substep", &sim->last_after, MAX_PAST);
    hair_serialize_pose(s, "head at the last step", &sim->head_at_last_step, MAX_PAST);
    hair_serialize_pose(s, "head", &sim->head, MAX_PLACE);
    for (int k = 0; k < 3; ++k)
        hair_serialize_double(s, "way of gusts", &sim->wind_state.moved[k], -MAX_PAST, MAX_PAST);
    serialize_colliders(s, "number of colliders", &sim->colliders, &sim->colliders.current, &loaded->now);
    serialize_colliders(s, "number of colliders at the last step", &sim->colliders, &sim->colliders.previous,
                        &loaded->before);
    serialize_pins(s, &sim->pins, loaded);
    hair_serialize_buffer(s, "guide vertices", sim->state, sim->guide_vertices * sizeof(struct hair_state));
    hair_serialize_buffer(s, "frames of segments", sim->material, sim->guide_vertices * sizeof(hair_vec4));
    hair_serialize_buffer(s, "rates of guide vertices", sim->history,
                          sim->guide_vertices * sizeof(struct hair_history));
    serialize_bend(s, sim);
    serialize_hair_grid(s, &sim->hair_grid, sim->guide_vertices);
    serialize_scalp_motion(s, sim, (marks & HAIR_SAVE_SKINNED) != 0);
    serialize_targets(s, sim, (marks & HAIR_SAVE_TARGETS) != 0);
    serialize_sleep(s, sim, loaded);
    hair_serialize_uint(s, "how many times as long substeps are", &sim->substep_scale, MAX_SUBSTEP_SCALE);
    hair_serialize_double(s, "time since hair was seen", &sim->unseen, 0, 1);
    serialize_wind_coupling(s, &sim->wind_coupling);
    hair_serialize_uint(s, "stride of simulated guides", &sim->guide_level.last, HAIR_MAX_GUIDE_STRIDE);
}
