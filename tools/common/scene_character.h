// scene_character.h - The skinned character of a scene, from JSON.
#ifndef HAIR_TOOLS_COMMON_SCENE_CHARACTER_H
#define HAIR_TOOLS_COMMON_SCENE_CHARACTER_H

#include "tools/common/json.h"

#define HAIR_SCENE_PATH 4096 // bytes of the name of a file
#define HAIR_SCENE_NAME 64 // bytes of the name of a joint or an animation

struct hair_scene_character {
    char file[HAIR_SCENE_PATH]; // .glb or .gltf, "" if there is no character
    char animation_name[HAIR_SCENE_NAME]; // "" selects the animation by its index
    uint32_t animation;
    char head[HAIR_SCENE_NAME]; // joint that the hair moves with, "" finds one by its name
    float scale; // metres per unit of the file
    bool fit; // moves roots of the hair onto the head
    bool fit_is_said; // Otherwise built-in haircuts are fitted, and files are not.
    float hair_scale; // multiple of the size that fits
    float hair_offset[3]; // m
    bool follow; // moves the camera along with a character that walks
};

// Read the character. The members have their defaults before.
bool hair_scene_read_character(const struct hair_json* json, const char* key, const json_t* value,
                               struct hair_scene_character* out);
// Return the defaults.
struct hair_scene_character hair_scene_character_default(void);
// Return the JSON of a character.
json_t* hair_scene_write_character(const struct hair_scene_character* character);

#endif
