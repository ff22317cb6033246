// groom_guide_order_test.c - the order of guides by which small hair simulates fewer of them.
#include "lib/groom/groom.h"
#include "tests/support/handmade.h"
#include "tests/support/host.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>
#include <cmocka.h>

#include "lib/base/math.h"

static struct hair_test_host test;

static hair_groom* make(uint32_t guides)
{
    struct hair_test_handmade wanted = hair_test_handmade_default();
    wanted.guides = guides;
    wanted.turn = 0;
    return hair_test_groom(&test.host, wanted);
}

static float distance_between(const hair_groom* groom, uint32_t a, uint32_t b)
{
    return hair_distance(hair_guide_root(groom, a), hair_guide_root(groom, b));
}

static void order_has_every_guide_once(void** state)
{
    (void)state;
    for (uint32_t guides = 1; guides < 70; ++guides) {
        hair_groom* groom = make(guides);
        bool seen[70] = {false};
        for (uint32_t i = 0; i < guides; ++i) {
            assert_true(groom->guide_order[i] < guides && !seen[groom->guide_order[i]]);
            seen[groom->guide_order[i]] = true;
        }
        hair_groom_destroy(groom);
    }
}

// Return the mean distance of a root from that of its parent, in the order of the groom or in that
// of their numbers.
static double mean_distance(const hair_groom* groom, uint32_t stride, bool in_order)
{
    double sum = 0;
    uint32_t count = groom->info.guide_count;
    for (uint32_t i = 0; i < count; ++i) {
        uint32_t own = i, parent = i - i % stride;
        if (in_order) own = groom->guide_order[own], parent = groom->guide_order[parent];
        sum += (double)distance_between(groom, own, parent);
    }
    return sum / count;
}

// The mean spacing of roots is what an even layout gives.
static void parents_stand_beside_their_guides(void** state)
{
    (void)state;
    hair_groom* groom = make(400);
    for (uint32_t stride = 2; stride <= HAIR_MAX_GUIDE_STRIDE; stride *= 2) {
        double ordered = mean_distance(groom, stride, true), numbered = mean_distance(groom, stride, false);
        // Half a ball of radius 0.1 m has an area of 2 pi 0.01 m^2.
        double spacing = sqrt(2 * 3.14159265 * 0.01 / (400 / stride));
        print_message("    one of %u: %.1f mm from the parent, %.1f mm in the order of numbers\n", stride,
                      1e3 * ordered, 1e3 * numbered);
        assert_true(ordered < 0.6 * spacing && ordered < 0.5 * numbered);
    }
    hair_groom_destroy(groom);
}

// In every whole block, no guide is nearer to the middle than the first one.
static void parents_are_in_the_middle(void** state)
{
    (void)state;
    hair_groom* groom = make(160);
    double of_parent = 0, of_others = 0;
    for (uint32_t i = 0; i < 160; i += 8) {
        hair_vec3 middle = {0, 0, 0};
        for (uint32_t k = 0; k < 8; ++k)
            middle = hair_add(middle, hair_scale(hair_guide_root(groom, groom->guide_order[i + k]), 0.125f));
        for (uint32_t k = 0; k < 8; ++k) {
            double d = (double)hair_distance(middle, hair_guide_root(groom, groom->guide_order[i + k]));
            if (k)
                of_others += d / 7;
            else
                of_parent += d;
        }
    }
    print_message("    parents are %.2f times as far from the middle as others\n", of_parent / of_others);
    assert_true(of_parent < 0.75 * of_others);
    hair_groom_destroy(groom);
}

#define TEST(name) HAIR_TEST_WITH_HOST(name, &test)

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(order_has_every_guide_once),
        TEST(parents_stand_beside_their_guides),
        TEST(parents_are_in_the_middle),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
