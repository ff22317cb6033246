// head_rig.h - Meshes and colliders of a scene, which move with the head or stay on the shoulders.
#ifndef HAIR_TOOLS_COMMON_HEAD_RIG_H
#define HAIR_TOOLS_COMMON_HEAD_RIG_H

#include "tools/common/head.h"
#include "tools/common/scene.h"

// Heights in the built-in head's space, in m. The head moves above HAIR_HEAD_RIG_MOVES and rests
// below HAIR_HEAD_RIG_RESTS. The neck between them bends.
#define HAIR_HEAD_RIG_MOVES 1.525f
#define HAIR_HEAD_RIG_RESTS 1.425f

#define HAIR_HEAD_RIG_COLLIDERS (HEAD_COLLIDERS + HEAD_MESHES + 1 + HAIR_SCENE_COLLIDERS)

// Make the ball that fur grows on. Return 0, or -1 if memory runs out. Release the mesh with
// head_mesh_free().
int hair_head_rig_ball(float radius, struct head_mesh* out);

// Compute the scene's colliders in the world at a time, in s, with the head at `transform`. The
// collision meshes of head_collision_meshes_create() replace the capsules of the built-in head,
// except for the neck, which bends. NULL selects the capsules. Return the number of colliders.
uint32_t hair_head_rig_colliders(const struct hair_scene* scene, hair_collision_mesh* const* meshes,
                                 float time, const float transform[16],
                                 hair_collider out[HAIR_HEAD_RIG_COLLIDERS]);

#endif
