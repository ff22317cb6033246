// strands_test.c - imported strands become fit for simulation.
#include "lib/asset/strands.h"
#include "lib/base/math.h"
#include "tests/support/files.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>
#include <cmocka.h>

static struct hair_test_host test;
static hair_import_stats repairs;
static const hair_tasks no_tasks;

static void clean(const hair_import* import, struct hair_strands* strands)
{
    assert_int_equal(hair_strands_clean(&test.host, &no_tasks, import, strands, &repairs), HAIR_OK);
}

static void drop(struct hair_strands* strands)
{
    hair_strands_free(&test.host, strands);
}

static void clean_strands_are_left_as_they_are(void** state)
{
    (void)state;
    hair_import import = hair_test_import();
    struct hair_strands strands = hair_test_import_strands(&test, 10, 20),
                        same = hair_test_import_strands(&test, 10, 20);
    clean(&import, &strands);
    assert_int_equal(strands.strand_count, 10);
    assert_memory_equal(strands.positions, same.positions, 12 * 200);
    assert_memory_equal(strands.vertices, same.vertices, 40);
    hair_import_stats none = {0};
    assert_memory_equal(&repairs, &none, sizeof none);
    drop(&strands);
    drop(&same);
}

static void scale_turns_units_into_metres(void** state)
{
    (void)state;
    hair_import import = hair_test_import();
    import.scale = 0.01f;
    struct hair_strands strands = hair_test_import_strands(&test, 3, 3);
    clean(&import, &strands);
    assert_float_equal(strands.positions[3], 1e-4f, 1e-9);
    assert_float_equal(strands.positions[3 * 8 + 2], 0.02f, 1e-8);
    assert_float_equal(strands.radii[2], 0.02f, 1e-8);
    drop(&strands);
}

static void up_axis_is_rotated_to_y_without_mirroring(void** state)
{
    (void)state;
    hair_up ups[2] = {HAIR_UP_Z, HAIR_UP_X};
    hair_vec3 want[2] = {{1, 3, -2}, {-2, 1, 3}};
    for (int i = 0; i < 2; ++i) {
        hair_import import = hair_test_import();
        import.up = ups[i];
        struct hair_strands strands = hair_test_import_strands(&test, 1, 4);
        // A corner of the axes. Its handedness reveals mirroring.
        float corner[12] = {1, 2, 3, 2, 2, 3, 2, 3, 3, 2, 3, 4};
        memcpy(strands.positions, corner, sizeof corner);
        clean(&import, &strands);
        hair_vec3 p = hair_load3(strands.positions);
        assert_memory_equal(&p, &want[i], sizeof p);
        hair_vec3 a = hair_sub(hair_load3(strands.positions + 3), p);
        hair_vec3 b = hair_sub(hair_load3(strands.positions + 6), hair_load3(strands.positions + 3));
        hair_vec3 c = hair_sub(hair_load3(strands.positions + 9), hair_load3(strands.positions + 6));
        assert_float_equal(hair_dot(hair_cross(a, b), c), 1, 1e-6);
        assert_float_equal(i ? a.y : c.y, 1, 1e-6); // The up axis.
        drop(&strands);
    }
}

static void tip_first_strands_are_reversed(void** state)
{
    (void)state;
    hair_import import = hair_test_import();
    import.tip_first = true;
    struct hair_strands strands = hair_test_import_strands(&test, 2, 5);
    clean(&import, &strands);
    for (uint32_t i = 0; i < 10; ++i) {
        assert_float_equal(strands.positions[3 * i], 0.01f * (float)(4 - i % 5), 0);
        assert_float_equal(strands.positions[3 * i + 2], (float)(i / 5), 0);
    }
    drop(&strands);
}

static void keep_fraction_keeps_strands_evenly(void** state)
{
    (void)state;
    const float fractions[] = {1e-6f, 0.001f, 0.1f, 0.25f, 1.0f / 3, 0.5f, 0.77f, 0.999f};
    const uint32_t counts[] = {1, 2, 3, 10, 97, 1000};
    for (size_t s = 0; s < 8; ++s)
        for (size_t c = 0; c < 6; ++c) {
            hair_import import = hair_test_import();
            import.keep_fraction = fractions[s];
            struct hair_strands strands = hair_test_import_strands(&test, counts[c], 3);
            clean(&import, &strands);
            double wanted = (double)fractions[s] * counts[c];
            assert_true(strands.strand_count >= fmax(1, floor(wanted)));
            assert_true(strands.strand_count <= fmax(1, ceil(wanted)));
            // z identifies the strand. Strands are in order and unique, without a gap wider than
            // two runs, and keep their radii.
            float last = -1;
            for (uint32_t i = 0; i < strands.strand_count; ++i) {
                float z = strands.positions[9 * i + 2];
                assert_true(z > last && z - last <= 2.0 * counts[c] / strands.strand_count + 1);
                assert_float_equal(strands.radii[i], z, 0);
                last = z;
            }
            drop(&strands);
        }
}

