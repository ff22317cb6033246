// save_test.c - a run that is saved and loaded continues with the same bits, whatever else runs
// beside it. HAIR_TEST_FULL=1 saves at twice as many moments.
#include "tests/support/motion.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define AFTER 14 // Number of steps compared after loading.

// Record the run from the i-th move on. Between a move and its step nothing is settled.
static void follow(struct hair_test* test, hair_instance* hair, const struct hair_test_subject* subject,
                   uint32_t i, struct hair_test_seen seen[AFTER + 1])
{
    hair_test_look(test, hair, &seen[0]);
    for (uint32_t k = 1; k <= AFTER; ++k) {
        hair_test_step(test, hair, subject, i + k - 1);
        hair_test_look(test, hair, &seen[k]);
        hair_test_move(test, hair, subject, i + k);
    }
}

// Load into the same instance, which has moved on, and into a new one. Return whether time had
// passed since the last substep.
static int check_run(struct hair_test* test, const struct hair_test_subject* subject, uint32_t i)
{
    static struct hair_test_seen straight[AFTER + 1], again[AFTER + 1];
    hair_instance* hair = hair_test_subject_make(test, subject);
    hair_test_run(test, hair, subject, 0, i);
    hair_test_move(test, hair, subject, i);
    int between = hair->sim.accumulator > 0.05 * hair->sim.substep;
    struct hair_test_blob blob = hair_test_save(test, hair);
    follow(test, hair, subject, i, straight);
    for (int fresh = 0; fresh < 2; ++fresh) {
        if (fresh) {
            hair_destroy(hair);
            hair = hair_test_subject_make(test, subject);
        }
        // The GPU still runs this when the state is loaded.
        hair_test_run(test, hair, subject, 20, 23);
        hair_test_set(test, hair, subject, i);
        hair_test_ok(test, hair_load(hair, blob.bytes, blob.size));
        follow(test, hair, subject, i, again);
        for (uint32_t k = 0; k <= AFTER; ++k) hair_test_same(&again[k], &straight[k]);
    }
    hair_destroy(hair);
    free(blob.bytes);
    return between;
}

static void saved_and_loaded_run_gives_equal_bits(void** state)
{
    static const uint32_t saved[] = {0, 7, 12, 17, 28}; // 12 ends in a teleport, 28 in a reset.
    bool is_long = getenv("HAIR_TEST_FULL");
    int between = 0, all = 0;
    for (uint32_t way = 0; way < HAIR_TEST_WAYS; ++way)
        for (uint32_t i = 0; i < sizeof saved / sizeof *saved; ++i) {
            // Every pair of way, moment and subject occurs once in the long run. The short run has
            // one subject a way, because subjects have programs of their own.
            if ((way + i) % 2 && !is_long) continue;
            ++all;
            uint32_t which = (is_long ? way + i : way) % HAIR_TEST_SUBJECTS;
            struct hair_test_subject subject = hair_test_subject_of(which);
            subject.desc.solver = hair_test_way((int)way).solver;
            subject.desc.thread_mapping = hair_test_way((int)way).thread_mapping;
            between += check_run(*state, &subject, saved[i]);
        }
    print_message("    %d of %d between two substeps\n", between, all);
    assert_true(between > all / 2);
}

// Check that a loaded state saves as the bytes it was loaded from.
static void loaded_state_saves_as_equal_bytes(void** state)
{
    struct hair_test* test = *state;
    struct hair_test_subject subject = hair_test_subject_of(0);
    hair_instance* hair[2] = {hair_test_subject_make(test, &subject), hair_test_subject_make(test, &subject)};
    hair_test_run(test, hair[0], &subject, 0, 10);
    struct hair_test_blob first = hair_test_save(test, hair[0]);
    hair_test_ok(test, hair_load(hair[1], first.bytes, first.size));
    struct hair_test_blob second = hair_test_save(test, hair[1]);
    assert_int_equal(second.size, first.size);
    assert_memory_equal(second.bytes, first.bytes, first.size);
    for (int i = 0; i < 2; ++i) hair_destroy(hair[i]);
    free(first.bytes), free(second.bytes);
}

// Check that loading keeps the instance's own settings.
static void loading_leaves_physics_and_look_as_they_are(void** state)
{
    struct hair_test* test = *state;
    struct hair_test_subject subject = hair_test_subject_of(0);
    hair_instance* from = hair_test_subject_make(test, &subject);
    subject.physics.damping = 77;
    hair_instance* into = hair_test_subject_make(test, &subject);
    hair_look own = hair_look_default();
    own.strand.segments = 3;
    hair_test_ok(test, hair_set_look(into, &own));
    struct hair_test_blob blob = hair_test_save(test, from);
    hair_test_ok(test, hair_load(into, blob.bytes, blob.size));
    assert_true(into->sim.physics.damping == 77);
    assert_memory_equal(&into->geometry.look, &own, sizeof own);
    hair_destroy(from);
    hair_destroy(into);
    free(blob.bytes);
}

