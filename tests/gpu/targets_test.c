// targets_test.c - target poses: guides at targets, between targets and simulation, and on the way
// from one to the other, by every solver and mapping.
#include "tests/support/targets.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "lib/api/api.h"

#define EXACT 1e-5 // m

// Return the displacement of vertex `i` over the last substep, m.
static hair_vec3 displacement_of(struct hair_test_living* living, uint32_t i)
{
    struct hair_state state;
    glGetNamedBufferSubData(living->hair->sim.state, (GLintptr)(i * sizeof state), sizeof state, &state);
    return hair_test_xyz(state.displacement);
}

static void full_weight_follows_a_cache_with_its_velocity(void** state)
{
    struct hair_test* test = *state;
    struct hair_test_target_cache cache = hair_test_targets_record(test);
    for (int way = 0; way < HAIR_TEST_TARGET_WAYS; ++way) {
        struct hair_test_living living;
        double off = 0, off_drawn = 0, off_speed = 0, went = 0;
        hair_test_targets_live(test, way, &living);
        hair_test_targets_blend(&living, 1, 0);
        for (int i = 0; i < HAIR_TEST_TARGET_FRAMES; ++i) {
            uint32_t count, tip = cache.vertices - 1;
            hair_test_targets_play(&living, &cache, i);
            hair_test_read_guides(&living);
            off = fmax(off, hair_test_targets_farthest(living.positions, cache.frame[i], cache.vertices));
            float* drawn = hair_test_targets_read(&living, &count);
            // The first and last samples of a guide are its vertices.
            off_drawn = fmax(off_drawn, hair_test_targets_distance(drawn, cache.frame[i]));
            off_drawn = fmax(off_drawn,
                             hair_test_targets_distance(drawn + 3 * (count - 1), cache.frame[i] + 3 * tip));
            free(drawn);
            if (i == 0) continue;
            hair_vec3 moved =
                hair_sub(hair_load3(cache.frame[i] + 3 * tip), hair_load3(cache.frame[i - 1] + 3 * tip));
            hair_vec3 own = hair_scale(displacement_of(&living, tip),
                                       HAIR_TEST_TARGET_FRAME / (float)living.hair->sim.substep);
            off_speed = fmax(off_speed, (double)hair_distance(moved, own));
            went = fmax(went, (double)hair_length(moved));
        }
        print_message(
            "    way %d: guides within %.2g mm, drawn within %.2g mm, moves within %.2g mm of %.2g\n", way,
            off * 1e3, off_drawn * 1e3, off_speed * 1e3, went * 1e3);
        assert_true(went > 0.003);
        assert_true(off < EXACT && off_drawn < EXACT && off_speed < EXACT);
        hair_test_die(&living);
    }
    hair_test_targets_forget(&cache);
}

// Return how far `c` is from the way from a to b, as a fraction of the distance of a and b.
static double detour(const float* a, const float* b, const float* c)
{
    double way = hair_test_targets_distance(a, b);
    return way > 1e-3 ? (hair_test_targets_distance(a, c) + hair_test_targets_distance(c, b)) / way - 1 : 0;
}

static void half_weight_draws_between_simulation_and_targets(void** state)
{
    struct hair_test* test = *state;
    struct hair_test_target_cache cache = hair_test_targets_record(test);
    for (int way = 0; way < HAIR_TEST_TARGET_WAYS; ++way) {
        struct hair_test_living half, free_hair, full;
        double max = 0, apart = 0;
        uint32_t count;
        hair_test_targets_live(test, way, &half), hair_test_targets_live(test, way, &free_hair),
            hair_test_targets_live(test, way, &full);
        hair_test_targets_blend(&half, 0.5f, 0), hair_test_targets_blend(&full, 1, 0);
        for (int i = 0; i < HAIR_TEST_TARGET_FRAMES / 2; ++i) {
            hair_test_targets_play(&half, &cache, i), hair_test_targets_play(&full, &cache, i),
                hair_test_targets_step(&free_hair);
            float *a = hair_test_targets_read(&free_hair, &count), *b = hair_test_targets_read(&full, &count),
                  *c = hair_test_targets_read(&half, &count);
            for (uint32_t k = 0; k < count; ++k) max = fmax(max, detour(a + 3 * k, b + 3 * k, c + 3 * k));
            apart = fmax(apart, hair_test_targets_farthest(a, b, count));
            free(a), free(b), free(c);
        }
        hair_test_read_guides(&half), hair_test_read_guides(&free_hair);
        print_message("    way %d: apart by %.3g mm, detour of %.3g\n", way, apart * 1e3, max);
        assert_true(apart > 0.01 && max < 0.2);
        // The simulation does not feel such targets.
        assert_memory_equal(half.positions, free_hair.positions, half.vertices * 3 * sizeof(float));
        hair_test_die(&half), hair_test_die(&free_hair), hair_test_die(&full);
    }
    hair_test_targets_forget(&cache);
}

