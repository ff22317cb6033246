// scene_cuts.h - Cuts of a scene, from JSON.
#ifndef HAIR_TOOLS_COMMON_SCENE_CUTS_H
#define HAIR_TOOLS_COMMON_SCENE_CUTS_H

#include <hair/hair.h>

#include "tools/common/json.h"

#define HAIR_SCENE_CUTS 8

// A cut after the step to a frame.
struct hair_scene_cut {
    hair_cut_desc desc;
    uint32_t frame;
    bool pieces; // keeps what falls off
};

struct hair_scene_cuts {
    uint32_t count;
    struct hair_scene_cut at[HAIR_SCENE_CUTS];
};

bool hair_scene_read_cuts(const struct hair_json* json, const char* key, const json_t* value,
                          struct hair_scene_cuts* out);
// Return the name of a shape in scene files. Return NULL beyond the last.
const char* hair_scene_cut_shape(int shape);

#endif
