// match.c - matching of colliders by key. The order is mostly that of the previous step. Otherwise
// both are sorted and merged.
#include "lib/collide/match.h"

#include <stdlib.h>
#include <string.h>

struct key_place {
    uint64_t key;
    uint32_t index;
};

static int compare_keys(const void* a, const void* b)
{
    const struct key_place *x = a, *y = b;
    int by_key = (x->key > y->key) - (x->key < y->key);
    return by_key ? by_key : (x->index > y->index) - (x->index < y->index);
}

static uint64_t key_of_collider(const hair_collider* colliders, uint32_t i, size_t stride)
{
    hair_collider collider;
    memcpy(&collider, (const unsigned char*)colliders + i * stride, sizeof collider);
    return collider.key;
}

static void sort_by_key(const hair_collider* colliders, uint32_t count, size_t stride, struct key_place* out)
{
    for (uint32_t i = 0; i < count; ++i)
        out[i] = (struct key_place){key_of_collider(colliders, i, stride), i};
    if (count) qsort(out, count, sizeof *out, compare_keys);
}

static void merge_places(const struct key_place* now, uint32_t count, const struct key_place* previous,
                         uint32_t previous_count, uint32_t* match)
{
    uint32_t i = 0, k = 0;
    while (i < count && k < previous_count)
        if (now[i].key == previous[k].key)
            match[now[i++].index] = previous[k++].index;
        else if (now[i].key < previous[k].key)
            ++i;
        else
            ++k;
}

hair_result hair_match_colliders(const hair_host* host, const hair_collider* now, uint32_t count,
                                 size_t stride, const hair_collider* previous, uint32_t previous_count,
                                 uint32_t* match)
{
    uint32_t both = count < previous_count ? count : previous_count, same = 0;
    while (same < both && key_of_collider(now, same, stride) == previous[same].key) ++same;
    if (same == both) {
        for (uint32_t i = 0; i < count; ++i) match[i] = i < both ? i : UINT32_MAX;
        return HAIR_OK;
    }
    struct key_place* places = hair_alloc(host, (size_t)count + previous_count, sizeof *places);
    if (!places) return hair_fail_memory(host, "the order of colliders");
    sort_by_key(now, count, stride, places);
    sort_by_key(previous, previous_count, sizeof *previous, places + count);
    for (uint32_t i = 0; i < count; ++i) match[i] = UINT32_MAX;
    merge_places(places, count, places + count, previous_count, match);
    hair_free(host, places);
    return HAIR_OK;
}
