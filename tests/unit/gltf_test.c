// gltf_test.c - glTF files: values of every type of accessor, every interpolation against closed
// forms, and refusals that name the member, the value and the range.
#include "tests/support/gltf.h"
#include "tests/support/shell.h"
#include "tools/common/file.h"
#include "tools/common/gltf.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include <fcntl.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static char said[1024]; // last message

static void hear(const char* sentence, void* user)
{
    (void)user;
    snprintf(said, sizeof said, "%s", sentence);
}

// Parse bytes without a line on stderr. hear() keeps the sentence.
static bool parse_bytes(const unsigned char* bytes, size_t size, struct hair_gltf* out)
{
    *said = 0;
    fflush(stderr);
    int kept = dup(STDERR_FILENO), sink = open("/dev/null", O_WRONLY);
    assert_true(kept >= 0 && sink >= 0 && dup2(sink, STDERR_FILENO) >= 0);
    bool ok = hair_gltf_parse("test", "a.glb", bytes, size, out);
    fflush(stderr);
    dup2(kept, STDERR_FILENO);
    close(kept);
    close(sink);
    return ok;
}

static bool parse(struct hair_test_file file, struct hair_gltf* out)
{
    bool ok = parse_bytes(file.bytes, file.size, out);
    free(file.bytes);
    return ok;
}

// Return the small file with a replaced part.
static struct hair_test_file file_with(const char* from, const char* to)
{
    unsigned char binary[HAIR_TEST_GLTF_BYTES];
    hair_test_gltf_binary(binary);
    return hair_test_glb(hair_test_gltf_text, from, to, binary, sizeof binary);
}

static struct hair_gltf read_with(const char* from, const char* to)
{
    struct hair_gltf gltf;
    assert_true(parse(file_with(from, to), &gltf));
    return gltf;
}

static void assert_close(const float* values, const float* expected, size_t count, float tolerance)
{
    for (size_t i = 0; i < count; ++i) assert_float_equal(values[i], expected[i], tolerance);
}

// Values ------------------------------------------------------------------------------------------

static void every_accessor_type_has_its_values(void** state)
{
    (void)state;
    struct hair_gltf gltf = read_with(NULL, NULL);
    static const float weights[4][4] = {{1, 0, 0, 0}, {0.2f, 0.8f, 0, 0}, {0.6f, 0.4f, 0, 0}, {0, 1, 0, 0}};
    static const float color[3] = {0.1f, 0.2f, 0.3f}, corner[3] = {1, 1, 0};
    static const uint32_t triangles[6] = {0, 1, 2, 0, 2, 3};
    assert_string_equal(said, "");
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
    assert_string_equal(said, "a.glb: textures and cameras are not used");
    hair_gltf_free(&gltf);
    gltf = read_with("'indices': 1", "'targets': [{}], 'indices': 1");
    assert_string_equal(said, "a.glb: morph targets are not used");
    hair_gltf_free(&gltf);
}

// Refusals ----------------------------------------------------------------------------------------

