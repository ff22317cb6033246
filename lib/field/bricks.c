// bricks.c - selection of the bricks of the field to write again, and of the colliders that reach
// into each.
//
// A collider is left out of a brick if it is farther than the band, or if another is nearer to
// every voxel.
#include "lib/field/bricks.h"

#include <string.h>

#define MAX_PAIRS (1u << 18) // Maximum pairs in a dispatch, unless one brick has more.
// Maximum colliders of a brick in a round. A collision mesh takes longer than other shapes. A
// thread of a GPU is slower than one of a processor.
#define MAX_IN_ROUND 512
#define MAX_MESHES_IN_ROUND 128
#define MAX_IN_ROUND_SOFTWARE 8192
#define MAX_MESHES_IN_ROUND_SOFTWARE 1024

static uint32_t brick_at(const struct hair_field_box* box, uint32_t x, uint32_t y, uint32_t z)
{
    HAIR_ASSERT(x < box->bricks[0] && y < box->bricks[1] && z < box->bricks[2]);
    return (z * box->bricks[1] + y) * box->bricks[0] + x;
}

// Bricks from `first` up to, not including, `end`. overlap() returns those that a collider's band
// touches within a range.
struct brick_range {
    uint32_t first[3], end[3];
};

static struct brick_range overlap(const struct hair_placed_collider* placed, const struct brick_range* with)
{
    struct brick_range range;
    for (int i = 0; i < 3; ++i) {
        range.first[i] = placed->first[i] > with->first[i] ? placed->first[i] : with->first[i];
        range.end[i] = placed->end[i] < with->end[i] ? placed->end[i] : with->end[i];
        if (range.end[i] < range.first[i]) range.end[i] = range.first[i];
    }
    return range;
}

#define EACH_BRICK(range, x, y, z)                                                                           \
    for (uint32_t z = (range).first[2]; z < (range).end[2]; ++z)                                             \
        for (uint32_t y = (range).first[1]; y < (range).end[1]; ++y)                                         \
            for (uint32_t x = (range).first[0]; x < (range).end[0]; ++x)

static struct brick_range all_of(const struct hair_field_box* box)
{
    return (struct brick_range){{0, 0, 0}, {box->bricks[0], box->bricks[1], box->bricks[2]}};
}

// Mark the bricks that a collider changes. If others are nearer everywhere in a brick, the collider
// does not change it. When those move, they mark the brick themselves.
void hair_field_mark_dirty(struct hair_collider_field* field, const struct hair_placed_collider* placed)
{
    const struct hair_field_box* box = &field->box;
    struct brick_range all = all_of(box);
    struct brick_range range = overlap(placed, &all);
    EACH_BRICK(range, x, y, z)
    {
        uint32_t brick = brick_at(box, x, y, z);
        if (!field->dirty[brick])
            field->dirty[brick] = hair_field_find_span(box, placed, x, y, z).min <= field->best[brick];
    }
}

// Find the bounds of all marked bricks. Return the number of marked bricks.
static uint32_t find_dirty(const struct hair_collider_field* field, struct brick_range* out)
{
    const struct hair_field_box* box = &field->box;
    struct brick_range all = all_of(box);
    uint32_t count = 0;
    *out = (struct brick_range){{UINT32_MAX, UINT32_MAX, UINT32_MAX}, {0, 0, 0}};
    EACH_BRICK(all, x, y, z)
    {
        if (!field->dirty[brick_at(box, x, y, z)]) continue;
        const uint32_t at[] = {x, y, z};
        for (int i = 0; i < 3; ++i) {
            if (at[i] < out->first[i]) out->first[i] = at[i];
            if (at[i] + 1 > out->end[i]) out->end[i] = at[i] + 1;
        }
        ++count;
    }
    return count;
}

