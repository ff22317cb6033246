// save.c - the moving part of a simulation as bytes that may come back from anywhere.
//
//   byte  0  "hairsave"
//         8  u32 version
//        12  u64 bytes of all
//        20  the fields, as walk() lists them
//   the end  u64 FNV-1a hash of all bytes before
//
// The hash finds what was damaged; against harm every field is checked as well, for anyone can make a hash.
#include "lib/sim/sim.h"

#include <string.h>

#include "lib/base/bytes.h"
#include "lib/collide/form.h"

#define VERSION 12 // Of the list in walk() and what its fields mean: raise it with either.
#define HEADER 20
#define TRAILER 8
#define MAGIC "hairsave"

#define MOST_PLACE 1e9     // m: of the head, as in hair_set_transform
#define MOST_PAST 1e12     // m: of a pose before it, which teleports between two steps take further
#define MOST_STATE 1e9     // any number in a buffer: a solver itself resets what is too far for hair
#define LEAST_SUBSTEP 1e-6 // s
#define MOST_SUBSTEP 0.11

_Static_assert(offsetof(hair_solid, friction) == 52 && sizeof(struct hair_pose) == 40 &&
                   sizeof(struct hair_state) == 32 && sizeof(struct hair_history) == 32,
               "what is saved has changed: raise VERSION, and see that walk() has it all");

#define MOST_BEAT 2000  // substeps of a block of the crowd or the fluid: more than there are of the shortest
#define MOST_CELLS 1e16 // from the world's origin to the fluid's box
#define MOST_CALM 1e9   // s
#define MOST_LONGER 16  // by the least hair_physics.rate
#define MOST_BUFFERS 10 // that walk() lists
#define SOLID_WORDS 14  // of a solid, before the mark of its form and its key
#define SOLID_BYTES (4 * SOLID_WORDS + 16)
#define KNOT_BYTES 36

// And ties.
struct loaded_ties {
    struct hair_knot* knot;
    uint32_t          count;
};

// Solids that are read, before they are checked and their forms are held.
struct loaded_solids {
    hair_solid* solid;
    uint32_t    count;
};

// Goes over the fields to count, write or read and check them.
struct cursor {
    const hair_host*     host;
    struct hair_gl*      gl;
    const unsigned char* read;  // all the bytes, or
    unsigned char*       write; // all the bytes, or neither: count only
    unsigned char*       own;   // as many; what is read of buffers, in the machine's order
    size_t               at, end;
    struct loaded_solids now, before; // what is read of them
    struct loaded_ties   ties;        // likewise
    hair_result          result;      // the first failure's; nothing is read after it
    uint32_t             buffers;
    struct {
        GLuint buffer;
        size_t at, size;
    } buffer[MOST_BUFFERS]; // read so far
};

// Whether the next `size` bytes are there to be read.
static int can_read(struct cursor* c, const char* name, size_t size)
{
    if (!c->read || c->result) return 0;
    if (size <= c->end - c->at) return 1;
    c->result = hair_fail(c->host, HAIR_ERROR_FILE,
                          "the fields of the saved state end at byte %zu, within the %s at byte %zu", c->end,
                          name, c->at);
    return 0;
}

static void check(struct cursor* c, const char* name, double value, double least, double most)
{
    if (c->result || (value >= least && value <= most)) return; // Written so that NaN fails too.
    c->result = hair_fail(c->host, HAIR_ERROR_FILE,
                          "the %s at byte %zu of the saved state is %.9g, not in [%.9g, %.9g]", name, c->at,
                          value, least, most);
}

static void walk_uint(struct cursor* c, const char* name, uint32_t* value, uint32_t most)
{
    if (c->write) hair_write_u32(c->write + c->at, *value);
    if (can_read(c, name, 4)) {
        uint32_t read = hair_read_u32(c->read + c->at);
        check(c, name, read, 0, most);
        if (!c->result) *value = read;
    }
    c->at += 4;
}

