// groomfile_test.c - .groom files keep all that an asset has, within their errors, and name the
// chunk and the byte of damage.
#define _POSIX_C_SOURCE 200809L
#include "lib/base/bytes.h"
#include "lib/base/crc.h"
#include <hair/hair_members.h>
#include "tests/support/groomfile.h"
#include "tests/support/seal.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <cmocka.h>

static struct hair_test_host test;

static hair_asset* read_groom(struct hair_test_file file)
{
    hair_import import = hair_test_import();
    return hair_test_read_file(&test, &import, file);
}

// Check that a file is refused with a sentence that has the text.
static void refuse(struct hair_test_file file, const char* text)
{
    hair_import import = hair_test_import();
    hair_asset* asset = NULL;
    assert_int_equal(hair_test_read(&test, &import, file.bytes, file.size, &asset), HAIR_ERROR_FILE);
    if (!strstr(test.sentence, text)) fail_msg("\"%s\" lacks \"%s\"", test.sentence, text);
    free(file.bytes);
}

static void checksums_are_those_of_zlib(void** state)
{
    (void)state;
    assert_int_equal(hair_crc_add(0, "123456789", 9), 0xcbf43926);
    uint32_t parts = hair_crc_add(hair_crc_add(0, "12345", 5), "6789", 4);
    assert_int_equal(parts, 0xcbf43926);
    // The definition, bit by bit, of every byte at each of 8 places.
    for (int i = 0; i < 2048; ++i) {
        unsigned char bytes[8] = {0};
        uint32_t sum = ~0u;
        bytes[i % 8] = (unsigned char)(i / 8);
        for (int bit = 0; bit < 64; ++bit) {
            uint32_t odd = (sum ^ (uint32_t)bytes[bit / 8] >> bit % 8) & 1;
            sum = sum >> 1 ^ (odd ? 0xedb88320u : 0);
        }
        assert_int_equal(hair_crc_add(0, bytes, 8), ~sum);
    }
}

// Check the names of joints, and the attributes and maps, by hair_asset_describe().
static void check_named(const hair_asset* asset)
{
    static const hair_strand_attribute_kind kinds[4] = {
        HAIR_STRAND_ATTRIBUTE_FRIZZ, HAIR_STRAND_ATTRIBUTE_LENGTH, HAIR_STRAND_ATTRIBUTE_FRIZZ,
        HAIR_STRAND_ATTRIBUTE_STIFFNESS};
    hair_asset_info info = hair_asset_info_default();
    assert_int_equal(hair_asset_describe(asset, &info), HAIR_OK);
    assert_string_equal(info.scalp_joint_names, "hip");
    assert_string_equal(info.scalp_joint_names + 14, "h\xc3\xa4r");
    assert_int_equal(info.strand_attribute_count, 4);
    for (int i = 0; i < 4; ++i) assert_int_equal(info.strand_attributes[i].kind, kinds[i]);
    assert_null(info.strand_attributes[0].strand_values);
    assert_memory_equal(info.strand_attributes[1].strand_values, ((const float[]){1, 0.5f, 0.25f, 0.01f}),
                        16);
    assert_memory_equal(info.strand_attributes[3].strand_values, ((const float[]){0.5f, 1, 2, 100}), 16);
    assert_int_equal(info.strand_attributes[0].map.source, HAIR_MAP_SOURCE_VERTICES);
    assert_float_equal(info.strand_attributes[0].map.values[2], 0.5f, 0);
    assert_int_equal(info.strand_attributes[1].map.height, 5);
    assert_float_equal(info.strand_attributes[1].map.values[4], 0.125f, 0);
    assert_int_equal(info.strand_attributes[3].map.source, HAIR_MAP_SOURCE_NONE);
    assert_non_null(info.map_sets[0]);
    assert_int_equal(info.map_sets[0]->density.source, HAIR_MAP_SOURCE_NONE);
    assert_int_equal(info.map_sets[1]->density.width, 4);
    assert_float_equal(info.map_sets[1]->density.values[5], 0.125f, 0);
    assert_int_equal(info.map_sets[1]->thickness.source, HAIR_MAP_SOURCE_TRIANGLES);
    assert_float_equal(info.map_sets[1]->thickness.values[1], 1, 0);
    assert_null(info.map_sets[2]);
}

static void names_of_attributes_are_those_of_settings(void** state)
{
    (void)state;
    hair_strand_attribute attribute = hair_strand_attribute_default();
    for (int i = 0; i < HAIR_ATTRIBUTE_KINDS; ++i) {
        char text[512];
        attribute.kind = (hair_strand_attribute_kind)i;
        assert_int_equal(hair_get_member(&test.host, HAIR_STRUCT_STRAND_ATTRIBUTE, &attribute,
                                         sizeof attribute, "kind", text, sizeof text, NULL),
                         HAIR_OK);
        assert_string_equal(hair_strand_attribute_name(attribute.kind), text);
    }
    assert_null(hair_strand_attribute_name((hair_strand_attribute_kind)HAIR_ATTRIBUTE_KINDS));
}

