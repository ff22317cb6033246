// form.h - the shape of a solid as distances to a triangle mesh, at the nodes of a grid in the mesh's own space.
#ifndef HAIR_COLLIDE_FORM_H
#define HAIR_COLLIDE_FORM_H

#include <stdatomic.h>

#include "lib/base/host.h"
#include "lib/base/math.h"

// Immutable once made, but for how many hold it.
struct hair_form {
    hair_host host; // whose memory it is
    atomic_uint holders;
    hair_form_info info;
    uint64_t mark; // of its content: two forms of one mark are the same shape
    uint32_t size[3]; // nodes along x, y, z
    float origin[3]; // of the first node, m
    float voxel; // from node to node, m
    // m, below 0 inside; node (i, j, k) is at i + size[0] (j + size[1] k). The surface, and the room
    // around it, stay HAIR_FORM_PADDING voxels away from the grid's faces. Exact up to HAIR_FORM_BAND voxels from the mesh, beyond it as good as exact.
    float* distance;
};

#define HAIR_FORM_PADDING 3
#define HAIR_FORM_BAND 2

// `desc` is whole and its numbers have been checked, but not what its arrays hold. On failure *out is untouched.
hair_result hair_form_build(const hair_host* host, const hair_form_desc* desc, hair_form** out);

// One holder more, one less; the last one frees it. Any thread. NULL is none.
void hair_form_hold(const hair_form* form);
void hair_form_release(const hair_form* form);

#endif
