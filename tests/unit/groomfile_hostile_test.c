// groomfile_hostile_test.c - .groom files that are cut off, have flipped bits, or are hostile are
// refused with the chunk and its byte, or read safely.
#include "lib/base/bytes.h"
#include "tests/support/groomfile.h"
#include "tests/support/seal.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

static struct hair_test_host test;

// Return whether the bytes are read, with two imports.
static bool survives(const void* bytes, size_t size)
{
    hair_import imports[2] = {hair_test_import(), hair_test_import()};
    imports[1].tip_first = true;
    imports[1].up = HAIR_UP_X;
    imports[1].strand_vertices = 8;
    imports[1].scale = 1e6f;
    bool is_accepted = false;
    for (int i = 0; i < 2; ++i) {
        hair_asset* asset = NULL;
        if (hair_test_read(&test, &imports[i], bytes, size, &asset)) continue;
        is_accepted |= i == 0;
        hair_asset_free(asset);
    }
    return is_accepted;
}

// Check that a file with valid checksums is refused with a sentence that has the text.
static void refuse(struct hair_test_file file, const char* text)
{
    hair_import import = hair_test_import();
    hair_asset* asset = NULL;
    hair_test_seal(file.bytes, file.size);
    assert_int_equal(hair_test_read(&test, &import, file.bytes, file.size, &asset), HAIR_ERROR_FILE);
    if (!strstr(test.sentence, text)) fail_msg("\"%s\" lacks \"%s\"", test.sentence, text);
    free(file.bytes);
}

static void truncated_files_are_refused(void** state)
{
    (void)state;
    hair_test_refuse_beginnings(hair_test_groomfile(), survives);
}

// Every bit is in a checksum, but those of the last number of the header.
static void files_with_a_flipped_bit_are_refused(void** state)
{
    (void)state;
    struct hair_test_file file = hair_test_groomfile();
    for (size_t bit = 0; bit < 8 * file.size; ++bit) {
        file.bytes[bit / 8] ^= (unsigned char)(1u << bit % 8);
        assert_int_equal(survives(file.bytes, file.size), bit / 32 == 7);
        file.bytes[bit / 8] ^= (unsigned char)(1u << bit % 8);
    }
    free(file.bytes);
}

static void flipped_bits_with_valid_checksums_are_refused_or_read(void** state)
{
    (void)state;
    struct hair_test_file file = hair_test_groomfile();
    unsigned char* copy = malloc(file.size);
    uint32_t accepted = 0;
    for (size_t bit = 0; bit < 8 * file.size; ++bit) {
        memcpy(copy, file.bytes, file.size);
        copy[bit / 8] ^= (unsigned char)(1u << bit % 8);
        hair_test_seal(copy, file.size);
        accepted += survives(copy, file.size);
    }
    assert_in_range(accepted, file.size, 7 * file.size);
    free(copy);
    free(file.bytes);
}

// A number of 32 bits in the content of a chunk, and the sentence that refuses it.
struct wrong {
    const char* letters;
    size_t at; // byte of the content
    uint32_t value;
    const char* text;
};

