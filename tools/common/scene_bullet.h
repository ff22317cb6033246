// scene_bullet.h - Shapes and objects of Bullet in a scene, from JSON. This file does not use
// Bullet itself.
#ifndef HAIR_TOOLS_COMMON_SCENE_BULLET_H
#define HAIR_TOOLS_COMMON_SCENE_BULLET_H

#include "tools/common/obj.h"
#include "tools/common/scene_colliders.h"

enum hair_bullet_kind {
    HAIR_BULLET_SPHERE,
    HAIR_BULLET_BOX,
    HAIR_BULLET_CAPSULE,
    HAIR_BULLET_CYLINDER,
    HAIR_BULLET_CONE,
    HAIR_BULLET_PLANE,
    HAIR_BULLET_HULL,
    HAIR_BULLET_MULTI_SPHERE,
    HAIR_BULLET_MESH,
    HAIR_BULLET_HEIGHT_FIELD,
    HAIR_BULLET_COMPOUND
};

// Rows of numbers.
struct hair_bullet_table {
    float* values;
    uint32_t rows, columns;
};

struct hair_bullet_shape {
    enum hair_bullet_kind kind;
    uint32_t axis; // 0 to 2 for x to z
    float radius, half_length, size[3];
    float normal[3], distance;
    float scale[3];
    float margin; // m, below 0 selects Bullet's margin
    float spacing; // distance of a height field's nodes, m
    struct hair_bullet_table points; // points of a hull
    struct hair_bullet_table spheres; // xyz and radius
    struct hair_bullet_table heights; // one row for each line of nodes
    struct hair_obj mesh; // mesh of a hull or a mesh shape
    struct hair_bullet_shape* children; // children of a compound
    uint32_t child_count;
    float position[3], rotation[4]; // pose of a child in its compound
};

struct hair_bullet_object {
    struct hair_bullet_shape shape;
    struct hair_scene_collider body; // pose, motion and friction, its shape and size are ignored
};

struct hair_bullet_list {
    struct hair_bullet_object* object;
    uint32_t count;
    char* text; // JSON of the objects, with absolute paths, for saving. NULL without objects.
};

// Read the list. Return false after printing an error. Call hair_scene_free_bullet() in either
// case.
bool hair_scene_read_bullet(const struct hair_json* json, const char* key, const json_t* value,
                            struct hair_bullet_list* out);
void hair_scene_free_bullet(struct hair_bullet_list* objects);

#endif
