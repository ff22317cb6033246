// targets.h - target poses of guides, and the pass that keeps guides at their targets.
#ifndef HAIR_SIM_TARGETS_H
#define HAIR_SIM_TARGETS_H

#include "lib/base/pose.h"
#include "lib/gl/commands.h"

#include <hair/hair_targets.h>

// All buffers are 0 while there are no targets.
struct hair_targets {
    GLuint target; // hair_vec4[], as in shared.h.
    GLuint position[2]; // xyz per guide vertex. [0] is of the last step, and [1] of the next.
    GLuint weight; // float[] per guide: the weights to come.
    GLuint upload; // Buffer from which the GPU copies positions that the application passes.
    GLuint params, unpack_params;
    struct hair_pose space; // Pose in the world of the space of position[1].
    uint64_t hash; // Hash of position[1] and its space. 0 if the positions came from a buffer.
    hair_vec4 rotation, offset; // Transform of position[0] to the head's frame, as in shared.h.
    int changed; // 1 if targets have been set since the last step.
    int ends; // 1 if the weights return to 0, after which the targets end.
    int disturbs; // 1 if the targets set since the last step are new.
    double blend_left; // Time until all weights have their values, s.
    hair_target_blend blend; // Without pointer.
    float* guide_weights; // Factor of the weight per guide. NULL selects 1.
};

struct hair_sim;

void hair_targets_init(struct hair_targets* targets);
void hair_targets_free(struct hair_sim* sim);
// Free the buffers. There are no targets afterwards.
void hair_targets_end(struct hair_sim* sim);

// Create buffers and programs, once. All weights are 0.
hair_result hair_targets_create(struct hair_sim* sim);

// Set the targets at the end of the next step, xyz per vertex. hair_targets_create() has succeeded.
void hair_targets_set(struct hair_sim* sim, const float* positions, const struct hair_pose* space);
// Set the targets from `size` bytes of a buffer, as hair_scalp_motion_set_buffer() does.
void hair_targets_set_buffer(struct hair_sim* sim, GLuint buffer, size_t offset, size_t size, uint32_t first,
                             uint32_t stride, const struct hair_pose* space);
// Let the weights return to 0, and then end the targets.
void hair_targets_fade(struct hair_sim* sim);

// Set the weights to a checked blend. `weights` has a factor per guide, or is NULL. On failure
// nothing has changed.
hair_result hair_targets_set_blend(struct hair_sim* sim, const hair_target_blend* blend,
                                   const float* weights);

// Compile the pass for the current solver.
hair_result hair_targets_ensure(struct hair_sim* sim);
// Begin a step: use the targets that have been set, and write the parameters.
void hair_targets_begin_step(struct hair_sim* sim);
// Move targets and guides by the substep that the solver has done. The step buffer holds it alone.
void hair_targets_run(struct hair_sim* sim);
// Count `time` of substeps.
void hair_targets_pass_time(struct hair_sim* sim, double time);
// End targets whose weights have returned to 0.
void hair_targets_end_step(struct hair_sim* sim);
// Put the guides, which are at rest, at their targets, without a past. The step buffer has the pose
// of the head.
void hair_targets_reset(struct hair_sim* sim);

#endif
