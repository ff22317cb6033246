// build.c - construction of a groom from strands, step by step.
#include "lib/groom/groom_builder.h"

#include <float.h>
#include <string.h>

#define MIN_VERTICES 4096 // Minimum number of vertices of a task.

// Source of followers.
enum source { FROM_STRANDS, FROM_GUIDES, FROM_SCALP };

static enum source find_source(const hair_groom_desc* desc)
{
    if (desc->strand_set == HAIR_STRAND_SET_FULL) return FROM_STRANDS;
    return desc->scalp_positions && desc->follower_count ? FROM_SCALP : FROM_GUIDES;
}

static hair_result count_candidates(struct hair_groom_builder* builder)
{
    switch (find_source(builder->desc)) {
    case FROM_STRANDS: return hair_strand_candidates(builder);
    case FROM_SCALP: return hair_scalp_candidates(builder);
    case FROM_GUIDES: break;
    }
    return hair_guide_candidates(builder);
}

static hair_result make_followers(struct hair_groom_builder* builder)
{
    struct hair_groom* groom = builder->groom;
    HAIR_ASSERT(builder->candidate_count > 0 && builder->place);
    groom->info.follower_count = builder->candidate_count;
    if (find_source(builder->desc) == FROM_STRANDS) groom->shape_vertices = groom->max_vertices;
    // Followers that are guides leave zeros in place of a shape.
    size_t vectors = hair_groom_follower_bytes(groom) / 16;
    groom->followers = groom->shape_vertices ? hair_alloc(builder->host, vectors, 16)
                                             : hair_alloc_undefined(builder->host, vectors, 16);
    if (!groom->followers) return hair_fail_memory(builder->host, "followers");
    switch (find_source(builder->desc)) {
    case FROM_STRANDS: return hair_strand_followers(builder);
    case FROM_SCALP: return hair_scalp_followers(builder);
    case FROM_GUIDES: break;
    }
    return hair_guide_followers(builder);
}

struct bounds_work {
    const struct hair_strands* strands;
    struct hair_division division; // of the vertices
    float lower[HAIR_MAX_TASKS][3], upper[HAIR_MAX_TASKS][3]; // of each task
};

static void add_to_bounds(const float* at, float* lower, float* upper)
{
    for (int a = 0; a < 3; ++a) {
        if (at[a] < lower[a]) lower[a] = at[a];
        if (at[a] > upper[a]) upper[a] = at[a];
    }
}

static void find_task_bounds(uint32_t index, void* data)
{
    struct bounds_work* work = data;
    const float* positions = work->strands->positions;
    size_t first = (size_t)index * work->division.each, end = hair_division_end(&work->division, index);
    memcpy(work->lower[index], positions + 3 * first, sizeof work->lower[index]);
    memcpy(work->upper[index], positions + 3 * first, sizeof work->upper[index]);
    for (size_t i = first + 1; i < end; ++i)
        add_to_bounds(positions + 3 * i, work->lower[index], work->upper[index]);
}

static void find_bounds(struct hair_groom_builder* builder)
{
    hair_groom_info* info = &builder->groom->info;
    struct bounds_work work = {.strands = &builder->strands,
                               .division = hair_divide(builder->strands.vertex_count, MIN_VERTICES)};
    hair_run_tasks(&builder->groom->tasks, find_task_bounds, &work, work.division.tasks);
    memcpy(info->lower, work.lower[0], sizeof info->lower);
    memcpy(info->upper, work.upper[0], sizeof info->upper);
    for (uint32_t i = 1; i < work.division.tasks; ++i) {
        add_to_bounds(work.lower[i], info->lower, info->upper);
        add_to_bounds(work.upper[i], info->lower, info->upper);
    }
}

static void compute_info(struct hair_groom_builder* builder)
{
    hair_groom_info* info = &builder->groom->info;
    const struct hair_strands* strands = &builder->strands;
    double sum = 0;
    info->strand_count = strands->strand_count;
    info->length[0] = FLT_MAX;
    for (uint32_t i = 0; i < strands->strand_count; ++i) {
        info->length[0] = fminf(info->length[0], builder->length[i]);
        info->length[2] = fmaxf(info->length[2], builder->length[i]);
        sum += (double)builder->length[i];
    }
    HAIR_ASSERT(0 < info->length[0] && info->length[0] <= info->length[2]);
    info->length[1] = (float)(sum / strands->strand_count);
    info->group_count = 1;
    for (uint32_t i = 0; strands->groups && i < strands->strand_count; ++i)
        if (strands->groups[i] >= info->group_count) info->group_count = strands->groups[i] + 1u;
    find_bounds(builder);
}

