// guides.c - selection of the strands that are simulated.
//
// From full strands the guides are chosen so that they represent the haircut. The shape samples of
// a strand form a point in 12 dimensions. The distance between two points measures how far two
// strands are apart along their length. The set is split at the mean of the axis of largest
// variance. The halves are split again, down to one guide per cell. The guide is the strand nearest
// to the mean of its cell (Heckbert 1982, "Color image quantization for frame buffer display").
#include "lib/groom/groom_builder.h"

#include <float.h>
#include <string.h>

#define AXES (3 * HAIR_SHAPE_SAMPLES)
// Number of cuts at the mean, after which sets are halved. It bounds the recursion on any input.
#define DEEPEST 48

_Static_assert(AXES <= HAIR_KD_MAX_DIMENSIONS, "a strand's marks are one point");

struct choice {
    const float* shape_samples;
    uint32_t* chosen;
    uint32_t* owner;
    uint32_t found;
};

// A set of strands, its mean, and the sum of squared distances from the mean along each axis.
struct cell {
    uint32_t* order;
    uint32_t count;
    double mean[AXES], squared[AXES];
};

static struct cell measure_cell(const struct choice* choice, uint32_t* order, uint32_t count)
{
    struct cell cell = {.order = order, .count = count};
    for (uint32_t i = 0; i < count; ++i)
        for (int a = 0; a < AXES; ++a)
            cell.mean[a] += (double)choice->shape_samples[AXES * (size_t)order[i] + (size_t)a];
    HAIR_ASSERT(count > 0);
    for (int a = 0; a < AXES; ++a) cell.mean[a] /= count;
    for (uint32_t i = 0; i < count; ++i)
        for (int a = 0; a < AXES; ++a) {
            double d = (double)choice->shape_samples[AXES * (size_t)order[i] + (size_t)a] - cell.mean[a];
            cell.squared[a] += d * d;
        }
    return cell;
}

// Return the weight of a cell, which is proportional to the number of guides it should get.
//
// The error of the best n representatives of a density f in d dimensions is minimal if their
// density is proportional to f^(d/(d+2)) (Zador 1982). A cell of N strands at a distance of about r
// has the density f = N / r^d and the volume r^d. Its weight is their product with that power,
//
//   N^(d/(d+2)) (r^d)^(2/(d+2)) = (N r^2)^(2/3),
//
// with d = 4, two dimensions for the root and two for the shape.
static double cell_weight(const struct cell* cell)
{
    double sum = 0;
    for (int a = 0; a < AXES; ++a) sum += cell->squared[a];
    return cbrt(sum * sum);
}

static void make_guide(struct choice* choice, const struct cell* cell)
{
    double min = DBL_MAX;
    uint32_t nearest = cell->order[0];
    for (uint32_t i = 0; i < cell->count; ++i) {
        double squared = 0;
        for (int a = 0; a < AXES; ++a) {
            double d =
                (double)choice->shape_samples[AXES * (size_t)cell->order[i] + (size_t)a] - cell->mean[a];
            squared += d * d;
        }
        if (squared < min) {
            min = squared;
            nearest = cell->order[i];
        }
        choice->owner[cell->order[i]] = choice->found;
    }
    choice->chosen[choice->found++] = nearest;
}

static uint32_t widest(const struct cell* cell)
{
    uint32_t axis = 0;
    for (uint32_t a = 1; a < AXES; ++a)
        if (cell->squared[a] > cell->squared[axis]) axis = a;
    return axis;
}

// Move the strands before the mean to the front. Return their number.
static uint32_t split_cell(const struct choice* choice, const struct cell* cell)
{
    uint32_t axis = widest(cell), front = 0;
    for (uint32_t i = 0; i < cell->count; ++i) {
        uint32_t strand = cell->order[i];
        if ((double)choice->shape_samples[AXES * (size_t)strand + axis] >= cell->mean[axis]) continue;
        cell->order[i] = cell->order[front];
        cell->order[front++] = strand;
    }
    return front;
}

// Return the number of `guides` for the first of two cells. Each cell gets at least one and at most
// one per strand.
static uint32_t count_front_guides(const struct cell* front, const struct cell* back, uint32_t guides)
{
    double a = cell_weight(front), b = cell_weight(back);
    if (!(a + b > 0)) a = front->count, b = back->count;
    uint32_t wanted = (uint32_t)(guides * (a / (a + b)) + 0.5);
    uint32_t min = guides > back->count ? guides - back->count : 1;
    uint32_t max = guides - 1 < front->count ? guides - 1 : front->count;
    HAIR_ASSERT(min <= max);
    return wanted < min ? min : wanted > max ? max : wanted;
}

static void choose_guides(struct choice* choice, const struct cell* cell, uint32_t guides, uint32_t depth)
{
    HAIR_ASSERT(1 <= guides && guides <= cell->count);
    if (guides == 1) {
        make_guide(choice, cell);
        return;
    }
    uint32_t at = split_cell(choice, cell);
    if (at == 0 || at == cell->count || depth > DEEPEST) at = cell->count / 2;
    HAIR_ASSERT(0 < at && at < cell->count);
    struct cell front = measure_cell(choice, cell->order, at);
    struct cell back = measure_cell(choice, cell->order + at, cell->count - at);
    uint32_t front_guides = count_front_guides(&front, &back, guides);
    HAIR_ASSERT(1 <= front_guides && front_guides < guides);
    choose_guides(choice, &front, front_guides, depth + 1);
    choose_guides(choice, &back, guides - front_guides, depth + 1);
}

static uint32_t count_guides(const struct hair_groom_builder* builder)
{
    uint32_t strands = builder->strands.strand_count;
    uint32_t wanted = builder->desc->guide_count;
    if (builder->desc->strand_set == HAIR_STRAND_SET_GUIDES) return strands;
    if (wanted == 0) wanted = strands / 10 < 64 ? 64 : strands / 10;
    if (wanted > HAIR_MAX_GUIDES) wanted = HAIR_MAX_GUIDES;
    return wanted < strands ? wanted : strands;
}

static hair_result choose_all(struct hair_groom_builder* builder, uint32_t guides)
{
    uint32_t count = builder->strands.strand_count;
    uint32_t* order = hair_alloc(builder->host, count, sizeof *order);
    builder->owner = hair_alloc(builder->host, count, sizeof *builder->owner);
    if (!order || !builder->owner) {
        hair_free(builder->host, order);
        return hair_fail_memory(builder->host, "the choice of guides");
    }
    for (uint32_t i = 0; i < count; ++i) order[i] = i;
    struct choice choice = {
        .shape_samples = builder->shape_samples, .chosen = builder->chosen, .owner = builder->owner};
    struct cell all = measure_cell(&choice, order, count);
    choose_guides(&choice, &all, guides, 0);
    HAIR_ASSERT(choice.found == guides);
    hair_free(builder->host, order);
    return HAIR_OK;
}

hair_result hair_build_guides(struct hair_groom_builder* builder)
{
    uint32_t guides = count_guides(builder);
    HAIR_ASSERT(0 < guides && guides <= HAIR_MAX_GUIDES);
    builder->groom->info.guide_count = guides;
    builder->chosen = hair_alloc(builder->host, guides, sizeof *builder->chosen);
    if (!builder->chosen) return hair_fail_memory(builder->host, "the choice of guides");
    if (builder->desc->strand_set == HAIR_STRAND_SET_FULL) return choose_all(builder, guides);
    for (uint32_t i = 0; i < guides; ++i) builder->chosen[i] = i;
    return HAIR_OK;
}
