// targets.c - hair that plays target poses from a cache of motion.
#include "tests/support/targets.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

void hair_test_targets_live(struct hair_test* test, int way, struct hair_test_living* out)
{
    struct hair_test_strands strands = hair_test_straight_and_curl();
    hair_desc desc = hair_test_way(way % HAIR_TEST_WAYS);
    if (way == HAIR_TEST_WAYS) {
        desc.solver = HAIR_SOLVER_REDBLACK;
        desc.thread_mapping = HAIR_THREAD_MAPPING_FEEDBACK;
    }
    hair_test_live(test, &strands, &desc, out);
    hair_test_strands_free(&strands);
}

void hair_test_targets_shake(struct hair_test_living* living, int frame)
{
    struct hair_reference_rod_pose head = hair_test_shaken(frame * (double)HAIR_TEST_TARGET_FRAME);
    hair_test_advance(living, &head, (double)HAIR_TEST_TARGET_FRAME);
    hair_test_read_guides(living);
}

struct hair_test_target_cache hair_test_targets_record(struct hair_test* test)
{
    struct hair_test_target_cache cache;
    struct hair_test_living living;
    hair_test_targets_live(test, 0, &living);
    cache.vertices = living.vertices;
    for (int i = 0; i < HAIR_TEST_TARGET_FRAMES; ++i) {
        hair_test_targets_shake(&living, i);
        cache.frame[i] = malloc(cache.vertices * 3 * sizeof(float));
        memcpy(cache.frame[i], living.positions, cache.vertices * 3 * sizeof(float));
    }
    hair_test_die(&living);
    return cache;
}

void hair_test_targets_forget(struct hair_test_target_cache* cache)
{
    for (int i = 0; i < HAIR_TEST_TARGET_FRAMES; ++i) free(cache->frame[i]);
}

void hair_test_targets_blend(struct hair_test_living* living, float weight, float blend_time)
{
    hair_target_blend blend = hair_target_blend_default();
    blend.weight = weight;
    blend.blend_time = blend_time;
    hair_test_ok(living->test, hair_set_target_blend(living->hair, &blend));
}

void hair_test_targets_set(struct hair_test_living* living, const struct hair_test_target_cache* cache,
                           int frame)
{
    hair_test_ok(living->test,
                 hair_set_targets(living->hair, cache->frame[frame], cache->vertices, 12, NULL));
}

void hair_test_targets_step(struct hair_test_living* living)
{
    hair_test_ok(living->test, hair_step(living->hair, HAIR_TEST_TARGET_FRAME));
}

// Play a frame of the cache while the head is at rest.
void hair_test_targets_play(struct hair_test_living* living, const struct hair_test_target_cache* cache,
                            int frame)
{
    hair_test_targets_set(living, cache, frame);
    hair_test_targets_step(living);
}

double hair_test_targets_distance(const float* a, const float* b)
{
    return (double)hair_distance(hair_load3(a), hair_load3(b));
}

double hair_test_targets_farthest(const float* a, const float* b, uint32_t vertices)
{
    double max = 0;
    for (uint32_t i = 0; i < vertices; ++i) max = fmax(max, hair_test_targets_distance(a + 3 * i, b + 3 * i));
    return max;
}

// Read the drawn guides. Free the result.
float* hair_test_targets_read(struct hair_test_living* living, uint32_t* count)
{
    hair_test_ok(living->test, hair_read_positions(living->hair, HAIR_READ_SMOOTH, NULL, 0, count));
    float* drawn = malloc(*count * 3 * sizeof *drawn);
    hair_test_ok(living->test, hair_read_positions(living->hair, HAIR_READ_SMOOTH, drawn, *count, count));
    for (uint32_t i = 0; i < 3 * *count; ++i) assert_true(isfinite(drawn[i]));
    return drawn;
}