static const struct {
    const char *from, *to, *sentence;
} refusals[] = {
    {"'version': '2.0'", "'version': '1.0'", "asset.version is \"1.0\", not \"2.0\""},
    {"'scene': 0", "'extensionsRequired': ['KHR_draco_mesh_compression']",
     "extensionsRequired[0] is \"KHR_draco_mesh_compression\", not an extension that can be left out"},
    {"'scene': 0", "'scene': 1", "scene is 1, not a whole number in [0, 0]"},
    {"[{'nodes': [0]}]", "[{'nodes': [5]}]",
     "scenes[0].nodes is [5], not an array of 1 to 5 whole numbers below 5"},
    {"'children': [1, 3]", "'children': [1, 9]", "nodes[0].children is [1,9], not an array of 1 to 5 whole"},
    {"'children': [4]", "'children': [3]", "nodes[2].children has node 3, which is a child of node 0 too"},
    {"{'name': 'hat'", "{'children': [0], 'name': 'hat'", "nodes has 5 nodes that are their own ancestors"},
    {"'translation': [1, 2, 3]", "'translation': [1, 2]",
     "nodes[0].translation is [1,2], not 3 numbers in [-1e+06, 1e+06]"},
    {"'translation': [1, 2, 3]", "'translation': [1, 2, 1e7]", "nodes[0].translation is [1,2,1e7], not 3"},
    {"[0, 0, 0.6, 0.8]", "[0, 0, 0, 0.1]", "not a unit quaternion"},
    {"'scale': [2, 2, 2]", "'scale': [2, 2, 1e4]", "not 3 numbers in [-1000, 1000]"},
    {"0, 0.5, 0, 1]", "0, 0.5, 0, 2]", "not a matrix with the last row 0, 0, 0, 1"},
    {"'mesh': 0", "'mesh': 1", "nodes[3].mesh is 1, not a whole number in [0, 0]"},
    {"'skin': 0", "'skin': -1", "nodes[3].skin is -1, not a whole number in [0, 0]"},
    {"'joints': [1, 2]", "'joints': [1]",
     "nodes[3].skin is 0 with 1 joints, but meshes[0].primitives[0] has 2"},
    {"'joints': [1, 2]", "'joints': [1, 2, 3]",
     "skins[0].inverseBindMatrices is 9, not an accessor of a MAT4 of floats per joint"},
    {"'joints': [1, 2]", "'joints': []",
     "skins[0].joints is [], not an array of 1 to 65536 whole numbers below 5"},
    {"'POSITION': 0", "'POSITION': 17",
     "meshes[0].primitives[0].attributes.POSITION is 17, not a whole number in [0, 16]"},
    {"'POSITION': 0", "'POSITION': 8",
     "POSITION is 8, not an accessor of 3 floats; this one has 4 components of the type 5126"},
    {"'POSITION': 0, ", "", "meshes[0].primitives[0].attributes.POSITION is missing, not a whole number"},
    {"'NORMAL': 16", "'NORMAL': 11", "NORMAL is 11, not an accessor with as many elements as POSITION"},
    {"'JOINTS_0': 4, ", "", "attributes.JOINTS_0 is missing, not given with the other of the two"},
    {"'JOINTS_0': 4", "'JOINTS_0': 8", "JOINTS_0 is 8, not an accessor of 4 unsigned bytes or shorts"},
    {"'WEIGHTS_0': 6", "'WEIGHTS_0': 4", "WEIGHTS_0 is 4, not an accessor of 4 floats, or 4 normalized"},
    {"'WEIGHTS_0': 6", "'WEIGHTS_0': 13", "WEIGHTS_0 is 13, not an accessor with as many elements"},
    {"'indices': 1", "'indices': 8", "indices is 8, not an accessor of whole numbers; this one has 4"},
    {"'indices': 1", "'indices': 1, 'mode': 7",
     "meshes[0].primitives[0].mode is 7, not a whole number in [0, 6]"},
    {"'material': 0", "'material': 1", "material is 1, not a whole number in [0, 0]"},
    {"[0.1, 0.2, 0.3, 1]", "[0.1, 0.2, 3, 1]",
     "materials[0].baseColorFactor is [0.1,0.2,3,1], not 4 numbers in [0, 1]"},
    {"'primitives': [{", "'primitives': [], 'others': [{",
     "meshes[0].primitives is [], not an array of at least 1 object"},
    {"'path': 'translation'", "'path': 'color'", "animations[0].channels[0].target.path is \"color\", not"},
    {"'node': 1, 'path'", "'node': 5, 'path'", "node is 5, not a whole number in [0, 4]"},
    {"'node': 1, 'path'", "'node': 4, 'path'", "target.node is 4, not a node without a matrix"},
    {"'sampler': 0", "'sampler': 2", "animations[0].channels[0].sampler is 2, not a whole number in [0, 1]"},
    {"'input': 10", "'input': 11", "animations[0].samplers[0].input is 11, not an accessor of single floats"},
    {"'output': 11", "'output': 12", "samplers[0].output has 9 elements, not the 3 of 3 keys"},
    {"'output': 11", "'output': 13", "samplers[0].output is 13, not an accessor of 3 floats"},
    {"'STEP'", "'NEAREST'", "animations[1].samplers[0].interpolation is \"NEAREST\", not"},
    {"[{'byteLength': 668}]", "[{'byteLength': 669}]",
     "buffers[0].byteLength is 669, not a whole number in [1, 668]"},
    {"[{'byteLength': 668}]", "[{'byteLength': 668}, {'byteLength': 4}]", "buffers[1].uri is missing"},
    {"[{'byteLength': 668}]", "[{'byteLength': 668, 'uri': '../a.bin'}]",
     "buffers[0].uri is \"../a.bin\", not data, or the name of a file in the same folder"},
    {"[{'byteLength': 668}]", "[{'byteLength': 668, 'uri': '/etc/passwd'}]",
     "not data, or the name of a file"},
    {"[{'byteLength': 668}]", "[{'byteLength': 668, 'uri': 'http://a/b'}]",
     "not data, or the name of a file"},
    {"[{'byteLength': 668}]", "[{'byteLength': 668, 'uri': '%2e%2e/b'}]", "not data, or the name of a file"},
    {"[{'byteLength': 668}]", "[{'byteLength': 6, 'uri': 'data:;base64,AA*A'}]", "not data in base64"},
    {"'buffer': 0", "'buffer': 1", "bufferViews[0].buffer is 1, not a whole number in [0, 0]"},
    {"'byteLength': 668}, ", "'byteLength': 669}, ",
     "bufferViews[0].byteLength is 669, not a whole number in [1, 668]"},
    {"'byteStride': 16", "'byteStride': 8",
     "accessors[16].bufferView has a byteStride of 8, not a multiple of 4 that is at least 12"},
    {"'byteStride': 16", "'byteStride': 256",
     "bufferViews[1].byteStride is 256, not a whole number in [4, 252]"},
    {"'accessors': [{'bufferView': 0", "'accessors': [{'bufferView': 2",
     "accessors[0].bufferView is 2, not a whole number in [0, 1]"},
    {"'accessors': [{'bufferView': 0", "'accessors': [{'sparse': {}, 'bufferView': 0",
     "accessors[0].sparse is {}, not left out; sparse accessors are not supported"},
    {"'byteOffset': 644", "'byteOffset': 645", "accessors[15].count is 3, not a whole number in [1, 2]"},
    {"'byteOffset': 644", "'byteOffset': 668",
     "accessors[15].byteOffset is 668, not a whole number in [0, 667]"},
    {"'componentType': 5122", "'componentType': 5124",
     "accessors[15].componentType is 5124, not 5120 to 5123, 5125 or 5126"},
    {"'componentType': 5122", "'componentType': 7", "componentType is 7, not a whole number in [5120, 5126]"},
    {"'MAT4'", "'MAT5'", "accessors[9].type is \"MAT5\", not"},
    {"'normalized': true", "'normalized': 1", "accessors[6].normalized is 1, not true or false"},
};

