// asset_test.c - files of every format with any of their parts, read as haircuts.
#include "tests/support/files.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

static struct hair_test_host test;

static hair_asset* read_file(struct hair_test_file file)
{
    hair_import import = hair_test_import();
    return hair_test_read_file(&test, &import, file);
}

static void assert_strands(const hair_asset* asset, const uint32_t vertices[3])
{
    assert_int_equal(asset->strands.strand_count, 3);
    assert_int_equal(asset->file_strands, 3);
    assert_int_equal(asset->file_vertices, vertices[0] + vertices[1] + vertices[2]);
    const float* p = asset->strands.positions;
    for (uint32_t i = 0; i < 3; ++i) {
        assert_int_equal(asset->strands.vertices[i], vertices[i]);
        for (uint32_t j = 0; j < vertices[i]; ++j, p += 3) {
            assert_float_equal(p[0], i, 0);
            assert_float_equal(p[1], j, 0);
            assert_float_equal(p[2], 0.125f * (float)j, 0);
        }
    }
}

static void hair_file_holds_strands_of_any_vertex_count(void** state)
{
    (void)state;
    hair_asset* asset = read_file(hair_test_hair(1 | 2));
    assert_int_equal(asset->format, HAIR_FORMAT_HAIR);
    assert_int_equal(asset->strand_set, HAIR_STRAND_SET_FULL);
    assert_strands(asset, (uint32_t[3]){3, 2, 4});
    assert_null(asset->strands.radii);
    assert_int_equal(test.warnings, 0);
    hair_asset_free(asset);
}

static void hair_file_without_segments_uses_its_header(void** state)
{
    (void)state;
    hair_asset* asset = read_file(hair_test_hair(2));
    assert_strands(asset, (uint32_t[3]){3, 3, 3});
    hair_asset_free(asset);
}

static void hair_file_is_read_with_any_optional_arrays(void** state)
{
    (void)state;
    for (uint32_t arrays = 0; arrays < 32; ++arrays) {
        if (!(arrays & 2)) continue;
        hair_asset* asset = read_file(hair_test_hair(arrays));
        assert_strands(asset, arrays & 1 ? (uint32_t[3]){3, 2, 4} : (uint32_t[3]){3, 3, 3});
        assert_int_equal(asset->strands.radii != NULL, (arrays & 4) != 0);
        hair_asset_free(asset);
    }
    assert_int_equal(test.warnings, 0);
}

static void radius_is_half_the_thickness_at_the_root(void** state)
{
    (void)state;
    for (uint32_t tip_first = 0; tip_first < 2; ++tip_first) {
        hair_import import = hair_test_import();
        import.tip_first = tip_first;
        import.scale = 0.01f;
        hair_asset* asset = hair_test_read_file(&test, &import, hair_test_hair(31));
        const uint32_t* roots = tip_first ? (uint32_t[3]){2, 4, 8} : (uint32_t[3]){0, 3, 5};
        for (uint32_t i = 0; i < 3; ++i)
            assert_float_equal(asset->strands.radii[i], 0.01f * 0.005f * (float)(1 + roots[i]), 1e-9);
        hair_asset_free(asset);
    }
}

static void invalid_thickness_drops_radii_with_a_warning(void** state)
{
    (void)state;
    const float bad[] = {NAN, INFINITY, -1, 3e38f};
    for (int i = 0; i < 4; ++i) {
        struct hair_test_file file = hair_test_hair(1 | 2 | 4);
        hair_test_set_float(&file, 128 + 6 + 108 + 4 * 3, bad[i]);
        hair_asset* asset = read_file(file);
        assert_null(asset->strands.radii);
        assert_int_equal(test.warnings, i + 1);
        hair_asset_free(asset);
    }
}

static float linear(float c)
{
    return c <= 0.04045f ? c / 12.92f : powf((c + 0.055f) / 1.055f, 2.4f);
}

// Return the colour of the k-th vertex of the file, as sRGB.
static float color_of(uint32_t vertex, uint32_t channel)
{
    return (float)(3 * vertex + channel) / 32;
}

