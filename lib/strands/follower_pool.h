// follower_pool.h - buffers of followers. All instances of a groom in a context share one, except
// those whose followers differ from the groom.
#ifndef HAIR_STRANDS_FOLLOWER_POOL_H
#define HAIR_STRANDS_FOLLOWER_POOL_H

#include "lib/gl/commands.h"
#include "lib/groom/groom.h"

// Buffer of followers and of their shapes.
struct hair_follower_buffer {
    GLuint buffer;
    GLuint texture; // Buffer texture of `buffer`, for stages without storage buffers.
    float max_width; // Maximum factor of the look's radius by the groom and by groups.
    // Groom of a buffer in the pool, which nobody may write. NULL if the buffer has one user.
    const struct hair_groom* groom;
};

struct hair_pooled_followers {
    struct hair_follower_buffer followers; // Without a groom if the place is free.
    uint32_t users;
};

// The pool of a context.
struct hair_follower_pool {
    struct hair_gl* gl;
    struct hair_pooled_followers* pooled;
    uint32_t count, capacity; // Number of places, and capacity.
};

// Set up an empty pool, without memory or OpenGL.
void hair_follower_pool_init(struct hair_follower_pool* pool, struct hair_gl* gl);
// Free a pool whose users are gone.
void hair_follower_pool_free(struct hair_follower_pool* pool);
// Get the followers of a groom, to which the user must refer. Free them with
// hair_follower_pool_release().
hair_result hair_follower_pool_acquire(struct hair_follower_pool* pool, const struct hair_groom* groom,
                                       struct hair_follower_buffer* out);
// Make a buffer for one user, of followers and shapes as in the groom. Free it with
// hair_follower_pool_release().
hair_result hair_follower_pool_make(struct hair_follower_pool* pool, const struct hair_groom* groom,
                                    const struct hair_follower* followers, struct hair_follower_buffer* out);
// Free a buffer of one user, or remove a user of a pooled one. `followers` may be empty, and is
// afterwards.
void hair_follower_pool_release(struct hair_follower_pool* pool, struct hair_follower_buffer* followers);

#endif