static void walk_flag(struct cursor* c, const char* name, int* flag)
{
    uint32_t value = *flag != 0;
    walk_uint(c, name, &value, 1);
    *flag = (int)value;
}

static void walk_float(struct cursor* c, const char* name, float* value, double most)
{
    if (c->write) hair_write_float(c->write + c->at, *value);
    if (can_read(c, name, 4)) {
        *value = hair_read_float(c->read + c->at);
        check(c, name, (double)*value, -most, most);
    }
    c->at += 4;
}

static void walk_double(struct cursor* c, const char* name, double* value, double least, double most)
{
    if (c->write) hair_write_double(c->write + c->at, *value);
    if (can_read(c, name, 8)) {
        *value = hair_read_double(c->read + c->at);
        check(c, name, *value, least, most);
    }
    c->at += 8;
}

// What must be as the instance has it: else the state is another's.
static void walk_same(struct cursor* c, const char* name, double value)
{
    if (c->write) hair_write_double(c->write + c->at, value);
    if (can_read(c, name, 8)) {
        double saved = hair_read_double(c->read + c->at);
        if (!(saved == value))
            c->result = hair_fail(c->host, HAIR_ERROR_ARGUMENT,
                                  "the saved state is another's: its %s is %.9g, the instance's %.9g", name,
                                  saved, value);
    }
    c->at += 8;
}

static void walk_pose(struct cursor* c, const char* name, struct hair_pose* pose, double most)
{
    float* rotation[] = {&pose->rotation.x, &pose->rotation.y, &pose->rotation.z, &pose->rotation.w};
    float  norm       = 0;
    for (int i = 0; i < 3; ++i) walk_double(c, name, &pose->position[i], -most, most);
    for (int i = 0; i < 4; ++i) {
        walk_float(c, name, rotation[i], 2);
        norm += *rotation[i] * *rotation[i];
    }
    if (c->read && !c->result && !(fabsf(norm - 1) <= 1e-3f))
        c->result =
            hair_fail(c->host, HAIR_ERROR_FILE,
                      "the rotation of the %s, before byte %zu of the saved state, has norm %g, not 1", name,
                      c->at, (double)sqrtf(norm));
}

// The form of that mark among the solids there are. NULL: none.
static const hair_form* find_form(const struct hair_solids* solids, uint64_t mark)
{
    const struct hair_solid_list* lists[] = {&solids->now, &solids->before};
    for (int k = 0; k < 2 && mark; ++k)
        for (uint32_t i = 0; i < lists[k]->count; ++i) {
            const hair_form* form = lists[k]->solid[i].form;
            if (form && form->mark == mark) return form;
        }
    return NULL;
}

// As bits: hair_solids_restore knows which of the numbers matter to a shape.
static void walk_solid(struct cursor* c, const struct hair_solids* there, hair_solid* solid)
{
    for (size_t k = 0; k < SOLID_WORDS; ++k) {
        uint32_t bits;
        memcpy(&bits, (unsigned char*)solid + 4 * k, sizeof bits);
        walk_uint(c, "solid", &bits, UINT32_MAX);
        memcpy((unsigned char*)solid + 4 * k, &bits, sizeof bits);
    }
    uint32_t marks[4] = {0, 0, (uint32_t)solid->key, (uint32_t)(solid->key >> 32)};
    if (solid->form) {
        marks[0] = (uint32_t)solid->form->mark;
        marks[1] = (uint32_t)(solid->form->mark >> 32);
    }
    for (int k = 0; k < 4; ++k) walk_uint(c, "solid", &marks[k], UINT32_MAX);
    if (!c->read) return;
    solid->key  = marks[2] | (uint64_t)marks[3] << 32;
    solid->form = NULL;
    if (solid->shape == HAIR_SHAPE_FORM) solid->form = find_form(there, marks[0] | (uint64_t)marks[1] << 32);
}

