// collision_meshes.cpp - collision meshes of shapes already met, found by the shape's address and a
// hash of its numbers.
#include "lib/bullet/bullet.h"

#include <cstring>

uint64_t hair_bullet_fingerprint(uint64_t fingerprint, const void* bytes, size_t size)
{
    const unsigned char* at = static_cast<const unsigned char*>(bytes);
    for (size_t i = 0; i < size; ++i) fingerprint = (fingerprint ^ at[i]) * 0x100000001b3u;
    return fingerprint;
}

static uint32_t place_of(const hair_bullet* bullet, const btCollisionShape* shape)
{
    uint64_t hash = hair_bullet_fingerprint(0xcbf29ce484222325u, &shape, sizeof shape);
    uint32_t mask = bullet->cached_capacity - 1, place = static_cast<uint32_t>(hash ^ hash >> 32) & mask;
    // An empty slot ends the search.
    HAIR_ASSERT((bullet->cached_capacity & mask) == 0 && bullet->cached_count < bullet->cached_capacity);
    while (bullet->cached[place].shape && bullet->cached[place].shape != shape) place = (place + 1) & mask;
    return place;
}

hair_cached_shape* hair_bullet_find(hair_bullet* bullet, const btCollisionShape* shape, uint64_t fingerprint)
{
    if (!bullet->cached_count) return nullptr;
    hair_cached_shape* cached = &bullet->cached[place_of(bullet, shape)];
    if (cached->shape != shape || cached->fingerprint != fingerprint) return nullptr;
    cached->round = bullet->round;
    return cached;
}

// Rebuild the table with `capacity` slots, without the entry of `shape` and entries older than
// `rounds` rounds.
static hair_result rebuild(hair_bullet* bullet, uint32_t capacity, uint32_t rounds,
                           const btCollisionShape* shape)
{
    HAIR_ASSERT(capacity > bullet->cached_count);
    hair_cached_shape* old = bullet->cached;
    uint32_t before = bullet->cached_capacity;
    void* memory = hair_alloc(&bullet->host, capacity, sizeof *old);
    if (!memory) return hair_fail_memory(&bullet->host, "the collision meshes of shapes");
    bullet->cached = static_cast<hair_cached_shape*>(memory);
    bullet->cached_capacity = capacity;
    bullet->cached_count = 0;
    for (uint32_t i = 0; i < before; ++i) {
        if (!old[i].shape) continue;
        if (bullet->round - old[i].round > rounds || old[i].shape == shape) {
            hair_collision_mesh_destroy(old[i].mesh);
            continue;
        }
        bullet->cached[place_of(bullet, old[i].shape)] = old[i];
        ++bullet->cached_count;
    }
    hair_free(&bullet->host, old);
    return HAIR_OK;
}

hair_result hair_bullet_keep(hair_bullet* bullet, const btCollisionShape* shape, uint64_t fingerprint,
                             hair_collision_mesh* mesh)
{
    if (2 * (bullet->cached_count + 1) > bullet->cached_capacity) {
        uint32_t capacity = bullet->cached_capacity ? 2 * bullet->cached_capacity : 64;
        HAIR_TRY(rebuild(bullet, capacity, UINT32_MAX, nullptr));
    }
    hair_cached_shape* cached = &bullet->cached[place_of(bullet, shape)];
    if (cached->shape)
        hair_collision_mesh_destroy(cached->mesh); // The shape was another one then.
    else
        ++bullet->cached_count;
    HAIR_ASSERT(2 * bullet->cached_count <= bullet->cached_capacity);
    *cached = {shape, fingerprint, mesh, bullet->round};
    return HAIR_OK;
}

void hair_bullet_free_old(hair_bullet* bullet, uint32_t rounds, const btCollisionShape* shape)
{
    bool any = false;
    for (uint32_t i = 0; i < bullet->cached_capacity; ++i)
        any = any || (bullet->cached[i].shape &&
                      (bullet->cached[i].shape == shape || bullet->round - bullet->cached[i].round > rounds));
    // Without memory, the entries stay longer.
    if (any) rebuild(bullet, bullet->cached_capacity, rounds, shape);
}
