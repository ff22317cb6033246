// scene_lights.h - Lights of a scene.
#ifndef HAIR_TOOLS_COMMON_SCENE_LIGHTS_H
#define HAIR_TOOLS_COMMON_SCENE_LIGHTS_H

#include <hair/hair.h>

#include "tools/common/json.h"

#define HAIR_SCENE_LIGHTS 16
#define HAIR_SCENE_SHADOWS 4 // maximum number of lights with a shadow

// A light. With `shadow` it has shadow maps of depth and of the hair's opacity. Otherwise it shines
// through everything.
struct hair_scene_light {
    hair_light light;
    bool shadow;
};

// Lights in addition to the first, which is a setting.
struct hair_scene_lights {
    uint32_t count;
    struct hair_scene_light at[HAIR_SCENE_LIGHTS - 1];
};

bool hair_scene_read_lights(const struct hair_json* json, const char* key, const json_t* value,
                            struct hair_scene_lights* out);

// Light parameters for the tools' shaders.
// `to` is the position (w = 1) or the direction (w = 0). `color` is the colour and, in w, the
// squared size of a lamp. `axis` is a spot light's axis and, in w, the cosine at the cone's edge.
// `more` is the slope of the cone's falloff and 1 over the squared range.
struct hair_lit {
    float to[4], color[4], axis[4], more[2];
};
struct hair_lit hair_lit_of(const hair_light* light);

#endif