static void malformed_chunks_are_refused(void** state)
{
    (void)state;
    static const struct wrong wrongs[] = {
        {"STRD", 0, 0, "has 0 strands"},
        {"STRD", 0, 3, "has 16 bytes, not 15"},
        {"STRD", 0, 0xffffffff, "has 4294967295 strands"},
        {"STRD", 4, 13, "has strands of 12 vertices, not the 13 that it says"},
        {"STRD", 4, 0xffffffff, "and 4294967295 vertices"},
        {"STRD", 8, 2, "has the set 2 of strands, not in [0, 1]"},
        {"STRD", 12, 0x02030100, "has 1 vertex of strand 0, not 2 to 256"},
        {"CURV", 48, 0x00202020, "has the step 32 of strand 0, not 0 or in [64, 160]"},
        {"CURV", 52, 0x40000000, "has the widths 0x40000000 of strand 0"},
        {"CURV", 64, 1, "has the widths 0x1 of strand 3"},
        {"CURV", 52, 0x3fffffff, " bytes, not "},
        {"RADI", 4, 0xbf800000, "has the radius -1 of strand 1, not in [0, 1e+06]"},
        {"RADI", 12, 0x7fc00000, "has the radius nan of strand 3"},
        {"GRUP", 0, 0x00080700, "has the group 8 of strand 2, not in [0, 7]"},
        {"COLR", 24, 0x3fffffff, " bytes, not "},
        {"SCLP", 0, 2, "has 2 vertices and 2 triangles, not in [3, 4194304] and [1, 4194304]"},
        {"SCLP", 4, 0xffffffff, "vertices and 4294967295 triangles"},
        {"SCLP", 0, 5, " bytes, not "},
        {"SCLP", 8, 0x7f800000, "has the number inf"},
        {"SCLP", 8, 0x49800000, "not within 1e+06 m of the origin"},
        {"SCLP", 56, 4, "has the corner 4, not in [0, 3]"},
        {"DENS", 0, 0x40000000, "has the number 2, not in [0, 1]"},
        {"TEXC", 0, 0x7fc00000, "has the number nan, not in [-1e+06, 1e+06]"},
        {"SKIN", 0, 0, "has 0 joints, not in [1, 65536]"},
        {"SKIN", 0, 4, "has the joint 4 of vertex 2, not in [0, 3]"},
        {"SKIN", 36, 0x3f000000, "has weights of vertex 0 whose sum is 0.5, not in [0.99, 1.01]"},
        {"JNTN", 0, 0x00706900, "has 6 names that end in a byte 0, not 5"},
        {"JNTN", 20, 0x01b1a6ff, "has 4 names that end in a byte 0, not 5"},
        {"JNTN", 14, 0x7273c368, "has a name that is not UTF-8"},
        {"GUID", 0, 0x00010200, "has the number 2 of strand 1, not in [0, 1]"},
        {"ATTR stiffness", 32, 0xbf800000, "has the number -1, not in [0, 100]"},
        {"ATTR stiffness", 36, 0x7fc00000, "has the number nan, not in [0, 100]"},
        {"ATTR length", 44, 0, "has the number 0, not in [0.01, 1]"},
        {"ATTR length", 36, 0x7f800000, "has the number inf, not in [0.01, 1]"},
        {"MAPS set_density", 32, 4, "has the index 4, not in [0, 3]"},
        {"MAPS set_density", 32, 0xffffffff, "has the index 4294967295, not in [0, 3]"},
        {"MAPS set_density", 36, 4, "has the source 4, not in [0, 3]"},
        {"MAPS set_density", 36, 2, "has 48 bytes, not 64"},
        {"MAPS set_density", 36, 1, "is an image of 0 by 0 values"},
        {"MAPS set_density", 40, 16385, "is of 16385 by 0 values, not of [0, 16384] each"},
        {"MAPS set_density", 44, 0xffffffff, "is of 0 by 4294967295 values, not of [0, 16384] each"},
        {"MAPS set_thickness", 36, 0, "has 56 bytes, not 48"},
        {"MAPS set_thickness", 36, 2, "has 56 bytes, not 64"},
        {"MAPS set_thickness", 48, 0x40800001, "has the number 4, not in [0, 4]"},
        {"MAPS set_thickness", 52, 0x7fc00000, "has the number nan, not in [0, 4]"},
        {"MAPS length", 32, 1, "has the index 1, not 0"},
        {"MAPS length", 36, 0, "is a map of \"length\" without a source"},
        {"MAPS length", 40, 16384, "has 68 bytes, not 327728"},
        {"MAPS length", 44, 0, "is an image of 1 by 0 values"},
        {"MAPS frizz", 60, 0x40a00000, "has the number 5, not in [0, 4]"},
    };
    for (size_t i = 0; i < sizeof wrongs / sizeof *wrongs; ++i) {
        struct hair_test_file file = hair_test_groomfile();
        char chunk[64];
        size_t at = hair_test_find_chunk(&file, wrongs[i].letters);
        snprintf(chunk, sizeof chunk, "the chunk \"%.4s\" at byte %zu ", wrongs[i].letters, at);
        hair_test_set_u32(&file, at + 16 + wrongs[i].at, wrongs[i].value);
        refuse(file, wrongs[i].text);
        if (!strstr(test.sentence, chunk)) fail_msg("\"%s\" lacks \"%s\"", test.sentence, chunk);
    }
}

