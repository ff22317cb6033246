// asset_haircut_test.c - haircuts that are written and read again, and real haircuts.
#include "tests/support/files.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

static struct hair_test_host test;

static hair_asset* read_file(struct hair_test_file file)
{
    hair_import import = hair_test_import();
    return hair_test_read_file(&test, &import, file);
}

static void assert_same(const hair_asset* a, const hair_asset* b)
{
    assert_int_equal(a->strands.strand_count, b->strands.strand_count);
    assert_int_equal(a->strands.vertex_count, b->strands.vertex_count);
    assert_memory_equal(a->strands.vertices, b->strands.vertices, 4 * (size_t)a->strands.strand_count);
    assert_memory_equal(a->strands.positions, b->strands.positions, 12 * (size_t)a->strands.vertex_count);
    assert_int_equal(!a->strands.radii, !b->strands.radii);
    if (a->strands.radii)
        assert_memory_equal(a->strands.radii, b->strands.radii, 4 * (size_t)a->strands.strand_count);
}

static void hair_reads_back_bit_for_bit(void** state)
{
    (void)state;
    for (uint32_t arrays = 2; arrays < 8; ++arrays) {
        if (!(arrays & 2)) continue;
        struct hair_test_file file = hair_test_hair(arrays);
        hair_test_set_float(&file, file.size - (arrays & 4 ? 40 : 4), 0.1f / 3);
        hair_asset* asset = read_file(file);
        hair_asset* again = read_file(hair_test_write_file(asset, HAIR_FORMAT_HAIR));
        assert_same(asset, again);
        assert_int_equal(again->format, HAIR_FORMAT_HAIR);
        hair_asset_free(asset);
        hair_asset_free(again);
    }
    assert_int_equal(test.warnings, 0);
}

static void tfx_reads_back_bit_for_bit(void** state)
{
    (void)state;
    hair_asset* asset = read_file(hair_test_tfx3());
    asset->strands.positions[4] = 0.1f / 3;
    struct hair_test_file file = hair_test_write_file(asset, HAIR_FORMAT_TFX4);
    assert_int_equal(file.size, 160 + 12 * 16 + 3 * 8);
    // The two vertices at the root are pinned.
    const unsigned char one[4] = {0, 0, 0x80, 0x3f}, zero[4] = {0};
    for (int i = 0; i < 12; ++i) assert_memory_equal(file.bytes + 172 + 16 * i, i % 4 < 2 ? zero : one, 4);
    hair_asset* again = read_file(file);
    assert_int_equal(again->format, HAIR_FORMAT_TFX4);
    assert_same(asset, again);
    hair_asset_free(asset);
    hair_asset_free(again);
}

static void formats_that_cannot_hold_the_strands_are_refused(void** state)
{
    (void)state;
    size_t size = 77;
    hair_asset* asset = read_file(hair_test_hair(1 | 2));
    assert_int_equal(hair_asset_encode(asset, HAIR_FORMAT_TFX4, NULL, 0, &size), HAIR_ERROR_ARGUMENT);
    assert_non_null(strstr(test.sentence, "strand 0 has 3"));
    assert_int_equal(hair_asset_encode(asset, HAIR_FORMAT_TFX3, NULL, 0, &size), HAIR_ERROR_ARGUMENT);
    assert_int_equal(hair_asset_encode(asset, HAIR_FORMAT_NONE, NULL, 0, &size), HAIR_ERROR_ARGUMENT);
    assert_int_equal(size, 77);
    assert_int_equal(test.errors, 3);
    hair_asset_free(asset);

    for (uint32_t count = 2; count <= 256; ++count) {
        hair_import import = hair_test_import();
        import.strand_vertices = count;
        asset = hair_test_read_file(&test, &import, hair_test_hair(1 | 2));
        int fits = count == 4 || count == 8 || count == 16 || count == 32 || count == 64;
        assert_int_equal(hair_asset_encode(asset, HAIR_FORMAT_TFX4, NULL, 0, &size),
                         fits ? HAIR_OK : HAIR_ERROR_ARGUMENT);
        hair_asset_free(asset);
    }
}

static struct hair_test_file load(const char* name)
{
    char path[256];
    snprintf(path, sizeof path, "../shared/data/tressfx/%s", name);
    struct hair_test_file file = {0};
    FILE* in = fopen(path, "rb");
    if (!in) return file;
    unsigned char buffer[4096];
    for (size_t got; (got = fread(buffer, 1, sizeof buffer, in)) > 0;) hair_test_put(&file, buffer, got);
    fclose(in);
    return file;
}

// Read haircuts of TressFX if they are available. The other tests are complete without them.
static void real_haircuts_are_read(void** state)
{
    (void)state;
    static const struct {
        const char* name;
        hair_format format;
        uint32_t strands, each;
    } real[] = {{"ponytail_back.tfx", HAIR_FORMAT_TFX3, 517, 16},
                {"ponytail_front_top.tfx", HAIR_FORMAT_TFX3, 876, 16},
                {"ponytail_side.tfx", HAIR_FORMAT_TFX3, 3066, 16},
                {"ponytail_tail.tfx", HAIR_FORMAT_TFX3, 474, 16},
                {"ratboy_mohawk.tfx", HAIR_FORMAT_TFX4, 2228, 32}};
    for (size_t i = 0; i < sizeof real / sizeof *real; ++i) {
        struct hair_test_file file = load(real[i].name);
        if (!file.bytes) continue;
        hair_import import = hair_test_import();
        import.scale = 0.01f;
        hair_asset* asset = hair_test_read_file(&test, &import, file);
        assert_int_equal(asset->format, real[i].format);
        assert_int_equal(asset->file_strands, real[i].strands);
        assert_int_equal(asset->file_vertices, real[i].strands * real[i].each);
        hair_asset* again = read_file(hair_test_write_file(asset, HAIR_FORMAT_HAIR));
        assert_same(asset, again);
        hair_asset_free(asset);
        hair_asset_free(again);
    }
}

static void degenerate_strands_of_a_real_haircut_are_repaired(void** state)
{
    (void)state;
    struct hair_test_file file = load("ratboy_mohawk.tfx");
    if (!file.bytes) return;
    hair_asset* asset = read_file(file);
    assert_int_equal(asset->repairs.dropped_short, 1); // This strand is 7.5 micrometres long.
    assert_int_equal(asset->strands.strand_count, 2227);
    hair_asset_free(asset);
}

#define TEST(name) HAIR_TEST_WITH_HOST(name, &test)

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(hair_reads_back_bit_for_bit),
        TEST(tfx_reads_back_bit_for_bit),
        TEST(formats_that_cannot_hold_the_strands_are_refused),
        TEST(real_haircuts_are_read),
        TEST(degenerate_strands_of_a_real_haircut_are_repaired),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
