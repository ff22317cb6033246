// sdf_pool.c - distance grids of collision meshes, pooled in one buffer. Unused grids are dropped
// when the buffer grows, and the buffer is freed with the last one.
#include "lib/field/sdf_pool.h"

#include <string.h>

#define MIN_ROOM 65536 // Minimum capacity, in nodes.
#define NOWHERE 1e9f // Distance at which no scale lets anything meet a mesh, m.

// Return the number of floats of a mesh. The motion of a body follows its distances.
static size_t count_nodes(const hair_collision_mesh* mesh)
{
    return (size_t)mesh->size[0] * mesh->size[1] * mesh->size[2] * (mesh->home ? 4 : 1);
}

// Write the nodes of a destroyed body so far away that nothing meets the body. Its distances were
// lost with the OpenGL context, and nobody computes them again.
static hair_result upload_nowhere(struct hair_sdf_pool* pool, const struct hair_pooled_sdf* pooled)
{
    const hair_collision_mesh* mesh = pooled->mesh;
    const hair_host* host = &pool->gl->host;
    size_t count = (size_t)mesh->size[0] * mesh->size[1] * mesh->size[2];
    float* distance = hair_alloc(host, count, sizeof *distance);
    if (!distance) return hair_fail_memory(host, "a body");
    for (size_t i = 0; i < count; ++i) distance[i] = NOWHERE;
    pool->gl->NamedBufferSubData(pool->nodes, (GLintptr)(pooled->first * sizeof *distance),
                                 (GLsizeiptr)(count * sizeof *distance), distance);
    hair_free(host, distance);
    return HAIR_OK;
}

// Write the nodes of a mesh that has `pooled->first`.
static hair_result upload_sdf(struct hair_sdf_pool* pool, const struct hair_pooled_sdf* pooled)
{
    if (!pooled->mesh->distance) return upload_nowhere(pool, pooled);
    GLintptr at = (GLintptr)(pooled->first * sizeof(float));
    pool->gl->NamedBufferSubData(pool->nodes, at, (GLsizeiptr)(count_nodes(pooled->mesh) * sizeof(float)),
                                 pooled->mesh->distance);
    return HAIR_OK;
}

// Copy the nodes of a mesh to a larger buffer. The nodes of a body are on the GPU only.
static void move_sdf(struct hair_sdf_pool* pool, GLuint buffer, struct hair_pooled_sdf* pooled)
{
    size_t count = count_nodes(pooled->mesh);
    HAIR_ASSERT(pool->used + count <= pool->room);
    hair_gl_copy_buffer(pool->gl, pool->nodes, buffer, (GLintptr)(pooled->first * sizeof(float)),
                        (GLintptr)(pool->used * sizeof(float)), (GLsizeiptr)(count * sizeof(float)));
    pooled->first = (uint32_t)pool->used;
    pool->used += count;
}

// Make a buffer that holds all used grids and `more` nodes.
static hair_result reserve_nodes(struct hair_sdf_pool* pool, size_t more)
{
    if (pool->nodes && pool->used + more <= pool->room) return HAIR_OK;
    GLuint buffer = 0;
    size_t used = 0;
    for (uint32_t i = 0; i < pool->count; ++i)
        if (pool->pooled[i].mesh) used += count_nodes(pool->pooled[i].mesh);
    size_t room = used + more + (used + more) / 2;
    if (room < MIN_ROOM) room = MIN_ROOM;
    HAIR_TRY(hair_gl_storage(pool->gl, HAIR_GL_NO_CATEGORY, "hair collision meshes", room * sizeof(float),
                             NULL, &buffer));
    pool->room = room;
    pool->used = 0;
    for (uint32_t i = 0; i < pool->count; ++i)
        if (pool->pooled[i].mesh) move_sdf(pool, buffer, &pool->pooled[i]);
    hair_gl_free_array(pool->gl, &pool->nodes, &pool->texture);
    pool->nodes = buffer;
    return HAIR_OK;
}

