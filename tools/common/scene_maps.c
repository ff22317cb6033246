// scene_maps.c - Maps of a scene, from digits in JSON to images that are projected onto the scalp
// from above.
#include "tools/common/scene_maps.h"

#include <math.h>
#include <string.h>

static bool read_rows(const struct hair_json* json, const char* key, const json_t* value, float one,
                      struct hair_scene_map* map)
{
    static const char must[] = "rows of digits, all as long, at most 64 by 64";
    size_t rows = json_array_size(value);
    if (rows < 1 || rows > HAIR_SCENE_MAP) return hair_json_wrong(json, key, must);
    for (size_t y = 0; y < rows; ++y) {
        const char* row = json_string_value(json_array_get(value, y));
        size_t width = row ? strlen(row) : 0;
        if (width < 1 || width > HAIR_SCENE_MAP || (y && width != map->width) ||
            strspn(row, "0123456789") != width)
            return hair_json_wrong(json, key, must);
        map->width = (uint32_t)width;
        for (size_t x = 0; x < width; ++x) map->value[y * width + x] = (float)(row[x] - '0') / one;
    }
    map->height = (uint32_t)rows;
    return true;
}

static bool read_density(const struct hair_json* json, const char* key, const json_t* value, void* out)
{
    return read_rows(json, key, value, 9, out);
}

static bool read_thickness(const struct hair_json* json, const char* key, const json_t* value, void* out)
{
    struct hair_scene_map* density = out; // Thickness is the next member.
    return read_rows(json, key, value, 3, density + 1);
}

bool hair_scene_read_maps(const struct hair_json* json, const char* key, const json_t* value,
                          struct hair_scene_maps* maps)
{
    static const struct hair_json_entry entries[] = {HAIR_OTHER("density", read_density),
                                                     HAIR_OTHER("thickness", read_thickness), HAIR_END};
    memset(maps, 0, sizeof *maps);
    return hair_json_array(json, key, value, entries, maps->set, sizeof *maps->set, HAIR_SCENE_SETS,
                           &maps->count);
}

// Attributes --------------------------------------------------------------------------------------

static bool read_kind(const struct hair_json* json, const char* key, const json_t* value, void* out)
{
    char must[256] = "one of";
    const char *name = json_is_string(value) ? json_string_value(value) : "", *kind;
    for (int i = 0; (kind = hair_strand_attribute_name((hair_strand_attribute_kind)i)); ++i) {
        if (strcmp(name, kind) == 0) {
            ((struct hair_scene_attribute*)out)->kind = (hair_strand_attribute_kind)i;
            return true;
        }
        snprintf(must + strlen(must), sizeof must - strlen(must), "%s %s", i ? "," : "", kind);
    }
    return hair_json_wrong(json, key, must);
}

static bool read_attribute_map(const struct hair_json* json, const char* key, const json_t* value, void* out)
{
    return read_rows(json, key, value, 9, &((struct hair_scene_attribute*)out)->map);
}

bool hair_scene_read_attributes(const struct hair_json* json, const char* key, const json_t* value,
                                struct hair_scene_attributes* attributes)
{
    static const struct hair_json_entry entries[] = {
        HAIR_OTHER("kind", read_kind), HAIR_OTHER("map", read_attribute_map),
        HAIR_NUMBERS("range", offsetof(struct hair_scene_attribute, range), 2, 0, 100), HAIR_END};
    memset(attributes, 0, sizeof *attributes);
    for (int i = 0; i < HAIR_SCENE_ATTRIBUTES; ++i) {
        struct hair_scene_attribute* attribute = &attributes->at[i];
        attribute->range[0] = 0.2f;
        attribute->range[1] = 1;
        attribute->map.width = attribute->map.height = 1;
        attribute->map.value[0] = 1;
    }
    return hair_json_array(json, key, value, entries, attributes->at, sizeof *attributes->at,
                           HAIR_SCENE_ATTRIBUTES, &attributes->count);
}

void hair_scene_put_attributes(const struct hair_scene_attributes* attributes,
                               hair_strand_attribute all[HAIR_SCENE_ALL_ATTRIBUTES], float* values,
                               hair_groom_desc* desc)
{
    for (uint32_t i = 0; i < desc->strand_attribute_count; ++i) all[i] = desc->strand_attributes[i];
    desc->strand_attributes = all;
    for (uint32_t i = 0; i < attributes->count; ++i, values += HAIR_SCENE_MAP * HAIR_SCENE_MAP) {
        const struct hair_scene_attribute* attribute = &attributes->at[i];
        const struct hair_scene_map* map = &attribute->map;
        hair_strand_attribute* own = &all[desc->strand_attribute_count++];
        for (uint32_t k = 0; k < map->width * map->height; ++k)
            values[k] = (1 - map->value[k]) * attribute->range[0] + map->value[k] * attribute->range[1];
        *own = hair_strand_attribute_default();
        own->kind = attribute->kind;
        own->map = (hair_map){HAIR_MAP_SOURCE_IMAGE, values, map->width, map->height};
    }
}

