// asset_arrays_test.c - assets that applications make of arrays, by a .groom file to a groom.
#include "tests/support/groomfile.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>
#include <cmocka.h>

static struct hair_test_host test;

static hair_asset* read_groom(struct hair_test_file file)
{
    hair_import import = hair_test_import();
    return hair_test_read_file(&test, &import, file);
}

static const float arrays_positions[] = {0, 0, 0, 0, 0, 1, 1, 0, 0, 1, 0, 2, 1, 0, 3};
static const float arrays_scalp[] = {0, 0, 0, 2, 0, 0, 0, 2, 0};
static const uint32_t arrays_vertices[] = {2, 3}, arrays_triangle[] = {0, 1, 2};
static const uint16_t arrays_joints[12] = {0, 1, 2, 3, 0, 0, 0, 0, 3, 3, 3, 3};
// Names of four joints, of which the last is not English.
static const char arrays_names[] = "hip\0neck\0head\0h\xc3\xa4r";
static const float arrays_weights[12] = {0.25f, 0.25f, 0.5f, 0, 1, 0, 0, 0, 0, 0, 1, 0};

static hair_groom_desc arrays_desc(void)
{
    static const uint8_t groups[] = {5, 2};
    static const float density[] = {0, 1, 0.5f}, uvs[] = {0, 0, 1, 0, 0, 1};
    static hair_import import;
    hair_groom_desc desc = hair_groom_desc_default();
    import = hair_import_default();
    import.up = HAIR_UP_Z;
    import.scale = 0.1f;
    desc.host = &test.host;
    desc.import = &import;
    desc.positions = arrays_positions;
    desc.strand_vertices = arrays_vertices;
    desc.strand_count = 2;
    desc.strand_set = HAIR_STRAND_SET_GUIDES;
    desc.strand_groups = groups;
    desc.scalp_positions = arrays_scalp;
    desc.scalp_triangles = arrays_triangle;
    desc.scalp_density = density;
    desc.scalp_uvs = uvs;
    desc.scalp_vertex_count = 3;
    desc.scalp_triangle_count = 1;
    return desc;
}

static void arrays_are_written_and_make_a_groom_with_groups(void** state)
{
    (void)state;
    hair_groom_desc desc = arrays_desc();
    hair_asset* asset = NULL;
    assert_int_equal(hair_asset_create(&desc, arrays_joints, arrays_weights, 4, arrays_names, &asset),
                     HAIR_OK);
    hair_asset* again = read_groom(hair_test_write_file(asset, HAIR_FORMAT_GROOM));
    hair_asset_info info = hair_asset_info_default();
    assert_int_equal(hair_asset_describe(again, &info), HAIR_OK);
    assert_int_equal(info.strand_set, HAIR_STRAND_SET_GUIDES);
    assert_float_equal(info.positions[3 * 4 + 1], 0.3f, 3e-6); // +z has become +y.
    assert_float_equal(info.scalp_positions[3 * 2 + 2], -0.2f, 0);
    assert_memory_equal(info.scalp_joints, arrays_joints, sizeof arrays_joints);
    assert_memory_equal(info.scalp_weights, arrays_weights, sizeof arrays_weights);
    assert_int_equal(info.scalp_joint_count, 4);
    assert_memory_equal(info.scalp_joint_names, arrays_names, sizeof arrays_names);
    hair_groom_desc next = hair_groom_desc_default();
    hair_groom* groom = NULL;
    hair_groom_info made = hair_groom_info_default();
    next.host = &test.host;
    next.follower_count = 100;
    assert_int_equal(hair_asset_to_groom_desc(again, &next), HAIR_OK);
    assert_ptr_equal(next.scalp_density, info.scalp_density);
    assert_ptr_equal(next.scalp_uvs, info.scalp_uvs);
    assert_int_equal(hair_groom_create(&next, &groom), HAIR_OK);
    assert_int_equal(hair_groom_describe(groom, &made), HAIR_OK);
    assert_int_equal(made.group_count, 6);
    assert_int_equal(made.guide_count, 2);
    hair_groom_destroy(groom);
    hair_asset_destroy(asset);
    hair_asset_destroy(again);
}

