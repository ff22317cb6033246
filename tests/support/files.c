// files.c - small haircut files of every format, made in memory, and a checked read of them.
#include "tests/support/files.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

void hair_test_put(struct hair_test_file* file, const void* bytes, size_t size)
{
    if (file->size + size > file->room) {
        file->room = 2 * (file->size + size);
        file->bytes = realloc(file->bytes, file->room);
        assert_non_null(file->bytes);
    }
    memcpy(file->bytes + file->size, bytes, size);
    file->size += size;
}

void hair_test_put_text(struct hair_test_file* file, const char* text)
{
    hair_test_put(file, text, strlen(text));
}

void hair_test_set_u32(struct hair_test_file* file, size_t at, uint32_t value)
{
    for (size_t i = 0; i < 4; ++i) file->bytes[at + i] = (unsigned char)(value >> 8 * i);
}

void hair_test_set_float(struct hair_test_file* file, size_t at, float value)
{
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    hair_test_set_u32(file, at, bits);
}

void hair_test_put_u32(struct hair_test_file* file, uint32_t value)
{
    hair_test_put(file, "....", 4);
    hair_test_set_u32(file, file->size - 4, value);
}

void hair_test_put_float(struct hair_test_file* file, float value)
{
    hair_test_put_u32(file, 0);
    hair_test_set_float(file, file->size - 4, value);
}

static void put_vertex(struct hair_test_file* file, uint32_t strand, uint32_t vertex)
{
    hair_test_put_float(file, (float)strand);
    hair_test_put_float(file, (float)vertex);
    hair_test_put_float(file, 0.125f * (float)vertex);
}

static void put_floats(struct hair_test_file* file, uint32_t count, float value)
{
    for (uint32_t i = 0; i < count; ++i) hair_test_put_float(file, value);
}

static void put_zeros(struct hair_test_file* file, uint32_t count)
{
    for (uint32_t i = 0; i < count; ++i) hair_test_put_u32(file, 0);
}

struct hair_test_file hair_test_hair(uint32_t arrays)
{
    static const uint32_t varied[3] = {3, 2, 4};
    struct hair_test_file file = {0};
    char info[88];
    memset(info, 'i', sizeof info); // not terminated by 0
    hair_test_put_text(&file, "HAIR");
    hair_test_put_u32(&file, 3);
    hair_test_put_u32(&file, 9);
    hair_test_put_u32(&file, arrays);
    hair_test_put_u32(&file, 2);
    put_floats(&file, 5, 1);
    hair_test_put(&file, info, sizeof info);
    for (uint32_t i = 0; i < 3 && (arrays & 1); ++i)
        hair_test_put(&file, (unsigned char[2]){(unsigned char)(varied[i] - 1), 0}, 2);
    for (uint32_t i = 0; i < 3 && (arrays & 2); ++i)
        for (uint32_t j = 0; j < (arrays & 1 ? varied[i] : 3); ++j) put_vertex(&file, i, j);
    for (uint32_t i = 0; i < 9 && (arrays & 4); ++i) hair_test_put_float(&file, 0.01f * (float)(1 + i));
    if (arrays & 8) put_floats(&file, 9, 0.5f);
    if (arrays & 16) put_floats(&file, 27, 0.25f);
    return file;
}

// Return a file whose sections are in another order than their offsets.
struct hair_test_file hair_test_tfx4(void)
{
    struct hair_test_file file = {0};
    hair_test_put_float(&file, 4);
    hair_test_put_u32(&file, 3);
    hair_test_put_u32(&file, 4);
    hair_test_put_u32(&file, 160 + 24 + 12); // positions, last of these
    hair_test_put_u32(&file, 160); // coordinates of strands
    hair_test_put_u32(&file, 160 + 24 + 12 + 192);
    hair_test_put_u32(&file, 160 + 24); // thickness
    hair_test_put_u32(&file, 160 + 24 + 12 + 192 + 96);
    put_zeros(&file, 32);
    put_floats(&file, 6, 0.5f);
    put_floats(&file, 3, 1);
    for (uint32_t i = 0; i < 12; ++i) {
        put_vertex(&file, i / 4, i % 4);
        hair_test_put_float(&file, i % 4 < 2 ? 0 : 1);
    }
    put_floats(&file, 24, 0.5f);
    put_floats(&file, 48, 0.25f);
    return file;
}

struct hair_test_file hair_test_tfx3(void)
{
    struct hair_test_file file = {0};
    hair_test_put_float(&file, 3);
    hair_test_put_u32(&file, 3);
    hair_test_put_u32(&file, 4);
    hair_test_put_u32(&file, 5); // followers per guide
    hair_test_put_u32(&file, 1);
    put_zeros(&file, 31);
    hair_test_put_u32(&file, 296);
    hair_test_put_u32(&file, 296 + 144); // thickness
    put_zeros(&file, 4);
    put_zeros(&file, 32);
    for (uint32_t i = 0; i < 12; ++i) put_vertex(&file, i / 4, i % 4);
    put_floats(&file, 3, 1);
    return file;
}

struct hair_test_file hair_test_tfx2(void)
{
    struct hair_test_file file = {0};
    hair_test_put_text(&file,
                       "version 2.0\nscale 1.0\nrotation 0 0 0\ntranslation 0 0 0\nbothEndsImmovable 0\n"
                       "maxNumVerticesInStrand 4\nnumFollowHairsPerGuideHair 4\n"
                       "maxRadiusAroundGuideHair 0.5\nnumStrands 3\nis sorted 1\n"
                       "strand 0 numVerts 4 texcoord 0.000000 0.522833\n"
                       "0 0 0\n0.0 1.0 0.125\n0 2 .25\n0 3. 0.375\n"
                       "strand 1 numVerts 4 texcoord 0 0\n"
                       "1 0 0\n1 1 1.25e-1\n+1 2 25E-2\n1 3e0 0.000375e+3\n"
                       "strand 2 numVerts 4 texcoord 0 0\n"
                       "2 0 -0\n2 1 0.125\n2 2 0.25\n2 3 0.375\n");
    return file;
}

