// asset_hostile_test.c - files that are cut off, have flipped bits, or are hostile are refused or
// read safely.
#include "tests/support/files.h"

#include <float.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

static struct hair_test_host test;

static const struct {
    struct hair_test_file (*make)(void);
    size_t header; // Bytes. 0 means the whole file.
} formats[] = {{hair_test_tfx4, 160}, {hair_test_tfx3, 296}, {hair_test_tfx2, 0}};
#define FORMATS (sizeof formats / sizeof *formats)

// Read the bytes with several imports, and read the resulting asset again. Return whether they were
// accepted.
static bool survives(const void* bytes, size_t size)
{
    hair_import imports[3] = {hair_test_import(), hair_test_import(), hair_test_import()};
    imports[1].tip_first = true;
    imports[1].up = HAIR_UP_X;
    imports[1].strand_vertices = 8;
    imports[2].scale = 1e6f;
    imports[2].keep_fraction = 1e-6f;
    uint32_t accepted = 0;
    for (int i = 0; i < 3; ++i) {
        hair_asset* asset = NULL;
        if (hair_test_read(&test, &imports[i], bytes, size, &asset)) continue;
        size_t needed = 0;
        assert_int_equal(hair_asset_encode(asset, HAIR_FORMAT_HAIR, NULL, 0, &needed), HAIR_OK);
        void* written = malloc(needed);
        hair_asset* again = NULL;
        assert_int_equal(hair_asset_encode(asset, HAIR_FORMAT_HAIR, written, needed, &needed), HAIR_OK);
        assert_int_equal(hair_test_read(&test, &imports[0], written, needed, &again), HAIR_OK);
        assert_int_equal(again->strands.vertex_count, asset->strands.vertex_count);
        assert_memory_equal(again->strands.positions, asset->strands.positions,
                            12 * (size_t)asset->strands.vertex_count);
        free(written);
        hair_asset_free(again);
        hair_asset_free(asset);
        accepted |= 1u << i;
    }
    return accepted & 1;
}

static void truncated_binary_files_are_refused(void** state)
{
    (void)state;
    for (uint32_t arrays = 2; arrays < 32; ++arrays) {
        if (!(arrays & 2)) continue;
        hair_test_refuse_beginnings(hair_test_hair(arrays), survives);
    }
    for (size_t i = 0; i < 2; ++i) hair_test_refuse_beginnings(formats[i].make(), survives);
}

static void truncated_text_file_is_refused(void** state)
{
    (void)state;
    struct hair_test_file file = hair_test_tfx2();
    for (size_t size = 0; size <= file.size; ++size) {
        bool whole = size + 5 >= file.size; // "0.375\n" may lose digits and its line end.
        assert_int_equal(survives(file.bytes, size), whole);
    }
    free(file.bytes);
}

static uint32_t flip_every_bit(struct hair_test_file file, size_t size)
{
    uint32_t accepted = 0;
    for (size_t bit = 0; bit < 8 * size; ++bit) {
        file.bytes[bit / 8] ^= (unsigned char)(1u << bit % 8);
        accepted += survives(file.bytes, file.size);
        file.bytes[bit / 8] ^= (unsigned char)(1u << bit % 8);
    }
    free(file.bytes);
    return accepted;
}

static void files_with_a_flipped_bit_are_refused_or_read(void** state)
{
    (void)state;
    // Flips are refused in every bit of the magic, of both counts, of the points bit, and of the
    // segments in use.
    assert_in_range(flip_every_bit(hair_test_hair(31), 128), 900, 1024 - 3 * 32 - 1);
    assert_in_range(flip_every_bit(hair_test_hair(2), 128), 850, 1024 - 4 * 32 - 1);
    for (size_t i = 0; i < FORMATS; ++i) {
        struct hair_test_file file = formats[i].make();
        size_t size = formats[i].header ? formats[i].header : file.size;
        assert_in_range(flip_every_bit(file, size), 100, 8 * size - 64);
    }
    // Flip the data too, which may be any position, text and number.
    struct hair_test_file hair = hair_test_hair(31), tfx4 = hair_test_tfx4();
    flip_every_bit(hair, hair.size);
    flip_every_bit(tfx4, tfx4.size);
}

