// frame_lights.h - The lights of a frame and the shadow matrices of those that cast shadows.
#ifndef HAIR_TOOLS_COMMON_FRAME_LIGHTS_H
#define HAIR_TOOLS_COMMON_FRAME_LIGHTS_H

#include "tools/common/camera.h"
#include "tools/common/shadow_map.h"

struct hair_frame_shadow {
    uint32_t light; // index of the light
    struct hair_matrices matrices;
    float texel; // width of a shadow map texel at the head, m
};

struct hair_frame_lights {
    hair_light light[HAIR_SCENE_LIGHTS];
    uint32_t count, shadows;
    struct hair_frame_shadow shadow[HAIR_SCENE_SHADOWS];
};

// Compute the lights and shadow matrices of a frame. `transform` is the head's transform, `reach`
// the radius of its sphere.
void hair_frame_lights_find(const struct hair_scene* scene, const float transform[16], float reach,
                            struct hair_frame_lights* out);

// Set the light uniforms of the skin program and bind one shadow map for each shadow.
void hair_frame_lights_set(unsigned program, const struct hair_frame_lights* lights,
                           const struct hair_shadow_map* maps, unsigned sampler);
// Undo the sampler bindings of hair_frame_lights_set().
void hair_frame_lights_unset(const struct hair_frame_lights* lights);

#endif
