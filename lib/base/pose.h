// pose.h - where a rigid body is: doubles for the place, so that far from the origin differences keep their digits.
#ifndef HAIR_BASE_POSE_H
#define HAIR_BASE_POSE_H

#include "lib/base/math.h"

struct hair_pose {
    double position[3];
    hair_quat rotation;
};

// Of a column-major matrix. 0 when it is not rigid to 1e-3, or not finite.
int hair_pose_from_matrix(const float matrix[16], struct hair_pose* out);

// From a (t = 0) to b (t = 1): evenly along the straight line, shortest way round.
struct hair_pose hair_pose_between(const struct hair_pose* a, const struct hair_pose* b, double t);

// a.position - b.position.
hair_vec3 hair_pose_offset(const struct hair_pose* a, const struct hair_pose* b);

#endif