void hair_field_begin(struct hair_collider_field* field, struct hair_field_job* job)
{
    const struct hair_field_box* box = &field->box;
    struct brick_range dirty;
    memset(job, 0, sizeof *job);
    if (!find_dirty(field, &dirty)) return;
    // Compute an upper bound of each brick's member count.
    memset(field->brick_colliders, 0, hair_field_bricks(box) * sizeof *field->brick_colliders);
    for (uint32_t i = 0; i < field->count; ++i) {
        struct brick_range range = overlap(&field->placed[i], &dirty);
        EACH_BRICK(range, x, y, z) field->brick_colliders[brick_at(box, x, y, z)]++;
    }
    job->end = hair_field_bricks(box);
}

// Collider that may reach into a brick.
struct pair {
    uint32_t brick, collider;
    float min; // Lower bound of its distance to any voxel.
};

// Add marked bricks from job->next on, while their pairs fit. Return the first brick that is left.
static uint32_t take_bricks(const struct hair_collider_field* field, const struct hair_field_job* job,
                            uint32_t* bricks, size_t* pairs)
{
    HAIR_ASSERT(job->next <= job->end);
    uint32_t end = job->next;
    for (; end < job->end; ++end) {
        if (!field->dirty[end]) continue;
        if (*bricks && *pairs + field->brick_colliders[end] > MAX_PAIRS) break;
        *pairs += field->brick_colliders[end];
        ++*bricks;
    }
    return end;
}

// List the pairs by collider, then by brick. Return their number.
static uint32_t find_brick_pairs(struct hair_collider_field* field, const struct hair_field_job* job,
                                 uint32_t end, struct pair* pairs)
{
    const struct hair_field_box* box = &field->box;
    uint32_t layer = box->bricks[0] * box->bricks[1], count = 0;
    HAIR_ASSERT(job->next < end && end <= job->end);
    struct brick_range slab = all_of(box);
    slab.first[2] = job->next / layer;
    slab.end[2] = (end - 1) / layer + 1;
    for (uint32_t b = job->next; b < end; ++b)
        if (field->dirty[b]) field->best[b] = box->far;
    for (uint32_t i = 0; i < field->count; ++i) {
        struct brick_range range = overlap(&field->placed[i], &slab);
        EACH_BRICK(range, x, y, z)
        {
            uint32_t brick = brick_at(box, x, y, z);
            if (brick < job->next || brick >= end || !field->dirty[brick]) continue;
            struct hair_field_span span = hair_field_find_span(box, &field->placed[i], x, y, z);
            if (!(span.min <= field->best[brick])) continue;
            field->best[brick] = fminf(field->best[brick], span.max);
            pairs[count++] = (struct pair){brick, i, span.min};
        }
    }
    return count;
}

#define HAS_MESH 2 // Value of `dirty` for a brick that a collision mesh reaches into.

// Turn pairs into members, in the order of colliders in every brick. Write the marked bricks, of
// which those that collision meshes reach into come last. Return the number of the others.
static uint32_t sort_pairs(struct hair_collider_field* field, struct hair_field_job* job, uint32_t end,
                           const struct pair* pairs, uint32_t count, struct hair_field_brick* whole,
                           uint32_t bricks)
{
    const struct hair_field_box* box = &field->box;
    uint32_t first = 0, plain = 0, with_meshes = 0, last = HAIR_NO_COLLIDER;
    for (uint32_t b = job->next; b < end; ++b) field->brick_colliders[b] = 0;
    for (uint32_t i = 0; i < count; ++i) {
        uint32_t b = pairs[i].brick;
        if (!(pairs[i].min <= field->best[b])) continue;
        field->brick_colliders[b]++;
        if (field->placed[pairs[i].collider].mesh) field->dirty[b] = HAS_MESH;
    }
    for (uint32_t b = job->next; b < end; ++b) {
        if (!field->dirty[b]) continue;
        uint32_t x = b % box->bricks[0], y = b / box->bricks[0] % box->bricks[1],
                 z = b / box->bricks[0] / box->bricks[1], brick_colliders = field->brick_colliders[b];
        HAIR_ASSERT(x < 1024 && y < 1024 && z < 1024); // Ten bits each.
        uint32_t at = field->dirty[b] == HAS_MESH ? bricks - ++with_meshes : plain++;
        HAIR_ASSERT(at < bricks);
        whole[at] = (struct hair_field_brick){
            .at = x + (y << 10) + (z << 20), .first = first, .count = brick_colliders};
        field->brick_colliders[b] = first; // Place of the brick's next member.
        first += brick_colliders;
        field->dirty[b] = 0;
    }
    for (uint32_t i = 0; i < count; ++i) {
        const struct hair_placed_collider* placed = &field->placed[pairs[i].collider];
        if (!(pairs[i].min <= field->best[pairs[i].brick])) continue;
        if (pairs[i].collider != last) {
            HAIR_ASSERT(job->colliders < field->count);
            job->collider[job->colliders] = placed->collider;
            if (placed->mesh)
                job->collider[job->colliders].first = field->sdf_pool->pooled[placed->place].first;
            ++job->colliders;
        }
        last = pairs[i].collider;
        job->brick_collider[field->brick_colliders[pairs[i].brick]++] = job->colliders - 1;
    }
    HAIR_ASSERT(plain + with_meshes == bricks && first <= count);
    job->brick_colliders = first;
    return plain;
}

