// form.h - a collision mesh: distances to a triangle mesh at the nodes of a grid in the mesh's own
// space.
#ifndef HAIR_COLLIDE_FORM_H
#define HAIR_COLLIDE_FORM_H

#include <stdatomic.h>

#include "lib/base/host.h"
#include "lib/base/math.h"

// Immutable once made, except the reference count.
struct hair_form {
    hair_host host; // owner of the memory
    atomic_uint holders;
    hair_form_info info;
    uint64_t mark; // hash of the content. Collision meshes with equal marks have equal shapes.
    uint32_t size[3]; // number of nodes along x, y, z
    float origin[3]; // position of the first node, m
    float voxel; // distance between nodes, m
    // Signed distance at each node, m, negative inside. Node (i, j, k) is at i + size[0] (j +
    // size[1] k). The surface and the room around it stay HAIR_FORM_PADDING voxels away from the
    // grid's faces. Distances are exact up to HAIR_FORM_BAND voxels from the mesh, and nearly exact
    // beyond.
    float* distance;
};

#define HAIR_FORM_PADDING 3
#define HAIR_FORM_BAND 2

// Build a collision mesh. `desc` is complete and its numbers are checked, except the contents of
// its arrays. On failure *out is untouched.
hair_result hair_form_build(const hair_host* host, const hair_form_desc* desc, hair_form** out);

// Add a reference. Any thread. NULL is ignored.
void hair_form_hold(const hair_form* form);
// Remove a reference and free the collision mesh with the last one. Any thread. NULL is ignored.
void hair_form_release(const hair_form* form);

#endif