static bool takes_hair(uint32_t arrays, size_t at, uint32_t value)
{
    struct hair_test_file file = hair_test_hair(arrays);
    hair_test_set_u32(&file, at, value);
    bool accepted = survives(file.bytes, file.size);
    free(file.bytes);
    return accepted;
}

static void malformed_hair_file_is_refused(void** state)
{
    (void)state;
    assert_false(takes_hair(3, 8, 0x55555556)); // 12 times this wraps to 8 in 32 bits.
    assert_false(takes_hair(3, 8, 0x15555556));
    assert_false(takes_hair(3, 8, 0xffffffff));
    assert_false(takes_hair(3, 4, 0xffffffff));
    assert_false(takes_hair(3, 4, 0x80000000));
    assert_false(takes_hair(2, 4, 0xffffffff));
    assert_false(takes_hair(3, 4, 0));
    assert_false(takes_hair(3, 8, 0));
    assert_false(takes_hair(3, 8, 8)); // The count is not the sum of the segments.
    assert_false(takes_hair(3, 8, 10));
    assert_false(takes_hair(3, 12, 1)); // The file has no points.
    assert_false(takes_hair(3, 12, 0));
    assert_false(takes_hair(3, 12, 4));
    assert_false(takes_hair(2, 16, 0)); // d_segments.
    assert_false(takes_hair(2, 16, 0xffffffff)); // One more than this wraps to 0.
    assert_false(takes_hair(2, 16, 0x55555557)); // One more than this, times 3 strands, wraps to 8.
    assert_true(takes_hair(3, 16, 0xffffffff)); // The value is not used.
    assert_true(takes_hair(3, 12, 0xffffffe0 | 3));
    assert_true(takes_hair(3, 20, 0x7fc00000)); // NaN in a number that is not read.
}

static void segments_whose_product_wraps_are_refused(void** state)
{
    (void)state;
    struct hair_test_file file = hair_test_hair(2);
    hair_test_set_u32(&file, 4, 4);
    hair_test_set_u32(&file, 8, 8);
    hair_test_set_u32(&file, 16, 0x40000001); // One more than this, times 4, is 8 in 32 bits.
    assert_false(survives(file.bytes, file.size));
    hair_test_set_u32(&file, 16, 1);
    assert_true(survives(file.bytes, file.size));
    free(file.bytes);
}

static void points_of_any_values_are_read_or_repaired(void** state)
{
    (void)state;
    const float numbers[] = {NAN,     -NAN,     INFINITY, -INFINITY, 1e38f,   -1e38f, FLT_MAX,
                             FLT_MIN, 1.0e-45f, -0.0f,    1e6f,      -1.1e6f, 1e20f};
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; ++i)
        for (uint32_t at = 0; at < 27; ++at) {
            struct hair_test_file file = hair_test_hair(3);
            hair_test_set_float(&file, 128 + 6 + 4 * at, numbers[i]);
            assert_true(survives(file.bytes, file.size));
            for (uint32_t j = 0; j < 27; ++j)
                hair_test_set_float(&file, 128 + 6 + 4 * j, numbers[(i + j) % 3]);
            assert_false(survives(file.bytes, file.size));
            free(file.bytes);
        }
}

static void strands_of_65535_segments_are_read(void** state)
{
    (void)state;
    struct hair_test_file file = hair_test_hair(2);
    file.size = 128;
    hair_test_set_u32(&file, 4, 2);
    hair_test_set_u32(&file, 8, 2 * 65536);
    hair_test_set_u32(&file, 12, 3);
    hair_test_put_u32(&file, 0xffffffff); // The segments of both strands.
    for (uint32_t i = 0; i < 2 * 65536; ++i) {
        hair_test_put_float(&file, 0.001f * (float)i);
        hair_test_put_float(&file, 0);
        hair_test_put_float(&file, 0);
    }
    hair_import import = hair_test_import();
    hair_asset* asset = NULL;
    assert_int_equal(hair_test_read(&test, &import, file.bytes, file.size, &asset), HAIR_OK);
    assert_int_equal(asset->strands.vertices[1], 256);
    assert_int_equal(asset->repairs.resampled, 2);
    hair_asset_free(asset);
    free(file.bytes);
}

static bool takes_tfx(struct hair_test_file file, size_t at, uint32_t value)
{
    hair_test_set_u32(&file, at, value);
    bool accepted = survives(file.bytes, file.size);
    free(file.bytes);
    return accepted;
}

