// scene_lights.h - the lights of a scene.
#ifndef HAIR_TOOLS_COMMON_SCENE_LIGHTS_H
#define HAIR_TOOLS_COMMON_SCENE_LIGHTS_H

#include <hair/hair.h>

#include "tools/common/json.h"

#define HAIR_SCENE_LIGHTS 16
#define HAIR_SCENE_SHADOWS 4 // of those, at most

// With a shadow it has maps of depth and of what hair takes of it, else it shines through everything.
struct hair_scene_light {
    hair_light light;
    bool shadow;
};

// Lights beside the first, which is a setting.
struct hair_scene_lights {
    uint32_t count;
    struct hair_scene_light at[HAIR_SCENE_LIGHTS - 1];
};

bool hair_scene_read_lights(const struct hair_json* json, const char* key, const json_t* value,
                            struct hair_scene_lights* out);

// A light as the shaders of tools take it: where it is or (w 0) which way; colour and the square of its size; of a spot
// its axis and the cosine at its edge; the slope from there on, and 1 over the square of the range.
struct hair_lit {
    float to[4], color[4], axis[4], more[2];
};
struct hair_lit hair_lit_of(const hair_light* light);

#endif
