// scene_solids.h - what hair collides with in a scene, from JSON, and where it is over time.
#ifndef HAIR_TOOLS_COMMON_SCENE_SOLIDS_H
#define HAIR_TOOLS_COMMON_SCENE_SOLIDS_H

#include <hair/hair.h>

#include "tools/common/json.h"
#include "tools/common/motion.h"

#define HAIR_SCENE_SOLID_KEYS 32
#define HAIR_SCENE_FAR 1e6 // of any coordinate, m

struct hair_scene_solid {
    hair_solid solid; // at time 0
    bool stays; // in the world; else in groom space: it goes with the head
    float velocity[3]; // m/s
    float spin[3]; // degrees/s about each axis
    struct hair_key key[HAIR_SCENE_SOLID_KEYS];
    uint32_t key_count;
};

// Of a motion, in order of time.
bool hair_scene_read_keys(const struct hair_json* json, const char* key, const json_t* value,
                          struct hair_key* keys, uint32_t most, uint32_t* count);
bool hair_scene_read_solids(const struct hair_json* json, const char* key, const json_t* value,
                            struct hair_scene_solid* solids, uint32_t most, uint32_t* count);

hair_solid hair_scene_solid_at(const struct hair_scene_solid* from, float time); // s

// By a share of a rigid motion.
void hair_solid_carry(const float transform[16], float share, hair_solid* solid);

#endif
