// gltf_test.c - glTF files: values of every type of accessor, and every interpolation against
// closed forms.
#include "tests/support/gltf_parse.h"
#include "tests/support/shell.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static struct hair_gltf read_with(const char* from, const char* to)
{
    struct hair_gltf gltf;
    assert_true(hair_test_gltf_parse(hair_test_gltf_with(from, to), &gltf));
    return gltf;
}

static void assert_close(const float* values, const float* expected, size_t count, float tolerance)
{
    for (size_t i = 0; i < count; ++i) assert_float_equal(values[i], expected[i], tolerance);
}

static void every_accessor_type_has_its_values(void** state)
{
    (void)state;
    struct hair_gltf gltf = read_with(NULL, NULL);
    static const float weights[4][4] = {{1, 0, 0, 0}, {0.2f, 0.8f, 0, 0}, {0.6f, 0.4f, 0, 0}, {0, 1, 0, 0}};
    static const float color[3] = {0.1f, 0.2f, 0.3f}, corner[3] = {1, 1, 0};
    static const uint32_t triangles[6] = {0, 1, 2, 0, 2, 3};
    assert_string_equal(hair_test_gltf_said, "");
    assert_int_equal(gltf.meshes[0].primitive_count, 3);
    for (int i = 0; i < 3; ++i) {
        const struct hair_gltf_primitive* primitive = &gltf.meshes[0].primitives[i];
        assert_int_equal(primitive->vertex_count, 4);
        assert_int_equal(primitive->triangle_count, 2);
        assert_memory_equal(primitive->triangles, triangles, sizeof triangles);
        assert_close(primitive->weights, weights[0], 16, i == 0 ? 2e-3f : 1e-5f);
        for (int v = 0; v < 4; ++v) assert_int_equal(primitive->joints[4 * v + 1], weights[v][1] > 0 ? 1 : 0);
        assert_int_equal(primitive->joint_end, 2);
        assert_close(primitive->positions + 6, corner, 3, 0);
        assert_close(primitive->color, color, 3, 1e-6f);
        // Normals are the first three weights by a stride, as unit vectors.
        float size = sqrtf(0.04f + 0.64f);
        assert_close(primitive->normals + 3, (const float[]){0.2f / size, 0.8f / size, 0}, 3, 1e-6f);
    }
    assert_int_equal(gltf.skins[0].joint_count, 2);
    assert_float_equal(gltf.skins[0].inverse_binds[13], -2, 0);
    hair_gltf_free(&gltf);
}

static void normals_that_are_missing_are_computed(void** state)
{
    (void)state;
    struct hair_gltf gltf = read_with("'NORMAL': 16, ", "");
    assert_close(gltf.meshes[0].primitives[0].normals, (const float[]){0, 0, 1}, 3, 1e-6f);
    hair_gltf_free(&gltf);
}

// Compute the weights of Hermite's cubic.
static float hermite(float a, float out_tangent, float b, float in_tangent, float h, float t)
{
    return a * (1 - t) * (1 - t) * (1 + 2 * t) + h * out_tangent * t * (1 - t) * (1 - t) +
           b * t * t * (3 - 2 * t) - h * in_tangent * t * t * (1 - t);
}

static float value_at(int i) // of the vectors in the binary chunk
{
    return 1 + 0.25f * (float)(i * i % 7);
}

static void interpolations_match_closed_forms(void** state)
{
    (void)state;
    static const float times[] = {-1, 0.5f, 0.75f, 1, 1.25f, 1.9f, 2, 5};
    static const float keys[3] = {0.5f, 1, 2};
    struct hair_gltf gltf = read_with(NULL, NULL);
    for (size_t i = 0; i < sizeof times / sizeof *times; ++i) {
        float now = fminf(fmaxf(times[i], 0.5f), 2), out[4];
        int key = now >= 2 ? 2 : now >= 1 ? 1 : 0;
        float h = key < 2 ? keys[key + 1] - keys[key] : 1, t = (now - keys[key]) / h;
        hair_gltf_sample(&gltf.animations[0].channels[0], times[i], out);
        for (int k = 0; k < 3; ++k) {
            float next = key < 2 ? value_at(3 * key + 3 + k) : 0;
            assert_float_equal(out[k], (1 - t) * value_at(3 * key + k) + t * next, 1e-5f);
        }
        hair_gltf_sample(&gltf.animations[1].channels[0], times[i], out);
        for (int k = 0; k < 3; ++k) assert_float_equal(out[k], value_at(3 * key + k), 0);
        hair_gltf_sample(&gltf.animations[2].channels[0], times[i], out);
        for (int k = 0; k < 3; ++k) {
            int at = 9 * key + k; // in-tangent, value, out-tangent
            float expected = key == 2 ? value_at(at + 3)
                                      : hermite(value_at(at + 3), value_at(at + 6), value_at(at + 12),
                                                value_at(at + 9), h, t);
            assert_float_equal(out[k], expected, 1e-5f);
        }
    }
    hair_gltf_free(&gltf);
}