// The guides that arrays name go to a file and to a groom.
static void guides_of_arrays_reach_a_groom(void** state)
{
    (void)state;
    static const uint8_t guides[] = {0, 1};
    hair_groom_desc desc = arrays_desc(), next = hair_groom_desc_default();
    hair_asset* asset = NULL;
    hair_groom* groom = NULL;
    hair_groom_info made = hair_groom_info_default();
    float root[3 * 3];
    desc.strand_set = HAIR_STRAND_SET_FULL;
    desc.strand_groups = NULL;
    desc.strand_guides = guides;
    assert_int_equal(hair_asset_create(&desc, NULL, NULL, 0, NULL, &asset), HAIR_OK);
    hair_asset* again = read_groom(hair_test_write_file(asset, HAIR_FORMAT_GROOM));
    next.host = &test.host;
    assert_int_equal(hair_asset_to_groom_desc(again, &next), HAIR_OK);
    assert_memory_equal(next.strand_guides, guides, sizeof guides);
    assert_int_equal(hair_groom_create(&next, &groom), HAIR_OK);
    assert_int_equal(hair_groom_describe(groom, &made), HAIR_OK);
    assert_int_equal(made.guide_count, 1);
    assert_int_equal(hair_groom_get_guides(groom, NULL, 0, root, 3), HAIR_OK);
    assert_float_equal(root[0], 0.1f, 3e-6); // The second strand has x = 1 at a scale of 0.1.
    hair_groom_destroy(groom);
    hair_asset_destroy(asset);
    hair_asset_destroy(again);
    // A desc of a caller that does not know the member stays as it is.
    next = hair_groom_desc_default();
    next.header.size = offsetof(hair_groom_desc, strand_guides);
    asset = NULL;
    assert_int_equal(hair_asset_create(&desc, NULL, NULL, 0, NULL, &asset), HAIR_OK);
    assert_int_equal(hair_asset_to_groom_desc(asset, &next), HAIR_OK);
    assert_null(next.strand_guides);
    hair_asset_destroy(asset);
}

// Attributes of one kind, and maps of both sets, go from arrays to a file and to a groom.
static void attributes_and_maps_of_arrays_reach_a_groom(void** state)
{
    (void)state;
    static const float values[] = {2, 60, 0.5f, 50}, density[] = {0, 1, 0.5f}, length[] = {0.5f};
    hair_groom_desc desc = arrays_desc(), next = hair_groom_desc_default();
    hair_strand_attribute attributes[3];
    hair_map_set set = hair_map_set_default();
    set.density = (hair_map){HAIR_MAP_SOURCE_VERTICES, density, 0, 0};
    for (int i = 0; i < 3; ++i) attributes[i] = hair_strand_attribute_default();
    attributes[0].strand_values = values;
    attributes[1].kind = HAIR_STRAND_ATTRIBUTE_LENGTH;
    attributes[1].map = (hair_map){HAIR_MAP_SOURCE_TRIANGLES, length, 0, 0};
    attributes[2].strand_values = values + 2;
    desc.strand_attributes = attributes;
    desc.strand_attribute_count = 3;
    desc.map_sets[0] = &set;
    hair_asset* asset = NULL;
    hair_groom* groom[2] = {0};
    hair_groom_info made[2] = {hair_groom_info_default(), hair_groom_info_default()};
    assert_int_equal(hair_asset_create(&desc, NULL, NULL, 0, NULL, &asset), HAIR_OK);
    hair_asset* again = read_groom(hair_test_write_file(asset, HAIR_FORMAT_GROOM));
    next.host = &test.host;
    assert_int_equal(hair_asset_to_groom_desc(again, &next), HAIR_OK);
    assert_int_equal(next.strand_attribute_count, 2);
    assert_int_equal(next.strand_attributes[0].kind, HAIR_STRAND_ATTRIBUTE_LENGTH);
    assert_float_equal(next.strand_attributes[0].map.values[0], 0.5f, 0);
    assert_float_equal(next.strand_attributes[1].strand_values[0], 1, 0);
    assert_float_equal(next.strand_attributes[1].strand_values[1], 100, 0); // It is limited.
    assert_memory_equal(next.map_sets[0]->density.values, density, sizeof density);
    desc.follower_count = next.follower_count = 100;
    assert_int_equal(hair_groom_create(&desc, &groom[0]), HAIR_OK);
    assert_int_equal(hair_groom_create(&next, &groom[1]), HAIR_OK);
    for (int i = 0; i < 2; ++i) assert_int_equal(hair_groom_describe(groom[i], &made[i]), HAIR_OK);
    assert_float_equal(made[1].length[2], made[0].length[2], 1e-5);
    assert_float_equal(made[1].length[2], 0.5f * 0.3f, 1e-5);
    for (int i = 0; i < 2; ++i) hair_groom_destroy(groom[i]);
    hair_asset_destroy(asset);
    hair_asset_destroy(again);
}

