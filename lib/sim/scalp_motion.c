// scalp_motion.c - the buffers of a skinned scalp, and the passes that compute the scalp motion.
#include "lib/sim/scalp_motion.h"
#include "lib/sim/sim.h"

#include <string.h>

static void free_buffers(struct hair_sim* sim)
{
    struct hair_scalp_motion* motion = &sim->scalp_motion;
    hair_gl_free_array(sim->gl, &motion->root_transform, &motion->texture);
    hair_gl_free_buffer(sim->gl, &motion->root_binding);
    hair_gl_free_buffer(sim->gl, &motion->rest);
    hair_gl_free_buffer(sim->gl, &motion->scalp[0]);
    hair_gl_free_buffer(sim->gl, &motion->scalp[1]);
    hair_gl_free_buffer(sim->gl, &motion->upload);
    hair_gl_free_buffer(sim->gl, &motion->params);
}

void hair_scalp_motion_undo_create(struct hair_sim* sim)
{
    free_buffers(sim);
    HAIR_ASSERT(!hair_scalp_motion_is_on(sim));
}

void hair_scalp_motion_free(struct hair_sim* sim)
{
    free_buffers(sim);
    hair_scalp_skin_adopt(sim->gl, &sim->scalp_motion.skin, NULL, 0);
    hair_root_bindings_release(sim->scalp_motion.root_bindings);
    sim->scalp_motion.root_bindings = NULL;
}

static size_t scalp_size(const struct hair_scalp_motion* motion)
{
    HAIR_ASSERT(motion->root_bindings && motion->root_bindings->vertex_count > 0);
    return 3 * (size_t)motion->root_bindings->vertex_count * sizeof(float);
}

static struct hair_root_transform* make_root_transforms(const struct hair_sim* sim)
{
    struct hair_root_transform* root_transforms =
        hair_alloc(&sim->gl->host, sim->guides, sizeof *root_transforms);
    for (uint32_t i = 0; root_transforms && i < sim->guides; ++i)
        for (int k = 0; k < HAIR_ROOT_TRANSFORMS; ++k) root_transforms[i].turn[k].w = 1;
    return root_transforms;
}

static hair_result make_scalp_buffers(struct hair_sim* sim, GLuint* root_transform)
{
    struct hair_gl* gl = sim->gl;
    struct hair_scalp_motion* motion = &sim->scalp_motion;
    struct hair_root_transform* root_transforms = make_root_transforms(sim);
    size_t size = scalp_size(motion);
    if (!root_transforms) return hair_fail_memory(&gl->host, "the skinned scalp");
    hair_result result =
        hair_gl_storage(gl, HAIR_GL_CATEGORY_ROOT_TRANSFORMS, "hair root transforms",
                        sim->guides * sizeof *root_transforms, root_transforms, root_transform);
    hair_free(&gl->host, root_transforms);
    HAIR_TRY(result);
    HAIR_TRY(hair_gl_storage(gl, HAIR_GL_CATEGORY_ROOT_TRANSFORMS, "hair root bindings",
                             motion->root_bindings->count * sizeof *motion->root_bindings->binding,
                             motion->root_bindings->binding, &motion->root_binding));
    HAIR_TRY(hair_gl_storage(gl, HAIR_GL_CATEGORY_UNPACK_POSITIONS, "hair scalp at rest", size,
                             motion->root_bindings->positions, &motion->rest));
    for (int i = 0; i < 2; ++i)
        HAIR_TRY(hair_gl_storage(gl, HAIR_GL_CATEGORY_UNPACK_POSITIONS, "hair scalp", size,
                                 motion->root_bindings->positions, &motion->scalp[i]));
    HAIR_TRY(
        hair_gl_uniform(gl, HAIR_GL_CATEGORY_UNPACK_POSITIONS, "hair scalp upload", size, &motion->upload));
    HAIR_TRY(hair_gl_uniform(gl, HAIR_GL_CATEGORY_UNPACK_POSITIONS, "hair scalp params",
                             sizeof(struct hair_scalp_params), &motion->params));
    return hair_gl_buffer_texture(gl, "hair root transforms", GL_RGBA32F, *root_transform, &motion->texture);
}

