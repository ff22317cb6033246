// field.h - solids voxelised: the distance to the nearest of them and its number, in a box in the head's frame, so that
// what moves with the head stands still in it.
//
// Nothing is made before a solid reaches into the box, and then only what moved is written again.
#ifndef HAIR_FIELD_FIELD_H
#define HAIR_FIELD_FIELD_H

#include "lib/field/forms.h"
#include "lib/field/place.h"
#include "lib/gl/gl.h"

struct hair_solid_field {
    struct hair_gl* gl;
    struct hair_forms* forms; // of the context
    struct hair_field_box box;
    GLuint distance; // 3D texture, R16F, m; 0: there is none
    GLuint number; // 3D texture, R32UI; HAIR_NO_SOLID where none is near
    GLuint params; // uniform buffer
    GLuint work; // what the last dispatch was to do
    GLuint work_texture; // the same
    hair_quat rotation; // of the head, as the parameters have it
    struct hair_placed* placed; // as they were written
    uint32_t count, room;
    uint32_t near; // of them that reach into the box
    unsigned char* dirty; // per brick: is to be written
    uint32_t* members; // per brick
    uint32_t writes; // how often it has been written or let go
    float* best; // per brick, as it was written: no voxel is farther from the nearest solid, m
};

// Where the field of this groom is. Neither memory nor OpenGL.
void hair_field_create(struct hair_solid_field* field, struct hair_forms* forms,
                       const struct hair_groom* groom, float voxel);
void hair_field_destroy(struct hair_solid_field* field);

// Write what has moved since the last time. On failure there is no field. Where no solid is near, there may be none.
hair_result hair_field_update(struct hair_solid_field* field, const hair_solid* solids, uint32_t count,
                              const struct hair_pose* head);

// The i-th of the solids, as shaders know it. With forms of which some other than the last update knows, it has none.
struct hair_field_solid hair_field_shown(const struct hair_solid_field* field, const hair_solid* solid,
                                         uint32_t i, const struct hair_pose* head, hair_vec3* lower,
                                         hair_vec3* upper);

// Whether a strand can meet a solid: only then hair_field_bind has something to bind, and glsl/field.glsl to read.
int hair_field_is_near(const struct hair_solid_field* field);
void hair_field_bind(const struct hair_solid_field* field);

#endif
