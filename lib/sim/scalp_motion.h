// scalp_motion.h - a scalp that the application skins, and the motion of roots with the scalp. The
// application sets the scalp before a step.
//
// Positions and rotations of roots are kept relative to the head. Whatever moves the head thus
// moves the roots too.
#ifndef HAIR_SIM_SCALP_MOTION_H
#define HAIR_SIM_SCALP_MOTION_H

#include "lib/base/pose.h"
#include "lib/gl/commands.h"
#include "lib/groom/scalp_binding.h"
#include "lib/sim/scalp_skin.h"

// All members but `root_bindings` and `skin` are 0 until the application first sets a scalp.
struct hair_scalp_motion {
    // Root bindings, of which a reference is held. NULL without a scalp.
    struct hair_root_bindings* root_bindings;
    // Buffers, as in shared.h. scalp[0] is the scalp of the last step, and scalp[1] that of the
    // next.
    GLuint root_transform, root_binding, rest, scalp[2], params;
    GLuint upload; // Buffer from which the GPU copies positions that the application passes.
    GLuint texture; // Texture of `root_transform`.
    struct hair_pose space; // Pose in the world of the space of scalp[1].
    int changed; // 1 if a scalp has been set since the last step.
    hair_vec4 rotation, offset; // Transform of scalp[0] to the head's frame, as in shared.h.
    struct hair_scalp_skin skin; // Joints, if the library skins the scalp.
};

struct hair_sim;

void hair_scalp_motion_free(struct hair_sim* sim);

// Create buffers and programs, once. The scalp counts as at rest so far. `root_bindings` is not
// NULL.
hair_result hair_scalp_motion_create(struct hair_sim* sim);
// Undo hair_scalp_motion_create(). No pass may have read the buffers.
void hair_scalp_motion_undo_create(struct hair_sim* sim);

// Return the number of vertices of the groom's scalp, or 0 if the groom has none.
uint32_t hair_scalp_motion_vertex_count(const struct hair_sim* sim);

// Set the scalp of the next step, xyz per vertex. hair_scalp_motion_create() has succeeded.
void hair_scalp_motion_set(struct hair_sim* sim, const float* positions, const struct hair_pose* space);
// Set the scalp of the next step from `size` bytes of a buffer, from the byte `offset` on. The
// first vertex is at the float `first` of that range, and the vertices are `stride` floats apart.
// hair_scalp_motion_create() has succeeded.
void hair_scalp_motion_set_buffer(struct hair_sim* sim, GLuint buffer, size_t offset, size_t size,
                                  uint32_t first, uint32_t stride, const struct hair_pose* space);
// Set the scalp of the next step by joints. hair_scalp_motion_create() and hair_scalp_skin_create()
// have succeeded.
void hair_scalp_motion_set_joints(struct hair_sim* sim, const struct hair_joint* joints,
                                  const struct hair_pose* space);

// Copy `vertices` positions out of `size` bytes of the application's buffer, from the byte `offset`
// on. The parameters of the copy and the buffer that receives the positions are bound.
void hair_unpack_positions(struct hair_gl* gl, GLuint buffer, size_t offset, size_t size, uint32_t vertices);

// Move the roots with the scalp in a step of `substeps` substeps. The last substep goes from the
// fraction `before` of the step to the fraction `after`. `again` continues the step of the last
// call. The head is already where it is at the end of the step.
void hair_scalp_motion_run(struct hair_sim* sim, int again, uint32_t substeps, float before, float after);
// Move the roots to the scalp at once, without a past.
void hair_scalp_motion_reset(struct hair_sim* sim);

// Create the scalp motion of a scalp that was always at rest, in a buffer that the caller frees.
hair_result hair_scalp_motion_make_rest(struct hair_sim* sim, GLuint* out);
// Replace the scalp motion by a result of hair_scalp_motion_make_rest(), and put the scalp at rest.
void hair_scalp_motion_restore_rest(struct hair_sim* sim, GLuint still);

// Bind all buffers for the passes that write followers.
void hair_scalp_motion_bind_all(struct hair_sim* sim, uint32_t followers);

#endif
