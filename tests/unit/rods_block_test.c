// rods_block_test.c - guides that are computed in blocks, beside each guide computed alone by the
// scalar functions of tests/support/rod_statics.h.
#define _POSIX_C_SOURCE 200809L
#include "tests/support/support.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "tests/support/rod_statics.h"
#include "tests/support/rods.h"

#define GUIDES 61 // Not a multiple of the lanes of a block.
#define MAX_VERTICES 40
#define PI 3.141592653589793

static struct hair_guide guides[GUIDES];
static struct hair_rest rest[GUIDES * MAX_VERTICES];
static struct hair_rod_borne borne[GUIDES * MAX_VERTICES], alone[GUIDES * MAX_VERTICES];

static double fraction(uint32_t* seed)
{
    *seed = *seed * 1664525u + 1013904223u;
    return (double)(*seed >> 8) / (1 << 24);
}

// Cut a guide at a vertex. The tip keeps the length that is cut off.
static void cut_guide(struct hair_guide* guide, uint32_t count)
{
    struct hair_rest* own = rest + guide->first;
    float lost = 0;
    for (uint32_t i = count - 1; i + 1 < guide->count; ++i) lost += own[i].position.w;
    own[count - 1].position.w = lost;
    guide->count = count;
    guide->arc_length -= lost;
}

// Set guides of different shapes and numbers of vertices. Every third guide is cut. `curl` is the
// radius of a curl, m. Return the number of vertices.
static uint32_t set_guides(uint32_t* seed, double length, double curl, uint32_t vertices)
{
    struct hair_test_rod* f = hair_test_rod_make();
    float place[3 * MAX_VERTICES];
    uint32_t first = 0;
    for (uint32_t k = 0; k < GUIDES; ++k) {
        uint32_t count = vertices ? vertices : 2 + (uint32_t)(fraction(seed) * (MAX_VERTICES - 2));
        double lean = PI * fraction(seed), fall = 2 * fraction(seed), phase = 2 * PI * fraction(seed);
        double at[3] = {0}, own = length * (0.2 + 0.8 * fraction(seed));
        for (uint32_t i = 0; i < count; ++i) {
            double t = (double)i / (count - 1), size = curl * fmin(1, 4 * t);
            double way[3] = {sin(lean), cos(lean) - fall * t, 0.1}, norm = 0;
            place[3 * i] = (float)(at[0] + size * (cos(20 * t + phase) - cos(phase)));
            place[3 * i + 1] = (float)at[1];
            place[3 * i + 2] = (float)(at[2] + size * (sin(20 * t + phase) - sin(phase)));
            for (int n = 0; n < 3; ++n) norm += way[n] * way[n];
            for (int n = 0; n < 3; ++n) at[n] += own / (count - 1) * way[n] / sqrt(norm);
        }
        hair_test_rod_place(f, count, place);
        guides[k] = f->guide;
        guides[k].first = first;
        memcpy(rest + first, f->rest, count * sizeof *rest);
        if (k % 3 == 2) cut_guide(&guides[k], count / 2 + 1);
        first += guides[k].count;
    }
    free(f);
    return first;
}

// Compute the preload of each guide alone. Return the report.
static struct hair_rods_report preload_alone(const hair_physics* physics)
{
    struct hair_rods_report report = hair_rods_report_none();
    for (uint32_t k = 0; k < GUIDES; ++k) {
        struct hair_rod_shape shape;
        double bend[HAIR_MAX_GUIDE_VERTICES];
        hair_rod_shape_of(guides + k, rest + guides[k].first, physics, &shape);
        memcpy(bend, shape.bend, sizeof bend);
        struct hair_rod_preload held = hair_rod_preload_gravity(&shape);
        for (uint32_t i = 0; i < shape.count; ++i)
            alone[guides[k].first + i] =
                (struct hair_rod_borne){{shape.stress[i].x, shape.stress[i].y, shape.stress[i].z},
                                        shape.rest_real[i],
                                        bend[i] > 0 ? shape.bend[i] / bend[i] : 1};
        report.stiffened += held.stiffest > 1;
        report.sagging += (uint32_t)held.sags;
        report.stiffest = fmaxf(report.stiffest, (float)held.stiffest);
        report.farthest_sag = fmaxf(report.farthest_sag, (float)held.sag);
    }
    return report;
}

static hair_physics physics_of(uint32_t* seed, uint32_t round)
{
    hair_physics physics = hair_physics_default();
    physics.fiber.youngs_modulus *= (float)pow(10, 3 * fraction(seed) - 1.5);
    physics.fiber.radius *= (float)(0.5 + 1.5 * fraction(seed));
    if (round % 3 == 0) physics.tip_mass = (float)(20 * fraction(seed));
    if (round % 4 == 0) physics.fiber.flatness = (float)(0.4 + 0.6 * fraction(seed));
    if (round % 5 == 0) physics.shape.frequency_root = physics.shape.frequency_tip = 0;
    if (round % 6 == 0) physics.shape.gravity_preload = (float)fraction(seed);
    if (round % 7 == 0) physics.shape.stiffness_tip = (float)fraction(seed);
    if (round % 16 == 15) physics.shape.stiffness_root = 0;
    if (round % 16 == 14) physics.root = HAIR_ROOT_HINGED;
    return physics;
}

