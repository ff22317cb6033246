// strands.c - imported strands made valid for simulation: scaled, rotated, thinned out, repaired,
// resampled.
//
// Except for resampling to more vertices, this happens in place. Strands that are kept move to the
// front of their task, and then the strands of all tasks together.
#include "lib/asset/strands.h"

#include <string.h>

// Maximum distance from the origin, m. Beyond it floats are far too coarse for hair.
#define FARTHEST 1e6
#define MIN_STRANDS 64 // Minimum number of strands of a task.

void hair_strands_free(const hair_host* host, struct hair_strands* strands)
{
    hair_free(host, strands->positions);
    hair_free(host, strands->vertices);
    hair_free(host, strands->radii);
    hair_free(host, strands->colors);
    hair_free(host, strands->groups);
    hair_free(host, strands->guides);
    for (int k = 0; k < HAIR_ATTRIBUTE_KINDS; ++k) hair_free(host, strands->factors[k]);
    memset(strands, 0, sizeof *strands);
}

static void reverse(float* p, uint32_t vertices)
{
    if (vertices < 2) return;
    for (size_t i = 0, j = vertices - 1; i < j; ++i, --j) {
        hair_vec3 swap = hair_load3(p + 3 * i);
        memcpy(p + 3 * i, p + 3 * j, sizeof swap);
        hair_store3(p + 3 * j, swap);
    }
}

static float* colors_of(const struct hair_strands* strands, uint32_t strand)
{
    return strands->colors + 3 * HAIR_STRAND_COLORS * (size_t)strand;
}

// Counts of what is kept so far. Writing never overtakes reading.
struct kept {
    uint32_t strands, vertices;
};

static void move(void* array, size_t size, uint32_t to, uint32_t from, uint32_t count)
{
    if (array) memmove((char*)array + to * size, (char*)array + from * size, count * size);
}

// Move what `count` strands have beside their vertices.
static void move_rest(struct hair_strands* strands, uint32_t to, uint32_t from, uint32_t count)
{
    if (to == from) return;
    move(strands->radii, sizeof *strands->radii, to, from, count);
    move(strands->groups, sizeof *strands->groups, to, from, count);
    move(strands->guides, sizeof *strands->guides, to, from, count);
    for (int k = 0; k < HAIR_ATTRIBUTE_KINDS; ++k)
        move(strands->factors[k], sizeof *strands->factors[k], to, from, count);
    move(strands->colors, 3 * HAIR_STRAND_COLORS * sizeof *strands->colors, to, from, count);
}

static void move_vertices(struct hair_strands* strands, uint32_t to, size_t from, uint32_t count)
{
    if (to == from) return;
    memmove(strands->positions + 3 * (size_t)to, strands->positions + 3 * from,
            3 * (size_t)count * sizeof *strands->positions);
}

static void keep_strand(struct hair_strands* strands, struct kept* kept, uint32_t strand, size_t first,
                        uint32_t vertices)
{
    HAIR_ASSERT(kept->strands <= strand && kept->vertices <= first);
    move_vertices(strands, kept->vertices, first, vertices);
    strands->vertices[kept->strands] = vertices;
    move_rest(strands, kept->strands, strand, 1);
    ++kept->strands;
    kept->vertices += vertices;
}

static void truncate_strands(struct hair_strands* strands, struct kept kept)
{
    HAIR_ASSERT(kept.strands <= strands->strand_count);
    strands->strand_count = kept.strands;
    strands->vertex_count = kept.vertices;
}

// Draw one random strand out of run `run` of `wanted` runs of equal length. The selection is even
// along the file, whatever its order, and has no rhythm that could coincide with one of the file.
static uint32_t draw_random(uint32_t count, uint32_t wanted, uint32_t run, uint32_t* random)
{
    HAIR_ASSERT(run < wanted && wanted <= count);
    uint32_t begin = (uint32_t)((uint64_t)run * count / wanted);
    uint32_t end = (uint32_t)(((uint64_t)run + 1) * count / wanted);
    HAIR_ASSERT(begin < end && end <= count);
    return begin + (uint32_t)((double)hair_random(random) * (end - begin));
}

static void thin_out(const hair_import* import, struct hair_strands* strands)
{
    uint32_t count = strands->strand_count;
    uint32_t wanted = (uint32_t)((double)import->keep_fraction * count + 0.5);
    if (wanted >= count) return;
    if (wanted == 0) wanted = 1;

    uint32_t random = import->seed;
    uint32_t drawn = draw_random(count, wanted, 0, &random);
    struct kept kept = {0};
    size_t first = 0;
    for (uint32_t i = 0; i < count && kept.strands < wanted; ++i) {
        uint32_t vertices = strands->vertices[i]; // Read before keep_strand() may write there.
        if (i == drawn) {
            keep_strand(strands, &kept, i, first, vertices);
            if (kept.strands < wanted) drawn = draw_random(count, wanted, kept.strands, &random);
        }
        first += vertices;
    }
    truncate_strands(strands, kept);
}