static void colors_of_strands_are_read_and_written(void** state)
{
    (void)state;
    for (uint32_t tip_first = 0; tip_first < 2; ++tip_first) {
        struct hair_test_file file = hair_test_hair(31);
        hair_import import = hair_test_import();
        import.tip_first = tip_first;
        for (uint32_t i = 0; i < 27; ++i)
            hair_test_set_float(&file, file.size - 4 * (27 - i), color_of(i / 3, i % 3));
        hair_asset* asset = hair_test_read_file(&test, &import, file);
        uint32_t ends[3][2] = {{0, 2}, {3, 4}, {5, 8}};
        const float* colors = asset->strands.colors;
        assert_non_null(colors);
        for (uint32_t i = 0; i < 9; ++i) { // Each strand and channel.
            const float* own = colors + 3 * HAIR_STRAND_COLORS * (i / 3) + i % 3;
            assert_float_equal(own[0], linear(color_of(ends[i / 3][tip_first], i % 3)), 1e-6);
            assert_float_equal(own[3 * (HAIR_STRAND_COLORS - 1)],
                               linear(color_of(ends[i / 3][1 - tip_first], i % 3)), 1e-6);
        }
        hair_asset* again = read_file(hair_test_write_file(asset, HAIR_FORMAT_HAIR));
        for (uint32_t i = 0; i < 3; ++i)
            // Between the ends, the accuracy is limited by the distance of vertices.
            for (uint32_t k = 0; k < 6; ++k) {
                uint32_t at = 3 * HAIR_STRAND_COLORS * i + (k < 3 ? k : 3 * (HAIR_STRAND_COLORS - 1) + k - 3);
                assert_float_equal(again->strands.colors[at], colors[at], 1e-6);
            }
        hair_asset_free(asset);
        hair_asset_free(again);
    }
    hair_asset* guides = read_file(hair_test_tfx4());
    assert_float_equal(guides->strands.colors[5], linear(0.25f), 1e-6);
    hair_asset* again = read_file(hair_test_write_file(guides, HAIR_FORMAT_TFX4));
    for (uint32_t i = 0; i < 9 * HAIR_STRAND_COLORS; ++i)
        assert_float_equal(again->strands.colors[i], guides->strands.colors[i], 1e-6);
    hair_asset_free(guides);
    hair_asset_free(again);
}

static void invalid_color_drops_colors_with_a_warning(void** state)
{
    (void)state;
    const float bad[] = {NAN, INFINITY, -0.1f, 1.1f};
    for (int i = 0; i < 4; ++i) {
        struct hair_test_file file = hair_test_hair(31);
        hair_test_set_float(&file, file.size - 4 * 7, bad[i]);
        hair_asset* asset = read_file(file);
        assert_null(asset->strands.colors);
        assert_int_equal(test.warnings, i + 1);
        hair_asset_free(asset);
    }
}

static void unknown_arrays_and_trailing_bytes_are_warned_of(void** state)
{
    (void)state;
    struct hair_test_file file = hair_test_hair(1 | 2);
    hair_test_set_u32(&file, 12, 1 | 2 | 32 | 1u << 31);
    hair_test_put_text(&file, "the unknown array");
    hair_asset* asset = read_file(file);
    assert_strands(asset, (uint32_t[3]){3, 2, 4});
    assert_int_equal(test.warnings, 1);
    hair_asset_free(asset);

    file = hair_test_hair(1 | 2);
    hair_test_put_text(&file, "x");
    hair_asset_free(read_file(file));
    assert_int_equal(test.warnings, 2);
}

static void tfx_sections_may_be_at_any_offset(void** state)
{
    (void)state;
    hair_asset* asset = read_file(hair_test_tfx4());
    assert_int_equal(asset->format, HAIR_FORMAT_TFX4);
    assert_int_equal(asset->strand_set, HAIR_STRAND_SET_GUIDES);
    assert_null(asset->strands.radii); // The thickness in the file is a factor.
    assert_strands(asset, (uint32_t[3]){4, 4, 4});
    hair_asset_free(asset);

    asset = read_file(hair_test_tfx3());
    assert_int_equal(asset->format, HAIR_FORMAT_TFX3);
    assert_int_equal(asset->strand_set, HAIR_STRAND_SET_GUIDES);
    assert_strands(asset, (uint32_t[3]){4, 4, 4});
    hair_asset_free(asset);
}

static void tfx_with_only_positions_is_read(void** state)
{
    (void)state;
    struct hair_test_file file = hair_test_tfx4();
    hair_test_set_u32(&file, 16, 0);
    hair_test_set_u32(&file, 20, 0);
    hair_test_set_u32(&file, 24, 0);
    hair_test_set_u32(&file, 28, 0);
    file.size = 160 + 24 + 12 + 192;
    hair_asset* asset = read_file(file);
    assert_strands(asset, (uint32_t[3]){4, 4, 4});
    hair_asset_free(asset);
}

static void tfx_of_any_vertex_count_is_read(void** state)
{
    (void)state;
    struct hair_test_file file = hair_test_tfx4();
    // The twelve vertices belong to two strands, and each strand has six.
    hair_test_set_u32(&file, 4, 2);
    hair_test_set_u32(&file, 8, 6);
    hair_asset* asset = read_file(file);
    assert_int_equal(asset->strands.vertices[1], 6);
    hair_asset_free(asset);
}

