// scene_maps.h - Density, thickness and attributes of hair on a scalp, drawn as digits in JSON.
#ifndef HAIR_TOOLS_COMMON_SCENE_MAPS_H
#define HAIR_TOOLS_COMMON_SCENE_MAPS_H

#include <hair/hair.h>

#include "tools/common/json.h"

#define HAIR_SCENE_SETS 4
#define HAIR_SCENE_MAP 64 // maximum number of rows and of columns
#define HAIR_SCENE_ATTRIBUTES 8
#define HAIR_SCENE_ALL_ATTRIBUTES (32 + HAIR_SCENE_ATTRIBUTES) // with those of a groom

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

// Attributes of strands. Each has a map, whose values are in [0, 1].
struct hair_scene_attributes {
    struct hair_scene_attribute {
        hair_strand_attribute_kind kind;
        float range[2]; // factors where the map is 0 and 1
        struct hair_scene_map map;
    } at[HAIR_SCENE_ATTRIBUTES];
    uint32_t count;
};

// Read attributes such as [{"kind": "frizz", "map": ["09"], "range": [0.5, 2]}]. The digits 0 and 9
// stand for the numbers of the range, which is [0.2, 1] by default. Without a map all strands have
// the second number.
bool hair_scene_read_attributes(const struct hair_json* json, const char* key, const json_t* value,
                                struct hair_scene_attributes* attributes);

// Return whether values of maps of a desc are at its texture coordinates.
bool hair_scene_has_images(const hair_groom_desc* desc);

// Append the attributes to those of `desc`, which has texture coordinates as seen from above.
// `all` and `values`, HAIR_SCENE_MAP squared for each attribute, must live as long as `desc`.
void hair_scene_put_attributes(const struct hair_scene_attributes* attributes,
                               hair_strand_attribute all[HAIR_SCENE_ALL_ATTRIBUTES], float* values,
                               hair_groom_desc* desc);

// Assign the maps to `desc`, which has a scalp, and texture coordinates as seen from above. `sets`
// and `uvs`, two for each scalp vertex, must live as long as `desc`.
void hair_scene_put_maps(const struct hair_scene_maps* maps, hair_map_set sets[HAIR_SCENE_SETS], float* uvs,
                         hair_groom_desc* desc);

// Return the number of values of hair_scene_bake_images().
size_t hair_scene_count_baked(const struct hair_scene_maps* maps,
                              const struct hair_scene_attributes* attributes, const hair_groom_desc* desc);

// Replace the images of the sets, of which there are `set_count`, and of `count` attributes by
// their values at the vertices of the scalp. Images of a groom can then have texture coordinates of
// its own. `values` must live as long as the desc.
void hair_scene_bake_images(hair_map_set* sets, uint32_t set_count, hair_strand_attribute* attributes,
                            uint32_t count, const float* uvs, float* values, const hair_groom_desc* desc);

#endif
