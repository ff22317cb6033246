// live_colliders.h - All colliders of a scene at one time.
#ifndef HAIR_TOOLS_COMMON_LIVE_COLLIDERS_H
#define HAIR_TOOLS_COMMON_LIVE_COLLIDERS_H

#include "tools/common/character.h"
#include "tools/common/head_body.h"

struct hair_live_colliders {
    const char* tool; // Set these before the first use. They must outlive this.
    const hair_host* host;
    hair_context* context;
    hair_collider* at;
    uint32_t count, room;
    hair_collision_mesh* head; // of the built-in head, NULL until it is needed
    struct hair_head_body body; // of the built-in head, as long as its mesh
};

// Place the scene's colliders, the body of the character, which may be NULL, and `others`. The head
// is at `transform` at a time, in s. OpenGL is required.
hair_result hair_live_colliders_place(struct hair_live_colliders* colliders, const struct hair_scene* scene,
                                      const struct hair_character* character, float time,
                                      const float transform[16], const hair_collider* others,
                                      uint32_t other_count);
// OpenGL is required if anything was placed.
void hair_live_colliders_free(struct hair_live_colliders* colliders);

#endif
