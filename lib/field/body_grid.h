// body_grid.h - the signed distance to a body on the GPU, computed again whenever its vertices have
// moved. The distances are in the pool of collision meshes, where everything reads them.
#ifndef HAIR_FIELD_BODY_GRID_H
#define HAIR_FIELD_BODY_GRID_H

#include "lib/field/sdf_pool.h"

struct hair_body_grid {
    struct hair_gl* gl;
    struct hair_sdf_pool* pool; // Pool of the context.
    hair_collision_mesh* mesh; // Mesh of the body, whose owner has a reference.
    uint32_t place; // Place of the mesh in the pool.
    uint32_t vertex_count, triangle_count;
    GLuint params; // Uniform buffer.
    GLuint upload; // Buffer from which the GPU copies the positions.
    GLuint position, before, triangle; // See HAIR_BIND_BODY_POSITION and after.
    bool has_shape; // True once there are positions.
    GLuint nearest, crossing, point, change; // Buffers that the passes use among themselves.
};

// Create the buffers of a body, and its place in the pool. On failure hair_body_grid_destroy()
// frees what there is. [GL], with the context entered.
hair_result hair_body_grid_create(struct hair_body_grid* grid, struct hair_sdf_pool* pool,
                                  hair_collision_mesh* mesh, const uint32_t* triangles,
                                  uint32_t triangle_count, uint32_t vertex_count);
void hair_body_grid_destroy(struct hair_body_grid* grid);

// Compute the distances to the triangles with vertices at `positions`, in voxels from the first
// node.
void hair_body_grid_update(struct hair_body_grid* grid, const float* positions);

// Positions in a buffer of the application, in m.
struct hair_body_input {
    GLuint buffer;
    size_t offset, size; // bytes that are bound
    uint32_t first, stride; // first number among those, and numbers from vertex to vertex
    const float *lower, *upper; // box of the body, m
};
// Compute the distances to the triangles with vertices in a buffer.
hair_result hair_body_grid_update_from(struct hair_body_grid* grid, const struct hair_body_input* input);

#endif
