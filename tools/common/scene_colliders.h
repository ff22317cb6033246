// scene_colliders.h - Colliders of a scene, from JSON, and their poses over time.
#ifndef HAIR_TOOLS_COMMON_SCENE_COLLIDERS_H
#define HAIR_TOOLS_COMMON_SCENE_COLLIDERS_H

#include <hair/hair.h>

#include "tools/common/json.h"
#include "tools/common/motion.h"

#define HAIR_SCENE_COLLIDER_KEYS 32
#define HAIR_SCENE_FAR 1e6 // maximum of any coordinate, m

// Names of shapes in scene files, by hair_shape. NULL is a collision mesh, which no scene has.
#define HAIR_SCENE_SHAPES (HAIR_SHAPE_ELLIPSOID + 1)
extern const char* const hair_scene_shapes[HAIR_SCENE_SHAPES];

struct hair_scene_collider {
    hair_collider collider; // at time 0
    // Fixed in the world. Otherwise the collider is in groom space and moves with the head.
    bool stays;
    float velocity[3]; // m/s
    float spin[3]; // degrees/s about each axis
    struct hair_key key[HAIR_SCENE_COLLIDER_KEYS];
    uint32_t key_count;
};

// Read the keys of a motion, in order of time.
bool hair_scene_read_keys(const struct hair_json* json, const char* key, const json_t* value,
                          struct hair_key* keys, uint32_t max, uint32_t* count);
// Read an array of colliders.
bool hair_scene_read_colliders(const struct hair_json* json, const char* key, const json_t* value,
                               struct hair_scene_collider* colliders, uint32_t max, uint32_t* count);

// Compute the collider at a time, in s.
hair_collider hair_scene_collider_at(const struct hair_scene_collider* from, float time);

// Apply a fraction of a rigid motion to a collider.
void hair_collider_carry(const float transform[16], float fraction, hair_collider* collider);

#endif
