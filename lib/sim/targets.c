// targets.c - the buffers of target poses, and the pass that keeps guides at them.
#include "lib/sim/targets.h"
#include "lib/sim/sim.h"
#include "lib/base/bytes.h"
#include "lib/base/curve.h"

#include <string.h>

void hair_targets_init(struct hair_targets* targets)
{
    targets->blend = hair_target_blend_default();
}

void hair_targets_end(struct hair_sim* sim)
{
    struct hair_targets* targets = &sim->targets;
    hair_gl_free_buffer(sim->gl, &targets->target);
    for (int i = 0; i < 2; ++i) hair_gl_free_buffer(sim->gl, &targets->position[i]);
    hair_gl_free_buffer(sim->gl, &targets->weight);
    hair_gl_free_buffer(sim->gl, &targets->upload);
    hair_gl_free_buffer(sim->gl, &targets->params);
    hair_gl_free_buffer(sim->gl, &targets->unpack_params);
    targets->changed = targets->ends = targets->disturbs = 0;
    targets->hash = 0;
    targets->blend_left = 0;
}

void hair_targets_free(struct hair_sim* sim)
{
    hair_targets_end(sim);
    hair_free(&sim->gl->host, sim->targets.guide_weights);
    sim->targets.guide_weights = NULL;
}

static size_t positions_size(const struct hair_sim* sim)
{
    return 3 * (size_t)sim->guide_vertices * sizeof(float);
}

// Weights -----------------------------------------------------------------------------------------

// Write the weights to come. `factors` has one per guide, or is NULL. The GPU copies them in order
// with dispatches.
static hair_result write_weights(struct hair_sim* sim, float weight, const float* factors)
{
    struct hair_gl* gl = sim->gl;
    GLuint source = 0;
    size_t size = sim->guides * sizeof(float);
    float* weights = hair_alloc(&gl->host, sim->guides, sizeof *weights);
    if (!weights) return hair_fail_memory(&gl->host, "the weights of targets");
    for (uint32_t g = 0; g < sim->guides; ++g) weights[g] = weight * (factors ? factors[g] : 1);
    hair_result result =
        hair_gl_buffer(gl, HAIR_GL_CATEGORY_TARGETS, "hair target weights", size, weights, &source);
    hair_free(&gl->host, weights);
    HAIR_TRY(result);
    hair_gl_copy_buffer(gl, source, sim->targets.weight, 0, 0, (GLsizeiptr)size);
    hair_gl_free_buffer(gl, &source);
    return HAIR_OK;
}

// Record that weights change, which takes the blend time and a substep of rounding.
static void begin_blend(struct hair_sim* sim)
{
    sim->targets.blend_left = (double)sim->targets.blend.blend_time + 2 * sim->substep;
}

hair_result hair_targets_set_blend(struct hair_sim* sim, const hair_target_blend* blend, const float* factors)
{
    const hair_host* host = &sim->gl->host;
    struct hair_targets* targets = &sim->targets;
    float* own = NULL;
    hair_result result = HAIR_OK;
    if (factors) {
        own = hair_alloc(host, sim->guides, sizeof *own);
        if (!own) return hair_fail_memory(host, "the weights of targets");
        memcpy(own, factors, sim->guides * sizeof *own);
    }
    if (hair_targets_are_on(sim)) result = write_weights(sim, blend->weight, own);
    if (result) {
        hair_free(host, own);
        return result;
    }
    hair_free(host, targets->guide_weights);
    targets->guide_weights = own;
    targets->blend = *blend;
    targets->blend.guide_weights = NULL;
    if (hair_targets_are_on(sim)) begin_blend(sim);
    return HAIR_OK;
}

// Buffers -----------------------------------------------------------------------------------------

static hair_result make_buffers(struct hair_sim* sim)
{
    struct hair_gl* gl = sim->gl;
    struct hair_targets* targets = &sim->targets;
    const hair_gl_category category = HAIR_GL_CATEGORY_TARGETS;
    size_t size = positions_size(sim);
    for (int i = 0; i < 2; ++i)
        HAIR_TRY(hair_gl_storage(gl, category, "hair target positions", size, NULL, &targets->position[i]));
    HAIR_TRY(hair_gl_storage(gl, category, "hair target weights", sim->guides * sizeof(float), NULL,
                             &targets->weight));
    HAIR_TRY(write_weights(sim, targets->blend.weight, targets->guide_weights));
    HAIR_TRY(hair_gl_uniform(gl, category, "hair target upload", size, &targets->upload));
    HAIR_TRY(hair_gl_uniform(gl, category, "hair target params", sizeof(struct hair_target_params),
                             &targets->params));
    HAIR_TRY(hair_gl_uniform(gl, category, "hair target positions", sizeof(struct hair_scalp_params),
                             &targets->unpack_params));
    // The buffer whose name means that there are targets comes last.
    return hair_gl_storage(gl, category, "hair targets", sim->guide_vertices * sizeof(hair_vec4), NULL,
                           &targets->target);
}

static hair_gl_pass blend_pass(const struct hair_sim* sim)
{
    hair_gl_pass pass = HAIR_GL_BLEND_TARGETS;
    if (sim->rods) pass |= HAIR_GL_WITH(ROD);
    return hair_sim_is_mixed(sim) ? pass | HAIR_GL_WITH(MIXED) : pass;
}

hair_result hair_targets_ensure(struct hair_sim* sim)
{
    return hair_targets_are_on(sim) ? hair_gl_ensure_program(sim->gl, blend_pass(sim)) : HAIR_OK;
}