// Grooms ------------------------------------------------------------------------------------------

bool hair_scene_has_images(const hair_groom_desc* desc)
{
    bool has_images = false;
    for (int i = 0; i < HAIR_SCENE_SETS && desc->map_sets[i]; ++i)
        has_images |= desc->map_sets[i]->density.source == HAIR_MAP_SOURCE_IMAGE ||
                      desc->map_sets[i]->thickness.source == HAIR_MAP_SOURCE_IMAGE;
    for (uint32_t i = 0; i < desc->strand_attribute_count; ++i)
        has_images |= desc->strand_attributes[i].map.source == HAIR_MAP_SOURCE_IMAGE;
    return has_images;
}

// Compute texture coordinates of the scalp as seen from above. The face looks along +z.
static void look_from_above(const hair_groom_desc* desc, float* uvs)
{
    float lower[3], upper[3];
    for (uint32_t i = 0; i < desc->scalp_vertex_count; ++i)
        for (uint32_t k = 0; k < 3; ++k) {
            float at = desc->scalp_positions[3 * i + k];
            lower[k] = i && lower[k] < at ? lower[k] : at;
            upper[k] = i && upper[k] > at ? upper[k] : at;
        }
    for (uint32_t i = 0; i < desc->scalp_vertex_count; ++i)
        for (uint32_t k = 0; k < 2; ++k) {
            uint32_t axis = 2 * k;
            float width = upper[axis] - lower[axis];
            uvs[2 * i + k] = width > 0 ? (desc->scalp_positions[3 * i + axis] - lower[axis]) / width : 0;
        }
}

static hair_map map_of(const struct hair_scene_map* map)
{
    if (!map->height) return (hair_map){HAIR_MAP_SOURCE_NONE, NULL, 0, 0};
    return (hair_map){HAIR_MAP_SOURCE_IMAGE, map->value, map->width, map->height};
}

void hair_scene_put_maps(const struct hair_scene_maps* maps, hair_map_set sets[HAIR_SCENE_SETS], float* uvs,
                         hair_groom_desc* desc)
{
    look_from_above(desc, uvs);
    desc->scalp_uvs = uvs;
    for (uint32_t i = 0; maps->count && i < HAIR_SCENE_SETS; ++i) desc->map_sets[i] = NULL;
    for (uint32_t i = 0; i < maps->count; ++i) {
        sets[i] = hair_map_set_default();
        sets[i].density = map_of(&maps->set[i].density);
        sets[i].thickness = map_of(&maps->set[i].thickness);
        desc->map_sets[i] = &sets[i];
    }
}

// Images of grooms --------------------------------------------------------------------------------

// Return the number of the value before a coordinate along a side, and set the weight of the next.
static uint32_t find_place(float uv, uint32_t size, float* fraction)
{
    float place = fminf(fmaxf(uv * (float)size - 0.5f, 0), (float)(size - 1));
    *fraction = place - (float)(uint32_t)place;
    return (uint32_t)place;
}

// Sample an image as grooms do.
static float sample(const hair_map* map, const float uv[2])
{
    float right, down, row[2];
    uint32_t x = find_place(uv[0], map->width, &right), y = find_place(uv[1], map->height, &down);
    uint32_t next = x + 1 < map->width ? x + 1 : x;
    for (uint32_t i = 0; i < 2; ++i) {
        const float* values = map->values + (size_t)(y + i < map->height ? y + i : y) * map->width;
        row[i] = (1 - right) * values[x] + right * values[next];
    }
    return (1 - down) * row[0] + down * row[1];
}

// Replace an image. Return the values that follow.
static float* bake(hair_map* map, const float* uvs, float* values, uint32_t vertices)
{
    if (map->source != HAIR_MAP_SOURCE_IMAGE) return values;
    for (uint32_t i = 0; i < vertices; ++i) values[i] = sample(map, uvs + 2 * (size_t)i);
    *map = (hair_map){HAIR_MAP_SOURCE_VERTICES, values, 0, 0};
    return values + vertices;
}

size_t hair_scene_count_baked(const struct hair_scene_maps* maps,
                              const struct hair_scene_attributes* attributes, const hair_groom_desc* desc)
{
    return (2 * (size_t)maps->count + attributes->count) * desc->scalp_vertex_count;
}

void hair_scene_bake_images(hair_map_set* sets, uint32_t set_count, hair_strand_attribute* attributes,
                            uint32_t count, const float* uvs, float* values, const hair_groom_desc* desc)
{
    for (uint32_t i = 0; i < set_count; ++i) {
        values = bake(&sets[i].density, uvs, values, desc->scalp_vertex_count);
        values = bake(&sets[i].thickness, uvs, values, desc->scalp_vertex_count);
    }
    for (uint32_t i = 0; i < count; ++i)
        values = bake(&attributes[i].map, uvs, values, desc->scalp_vertex_count);
}
