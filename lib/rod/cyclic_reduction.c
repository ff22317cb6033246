// cyclic_reduction.c - parallel cyclic reduction (Hockney 1965) of the implicit systems for a work
// group. The matrix is constant, so its part of the reduction is done here. Shaders reduce only the
// right side.
//
// Pairs of vertices turn the five diagonals of a system into three diagonals of 2x2 blocks. Round n
// eliminates the blocks B - 2^n and B + 2^n from the row of block B. The right side r changes by
//
//   r_B += a r_(B-2^n) + c r_(B+2^n)
//
// where a and c are 2x2 blocks. After the last round the solution is x = D^-1 r, where D is the
// remaining diagonal block. Each vertex stores a row of a and a row of c per round. Bending reaches
// less far in shorter substeps, so rounds that influence no vertex are left out.
#include "lib/rod/rod.h"

#include <math.h>
#include <string.h>

#define MAX_BLOCKS (HAIR_MAX_GUIDE_VERTICES / 2)
// Influence on a vertex's displacement over a substep of 1/240 s, as a fraction, that may be
// neglected. The fraction shrinks with the cube of shorter substeps, so that the accumulated error
// stays of second order.
#define HEARD 1e-4

// A 2x2 block, row by row.
struct block {
    double m[4];
};
struct block_row {
    struct block before, own, after;
};

static struct block times(struct block a, struct block b)
{
    return (struct block){{a.m[0] * b.m[0] + a.m[1] * b.m[2], a.m[0] * b.m[1] + a.m[1] * b.m[3],
                           a.m[2] * b.m[0] + a.m[3] * b.m[2], a.m[2] * b.m[1] + a.m[3] * b.m[3]}};
}

static struct block plus(struct block a, struct block b)
{
    return (struct block){{a.m[0] + b.m[0], a.m[1] + b.m[1], a.m[2] + b.m[2], a.m[3] + b.m[3]}};
}

static struct block inverse(struct block a)
{
    // Pivots of a positive definite system are positive definite.
    HAIR_ASSERT(a.m[0] > 0 && a.m[0] * a.m[3] - a.m[1] * a.m[2] > 0);
    double d = 1 / (a.m[0] * a.m[3] - a.m[1] * a.m[2]);
    return (struct block){{a.m[3] * d, -a.m[1] * d, -a.m[2] * d, a.m[0] * d}};
}

static struct block minus_times_inverse(struct block a, struct block b)
{
    struct block c = times(a, inverse(b));
    return (struct block){{-c.m[0], -c.m[1], -c.m[2], -c.m[3]}};
}

// Return the entry (i, j) of L D L^T, where j <= i <= j + 2. Beyond the last vertex, return that of
// the identity.
static double entry(const struct hair_rod* rod, uint32_t count, uint32_t i, uint32_t j)
{
    HAIR_ASSERT(j <= i && i <= j + 2);
    if (i >= count) return i == j;
    double sum = 0;
    for (uint32_t k = i < 2 ? 0 : i - 2; k <= j; ++k) {
        const hair_vec4* f = &rod[k].factor;
        double l[3] = {1, (double)f->y, (double)f->z};
        sum += l[i - k] * l[j - k] / (double)f->x;
    }
    return sum;
}

static struct block_row row_of_block(const struct hair_rod* rod, uint32_t count, uint32_t block)
{
    uint32_t i = 2 * block;
    double off = entry(rod, count, i + 1, i);
    struct block_row row = {.own = {{entry(rod, count, i, i), off, off, entry(rod, count, i + 1, i + 1)}}};
    if (i > 0)
        row.before = (struct block){
            {entry(rod, count, i, i - 2), entry(rod, count, i, i - 1), 0, entry(rod, count, i + 1, i - 1)}};
    if (i + 2 < count)
        row.after = (struct block){{entry(rod, count, i + 2, i), 0, entry(rod, count, i + 2, i + 1),
                                    entry(rod, count, i + 3, i + 1)}};
    return row;
}

static void write_round(const struct hair_guide* guide, uint32_t block, struct block a, struct block c,
                        hair_vec4* out)
{
    for (uint32_t r = 0; r < 2 && 2 * block + r < guide->count; ++r)
        out[guide->first + 2 * block + r] =
            (hair_vec4){(float)a.m[2 * r], (float)a.m[2 * r + 1], (float)c.m[2 * r], (float)c.m[2 * r + 1]};
}

