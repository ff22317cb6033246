// world.h - Objects of a scene in a world of Bullet, and the colliders of objects that touch the
// hair.
#ifndef HAIR_TOOLS_BULLET_WORLD_H
#define HAIR_TOOLS_BULLET_WORLD_H

#include "tools/common/scene.h"

struct hair_world;

// Create the world. Return an exit status, after printing any error. `*out` is NULL if the scene
// has no objects. `scene`, whose name is `name`, and `host` must outlive the world.
int hair_world_create(const char* tool, const char* name, const struct hair_scene* scene,
                      const hair_host* host, struct hair_world** out);
void hair_world_destroy(struct hair_world* world); // NULL is allowed.

// Move the objects to their poses at `time`, in s, with the head at `transform`. Return the
// colliders of objects that touch the bounds. The list is valid until the next call.
hair_result hair_world_colliders(struct hair_world* world, float time, const float transform[16],
                                 const float lower[3], const float upper[3], const hair_collider** colliders,
                                 uint32_t* count);

#endif
