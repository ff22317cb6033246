// rig.h - what goes with the head when it moves, and what stays on the shoulders.
#ifndef HAIR_TOOLS_COMMON_RIG_H
#define HAIR_TOOLS_COMMON_RIG_H

#include "tools/common/head.h"
#include "tools/common/scene.h"

// Heights in the built-in head's space, m: above the first it moves, below the second it rests; the neck
// between them bends.
#define HAIR_RIG_MOVES 1.525f
#define HAIR_RIG_RESTS 1.425f

#define HAIR_RIG_SOLIDS (HEAD_SOLIDS + 1 + HAIR_SCENE_SOLIDS)

// The ball that fur grows on. Returns 0, or -1 when memory ran out; head_mesh_free undoes it.
int hair_rig_ball(float radius, struct head_mesh* out);

// The scene's solids in the world at a time, in s, with the head at `transform`. Returns how many.
uint32_t hair_rig_solids(const struct hair_scene* scene, float time, const float transform[16],
                         hair_solid out[HAIR_RIG_SOLIDS]);

#endif
