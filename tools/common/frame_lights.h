// frame_lights.h - the lights of a frame, and what those see that have a shadow.
#ifndef HAIR_TOOLS_COMMON_FRAME_LIGHTS_H
#define HAIR_TOOLS_COMMON_FRAME_LIGHTS_H

#include "tools/common/camera.h"
#include "tools/common/shadow_map.h"

struct hair_frame_shadow {
    uint32_t light; // which has it
    struct hair_matrices matrices;
    float texel; // of its maps where the head is, m
};

struct hair_frame_lights {
    hair_light light[HAIR_SCENE_LIGHTS];
    uint32_t count, shadows;
    struct hair_frame_shadow shadow[HAIR_SCENE_SHADOWS];
};

// `transform` is the head's, `reach` the radius of its sphere.
void hair_frame_lights_find(const struct hair_scene* scene, const float transform[16], float reach,
                            struct hair_frame_lights* out);

// As the program of skin takes them, with a map for each shadow; and undo what that binds.
void hair_frame_lights_set(unsigned program, const struct hair_frame_lights* lights,
                           const struct hair_shadow_map* maps, unsigned sampler);
void hair_frame_lights_unset(const struct hair_frame_lights* lights);

#endif
