// targets.h - hair that plays target poses from a cache of motion.
#ifndef HAIR_TESTS_SUPPORT_TARGETS_H
#define HAIR_TESTS_SUPPORT_TARGETS_H

#include "tests/support/live_hair.h"
#include "tests/support/ways.h"

#define HAIR_TEST_TARGET_FRAME (1.0f / 60)
#define HAIR_TEST_TARGET_FRAMES 60
#define HAIR_TEST_TARGET_WAYS (HAIR_TEST_WAYS + 1) // The last is redblack by transform feedback.

// Motion of a shaken head's hair: the positions of all guide vertices in each frame.
struct hair_test_target_cache {
    float* frame[HAIR_TEST_TARGET_FRAMES];
    uint32_t vertices;
};

// Make a straight strand and a curl, by one of HAIR_TEST_TARGET_WAYS.
void hair_test_targets_live(struct hair_test* test, int way, struct hair_test_living* out);
// Simulate a frame of a shaken head, and read the guides.
void hair_test_targets_shake(struct hair_test_living* living, int frame);
// Record the motion of that hair. Free the result by hair_test_targets_forget().
struct hair_test_target_cache hair_test_targets_record(struct hair_test* test);
void hair_test_targets_forget(struct hair_test_target_cache* cache);

void hair_test_targets_blend(struct hair_test_living* living, float weight, float blend_time);
void hair_test_targets_set(struct hair_test_living* living, const struct hair_test_target_cache* cache,
                           int frame);
void hair_test_targets_step(struct hair_test_living* living);
// Play a frame of the cache while the head is at rest.
void hair_test_targets_play(struct hair_test_living* living, const struct hair_test_target_cache* cache,
                            int frame);

// Return the distance of two positions, m.
double hair_test_targets_distance(const float* a, const float* b);
double hair_test_targets_farthest(const float* a, const float* b, uint32_t vertices);
// Read the drawn guides. Free the result.
float* hair_test_targets_read(struct hair_test_living* living, uint32_t* count);

#endif
