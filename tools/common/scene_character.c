// scene_character.c - The skinned character of a scene, from JSON.
#include "tools/common/scene_character.h"

#include <stddef.h>
#include <stdio.h>
#include <string.h>

typedef struct hair_json place;
typedef struct hair_json_entry entry;

#define AT(member) offsetof(struct hair_scene_character, member)

struct hair_scene_character hair_scene_character_default(void)
{
    return (struct hair_scene_character){.scale = 1, .hair_scale = 1, .follow = true};
}

static bool read_file(const place* json, const char* key, const json_t* value, void* out)
{
    struct hair_scene_character* character = out;
    return hair_json_path(json, key, value, character->file, sizeof character->file);
}

static bool read_name(const place* json, const char* key, const json_t* value, char out[HAIR_SCENE_NAME])
{
    const char* name = json_string_value(value);
    if (name && *name && strlen(name) < HAIR_SCENE_NAME) {
        snprintf(out, HAIR_SCENE_NAME, "%s", name);
        return true;
    }
    return hair_json_wrong(json, key, "a name of 1 to 63 bytes");
}

static bool read_animation(const place* json, const char* key, const json_t* value, void* out)
{
    struct hair_scene_character* character = out;
    if (json_is_string(value)) return read_name(json, key, value, character->animation_name);
    json_int_t number = json_integer_value(value);
    if (!json_is_integer(value) || number < 0 || number > 65535)
        return hair_json_wrong(json, key, "a whole number in [0, 65535], or a name");
    character->animation = (uint32_t)number;
    return true;
}

static bool read_head(const place* json, const char* key, const json_t* value, void* out)
{
    return read_name(json, key, value, ((struct hair_scene_character*)out)->head);
}

bool hair_scene_read_character(const struct hair_json* json, const char* key, const json_t* value,
                               struct hair_scene_character* out)
{
    static const entry entries[] = {HAIR_OTHER("file", read_file),
                                    HAIR_OTHER("animation", read_animation),
                                    HAIR_OTHER("head", read_head),
                                    HAIR_NUMBERS("scale", AT(scale), 1, 1e-4, 1e4),
                                    HAIR_BOOLEAN("fit", AT(fit)),
                                    HAIR_NUMBERS("hair_scale", AT(hair_scale), 1, 0.1, 10),
                                    HAIR_NUMBERS("hair_offset", AT(hair_offset), 3, -10, 10),
                                    HAIR_BOOLEAN("follow", AT(follow)),
                                    HAIR_END};
    if (!hair_json_object(json, key, value, entries, out)) return false;
    out->fit_is_said = json_object_get(value, "fit");
    return *out->file ? true : hair_json_wrong(json, key, "given with a file");
}

json_t* hair_scene_write_character(const struct hair_scene_character* character)
{
    const float* offset = character->hair_offset;
    json_t* out =
        json_pack("{s:s, s:f, s:f, s:[f, f, f], s:b}", "file", character->file, "scale",
                  (double)character->scale, "hair_scale", (double)character->hair_scale, "hair_offset",
                  (double)offset[0], (double)offset[1], (double)offset[2], "follow", character->follow);
    if (*character->animation_name)
        json_object_set_new(out, "animation", json_string(character->animation_name));
    else
        json_object_set_new(out, "animation", json_integer(character->animation));
    if (*character->head) json_object_set_new(out, "head", json_string(character->head));
    if (character->fit_is_said) json_object_set_new(out, "fit", json_boolean(character->fit));
    return out;
}