// Read into `loaded`. There are no more than bytes for them.
static void walk_solids(struct cursor* c, const char* name, struct hair_solids* there,
                        struct hair_solid_list* list, struct loaded_solids* loaded)
{
    hair_solid* solid = list->solid;
    uint32_t    count = list->count;
    walk_uint(c, name, &count, HAIR_MOST_SOLIDS);
    if (c->read && !c->result) {
        if (count > (c->end - c->at) / SOLID_BYTES) {
            c->result = hair_fail(c->host, HAIR_ERROR_FILE,
                                  "the %s before byte %zu of the saved state is %u, more than it holds", name,
                                  c->at, count);
            return;
        }
        solid = loaded->solid = hair_alloc(c->host, count, sizeof *solid);
        loaded->count         = count;
        if (!solid) c->result = hair_fail_memory(c->host, "the solids to load");
    }
    for (uint32_t i = 0; i < count && !c->result; ++i) walk_solid(c, there, &solid[i]);
}

static void walk_knot(struct cursor* c, struct hair_knot* knot)
{
    walk_uint(c, "guide of a tie", &knot->guide, UINT32_MAX);
    walk_uint(c, "vertex of a tie", &knot->vertex, UINT32_MAX);
    walk_flag(c, "whether a tie is in the world", &knot->world);
    for (int k = 0; k < 3; ++k) walk_double(c, "place of a tie", &knot->place[k], -MOST_PAST, MOST_PAST);
}

// Into c->ties, as solids are.
static void walk_ties(struct cursor* c, struct hair_ties* ties)
{
    struct hair_knot* knot  = ties->knot;
    uint32_t          count = ties->count;
    walk_uint(c, "number of ties", &count, HAIR_MOST_TIES);
    if (c->read && !c->result) {
        if (count > (c->end - c->at) / KNOT_BYTES) {
            c->result =
                hair_fail(c->host, HAIR_ERROR_FILE,
                          "the number of ties before byte %zu of the saved state is %u, more than it holds",
                          c->at, count);
            return;
        }
        if (count) knot = c->ties.knot = hair_alloc(c->host, count, sizeof *knot);
        c->ties.count = count;
        if (count && !c->ties.knot) c->result = hair_fail_memory(c->host, "the ties to load");
    }
    for (uint32_t i = 0; i < count && !c->result; ++i) walk_knot(c, &knot[i]);
}

// Floats, whatever they are to a solver. A buffer that the instance has no use for is 0.
static void walk_buffer(struct cursor* c, const char* name, GLuint buffer, size_t size)
{
    size_t end = c->at + size;
    if (!buffer) return;
    if (c->write) {
        unsigned char* at = c->write + c->at;
        c->gl->GetNamedBufferSubData(buffer, 0, (GLsizeiptr)size, at);
        for (size_t i = 0; i < size / 4; ++i) { // In place, from the machine's order of bytes.
            uint32_t bits;
            memcpy(&bits, at, sizeof bits);
            at = hair_write_u32(at, bits);
        }
    }
    if (c->read) {
        c->buffer[c->buffers].buffer = buffer;
        c->buffer[c->buffers].at     = c->at;
        c->buffer[c->buffers].size   = size;
        ++c->buffers;
        while (c->at < end && !c->result) {
            float  number = 0;
            size_t at     = c->at;
            walk_float(c, name, &number, MOST_STATE);
            if (!c->result) memcpy(c->own + at, &number, sizeof number);
        }
    }
    c->at = end;
}

// Within a block of substeps what other hair does is part of the state. An instance without cohesion and volume reads
// over it.
static void walk_crowd(struct cursor* c, struct hair_crowd* crowd, uint32_t vertices)
{
    size_t size = vertices * sizeof(hair_vec4);
    walk_uint(c, "number of substeps since the crowd was looked at", &crowd->beat, MOST_BEAT);
    if (crowd->beat == 0 || c->result) return;
    walk_buffer(c, "crowd's accelerations", crowd->push, size);
    for (size_t i = 0; i < size && !crowd->push && !c->result; i += 4) {
        float number = 0;
        walk_float(c, "crowd's accelerations", &number, MOST_STATE);
    }
}