hair_import hair_test_import(void)
{
    return (hair_import){.scale = 1, .keep_fraction = 1, .seed = 1};
}

static void assert_fit(const struct hair_strands* strands)
{
    assert_in_range(strands->strand_count, 1, 4194304);
    size_t first = 0;
    for (uint32_t i = 0; i < strands->strand_count; ++i) {
        assert_in_range(strands->vertices[i], 2, 256);
        assert_true(hair_strand_is_fit(strands->positions + 3 * first, strands->vertices[i]));
        if (strands->radii) assert_true(strands->radii[i] >= 0 && strands->radii[i] <= 1e6f);
        first += strands->vertices[i];
    }
    assert_int_equal(first, strands->vertex_count);
    for (size_t i = 0; i < 3 * first; ++i) assert_true(fabsf(strands->positions[i]) <= 1e6f);
}

hair_result hair_test_read(struct hair_test_host* test, const hair_import* import, const void* bytes,
                           size_t size, hair_asset** out)
{
    // Copy to exactly this size, so that the address sanitizer sees any read beyond it.
    void* copy = malloc(size ? size : 1);
    assert_non_null(copy);
    if (size) memcpy(copy, bytes, size);
    uint32_t errors = test->errors, blocks = test->blocks;
    hair_asset* const untouched = (hair_asset*)test;
    hair_asset* asset = untouched;
    test->peak = test->live;
    size_t before = test->live;
    hair_result result = hair_asset_decode(&test->host, import, copy, size, &asset);
    free(copy);

    assert_true(test->peak - before <= ((size_t)64 << 20) + 4 * size);
    if (result == HAIR_OK) {
        assert_int_equal(test->errors, errors);
        assert_fit(&asset->strands);
        *out = asset;
        return result;
    }
    assert_ptr_equal(asset, untouched);
    assert_int_equal(test->blocks, blocks);
    assert_int_equal(test->errors, errors + 1);
    if (result == HAIR_ERROR_FILE) {
        const char* byte = strstr(test->sentence, "byte ");
        assert_non_null(byte);
        assert_in_range(byte[5], '0', '9');
    } else {
        assert_int_equal(result, HAIR_ERROR_MEMORY);
    }
    return result;
}

struct hair_strands hair_test_import_strands(const struct hair_test_host* test, uint32_t count, uint32_t each)
{
    struct hair_strands strands = {.strand_count = count, .vertex_count = count * each};
    strands.positions = hair_alloc(&test->host, strands.vertex_count, 12);
    strands.vertices = hair_alloc(&test->host, count, 4);
    strands.radii = hair_alloc(&test->host, count, 4);
    for (uint32_t i = 0; i < count; ++i) {
        strands.vertices[i] = each;
        strands.radii[i] = (float)i;
        for (uint32_t j = 0; j < each; ++j)
            hair_store3(strands.positions + 3 * (size_t)(i * each + j),
                        hair_v3(0.01f * (float)j, 0, (float)i));
    }
    return strands;
}

void hair_test_assert_fit(const struct hair_strands* strands)
{
    size_t first = 0;
    for (uint32_t i = 0; i < strands->strand_count; ++i) {
        uint32_t vertices = strands->vertices[i];
        const float* p = strands->positions + 3 * first;
        assert_in_range(vertices, 2, 256);
        double length = hair_strand_length(p, vertices);
        assert_true(length >= 1e-5);
        for (uint32_t j = 0; j < 3 * vertices; ++j) assert_true(fabsf(p[j]) <= 1e6f);
        for (uint32_t j = 1; j < vertices; ++j)
            assert_true(hair_strand_length(p + 3 * (j - 1), 2) >= 1e-5 * length);
        first += vertices;
    }
    assert_int_equal(first, strands->vertex_count);
}

void hair_test_refuse_beginnings(struct hair_test_file file, bool (*survives)(const void*, size_t))
{
    for (size_t size = 0; size < file.size; ++size) assert_false(survives(file.bytes, size));
    assert_true(survives(file.bytes, file.size));
    free(file.bytes);
}

hair_asset* hair_test_read_file(struct hair_test_host* test, const hair_import* import,
                                struct hair_test_file file)
{
    hair_asset* asset = NULL;
    assert_int_equal(hair_test_read(test, import, file.bytes, file.size, &asset), HAIR_OK);
    free(file.bytes);
    return asset;
}

struct hair_test_file hair_test_write_file(const hair_asset* asset, hair_format format)
{
    size_t size = 0, again = 0;
    assert_int_equal(hair_asset_encode(asset, format, NULL, 0, &size), HAIR_OK);
    struct hair_test_file file = {.bytes = malloc(size + 8), .size = size};
    memset(file.bytes, 0x77, size + 8);
    assert_int_equal(hair_asset_encode(asset, format, file.bytes, size - 1, &again), HAIR_OK);
    assert_int_equal(again, size);
    assert_int_equal(file.bytes[0], 0x77); // With too little capacity nothing is written.
    assert_int_equal(hair_asset_encode(asset, format, file.bytes, size, &again), HAIR_OK);
    for (int i = 0; i < 8; ++i) assert_int_equal(file.bytes[size + i], 0x77);
    return file;
}
