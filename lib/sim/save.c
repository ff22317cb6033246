// save.c - the changing state of a simulation as bytes. Bytes to load may come from untrusted
// sources.
//
//   byte  0  "hairsave"
//         8  u32 version
//        12  u64 size of the whole state in bytes
//        20  the fields, in the order of hair_sim_serialize()
//   the end  u64 FNV-1a hash of all bytes before
//
// The hash detects damage. Every field is checked as well, because an attacker can compute the hash
// too.
#include "lib/sim/save_fields.h"

#include <string.h>

#include "lib/base/bytes.h"

#define HEADER HAIR_SAVE_HEADER
#define TRAILER HAIR_SAVE_TRAILER

size_t hair_sim_save_size(struct hair_sim* sim)
{
    struct hair_serializer s = {.host = &sim->gl->host, .gl = sim->gl, .at = HEADER};
    struct hair_loaded none = {0}; // Nothing is read.
    hair_sleep_resolve_query(sim);
    hair_sim_serialize(&s, sim, &none);
    HAIR_ASSERT(s.result == HAIR_OK);
    return s.at + TRAILER;
}

void hair_sim_save(struct hair_sim* sim, unsigned char* bytes)
{
    struct hair_serializer s = {.host = &sim->gl->host, .gl = sim->gl, .write = bytes, .at = HEADER};
    struct hair_loaded none = {0}; // Nothing is read.
    hair_sleep_resolve_query(sim);
    hair_sim_serialize(&s, sim, &none);
    HAIR_ASSERT(s.result == HAIR_OK);
    hair_save_seal(bytes, s.at);
}

// Upload the buffers by GPU copies, which run in order with dispatches. One driver was seen to lose
// CPU writes into a buffer that a dispatch had just written.
static hair_result upload_state(const struct hair_serializer* s)
{
    GLuint source = 0;
    HAIR_TRY(hair_gl_buffer(s->gl, HAIR_GL_NO_CATEGORY, "hair loaded", s->end, s->native, &source));
    for (uint32_t i = 0; i < s->buffers; ++i) HAIR_ASSERT(s->buffer[i].at + s->buffer[i].size <= s->end);
    for (uint32_t i = 0; i < s->buffers; ++i)
        hair_gl_copy_buffer(s->gl, source, s->buffer[i].buffer, (GLintptr)s->buffer[i].at, 0,
                            (GLsizeiptr)s->buffer[i].size);
    hair_gl_free_buffer(s->gl, &source);
    return HAIR_OK;
}

// Load a state whose frame has been checked, into a simulation that has all buffers of the state.
// `fluid` replaces the fluid of the wind, if its gl is not NULL.
static hair_result load_state(struct hair_sim* sim, const unsigned char* bytes, size_t size, bool skinned,
                              const struct hair_fluid* fluid)
{
    const hair_host* host = &sim->gl->host;
    struct hair_sim own = *sim; // Copy that receives the loaded state.
    hair_wind_coupling_replace(&own.wind_coupling, fluid);
    struct hair_loaded loaded = {0};
    struct hair_serializer s = {
        .host = host, .gl = sim->gl, .read = bytes, .at = HEADER, .end = size - TRAILER};
    own.sleep.fence = NULL;
    s.native = hair_alloc(host, 1, s.end);
    if (!s.native) return hair_fail_memory(host, "the state to load");
    struct hair_colliders colliders = {0};
    struct hair_new_lengths lengths = {0};
    GLuint still = 0;
    hair_result result = hair_save_read(&s, &own, &loaded, &colliders);
    if (!result && loaded.has_anchors) {
        result = hair_sleep_create(&own);
        s.buffer[loaded.anchors].buffer = own.sleep.anchor;
    }
    if (!result && !skinned && hair_scalp_motion_is_on(sim))
        result = hair_scalp_motion_make_rest(sim, &still);
    bool has_lengths = !result && (loaded.guide_fraction || sim->lengths.guides);
    if (has_lengths)
        result = hair_lengths_make(sim, loaded.guide_fraction, loaded.follower_fraction, &lengths);
    if (!result) result = upload_state(&s);
    if (!result && sim->bend && s.lacks_bend) hair_gl_clear_buffer(sim->gl, sim->bend);
    if (!result && still) hair_scalp_motion_restore_rest(&own, still);
    hair_gl_free_buffer(sim->gl, &still);
    hair_free(host, s.native);
    hair_free(host, loaded.now.collider);
    hair_free(host, loaded.before.collider);
    hair_free(host, loaded.guide_fraction);
    hair_free(host, loaded.follower_fraction);
    if (result) {
        hair_free(host, loaded.resolved_pin);
        hair_colliders_free(host, &colliders);
        if (!sim->sleep.anchor) hair_sleep_free(&own);
        hair_lengths_discard(sim, &lengths);
        return result;
    }
    hair_colliders_free(host, &sim->colliders);
    hair_sleep_load(&own, &sim->sleep);
    if (fluid->gl) hair_fluid_destroy(&sim->wind_coupling.fluid);
    *sim = own;
    sim->colliders = colliders;
    hair_pins_adopt(sim, loaded.resolved_pin, loaded.pins);
    if (has_lengths) hair_lengths_use(sim, &lengths, false);
    sim->next_substep = 0;
    hair_diagnosis_reset(sim);
    if (!sim->hair_grid.acceleration) sim->hair_grid.substeps_done = 0;
    if (sim->wind_coupling.fluid.gl) hair_fluid_publish(&sim->wind_coupling.fluid);
    hair_sim_upload_render_state(sim);
    return HAIR_OK;
}

hair_result hair_sim_load(struct hair_sim* sim, const unsigned char* bytes, size_t size)
{
    const hair_host* host = &sim->gl->host;
    HAIR_TRY(hair_save_check(host, bytes, size));
    // The state may contain accelerations of the hair-hair grid.
    HAIR_TRY(hair_sim_ensure_hair_grid(sim));
    uint32_t marks = size >= HEADER + 4 + TRAILER ? hair_read_u32(bytes + HEADER) : 0;
    bool skinned = marks & HAIR_SAVE_SKINNED, has_targets = marks & HAIR_SAVE_TARGETS;
    if (skinned && !sim->scalp_motion.root_bindings)
        return hair_fail(
            host, HAIR_ERROR_ARGUMENT,
            "the saved state is another's: its scalp is skinned, and the instance's groom has none");
    bool was_skinned = hair_scalp_motion_is_on(sim), had_targets = hair_targets_are_on(sim);
    if (skinned) HAIR_TRY(hair_scalp_motion_create(sim));
    hair_result result = has_targets ? hair_targets_create(sim) : HAIR_OK;
    struct hair_fluid fluid = {0}; // The state may contain the air of a fluid.
    if (!result) result = hair_wind_coupling_prepare(sim, &fluid);
    if (!result) result = load_state(sim, bytes, size, skinned, &fluid);
    if (result) hair_fluid_destroy(&fluid);
    if (result && skinned && !was_skinned) hair_scalp_motion_undo_create(sim);
    if (result ? has_targets && !had_targets : !has_targets) hair_targets_end(sim);
    return result;
}
