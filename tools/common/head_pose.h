// head_pose.h - Motion of the bust: the head moves, the shoulders rest, the neck bends, and the
// chest breathes.
#ifndef HAIR_TOOLS_COMMON_HEAD_POSE_H
#define HAIR_TOOLS_COMMON_HEAD_POSE_H

#include <stdbool.h>

// Heights in the space of the built-in haircuts, in m. The head moves above HAIR_HEAD_MOVES, and
// the shoulders rest below HAIR_HEAD_RESTS.
#define HAIR_HEAD_MOVES 1.525f
#define HAIR_HEAD_RESTS 1.425f

// Motion of the bust, as uniforms of hair_mesh_vert.
struct hair_head_pose {
    float transform[16]; // of the head
    // Heights in m: the head moves above the first and rests below the second. The chest breathes
    // below the fourth and rests above the third.
    float heights[4];
    // Widening of the chest per m to its side, rise in m, and widening per m before an axis, whose
    // z in m is the last.
    float breath[4];
};

// Return the pose of the bust with the head at `transform`. Breath moves the front of the chest
// forwards by `breath`, in m. With `whole`, everything moves with the head.
struct hair_head_pose hair_head_pose_at(const float transform[16], float breath, bool whole);

// Compute the place of a point of the bust, in m, as hair_mesh_vert does.
void hair_head_pose_move(const struct hair_head_pose* pose, const float rest[3], float out[3]);

// Return the weight of the head's motion at a height, in [0, 1].
float hair_head_pose_weight(float height);

#endif
