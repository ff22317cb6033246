// bind.c - followers of full strands, each bound to the guides that are most like it. A strand that
// is a guide follows itself.
#include "lib/groom/groom_builder.h"
#include "lib/groom/guide_spline.h"

#include <string.h>

static float distance_squared(const float* a, const float* b)
{
    float sum = 0;
    for (int i = 0; i < HAIR_FEATURES; ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
    return sum;
}

static void gather_features(const struct hair_groom_builder* builder, float* features)
{
    for (uint32_t i = 0; i < builder->groom->info.guide_count; ++i)
        memcpy(features + HAIR_FEATURES * (size_t)i,
               builder->features + HAIR_FEATURES * (size_t)builder->chosen[i],
               HAIR_FEATURES * sizeof *features);
}

// Search for the guides of the strands of a group.
struct owner_search {
    struct hair_groom_builder* builder;
    struct hair_division division; // of the strands
    struct hair_kd_tree tree;
    const float* features; // of the guides of the group
    uint32_t group, first; // The group, and its first guide.
};

static void find_owner(const struct owner_search* search, uint32_t strand)
{
    struct hair_groom_builder* builder = search->builder;
    // The guide of the strand's cell is near, so the search only has to find a nearer one.
    uint32_t owner = builder->owner[strand] - search->first;
    HAIR_ASSERT(owner < search->tree.count);
    const float* own = builder->features + HAIR_FEATURES * (size_t)strand;
    struct hair_kd_neighbor* near = builder->near + HAIR_FOLLOWED * (size_t)strand;
    near[0] = (struct hair_kd_neighbor){
        owner, distance_squared(own, search->features + HAIR_FEATURES * (size_t)owner)};
    uint32_t found = hair_kd_tree_nearest(&search->tree, own, near, 1, HAIR_FOLLOWED);
    for (uint32_t k = found; k < HAIR_FOLLOWED; ++k) near[k] = near[0];
    for (uint32_t k = 0; k < HAIR_FOLLOWED; ++k) near[k].index += search->first;
    builder->owner[strand] = near[0].index;
}

static void find_some_owners(uint32_t index, void* data)
{
    const struct owner_search* search = data;
    uint32_t end = hair_division_end(&search->division, index);
    for (uint32_t i = index * search->division.each; i < end; ++i)
        if (hair_group_of(search->builder, i) == search->group) find_owner(search, i);
}

// Find the nearest guides of the strands of a group among the guides of the group.
static hair_result find_owners_in_group(struct hair_groom_builder* builder, const float* all, uint32_t group)
{
    uint32_t first = builder->group_first[group], count = builder->group_first[group + 1] - first;
    struct owner_search search = {.builder = builder,
                                  .division =
                                      hair_divide(builder->strands.strand_count, HAIR_MIN_TASK_STRANDS),
                                  .features = all + HAIR_FEATURES * (size_t)first,
                                  .group = group,
                                  .first = first};
    if (count == 0) return HAIR_OK;
    HAIR_TRY(hair_kd_tree_build(builder->host, (struct hair_point_set){search.features, HAIR_FEATURES}, count,
                                &search.tree));
    hair_run_tasks(&builder->groom->tasks, find_some_owners, &search, search.division.tasks);
    hair_kd_tree_free(builder->host, &search.tree);
    return HAIR_OK;
}

static hair_result find_owners(struct hair_groom_builder* builder, const float* features)
{
    for (uint32_t group = 0; group < HAIR_MAX_STRAND_GROUPS; ++group)
        HAIR_TRY(find_owners_in_group(builder, features, group));
    for (uint32_t i = 0; i < builder->groom->info.guide_count; ++i) builder->owner[builder->chosen[i]] = i;
    return HAIR_OK;
}

// Sort strands by guide with a counting sort.
static void sort_strands(struct hair_groom_builder* builder)
{
    uint32_t strands = builder->strands.strand_count;
    for (uint32_t i = 0; i < strands; ++i) ++builder->bin_candidates[builder->owner[i]];
    hair_number_candidates(builder);
    HAIR_ASSERT(builder->candidate_count == strands);
    for (uint32_t i = 0; i < strands; ++i) builder->strand_of[builder->bin_first[builder->owner[i]]++] = i;
    for (uint32_t i = 0; i < builder->bin_count; ++i) builder->bin_first[i] -= builder->bin_candidates[i];
}

hair_result hair_strand_candidates(struct hair_groom_builder* builder)
{
    uint32_t strands = builder->strands.strand_count, guides = builder->groom->info.guide_count;
    HAIR_TRY(hair_guide_bins(builder));
    float* features = hair_alloc(builder->host, guides, HAIR_FEATURES * sizeof *features);
    builder->strand_of = hair_alloc(builder->host, strands, sizeof *builder->strand_of);
    builder->near = hair_alloc(builder->host, strands, HAIR_FOLLOWED * sizeof *builder->near);
    if (!features || !builder->strand_of || !builder->near) {
        hair_free(builder->host, features);
        return hair_fail_memory(builder->host, "the binding of strands to guides");
    }
    gather_features(builder, features);
    hair_result result = find_owners(builder, features);
    hair_free(builder->host, features);
    if (!result) sort_strands(builder);
    return result;
}

static struct hair_follower bind_follower(const struct hair_groom_builder* builder, uint32_t strand,
                                          uint32_t place, uint32_t guide,
                                          const struct hair_guide_spline* spline)
{
    uint32_t random = hair_candidate_random(builder, strand);
    struct hair_follower follower = hair_own_follower(guide, &random);
    if (strand != builder->chosen[guide]) hair_shape_follower(builder, strand, place, spline, &follower);
    return follower;
}

// Shape a guide and its followers.
static void bind_followers_of(const struct hair_groom_builder* builder, uint32_t guide)
{
    struct hair_groom* groom = builder->groom;
    struct hair_guide_spline spline;
    hair_guide_spline_fit(groom, guide, &spline);
    hair_shape_guide(groom, guide, &spline);
    for (uint32_t i = 0; i < builder->bin_candidates[guide]; ++i) {
        uint32_t candidate = builder->bin_first[guide] + i;
        uint32_t place = builder->place[candidate], strand = builder->strand_of[candidate];
        HAIR_ASSERT(place < groom->info.follower_count);
        groom->followers[place] = bind_follower(builder, strand, place, guide, &spline);
    }
}

struct follower_binding {
    const struct hair_groom_builder* builder;
    struct hair_division division; // of the guides
};

static void bind_some_followers(uint32_t index, void* data)
{
    const struct follower_binding* binding = data;
    uint32_t end = hair_division_end(&binding->division, index);
    for (uint32_t guide = index * binding->division.each; guide < end; ++guide)
        bind_followers_of(binding->builder, guide);
}

hair_result hair_strand_followers(struct hair_groom_builder* builder)
{
    struct hair_groom* groom = builder->groom;
    struct follower_binding binding = {.builder = builder, .division = hair_divide(builder->bin_count, 1)};
    size_t smooth_vertices = 2 * ((size_t)groom->max_vertices - 1) + 1;
    groom->guide_shapes =
        hair_alloc(builder->host, smooth_vertices * groom->info.guide_count, sizeof *groom->guide_shapes);
    if (!groom->guide_shapes) return hair_fail_memory(builder->host, "the shapes of guides");
    hair_run_tasks(&groom->tasks, bind_some_followers, &binding, binding.division.tasks);
    return HAIR_OK;
}