static void wrong_members_are_refused_by_name(void** state)
{
    (void)state;
    for (size_t i = 0; i < sizeof refusals / sizeof *refusals; ++i) {
        struct hair_gltf gltf;
        bool ok = parse(file_with(refusals[i].from, refusals[i].to), &gltf);
        if (ok || !strstr(said, refusals[i].sentence) || strncmp(said, "a.glb: ", 7))
            fail_msg("%s gave: %s", refusals[i].to, said);
        assert_null(gltf.nodes);
    }
}

// Change a number of the binary chunk.
static void refuse_number(size_t at, uint32_t value, const char* sentence)
{
    unsigned char binary[HAIR_TEST_GLTF_BYTES];
    struct hair_gltf gltf;
    hair_test_gltf_binary(binary);
    memcpy(binary + at, &value, at == HAIR_TEST_GLTF_INDICES ? 1 : 4);
    assert_false(parse(hair_test_glb(hair_test_gltf_text, NULL, NULL, binary, sizeof binary), &gltf));
    if (!strstr(said, sentence)) fail_msg("%s", said);
}

static void wrong_numbers_are_refused_by_element(void** state)
{
    (void)state;
    refuse_number(HAIR_TEST_GLTF_INDICES, 4,
                  "meshes[0].primitives[0].indices has 4 in element 0, not in [0, 3]");
    refuse_number(0, 0x7fc00000, "attributes.POSITION has nan in element 0, not in [-1e+06, 1e+06]");
    refuse_number(12, 0x7f800000, "attributes.POSITION has inf in element 1");
    refuse_number(HAIR_TEST_GLTF_WEIGHTS, 0,
                  "primitives[2].attributes.WEIGHTS_0 has the sum 0 in element 0, not 1");
    refuse_number(HAIR_TEST_GLTF_WEIGHTS, 0xbf800000, "WEIGHTS_0 has -1 in element 0, not in [0, 1]");
    refuse_number(HAIR_TEST_GLTF_TIMES + 4, 0,
                  "samplers[0].input has 0 in element 1, not a time above the one before");
    refuse_number(HAIR_TEST_GLTF_ROTATIONS + 12, 0x40000000,
                  "samplers[1].output has a quaternion of the length 2 at key 0, not 1");
}