static void kept_strands_depend_only_on_the_seed(void** state)
{
    (void)state;
    hair_import import = hair_test_import();
    import.keep_fraction = 0.1f;
    struct hair_strands strands[3];
    for (uint32_t i = 0; i < 3; ++i) {
        import.seed = i / 2;
        strands[i] = hair_test_import_strands(&test, 1000, 3);
        clean(&import, &strands[i]);
        assert_int_equal(strands[i].strand_count, 100);
    }
    assert_memory_equal(strands[0].positions, strands[1].positions, 9 * 4 * 100);
    assert_memory_not_equal(strands[0].positions, strands[2].positions, 9 * 4 * 100);
    for (uint32_t i = 0; i < 3; ++i) drop(&strands[i]);
}

static void nonfinite_and_far_vertices_are_removed_and_counted(void** state)
{
    (void)state;
    hair_import import = hair_test_import();
    struct hair_strands strands = hair_test_import_strands(&test, 2, 8);
    strands.positions[0] = NAN;
    strands.positions[3 + 1] = INFINITY;
    strands.positions[9 + 2] = -1e38f;
    strands.positions[12] = 1.1e6f;
    strands.positions[15 + 2] = 1e-45f; // Denormal numbers are accepted.
    clean(&import, &strands);
    assert_int_equal(repairs.removed_nonfinite, 4);
    assert_int_equal(strands.vertices[0], 4);
    assert_int_equal(strands.vertices[1], 8);
    assert_float_equal(strands.positions[0], 0.02f, 0);
    hair_test_assert_fit(&strands);
    drop(&strands);
}

static void scaling_beyond_the_range_of_floats_removes_vertices(void** state)
{
    (void)state;
    hair_import import = hair_test_import();
    import.scale = 1e6f;
    struct hair_strands strands = hair_test_import_strands(&test, 1, 3);
    strands.positions[3] = 1e38f;
    clean(&import, &strands);
    assert_int_equal(repairs.removed_nonfinite, 1);
    assert_int_equal(strands.vertices[0], 2);
    drop(&strands);
}

static void repeated_vertices_are_merged_and_counted(void** state)
{
    (void)state;
    hair_import import = hair_test_import();
    // The strand is 9 cm long. Vertices closer than 0.9 micrometres count as repeated.
    struct hair_strands strands = hair_test_import_strands(&test, 1, 10);
    strands.positions[3 * 1] = strands.positions[0];
    strands.positions[3 * 2] = strands.positions[0] + 0.8e-6f;
    strands.positions[3 * 5] = strands.positions[3 * 4] + 1e-6f;
    clean(&import, &strands);
    assert_int_equal(repairs.removed_repeated, 2);
    assert_int_equal(strands.vertices[0], 8);
    hair_test_assert_fit(&strands);
    drop(&strands);
}

static void creeping_strands_keep_their_shape(void** state)
{
    (void)state;
    // Each step is below the limit, but their sum is most of the strand.
    hair_import import = hair_test_import();
    struct hair_strands strands = hair_test_import_strands(&test, 1, 200001);
    for (uint32_t i = 0; i < 200001; ++i) strands.positions[3 * i] = 1e-6f * (float)i;
    clean(&import, &strands);
    assert_float_equal(hair_strand_length(strands.positions, strands.vertices[0]), 0.2, 1e-3);
    assert_true(repairs.removed_repeated > 1000);
    hair_test_assert_fit(&strands);
    drop(&strands);
}

static void strands_of_one_vertex_are_dropped_and_counted(void** state)
{
    (void)state;
    hair_import import = hair_test_import();
    struct hair_strands strands = hair_test_import_strands(&test, 4, 3);
    strands.vertices[0] = 1; // The strands have 1, 5, 0 and 6 vertices.
    strands.vertices[1] = 5;
    strands.vertices[2] = 0;
    strands.vertices[3] = 6;
    for (uint32_t i = 1; i < 5; ++i) strands.positions[3 * i + 1] = NAN;
    clean(&import, &strands);
    assert_int_equal(repairs.dropped_single, 3);
    assert_int_equal(repairs.removed_nonfinite, 4);
    assert_int_equal(strands.strand_count, 1);
    assert_float_equal(strands.radii[0], 3, 0);
    hair_test_assert_fit(&strands);
    drop(&strands);
}

static void strands_shorter_than_10_micrometres_are_dropped_and_counted(void** state)
{
    (void)state;
    hair_import import = hair_test_import();
    struct hair_strands strands = hair_test_import_strands(&test, 3, 2);
    strands.positions[3] = 0.9e-5f;
    strands.positions[9] = 0; // The strand has no length.
    strands.positions[15] = 1.1e-5f;
    clean(&import, &strands);
    assert_int_equal(repairs.dropped_short, 2);
    assert_int_equal(strands.strand_count, 1);
    hair_test_assert_fit(&strands);
    drop(&strands);
}

static void import_that_drops_every_strand_succeeds(void** state)
{
    (void)state;
    hair_import import = hair_test_import();
    struct hair_strands strands = hair_test_import_strands(&test, 5, 2);
    for (uint32_t i = 0; i < 30; ++i) strands.positions[i] = NAN;
    import.strand_vertices = 16;
    clean(&import, &strands);
    assert_int_equal(strands.strand_count, 0);
    assert_int_equal(strands.vertex_count, 0);
    assert_int_equal(repairs.dropped_single, 5);
    drop(&strands);
}