static double min_heard(double substep, int is_free)
{
    double ratio = 240 * substep;
    return is_free ? 0 : HEARD * fmin(ratio * ratio * ratio, 1); // Free strands move as a whole.
}

// Return the maximum influence of displacements d_j on d_i = a r_j / D_i, where r_j = D_j d_j.
static double fraction_of(struct block a, struct block own, struct block far)
{
    double max = 0;
    for (int i = 0; i < 2; ++i)
        for (int j = 0; j < 2; ++j) max = fmax(max, fabs(a.m[2 * i + j] * far.m[3 * j] / own.m[3 * i]));
    return max;
}

// Reduce the system of a guide. Write to `last` the final solve. Return the number of rounds before
// it, after which the influence is at most `min`.
static uint32_t reduce_guide(const struct hair_guide* guide, const struct hair_rod* rod, uint32_t vertices,
                             double min, hair_vec4* out, hair_vec4* last)
{
    static const struct block none = {{0, 0, 0, 0}};
    uint32_t count = (guide->count + 1) / 2, round = 0, heard = 0;
    HAIR_ASSERT(0 < count && count <= MAX_BLOCKS);
    struct block_row row[2][MAX_BLOCKS];
    struct block solve[MAX_BLOCKS]; // Final solve after the rounds that are needed so far.
    for (uint32_t b = 0; b < count; ++b) row[0][b] = row_of_block(rod, guide->count, b);
    for (uint32_t b = 0; b < count; ++b) solve[b] = inverse(row[0][b].own);
    for (uint32_t reach = 1; reach < count; reach *= 2, ++round) {
        const struct block_row* from = row[round % 2];
        struct block_row* to = row[(round + 1) % 2];
        for (uint32_t b = 0; b < count; ++b) {
            const struct block_row* up = b >= reach ? &from[b - reach] : NULL;
            const struct block_row* down = b + reach < count ? &from[b + reach] : NULL;
            struct block a = up ? minus_times_inverse(from[b].before, up->own) : none;
            struct block c = down ? minus_times_inverse(from[b].after, down->own) : none;
            to[b].before = up ? times(a, up->before) : none;
            to[b].after = down ? times(c, down->after) : none;
            to[b].own = plus(from[b].own,
                             plus(up ? times(a, up->after) : none, down ? times(c, down->before) : none));
            write_round(guide, b, a, c, out + (size_t)round * vertices);
            double fraction = fmax(up ? fraction_of(a, from[b].own, up->own) : 0,
                                   down ? fraction_of(c, from[b].own, down->own) : 0);
            if (!(fraction <= min)) heard = round + 1;
        }
        for (uint32_t b = 0; b < count && heard == round + 1; ++b) solve[b] = inverse(to[b].own);
    }
    HAIR_ASSERT(heard <= round);
    for (uint32_t b = 0; b < count; ++b) write_round(guide, b, solve[b], none, last);
    // Other guides may need more rounds. Fill the rounds that this guide does not need with zeros.
    for (uint32_t n = heard; n < round; ++n)
        memset(out + (size_t)n * vertices + guide->first, 0, guide->count * sizeof *out);
    return heard;
}

uint32_t hair_rods_rounds(uint32_t max_vertices)
{
    uint32_t rounds = 1;
    for (uint32_t reach = 1; reach < (max_vertices + 1) / 2; reach *= 2) ++rounds;
    return rounds;
}

bool hair_rods_have_system(const struct hair_rod* rod)
{
    return rod->factor.x > 0;
}

uint32_t hair_rods_write_reduction(const struct hair_guide* guide, const struct hair_rod* rod,
                                   uint32_t vertices, double substep, hair_vec4* out, hair_vec4* last)
{
    if (!hair_rods_have_system(rod)) return 0;
    double min = min_heard(substep, rod->segment.y > 0);
    uint32_t rounds = reduce_guide(guide, rod, vertices, min, out, last);
    HAIR_ASSERT(rounds < hair_rods_rounds(guide->count));
    return rounds;
}

void hair_rods_add_final_solve(const struct hair_guide* guides, uint32_t count, uint32_t vertices,
                               uint32_t rounds, const hair_vec4* last, hair_vec4* out)
{
    for (uint32_t i = 0; i < count; ++i) { // Guides may have fewer rounds of their own.
        uint32_t own = hair_rods_rounds(guides[i].count) - 1, first = guides[i].first;
        hair_vec4* to = out + (size_t)(own < rounds ? own : rounds) * vertices + first;
        memcpy(to, last + first, guides[i].count * sizeof *out);
    }
}
