// patches.c - followers in draw order: patches of neighbours, each well filled.
//
// Root bins are split along the axis of largest extent, in proportion to the patches that each side
// will fill. The halves are split again until each fits into one patch. This is the packing of an
// R-tree (Leutenegger et al. 1997, "STR").
#include "lib/groom/groom_builder.h"

#define ALIKE (1.0f / 16) // Maximum difference of densities within a patch.

struct patch_layout {
    struct hair_groom_builder* builder;
    struct hair_point_set centres;
    uint32_t* queue; // candidates in the order of their followers
    uint32_t queued;
    struct hair_patch* patches;
    uint32_t patch_count;
};

static float density_of(const struct patch_layout* layout, uint32_t bin)
{
    return layout->builder->bin_density ? layout->builder->bin_density[bin] : 1;
}

static uint64_t count_patch_candidates(const struct patch_layout* layout, const uint32_t* order,
                                       uint32_t count)
{
    uint64_t sum = 0;
    for (uint32_t i = 0; i < count; ++i) sum += layout->builder->bin_candidates[order[i]];
    return sum;
}

static bool are_similar(const struct patch_layout* layout, const uint32_t* order, uint32_t count)
{
    float min = 1, max = 0;
    for (uint32_t i = 0; i < count; ++i) {
        float density = density_of(layout, order[i]);
        if (density < min) min = density;
        if (density > max) max = density;
    }
    return max - min <= ALIKE;
}

// Shuffle the candidates, because cutting off the end of a patch must thin it evenly.
static void shuffle(uint32_t* queue, uint32_t count, uint32_t random)
{
    for (uint32_t i = count; i > 1; --i) {
        uint32_t j = (uint32_t)((double)hair_random(&random) * i);
        HAIR_ASSERT(j < i);
        uint32_t was = queue[i - 1];
        queue[i - 1] = queue[j];
        queue[j] = was;
    }
}

// Interleave the candidates of scattered root bins.
//
// Any run of candidates of a root bin is spread evenly over it, which thins a patch more evenly
// than a random order. The candidates of one root bin therefore keep their order. Each root bin
// contributes its candidates at even distances, from a random start.
static void merge_queue(const struct hair_groom_builder* builder, uint32_t* queue, uint32_t count)
{
    HAIR_ASSERT(count <= HAIR_MAX_ISOLINES);
    float from[HAIR_MAX_ISOLINES];
    for (uint32_t i = 0; i < count; ++i) {
        uint32_t bin = builder->scalp_points[queue[i]].triangle, random = hair_candidate_random(builder, bin);
        float at = (float)(queue[i] - builder->bin_first[bin]) + hair_random(&random);
        from[i] = at / (float)builder->bin_candidates[bin];
    }
    hair_sort_by_density(queue, from, count);
}

// Make one patch, or the minimum number of patches of even size if one cannot hold all.
static void make_patches(struct patch_layout* layout, uint32_t first, uint32_t total, float density)
{
    HAIR_ASSERT(total > 0 && first + total <= layout->queued);
    if (layout->builder->is_scattered && total <= HAIR_MAX_ISOLINES)
        merge_queue(layout->builder, layout->queue + first, total);
    // One root bin keeps its order.
    else if (!layout->builder->is_scattered || layout->builder->map_density)
        shuffle(layout->queue + first, total, layout->builder->desc->seed ^ hair_hash(first));
    uint32_t parts = (total - 1) / HAIR_MAX_ISOLINES + 1;
    for (uint32_t i = 0; i < parts; ++i) {
        uint32_t begin = (uint32_t)((uint64_t)total * i / parts);
        uint32_t end = (uint32_t)((uint64_t)total * (i + 1) / parts);
        struct hair_patch patch = {.first = first + begin, .count = end - begin, .density = density};
        HAIR_ASSERT(0 < patch.count && patch.count <= HAIR_MAX_ISOLINES);
        hair_map_patch(layout->builder, layout->queue + patch.first, &patch);
        layout->patches[layout->patch_count++] = patch;
    }
}