// Write scalp[which]. The GPU copies the positions from another buffer, because writes of the CPU
// overtake dispatches that still read a storage buffer. NVIDIA's driver was observed to let them.
static void write_scalp(struct hair_sim* sim, int which, const float* positions)
{
    struct hair_scalp_motion* motion = &sim->scalp_motion;
    size_t size = scalp_size(motion);
    hair_gl_write_uniform(sim->gl, motion->upload, size, positions);
    hair_gl_copy_buffer(sim->gl, motion->upload, motion->scalp[which], 0, 0, (GLsizeiptr)size);
}

static void rest_scalp(struct hair_sim* sim)
{
    struct hair_scalp_motion* motion = &sim->scalp_motion;
    motion->rotation = (hair_vec4){0, 0, 0, 1};
    motion->offset = (hair_vec4){0, 0, 0, 0};
    motion->changed = 0;
    write_scalp(sim, 0, motion->root_bindings->positions);
}

uint32_t hair_scalp_motion_vertex_count(const struct hair_sim* sim)
{
    const struct hair_root_bindings* root_bindings = sim->scalp_motion.root_bindings;
    return root_bindings ? root_bindings->vertex_count : 0;
}

hair_result hair_scalp_motion_create(struct hair_sim* sim)
{
    struct hair_gl* gl = sim->gl;
    GLuint root_transform = 0;
    if (hair_scalp_motion_is_on(sim)) return HAIR_OK;
    HAIR_TRY(hair_gl_ensure_programs(gl, HAIR_GL_UNPACK_POSITIONS, HAIR_GL_BIND_FOLLOWERS, 0));
    HAIR_TRY(hair_gl_ensure_program(gl, hair_sim_reset_pass(sim, 1)));
    HAIR_TRY(hair_gl_ensure_program(gl, hair_sim_smooth_pass(sim, true, hair_targets_are_on(sim))));
    hair_result result = make_scalp_buffers(sim, &root_transform);
    if (result) {
        hair_gl_free_buffer(gl, &root_transform);
        free_buffers(sim);
        return result;
    }
    sim->scalp_motion.root_transform = root_transform;
    rest_scalp(sim);
    return HAIR_OK;
}

hair_result hair_scalp_motion_make_rest(struct hair_sim* sim, GLuint* out)
{
    struct hair_root_transform* root_transforms = make_root_transforms(sim);
    if (!root_transforms) return hair_fail_memory(&sim->gl->host, "the skinned scalp");
    hair_result result = hair_gl_buffer(sim->gl, HAIR_GL_CATEGORY_ROOT_TRANSFORMS, "hair root transforms",
                                        sim->guides * sizeof *root_transforms, root_transforms, out);
    hair_free(&sim->gl->host, root_transforms);
    return result;
}

void hair_scalp_motion_restore_rest(struct hair_sim* sim, GLuint still)
{
    GLsizeiptr size = (GLsizeiptr)(sim->guides * sizeof(struct hair_root_transform));
    hair_gl_copy_buffer(sim->gl, still, sim->scalp_motion.root_transform, 0, 0, size);
    rest_scalp(sim);
}

void hair_scalp_motion_set(struct hair_sim* sim, const float* positions, const struct hair_pose* space)
{
    struct hair_scalp_motion* motion = &sim->scalp_motion;
    HAIR_ASSERT(hair_scalp_motion_is_on(sim) && positions);
    write_scalp(sim, 1, positions);
    motion->space = *space;
    motion->changed = 1;
}

static void bind_scalp(struct hair_sim* sim, GLuint scalp, struct hair_scalp_params params)
{
    struct hair_gl* gl = sim->gl;
    struct hair_scalp_motion* motion = &sim->scalp_motion;
    HAIR_ASSERT(hair_scalp_motion_is_on(sim) && scalp);
    GLuint storage[] = {motion->root_transform, scalp, motion->rest, motion->root_binding};
    params.rotation = motion->rotation;
    params.offset = motion->offset;
    params.vertices = motion->root_bindings->vertex_count;
    params.guides = sim->guides;
    params.smooth_vertices = sim->smooth_vertices;
    hair_gl_write_uniform(gl, motion->params, sizeof params, &params);
    hair_gl_bind_buffers(gl, GL_SHADER_STORAGE_BUFFER, HAIR_BIND_ROOT_TRANSFORM, 4, storage);
    hair_gl_bind_buffers(gl, GL_UNIFORM_BUFFER, HAIR_BIND_SCALP_PARAMS, 1, &motion->params);
}

