// field.h - voxelised distance field of the colliders in a box of the head's frame. It holds the
// distance to the nearest collider and, if wanted, its number. Colliders that move with the head do
// not change it.
//
// Nothing is created before a collider reaches into the box. Afterwards only bricks that changed
// are written again.
#ifndef HAIR_FIELD_FIELD_H
#define HAIR_FIELD_FIELD_H

#include "lib/field/sdf_pool.h"
#include "lib/field/field_bounds.h"
#include "lib/gl/commands.h"

struct hair_collider_field {
    struct hair_gl* gl;
    struct hair_sdf_pool* sdf_pool; // Pool of the context.
    struct hair_field_box box;
    GLuint distance; // 3D texture, R16F, in metres. 0 if there is none.
    // 3D texture, R32UI. HAIR_NO_COLLIDER where no collider is near. 0 unless the number is wanted.
    GLuint number;
    bool wants_numbers;
    GLuint params; // Uniform buffer.
    GLuint work; // Inputs of the last dispatch.
    GLuint work_texture; // Buffer texture of `work`.
    hair_quat rotation; // Rotation of the head in `params`.
    struct hair_placed_collider* placed; // Colliders as written.
    uint32_t count, room;
    struct hair_placed_collider* stepped; // Colliders as the last step wrote them.
    uint32_t stepped_count, stepped_room;
    uint32_t near; // Number of colliders that reach into the box.
    unsigned char* dirty; // Per brick, nonzero if it must be written.
    uint32_t* brick_colliders; // Member count or place, per brick.
    uint32_t writes; // Number of times that the field was written or freed.
    // Per brick, maximum distance of any voxel to the nearest collider as written, in metres.
    float* best;
};

// Free the field of a groom, which gets another size of voxels when it is written next.
void hair_field_set_voxel(struct hair_collider_field* field, const struct hair_groom* groom, float voxel);
// Set up the field of a groom, without memory or OpenGL.
void hair_field_create(struct hair_collider_field* field, struct hair_sdf_pool* pool,
                       const struct hair_groom* groom, float voxel);
void hair_field_destroy(struct hair_collider_field* field);

// Let updates write the numbers of colliders too, from the next on. Fluids read them.
void hair_field_want_numbers(struct hair_collider_field* field);
// Return a pass that writes the field, with the features of the field.
hair_gl_pass hair_field_pass(const struct hair_collider_field* field, hair_gl_pass pass);

// Write what has changed since the last update. On failure there is no field. There may be none
// while no collider is near.
hair_result hair_field_update(struct hair_collider_field* field, const hair_collider* colliders,
                              uint32_t count, const struct hair_pose* head);

// Update the field for a step, whose motion depends on it. What views wrote since the last step has
// no effect on what is written.
hair_result hair_field_update_for_step(struct hair_collider_field* field, const hair_collider* colliders,
                                       uint32_t count, const struct hair_pose* head);

// Return collider i as shaders read it, and its extent. A collision mesh that differs from the last
// update has an empty extent.
struct hair_field_collider hair_field_shown(const struct hair_collider_field* field,
                                            const hair_collider* collider, uint32_t i,
                                            const struct hair_pose* head, hair_vec3* lower, hair_vec3* upper);

// Return nonzero if a strand can meet a collider. Only then may hair_field_bind() be called and
// glsl/field.glsl read the field.
int hair_field_is_near(const struct hair_collider_field* field);
void hair_field_bind(const struct hair_collider_field* field);

#endif
