// strands_resample_test.c - imported strands with too many vertices, or with a requested number,
// get vertices at equal distances.
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

static void long_strands_are_resampled_to_256_vertices(void** state)
{
    (void)state;
    hair_import import = hair_test_import();
    struct hair_strands strands = hair_test_import_strands(&test, 3, 65536);
    // A helix of 50 turns, 65 m long.
    for (uint32_t i = 0; i < 3 * 65536; ++i) {
        float a = 6.2831853f * 50 * (float)(i % 65536) / 65535;
        hair_store3(strands.positions + 3 * (size_t)i, hair_v3(0.01f * cosf(a), a, 0.01f * sinf(a)));
    }
    float tip[3];
    memcpy(tip, strands.positions + 3 * 65535, sizeof tip);
    clean(&import, &strands);
    assert_int_equal(repairs.resampled, 3);
    assert_int_equal(strands.vertices[2], 256);
    assert_float_equal(strands.positions[0], 0.01f, 0);
    assert_memory_equal(strands.positions + 3 * 255, tip, sizeof tip);
    double step = hair_strand_length(strands.positions, 256) / 255;
    for (uint32_t i = 0; i < 255; ++i)
        assert_float_equal(hair_strand_length(strands.positions + 3 * i, 2), step, 0.01 * step);
    hair_test_assert_fit(&strands);
    drop(&strands);
}

static void only_strands_over_256_vertices_are_resampled(void** state)
{
    (void)state;
    for (uint32_t more = 0; more < 2; ++more) {
        hair_import import = hair_test_import();
        struct hair_strands strands = hair_test_import_strands(&test, 1, 256 + more);
        clean(&import, &strands);
        assert_int_equal(repairs.resampled, more);
        assert_int_equal(strands.vertices[0], 256);
        drop(&strands);
    }
}

static void resampling_puts_vertices_at_equal_distances(void** state)
{
    (void)state;
    // Three sides of a rectangle, of lengths 1, 2 and 1. Nine samples are half a unit apart along
    // it.
    const float corners[12] = {0, 0, 0, 0, 1, 0, 2, 1, 0, 2, 0, 0};
    const float want[27] = {0, 0,    0, 0, 0.5f, 0, 0, 1, 0,    0.5f, 1, 0, 1, 1,
                            0, 1.5f, 1, 0, 2,    1, 0, 2, 0.5f, 0,    2, 0, 0};
    float out[27];
    hair_strand_resample(corners, 4, out, 9);
    for (int i = 0; i < 27; ++i) assert_float_equal(out[i], want[i], 1e-6);
    hair_strand_resample(corners, 4, out, 2);
    assert_memory_equal(out + 3, corners + 9, 12);
}

static void resampling_reaches_every_count(void** state)
{
    (void)state;
    for (uint32_t count = 1; count <= 256; ++count) {
        hair_import import = hair_test_import();
        import.strand_vertices = count;
        struct hair_strands strands = hair_test_import_strands(&test, 3, 7);
        clean(&import, &strands);
        assert_int_equal(strands.strand_count, 3);
        for (uint32_t i = 0; i < 3; ++i) {
            const float* p = strands.positions + 3 * (size_t)strands.vertices[0] * i;
            assert_int_equal(strands.vertices[i], count == 1 ? 2 : count);
            assert_float_equal(hair_strand_length(p, strands.vertices[i]), 0.06, 1e-7);
            assert_float_equal(p[2], (float)i, 0);
        }
        hair_test_assert_fit(&strands);
        drop(&strands);
    }
}

static void strands_that_fold_back_keep_distinct_vertices(void** state)
{
    (void)state;
    // A strand that goes there and back. With an even count, two samples coincide on both sides of
    // the fold.
    for (uint32_t count = 3; count <= 256; ++count) {
        hair_import import = hair_test_import();
        import.strand_vertices = count;
        struct hair_strands strands = hair_test_import_strands(&test, 1, 3);
        strands.positions[3] = 1;
        strands.positions[6] = 0;
        clean(&import, &strands);
        assert_int_equal(strands.strand_count, 1);
        assert_int_equal(strands.vertices[0], count);
        hair_test_assert_fit(&strands);
        drop(&strands);
    }
}

static void strands_that_cannot_be_resampled_are_dropped(void** state)
{
    (void)state;
    hair_import import = hair_test_import();
    import.strand_vertices = 2;
    struct hair_strands strands = hair_test_import_strands(&test, 2, 3);
    strands.positions[6] = 0; // The tip of the first strand is at its root.
    clean(&import, &strands);
    assert_int_equal(strands.strand_count, 1);
    assert_int_equal(repairs.dropped_short, 1);
    assert_float_equal(strands.radii[0], 1, 0);
    drop(&strands);

    // Floats at 1e6 m are spaced by 6 cm, which is too coarse for 256 vertices on 25 cm.
    strands = hair_test_import_strands(&test, 1, 2);
    import.strand_vertices = 256;
    strands.positions[0] = 9e5f;
    strands.positions[3] = 9e5f + 0.25f;
    clean(&import, &strands);
    assert_int_equal(strands.strand_count, 0);
    drop(&strands);
}

#define TEST(name) HAIR_TEST_WITH_HOST(name, &test)

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(long_strands_are_resampled_to_256_vertices),
        TEST(only_strands_over_256_vertices_are_resampled),
        TEST(resampling_puts_vertices_at_equal_distances),
        TEST(resampling_reaches_every_count),
        TEST(strands_that_fold_back_keep_distinct_vertices),
        TEST(strands_that_cannot_be_resampled_are_dropped),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
