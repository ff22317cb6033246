// render_mesh.h - The mesh that is drawn beside the hair, in OpenGL buffers.
#ifndef HAIR_TOOLS_COMMON_RENDER_MESH_H
#define HAIR_TOOLS_COMMON_RENDER_MESH_H

#include "tools/common/camera.h"
#include "tools/common/head_rig.h"

// The first four buffers are vertex attributes too.
enum hair_mesh_buffer {
    HAIR_MESH_POSITIONS,
    HAIR_MESH_NORMALS,
    HAIR_MESH_COLORS,
    HAIR_MESH_SURFACE,
    HAIR_MESH_TRIANGLES,
    HAIR_MESH_BUFFERS
};

// A mesh of zeros draws nothing.
struct hair_render_mesh {
    unsigned vertex_array, buffer[HAIR_MESH_BUFFERS];
    uint32_t indices; // without fine hairs
    uint32_t fine_indices; // those of fine hairs, which are the last ones
    bool whole; // The whole mesh moves with the head.
};

// Replace the mesh. With `whole`, the whole mesh moves with the head. Otherwise it bends at the
// neck.
void hair_render_mesh_make(const struct head_mesh* mesh, bool whole, struct hair_render_mesh* out);
// Move the vertices of the mesh, which has as many as before.
void hair_render_mesh_move(const struct hair_render_mesh* mesh, const struct head_mesh* to);
void hair_render_mesh_delete(struct hair_render_mesh* mesh);

// Draw the mesh by a program of hair_mesh_vert, with or without brows, lashes and fine hairs.
void hair_render_mesh_draw(const struct hair_render_mesh* mesh, unsigned program, const float transform[16],
                           float breath, const struct hair_matrices* matrices, bool has_fine);

// Set the uniforms of hair_mesh_vert, except for the camera.
void hair_render_mesh_set_pose(unsigned program, const struct hair_head_pose* pose);

#endif
