// body_mesh.h - the collision mesh of a body, which deforms: its grid, and its vertices in it. The
// distances are on the GPU only.
#ifndef HAIR_COLLIDE_BODY_MESH_H
#define HAIR_COLLIDE_BODY_MESH_H

#include "lib/collide/collision_mesh.h"

// Write the bounds of positions to `lower` and `upper`, m. Fail if a vertex is outside the box from
// `desc->lower` to `desc->upper`.
hair_result hair_body_mesh_measure(const hair_host* host, const hair_body_desc* desc, const float* positions,
                                   size_t stride, float lower[3], float upper[3]);

// Build the mesh of a body without vertices, and write the bounds of `desc->positions`. `desc` is
// complete and its numbers are checked, except the contents of its arrays. On failure *out is
// untouched.
hair_result hair_body_mesh_build(const hair_host* host, const hair_body_desc* desc, float lower[3],
                                 float upper[3], hair_collision_mesh** out);

// Convert positions, which have been measured, to voxels from the first node.
void hair_body_mesh_place(const hair_collision_mesh* mesh, const float* positions, uint32_t count,
                          size_t stride, float* out);

// Record that the mesh has a new shape with these bounds, m.
void hair_body_mesh_change(hair_collision_mesh* mesh, const float lower[3], const float upper[3]);

#endif