static void chunks_of_another_size_are_refused(void** state)
{
    (void)state;
    static const char* const letters[] = {"STRD",
                                          "CURV",
                                          "RADI",
                                          "GRUP",
                                          "COLR",
                                          "SCLP",
                                          "DENS",
                                          "TEXC",
                                          "SKIN",
                                          "JNTN",
                                          "GUID",
                                          "ATTR stiffness",
                                          "ATTR length",
                                          "MAPS set_density",
                                          "MAPS set_thickness",
                                          "MAPS length",
                                          "MAPS frizz"};
    for (size_t i = 0; i < sizeof letters / sizeof *letters; ++i) {
        struct hair_test_file file = hair_test_groomfile();
        size_t size = (size_t)hair_read_u64(file.bytes + hair_test_find_chunk(&file, letters[i]) + 4);
        free(file.bytes);
        for (size_t left = 0; left <= size + 1; ++left) {
            if (left == size) continue;
            file = hair_test_groomfile();
            hair_test_resize_chunk(&file, letters[i], left < size ? left : size,
                                   left < size ? (int)left - (int)size : 1);
            char text[5] = {0};
            memcpy(text, letters[i], 4);
            refuse(file, text);
        }
    }
}

// Check that a file is refused after a chunk has got the letters or the name of another.
static void refuse_changed(const char* letters, size_t at, const char* changed, const char* text)
{
    struct hair_test_file file = hair_test_groomfile();
    unsigned char* to = file.bytes + hair_test_find_chunk(&file, letters) + at;
    memset(to, 0, at ? 32 : 4);
    memcpy(to, changed, strlen(changed));
    refuse(file, text);
}

static void chunks_with_names_are_refused_twice_or_without_others(void** state)
{
    (void)state;
    refuse_changed("ATTR length", 16, "stiffness", "has the name \"stiffness\" again");
    refuse_changed("MAPS set_thickness", 16, "set_density", "is the map \"set_density\" of set 1 again");
    refuse_changed("ATTR length", 16, "a_name_without_an_end_of_32_byte", "name that does not end within 32");
    refuse_changed("TEXC", 0, "TEXX", " needs a chunk \"TEXC\"");
    refuse_changed("SKIN", 0, "SKIX", "the chunk \"JNTN\" at byte");
}

// Write 33 maps of one kind, or 32 and factors of another kind.
static void files_with_too_many_attributes_are_refused(void** state)
{
    (void)state;
    for (uint32_t has_factors = 0; has_factors < 2; ++has_factors) {
        struct hair_test_file file = hair_test_groomfile();
        size_t begin = hair_test_find_chunk(&file, "MAPS frizz"),
               size = 16 + (size_t)hair_read_u64(file.bytes + begin + 4);
        unsigned char chunk[256];
        assert_true(size <= sizeof chunk);
        memcpy(chunk, file.bytes + begin, size);
        if (has_factors) hair_write_u32(file.bytes + hair_test_find_chunk(&file, "MAPS length"), 0x45455245);
        for (uint32_t i = 0; i < 30; ++i) hair_test_put(&file, chunk, size);
        hair_write_u32(file.bytes + 12, hair_read_u32(file.bytes + 12) + 30);
        hair_write_u64(file.bytes + 16, file.size);
        refuse(file, has_factors ? " make 34 attributes, more than 32"
                                 : "is one of more than 32 maps of attributes");
    }
}

static void malformed_lists_of_chunks_are_refused(void** state)
{
    (void)state;
    struct hair_test_file file = hair_test_groomfile();
    hair_test_set_u32(&file, 12, 8);
    refuse(file, "the 8 chunks end at byte ");
    file = hair_test_groomfile();
    hair_test_set_u32(&file, 12, 0xffffffff);
    refuse(file, "byte 12 says that it has 4294967295 chunks");
    file = hair_test_groomfile();
    hair_write_u64(file.bytes + 16, 31);
    refuse(file, "the size of the file at byte 16 is 31 bytes");
    file = hair_test_groomfile();
    hair_write_u64(file.bytes + 16, UINT64_MAX);
    refuse(file, "the size of the file at byte 16 is 18446744073709551615 bytes");
    file = hair_test_groomfile();
    memcpy(file.bytes + hair_test_find_chunk(&file, "DENS"), "CURV", 4);
    refuse(file, "stands again at byte ");
    file = hair_test_groomfile();
    memcpy(file.bytes + hair_test_find_chunk(&file, "CURV"), "\n\n\n\n", 4);
    refuse(file, "without a chunk \"CURV\"");
    file = hair_test_groomfile();
    memcpy(file.bytes + hair_test_find_chunk(&file, "SCLP"), "SKLP", 4);
    refuse(file, "needs a chunk \"SCLP\"");
    file = hair_test_groomfile();
    hair_write_u64(file.bytes + hair_test_find_chunk(&file, "RADI") + 4, UINT64_MAX);
    refuse(file, "has 18446744073709551615 bytes, but the file ends at byte ");
}