// Check that a file with changed bytes is refused with a sentence, or accepted.
static void check(const unsigned char* bytes, size_t size)
{
    struct hair_gltf gltf;
    unsigned char* copy = malloc(size ? size : 1);
    memcpy(copy, bytes, size);
    bool ok = parse_bytes(copy, size, &gltf);
    free(copy);
    assert_true(ok || strlen(said) > 10);
    hair_gltf_free(&gltf);
}

static void every_truncation_and_flipped_bit_is_survived(void** state)
{
    (void)state;
    struct hair_test_file file = file_with(NULL, NULL);
    for (size_t size = 0; size < file.size; ++size) {
        struct hair_gltf gltf;
        unsigned char* copy = malloc(size ? size : 1);
        memcpy(copy, file.bytes, size);
        assert_false(parse_bytes(copy, size, &gltf));
        free(copy);
    }
    for (size_t bit = 0; bit < 8 * file.size; ++bit) {
        file.bytes[bit / 8] ^= (unsigned char)(1u << bit % 8);
        check(file.bytes, file.size);
        file.bytes[bit / 8] ^= (unsigned char)(1u << bit % 8);
    }
    free(file.bytes);
}

static void shared_accessors_are_limited_by_the_size_of_the_file(void** state)
{
    (void)state;
    // 400 primitives of the same 6,000 indices would take 30 times more than the file may.
    struct hair_test_file text = {0};
    unsigned char* binary = calloc(1, 6048);
    hair_test_put_text(&text,
                       "{'asset': {'version': '2.0'}, 'buffers': [{'byteLength': 6048}], 'bufferViews': "
                       "[{'buffer': 0, 'byteLength': 6048}], 'accessors': [{'bufferView': 0, "
                       "'componentType': 5126, 'type': 'VEC3', 'count': 3}, {'bufferView': 0, "
                       "'componentType': 5121, 'type': 'SCALAR', 'count': 6000}], 'meshes': [");
    for (int i = 0; i < 400; ++i) {
        hair_test_put_text(&text, i ? ", " : "");
        hair_test_put_text(&text, "{'primitives': [{'attributes': {'POSITION': 0}, 'indices': 1}]}");
    }
    hair_test_put(&text, "]}", 3);
    struct hair_gltf gltf;
    bool ok = parse(hair_test_glb((const char*)text.bytes, NULL, NULL, binary, 6048), &gltf);
    free(text.bytes);
    free(binary);
    assert_false(ok);
    if (!strstr(said, "needs 24000 bytes; all accessors may take 64 times the size of the file"))
        fail_msg("%s", said);
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
        cmocka_unit_test(wrong_members_are_refused_by_name),
        cmocka_unit_test(wrong_numbers_are_refused_by_element),
        cmocka_unit_test(every_truncation_and_flipped_bit_is_survived),
        cmocka_unit_test(shared_accessors_are_limited_by_the_size_of_the_file),
    };
    hair_complain_to(hear, NULL);
    return cmocka_run_group_tests(tests, NULL, NULL);
}
