// guides.c - selection of the strands that are simulated.
//
// From full strands the guides are chosen so that they represent the haircut. The features of a
// strand form a point. The distance between two points measures how differently two strands move.
// The set is split at the mean of the axis of largest
// variance. The halves are split again, down to one guide per cell. The guide is the strand nearest
// to the mean of its cell (Heckbert 1982, "Color image quantization for frame buffer display").
#include "lib/groom/groom_builder.h"

#include <float.h>
#include <string.h>

// Number of cuts at the mean, after which sets are halved. It bounds the recursion on any input.
#define DEEPEST 48
// Rounds of the refinement of cells. More rounds hardly change the error of followers.
#define ROUNDS 2

_Static_assert(HAIR_FEATURES <= HAIR_KD_MAX_DIMENSIONS, "a strand's marks are one point");

// The choice of guides for the strands of one group.
struct choice {
    const struct hair_groom_builder* builder;
    uint32_t group;
    const float* features;
    uint32_t* chosen; // strand of each guide of the group
    uint32_t* owner; // guide of each strand, counted from the first guide of the group
    uint32_t found;
};

// A set of strands, its mean, and the sum of squared distances from the mean along each axis.
struct cell {
    uint32_t* order;
    uint32_t count;
    double mean[HAIR_FEATURES], squared[HAIR_FEATURES];
};