static uint32_t remove_nonfinite(float* p, uint32_t vertices)
{
    uint32_t left = 0;
    for (size_t i = 0; i < vertices; ++i) {
        double x = p[3 * i], y = p[3 * i + 1], z = p[3 * i + 2];
        if (!(x * x + y * y + z * z <= FARTHEST * FARTHEST)) continue; // NaN fails too.
        memmove(p + 3 * (size_t)left++, p + 3 * i, 3 * sizeof *p);
    }
    return left;
}

// Sample a strand at `count` points, out of place. Samples of a strand that folds back on itself
// may coincide. They are merged, and segments are split instead. Return the vertices left: `count`,
// or 0 if the strand is dropped.
static uint32_t resample_strand(const float* p, uint32_t vertices, float* out, uint32_t count,
                                hair_import_stats* repairs)
{
    hair_strand_resample(p, vertices, out, count);
    uint32_t left = hair_strand_merge(out, count);
    if (left < 2) {
        ++repairs->dropped_single;
        return 0;
    }
    hair_strand_split(out, left, count);
    if (hair_strand_is_fit(out, count)) return count;
    // The ends meet, or floats cannot resolve this many vertices so far from the origin.
    ++repairs->dropped_short;
    return 0;
}

static uint32_t bring_down(float* p, uint32_t vertices, hair_import_stats* repairs)
{
    HAIR_ASSERT(vertices > HAIR_STRAND_MAX_VERTICES);
    float sampled[3 * HAIR_STRAND_MAX_VERTICES];
    ++repairs->resampled;
    uint32_t left = resample_strand(p, vertices, sampled, HAIR_STRAND_MAX_VERTICES, repairs);
    memcpy(p, sampled, 3 * (size_t)left * sizeof *p);
    return left;
}

// Repair a strand. Return the vertices left, or 0 if the strand is dropped.
static uint32_t repair_strand(float* p, uint32_t vertices, hair_import_stats* repairs)
{
    uint32_t finite = remove_nonfinite(p, vertices);
    repairs->removed_nonfinite += vertices - finite;
    uint32_t left = hair_strand_merge(p, finite);
    HAIR_ASSERT(left <= finite && finite <= vertices);
    repairs->removed_repeated += finite - left;
    if (left < 2) {
        ++repairs->dropped_single;
        return 0;
    }
    if (!hair_strand_is_fit(p, left)) {
        ++repairs->dropped_short;
        return 0;
    }
    return left;
}

// Work on all strands, divided among tasks. Strands do not depend on each other.
struct cleaning {
    const hair_import* import;
    struct hair_strands* strands;
    struct hair_division division; // of the strands
    uint32_t first[HAIR_MAX_TASKS]; // First vertex of each task.
    struct kept kept[HAIR_MAX_TASKS]; // Number of strands and vertices that each task keeps.
    hair_import_stats repairs[HAIR_MAX_TASKS];
};

// Run tasks over all strands.
static void divide_strands(struct cleaning* cleaning, const hair_tasks* tasks, hair_task task)
{
    const struct hair_strands* strands = cleaning->strands;
    uint32_t first = 0;
    cleaning->division = hair_divide(strands->strand_count, MIN_STRANDS);
    for (uint32_t i = 0; i < strands->strand_count; first += strands->vertices[i++])
        if (i % cleaning->division.each == 0) cleaning->first[i / cleaning->division.each] = first;
    hair_run_tasks(tasks, task, cleaning, cleaning->division.tasks);
}

static void place_strands(uint32_t index, void* data)
{
    const struct cleaning* cleaning = data;
    const hair_import* import = cleaning->import;
    struct hair_strands* strands = cleaning->strands;
    uint32_t end = hair_division_end(&cleaning->division, index);
    float* p = strands->positions + 3 * (size_t)cleaning->first[index];
    for (uint32_t i = index * cleaning->division.each; i < end; ++i) {
        const uint32_t vertices = strands->vertices[i];
        for (size_t k = 0; k < vertices; ++k)
            hair_store3(p + 3 * k, hair_import_point(import, hair_load3(p + 3 * k)));
        if (import->tip_first) reverse(p, vertices);
        if (import->tip_first && strands->colors) hair_strand_reverse_colors(colors_of(strands, i));
        if (strands->radii) strands->radii[i] *= import->scale;
        p += 3 * (size_t)vertices;
    }
}

static void repair_strands(uint32_t index, void* data)
{
    struct cleaning* cleaning = data;
    struct hair_strands* strands = cleaning->strands;
    hair_import_stats repairs = {0};
    uint32_t begin = index * cleaning->division.each, end = hair_division_end(&cleaning->division, index);
    struct kept kept = {.strands = begin, .vertices = cleaning->first[index]};
    size_t first = kept.vertices;
    for (uint32_t i = begin; i < end; ++i) {
        float* p = strands->positions + 3 * first;
        uint32_t vertices = strands->vertices[i];
        uint32_t left = repair_strand(p, vertices, &repairs);
        if (left > HAIR_STRAND_MAX_VERTICES && cleaning->import->strand_vertices == 0)
            left = bring_down(p, left, &repairs);
        if (left) keep_strand(strands, &kept, i, first, left);
        first += vertices;
    }
    cleaning->kept[index] =
        (struct kept){.strands = kept.strands - begin, .vertices = kept.vertices - cleaning->first[index]};
    cleaning->repairs[index] = repairs;
}

