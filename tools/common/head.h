// head.h - The bust that tools draw under the hair and use as colliders. libhair draws hair only.
#ifndef TOOLS_COMMON_HEAD_H
#define TOOLS_COMMON_HEAD_H

#include <hair/hair.h>

struct head_mesh {
    float* positions; // xyz per vertex, m, in the space of the built-in haircuts
    float* normals; // xyz per vertex, unit, outwards
    float* colors; // linear reflectance rgb per vertex
    // Kind, strength of the highlight and visible fraction of surroundings, per vertex. The kind of
    // skin is 1 plus the fraction that hair covers.
    float* surface;
    uint32_t* triangles; // three indices each, counter-clockwise from outside
    uint32_t vertex_count;
    uint32_t triangle_count;
    uint32_t fine_count; // number of triangles of brows, lashes and fine hairs, the last ones
};

// A band that holds hair together.
struct head_tie {
    float at[3]; // centre, m, in the space of the built-in haircuts
    float axis[3]; // unit, along the hair
    float radius; // of the hair inside, m
};

// Create the mesh of the bust, with a hair tie unless `tie` is NULL. Return 0, or -1 if memory runs
// out.
int head_mesh_create(const struct head_tie* tie, struct head_mesh* out);
void head_mesh_free(struct head_mesh* mesh);

#define HEAD_KIND_HAIR 0.5f // Kind of brows, lashes and fine hairs, which have the colour of hair.
#define HEAD_COLLIDERS 16

// Write the bust's colliders for hair_set_colliders(). No collider extends outside the scalp. Write
// at most `capacity` colliders. Return the total count.
uint32_t head_colliders(hair_collider* out, uint32_t capacity);

// Create the collision mesh of the rigid head above the neck, in the space of the built-in
// haircuts. Return 0, or -1 after an error, which the host hears. Destroy the mesh with
// hair_collision_mesh_destroy().
int head_collision_mesh_create(const hair_host* host, hair_collision_mesh** out);

// Closed surfaces that may overlap.
struct head_solid {
    float* positions; // xyz per vertex, m, in the space of the built-in haircuts
    uint32_t* triangles; // three indices each, counter-clockwise from outside
    uint32_t vertex_count, triangle_count;
};

// Create the surface below the head: the neck and the garment. Return 0, or -1 if memory runs out.
int head_body_create(struct head_solid* out);
void head_solid_free(struct head_solid* solid);

#endif