static struct cell measure_cell(const struct choice* choice, uint32_t* order, uint32_t count)
{
    struct cell cell = {.order = order, .count = count};
    for (uint32_t i = 0; i < count; ++i)
        for (int a = 0; a < HAIR_FEATURES; ++a)
            cell.mean[a] += (double)choice->features[HAIR_FEATURES * (size_t)order[i] + (size_t)a];
    HAIR_ASSERT(count > 0);
    for (int a = 0; a < HAIR_FEATURES; ++a) cell.mean[a] /= count;
    for (uint32_t i = 0; i < count; ++i)
        for (int a = 0; a < HAIR_FEATURES; ++a) {
            double d = (double)choice->features[HAIR_FEATURES * (size_t)order[i] + (size_t)a] - cell.mean[a];
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
    for (int a = 0; a < HAIR_FEATURES; ++a) sum += cell->squared[a];
    return cbrt(sum * sum);
}

static void make_guide(struct choice* choice, const struct cell* cell)
{
    double min = DBL_MAX;
    uint32_t nearest = cell->order[0];
    for (uint32_t i = 0; i < cell->count; ++i) {
        double squared = 0;
        for (int a = 0; a < HAIR_FEATURES; ++a) {
            double d =
                (double)choice->features[HAIR_FEATURES * (size_t)cell->order[i] + (size_t)a] - cell->mean[a];
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
    for (uint32_t a = 1; a < HAIR_FEATURES; ++a)
        if (cell->squared[a] > cell->squared[axis]) axis = a;
    return axis;
}

// Move the strands before the mean to the front. Return their number.
static uint32_t split_cell(const struct choice* choice, const struct cell* cell)
{
    uint32_t axis = widest(cell), front = 0;
    for (uint32_t i = 0; i < cell->count; ++i) {
        uint32_t strand = cell->order[i];
        if ((double)choice->features[HAIR_FEATURES * (size_t)strand + axis] >= cell->mean[axis]) continue;
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

static bool is_of_other_group(const struct choice* choice, uint32_t strand)
{
    return hair_group_of(choice->builder, strand) != choice->group;
}

// Sum up the features of the strands of each cell. Return false if a cell is empty.
static bool sum_cells(const struct choice* choice, const uint32_t* owner, uint32_t count, double* mean,
                      uint32_t* members)
{
    memset(mean, 0, (size_t)choice->found * HAIR_FEATURES * sizeof *mean);
    memset(members, 0, choice->found * sizeof *members);
    for (uint32_t i = 0; i < count; ++i) {
        if (is_of_other_group(choice, i)) continue;
        ++members[owner[i]];
        for (size_t a = 0; a < HAIR_FEATURES; ++a)
            mean[HAIR_FEATURES * (size_t)owner[i] + a] +=
                (double)choice->features[HAIR_FEATURES * (size_t)i + a];
    }
    for (uint32_t g = 0; g < choice->found; ++g) {
        if (members[g] == 0) return false;
        for (size_t a = 0; a < HAIR_FEATURES; ++a) mean[HAIR_FEATURES * (size_t)g + a] /= members[g];
    }
    return true;
}

static float squared_from(const struct choice* choice, uint32_t strand, const float* mean)
{
    const float* own = choice->features + HAIR_FEATURES * (size_t)strand;
    float sum = 0;
    for (int a = 0; a < HAIR_FEATURES; ++a) sum += (own[a] - mean[a]) * (own[a] - mean[a]);
    return sum;
}

// Assign each strand to the nearest mean. The search begins with the strand's own.
static hair_result assign_strands(const struct choice* choice, const hair_host* host, uint32_t count,
                                  const float* mean, uint32_t* owner)
{
    struct hair_kd_tree tree;
    HAIR_TRY(hair_kd_tree_build(host, (struct hair_point_set){mean, HAIR_FEATURES}, choice->found, &tree));
    for (uint32_t i = 0; i < count; ++i) {
        if (is_of_other_group(choice, i)) continue;
        struct hair_kd_neighbor near = {
            choice->owner[i], squared_from(choice, i, mean + HAIR_FEATURES * (size_t)choice->owner[i])};
        hair_kd_tree_nearest(&tree, choice->features + HAIR_FEATURES * (size_t)i, &near, 1, 1);
        owner[i] = near.index;
    }
    hair_kd_tree_free(host, &tree);
    return HAIR_OK;
}

// Make the strand nearest to the mean of each cell its guide.
static void choose_nearest_guides(struct choice* choice, uint32_t count, const float* mean, float* squared)
{
    for (uint32_t g = 0; g < choice->found; ++g) squared[g] = INFINITY;
    for (uint32_t i = 0; i < count; ++i) {
        if (is_of_other_group(choice, i)) continue;
        uint32_t g = choice->owner[i];
        float own = squared_from(choice, i, mean + HAIR_FEATURES * (size_t)g);
        if (!(own < squared[g])) continue;
        squared[g] = own;
        choice->chosen[g] = i;
    }
}

struct refinement {
    double* sum;
    float *mean, *squared; // of each cell, and the squared distance of its guide
    uint32_t *members, *owner;
};

// Move the means to the strands that are nearest to them, and the strands to the nearest means
// (Lloyd 1982, "Least squares quantization in PCM"). Stop at cells that would be empty.
static hair_result refine_cells(struct choice* choice, const hair_host* host, uint32_t count,
                                const struct refinement* r)
{
    size_t features = (size_t)choice->found * HAIR_FEATURES;
    for (int round = 0; round <= ROUNDS; ++round) {
        if (!sum_cells(choice, round ? r->owner : choice->owner, count, r->sum, r->members)) return HAIR_OK;
        for (uint32_t i = 0; round && i < count; ++i)
            if (!is_of_other_group(choice, i)) choice->owner[i] = r->owner[i];
        for (size_t k = 0; k < features; ++k) r->mean[k] = (float)r->sum[k];
        choose_nearest_guides(choice, count, r->mean, r->squared);
        if (round < ROUNDS) HAIR_TRY(assign_strands(choice, host, count, r->mean, r->owner));
    }
    return HAIR_OK;
}

static hair_result refine(struct choice* choice, const hair_host* host, uint32_t count)
{
    size_t guides = choice->found;
    struct refinement r = {
        hair_alloc(host, guides, HAIR_FEATURES * sizeof *r.sum),
        hair_alloc(host, guides, HAIR_FEATURES * sizeof *r.mean), hair_alloc(host, guides, sizeof *r.squared),
        hair_alloc(host, guides, sizeof *r.members), hair_alloc(host, count, sizeof *r.owner)};
    hair_result result;
    if (r.sum && r.mean && r.squared && r.members && r.owner)
        result = refine_cells(choice, host, count, &r);
    else
        result = hair_fail_memory(host, "the choice of guides");
    hair_free(host, r.sum);
    hair_free(host, r.mean);
    hair_free(host, r.squared);
    hair_free(host, r.members);
    hair_free(host, r.owner);
    return result;
}

// Count the strands of each group. Return the number of groups that have strands.
static uint32_t count_groups(const struct hair_groom_builder* builder,
                             uint32_t strands[HAIR_MAX_STRAND_GROUPS])
{
    uint32_t groups = 0;
    memset(strands, 0, HAIR_MAX_STRAND_GROUPS * sizeof *strands);
    for (uint32_t i = 0; i < builder->strands.strand_count; ++i) ++strands[hair_group_of(builder, i)];
    for (uint32_t group = 0; group < HAIR_MAX_STRAND_GROUPS; ++group) groups += strands[group] > 0;
    return groups;
}

static uint32_t count_guides(const struct hair_groom_builder* builder, uint32_t groups)
{
    uint32_t strands = builder->strands.strand_count;
    uint32_t wanted = builder->desc->guide_count;
    if (builder->desc->strand_set == HAIR_STRAND_SET_GUIDES) return strands;
    if (wanted == 0) wanted = strands / 10 < 64 ? 64 : strands / 10;
    if (wanted > HAIR_MAX_GUIDES) wanted = HAIR_MAX_GUIDES;
    if (wanted < groups) wanted = groups;
    return wanted < strands ? wanted : strands;
}

// Count the given guides of each group, and one for a group without any. Return false if the groom
// chooses all guides.
static bool count_given_guides(const struct hair_groom_builder* builder,
                               const uint32_t strands[HAIR_MAX_STRAND_GROUPS],
                               uint32_t given[HAIR_MAX_STRAND_GROUPS])
{
    const uint8_t* is_guide = builder->strands.guides;
    bool is_any = false;
    memset(given, 0, HAIR_MAX_STRAND_GROUPS * sizeof *given);
    if (!is_guide || builder->desc->guide_count != HAIR_AUTO) return false;
    for (uint32_t i = 0; i < builder->strands.strand_count; ++i) {
        given[hair_group_of(builder, i)] += is_guide[i];
        is_any |= is_guide[i];
    }
    for (uint32_t group = 0; group < HAIR_MAX_STRAND_GROUPS; ++group)
        if (strands[group] && !given[group]) given[group] = 1;
    return is_any;
}

// Make the given guides of a group its guides. bind.c finds those near each strand. Return false if
// none is given.
static bool use_given_guides(struct hair_groom_builder* builder, uint32_t group)
{
    uint32_t first = builder->group_first[group], found = 0;
    for (uint32_t i = 0; i < builder->strands.strand_count; ++i) {
        if (hair_group_of(builder, i) != group) continue;
        if (builder->strands.guides[i]) builder->chosen[first + found++] = i;
        builder->owner[i] = first;
    }
    return found > 0;
}

// Choose the guides of the group to which all strands of the cell belong.
static hair_result choose_in_group(struct hair_groom_builder* builder, const struct cell* cell,
                                   uint32_t group, uint32_t guides)
{
    uint32_t first = builder->group_first[group], strands = builder->strands.strand_count;
    if (builder->has_given_guides && use_given_guides(builder, group)) return HAIR_OK;
    struct choice choice = {.builder = builder,
                            .group = group,
                            .features = builder->features,
                            .chosen = builder->chosen + first,
                            .owner = builder->owner};
    choose_guides(&choice, cell, guides, 0);
    HAIR_ASSERT(choice.found == guides);
    if (guides < cell->count) HAIR_TRY(refine(&choice, builder->host, strands));
    for (uint32_t i = 0; first && i < strands; ++i)
        if (!is_of_other_group(&choice, i)) builder->owner[i] += first;
    return HAIR_OK;
}

// Divide the guides among the groups like among the cells of a group, or as they are given. `order`
// has the strands of one group after the other, and `strands` their numbers.
static hair_result choose_by_group(struct hair_groom_builder* builder, uint32_t* order,
                                   const uint32_t strands[HAIR_MAX_STRAND_GROUPS],
                                   const uint32_t given[HAIR_MAX_STRAND_GROUPS], uint32_t groups,
                                   uint32_t guides)
{
    const struct choice all = {.features = builder->features};
    uint32_t left = builder->strands.strand_count;
    for (uint32_t group = 0; group < HAIR_MAX_STRAND_GROUPS; ++group) {
        uint32_t count = strands[group], own = 0;
        if (count) {
            struct cell front = measure_cell(&all, order, count);
            own = builder->has_given_guides ? given[group] : guides;
            if (count < left && !builder->has_given_guides) {
                struct cell back = measure_cell(&all, order + count, left - count);
                own = count_front_guides(&front, &back, guides);
                // Each of the other groups needs a guide.
                if (own > guides - --groups) own = guides - groups;
            }
            HAIR_TRY(choose_in_group(builder, &front, group, own));
        }
        builder->group_first[group + 1] = builder->group_first[group] + own;
        order += count, left -= count, guides -= own;
    }
    HAIR_ASSERT(left == 0 && guides == 0);
    return HAIR_OK;
}

static hair_result choose_all(struct hair_groom_builder* builder, uint32_t guides,
                              const uint32_t strands[HAIR_MAX_STRAND_GROUPS],
                              const uint32_t given[HAIR_MAX_STRAND_GROUPS], uint32_t groups)
{
    uint32_t count = builder->strands.strand_count;
    uint32_t* order = hair_alloc(builder->host, count, sizeof *order);
    builder->owner = hair_alloc(builder->host, count, sizeof *builder->owner);
    if (!order || !builder->owner) {
        hair_free(builder->host, order);
        return hair_fail_memory(builder->host, "the choice of guides");
    }
    uint32_t next[HAIR_MAX_STRAND_GROUPS] = {0};
    for (uint32_t group = 1; group < HAIR_MAX_STRAND_GROUPS; ++group)
        next[group] = next[group - 1] + strands[group - 1];
    for (uint32_t i = 0; i < count; ++i) order[next[hair_group_of(builder, i)]++] = i;
    hair_result result = choose_by_group(builder, order, strands, given, groups, guides);
    hair_free(builder->host, order);
    return result;
}

hair_result hair_build_guides(struct hair_groom_builder* builder)
{
    uint32_t strands[HAIR_MAX_STRAND_GROUPS], given[HAIR_MAX_STRAND_GROUPS], guides = 0;
    uint32_t groups = count_groups(builder, strands);
    builder->has_given_guides = count_given_guides(builder, strands, given);
    for (uint32_t group = 0; group < HAIR_MAX_STRAND_GROUPS; ++group) guides += given[group];
    if (!builder->has_given_guides) guides = count_guides(builder, groups);
    if (guides > HAIR_MAX_GUIDES)
        return hair_fail(builder->host, HAIR_ERROR_ARGUMENT,
                         "hair_groom_desc.strand_guides: %u guides, not in [1, %u]", guides, HAIR_MAX_GUIDES);
    HAIR_ASSERT(guides > 0);
    builder->groom->info.guide_count = guides;
    builder->chosen = hair_alloc(builder->host, guides, sizeof *builder->chosen);
    if (!builder->chosen) return hair_fail_memory(builder->host, "the choice of guides");
    if (builder->desc->strand_set == HAIR_STRAND_SET_FULL)
        return choose_all(builder, guides, strands, given, groups);
    for (uint32_t i = 0; i < guides; ++i) builder->chosen[i] = i;
    return HAIR_OK;
}