static void import_options_are_applied(void** state)
{
    (void)state;
    hair_import import = hair_test_import();
    import.scale = 0.01f;
    import.up = HAIR_UP_Z;
    import.tip_first = true;
    import.strand_vertices = 16;
    import.keep_fraction = 0.34f;
    hair_asset* asset = hair_test_read_file(&test, &import, hair_test_tfx3());
    assert_int_equal(asset->strands.strand_count, 1);
    assert_int_equal(asset->strands.vertices[0], 16);
    assert_int_equal(asset->file_strands, 3);
    assert_float_equal(asset->strands.positions[1], 0.00375f, 1e-8);
    assert_float_equal(asset->strands.positions[2], -0.03f, 1e-8);
    hair_asset_free(asset);
}

static void repairs_are_counted(void** state)
{
    (void)state;
    struct hair_test_file file = hair_test_tfx3();
    hair_test_set_float(&file, 296, NAN);
    for (uint32_t i = 0; i < 12; ++i) hair_test_set_float(&file, 296 + 48 + 4 * i, 1);
    hair_asset* asset = read_file(file);
    assert_int_equal(asset->repairs.removed_nonfinite, 1);
    assert_int_equal(asset->repairs.dropped_short, 1);
    assert_int_equal(asset->strands.strand_count, 2);
    hair_asset_free(asset);
}

static void max_size_of_a_beginning_covers_every_array(void** state)
{
    (void)state;
    for (uint32_t arrays = 2; arrays < 32; ++arrays) {
        if (!(arrays & 2)) continue;
        struct hair_test_file file = hair_test_hair(arrays);
        assert_int_equal(hair_asset_max_size(file.bytes, 128), file.size);
        free(file.bytes);
    }
    // Sections of .tfx files may lie apart, so that more may be read.
    struct hair_test_file tfx[] = {hair_test_tfx4(), hair_test_tfx3()};
    for (int i = 0; i < 2; ++i) {
        assert_true(hair_asset_max_size(tfx[i].bytes, i ? 296 : 160) >= tfx[i].size);
        free(tfx[i].bytes);
    }
}

// Move one section after the other to the end of the file, and four bytes farther.
static void tfx_sections_that_end_beyond_the_file_are_refused(void** state)
{
    (void)state;
    static const struct {
        uint32_t version, at, bytes; // `bytes` is the size of the section.
    } sections[] = {{4, 12, 192}, {4, 16, 24},  {4, 20, 96},   {4, 24, 12},  {4, 28, 192}, {3, 144, 144},
                    {3, 148, 12}, {3, 152, 24}, {3, 156, 192}, {3, 160, 12}, {3, 164, 96}};
    hair_import import = hair_test_import();
    for (size_t i = 0; i < sizeof sections / sizeof *sections; ++i)
        for (uint32_t beyond = 0; beyond < 2; ++beyond) {
            hair_asset* asset = NULL;
            struct hair_test_file file = sections[i].version == 4 ? hair_test_tfx4() : hair_test_tfx3();
            for (int k = 0; k < 48; ++k) hair_test_put_float(&file, (float)k / 48);
            hair_test_set_u32(&file, sections[i].at, (uint32_t)file.size - sections[i].bytes + 4 * beyond);
            assert_int_equal(hair_test_read(&test, &import, file.bytes, file.size, &asset),
                             beyond ? HAIR_ERROR_FILE : HAIR_OK);
            hair_asset_free(asset);
            free(file.bytes);
        }
}

#define TEST(name) HAIR_TEST_WITH_HOST(name, &test)

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(hair_file_holds_strands_of_any_vertex_count),
        TEST(hair_file_without_segments_uses_its_header),
        TEST(hair_file_is_read_with_any_optional_arrays),
        TEST(radius_is_half_the_thickness_at_the_root),
        TEST(invalid_thickness_drops_radii_with_a_warning),
        TEST(colors_of_strands_are_read_and_written),
        TEST(invalid_color_drops_colors_with_a_warning),
        TEST(unknown_arrays_and_trailing_bytes_are_warned_of),
        TEST(tfx_sections_may_be_at_any_offset),
        TEST(tfx_with_only_positions_is_read),
        TEST(tfx_of_any_vertex_count_is_read),
        TEST(max_size_of_a_beginning_covers_every_array),
        TEST(tfx_sections_that_end_beyond_the_file_are_refused),
        TEST(import_options_are_applied),
        TEST(repairs_are_counted),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
