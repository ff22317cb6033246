// gltf.c - a small .glb file with all types of accessors and all interpolations, made in memory.
#include "tests/support/gltf.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define PRIMITIVE(indices, joints, weights)                                                                  \
    "{'attributes': {'POSITION': 0, 'NORMAL': 16, 'JOINTS_0': " joints ", 'WEIGHTS_0': " weights             \
    "}, 'indices': " indices ", 'material': 0}"
#define ACCESSOR(offset, component, type, count)                                                             \
    "{'bufferView': 0, 'byteOffset': " offset ", 'componentType': " component ", 'type': '" type             \
    "', 'count': " count "}"
#define FRACTIONS(offset, component, count)                                                                  \
    "{'bufferView': 0, 'byteOffset': " offset ", 'componentType': " component                                \
    ", 'normalized': true, 'type': 'VEC4', 'count': " count "}"

const char hair_test_gltf_text[] =
    "{'asset': {'version': '2.0'}, 'scene': 0, 'scenes': [{'nodes': [0]}], "
    "'nodes': [{'name': 'root', 'translation': [1, 2, 3], 'children': [1, 3]}, "
    "{'name': 'hips', 'rotation': [0, 0, 0.6, 0.8], 'children': [2]}, "
    "{'name': 'Head', 'translation': [0, 1, 0], 'scale': [2, 2, 2], 'children': [4]}, "
    "{'name': 'body', 'mesh': 0, 'skin': 0}, "
    "{'name': 'hat', 'matrix': [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0.5, 0, 1]}], "
    "'materials': [{'pbrMetallicRoughness': {'baseColorFactor': [0.1, 0.2, 0.3, 1]}}], "
    "'meshes': [{'primitives': [" PRIMITIVE("1", "4", "6") ", " PRIMITIVE("2", "5", "7") ", " PRIMITIVE(
        "3",
        "4", "8") "]}], "
                  "'skins': [{'joints': [1, 2], 'inverseBindMatrices': 9}], "
                  "'animations': [{'name': 'linear', 'channels': ["
                  "{'sampler': 0, 'target': {'node': 1, 'path': 'translation'}}, "
                  "{'sampler': 1, 'target': {'node': 2, 'path': 'rotation'}}, "
                  "{'sampler': 0, 'target': {'node': 1, 'path': 'scale'}}], 'samplers': ["
                  "{'input': 10, 'output': 11}, {'input': 10, 'output': 15}]}, "
                  "{'name': 'step', 'channels': [{'sampler': 0, 'target': {'node': 1, 'path': "
                  "'translation'}}, "
                  "{'sampler': 1, 'target': {'node': 2, 'path': 'rotation'}}], 'samplers': ["
                  "{'input': 10, 'output': 11, 'interpolation': 'STEP'}, "
                  "{'input': 10, 'output': 13, 'interpolation': 'STEP'}]}, "
                  "{'name': 'cubic', 'channels': [{'sampler': 0, 'target': {'node': 1, 'path': "
                  "'translation'}}, "
                  "{'sampler': 1, 'target': {'node': 2, 'path': 'rotation'}}], 'samplers': ["
                  "{'input': 10, 'output': 12, 'interpolation': 'CUBICSPLINE'}, "
                  "{'input': 10, 'output': 14, 'interpolation': 'CUBICSPLINE'}]}], "
                  "'buffers': [{'byteLength': 668}], "
                  "'bufferViews': [{'buffer': 0, 'byteLength': 668}, "
                  "{'buffer': 0, 'byteOffset': 188, 'byteLength': 64, 'byteStride': 16}], "
                  // clang-format would indent each row deeper than the one before.
                  // clang-format off
    "'accessors': ["
    ACCESSOR("0", "5126", "VEC3", "4") ", "
    ACCESSOR("48", "5121", "SCALAR", "6") ", "
    ACCESSOR("56", "5123", "SCALAR", "6") ", "
    ACCESSOR("68", "5125", "SCALAR", "6") ", "
    ACCESSOR("92", "5121", "VEC4", "4") ", "
    ACCESSOR("108", "5123", "VEC4", "4") ", "
    FRACTIONS("140", "5121", "4") ", "
    FRACTIONS("156", "5123", "4") ", "
    ACCESSOR("188", "5126", "VEC4", "4") ", "
    ACCESSOR("252", "5126", "MAT4", "2") ", "
    ACCESSOR("380", "5126", "SCALAR", "3") ", "
    ACCESSOR("392", "5126", "VEC3", "3") ", "
    ACCESSOR("392", "5126", "VEC3", "9") ", "
    ACCESSOR("500", "5126", "VEC4", "3") ", "
    ACCESSOR("500", "5126", "VEC4", "9") ", "
    FRACTIONS("644", "5122", "3") ", "
    "{'bufferView': 1, 'componentType': 5126, 'type': 'VEC3', 'count': 4}]}";