static void walk_vec4(struct cursor* c, const char* name, hair_vec4* v, double most)
{
    float* number[] = {&v->x, &v->y, &v->z, &v->w};
    for (int k = 0; k < 4; ++k) walk_float(c, name, number[k], most);
}

// Where a skinned scalp is, which hair_sim_load has made ready for, and where it has roots.
static void walk_skin(struct cursor* c, struct hair_sim* sim, int skinned)
{
    struct hair_skin* skin = &sim->skin;
    if (!skinned || c->result) return;
    size_t size = 3 * (size_t)skin->seats->vertex_count * sizeof(float);
    walk_same(c, "number of scalp vertices", skin->seats->vertex_count);
    walk_vec4(c, "turn of the scalp", &skin->rotation, 2);
    walk_vec4(c, "offset of the scalp", &skin->offset, MOST_PAST);
    walk_buffer(c, "rides of roots", skin->ride, sim->guides * sizeof(struct hair_ride));
    walk_buffer(c, "scalp", skin->scalp[0], size);
    walk_flag(c, "whether a scalp has been given since the last step", &skin->fresh);
    if (!skin->fresh || c->result) return;
    walk_pose(c, "space of the scalp", &skin->space, MOST_PLACE);
    walk_buffer(c, "scalp to come", skin->scalp[1], size);
}

// Whether hair sleeps, and what has been seen of its coming to rest.
static void walk_sleep(struct cursor* c, struct hair_sim* sim)
{
    struct hair_sleep* sleep    = &sim->sleep;
    float*             number[] = {&sleep->now.far, &sleep->now.speed, &sleep->before, &sleep->answer.far,
                                   &sleep->answer.speed};
    walk_flag(c, "whether hair sleeps", &sleep->asleep);
    walk_flag(c, "whether hair has been stirred", &sleep->stirred);
    walk_double(c, "time since hair was stirred", &sleep->calm, -MOST_CALM, MOST_CALM);
    walk_double(c, "time when guides are looked at", &sleep->due, -MOST_CALM, MOST_CALM);
    walk_uint(c, "number of looks at guides", &sleep->looks, UINT32_MAX);
    for (int i = 0; i < 5; ++i) walk_float(c, "stirring of guides", number[i], MOST_STATE);
    walk_flag(c, "whether a look is under way", &sleep->waits);
    walk_uint(c, "number of steps since a look", &sleep->steps, UINT32_MAX);
    walk_double(c, "time since a look", &sleep->time, 0, MOST_CALM);
    walk_double(c, "time when a round of looks began", &sleep->since, -MOST_CALM, MOST_CALM);
    walk_double(c, "time that a round of looks took", &sleep->span, 0, 2 * MOST_CALM);
    walk_double(c, "time that the round before took", &sleep->span_before, 0, 2 * MOST_CALM);
    walk_pose(c, "head at rest", &sleep->head, MOST_PAST);
    if (c->read && sleep->looks && !c->result) c->result = hair_sleep_make(sim);
    if (sleep->looks && !c->result)
        walk_buffer(c, "anchors of guides", sleep->anchor, sim->guide_vertices * sizeof(hair_vec4));
}

