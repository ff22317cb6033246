// groom_kd_tree_test.c - a k-d tree of points: its construction, and searches for the nearest
// points.
#include "lib/base/math.h"
#include "lib/groom/kd_tree.h"
#include "tests/support/host.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <cmocka.h>

static struct hair_test_host test;

#define COUNT 500

// Scatter points on a grid of `steps` per axis. With few steps, many points coincide.
static void strew(float* points, uint32_t dimensions, uint32_t steps, uint32_t seed)
{
    for (uint32_t i = 0; i < COUNT * dimensions; ++i)
        points[i] = floorf(hair_random(&seed) * (float)steps) / (float)steps;
}

static float distance_squared(const float* a, const float* b, uint32_t dimensions)
{
    float sum = 0;
    for (uint32_t i = 0; i < dimensions; ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
    return sum;
}

static int compare(const void* a, const void* b)
{
    float x = *(const float*)a, y = *(const float*)b;
    return (x > y) - (x < y);
}

static void nearest_points_equal_a_linear_scan(void** state)
{
    (void)state;
    static float points[COUNT * 12], squared[COUNT];
    for (uint32_t steps = 2; steps < 5000; steps *= 7)
        for (uint32_t dimensions = 1; dimensions <= 12; ++dimensions) {
            struct hair_kd_tree tree;
            strew(points, dimensions, steps, dimensions);
            assert_int_equal(
                hair_kd_tree_build(&test.host, (struct hair_point_set){points, dimensions}, COUNT, &tree),
                HAIR_OK);
            for (uint32_t i = 0; i < 100; ++i) {
                struct hair_kd_neighbor near[8];
                float point[12];
                uint32_t seed = 1000 + i;
                for (uint32_t a = 0; a < dimensions; ++a) point[a] = hair_random(&seed);
                for (uint32_t j = 0; j < COUNT; ++j)
                    squared[j] = distance_squared(points + dimensions * j, point, dimensions);
                assert_int_equal(hair_kd_tree_nearest(&tree, point, near, 0, 8), 8);
                for (int k = 0; k < 8; ++k) assert_true(near[k].squared == squared[near[k].index]);
                qsort(squared, COUNT, sizeof *squared, compare);
                for (int k = 0; k < 8; ++k) assert_true(near[k].squared == squared[k]);
            }
            hair_kd_tree_free(&test.host, &tree);
        }
}

static void search_with_a_known_point_finds_a_nearer_or_keeps_it(void** state)
{
    (void)state;
    static float points[COUNT * 3];
    struct hair_kd_tree tree;
    strew(points, 3, 100, 1);
    assert_int_equal(hair_kd_tree_build(&test.host, (struct hair_point_set){points, 3}, COUNT, &tree),
                     HAIR_OK);
    for (uint32_t i = 0; i < COUNT; ++i) {
        float point[3] = {points[3 * i] + 0.001f, points[3 * i + 1], points[3 * i + 2]};
        struct hair_kd_neighbor blind, known = {i, distance_squared(points + 3 * i, point, 3)};
        hair_kd_tree_nearest(&tree, point, &blind, 0, 1);
        assert_int_equal(hair_kd_tree_nearest(&tree, point, &known, 1, 1), 1);
        assert_true(known.squared == blind.squared);
    }
    hair_kd_tree_free(&test.host, &tree);
}

static void search_for_more_points_finds_all_points(void** state)
{
    (void)state;
    float points[] = {0, 0, 0, 1, 0, 0, 2, 0, 0}, point[] = {1.9f, 0, 0};
    struct hair_kd_neighbor near[8];
    struct hair_kd_tree tree;
    assert_int_equal(hair_kd_tree_build(&test.host, (struct hair_point_set){points, 3}, 3, &tree), HAIR_OK);
    assert_int_equal(hair_kd_tree_nearest(&tree, point, near, 0, 8), 3);
    assert_int_equal(near[0].index, 2);
    assert_int_equal(near[1].index, 1);
    assert_int_equal(near[2].index, 0);
    hair_kd_tree_free(&test.host, &tree);
}

static void split_keeps_points_on_their_sides_within_its_weight(void** state)
{
    (void)state;
    static float points[COUNT * 3];
    static uint32_t order[COUNT], weights[COUNT];
    for (uint32_t steps = 1; steps < 5000; steps *= 4)
        for (uint32_t target = 0; target < 4 * COUNT; target += 37) {
            uint32_t seed = target, seen = 0;
            strew(points, 3, steps, target);
            for (uint32_t i = 0; i < COUNT; ++i) order[i] = i, weights[i] = 1 + hair_hash(++seed) % 3;
            struct hair_point_set point_set = {points, 3};
            uint32_t front = hair_kd_split(point_set, order, COUNT, 1, weights, target);
            assert_in_range(front, 1, COUNT - 1);
            float max = -1;
            uint64_t weight = 0;
            for (uint32_t i = 0; i < COUNT; ++i) {
                float x = points[3 * order[i] + 1];
                seen += order[i];
                if (i < front) {
                    max = fmaxf(max, x);
                    weight += weights[order[i]];
                } else {
                    assert_true(x >= max);
                    if (target >= 3) assert_true(x >= points[3 * order[front] + 1]);
                }
            }
            assert_int_equal(seen, COUNT * (COUNT - 1) / 2);
            if (front > 1) assert_true(weight <= target);
            if (front < COUNT - 1) assert_true(weight + weights[order[front]] > target);
        }
}

static void widest_axis_is_that_of_the_largest_extent(void** state)
{
    (void)state;
    float points[] = {0, 0, 0, 1, -3, 2, 0.5f, 1, 1};
    uint32_t order[] = {0, 1, 2};
    struct hair_point_set point_set = {points, 3};
    assert_int_equal(hair_kd_widest_axis(point_set, order, 3), 1);
    uint32_t two[] = {0, 2};
    assert_int_equal(hair_kd_widest_axis(point_set, two, 2), 1);
    uint32_t others[] = {2, 0};
    points[7] = 0;
    assert_int_equal(hair_kd_widest_axis(point_set, others, 2), 2);
}

#define TEST(name) HAIR_TEST_WITH_HOST(name, &test)

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(nearest_points_equal_a_linear_scan),
        TEST(search_with_a_known_point_finds_a_nearer_or_keeps_it),
        TEST(search_for_more_points_finds_all_points),
        TEST(split_keeps_points_on_their_sides_within_its_weight),
        TEST(widest_axis_is_that_of_the_largest_extent),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