static void interleaved_instances_give_the_bits_of_each_alone(void** state)
{
    static struct hair_test_seen alone[3][2], beside;
    struct hair_test* test = *state;
    uint32_t random = 5, done[3] = {0}, left = 3;
    struct hair_test_subject subjects[3];
    hair_instance* hair[3];
    for (uint32_t n = 0; n < 3; ++n) {
        subjects[n] = hair_test_subject_of(n);
        if (n > 0)
            subjects[n].physics.hair_hair.cohesion = 6,
            subjects[n].physics.hair_hair.pressure_stiffness = 0.2f;
        hair[n] = hair_test_subject_make(test, &subjects[n]);
        for (uint32_t half = 0; half < 2; ++half) {
            hair_test_run(test, hair[n], &subjects[n], 20 * half, 20 * half + 20);
            hair_test_look(test, hair[n], &alone[n][half]);
        }
        hair_destroy(hair[n]);
    }
    for (uint32_t n = 0; n < 3; ++n) hair[n] = hair_test_subject_make(test, &subjects[n]);
    while (left) {
        uint32_t n = (uint32_t)(3 * hair_random(&random));
        uint32_t steps = 1 + (uint32_t)(2 * hair_random(&random));
        for (; steps && done[n] < 40; --steps) {
            hair_test_run(test, hair[n], &subjects[n], done[n], done[n] + 1);
            if (++done[n] % 20) continue;
            hair_test_look(test, hair[n], &beside);
            hair_test_same(&beside, &alone[n][done[n] / 20 - 1]);
            left -= done[n] == 40;
        }
    }
    for (uint32_t n = 0; n < 3; ++n) hair_destroy(hair[n]);
}

// Check a transform that was set without a step. It must not rotate the hair where the last step
// left it.
// Guides stay to the rounding of numbers. A follower that is pushed out of a body may stop anywhere
// within the depth that it may keep, NEAR_ENOUGH of repair_push.glsl: a change in the last bit can
// decide whether there is one more round.
static void teleport_by_nothing_after_set_transform_keeps_hair(void** state)
{
    static struct hair_test_seen once, twice;
    struct hair_test* test = *state;
    struct hair_test_subject subject = hair_test_subject_of(0);
    hair_instance* hair = hair_test_subject_make(test, &subject);
    float there[16], identity[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    hair_test_run(test, hair, &subject, 0, 4);
    hair_test_ok(test, hair_teleport(hair, identity));
    hair_test_look(test, hair, &once);
    hair_test_pose(3, there);
    hair_test_ok(test, hair_set_transform(hair, there));
    hair_test_ok(test, hair_teleport(hair, there)); // Moves by nothing.
    hair_test_look(test, hair, &twice);
    assert_int_equal(once.count, twice.count);
    size_t first = once.count - once.followers;
    for (size_t i = 0; i < once.count; ++i)
        hair_test_near(i < first ? "number" : "number of followers", i, (double)twice.number[i],
                       (double)once.number[i], i < first ? 1e-6 : 2e-5);
    hair_destroy(hair);
}

static void save_into_too_few_bytes_names_both_sizes(void** state)
{
    struct hair_test* test = *state;
    struct hair_test_subject subject = hair_test_subject_of(0);
    hair_instance* hair = hair_test_subject_make(test, &subject);
    size_t size = 0, again = 0;
    char words[96];
    hair_test_ok(test, hair_save(hair, NULL, 0, &size));
    unsigned char* bytes = malloc(size + 1);
    memset(bytes, 0xa5, size + 1);
    for (size_t capacity = 0; capacity < size; capacity += 1 + capacity / 2) {
        snprintf(words, sizeof words, "capacity is %zu, less than the state's %zu bytes", capacity, size);
        hair_test_refused(test, hair_save(hair, bytes, capacity, &again), HAIR_ERROR_ARGUMENT, words);
        assert_int_equal(again, size);
        for (size_t i = 0; i <= size; ++i) assert_int_equal(bytes[i], 0xa5);
    }
    hair_test_ok(test, hair_save(hair, bytes, size, &again));
    assert_int_equal(again, size);
    assert_int_equal(bytes[size], 0xa5);
    hair_test_ok(test, hair_save(hair, bytes, SIZE_MAX, &again));
    hair_destroy(hair);
    free(bytes);
}

int main(void)
{
    if (hair_test_skips()) return 0;
    const struct CMUnitTest tests[] = {
        HAIR_TEST(saved_and_loaded_run_gives_equal_bits),
        HAIR_TEST(loaded_state_saves_as_equal_bytes),
        HAIR_TEST(loading_leaves_physics_and_look_as_they_are),
        HAIR_TEST(interleaved_instances_give_the_bits_of_each_alone),
        HAIR_TEST(teleport_by_nothing_after_set_transform_keeps_hair),
        HAIR_TEST(save_into_too_few_bytes_names_both_sizes),
    };
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
