// collision_mesh.h - a collision mesh: distances to a triangle mesh at the nodes of a grid in the
// mesh's own space.
#ifndef HAIR_COLLIDE_COLLISION_MESH_H
#define HAIR_COLLIDE_COLLISION_MESH_H

#include <stdatomic.h>

#include "lib/base/host.h"
#include "lib/base/math.h"

// Immutable once made, except the reference count. The mesh of a body changes its shape.
struct hair_collision_mesh {
    hair_host host; // owner of the memory
    atomic_uint holders;
    hair_collision_mesh_info info;
    // hash of the content. Collision meshes with equal hashes have equal shapes.
    uint64_t content_hash;
    uint32_t size[3]; // number of nodes along x, y, z
    float origin[3]; // position of the first node, m
    float voxel; // distance between nodes, m
    // Signed distance at each node, m, negative inside. Node (i, j, k) is at i + size[0] (j +
    // size[1] k). The surface and the padding around it stay HAIR_COLLISION_MESH_PADDING voxels
    // away from the grid's faces. Distances are exact up to HAIR_COLLISION_MESH_BAND voxels from
    // the mesh, and nearly exact beyond. NULL for the mesh of a body, whose distances are only in
    // the hair_sdf_pool `home`.
    float* distance;
    const void* home; // NULL for all but bodies
    uint32_t generation; // number of shapes of a body so far
    float shape_lower[3], shape_upper[3]; // bounds of the current shape of a body, m
};

#define HAIR_COLLISION_MESH_PADDING 3
#define HAIR_COLLISION_MESH_BAND 2

// Build a collision mesh. `desc` is complete and its numbers are checked, except the contents of
// its arrays. On failure *out is untouched.
hair_result hair_collision_mesh_build(const hair_host* host, const hair_collision_mesh_desc* desc,
                                      hair_collision_mesh** out);

// Add a reference. Any thread. NULL is ignored.
void hair_collision_mesh_hold(const hair_collision_mesh* mesh);
// Return the number of references.
uint32_t hair_collision_mesh_holders(const hair_collision_mesh* mesh);
// Remove a reference and free the collision mesh with the last one. Any thread. NULL is ignored.
void hair_collision_mesh_release(const hair_collision_mesh* mesh);

#endif