// Step while the head shakes, with the targets of the cache unless `cache` is NULL. Return the
// greatest speed of the drawn hair, m/s.
static double fastest(struct hair_test_living* living, const struct hair_test_target_cache* cache, int begin,
                      int end)
{
    double max = 0;
    float* before = NULL;
    for (int i = begin; i < end; ++i) {
        uint32_t count;
        struct hair_reference_rod_pose head = hair_test_shaken(i * (double)HAIR_TEST_TARGET_FRAME);
        if (cache) hair_test_targets_set(living, cache, i % HAIR_TEST_TARGET_FRAMES);
        hair_test_advance(living, &head, (double)HAIR_TEST_TARGET_FRAME);
        float* drawn = hair_test_targets_read(living, &count);
        if (before)
            max =
                fmax(max, hair_test_targets_farthest(before, drawn, count) / (double)HAIR_TEST_TARGET_FRAME);
        free(before);
        before = drawn;
    }
    free(before);
    return max;
}

static void switching_adds_at_most_half_of_the_velocity(void** state)
{
    struct hair_test* test = *state;
    struct hair_test_target_cache cache = hair_test_targets_record(test);
    for (int way = 0; way < HAIR_TEST_TARGET_WAYS; ++way) {
        struct hair_test_living living;
        hair_test_targets_live(test, way, &living);
        double simulated = fastest(&living, NULL, 0, 20), to = fastest(&living, &cache, 19, 45);
        hair_test_ok(test, hair_set_targets(living.hair, NULL, 0, 0, NULL));
        double from = fastest(&living, NULL, 44, HAIR_TEST_TARGET_FRAMES);
        print_message("    way %d: %.3g m/s simulated, %.3g to the targets, %.3g from them\n", way, simulated,
                      to, from);
        assert_true(to <= 1.5 * simulated && from <= 1.5 * to);
        assert_false(hair_targets_are_on(&living.hair->sim));
        hair_test_die(&living);
    }
    hair_test_targets_forget(&cache);
}

static void tip_hangs_from_the_part_that_is_at_its_targets(void** state)
{
    struct hair_test* test = *state;
    struct hair_test_target_cache cache = hair_test_targets_record(test);
    for (int way = 0; way < HAIR_TEST_TARGET_WAYS; ++way) {
        struct hair_test_living living;
        hair_target_blend blend = hair_target_blend_default();
        double off = 0, tip = 0, stretch = 0;
        hair_test_targets_live(test, way, &living);
        for (int i = 4; i < 8; ++i) blend.along.at[i] = 0;
        blend.blend_time = 0;
        hair_test_ok(test, hair_set_target_blend(living.hair, &blend));
        uint32_t first = living.groom->guides[0].count;
        for (int i = 0; i < HAIR_TEST_TARGET_FRAMES; ++i) {
            hair_test_targets_play(&living, &cache, i);
            hair_test_read_guides(&living);
            off = fmax(off, hair_test_targets_farthest(living.positions, cache.frame[i], first / 3));
            tip = fmax(tip, hair_test_targets_distance(living.positions + 3 * (first - 1),
                                                       cache.frame[i] + 3 * (first - 1)));
            stretch = fmax(stretch, hair_test_stretch(&living));
        }
        print_message("    way %d: root part within %.2g mm, tip %.3g mm away, stretch %.3g\n", way,
                      off * 1e3, tip * 1e3, stretch);
        assert_true(off < EXACT && tip > 0.003);
        // The solver redblack stretches.
        assert_true(stretch < (living.hair->sim.rods ? 0.02 : 1.5));
        hair_test_die(&living);
    }
    hair_test_targets_forget(&cache);
}