// Add bricks to the job, with at most `max` colliders in each round.
static void add_rounds(struct hair_field_job* job, const struct hair_field_brick* whole, uint32_t bricks,
                       uint32_t max)
{
    uint32_t before, round = 0;
    do {
        before = job->bricks;
        for (uint32_t i = 0; i < bricks; ++i) {
            struct hair_field_brick brick = whole[i];
            if (round && brick.count <= round * max) continue;
            brick.first += round * max;
            brick.count -= round * max;
            if (brick.count > max) brick.count = max;
            brick.round = round;
            job->brick[job->bricks++] = brick;
        }
        ++round;
    } while (job->bricks > before);
}

hair_result hair_field_next(struct hair_collider_field* field, struct hair_field_job* job)
{
    const hair_host* host = &field->gl->host;
    uint32_t at_once = field->gl->software ? MAX_IN_ROUND_SOFTWARE : MAX_IN_ROUND;
    uint32_t meshes = field->gl->software ? MAX_MESHES_IN_ROUND_SOFTWARE : MAX_MESHES_IN_ROUND;
    uint32_t bricks = 0;
    size_t max = 0;
    hair_field_end(field, job);
    job->bricks = job->brick_colliders = job->colliders = 0;
    uint32_t end = take_bricks(field, job, &bricks, &max);
    if (!bricks) return HAIR_OK;
    struct pair* pairs = hair_alloc(host, max, sizeof *pairs);
    struct hair_field_brick* whole = hair_alloc(host, bricks, sizeof *whole);
    uint32_t count = pairs ? find_brick_pairs(field, job, end, pairs) : 0;
    HAIR_ASSERT(count <= max);
    job->brick = hair_alloc(host, bricks + count / meshes, sizeof *job->brick);
    job->brick_collider = hair_alloc(host, count, sizeof *job->brick_collider);
    job->collider = hair_alloc(host, count < field->count ? count : field->count, sizeof *job->collider);
    int failed = !pairs || !whole || !job->brick || !job->brick_collider || !job->collider;
    if (!failed) {
        uint32_t plain = sort_pairs(field, job, end, pairs, count, whole, bricks);
        add_rounds(job, whole, plain, at_once);
        uint32_t first = job->bricks;
        add_rounds(job, whole + plain, bricks - plain, meshes);
        job->with_meshes = job->bricks - first;
    }
    hair_free(host, whole);
    hair_free(host, pairs);
    job->next = end;
    return failed ? hair_fail_memory(host, "what is to be written of the field") : HAIR_OK;
}

void hair_field_end(struct hair_collider_field* field, struct hair_field_job* job)
{
    hair_free(&field->gl->host, job->brick);
    hair_free(&field->gl->host, job->brick_collider);
    hair_free(&field->gl->host, job->collider);
    job->brick = NULL;
    job->brick_collider = NULL;
    job->collider = NULL;
}