void hair_unpack_positions(struct hair_gl* gl, GLuint buffer, size_t offset, size_t size, uint32_t vertices)
{
    GLintptr at = (GLintptr)offset;
    GLsizeiptr whole = (GLsizeiptr)size;
    hair_gl_bind_ranges(gl, GL_SHADER_STORAGE_BUFFER, HAIR_BIND_GIVEN, 1, &buffer, &at, &whole);
    // Shaders of the application may have written the buffer.
    hair_gl_barrier(gl, GL_SHADER_STORAGE_BARRIER_BIT);
    hair_gl_run(gl, HAIR_GL_UNPACK_POSITIONS, (vertices + HAIR_GROUP_SIZE - 1) / HAIR_GROUP_SIZE);
    hair_gl_bind_buffers(gl, GL_SHADER_STORAGE_BUFFER, HAIR_BIND_GIVEN, 1, NULL);
}

void hair_scalp_motion_set_buffer(struct hair_sim* sim, GLuint buffer, size_t offset, size_t size,
                                  uint32_t first, uint32_t stride, const struct hair_pose* space)
{
    struct hair_scalp_motion* motion = &sim->scalp_motion;
    HAIR_ASSERT(stride >= 3);
    HAIR_ASSERT((first + (size_t)stride * (motion->root_bindings->vertex_count - 1) + 3) * sizeof(float) <=
                size);
    bind_scalp(sim, motion->scalp[1], (struct hair_scalp_params){.first = first, .stride = stride});
    hair_unpack_positions(sim->gl, buffer, offset, size, motion->root_bindings->vertex_count);
    motion->space = *space;
    motion->changed = 1;
}

void hair_scalp_motion_set_joints(struct hair_sim* sim, const struct hair_joint* joints,
                                  const struct hair_pose* space)
{
    struct hair_scalp_motion* motion = &sim->scalp_motion;
    HAIR_ASSERT(hair_scalp_motion_is_on(sim) && joints);
    bind_scalp(sim, motion->scalp[1], (struct hair_scalp_params){0});
    hair_scalp_skin_run(sim->gl, &motion->skin, joints, motion->root_bindings->vertex_count);
    motion->space = *space;
    motion->changed = 1;
}

// Make the new scalp the current one.
static void take_changed(struct hair_sim* sim)
{
    struct hair_scalp_motion* motion = &sim->scalp_motion;
    HAIR_ASSERT(motion->changed && motion->scalp[0] != motion->scalp[1]);
    GLuint given = motion->scalp[1];
    motion->scalp[1] = motion->scalp[0];
    motion->scalp[0] = given;
    hair_pose_relative(&motion->space, &sim->head, &motion->rotation, &motion->offset);
}

static void run_scalp_pass(struct hair_sim* sim, struct hair_scalp_params params)
{
    struct hair_scalp_motion* motion = &sim->scalp_motion;
    if (motion->changed) {
        take_changed(sim);
        params.flags |= HAIR_SCALP_CHANGED;
    }
    motion->changed = 0;
    hair_sim_bind(sim);
    bind_scalp(sim, motion->scalp[0], params);
    hair_gl_run(sim->gl, HAIR_GL_ROOT_TRANSFORMS, (sim->guides + HAIR_GROUP_SIZE - 1) / HAIR_GROUP_SIZE);
}

void hair_scalp_motion_run(struct hair_sim* sim, int again, uint32_t substeps, float before, float after)
{
    HAIR_ASSERT(0 <= before && before <= after && after <= 1);
    run_scalp_pass(sim, (struct hair_scalp_params){.flags = again ? HAIR_SCALP_AGAIN : 0,
                                                   .substeps = substeps,
                                                   .fraction_before = before,
                                                   .fraction_after = after});
}

void hair_scalp_motion_reset(struct hair_sim* sim)
{
    run_scalp_pass(sim, (struct hair_scalp_params){.flags = HAIR_SCALP_RESET});
}

void hair_scalp_motion_bind_all(struct hair_sim* sim, uint32_t followers)
{
    bind_scalp(sim, sim->scalp_motion.scalp[0], (struct hair_scalp_params){.followers = followers});
}