static float random_float(uint32_t* random)
{
    // All bit patterns, then ordinary numbers, and then few values, so that they repeat.
    *random = hair_hash(*random);
    uint32_t kind = *random % 4, bits = hair_hash(*random + 1);
    float value;
    memcpy(&value, &bits, sizeof value);
    if (kind == 0) return value;
    if (kind == 1) return (float)(bits % 4) * 1e-5f;
    return (float)(bits % 1000) * 0.001f;
}

static void strands_of_any_bits_become_valid(void** state)
{
    (void)state;
    uint32_t random = 7, kept = 0;
    for (uint32_t round = 0; round < 2000; ++round) {
        hair_import import = hair_test_import();
        import.strand_vertices = round % 3 ? 0 : round % 257;
        import.tip_first = round & 1;
        import.up = (hair_up)(round % 3);
        import.keep_fraction = round % 5 ? 1 : 0.5f;
        uint32_t each = 1 + hair_hash(round) % (round % 50 ? 12 : 600);
        struct hair_strands strands = hair_test_import_strands(&test, 20, each);
        for (uint32_t i = 0; i < 3 * strands.vertex_count; ++i) strands.positions[i] = random_float(&random);
        clean(&import, &strands);
        hair_test_assert_fit(&strands);
        kept += strands.strand_count;

        import = hair_test_import();
        struct hair_strands same = {.strand_count = strands.strand_count,
                                    .vertex_count = strands.vertex_count};
        same.positions = hair_alloc(&test.host, strands.vertex_count, 12);
        memcpy(same.positions, strands.positions, 12 * (size_t)strands.vertex_count);
        clean(&import, &strands);
        assert_int_equal(strands.vertex_count, same.vertex_count);
        assert_memory_equal(strands.positions, same.positions, 12 * (size_t)strands.vertex_count);
        drop(&same);
        drop(&strands);
    }
    assert_true(kept > 10000);
}

static void four_million_strands_take_no_longer_than_their_number(void** state)
{
    (void)state;
    hair_import import = hair_test_import();
    import.keep_fraction = 0.5f;
    import.scale = 0.1f; // With this scale, no strand is beyond 1e6 m.
    struct hair_strands strands = hair_test_import_strands(&test, 4194304, 2);
    size_t before = test.live;
    clean(&import, &strands);
    assert_int_equal(strands.strand_count, 2097152);
    assert_true(test.peak < before + (1 << 20));
    drop(&strands);
}

static void unused_memory_of_an_import_is_freed(void** state)
{
    (void)state;
    hair_import import = hair_test_import();
    import.keep_fraction = 0.01f;
    struct hair_strands strands = hair_test_import_strands(&test, 10000, 10);
    clean(&import, &strands);
    assert_true(test.live < 100 * 10 * 12 + 100 * 8 + 3 * 16 + 16);
    drop(&strands);
}

static void every_refused_allocation_is_an_error_and_leaks_nothing(void** state)
{
    (void)state;
    uint32_t failures = 0;
    for (uint32_t refuse = 1;; ++refuse) {
        hair_import import = hair_test_import();
        import.strand_vertices = 8;
        import.keep_fraction = 0.1f;
        struct hair_strands strands = hair_test_import_strands(&test, 1000, 16);
        test.allocations = 0;
        test.refuse = refuse;
        hair_result result = hair_strands_clean(&test.host, &no_tasks, &import, &strands, &repairs);
        test.refuse = 0;
        drop(&strands);
        assert_int_equal(test.blocks, 0);
        if (result == HAIR_OK) break;
        assert_int_equal(result, HAIR_ERROR_MEMORY);
        assert_int_equal(test.errors, ++failures);
    }
    assert_true(failures >= 3);
}

#define TEST(name) HAIR_TEST_WITH_HOST(name, &test)

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(clean_strands_are_left_as_they_are),
        TEST(scale_turns_units_into_metres),
        TEST(up_axis_is_rotated_to_y_without_mirroring),
        TEST(tip_first_strands_are_reversed),
        TEST(keep_fraction_keeps_strands_evenly),
        TEST(kept_strands_depend_only_on_the_seed),
        TEST(nonfinite_and_far_vertices_are_removed_and_counted),
        TEST(scaling_beyond_the_range_of_floats_removes_vertices),
        TEST(repeated_vertices_are_merged_and_counted),
        TEST(creeping_strands_keep_their_shape),
        TEST(strands_of_one_vertex_are_dropped_and_counted),
        TEST(strands_shorter_than_10_micrometres_are_dropped_and_counted),
        TEST(import_that_drops_every_strand_succeeds),
        TEST(strands_of_any_bits_become_valid),
        TEST(four_million_strands_take_no_longer_than_their_number),
        TEST(unused_memory_of_an_import_is_freed),
        TEST(every_refused_allocation_is_an_error_and_leaks_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
