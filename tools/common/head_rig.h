// head_rig.h - Meshes and colliders of a scene, which move with the head or stay on the shoulders.
#ifndef HAIR_TOOLS_COMMON_HEAD_RIG_H
#define HAIR_TOOLS_COMMON_HEAD_RIG_H

#include "tools/common/head.h"
#include "tools/common/head_pose.h"
#include "tools/common/scene.h"

// Collision meshes of the built-in head. NULL selects the capsules of the bust.
struct hair_head_meshes {
    const hair_collision_mesh* head; // of head_collision_mesh_create()
    const hair_collision_mesh* body; // of the neck and the garment, in the world
};

#define HAIR_HEAD_RIG_COLLIDERS (HEAD_COLLIDERS + 2 + HAIR_SCENE_COLLIDERS)

// Make the ball that fur grows on. Return 0, or -1 if memory runs out. Release the mesh with
// head_mesh_free().
int hair_head_rig_ball(float radius, struct head_mesh* out);

// Return how far breath moves the front of the chest forwards at a time, in s. The result is in m.
float hair_head_rig_breath(const struct hair_scene* scene, float time);

// Compute the scene's colliders in the world at a time, in s, with the head at `transform`. Meshes
// replace the capsules of the built-in head. NULL selects the capsules. Return the number of
// colliders.
uint32_t hair_head_rig_colliders(const struct hair_scene* scene, const struct hair_head_meshes* meshes,
                                 float time, const float transform[16],
                                 hair_collider out[HAIR_HEAD_RIG_COLLIDERS]);

#endif