// Find a free place, or append one.
static hair_result reserve_place(struct hair_sdf_pool* pool, uint32_t* place)
{
    HAIR_ASSERT(pool->count <= pool->capacity);
    for (*place = 0; *place < pool->count; ++*place)
        if (!pool->pooled[*place].mesh) return HAIR_OK;
    if (pool->count == pool->capacity) {
        const hair_host* host = &pool->gl->host;
        uint32_t capacity = 2 * pool->capacity + 8;
        struct hair_pooled_sdf* pooled = hair_alloc(host, capacity, sizeof *pooled);
        if (!pooled) return hair_fail_memory(host, "the collision meshes of colliders");
        if (pool->count) memcpy(pooled, pool->pooled, pool->count * sizeof *pooled);
        hair_free(host, pool->pooled);
        pool->pooled = pooled;
        pool->capacity = capacity;
    }
    ++pool->count;
    return HAIR_OK;
}

// Drop meshes without users. A body's mesh is kept while another refers to it.
static void drop_unused(struct hair_sdf_pool* pool)
{
    for (uint32_t i = 0; i < pool->count; ++i) {
        struct hair_pooled_sdf* pooled = &pool->pooled[i];
        if (!pooled->mesh || pooled->users) continue;
        if (pooled->mesh->home && hair_collision_mesh_holders(pooled->mesh) > 1) continue;
        hair_collision_mesh_release(pooled->mesh);
        pooled->mesh = NULL;
    }
}

static void free_if_empty(struct hair_sdf_pool* pool)
{
    drop_unused(pool);
    for (uint32_t i = 0; i < pool->count; ++i)
        if (pool->pooled[i].mesh) return;
    hair_gl_free_array(pool->gl, &pool->nodes, &pool->texture);
    hair_free(&pool->gl->host, pool->pooled);
    *pool = (struct hair_sdf_pool){.gl = pool->gl};
}

void hair_sdf_pool_init(struct hair_sdf_pool* pool, struct hair_gl* gl)
{
    *pool = (struct hair_sdf_pool){.gl = gl};
}

// Add a user of a mesh. Without `is_written_later`, write the nodes of a mesh that is new.
static hair_result acquire(struct hair_sdf_pool* pool, const hair_collision_mesh* mesh, bool is_written_later,
                           uint32_t* place)
{
    for (uint32_t i = 0; i < pool->count; ++i)
        if (pool->pooled[i].mesh == mesh) {
            ++pool->pooled[i].users;
            *place = i;
            return HAIR_OK;
        }
    drop_unused(pool);
    hair_result result = reserve_nodes(pool, count_nodes(mesh));
    if (!result) result = reserve_place(pool, place);
    struct hair_pooled_sdf pooled = {.mesh = mesh, .users = 1, .first = (uint32_t)pool->used};
    HAIR_ASSERT(result || pool->used + count_nodes(mesh) <= pool->room);
    if (!result && !is_written_later) result = upload_sdf(pool, &pooled);
    if (result) {
        free_if_empty(pool);
        return result;
    }
    pool->used += count_nodes(mesh);
    hair_collision_mesh_hold(mesh);
    pool->pooled[*place] = pooled;
    return HAIR_OK;
}

hair_result hair_sdf_pool_acquire(struct hair_sdf_pool* pool, const hair_collision_mesh* mesh,
                                  uint32_t* place)
{
    HAIR_ASSERT(mesh && (mesh->distance || mesh->home == pool));
    return acquire(pool, mesh, false, place);
}

hair_result hair_sdf_pool_acquire_body(struct hair_sdf_pool* pool, const hair_collision_mesh* mesh,
                                       uint32_t* place)
{
    HAIR_ASSERT(mesh && mesh->home == pool);
    return acquire(pool, mesh, true, place);
}

void hair_sdf_pool_release(struct hair_sdf_pool* pool, uint32_t place)
{
    HAIR_ASSERT(place < pool->count);
    struct hair_pooled_sdf* pooled = &pool->pooled[place];
    HAIR_ASSERT(pooled->mesh && pooled->users > 0);
    if (--pooled->users == 0) free_if_empty(pool);
}

void hair_sdf_pool_free(struct hair_sdf_pool* pool)
{
    for (uint32_t i = 0; i < pool->count; ++i) {
        hair_collision_mesh_release(pool->pooled[i].mesh);
        pool->pooled[i].mesh = NULL;
    }
    if (pool->pooled) free_if_empty(pool);
}

hair_result hair_sdf_pool_ensure_texture(struct hair_sdf_pool* pool)
{
    if (pool->texture || !pool->nodes) return HAIR_OK;
    return hair_gl_buffer_texture(pool->gl, "hair collision meshes", GL_R32F, pool->nodes, &pool->texture);
}