static void everything_is_read_as_it_was_written(void** state)
{
    (void)state;
    struct hair_test_file first = hair_test_groomfile();
    hair_import import = hair_test_import();
    hair_asset* asset = NULL;
    assert_int_equal(hair_test_read(&test, &import, first.bytes, first.size, &asset), HAIR_OK);
    assert_int_equal(asset->format, HAIR_FORMAT_GROOM);
    assert_int_equal(asset->strand_set, HAIR_STRAND_SET_GUIDES);
    assert_memory_equal(asset->strands.vertices, ((const uint32_t[]){3, 2, 4, 3}), 16);
    assert_memory_equal(asset->strands.groups, ((const uint8_t[]){0, 7, 3, 0}), 4);
    assert_memory_equal(asset->strands.radii, ((const float[]){1e-5f, 2e-5f, 0, 4e-5f}), 16);
    assert_float_equal(asset->strands.positions[3 * 10 + 1], 0.2f * 1.0001e-5f, 0);
    for (int i = 0; i < 3 * HAIR_STRAND_COLORS * 4; ++i)
        assert_float_equal(asset->strands.colors[i], (float)(i * 37 % 101) / 100, 1.6e-5);
    assert_int_equal(asset->scalp_vertex_count, 4);
    assert_int_equal(asset->scalp_triangle_count, 2);
    assert_int_equal(asset->scalp_joint_count, 5);
    assert_float_equal(asset->scalp_density[1], 0.25f, 0);
    assert_float_equal(asset->scalp_uvs[7], 1, 0);
    assert_int_equal(asset->scalp_joints[11], 4);
    assert_float_equal(asset->scalp_weights[5], 0.5f, 0);
    assert_memory_equal(asset->strands.guides, ((const uint8_t[]){1, 0, 1, 1}), 4);
    check_named(asset);
    struct hair_test_file again = hair_test_write_file(asset, HAIR_FORMAT_GROOM);
    assert_int_equal(again.size, first.size);
    assert_memory_equal(again.bytes, first.bytes, first.size);
    assert_int_equal(test.warnings, 0);
    hair_asset_free(asset);
    free(first.bytes);
    free(again.bytes);
}

static void import_turns_and_scales_strands_and_scalp(void** state)
{
    (void)state;
    struct hair_test_file file = hair_test_groomfile();
    hair_import import = hair_test_import();
    import.scale = 0.5f;
    import.up = HAIR_UP_Z;
    import.keep_fraction = 0.5f;
    hair_asset* asset = hair_test_read_file(&test, &import, file);
    assert_int_equal(asset->strands.strand_count, 2);
    assert_float_equal(asset->strands.positions[4], 0, 0);
    assert_float_equal(asset->strands.positions[5], -0.05f, 1e-6);
    assert_float_equal(asset->scalp_positions[7], 0.5f, 0);
    // A strand keeps its group, its factors and whether it is a guide. The x of a root is half the
    // index of its strand.
    static const uint8_t groups[4] = {0, 7, 3, 0};
    float second = asset->strands.positions[3 * (size_t)asset->strands.vertices[0]];
    int old = (int)lroundf(2 * second);
    assert_int_equal(asset->strands.groups[1], groups[old]);
    assert_int_equal(asset->strands.guides[1], old != 1);
    assert_float_equal(asset->attributes[1].strand_values[1],
                       old ? (old == 3 ? 0.01f : 1.0f / (float)(2 * old)) : 1, 0);
    assert_ptr_equal(asset->attributes[1].strand_values,
                     asset->strands.factors[HAIR_STRAND_ATTRIBUTE_LENGTH]);
    hair_asset_free(asset);
}

// A strand as noise: steps of any direction and of very different lengths.
static void grow_noise(float* p, uint32_t vertices, uint32_t* random)
{
    float step = powf(10, -4 + 3 * hair_random(random));
    hair_vec3 at = hair_scale(hair_v3(hair_random(random), hair_random(random), hair_random(random)),
                              powf(10, 4 * hair_random(random) - 2));
    for (uint32_t i = 0; i < vertices; ++i, p += 3) {
        hair_store3(p, at);
        hair_vec3 aside =
            hair_v3(hair_random(random) - 0.3f, hair_random(random) - 0.5f, hair_random(random) - 0.5f);
        at = hair_add(at, hair_scale(aside, step * powf(10, -3 * hair_random(random))));
    }
}

