// scene_wind.c - Wind of a scene, from JSON.
#include "tools/common/scene_wind.h"

#include <stddef.h>
#include <stdio.h>
#include <string.h>

#define AT(member) offsetof(hair_wind_source, member)
#define FAR 1e6

bool hair_scene_set(const struct hair_json* json, const char* prefix, const char* name, const json_t* value,
                    struct hair_settings* settings)
{
    char key[64], text[256]; // A curve has eight numbers.
    snprintf(key, sizeof key, "%s%s", prefix, name);
    if (json_is_string(value))
        snprintf(text, sizeof text, "%s", json_string_value(value));
    else if (json_is_number(value))
        snprintf(text, sizeof text, "%.17g", json_number_value(value));
    else
        return hair_json_wrong(json, key, "a number or the name of a choice");
    return hair_settings_set(json->tool, settings, key, text);
}

static bool read_sources(const struct hair_json* json, const char* key, const json_t* value,
                         struct hair_scene_wind* out)
{
    static const struct hair_json_entry entries[] = {HAIR_NUMBERS("position", AT(position), 3, -FAR, FAR),
                                                     HAIR_NUMBERS("direction", AT(direction), 3, -FAR, FAR),
                                                     HAIR_NUMBERS("speed", AT(speed), 1, -1000, 1000),
                                                     HAIR_NUMBERS("radius", AT(radius), 1, 0.001, 100),
                                                     HAIR_END};
    for (int i = 0; i < HAIR_SCENE_SOURCES; ++i) out->source[i] = hair_wind_source_default();
    return hair_json_array(json, key, value, entries, out->source, sizeof *out->source, HAIR_SCENE_SOURCES,
                           &out->count);
}

bool hair_scene_read_wind(const struct hair_json* json, const char* key, const json_t* value,
                          struct hair_settings* settings, struct hair_scene_wind* out)
{
    static const char* const axes[] = {"x", "y", "z"};
    struct hair_json inside = {json->tool, json->path, "wind."};
    const char* name;
    json_t* member;
    if (!json_is_object(value)) return hair_json_wrong(json, key, "an object");
    json_object_foreach((json_t*)(uintptr_t)value, name, member)
    {
        bool ok = true;
        if (!strcmp(name, "sources")) {
            ok = read_sources(&inside, name, member, out);
        } else if (!strcmp(name, "velocity")) {
            if (json_array_size(member) != 3) return hair_json_wrong(&inside, name, "three numbers");
            for (size_t i = 0; i < 3 && ok; ++i)
                ok = hair_scene_set(json, "wind.", axes[i], json_array_get(member, i), settings);
        } else {
            ok = hair_scene_set(json, "wind.", name, member, settings);
        }
        if (!ok) return false;
    }
    return true;
}

hair_wind hair_scene_wind_of(const struct hair_settings* settings, const struct hair_scene_wind* wind)
{
    hair_wind own = settings->wind;
    own.sources = wind->source;
    own.source_count = wind->count;
    return own;
}
