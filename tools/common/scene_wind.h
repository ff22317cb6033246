// scene_wind.h - Wind of a scene. Its numbers are settings, its sources are stored here.
#ifndef HAIR_TOOLS_COMMON_SCENE_WIND_H
#define HAIR_TOOLS_COMMON_SCENE_WIND_H

#include "tools/common/json.h"
#include "tools/common/settings.h"

#define HAIR_SCENE_SOURCES 4

struct hair_scene_wind {
    uint32_t count;
    hair_wind_source source[HAIR_SCENE_SOURCES];
};

bool hair_scene_read_wind(const struct hair_json* json, const char* key, const json_t* value,
                          struct hair_settings* settings, struct hair_scene_wind* out);

// Return the wind for hair_set_wind(), with pointers into `wind`.
hair_wind hair_scene_wind_of(const struct hair_settings* settings, const struct hair_scene_wind* wind);

// Set a setting from a JSON number or the name of a choice. `prefix` goes before its name.
bool hair_scene_set(const struct hair_json* json, const char* prefix, const char* name, const json_t* value,
                    struct hair_settings* settings);

#endif