// Compare the guides with those computed alone. Rounding differs, but no decision may.
static void compare_guides(uint32_t count)
{
    double max = 0;
    for (uint32_t i = 0; i < count; ++i)
        for (int n = 0; n < 3; ++n) max = fmax(max, fabs(alone[i].stress[n]));
    for (uint32_t i = 0; i < count; ++i) {
        for (int n = 0; n < 3; ++n)
            hair_test_near("stress", i, borne[i].stress[n], alone[i].stress[n], 1e-7 * max);
        hair_test_near("real part", i, borne[i].rest_real, alone[i].rest_real, 1e-7);
        assert_true(borne[i].stiffen == alone[i].stiffen);
    }
}

static void other_guides_of_a_block_change_no_bit(void** state)
{
    (void)state;
    uint32_t seed = 5;
    hair_physics physics = hair_physics_default();
    struct hair_rods_report report;
    uint32_t count = set_guides(&seed, 0.25, 0.005, 0);
    hair_rods_preload_gravity(NULL, guides, rest, GUIDES, &physics, borne, &report);
    for (uint32_t k = 0; k < GUIDES; ++k)
        hair_rods_preload_gravity(NULL, guides + k, rest, 1, &physics, alone, &report);
    assert_memory_equal(borne, alone, count * sizeof *borne);
}

static void blocks_give_the_numbers_of_single_guides(void** state)
{
    (void)state;
    uint32_t seed = 1, stiffened = 0, sagging = 0, held = 0;
    for (uint32_t round = 0; round < 64; ++round) {
        hair_physics physics = physics_of(&seed, round);
        uint32_t vertices = round % 2 ? 0 : 2 + round % 30;
        double length = 0.01 + 0.4 * fraction(&seed), curl = round % 3 ? 0.02 * fraction(&seed) : 0;
        uint32_t count = set_guides(&seed, length, curl, vertices);
        struct hair_rods_report report, own = preload_alone(&physics);
        assert_int_equal(hair_rods_preload_gravity(NULL, guides, rest, GUIDES, &physics, borne, &report),
                         HAIR_OK);
        assert_true(report.stiffened == own.stiffened && report.sagging == own.sagging);
        assert_true(report.stiffest == own.stiffest);
        hair_test_near("farthest sag", round, (double)report.farthest_sag, (double)own.farthest_sag, 1e-6);
        compare_guides(count);
        stiffened += own.stiffened;
        sagging += own.sagging;
        held += GUIDES - own.stiffened;
    }
    printf("%u guides hold, %u are stiffened, of which %u sag\n", held, stiffened, sagging);
    assert_true(held > 500 && sagging > 500 && stiffened > sagging + 300);
}

static double thread_time(void)
{
    struct timespec time = {0};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

// Both times are from the same run, so that the speed of the machine cancels.
static void blocks_cost_less_than_single_guides(void** state)
{
    (void)state;
    uint32_t seed = 2;
    hair_physics physics = hair_physics_default();
    struct hair_rods_report report;
    double block = INFINITY, single = INFINITY;
    set_guides(&seed, 0.25, 0, 32);
    for (int k = 0; k < 5; ++k) {
        double start = thread_time();
        hair_rods_preload_gravity(NULL, guides, rest, GUIDES, &physics, borne, &report);
        double middle = thread_time();
        preload_alone(&physics);
        block = fmin(block, middle - start);
        single = fmin(single, thread_time() - middle);
    }
    printf("%.1f us a guide in blocks, %.1f alone\n", 1e6 * block / GUIDES, 1e6 * single / GUIDES);
    // Builds without optimization, and with sanitizers, are no measure.
#if defined(NDEBUG) && defined(__x86_64__)
    if (__builtin_cpu_supports("avx2")) assert_true(block < 0.6 * single);
#endif
}

static struct hair_test_host test;

static void refused_memory_is_an_error(void** state)
{
    (void)state;
    uint32_t seed = 3;
    hair_physics physics = hair_physics_default();
    struct hair_rods_report report;
    set_guides(&seed, 0.1, 0, 8);
    for (uint32_t nth = 1; nth <= 2; ++nth) {
        test.refuse = test.allocations + nth;
        assert_int_equal(
            hair_rods_preload_gravity(&test.host, guides, rest, GUIDES, &physics, borne, &report),
            HAIR_ERROR_MEMORY);
        assert_int_equal(test.blocks, 0);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(blocks_give_the_numbers_of_single_guides),
        cmocka_unit_test(other_guides_of_a_block_change_no_bit),
        cmocka_unit_test(blocks_cost_less_than_single_guides),
        HAIR_TEST_WITH_HOST(refused_memory_is_an_error, &test),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