static void wrong_attributes_and_maps_make_no_asset(void** state)
{
    (void)state;
    static const float wrong[] = {1, NAN, 5};
    hair_groom_desc desc = arrays_desc();
    hair_strand_attribute attribute = hair_strand_attribute_default();
    hair_map_set set = hair_map_set_default();
    hair_asset* asset = NULL;
    attribute.map = (hair_map){HAIR_MAP_SOURCE_VERTICES, wrong, 0, 0};
    desc.strand_attributes = &attribute;
    desc.strand_attribute_count = 1;
    assert_int_equal(hair_asset_create(&desc, NULL, NULL, 0, NULL, &asset), HAIR_ERROR_ARGUMENT);
    assert_non_null(strstr(test.sentence, "strand_attributes[0].map.values[1] is nan, not in [0, 100]"));
    attribute.map = (hair_map){HAIR_MAP_SOURCE_NONE, NULL, 0, 0};
    set.thickness = (hair_map){HAIR_MAP_SOURCE_TRIANGLES, wrong + 2, 0, 0};
    desc.map_sets[0] = &set;
    assert_int_equal(hair_asset_create(&desc, NULL, NULL, 0, NULL, &asset), HAIR_ERROR_ARGUMENT);
    assert_non_null(strstr(test.sentence, "map_sets[0].thickness.values[0] is 5, not in [0, 4]"));
    assert_null(asset);
}

// Check a sentence of hair_asset_create() for joints.
static void refuse_joints(const uint16_t* joints, const float* weights, uint32_t count, const char* text)
{
    hair_groom_desc desc = arrays_desc();
    hair_asset* asset = NULL;
    uint32_t blocks = test.blocks;
    assert_int_equal(hair_asset_create(&desc, joints, weights, count, NULL, &asset), HAIR_ERROR_ARGUMENT);
    if (!strstr(test.sentence, text)) fail_msg("\"%s\" lacks \"%s\"", test.sentence, text);
    assert_null(asset);
    assert_int_equal(test.blocks, blocks);
}

static void wrong_arrays_make_no_asset(void** state)
{
    (void)state;
    static const float thin[12] = {0.5f}, nan_weights[12] = {NAN}, far[] = {0, NAN, 0, 0, 0, 0};
    hair_asset* asset = NULL;
    refuse_joints(arrays_joints, arrays_weights, 3, "scalp_joints[3] is 3, not in [0, 2]");
    refuse_joints(arrays_joints, arrays_weights, 0, "scalp_joint_count is 0, not in [1, 65536]");
    refuse_joints(arrays_joints, arrays_weights, 65537, "scalp_joint_count is 65537");
    refuse_joints(arrays_joints, NULL, 4, "scalp_weights is NULL");
    refuse_joints(NULL, arrays_weights, 0, "scalp_joints is NULL");
    refuse_joints(arrays_joints, thin, 4, "the sum of scalp_weights of vertex 0 is 0.5, not in [0.99, 1.01]");
    refuse_joints(arrays_joints, nan_weights, 4, "scalp_weights[0] is nan, not in [0, 1]");
    hair_groom_desc desc = arrays_desc();
    assert_int_equal(hair_asset_create(&desc, arrays_joints, arrays_weights, 4, "a\0b\0\xff\0c", &asset),
                     HAIR_ERROR_ARGUMENT);
    assert_non_null(strstr(test.sentence, "scalp_joint_names: name 2 is not UTF-8"));
    assert_int_equal(hair_asset_create(&desc, NULL, NULL, 0, "a", &asset), HAIR_ERROR_ARGUMENT);
    assert_non_null(strstr(test.sentence, "scalp_joints is NULL but scalp_joint_names is not"));
    assert_null(asset);
    desc.scalp_uvs = far;
    assert_int_equal(hair_asset_create(&desc, NULL, NULL, 0, NULL, &asset), HAIR_ERROR_ARGUMENT);
    assert_non_null(strstr(test.sentence, "scalp_uvs: vertex 0 has nan"));
    desc = arrays_desc();
    desc.positions = NULL;
    assert_int_equal(hair_asset_create(&desc, NULL, NULL, 0, NULL, &asset), HAIR_ERROR_ARGUMENT);
    desc = arrays_desc();
    assert_int_equal(hair_asset_create(&desc, NULL, NULL, 0, NULL, NULL), HAIR_ERROR_ARGUMENT);
    assert_int_equal(hair_asset_create(NULL, NULL, NULL, 0, NULL, &asset), HAIR_ERROR_ARGUMENT);
    for (uint32_t refused = 1, result = HAIR_ERROR_MEMORY; result; ++refused) {
        test.allocations = 0;
        test.refuse = refused;
        result = hair_asset_create(&desc, arrays_joints, arrays_weights, 4, arrays_names, &asset);
        test.refuse = 0;
        assert_true(result == HAIR_OK || (result == HAIR_ERROR_MEMORY && refused < 16));
        if (result) assert_int_equal(test.blocks, 0);
    }
    hair_asset_destroy(asset);
}

#define TEST(name) HAIR_TEST_WITH_HOST(name, &test)

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(arrays_are_written_and_make_a_groom_with_groups),
        TEST(guides_of_arrays_reach_a_groom),
        TEST(attributes_and_maps_of_arrays_reach_a_groom),
        TEST(wrong_attributes_and_maps_make_no_asset),
        TEST(wrong_arrays_make_no_asset),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