static void add_repairs(const hair_import_stats* own, hair_import_stats* all)
{
    all->removed_nonfinite += own->removed_nonfinite;
    all->removed_repeated += own->removed_repeated;
    all->dropped_single += own->dropped_single;
    all->dropped_short += own->dropped_short;
    all->resampled += own->resampled;
}

// Repair all strands, and move those that each task keeps together.
static void repair_all(struct cleaning* cleaning, const hair_tasks* tasks, hair_import_stats* repairs)
{
    struct hair_strands* strands = cleaning->strands;
    struct kept all = {0};
    divide_strands(cleaning, tasks, repair_strands);
    for (uint32_t i = 0; i < cleaning->division.tasks; ++i) {
        const struct kept own = cleaning->kept[i];
        const uint32_t from = i * cleaning->division.each;
        move_vertices(strands, all.vertices, cleaning->first[i], own.vertices);
        if (all.strands != from)
            move(strands->vertices, sizeof *strands->vertices, all.strands, from, own.strands);
        move_rest(strands, all.strands, from, own.strands);
        add_repairs(&cleaning->repairs[i], repairs);
        all.strands += own.strands;
        all.vertices += own.vertices;
    }
    truncate_strands(strands, all);
}

static hair_result resample_all(const hair_host* host, uint32_t count, struct hair_strands* strands,
                                hair_import_stats* repairs)
{
    HAIR_ASSERT(count >= 2 && count <= HAIR_STRAND_MAX_VERTICES);
    float* sampled = hair_alloc(host, strands->strand_count, 3 * (size_t)count * sizeof *sampled);
    if (!sampled) return hair_fail_memory(host, "resampled strands");

    struct kept kept = {0};
    size_t first = 0;
    for (uint32_t i = 0; i < strands->strand_count; ++i) {
        uint32_t vertices = strands->vertices[i];
        float* out = sampled + 3 * (size_t)kept.vertices;
        if (resample_strand(strands->positions + 3 * first, vertices, out, count, repairs)) {
            HAIR_ASSERT(kept.strands <= i);
            strands->vertices[kept.strands] = count;
            move_rest(strands, kept.strands, i, 1);
            ++kept.strands;
            kept.vertices += count;
        }
        first += vertices;
    }
    hair_free(host, strands->positions);
    strands->positions = sampled;
    truncate_strands(strands, kept);
    return HAIR_OK;
}

static hair_result shrink(const hair_host* host, void** memory, size_t count, size_t size)
{
    if (!*memory) return HAIR_OK;
    void* smaller = hair_alloc(host, count, size);
    if (!smaller) return hair_fail_memory(host, "strands");
    memcpy(smaller, *memory, count * size);
    hair_free(host, *memory);
    *memory = smaller;
    return HAIR_OK;
}

// Free the memory that thinning out and repairs have made unnecessary.
static hair_result shrink_all(const hair_host* host, struct hair_strands* strands)
{
    void *positions = strands->positions, *vertices = strands->vertices, *radii = strands->radii,
         *colors = strands->colors, *groups = strands->groups, *guides = strands->guides;
    hair_result result = shrink(host, &positions, strands->vertex_count, 3 * sizeof(float));
    if (!result) result = shrink(host, &vertices, strands->strand_count, sizeof(uint32_t));
    if (!result) result = shrink(host, &radii, strands->strand_count, sizeof(float));
    if (!result) result = shrink(host, &groups, strands->strand_count, sizeof *strands->groups);
    if (!result) result = shrink(host, &guides, strands->strand_count, sizeof *strands->guides);
    if (!result)
        result = shrink(host, &colors, strands->strand_count, 3 * HAIR_STRAND_COLORS * sizeof(float));
    strands->positions = positions;
    strands->vertices = vertices;
    strands->radii = radii;
    strands->colors = colors;
    strands->groups = groups;
    strands->guides = guides;
    for (int k = 0; k < HAIR_ATTRIBUTE_KINDS && !result; ++k) {
        void* factors = strands->factors[k];
        result = shrink(host, &factors, strands->strand_count, sizeof(float));
        strands->factors[k] = factors;
    }
    return result;
}

hair_result hair_strands_clean(const hair_host* host, const hair_tasks* tasks, const hair_import* import,
                               struct hair_strands* strands, hair_import_stats* repairs)
{
    struct cleaning cleaning = {.import = import, .strands = strands};
    uint32_t vertices = strands->vertex_count;
    *repairs = (hair_import_stats){0};
    divide_strands(&cleaning, tasks, place_strands);
    thin_out(import, strands);
    repair_all(&cleaning, tasks, repairs);
    uint32_t count = import->strand_vertices == 1 ? 2 : import->strand_vertices;
    if (count) HAIR_TRY(resample_all(host, count, strands, repairs));
    return strands->vertex_count < vertices / 2 ? shrink_all(host, strands) : HAIR_OK;
}
