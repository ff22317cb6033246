// head_pose.c - Motion of the bust, as the vertex shader of its mesh computes it.
#include "tools/common/head_pose.h"

#include <cglm/cglm.h>

#include <string.h>

// Heights between which the head moves and rests, and between which the chest rests and breathes.
static const float heights[4] = {HAIR_HEAD_MOVES, HAIR_HEAD_RESTS, 1.43f, 1.30f};

// Return the weight of motion at a height, from 0 at `rests` to 1 at `moves`.
static float weight(float height, float rests, float moves)
{
    float t = glm_clamp((height - rests) / (moves - rests), 0, 1);
    return t * t * (3 - 2 * t);
}

float hair_head_pose_weight(float height)
{
    return weight(height, HAIR_HEAD_RESTS, HAIR_HEAD_MOVES);
}

struct hair_head_pose hair_head_pose_at(const float transform[16], float breath, bool whole)
{
    // The front of the chest is 0.125 m before the axis. The sides move by 0.4 of its motion.
    struct hair_head_pose pose = {.breath = {2 * breath, 0.25f * breath, 8 * breath, -0.03f}};
    memcpy(pose.transform, transform, sizeof pose.transform);
    memcpy(pose.heights, heights, sizeof pose.heights);
    if (whole) pose.heights[0] = -1e9f, pose.breath[0] = pose.breath[1] = pose.breath[2] = 0;
    return pose;
}

void hair_head_pose_move(const struct hair_head_pose* pose, const float rest[3], float out[3])
{
    const float *height = pose->heights, *breath = pose->breath;
    mat4 head;
    vec3 from = {breath[0] * rest[0], breath[1], breath[2] * (rest[2] - breath[3])}, moved;
    float chest = weight(rest[1], height[2], height[3]);
    memcpy(head, pose->transform, sizeof head);
    for (int k = 0; k < 3; ++k) from[k] = rest[k] + chest * from[k];
    glm_mat4_mulv3(head, from, 1, moved);
    glm_vec3_lerp(from, moved, rest[1] >= height[0] ? 1 : weight(rest[1], height[1], height[0]), moved);
    memcpy(out, moved, sizeof moved);
}
