/// hair_targets.h - target poses: guides that follow an animation, blended with their simulation.
///
/// Targets are positions of all guide vertices, from joints, a cache or a brush. Each vertex has a
/// weight. At 0 it is simulated. At 1 it is at its target, with the velocity of the target, and its
/// solver is not used. Between them, the drawn strand lies between the simulated strand and the
/// targets: each segment has a direction and a length between the two. The simulation does not
/// feel targets of such weights.
///
/// Weights change evenly over hair_target_blend.blend_time, so that hair moves from simulation to
/// targets and back without a jump. Vertices leave their targets with the velocity that they have
/// there. Targets ignore colliders and lengths. A vertex with a weight below 1 beyond a vertex at
/// its target hangs from that vertex.
#ifndef HAIR_HAIR_TARGETS_H
#define HAIR_HAIR_TARGETS_H

#include <hair/hair_look.h>

/// Weights of targets.
typedef struct hair_target_blend {
    hair_struct_header header;
    /// Weight of all targets. 0 is simulation, and 1 is the targets.
    float weight; ///< [0, 1]. Default 1.
    /// Factor of the weight along each guide.
    hair_curve along; ///< [0, 1]. Default 1.
    /// Factor of the weight of each guide, in the order of HAIR_READ_GUIDES. They are copied. NULL
    /// selects 1.
    const float* guide_weights; ///< [0, 1]. Default NULL.
    /// Number of guide weights, that of the guides. 0 if there are none.
    uint32_t guide_count; ///< [0, 262144]. Default 0.
    /// Time in which a weight changes from 0 to 1. 0 changes weights in the next substep, and moves
    /// vertices to their targets evenly over the next step.
    float blend_time; ///< s. [0, 10]. Default 0.25.
} hair_target_blend;
HAIR_DESC(hair_target_blend)

/// Set the targets at the end of the next step.
///
/// Targets move evenly over the next step. Targets that are not set again move with the head. The
/// first call starts with the weight 0. A hair_reset() after the call puts the hair at its targets
/// at once. The field, the hair-hair grid and hair_get_bounds() follow the head only, so keep the
/// targets near the head. The call takes effect with the next hair_step(), and also wakes sleeping
/// hair if the targets are new.
///
/// HAIR_READ_SMOOTH and HAIR_READ_FOLLOWERS read the drawn hair at the time of the last step.
/// HAIR_READ_GUIDES reads the simulation, which is at the targets where the weight is 1.
///
/// @param positions xyz per guide vertex, as floats, in the order of HAIR_READ_GUIDES. [-1e9, 1e9].
///     They are copied. NULL ends the targets. Weights then return to 0, and memory is freed.
/// @param count Number of guide vertices, hair_groom_info.guide_vertex_count. 0 if `positions` is
///     NULL. hair_groom_get_guides() tells the number of each guide.
/// @param stride Distance from one vertex to the next in bytes, a multiple of 4 in [12, 4096].
///     Ignored if `positions` is NULL.
/// @param to_world Rigid transform from the space of `positions` to the world. NULL if the
///     positions are in the world.
/// Errors: HAIR_ERROR_ARGUMENT, HAIR_ERROR_MEMORY, HAIR_ERROR_OPENGL.
/// OpenGL: required. Does not wait for the GPU.
HAIR_API hair_result hair_set_targets(hair_instance* hair, const float* positions, uint32_t count,
                                      size_t stride, const float to_world[16]);

/// Set the targets from an OpenGL buffer, in every other respect like hair_set_targets(). The GPU
/// copies the positions during this call. It sees everything that shaders have written before. The
/// weight of a vertex is 0 if its target is not finite, or farther than 10 km from the head.
///
/// @param gl_buffer Buffer object, not mapped unless persistently.
/// @param offset Offset of the first position in bytes, a multiple of 4.
/// @param stride As for hair_set_targets().
/// @param to_world As for hair_set_targets().
/// Errors: HAIR_ERROR_ARGUMENT, also if the buffer is too small, HAIR_ERROR_MEMORY,
///     HAIR_ERROR_OPENGL.
/// OpenGL: required. Does not wait for the GPU.
HAIR_API hair_result hair_set_targets_buffer(hair_instance* hair, uint32_t gl_buffer, size_t offset,
                                             size_t stride, const float to_world[16]);

/// Set the weights of targets, from the next step on. Weights may be set before targets. Without
/// targets they have no effect.
///
/// @param blend Weights, copied.
/// Errors: HAIR_ERROR_ARGUMENT, HAIR_ERROR_MEMORY, HAIR_ERROR_VERSION.
/// OpenGL: required if there are targets. Does not wait for the GPU.
HAIR_API hair_result hair_set_target_blend(hair_instance* hair, const hair_target_blend* blend);

#endif