// Split the candidates by the map value that differs too much, until maps allow one patch for each
// part.
static void part(struct patch_layout* layout, uint32_t first, uint32_t total, float density)
{
    for (;;) {
        uint32_t front = hair_map_split(layout->builder, layout->queue + first, total);
        if (front == 0) break;
        HAIR_ASSERT(front < total);
        part(layout, first, front, density);
        first += front;
        total -= front;
    }
    make_patches(layout, first, total, density);
}

static void fill_patches(struct patch_layout* layout, const uint32_t* order, uint32_t count)
{
    const struct hair_groom_builder* builder = layout->builder;
    uint32_t first = layout->queued;
    double sum = 0;
    for (uint32_t i = 0; i < count; ++i) {
        uint32_t candidates = builder->bin_candidates[order[i]];
        for (uint32_t j = 0; j < candidates; ++j)
            layout->queue[layout->queued++] = builder->bin_first[order[i]] + j;
        sum += (double)density_of(layout, order[i]) * candidates;
    }
    uint32_t total = layout->queued - first;
    part(layout, first, total, (float)(sum / total));
}

static void lay_out(struct patch_layout* layout, uint32_t* order, uint32_t count)
{
    for (;;) {
        HAIR_ASSERT(count > 0);
        uint64_t total = count_patch_candidates(layout, order, count);
        if (count == 1 || (total <= HAIR_MAX_ISOLINES && are_similar(layout, order, count))) {
            fill_patches(layout, order, count);
            return;
        }
        uint64_t parts = (total - 1) / HAIR_MAX_ISOLINES + 1;
        uint64_t target = parts > 1 ? total * (parts / 2) / parts : total / 2;
        uint32_t axis = hair_kd_widest_axis(layout->centres, order, count);
        uint32_t front =
            hair_kd_split(layout->centres, order, count, axis, layout->builder->bin_candidates, target);
        HAIR_ASSERT(0 < front && front < count);
        lay_out(layout, order, front);
        order += front;
        count -= front;
    }
}

// List the root bins that have candidates. Return their number.
static uint32_t list_bins(const struct hair_groom_builder* builder, uint32_t* order)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < builder->bin_count; ++i)
        if (builder->bin_candidates[i]) order[count++] = i;
    return count;
}

hair_result hair_build_patches(struct hair_groom_builder* builder)
{
    // There is at most one patch per root bin, plus the further patches of large root bins. With
    // maps, there is at most one patch per candidate.
    uint32_t max = builder->bin_count + builder->candidate_count / HAIR_MAX_ISOLINES;
    if (builder->map_density) max = builder->candidate_count;
    struct hair_groom* groom = builder->groom;
    uint32_t* order = hair_alloc_undefined(builder->host, builder->bin_count, sizeof *order);
    uint32_t* queue = hair_alloc_undefined(builder->host, builder->candidate_count, sizeof *queue);
    struct patch_layout layout = {.builder = builder, .centres = {builder->bin_centres, 3}, .queue = queue};
    builder->place = hair_alloc_undefined(builder->host, builder->candidate_count, sizeof *builder->place);
    layout.patches = groom->patches = hair_alloc(builder->host, max, sizeof *groom->patches);
    hair_result result = HAIR_OK;
    if (order && queue && builder->place && groom->patches) {
        lay_out(&layout, order, list_bins(builder, order));
        HAIR_ASSERT(layout.queued == builder->candidate_count && layout.patch_count <= max);
        for (uint32_t i = 0; i < builder->candidate_count; ++i) builder->place[queue[i]] = i;
        groom->info.patch_count = layout.patch_count;
    } else {
        result = hair_fail_memory(builder->host, "patches");
    }
    hair_free(builder->host, order);
    hair_free(builder->host, queue);
    return result;
}