// clang-format on

void hair_test_gltf_binary(unsigned char bytes[HAIR_TEST_GLTF_BYTES])
{
    static const float positions[12] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
    static const uint8_t corners[6] = {0, 1, 2, 0, 2, 3};
    static const float weights[4][4] = {{1, 0, 0, 0}, {0.2f, 0.8f, 0, 0}, {0.6f, 0.4f, 0, 0}, {0, 1, 0, 0}};
    static const float times[3] = {0.5f, 1, 2};
    struct hair_test_file file = {0};
    const uint8_t none[2] = {0};
    hair_test_put(&file, positions, sizeof positions);
    hair_test_put(&file, corners, 6);
    hair_test_put(&file, none, 2);
    for (int i = 0; i < 6; ++i) hair_test_put(&file, (const uint8_t[]){corners[i], 0}, 2);
    for (int i = 0; i < 6; ++i) hair_test_put_u32(&file, corners[i]);
    for (int i = 0; i < 4; ++i) hair_test_put(&file, (const uint8_t[]){0, 1, 0, 0}, 4);
    for (int i = 0; i < 4; ++i) hair_test_put(&file, (const uint8_t[]){0, 0, 1, 0, 0, 0, 0, 0}, 8);
    for (int i = 0; i < 16; ++i)
        hair_test_put(&file, (const uint8_t[]){(uint8_t)lroundf(255 * weights[i / 4][i % 4])}, 1);
    for (int i = 0; i < 16; ++i) {
        long whole = lroundf(65535 * weights[i / 4][i % 4]);
        hair_test_put(&file, (const uint8_t[]){(uint8_t)(whole & 255), (uint8_t)(whole >> 8)}, 2);
    }
    for (int i = 0; i < 16; ++i) hair_test_put_float(&file, weights[i / 4][i % 4]);
    for (int i = 0; i < 32; ++i) hair_test_put_float(&file, i % 16 % 5 == 0 ? 1 : i % 16 == 13 ? -2 : 0);
    for (int i = 0; i < 3; ++i) hair_test_put_float(&file, times[i]);
    for (int i = 0; i < 27; ++i) hair_test_put_float(&file, 1 + 0.25f * (float)(i * i % 7));
    for (int i = 0; i < 9; ++i) {
        // Unit quaternions about x, also where splines have tangents.
        float angle = 0.3f * (float)i, q[4] = {sinf(angle), 0, 0, cosf(angle)};
        for (int k = 0; k < 4; ++k) hair_test_put_float(&file, q[k]);
    }
    for (int i = 0; i < 3; ++i) {
        const int16_t q[4] = {0, (int16_t)(i == 1 ? 19660 : 0), 0, (int16_t)(i == 1 ? 26214 : 32767)};
        for (int k = 0; k < 4; ++k)
            hair_test_put(&file, (const uint8_t[]){(uint8_t)(q[k] & 255), (uint8_t)(q[k] >> 8)}, 2);
    }
    assert_int_equal(file.size, HAIR_TEST_GLTF_BYTES);
    memcpy(bytes, file.bytes, HAIR_TEST_GLTF_BYTES);
    free(file.bytes);
}

struct hair_test_file hair_test_glb(const char* text, const char* from, const char* to,
                                    const unsigned char* binary, size_t binary_size)
{
    struct hair_test_file file = {0};
    const char* found = from ? strstr(text, from) : NULL;
    assert_true(!from || found);
    hair_test_put_text(&file, "glTF");
    for (int i = 0; i < 3; ++i) hair_test_put_u32(&file, i == 0 ? 2 : 0);
    hair_test_put_text(&file, "JSON");
    if (found) {
        hair_test_put(&file, text, (size_t)(found - text));
        hair_test_put_text(&file, to);
        text = found + strlen(from);
    }
    hair_test_put_text(&file, text);
    while (file.size % 4) hair_test_put_text(&file, " ");
    for (size_t i = 20; i < file.size; ++i)
        if (file.bytes[i] == '\'') file.bytes[i] = '"';
    hair_test_set_u32(&file, 12, (uint32_t)file.size - 20);
    if (binary) {
        hair_test_put_u32(&file, (uint32_t)binary_size);
        hair_test_put(&file, "BIN", 4);
        hair_test_put(&file, binary, binary_size);
    }
    hair_test_set_u32(&file, 8, (uint32_t)file.size);
    return file;
}
