// gltf_refused_test.c - glTF files that are refused, by sentences that name the member, the value
// and the range.
#include "tests/support/gltf_parse.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include <stdlib.h>
#include <string.h>

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
        bool ok = hair_test_gltf_parse(hair_test_gltf_with(refusals[i].from, refusals[i].to), &gltf);
        if (ok || !strstr(hair_test_gltf_said, refusals[i].sentence) ||
            strncmp(hair_test_gltf_said, "a.glb: ", 7))
            fail_msg("%s gave: %s", refusals[i].to, hair_test_gltf_said);
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
    assert_false(
        hair_test_gltf_parse(hair_test_glb(hair_test_gltf_text, NULL, NULL, binary, sizeof binary), &gltf));
    if (!strstr(hair_test_gltf_said, sentence)) fail_msg("%s", hair_test_gltf_said);
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
    bool ok = hair_test_gltf_parse_bytes(copy, size, &gltf);
    free(copy);
    assert_true(ok || strlen(hair_test_gltf_said) > 10);
    hair_gltf_free(&gltf);
}

static void every_truncation_and_flipped_bit_is_survived(void** state)
{
    (void)state;
    struct hair_test_file file = hair_test_gltf_with(NULL, NULL);
    for (size_t size = 0; size < file.size; ++size) {
        struct hair_gltf gltf;
        unsigned char* copy = malloc(size ? size : 1);
        memcpy(copy, file.bytes, size);
        assert_false(hair_test_gltf_parse_bytes(copy, size, &gltf));
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
    bool ok = hair_test_gltf_parse(hair_test_glb((const char*)text.bytes, NULL, NULL, binary, 6048), &gltf);
    free(text.bytes);
    free(binary);
    assert_false(ok);
    if (!strstr(hair_test_gltf_said,
                "needs 24000 bytes; all accessors may take 64 times the size of the file"))
        fail_msg("%s", hair_test_gltf_said);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(wrong_members_are_refused_by_name),
        cmocka_unit_test(wrong_numbers_are_refused_by_element),
        cmocka_unit_test(every_truncation_and_flipped_bit_is_survived),
        cmocka_unit_test(shared_accessors_are_limited_by_the_size_of_the_file),
    };
    hair_test_gltf_listen();
    return cmocka_run_group_tests(tests, NULL, NULL);
}
