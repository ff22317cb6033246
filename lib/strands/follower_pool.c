// follower_pool.c - buffers of followers, each made once for all instances of a groom.
#include "lib/strands/follower_pool.h"

#include <math.h>

static float find_max_width(uint32_t count, const struct hair_follower* followers)
{
    float width = 0;
    for (uint32_t i = 0; i < count; ++i) width = fmaxf(width, followers[i].offset[0].w);
    return width;
}

static void free_followers(struct hair_gl* gl, struct hair_follower_buffer* followers)
{
    hair_gl_free_array(gl, &followers->buffer, &followers->texture);
    *followers = (struct hair_follower_buffer){0};
}

static hair_result write_followers(struct hair_gl* gl, hair_gl_category category,
                                   const struct hair_groom* groom, const struct hair_follower* followers,
                                   struct hair_follower_buffer* out)
{
    struct hair_follower_buffer made = {.max_width = find_max_width(groom->info.follower_count, followers)};
    HAIR_TRY(hair_gl_buffer(gl, category, "hair followers", hair_groom_follower_bytes(groom), followers,
                            &made.buffer));
    hair_result result =
        hair_gl_buffer_texture(gl, "hair followers", GL_RGBA32UI, made.buffer, &made.texture);
    if (result)
        free_followers(gl, &made);
    else
        *out = made;
    return result;
}

// Return the place of a groom, or a free one for NULL. NULL if there is none.
static struct hair_pooled_followers* find_pooled(struct hair_follower_pool* pool,
                                                 const struct hair_groom* groom)
{
    for (uint32_t i = 0; i < pool->count; ++i)
        if (pool->pooled[i].followers.groom == groom) return &pool->pooled[i];
    return NULL;
}

// Return a free place, or NULL without memory.
static struct hair_pooled_followers* add_pooled(struct hair_follower_pool* pool)
{
    struct hair_pooled_followers* place = find_pooled(pool, NULL);
    if (place) return place;
    if (pool->count == pool->capacity) {
        void* pooled = hair_grow(&pool->gl->host, pool->pooled, sizeof *pool->pooled, &pool->capacity, 8);
        if (!pooled) return NULL;
        pool->pooled = pooled;
    }
    place = &pool->pooled[pool->count++];
    *place = (struct hair_pooled_followers){.users = 0};
    return place;
}

static void free_empty_pool(struct hair_follower_pool* pool)
{
    for (uint32_t i = 0; i < pool->count; ++i)
        if (pool->pooled[i].users) return;
    hair_free(&pool->gl->host, pool->pooled);
    hair_follower_pool_init(pool, pool->gl);
}

void hair_follower_pool_init(struct hair_follower_pool* pool, struct hair_gl* gl)
{
    *pool = (struct hair_follower_pool){.gl = gl};
}

void hair_follower_pool_free(struct hair_follower_pool* pool)
{
    for (uint32_t i = 0; i < pool->count; ++i) {
        free_followers(pool->gl, &pool->pooled[i].followers);
        pool->pooled[i].users = 0;
    }
    free_empty_pool(pool);
}

hair_result hair_follower_pool_acquire(struct hair_follower_pool* pool, const struct hair_groom* groom,
                                       struct hair_follower_buffer* out)
{
    struct hair_pooled_followers* place = find_pooled(pool, groom);
    if (!place) {
        place = add_pooled(pool);
        hair_result result =
            place ? write_followers(pool->gl, HAIR_GL_NO_CATEGORY, groom, groom->followers, &place->followers)
                  : hair_fail_memory(&pool->gl->host, "the followers of grooms");
        if (result) {
            free_empty_pool(pool);
            return result;
        }
        place->followers.groom = groom;
    }
    ++place->users;
    *out = place->followers;
    return HAIR_OK;
}

hair_result hair_follower_pool_make(struct hair_follower_pool* pool, const struct hair_groom* groom,
                                    const struct hair_follower* followers, struct hair_follower_buffer* out)
{
    return write_followers(pool->gl, HAIR_GL_CATEGORY_COLOR, groom, followers, out);
}

void hair_follower_pool_release(struct hair_follower_pool* pool, struct hair_follower_buffer* followers)
{
    if (!followers->groom) {
        free_followers(pool->gl, followers);
        return;
    }
    struct hair_pooled_followers* place = find_pooled(pool, followers->groom);
    HAIR_ASSERT(place && place->users > 0);
    *followers = (struct hair_follower_buffer){0};
    if (--place->users) return;
    free_followers(pool->gl, &place->followers);
    free_empty_pool(pool);
}