hair_result hair_targets_create(struct hair_sim* sim)
{
    struct hair_gl* gl = sim->gl;
    if (hair_targets_are_on(sim)) return HAIR_OK;
    HAIR_TRY(hair_gl_ensure_program(gl, HAIR_GL_UNPACK_POSITIONS));
    HAIR_TRY(hair_gl_ensure_program(gl, blend_pass(sim)));
    HAIR_TRY(hair_gl_ensure_program(gl, hair_sim_smooth_pass(sim, hair_scalp_motion_is_on(sim), true)));
    hair_result result = make_buffers(sim);
    if (result) {
        hair_targets_end(sim);
        return result;
    }
    begin_blend(sim);
    return HAIR_OK;
}

// Targets -----------------------------------------------------------------------------------------

// Let the weights rise again if they were returning to 0.
static void stop_fading(struct hair_sim* sim)
{
    if (!sim->targets.ends) return;
    sim->targets.ends = 0;
    begin_blend(sim);
}

static void set_space(struct hair_sim* sim, const struct hair_pose* space, uint64_t hash)
{
    struct hair_targets* targets = &sim->targets;
    targets->disturbs |= !hash || hash != targets->hash;
    targets->hash = hash;
    targets->space = *space;
    targets->changed = 1;
}

void hair_targets_set(struct hair_sim* sim, const float* positions, const struct hair_pose* space)
{
    struct hair_targets* targets = &sim->targets;
    size_t size = positions_size(sim);
    HAIR_ASSERT(hair_targets_are_on(sim) && positions);
    uint64_t hash = hair_hash_bytes(HAIR_HASH_BEGIN, positions, size);
    stop_fading(sim);
    hair_gl_write_uniform(sim->gl, targets->upload, size, positions);
    hair_gl_copy_buffer(sim->gl, targets->upload, targets->position[1], 0, 0, (GLsizeiptr)size);
    set_space(sim, space, hair_hash_bytes(hash, space, sizeof *space) | 1);
}

void hair_targets_set_buffer(struct hair_sim* sim, GLuint buffer, size_t offset, size_t size, uint32_t first,
                             uint32_t stride, const struct hair_pose* space)
{
    struct hair_gl* gl = sim->gl;
    struct hair_targets* targets = &sim->targets;
    HAIR_ASSERT(hair_targets_are_on(sim) && stride >= 3);
    struct hair_scalp_params params = {.first = first, .stride = stride, .vertices = sim->guide_vertices};
    stop_fading(sim);
    hair_gl_write_uniform(gl, targets->unpack_params, sizeof params, &params);
    hair_gl_bind_buffers(gl, GL_UNIFORM_BUFFER, HAIR_BIND_SCALP_PARAMS, 1, &targets->unpack_params);
    hair_gl_bind_buffers(gl, GL_SHADER_STORAGE_BUFFER, HAIR_BIND_SCALP, 1, &targets->position[1]);
    hair_unpack_positions(gl, buffer, offset, size, sim->guide_vertices);
    set_space(sim, space, 0);
}

void hair_targets_fade(struct hair_sim* sim)
{
    struct hair_targets* targets = &sim->targets;
    if (!hair_targets_are_on(sim) || targets->ends) return;
    targets->ends = 1;
    begin_blend(sim);
}

// Steps -------------------------------------------------------------------------------------------

static void write_targets(struct hair_sim* sim, hair_uint flags)
{
    struct hair_targets* targets = &sim->targets;
    double time = (double)targets->blend.blend_time;
    struct hair_target_params params = {.rotation = targets->rotation,
                                        .offset = targets->offset,
                                        .max_change = time > sim->substep ? (float)(sim->substep / time) : 1,
                                        .strength = targets->ends ? 0 : 1,
                                        .flags = flags};
    hair_curve_to_cubics(&targets->blend.along, params.along);
    hair_gl_write_uniform(sim->gl, targets->params, sizeof params, &params);
}

void hair_targets_begin_step(struct hair_sim* sim)
{
    struct hair_targets* targets = &sim->targets;
    if (targets->changed) {
        GLuint given = targets->position[1];
        targets->position[1] = targets->position[0];
        targets->position[0] = given;
        hair_pose_relative(&targets->space, &sim->head, &targets->rotation, &targets->offset);
        targets->changed = targets->disturbs = 0;
    }
    write_targets(sim, 0);
}

void hair_targets_run(struct hair_sim* sim)
{
    struct hair_gl* gl = sim->gl;
    struct hair_targets* targets = &sim->targets;
    hair_sim_bind(sim);
    if (sim->rods) hair_sim_bind_rods(sim);
    hair_targets_bind(sim);
    hair_gl_bind_buffers(gl, GL_SHADER_STORAGE_BUFFER, HAIR_BIND_TARGET_WEIGHT, 1, &targets->weight);
    hair_gl_run(gl, blend_pass(sim), (sim->guides + HAIR_GROUP_SIZE - 1) / HAIR_GROUP_SIZE);
}

void hair_targets_pass_time(struct hair_sim* sim, double time)
{
    sim->targets.blend_left = fmax(sim->targets.blend_left - time, 0);
}

void hair_targets_end_step(struct hair_sim* sim)
{
    if (sim->targets.ends && sim->targets.blend_left <= 0) hair_targets_end(sim);
}

void hair_targets_reset(struct hair_sim* sim)
{
    hair_targets_begin_step(sim);
    write_targets(sim, HAIR_TARGETS_RESET);
    hair_targets_run(sim);
    sim->targets.blend_left = 0;
}
