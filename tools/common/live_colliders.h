// live_colliders.h - All colliders of a scene at one time.
#ifndef HAIR_TOOLS_COMMON_LIVE_COLLIDERS_H
#define HAIR_TOOLS_COMMON_LIVE_COLLIDERS_H

#include "tools/common/character.h"
#include "tools/common/head_rig.h"

struct hair_live_colliders {
    const char* tool; // Set both before the first use. They must outlive this.
    const hair_host* host;
    hair_collider* at;
    uint32_t count, room;
    hair_collision_mesh* head[HEAD_MESHES]; // of the built-in head, NULL until they are needed
};

// Place the scene's colliders, the body of the character, which may be NULL, and `others`. The head
// is at `transform` at a time, in s.
hair_result hair_live_colliders_place(struct hair_live_colliders* colliders, const struct hair_scene* scene,
                                      const struct hair_character* character, float time,
                                      const float transform[16], const hair_collider* others,
                                      uint32_t other_count);
void hair_live_colliders_free(struct hair_live_colliders* colliders);

#endif
