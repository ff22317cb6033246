// scene_maps.h - how densely hair grows and how thick it is on a scene's scalp, drawn as digits in JSON.
#ifndef HAIR_TOOLS_COMMON_SCENE_MAPS_H
#define HAIR_TOOLS_COMMON_SCENE_MAPS_H

#include <hair/hair.h>

#include "tools/common/json.h"

#define HAIR_SCENE_SETS 4
#define HAIR_SCENE_MAP 64 // rows and columns, at most

struct hair_scene_map {
    float value[HAIR_SCENE_MAP * HAIR_SCENE_MAP];
    uint32_t width, height; // 0: there is none
};

struct hair_scene_maps {
    struct {
        struct hair_scene_map density, thickness;
    } set[HAIR_SCENE_SETS];
    uint32_t count;
};

// [{"density": ["09", "90"], "thickness": ["36"]}]: a row of digits after the other, as the scalp is seen from above,
// the face at the bottom. Density in ninths; thickness in thirds, so that 3 is what the look says.
bool hair_scene_read_maps(const struct hair_json* json, const char* key, const json_t* value,
                          struct hair_scene_maps* maps);

// Have `desc`, which has a scalp, grow by the maps. `sets` and `uvs`, two for each of its vertices, must live as long.
void hair_scene_put_maps(const struct hair_scene_maps* maps, hair_map_set sets[HAIR_SCENE_SETS], float* uvs,
                         hair_groom_desc* desc);

#endif
