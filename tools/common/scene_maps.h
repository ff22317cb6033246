// scene_maps.h - Hair density and thickness on a scene's scalp, drawn as digits in JSON.
#ifndef HAIR_TOOLS_COMMON_SCENE_MAPS_H
#define HAIR_TOOLS_COMMON_SCENE_MAPS_H

#include <hair/hair.h>

#include "tools/common/json.h"

#define HAIR_SCENE_SETS 4
#define HAIR_SCENE_MAP 64 // maximum number of rows and of columns

struct hair_scene_map {
    float value[HAIR_SCENE_MAP * HAIR_SCENE_MAP];
    uint32_t width, height; // 0 if there is no map
};

struct hair_scene_maps {
    struct {
        struct hair_scene_map density, thickness;
    } set[HAIR_SCENE_SETS];
    uint32_t count;
};

// Read maps such as [{"density": ["09", "90"], "thickness": ["36"]}]. Each string is a row of
// digits. The scalp is seen from above, with the face at the bottom. Density is in ninths.
// Thickness is in thirds, so that 3 is the thickness of the look.
bool hair_scene_read_maps(const struct hair_json* json, const char* key, const json_t* value,
                          struct hair_scene_maps* maps);

// Assign the maps to `desc`, which has a scalp. `sets` and `uvs`, two for each scalp vertex, must
// live as long as `desc`.
void hair_scene_put_maps(const struct hair_scene_maps* maps, hair_map_set sets[HAIR_SCENE_SETS], float* uvs,
                         hair_groom_desc* desc);

#endif
