// generate.c - followers that are not given: the guides themselves, or grown around the guides
// without a scalp.
#include "lib/groom/groom_builder.h"

#define GOLDEN_ANGLE 2.39996323f

uint32_t hair_candidate_random(const struct hair_groom_builder* builder, uint32_t candidate)
{
    return hair_hash(candidate ^ hair_hash(builder->desc->seed));
}

struct hair_follower hair_own_follower(uint32_t guide, uint32_t* random)
{
    struct hair_follower follower = {.guide0 = guide, .guide1 = guide, .guide2 = guide, .length_ratio = 1};
    follower.seed = hair_hash(*random);
    follower.offset[0].w = 0.8f + 0.4f * hair_random(random); // Typical variation on one head.
    return follower;
}

// Return a random length ratio. Most strands are about as long as their guide. One in 25 is much
// shorter, because it is growing anew.
static float draw_length(uint32_t* random)
{
    if (hair_random(random) < 0.04f) return 0.6f + 0.25f * hair_random(random);
    return 0.85f + 0.15f * hair_random(random);
}

struct hair_follower hair_grown_follower(uint32_t guide, hair_vec3 offset, uint32_t* random)
{
    // Fractions of the offset from root to tip, which form a clump.
    static const float fraction[4] = {1, 0.8f, 0.5f, 0.25f};
    struct hair_follower follower = hair_own_follower(guide, random);
    // Deviation from the profile, so that clumps are not cones.
    float deviation = 0.12f * hair_length(offset);
    follower.length_ratio = draw_length(random);
    for (int i = 0; i < 4; ++i) {
        float x = i ? deviation * (2 * hair_random(random) - 1) : 0;
        float z = i ? deviation * (2 * hair_random(random) - 1) : 0;
        follower.offset[i].x = fraction[i] * offset.x + x;
        follower.offset[i].y = fraction[i] * offset.y;
        follower.offset[i].z = fraction[i] * offset.z + z;
    }
    return follower;
}

hair_result hair_guide_candidates(struct hair_groom_builder* builder)
{
    uint32_t guides = builder->groom->info.guide_count;
    uint64_t wanted = builder->desc->follower_count ? builder->desc->follower_count : guides;
    HAIR_TRY(hair_guide_bins(builder));
    for (uint32_t i = 0; i < guides; ++i)
        builder->bin_candidates[i] = (uint32_t)(wanted * (i + 1) / guides - wanted * i / guides);
    hair_number_candidates(builder);
    HAIR_ASSERT(builder->candidate_count == wanted);
    return HAIR_OK;
}

// Return the i-th of `count` offsets in a disc perpendicular to the guide. The offsets form Vogel's
// spiral, with the first at the centre. Their radii have a normal distribution, cut off at the edge
// of the disc, which is at two standard deviations.
static hair_vec3 spiral(uint32_t i, uint32_t count, float radius, float turn)
{
    HAIR_ASSERT(i < count);
    float edge = 1 - expf(-2);
    float r = 0.5f * radius * sqrtf(-2 * logf(1 - edge * (float)i / (float)count));
    // Floats lose the angle of larger indices.
    float angle = turn + GOLDEN_ANGLE * (float)(i % 65536);
    return hair_v3(r * cosf(angle), 0, r * sinf(angle));
}

// Make the followers of a guide.
static void grow_around(const struct hair_groom_builder* builder, uint32_t guide)
{
    struct hair_groom* groom = builder->groom;
    uint32_t count = builder->bin_candidates[guide], turns = hair_candidate_random(builder, guide);
    float turn = 6.2831853f * hair_random(&turns);
    for (uint32_t i = 0; i < count; ++i) {
        uint32_t candidate = builder->bin_first[guide] + i;
        HAIR_ASSERT(builder->place[candidate] < groom->info.follower_count);
        uint32_t random = hair_candidate_random(builder, hair_candidate_number(builder, candidate));
        struct hair_follower* follower = &groom->followers[builder->place[candidate]];
        if (builder->desc->follower_count)
            *follower =
                hair_grown_follower(guide, spiral(i, count, builder->desc->clump_radius, turn), &random);
        else
            *follower = hair_own_follower(guide, &random);
    }
}

struct growth {
    const struct hair_groom_builder* builder;
    struct hair_division division; // of the guides
};

static void grow_around_guides(uint32_t index, void* data)
{
    const struct growth* growth = data;
    uint32_t end = hair_division_end(&growth->division, index);
    for (uint32_t guide = index * growth->division.each; guide < end; ++guide)
        grow_around(growth->builder, guide);
}

hair_result hair_guide_followers(struct hair_groom_builder* builder)
{
    struct growth growth = {.builder = builder,
                            .division = hair_divide(builder->bin_count, HAIR_MIN_TASK_STRANDS)};
    hair_run_tasks(&builder->groom->tasks, grow_around_guides, &growth, growth.division.tasks);
    return HAIR_OK;
}