static void malformed_tfx_file_is_refused(void** state)
{
    (void)state;
    const uint32_t counts[] = {0, 1, 63, 64, 65, 0x80000000, 0xffffffff, 0x10000001};
    for (size_t i = 0; i < sizeof counts / sizeof *counts; ++i) {
        // Number of vertices of each strand.
        assert_false(takes_tfx(hair_test_tfx4(), 8, counts[i]));
        assert_false(takes_tfx(hair_test_tfx3(), 8, counts[i]));
        if (counts[i] == 1) continue; // One strand is valid.
        assert_false(takes_tfx(hair_test_tfx4(), 4, counts[i])); // Number of strands.
        assert_false(takes_tfx(hair_test_tfx3(), 4, counts[i]));
    }
    const uint32_t versions[] = {0x7fc00000, 0x7f800000, 0xc0800000, 0, 0x40000000, 0x40a00000};
    for (size_t i = 0; i < sizeof versions / sizeof *versions; ++i) {
        assert_false(takes_tfx(hair_test_tfx4(), 0, versions[i]));
        assert_false(takes_tfx(hair_test_tfx3(), 0, versions[i]));
    }
    const uint32_t offsets[] = {4, 156, 161, 162, 0x7fffffff, 0xfffffff0, 0xffffffff};
    for (size_t i = 0; i < sizeof offsets / sizeof *offsets; ++i) {
        for (size_t at = 12; at < 32; at += 4) assert_false(takes_tfx(hair_test_tfx4(), at, offsets[i]));
        for (size_t at = 144; at < 168; at += 4) assert_false(takes_tfx(hair_test_tfx3(), at, offsets[i]));
    }
    assert_false(takes_tfx(hair_test_tfx4(), 12, 0)); // The file has no positions.
    assert_false(takes_tfx(hair_test_tfx3(), 144, 0));
    assert_true(takes_tfx(hair_test_tfx4(), 12, 160)); // The section overlaps other sections.
    assert_true(takes_tfx(hair_test_tfx4(), 28, 160));
}

// Check that counts which a short file claims do not make the library allocate memory.
// hair_test_read checks the limit.
static void counts_beyond_the_file_take_no_memory(void** state)
{
    (void)state;
    for (uint32_t i = 0; i < 32; ++i)
        for (uint32_t j = 0; j < 32; ++j) {
            struct hair_test_file files[] = {hair_test_hair(2), hair_test_hair(3), hair_test_tfx4(),
                                             hair_test_tfx3()};
            for (size_t k = 0; k < 4; ++k) {
                hair_test_set_u32(&files[k], 4, 1u << i);
                hair_test_set_u32(&files[k], 8, 1u << j);
                survives(files[k].bytes, files[k].size);
                free(files[k].bytes);
            }
        }
    assert_true(test.peak < 4096);
}

// Check the maximum memory per byte of a file. The files have many strands of two vertices, in the
// shortest form of each format.
static void memory_of_reading_is_bounded(void** state)
{
    (void)state;
    const uint32_t count = 1500000;
    const char strand[] = "strand numVerts 2\n0 0 0\n1 0 0\n";
    struct hair_test_file hair = hair_test_hair(0);
    struct hair_test_file text = {0};
    hair_test_set_u32(&hair, 4, count);
    hair_test_set_u32(&hair, 8, 2 * count);
    hair_test_set_u32(&hair, 12, 2);
    hair_test_set_u32(&hair, 16, 1);
    hair_test_put_text(&text, "version 2\n");
    for (uint32_t i = 0; i < count; ++i) {
        for (int j = 0; j < 6; ++j) hair_test_put_float(&hair, j == 3 ? 1 : 0);
        hair_test_put_text(&text, strand);
    }
    const struct hair_test_file files[2] = {hair, text};
    for (int i = 0; i < 2; ++i) {
        hair_import import = hair_test_import();
        hair_asset* asset = NULL;
        assert_int_equal(hair_test_read(&test, &import, files[i].bytes, files[i].size, &asset), HAIR_OK);
        assert_int_equal(asset->strands.strand_count, count);
        assert_true(test.peak <= 2 * files[i].size); // hair_asset.h promises a larger bound.
        hair_asset_free(asset);
        free(files[i].bytes);
    }
}

