// pose.h - pose of a rigid body. Positions are doubles, so that differences keep their digits far
// from the origin.
#ifndef HAIR_BASE_POSE_H
#define HAIR_BASE_POSE_H

#include "glsl/shared.h"
#include "lib/base/math.h"

struct hair_pose {
    double position[3];
    hair_quat rotation;
};

// Convert a column-major matrix. Return 0 if it is not finite, or not rigid within 1e-3.
int hair_pose_from_matrix(const float matrix[16], struct hair_pose* out);

// Convert a pose to a column-major matrix.
void hair_pose_to_matrix(const struct hair_pose* pose, float out[16]);

// Interpolate from a (t = 0) to b (t = 1), with constant speed along the straight line and the
// shortest rotation.
struct hair_pose hair_pose_between(const struct hair_pose* a, const struct hair_pose* b, double t);

// Return a.position - b.position.
hair_vec3 hair_pose_offset(const struct hair_pose* a, const struct hair_pose* b);

// Find the transform from the space of a pose to the frame of the head. It maps a position p to
// rotation (p + offset). In this order, large coordinates cancel first.
void hair_pose_relative(const struct hair_pose* space, const struct hair_pose* head, hair_vec4* rotation,
                        hair_vec4* offset);

// Return a rotation as shaders read it.
static inline hair_vec4 hair_quat_to_vec4(hair_quat q)
{
    return (hair_vec4){q.x, q.y, q.z, q.w};
}

// Return the world matrix `m` for positions from the head's origin. Its last column gains m times
// that origin.
hair_mat4 hair_mat4_from_head(const float m[16], const struct hair_pose* head);

#endif
