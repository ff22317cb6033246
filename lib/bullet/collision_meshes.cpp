// collision_meshes.cpp - collision meshes of shapes already met, found by the shape's address and a hash of
// its numbers.
#include "lib/bullet/bullet.h"

#include <cstring>

uint64_t hair_bullet_print(uint64_t print, const void* bytes, size_t size)
{
    const unsigned char* at = static_cast<const unsigned char*>(bytes);
    for (size_t i = 0; i < size; ++i) print = (print ^ at[i]) * 0x100000001b3u;
    return print;
}

static uint32_t place_of(const hair_bullet* bullet, const btCollisionShape* shape)
{
    uint64_t hash = hair_bullet_print(0xcbf29ce484222325u, &shape, sizeof shape);
    uint32_t mask = bullet->met_capacity - 1, place = static_cast<uint32_t>(hash ^ hash >> 32) & mask;
    // An empty slot ends the search.
    HAIR_ASSERT((bullet->met_capacity & mask) == 0 && bullet->met_count < bullet->met_capacity);
    while (bullet->met[place].shape && bullet->met[place].shape != shape) place = (place + 1) & mask;
    return place;
}

hair_met* hair_bullet_find(hair_bullet* bullet, const btCollisionShape* shape, uint64_t print)
{
    if (!bullet->met_count) return nullptr;
    hair_met* met = &bullet->met[place_of(bullet, shape)];
    if (met->shape != shape || met->print != print) return nullptr;
    met->round = bullet->round;
    return met;
}

// Rebuild the table with `capacity` slots, without the entry of `shape` and entries older than
// `rounds` rounds.
static hair_result rebuild(hair_bullet* bullet, uint32_t capacity, uint32_t rounds,
                           const btCollisionShape* shape)
{
    HAIR_ASSERT(capacity > bullet->met_count);
    hair_met* old = bullet->met;
    uint32_t before = bullet->met_capacity;
    void* memory = hair_alloc(&bullet->host, capacity, sizeof *old);
    if (!memory) return hair_fail_memory(&bullet->host, "the collision meshes of shapes");
    bullet->met = static_cast<hair_met*>(memory);
    bullet->met_capacity = capacity;
    bullet->met_count = 0;
    for (uint32_t i = 0; i < before; ++i) {
        if (!old[i].shape) continue;
        if (bullet->round - old[i].round > rounds || old[i].shape == shape) {
            hair_collision_mesh_destroy(old[i].form);
            continue;
        }
        bullet->met[place_of(bullet, old[i].shape)] = old[i];
        ++bullet->met_count;
    }
    hair_free(&bullet->host, old);
    return HAIR_OK;
}

hair_result hair_bullet_keep(hair_bullet* bullet, const btCollisionShape* shape, uint64_t print,
                             hair_collision_mesh* form)
{
    if (2 * (bullet->met_count + 1) > bullet->met_capacity) {
        uint32_t capacity = bullet->met_capacity ? 2 * bullet->met_capacity : 64;
        hair_result result = rebuild(bullet, capacity, UINT32_MAX, nullptr);
        if (result) return result;
    }
    hair_met* met = &bullet->met[place_of(bullet, shape)];
    if (met->shape)
        hair_collision_mesh_destroy(met->form); // The shape was another one then.
    else
        ++bullet->met_count;
    HAIR_ASSERT(2 * bullet->met_count <= bullet->met_capacity);
    *met = {shape, print, form, bullet->round};
    return HAIR_OK;
}

void hair_bullet_free_old(hair_bullet* bullet, uint32_t rounds, const btCollisionShape* shape)
{
    bool any = false;
    for (uint32_t i = 0; i < bullet->met_capacity; ++i)
        any = any || (bullet->met[i].shape &&
                      (bullet->met[i].shape == shape || bullet->round - bullet->met[i].round > rounds));
    // Without memory, the entries stay longer.
    if (any) rebuild(bullet, bullet->met_capacity, rounds, shape);
}
