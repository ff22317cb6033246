// bullet_stub.c - Replacement of world.cpp for a tool that is built without Bullet.
#include "tools/bullet/world.h"
#include "tools/common/file.h"

int hair_world_create(const char* tool, const char* name, const struct hair_scene* scene,
                      const hair_host* host, struct hair_world** out)
{
    (void)host;
    *out = NULL;
    if (!scene->bullet.count) return HAIR_EXIT_OK;
    hair_complain(tool, "%s: bullet has %u objects, but this %s was built without Bullet (BULLET=0)", name,
                  scene->bullet.count, tool);
    return HAIR_EXIT_INPUT;
}

void hair_world_destroy(struct hair_world* world)
{
    (void)world;
}

hair_result hair_world_colliders(struct hair_world* world, float time, const float transform[16],
                                 const float lower[3], const float upper[3], const hair_collider** colliders,
                                 uint32_t* count)
{
    (void)world, (void)time, (void)transform, (void)lower, (void)upper;
    *colliders = NULL;
    *count = 0;
    return HAIR_OK;
}