static hair_result build_groom(struct hair_groom_builder* builder)
{
    HAIR_TRY(hair_build_strands(builder));
    HAIR_TRY(hair_build_scalp(builder));
    HAIR_TRY(hair_shorten_strands(builder));
    HAIR_TRY(hair_measure_strands(builder));
    HAIR_TRY(hair_build_guides(builder));
    HAIR_TRY(hair_build_rest(builder));
    HAIR_TRY(hair_order_guides(builder->groom));
    HAIR_TRY(hair_build_guide_factors(builder));
    HAIR_TRY(count_candidates(builder));
    HAIR_TRY(hair_build_scalp_points(builder));
    HAIR_TRY(hair_thin_candidates(builder));
    HAIR_TRY(hair_build_maps(builder));
    HAIR_TRY(hair_build_patches(builder));
    HAIR_TRY(make_followers(builder));
    HAIR_TRY(hair_build_strand_attributes(builder));
    HAIR_TRY(hair_build_follower_factors(builder));
    HAIR_TRY(hair_build_root_bindings(builder));
    hair_apply_thickness(builder);
    hair_measure_patches(builder->groom);
    builder->groom->head_sphere = hair_find_head_sphere(builder->groom);
    compute_info(builder);
    return HAIR_OK;
}

static void free_builder(struct hair_groom_builder* builder)
{
    hair_strands_free(builder->host, &builder->strands);
    hair_free(builder->host, builder->first);
    hair_free(builder->host, builder->length);
    hair_free(builder->host, builder->features);
    hair_free(builder->host, builder->scalp);
    hair_free(builder->host, builder->density);
    hair_free(builder->host, builder->map_lengths);
    hair_free(builder->host, builder->chosen);
    hair_free(builder->host, builder->owner);
    hair_free(builder->host, builder->near);
    hair_free(builder->host, builder->bin_candidates);
    hair_free(builder->host, builder->bin_first);
    hair_free(builder->host, builder->bin_centres);
    hair_free(builder->host, builder->strand_of);
    hair_free(builder->host, builder->place);
    hair_free(builder->host, builder->number);
    hair_free(builder->host, builder->scalp_points);
    hair_free(builder->host, builder->map_density);
    hair_free(builder->host, builder->map_thickness);
    hair_free(builder->host, builder->map_fraction);
}

// Move the strands of guides and followers out of the builder.
static hair_result take_origin(struct hair_groom_builder* builder, struct hair_groom_origin* origin)
{
    uint32_t count = builder->candidate_count;
    HAIR_ASSERT(builder->strand_of && builder->place);
    origin->follower = hair_alloc(builder->host, count, sizeof *origin->follower);
    if (!origin->follower) return hair_fail_memory(builder->host, "the strands of followers");
    for (uint32_t i = 0; i < count; ++i) origin->follower[builder->place[i]] = builder->strand_of[i];
    origin->guide = builder->chosen;
    builder->chosen = NULL;
    return HAIR_OK;
}

hair_result hair_groom_build(const hair_host* host, const hair_groom_desc* desc, const hair_import* import,
                             struct hair_groom_origin* origin, hair_groom** out)
{
    struct hair_groom* groom = hair_alloc(host, 1, sizeof *groom);
    if (!groom) return hair_fail_memory(host, "a groom");
    groom->host = *host;
    atomic_init(&groom->holders, 1);
    if (desc->tasks) groom->tasks = *desc->tasks;
    struct hair_groom_builder builder = {
        .host = &groom->host, .desc = desc, .import = import, .groom = groom};
    hair_result result = build_groom(&builder);
    if (!result && origin) result = take_origin(&builder, origin);
    free_builder(&builder);
    if (result)
        hair_groom_release(groom);
    else
        *out = groom;
    return result;
}

// Followers, and pairs of vertices of their shapes.
size_t hair_groom_follower_bytes(const struct hair_groom* groom)
{
    size_t shape = groom->shape_vertices ? (size_t)16 * HAIR_SHAPE_TEXELS(groom->shape_vertices) : 0;
    return groom->info.follower_count * (sizeof *groom->followers + shape);
}

hair_groom* hair_groom_retain(hair_groom* groom)
{
    HAIR_ASSERT(atomic_load(&groom->holders) > 0);
    atomic_fetch_add_explicit(&groom->holders, 1, memory_order_relaxed);
    return groom;
}

void hair_groom_release(hair_groom* groom)
{
    HAIR_ASSERT(!groom || atomic_load(&groom->holders) > 0);
    if (!groom || atomic_fetch_sub_explicit(&groom->holders, 1, memory_order_acq_rel) != 1) return;
    hair_host host = groom->host;
    hair_free(&host, groom->guides);
    hair_free(&host, groom->rest);
    hair_free(&host, groom->guide_order);
    hair_free(&host, groom->roots);
    hair_free(&host, groom->followers);
    hair_free(&host, groom->guide_shapes);
    hair_free(&host, groom->patches);
    hair_free(&host, groom->colors);
    hair_free(&host, groom->guide_factors);
    hair_free(&host, groom->factors);
    hair_root_bindings_release(groom->root_bindings);
    hair_free(&host, groom->root_uvs);
    if (groom->prepared) groom->free_prepared(&host, groom->prepared);
    hair_free(&host, groom);
}
