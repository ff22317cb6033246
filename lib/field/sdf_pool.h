// sdf_pool.h - pool of the distance grids of collision meshes. All instances of a context share one
// copy of each grid.
#ifndef HAIR_FIELD_SDF_POOL_H
#define HAIR_FIELD_SDF_POOL_H

#include "lib/collide/collision_mesh.h"
#include "lib/gl/commands.h"

struct hair_pooled_sdf {
    const hair_collision_mesh* mesh; // Referenced mesh. NULL if the place is free.
    // Number of colliders that use it. The distances of a body stay while anything refers to its
    // mesh, because they are nowhere else.
    uint32_t users;
    uint32_t first; // First of its nodes.
};

struct hair_sdf_pool {
    struct hair_gl* gl;
    GLuint nodes; // Buffer of floats, in metres.
    GLuint texture; // Buffer texture of `nodes`. 0 until hair_sdf_pool_ensure_texture().
    size_t used, room; // Used nodes and capacity.
    struct hair_pooled_sdf* pooled;
    uint32_t count, capacity; // Number of places, and capacity.
};

// Set up an empty pool, without memory or OpenGL.
void hair_sdf_pool_init(struct hair_sdf_pool* pool, struct hair_gl* gl);
// Free a pool whose users are gone or do not matter any more.
void hair_sdf_pool_free(struct hair_sdf_pool* pool);

// Add a user of `collision_mesh`. Its place stays `place` until hair_sdf_pool_release().
hair_result hair_sdf_pool_acquire(struct hair_sdf_pool* collision_meshes,
                                  const hair_collision_mesh* collision_mesh, uint32_t* place);
// Add a body as a user of its mesh. The body must write the nodes before anything reads them.
hair_result hair_sdf_pool_acquire_body(struct hair_sdf_pool* pool, const hair_collision_mesh* mesh,
                                       uint32_t* place);
// Remove a user.
void hair_sdf_pool_release(struct hair_sdf_pool* collision_meshes, uint32_t place);

// Create the buffer texture, for passes that have no storage buffer left.
hair_result hair_sdf_pool_ensure_texture(struct hair_sdf_pool* collision_meshes);

#endif