static double max_error(const struct hair_strands* a, const struct hair_strands* b)
{
    double max = 0;
    const float *p = a->positions, *q = b->positions;
    assert_int_equal(a->strand_count, b->strand_count);
    assert_memory_equal(a->vertices, b->vertices, 4 * (size_t)a->strand_count);
    for (uint32_t s = 0; s < a->strand_count; ++s) {
        double length = hair_strand_length(p, a->vertices[s]);
        assert_memory_equal(p, q, 12); // Roots are exact.
        for (uint32_t i = 0; i < a->vertices[s]; ++i, p += 3, q += 3)
            max = fmax(max,
                       hypot(hypot((double)p[0] - q[0], (double)p[1] - q[1]), (double)p[2] - q[2]) / length);
    }
    return max;
}

static void positions_are_within_1e_5_of_the_length_after_two_files(void** state)
{
    (void)state;
    enum { COUNT = 400 };
    uint32_t random = 7, vertices[COUNT], sum = 0;
    float* positions = calloc(COUNT * 256, 12);
    for (uint32_t i = 0; i < COUNT; ++i) {
        vertices[i] = 2 + (i * 13) % 255;
        grow_noise(positions + 3 * (size_t)sum, vertices[i], &random);
        // Vertices nearer than a file may have them are merged, as by an import.
        vertices[i] = hair_strand_merge(positions + 3 * (size_t)sum, vertices[i]);
        sum += vertices[i];
    }
    hair_asset asset = {.strands = {positions, vertices, .strand_count = COUNT, .vertex_count = sum}};
    hair_asset* once = read_groom(hair_test_write_file(&asset, HAIR_FORMAT_GROOM));
    hair_asset* twice = read_groom(hair_test_write_file(once, HAIR_FORMAT_GROOM));
    double error = max_error(&asset.strands, &once->strands);
    double both = max_error(&asset.strands, &twice->strands);
    print_message("    maximum error %.3g of the length, %.3g after two files\n", error, both);
    assert_true(error <= 5e-6 && error > 1e-6);
    assert_true(both <= 1e-5);
    hair_asset_free(once);
    hair_asset_free(twice);
    free(positions);
}

static void damaged_chunks_are_named_with_their_byte(void** state)
{
    (void)state;
    static const char letters[][5] = {"STRD", "CURV", "RADI", "GRUP", "COLR", "SCLP", "DENS",
                                      "TEXC", "SKIN", "JNTN", "GUID", "ATTR", "MAPS"};
    for (size_t i = 0; i < sizeof letters / sizeof *letters; ++i) {
        struct hair_test_file file = hair_test_groomfile();
        char text[128];
        size_t at = hair_test_find_chunk(&file, letters[i]);
        file.bytes[at + 17] ^= 4;
        snprintf(text, sizeof text, "the chunk \"%s\" at byte %zu is damaged", letters[i], at);
        refuse(file, text);
    }
    struct hair_test_file file = hair_test_groomfile();
    file.bytes[12] ^= 1;
    refuse(file, "the checksum at byte 24");
}

static void unknown_chunks_and_any_order_are_read(void** state)
{
    (void)state;
    struct hair_test_file file = hair_test_groomfile(), other = {0};
    hair_asset* asset = read_groom(hair_test_groomfile());
    size_t radii = hair_test_find_chunk(&file, "RADI");
    // The chunks from RADI on come first, and then a new chunk.
    hair_test_put(&other, file.bytes, 32);
    hair_test_put(&other, file.bytes + radii, file.size - radii);
    hair_test_put(&other, "NEWS\3\0\0\0\0\0\0\0....abc", 19);
    hair_test_put(&other, file.bytes + 32, radii - 32);
    // Chunks of a later library have the names of kinds that this library lacks.
    hair_test_put(&other, "ATTR\46\0\0\0\0\0\0\0....", 16);
    hair_test_put(&other, "shine\n\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0......", 38);
    hair_write_u32(other.bytes + 12, hair_read_u32(other.bytes + 12) + 2);
    hair_write_u64(other.bytes + 16, other.size);
    hair_test_seal(other.bytes, other.size);
    uint32_t warnings = test.warnings;
    hair_asset* again = read_groom(other);
    assert_int_equal(test.warnings, warnings + 2);
    check_named(again);
    assert_memory_equal(asset->strands.positions, again->strands.positions, 12 * 12);
    assert_memory_equal(asset->strands.groups, again->strands.groups, 4);
    hair_asset_free(asset);
    hair_asset_free(again);
    free(file.bytes);
}

static void files_of_other_versions_are_refused(void** state)
{
    (void)state;
    for (uint32_t version = 0; version < 3; version += 2) {
        struct hair_test_file file = hair_test_groomfile();
        hair_test_set_u32(&file, 8, version);
        hair_test_seal(file.bytes, file.size);
        refuse(file,
               version ? "the version at byte 8 is 2, of a newer library" : "the version at byte 8 is 0");
    }
    struct hair_test_file file = hair_test_groomfile();
    memmove(file.bytes + 5, file.bytes + 6, file.size - 6); // Line ends are converted.
    refuse(file, "conversion of line ends");
}