// Tracks of width 0 make many vertices of few bytes. Memory is then bounded by the strands.
static void memory_of_reading_is_bounded(void** state)
{
    (void)state;
    enum { COUNT = 20000 };
    struct hair_test_file file = {0};
    hair_test_put(&file, "GROOM\r\n\x1a\1\0\0\0\2\0\0\0", 16);
    for (int i = 0; i < 4; ++i) hair_test_put_u32(&file, 0);
    hair_test_put(&file, "STRD", 4);
    for (int i = 0; i < 3; ++i) hair_test_put_u32(&file, i ? 0 : 12 + COUNT);
    hair_test_put_u32(&file, COUNT);
    hair_test_put_u32(&file, 256 * COUNT);
    hair_test_put_u32(&file, 0);
    for (int i = 0; i < COUNT; ++i) hair_test_put(&file, "\xff", 1);
    hair_test_put(&file, "CURV", 4);
    for (int i = 0; i < 3; ++i) hair_test_put_u32(&file, i ? 0 : 17 * COUNT + (3 * COUNT + 7) / 8);
    for (int i = 0; i < 3 * COUNT; ++i) hair_test_put_u32(&file, 0);
    for (int i = 0; i < COUNT; ++i) hair_test_put(&file, "\x80", 1);
    for (int i = 0; i < COUNT; ++i) hair_test_put_u32(&file, 3); // The first number has 3 bits.
    for (int i = 0; i < (3 * COUNT + 7) / 8; ++i) hair_test_put(&file, "\xb6", 1); // 6, folded 3.
    hair_write_u64(file.bytes + 16, file.size);
    hair_test_seal(file.bytes, file.size);
    hair_import import = hair_test_import();
    hair_asset* asset = NULL;
    test.peak = test.live;
    size_t before = test.live;
    assert_int_equal(hair_asset_decode(&test.host, &import, file.bytes, file.size, &asset), HAIR_OK);
    assert_int_equal(asset->strands.vertex_count, 256 * COUNT);
    assert_float_equal(asset->strands.positions[3], 3, 0);
    assert_in_range(test.peak - before, 100 * file.size, 200 * file.size);
    hair_asset_free(asset);
    free(file.bytes);
}

static void every_refused_allocation_is_an_error_and_leaks_nothing(void** state)
{
    (void)state;
    struct hair_test_file file = hair_test_groomfile();
    hair_import import = hair_test_import();
    uint32_t failures = 0;
    import.strand_vertices = 2;
    for (uint32_t refused = 1;; ++refused, ++failures) {
        hair_asset* asset = NULL;
        test.allocations = 0;
        test.refuse = refused;
        hair_result result = hair_test_read(&test, &import, file.bytes, file.size, &asset);
        test.refuse = 0;
        if (result == HAIR_OK) {
            hair_asset_free(asset);
            break;
        }
        assert_int_equal(result, HAIR_ERROR_MEMORY);
        assert_int_equal(test.blocks, 0);
    }
    assert_in_range(failures, 20, 30);
    free(file.bytes);
}

static void randomly_changed_files_are_refused_or_read(void** state)
{
    (void)state;
    uint32_t accepted = 0;
    srand(9);
    for (int round = 0; round < 20000; ++round) {
        struct hair_test_file file = hair_test_groomfile();
        for (int i = 1 + rand() % 4; i > 0; --i)
            file.bytes[32 + (size_t)rand() % (file.size - 32)] = (unsigned char)(rand() >> 8);
        hair_test_seal(file.bytes, file.size);
        accepted += survives(file.bytes, file.size);
        free(file.bytes);
    }
    assert_in_range(accepted, 2000, 18000);
}

#define TEST(name) HAIR_TEST_WITH_HOST(name, &test)

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(truncated_files_are_refused),
        TEST(files_with_a_flipped_bit_are_refused),
        TEST(flipped_bits_with_valid_checksums_are_refused_or_read),
        TEST(malformed_chunks_are_refused),
        TEST(chunks_of_another_size_are_refused),
        TEST(chunks_with_names_are_refused_twice_or_without_others),
        TEST(files_with_too_many_attributes_are_refused),
        TEST(malformed_lists_of_chunks_are_refused),
        TEST(memory_of_reading_is_bounded),
        TEST(every_refused_allocation_is_an_error_and_leaks_nothing),
        TEST(randomly_changed_files_are_refused_or_read),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
