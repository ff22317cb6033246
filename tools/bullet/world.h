// world.h - the objects of a scene in a world of Bullet's, and the solids that those which touch the hair are.
#ifndef HAIR_TOOLS_BULLET_WORLD_H
#define HAIR_TOOLS_BULLET_WORLD_H

#include "tools/common/scene.h"

struct hair_world;

// Returns what to exit with, having complained. *out is NULL where the scene has no objects. `scene`, whose name is
// `name`, and `host` must outlive the world.
int hair_world_create(const char* tool, const char* name, const struct hair_scene* scene,
                      const hair_host* host, struct hair_world** out);
void hair_world_destroy(struct hair_world* world); // Takes NULL.

// Objects are moved to where they are at `time`, in s, with the head at `transform`; those that touch the bounds are
// taken. The list lives until the next call.
hair_result hair_world_solids(struct hair_world* world, float time, const float transform[16],
                              const float lower[3], const float upper[3], const hair_solid** solids,
                              uint32_t* count);

#endif