// The air of a fluid that has a past. An instance without one, or with another, reads over it and begins with the wind.
static void walk_blow(struct cursor* c, struct hair_blow* blow)
{
    struct hair_fluid* fluid = &blow->fluid;
    int                there = fluid->gl && !fluid->fresh;
    uint32_t           cells = fluid->desc.cells;
    float              side = fluid->desc.side, *wind[] = {&fluid->wind.x, &fluid->wind.y, &fluid->wind.z};
    walk_flag(c, "whether air is a fluid", &there);
    fluid->fresh |= c->read && !there;
    if (!there || c->result) return;
    walk_uint(c, "number of substeps since the fluid's last", &blow->beat, MOST_BEAT);
    walk_uint(c, "number of the fluid's cells", &cells, 128);
    walk_float(c, "side of the fluid's box", &side, 100);
    for (int k = 0; k < 3; ++k)
        walk_double(c, "place of the fluid", &fluid->origin[k], -MOST_CELLS, MOST_CELLS);
    for (int k = 0; k < 3; ++k) walk_float(c, "wind", wind[k], MOST_STATE);
    int    own  = fluid->gl && cells == fluid->desc.cells && side == fluid->desc.side;
    size_t size = 12 * (size_t)(cells + 1) * (cells + 1) * (cells + 1);
    if (own && !c->result) walk_buffer(c, "air", fluid->velocity[fluid->now].buffer, size);
    for (size_t i = 0; i < size && !own && !c->result; i += 4) {
        float number = 0;
        walk_float(c, "air", &number, MOST_STATE);
    }
    if (c->read) fluid->fresh = !own;
    if (!own) blow->beat = 0;
}

// All that is saved, in order: of which haircut it is, and what the coming motion depends on.
static void walk(struct cursor* c, struct hair_sim* sim)
{
    int skinned = hair_skin_is_on(sim);
    walk_flag(c, "mark of a skinned scalp", &skinned); // First, so that hair_sim_load can look.
    walk_same(c, "solver", sim->solver);
    walk_same(c, "substep", sim->asked_substep);
    walk_same(c, "number of guides", sim->guides);
    walk_same(c, "number of guide vertices", sim->guide_vertices);
    walk_same(c, "hash of the vertices of each guide", sim->layout);
    walk_double(c, "time since the last substep", &sim->left, 0, MOST_SUBSTEP);
    walk_double(c, "length of the last substep", &sim->last_substep, LEAST_SUBSTEP, MOST_SUBSTEP);
    walk_flag(c, "whether there have been solids", &sim->struck);
    walk_pose(c, "head at the start of the last substep", &sim->last_before, MOST_PAST);
    walk_pose(c, "head at the end of the last substep", &sim->last_after, MOST_PAST);
    walk_pose(c, "head at the last step", &sim->at_step, MOST_PAST);
    walk_pose(c, "head", &sim->head, MOST_PLACE);
    for (int k = 0; k < 3; ++k) walk_double(c, "way of gusts", &sim->air.moved[k], -MOST_PAST, MOST_PAST);
    walk_solids(c, "number of solids", &sim->solids, &sim->solids.now, &c->now);
    walk_solids(c, "number of solids at the last step", &sim->solids, &sim->solids.before, &c->before);
    walk_ties(c, &sim->ties);
    walk_buffer(c, "guide vertices", sim->state, sim->guide_vertices * sizeof(struct hair_state));
    walk_buffer(c, "frames of segments", sim->material, sim->guide_vertices * sizeof(hair_vec4));
    walk_buffer(c, "rates of guide vertices", sim->history,
                sim->guide_vertices * sizeof(struct hair_history));
    walk_crowd(c, &sim->crowd, sim->guide_vertices);
    walk_skin(c, sim, skinned);
    walk_sleep(c, sim);
    walk_uint(c, "how many times as long substeps are", &sim->longer, MOST_LONGER);
    walk_double(c, "time since hair was seen", &sim->unseen, 0, 1);
    walk_blow(c, &sim->blow);
}

size_t hair_sim_save_size(struct hair_sim* sim)
{
    struct cursor c = {.host = &sim->gl->host, .gl = sim->gl, .at = HEADER};
    hair_sleep_settle(sim);
    walk(&c, sim);
    return c.at + TRAILER;
}