static void too_many_strands_need_a_keep_fraction(void** state)
{
    (void)state;
    const uint32_t max = 4194304;
    struct hair_test_file file = hair_test_hair(0);
    hair_test_set_u32(&file, 12, 2);
    hair_test_set_u32(&file, 16, 1);
    for (uint32_t i = 0; i <= max; ++i) hair_test_put(&file, (const float[6]){0, 0, 0, 1, 0, 0}, 24);
    for (uint32_t more = 0; more < 3; ++more) {
        hair_import import = hair_test_import();
        hair_asset* asset = NULL;
        if (more == 2) import.keep_fraction = 0.5f;
        hair_test_set_u32(&file, 4, max + (more > 0));
        hair_test_set_u32(&file, 8, 2 * (max + (more > 0)));
        hair_result result = hair_test_read(&test, &import, file.bytes, file.size, &asset);
        assert_int_equal(result, more == 1 ? HAIR_ERROR_FILE : HAIR_OK);
        if (!result) hair_asset_free(asset);
    }
    free(file.bytes);
}

static void every_refused_allocation_is_an_error_and_leaks_nothing(void** state)
{
    (void)state;
    struct hair_test_file files[] = {hair_test_hair(31), hair_test_tfx4(), hair_test_tfx3(),
                                     hair_test_tfx2()};
    hair_import import = hair_test_import();
    import.strand_vertices = 2;
    import.keep_fraction = 0.4f;
    for (size_t i = 0; i < 4; ++i) {
        uint32_t failures = 0;
        for (uint32_t refuse = 1;; ++refuse, ++failures) {
            hair_asset* asset = NULL;
            test.allocations = 0;
            test.refuse = refuse;
            hair_result result = hair_test_read(&test, &import, files[i].bytes, files[i].size, &asset);
            test.refuse = 0;
            if (result == HAIR_OK) {
                hair_asset_free(asset);
                break;
            }
            assert_int_equal(result, HAIR_ERROR_MEMORY);
            assert_int_equal(test.blocks, 0);
        }
        assert_in_range(failures, 4, 16);
        free(files[i].bytes);
    }
}

static void random_bytes_are_refused_or_read(void** state)
{
    (void)state;
    unsigned char bytes[600];
    srand(5);
    for (int round = 0; round < 20000; ++round) {
        size_t size = (size_t)rand() % sizeof bytes;
        for (size_t i = 0; i < size; ++i) bytes[i] = (unsigned char)(rand() >> 8);
        if (size > 8)
            memcpy(bytes, round % 3 ? round % 3 == 1 ? "HAIR" : "\0\0\x80\x40" : "version ",
                   round % 3 ? 4 : 8);
        survives(bytes, size);
    }
}

static void randomly_changed_files_are_refused_or_read(void** state)
{
    (void)state;
    uint32_t accepted = 0;
    srand(9);
    for (int round = 0; round < 20000; ++round) {
        struct hair_test_file file =
            round % 4 ? formats[round % 4 - 1].make() : hair_test_hair(2 | (uint32_t)round % 29);
        for (int i = 1 + rand() % 8; i > 0; --i)
            file.bytes[(size_t)rand() % file.size] = (unsigned char)(rand() >> 8);
        accepted += survives(file.bytes, file.size);
        free(file.bytes);
    }
    assert_true(accepted > 2000);
}

#define TEST(name) HAIR_TEST_WITH_HOST(name, &test)

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(truncated_binary_files_are_refused),
        TEST(truncated_text_file_is_refused),
        TEST(files_with_a_flipped_bit_are_refused_or_read),
        TEST(malformed_hair_file_is_refused),
        TEST(segments_whose_product_wraps_are_refused),
        TEST(points_of_any_values_are_read_or_repaired),
        TEST(strands_of_65535_segments_are_read),
        TEST(malformed_tfx_file_is_refused),
        TEST(counts_beyond_the_file_take_no_memory),
        TEST(memory_of_reading_is_bounded),
        TEST(too_many_strands_need_a_keep_fraction),
        TEST(every_refused_allocation_is_an_error_and_leaks_nothing),
        TEST(random_bytes_are_refused_or_read),
        TEST(randomly_changed_files_are_refused_or_read),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