// Committed files of version 1 must be read by all later versions, and are what version 1 writes.
// The second has the chunks that came later.
static void committed_files_of_version_1_are_read(void** state)
{
    (void)state;
    static const char* const paths[] = {"tests/fuzz/corpus/groomfile/whole",
                                        "tests/fuzz/corpus/groomfile/named"};
    for (int i = 0; i < 2; ++i) {
        unsigned char bytes[2048];
        FILE* file = fopen(paths[i], "rb");
        assert_non_null(file);
        size_t size = fread(bytes, 1, sizeof bytes, file);
        fclose(file);
        hair_import import = hair_test_import();
        hair_asset* asset = NULL;
        assert_int_equal(hair_test_read(&test, &import, bytes, size, &asset), HAIR_OK);
        assert_int_equal(asset->strands.vertex_count, 12);
        assert_int_equal(asset->scalp_joint_count, 5);
        // The first writer rounded positions to units twice as large.
        struct hair_test_file own = i ? hair_test_groomfile() : hair_test_old_groomfile();
        hair_asset* again = NULL;
        assert_int_equal(hair_test_read(&test, &import, own.bytes, own.size, &again), HAIR_OK);
        assert_true(max_error(&again->strands, &asset->strands) <= 1.5e-5);
        assert_memory_equal(asset->strands.groups, again->strands.groups, 4);
        assert_int_equal(asset->attribute_count, again->attribute_count);
        assert_int_equal(asset->joint_names_size, again->joint_names_size);
        hair_asset_free(again);
        hair_asset_free(asset);
        free(own.bytes);
    }
}

// A lock of 25 vertices in waves of 2 cm, 30 cm long, with noise.
static void grow_wave(float* p, uint32_t* random)
{
    float x = hair_random(random), z = hair_random(random), phase = 6 * hair_random(random);
    for (int i = 0; i < 25; ++i, p += 3) {
        float t = (float)i / 24;
        hair_store3(p, hair_v3(0.1f * x + 0.01f * t * cosf(phase + 20 * t) + 2e-4f * hair_random(random),
                               1.7f - 0.3f * t, 0.1f * z + 0.01f * t * sinf(phase + 20 * t) + 0.1f * t * t));
    }
}

static double seconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static void head_of_100000_strands_is_small_and_loads_fast(void** state)
{
    (void)state;
    const uint32_t count = 100000;
    uint32_t random = 1, *vertices = malloc(count * sizeof *vertices);
    float *positions = malloc(count * 25 * 12), *radii = malloc(count * sizeof *radii);
    uint8_t* groups = malloc(count);
    for (uint32_t i = 0; i < count; ++i) {
        vertices[i] = 25;
        grow_wave(positions + 75 * (size_t)i, &random);
        radii[i] = 3e-5f + 1e-5f * hair_random(&random);
        groups[i] = i % 3;
    }
    hair_asset asset = {.strands = {.positions = positions,
                                    .vertices = vertices,
                                    .radii = radii,
                                    .groups = groups,
                                    .strand_count = count,
                                    .vertex_count = 25 * count}};
    struct hair_test_file file = hair_test_write_file(&asset, HAIR_FORMAT_GROOM);
    hair_import import = hair_test_import();
    hair_asset* again = NULL;
    double start = seconds();
    assert_int_equal(hair_asset_decode(&test.host, &import, file.bytes, file.size, &again), HAIR_OK);
    double time = seconds() - start;
    print_message("    100,000 strands of 25 vertices: %.2f MB, read in %.3f s\n", 1e-6 * (double)file.size,
                  time);
    assert_true(max_error(&asset.strands, &again->strands) <= 5e-6);
    assert_true(file.size < 15000000);
#ifdef NDEBUG
    assert_true(getenv("HAIR_TEST_SLOW") || time < 0.5);
#endif
    hair_asset_free(again);
    free(file.bytes);
    free(positions);
    free(vertices);
    free(radii);
    free(groups);
}

#define TEST(name) HAIR_TEST_WITH_HOST(name, &test)

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(checksums_are_those_of_zlib),
        TEST(names_of_attributes_are_those_of_settings),
        TEST(everything_is_read_as_it_was_written),
        TEST(import_turns_and_scales_strands_and_scalp),
        TEST(positions_are_within_1e_5_of_the_length_after_two_files),
        TEST(damaged_chunks_are_named_with_their_byte),
        TEST(unknown_chunks_and_any_order_are_read),
        TEST(files_of_other_versions_are_refused),
        TEST(committed_files_of_version_1_are_read),
        TEST(head_of_100000_strands_is_small_and_loads_fast),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