static void saved_targets_continue_with_the_same_bits(void** state)
{
    struct hair_test* test = *state;
    struct hair_test_target_cache cache = hair_test_targets_record(test);
    for (int way = 0; way < HAIR_TEST_TARGET_WAYS; ++way) {
        struct hair_test_living a, b;
        size_t size;
        hair_test_targets_live(test, way, &a), hair_test_targets_live(test, way, &b);
        hair_test_targets_blend(&a, 1, 0.1f), hair_test_targets_blend(&b, 1, 0.1f);
        for (int i = 0; i < 5; ++i) hair_test_targets_play(&a, &cache, i);
        // The targets are part of the state before the step too.
        hair_test_targets_set(&a, &cache, 5);
        hair_test_ok(test, hair_save(a.hair, NULL, 0, &size));
        unsigned char* bytes = malloc(size);
        hair_test_ok(test, hair_save(a.hair, bytes, size, &size));
        hair_test_ok(test, hair_load(b.hair, bytes, size));
        hair_test_targets_step(&a), hair_test_targets_step(&b);
        for (int i = 6; i < 12; ++i)
            hair_test_targets_play(&a, &cache, i), hair_test_targets_play(&b, &cache, i);
        uint32_t count;
        float *drawn = hair_test_targets_read(&a, &count), *other = hair_test_targets_read(&b, &count);
        assert_memory_equal(drawn, other, count * 3 * sizeof(float));
        free(drawn), free(other), free(bytes);
        // A state without targets ends them.
        hair_test_die(&a);
        hair_test_targets_live(test, way, &a);
        hair_test_ok(test, hair_save(a.hair, NULL, 0, &size));
        bytes = malloc(size);
        hair_test_ok(test, hair_save(a.hair, bytes, size, &size));
        hair_test_ok(test, hair_load(b.hair, bytes, size));
        assert_false(hair_targets_are_on(&b.hair->sim));
        free(bytes);
        hair_test_die(&a), hair_test_die(&b);
    }
    hair_test_targets_forget(&cache);
}

static void hair_sleeps_at_targets_and_wakes_for_new_ones(void** state)
{
    struct hair_test* test = *state;
    struct hair_test_target_cache cache = hair_test_targets_record(test);
    struct hair_test_living living;
    hair_test_targets_live(test, 0, &living);
    for (int i = 0; i < 240 && !living.hair->sim.sleep.asleep; ++i)
        hair_test_targets_play(&living, &cache, 10), glFinish();
    assert_true(living.hair->sim.sleep.asleep);
    hair_test_targets_play(&living, &cache, 10);
    assert_true(hair_sleep_through(&living.hair->sim));
    hair_test_targets_play(&living, &cache, 20);
    assert_false(living.hair->sim.sleep.asleep);
    hair_test_read_guides(&living);
    assert_true(hair_test_targets_farthest(living.positions, cache.frame[20], cache.vertices) < EXACT);
    hair_test_die(&living);
    hair_test_targets_forget(&cache);
}

static void reset_puts_hair_at_its_targets_at_once(void** state)
{
    struct hair_test* test = *state;
    struct hair_test_target_cache cache = hair_test_targets_record(test);
    for (int way = 0; way < HAIR_TEST_TARGET_WAYS; ++way) {
        struct hair_test_living living;
        float moved[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 1, 2, 3, 1};
        hair_test_targets_live(test, way, &living);
        hair_test_targets_set(&living, &cache, 30);
        hair_test_ok(test, hair_reset(living.hair));
        hair_test_read_guides(&living);
        assert_true(hair_test_targets_farthest(living.positions, cache.frame[30], cache.vertices) < EXACT);
        // Targets that are not set again move with the head.
        hair_test_ok(test, hair_teleport(living.hair, moved));
        hair_test_targets_step(&living);
        hair_test_read_guides(&living);
        for (uint32_t i = 0; i < 3 * cache.vertices; ++i)
            assert_true(fabsf(living.positions[i] - cache.frame[30][i] - moved[12 + i % 3]) < (float)EXACT);
        hair_test_die(&living);
    }
    hair_test_targets_forget(&cache);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        HAIR_TEST(full_weight_follows_a_cache_with_its_velocity),
        HAIR_TEST(half_weight_draws_between_simulation_and_targets),
        HAIR_TEST(switching_adds_at_most_half_of_the_velocity),
        HAIR_TEST(tip_hangs_from_the_part_that_is_at_its_targets),
        HAIR_TEST(saved_targets_continue_with_the_same_bits),
        HAIR_TEST(hair_sleeps_at_targets_and_wakes_for_new_ones),
        HAIR_TEST(reset_puts_hair_at_its_targets_at_once),
    };
    if (hair_test_skips()) return 0;
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