static void rotations_are_spherical_and_of_unit_length(void** state)
{
    (void)state;
    struct hair_gltf gltf = read_with(NULL, NULL);
    float out[4];
    // The first animation turns about y to 2 atan2(0.6, 0.8) at the second key.
    float half = atan2f(0.6f, 0.8f);
    for (int i = 0; i <= 8; ++i) {
        float t = (float)i / 8;
        hair_gltf_sample(&gltf.animations[0].channels[2], 0.5f + 0.5f * t, out);
        assert_close(out, (const float[]){0, sinf(half * t), 0, cosf(half * t)}, 4, 1e-4f);
        hair_gltf_sample(&gltf.animations[2].channels[1], 0.5f + 1.5f * t, out);
        assert_float_equal(out[0] * out[0] + out[1] * out[1] + out[2] * out[2] + out[3] * out[3], 1, 1e-5f);
    }
    hair_gltf_free(&gltf);
}

static void poses_follow_parents(void** state)
{
    (void)state;
    struct hair_gltf gltf = read_with(NULL, NULL);
    float world[5 * 16];
    hair_gltf_pose(&gltf, HAIR_GLTF_NONE, 0, world);
    // The hips turn by 2 atan(0.6 / 0.8) about z: the cosine is 0.28, the sine is 0.96.
    const float hips[16] = {0.28f, 0.96f, 0, 0, -0.96f, 0.28f, 0, 0, 0, 0, 1, 0, 1, 2, 3, 1};
    assert_close(world + 16, hips, 16, 1e-6f);
    // The hat is 0.5 above the head, which doubles sizes and is 1 above the hips.
    assert_close(world + 64 + 12, (const float[]){1 - 0.96f * 2, 2 + 0.28f * 2, 3}, 3, 1e-6f);
    assert_float_equal(world[64 + 1], 2 * 0.96f, 1e-6f);
    hair_gltf_pose(&gltf, 0, 0.5f, world);
    // The first key scales the hips by their own translation.
    float scale[3] = {value_at(0), value_at(1), value_at(2)};
    assert_close(world + 16 + 12, (const float[]){1 + scale[0], 2 + scale[1], 3 + scale[2]}, 3, 1e-6f);
    assert_float_equal(world[16], 0.28f * scale[0], 1e-6f);
    assert_float_equal(world[16 + 10], scale[2], 1e-6f);
    hair_gltf_free(&gltf);
}

static void text_files_hold_data_or_name_a_file(void** state)
{
    (void)state;
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    unsigned char binary[HAIR_TEST_GLTF_BYTES + 2] = {0};
    char uri[1024] = "'uri': 'data:application/octet-stream;base64,", path[512];
    hair_test_gltf_binary(binary);
    size_t at = strlen(uri);
    for (size_t i = 0; i < HAIR_TEST_GLTF_BYTES; i += 3)
        for (int k = 3; k >= 0; --k)
            uri[at++] = digits[(binary[i] << 16 | binary[i + 1] << 8 | binary[i + 2]) >> 6 * k & 63];
    strcpy(uri + at - 1, "=', 'byteLength'"); // 668 is 2 beyond a multiple of 3.
    const char* uris[] = {uri, "'uri': 'a%20b.bin', 'byteLength'"};
    snprintf(path, sizeof path, "%s/a b.bin", hair_test_folder());
    FILE* beside = fopen(path, "wb");
    assert_true(beside && fwrite(binary, 1, HAIR_TEST_GLTF_BYTES, beside) == HAIR_TEST_GLTF_BYTES);
    fclose(beside);
    for (int i = 0; i < 2; ++i) {
        struct hair_test_file file = hair_test_glb(hair_test_gltf_text, "'byteLength'", uris[i], NULL, 0);
        snprintf(path, sizeof path, "%s/a.gltf", hair_test_folder());
        FILE* out = fopen(path, "wb");
        assert_true(out && fwrite(file.bytes + 20, 1, file.size - 20, out) == file.size - 20);
        fclose(out);
        free(file.bytes);
        struct hair_gltf gltf;
        assert_true(hair_gltf_read("test", path, &gltf));
        assert_float_equal(gltf.meshes[0].primitives[2].weights[4], 0.2f, 1e-6f);
        hair_gltf_free(&gltf);
    }
}

static void parts_that_are_not_used_are_said_once(void** state)
{
    (void)state;
    struct hair_gltf gltf = read_with("'scene': 0", "'cameras': [{}], 'textures': [{}], 'scene': 0");
    assert_string_equal(hair_test_gltf_said, "a.glb: textures and cameras are not used");
    hair_gltf_free(&gltf);
    gltf = read_with("'indices': 1", "'targets': [{}], 'indices': 1");
    assert_string_equal(hair_test_gltf_said, "a.glb: morph targets are not used");
    hair_gltf_free(&gltf);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_accessor_type_has_its_values),
        cmocka_unit_test(normals_that_are_missing_are_computed),
        cmocka_unit_test(interpolations_match_closed_forms),
        cmocka_unit_test(rotations_are_spherical_and_of_unit_length),
        cmocka_unit_test(poses_follow_parents),
        cmocka_unit_test(text_files_hold_data_or_name_a_file),
        cmocka_unit_test(parts_that_are_not_used_are_said_once),
    };
    hair_test_gltf_listen();
    return cmocka_run_group_tests(tests, NULL, NULL);
}
