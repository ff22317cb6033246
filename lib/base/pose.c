// pose.c - poses from and to matrices, and interpolation between poses.
#include "lib/base/pose.h"

#include <string.h>

int hair_pose_from_matrix(const float m[16], struct hair_pose* out)
{
    hair_vec3 x = hair_load3(m), y = hair_load3(m + 4), z = hair_load3(m + 8);
    float worst = fabsf(hair_dot(hair_cross(x, y), z) - 1); // NaN and infinity end up here too.
    float errors[] = {hair_dot(x, x) - 1,
                      hair_dot(y, y) - 1,
                      hair_dot(z, z) - 1,
                      hair_dot(x, y),
                      hair_dot(y, z),
                      hair_dot(z, x),
                      m[3],
                      m[7],
                      m[11],
                      m[15] - 1};
    if (!(worst <= 1e-3f)) return 0;
    for (int i = 0; i < (int)(sizeof errors / sizeof *errors); ++i)
        if (!(fabsf(errors[i]) <= 1e-3f)) return 0;
    for (int i = 0; i < 3; ++i) {
        if (!isfinite(m[12 + i])) return 0;
        out->position[i] = (double)m[12 + i];
    }
    out->rotation = hair_quat_from_axes(x, y, z);
    HAIR_ASSERT(hair_quat_is_unit(out->rotation));
    return 1;
}

void hair_pose_to_matrix(const struct hair_pose* pose, float out[16])
{
    for (int axis = 0; axis < 3; ++axis) {
        hair_vec3 v = hair_rotate(pose->rotation, hair_v3(axis == 0, axis == 1, axis == 2));
        out[4 * axis] = v.x;
        out[4 * axis + 1] = v.y;
        out[4 * axis + 2] = v.z;
        out[4 * axis + 3] = 0;
        out[12 + axis] = (float)pose->position[axis];
    }
    out[15] = 1;
}

struct hair_pose hair_pose_between(const struct hair_pose* a, const struct hair_pose* b, double t)
{
    struct hair_pose pose = {.rotation = hair_slerp(a->rotation, b->rotation, (float)t)};
    for (int i = 0; i < 3; ++i) pose.position[i] = a->position[i] + t * (b->position[i] - a->position[i]);
    return pose;
}

hair_vec3 hair_pose_offset(const struct hair_pose* a, const struct hair_pose* b)
{
    return hair_v3((float)(a->position[0] - b->position[0]), (float)(a->position[1] - b->position[1]),
                   (float)(a->position[2] - b->position[2]));
}

// With s and t the rotation and position of the space, and r and o those of the head, a position p
// is at conj(r) s (p + conj(s) (t - o)).
void hair_pose_relative(const struct hair_pose* space, const struct hair_pose* head, hair_vec4* rotation,
                        hair_vec4* offset)
{
    hair_quat s = space->rotation;
    hair_vec3 away = hair_rotate(hair_quat_conjugate(s), hair_pose_offset(space, head));
    *rotation =
        hair_quat_to_vec4(hair_quat_normalize(hair_quat_multiply(hair_quat_conjugate(head->rotation), s)));
    *offset = (hair_vec4){away.x, away.y, away.z, 0};
}

// Sum in double, because far from the world's origin both terms are large and nearly cancel.
hair_mat4 hair_mat4_from_head(const float m[16], const struct hair_pose* head)
{
    hair_mat4 out;
    float copy[16];
    memcpy(copy, m, sizeof copy);
    for (int i = 0; i < 4; ++i) {
        double sum = (double)m[12 + i];
        for (int k = 0; k < 3; ++k) sum += (double)m[4 * k + i] * head->position[k];
        copy[12 + i] = (float)sum;
    }
    memcpy(&out, copy, sizeof out);
    return out;
}
