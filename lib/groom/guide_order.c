// guide_order.c - the order of guides by which small hair simulates fewer of them.
//
// A k-d tree over the roots and the tips of guides gives an order in which every aligned block of
// two, four or eight guides is a cell of neighbours. The first guide of a block is the parent of
// the others. It is the one that stands nearest to the middle of the block. The parents of large
// blocks are parents of small ones too, so that a change of level keeps them.
#include "lib/groom/groom.h"
#include "lib/groom/kd_tree.h"

#include <float.h>
#include <string.h>

#define BLOCK ((uint32_t)HAIR_MAX_GUIDE_STRIDE) // Maximum guides of a block.
#define DIMENSIONS 7 // Root, tip and group.
#define GROUP_DISTANCE 1e3f // Distance between groups in the order, m. Blocks rarely mix them.
#define NOBODY UINT32_MAX

static void write_point(const struct hair_groom* groom, uint32_t guide, float* point)
{
    const struct hair_guide* own = &groom->guides[guide];
    hair_vec4 root = groom->rest[own->first].position;
    hair_vec4 tip = groom->rest[own->first + own->count - 1].position;
    const float at[DIMENSIONS] = {
        root.x, root.y, root.z, tip.x, tip.y, tip.z, GROUP_DISTANCE * (float)own->group};
    memcpy(point, at, sizeof at);
}

// Split `count` guides into cells, whose sizes are whole blocks, or powers of two within a block.
static void split_guides(struct hair_point_set points, uint32_t* order, uint32_t count)
{
    if (count < 2) return;
    uint32_t front = BLOCK;
    if (count > BLOCK)
        front = (count / 2 + BLOCK - 1) / BLOCK * BLOCK;
    else
        while (front >= count) front /= 2;
    HAIR_ASSERT(0 < front && front < count);
    uint32_t made =
        hair_kd_split(points, order, count, hair_kd_widest_axis(points, order, count), NULL, front);
    HAIR_ASSERT(made == front);
    split_guides(points, order, made);
    split_guides(points, order + made, count - made);
}

// Return the guide nearest to the middle of a cell.
static uint32_t find_parent(struct hair_point_set points, const uint32_t* order, uint32_t count)
{
    double middle[DIMENSIONS] = {0}, min = DBL_MAX;
    uint32_t nearest = order[0];
    for (uint32_t i = 0; i < count; ++i)
        for (uint32_t a = 0; a < DIMENSIONS; ++a)
            middle[a] += (double)points.points[DIMENSIONS * (size_t)order[i] + a] / count;
    for (uint32_t i = 0; i < count; ++i) {
        double squared = 0;
        for (uint32_t a = 0; a < DIMENSIONS; ++a) {
            double d = (double)points.points[DIMENSIONS * (size_t)order[i] + a] - middle[a];
            squared += d * d;
        }
        if (squared < min) min = squared, nearest = order[i];
    }
    return nearest;
}

static void swap_halves(uint32_t* order, uint32_t half)
{
    for (uint32_t i = 0; i < half; ++i) {
        uint32_t kept = order[i];
        order[i] = order[half + i];
        order[half + i] = kept;
    }
}

// Bring the parent of a block to its front, and the parents of its halves to theirs. `parent` is
// NOBODY, or a guide of the block that has been chosen. Only whole blocks can swap their halves.
static void lead_block(struct hair_point_set points, uint32_t* order, uint32_t count, uint32_t parent)
{
    uint32_t half = BLOCK;
    if (count < 2) return;
    while (half >= count) half /= 2;
    bool is_whole = count == 2 * half;
    if (is_whole && parent == NOBODY) parent = find_parent(points, order, count);
    bool is_behind = false;
    for (uint32_t i = half; i < count; ++i) is_behind |= order[i] == parent;
    if (is_whole && is_behind) swap_halves(order, half);
    lead_block(points, order, half, is_whole ? parent : NOBODY);
    lead_block(points, order + half, count - half, NOBODY);
}

hair_result hair_order_guides(struct hair_groom* groom)
{
    uint32_t count = groom->info.guide_count;
    uint32_t* order = groom->guide_order = hair_alloc_undefined(&groom->host, count, sizeof *order);
    float* at = hair_alloc_undefined(&groom->host, count, DIMENSIONS * sizeof *at);
    if (!order || !at) {
        hair_free(&groom->host, at);
        return hair_fail_memory(&groom->host, "the order of guides");
    }
    const struct hair_point_set points = {.points = at, .dimensions = DIMENSIONS};
    for (uint32_t i = 0; i < count; ++i) {
        order[i] = i;
        write_point(groom, i, at + DIMENSIONS * (size_t)i);
    }
    split_guides(points, order, count);
    for (uint32_t i = 0; i < count; i += BLOCK)
        lead_block(points, order + i, count - i < BLOCK ? count - i : BLOCK, NOBODY);
    hair_free(&groom->host, at);
    return HAIR_OK;
}