void hair_sim_save(struct hair_sim* sim, unsigned char* bytes)
{
    struct cursor c = {.host = &sim->gl->host, .gl = sim->gl, .write = bytes, .at = HEADER};
    hair_sleep_settle(sim);
    walk(&c, sim);
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
    uint64_t whole   = hair_read_u64(bytes + 12);
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

// Into `sim`, which is a copy, `solids` and c->own.
static hair_result read(struct cursor* c, struct hair_sim* sim, struct hair_solids* solids)
{
    walk(c, sim);
    if (!c->result && c->at != c->end)
        c->result =
            hair_fail(c->host, HAIR_ERROR_FILE,
                      "the fields of the saved state end at byte %zu, not at byte %zu", c->at, c->end);
    if (!c->result) c->result = hair_ties_check(sim, c->ties.knot, c->ties.count);
    if (c->result) return c->result;
    return hair_solids_restore(c->host, solids, c->now.solid, c->now.count, c->before.solid, c->before.count);
}

// By the GPU, in its order: one driver was seen to lose what the CPU writes into a buffer that a dispatch has
// just written.
static hair_result upload(const struct cursor* c)
{
    GLuint      source = 0;
    hair_result result = hair_gl_buffer(c->gl, "hair loaded", c->end, c->own, &source);
    if (result) return result;
    for (uint32_t i = 0; i < c->buffers; ++i)
        c->gl->CopyNamedBufferSubData(source, c->buffer[i].buffer, (GLintptr)c->buffer[i].at, 0,
                                      (GLsizeiptr)c->buffer[i].size);
    hair_gl_free_buffer(c->gl, &source);
    return HAIR_OK;
}

hair_result hair_sim_load(struct hair_sim* sim, const unsigned char* bytes, size_t size)
{
    const hair_host* host   = &sim->gl->host;
    hair_result      result = check_frame(host, bytes, size);
    if (!result) result = hair_sim_need_crowd(sim); // Its accelerations may be among what is loaded,
    if (!result) result = hair_blow_need(sim);      // and its air.
    int skinned = !result && size >= HEADER + 4 + TRAILER && hair_read_u32(bytes + HEADER) == 1;
    if (skinned && !sim->skin.seats)
        result = hair_fail(
            host, HAIR_ERROR_ARGUMENT,
            "the saved state is another's: its scalp is skinned, and the instance's groom has none");
    if (!result && skinned) result = hair_skin_make(sim);
    if (result) return result;
    struct hair_sim loaded = *sim;
    struct cursor   c  = {.host = host, .gl = sim->gl, .read = bytes, .at = HEADER, .end = size - TRAILER};
    loaded.sleep.fence = NULL;
    c.own              = hair_alloc(host, 1, c.end);
    if (!c.own) return hair_fail_memory(host, "the state to load");
    struct hair_solids solids = {0};
    GLuint             still  = 0;
    result                    = read(&c, &loaded, &solids);
    if (!result && !skinned && hair_skin_is_on(sim)) result = hair_skin_make_still(sim, &still);
    if (!result) result = upload(&c);
    if (!result && still) hair_skin_forget(&loaded, still);
    hair_gl_free_buffer(sim->gl, &still);
    hair_free(host, c.own);
    hair_free(host, c.now.solid);
    hair_free(host, c.before.solid);
    if (result) {
        hair_free(host, c.ties.knot);
        hair_solids_free(host, &solids);
        if (!sim->sleep.anchor) hair_sleep_free(&loaded);
        return result;
    }
    hair_solids_free(host, &sim->solids);
    hair_sleep_load(&loaded, &sim->sleep);
    *sim        = loaded;
    sim->solids = solids;
    hair_ties_take(sim, c.ties.knot, c.ties.count);
    sim->next_substep = 0;
    if (!sim->crowd.push) sim->crowd.beat = 0;
    if (sim->blow.fluid.gl) hair_fluid_show(&sim->blow.fluid);
    hair_sim_show(sim);
    return HAIR_OK;
}
