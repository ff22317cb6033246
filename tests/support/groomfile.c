// groomfile.c - a small .groom file with every chunk, and changes of chunks with valid checksums.
#include "tests/support/groomfile.h"
#include "lib/base/bytes.h"
#include "tests/support/seal.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

#define STRANDS 4
#define VERTICES 12

static void fill_strands(float* positions, float* colors)
{
    static const uint32_t vertices[STRANDS] = {3, 2, 4, 3};
    for (uint32_t s = 0; s < STRANDS; ++s)
        for (uint32_t i = 0; i < vertices[s]; ++i, positions += 3)
            hair_store3(positions, hair_v3((float)s, 0.1f * (float)i, s == 2 ? 0.0125f * (float)(i * i) : 0));
    // Rounding to a unit of at least 2.8e-6 of the length may not keep this segment apart.
    positions[-5] = 0.2f * 1.0001e-5f;
    for (int i = 0; i < 3 * HAIR_STRAND_COLORS * STRANDS; ++i) colors[i] = (float)(i * 37 % 101) / 100;
}

// Give an asset what chunks with names hold: two map sets, and attributes of three kinds.
static void add_named(hair_asset* asset)
{
    static const float values[8] = {0, 0.25f, 0.5f, 1, 0.75f, 0.125f, 1, 0};
    static float stiffness[STRANDS] = {0.5f, 1, 2, 100}, length[STRANDS] = {1, 0.5f, 0.25f, 0.01f};
    asset->map_set_count = 2;
    for (int i = 0; i < 2; ++i) asset->map_sets[i] = hair_map_set_default();
    asset->map_sets[1].density = (hair_map){HAIR_MAP_SOURCE_IMAGE, values, 4, 2};
    asset->map_sets[1].thickness = (hair_map){HAIR_MAP_SOURCE_TRIANGLES, values + 2, 0, 0};
    hair_asset_add_attribute(asset, HAIR_STRAND_ATTRIBUTE_FRIZZ)->map =
        (hair_map){HAIR_MAP_SOURCE_VERTICES, values, 0, 0};
    hair_asset_add_attribute(asset, HAIR_STRAND_ATTRIBUTE_LENGTH)->map =
        (hair_map){HAIR_MAP_SOURCE_IMAGE, values + 1, 1, 5};
    hair_asset_add_attribute(asset, HAIR_STRAND_ATTRIBUTE_FRIZZ)->map =
        (hair_map){HAIR_MAP_SOURCE_IMAGE, values, 2, 2};
    asset->strands.factors[HAIR_STRAND_ATTRIBUTE_STIFFNESS] = stiffness;
    asset->strands.factors[HAIR_STRAND_ATTRIBUTE_LENGTH] = length;
}

static struct hair_test_file write_groomfile(bool has_all)
{
    // A byte 0 follows the last name.
    static char names[] = "hip\0neck\0head\0h\xc3\xa4r\0\xf0\x9f\xa6\xb1";
    static uint8_t guides[STRANDS] = {1, 0, 1, 1};
    static uint32_t vertices[STRANDS] = {3, 2, 4, 3}, triangles[6] = {0, 1, 2, 2, 1, 3};
    static uint8_t groups[STRANDS] = {0, 7, 3, 0};
    static float positions[3 * VERTICES], colors[3 * HAIR_STRAND_COLORS * STRANDS],
        radii[STRANDS] = {1e-5f, 2e-5f, 0, 4e-5f}, density[4] = {0, 0.25f, 0.5f, 1},
        uvs[8] = {0, 0, 1, 0, 0, 1, 1, 1}, scalp[12] = {0, 0, 0, 1, 0, 0, 0, 0, 1, 1, 0, 1},
        weights[16] = {1, 0, 0, 0, 0.5f, 0.5f, 0, 0, 0.25f, 0.25f, 0.25f, 0.25f, 0, 0, 0, 1};
    static uint16_t joints[16] = {0, 0, 0, 0, 1, 2, 0, 0, 1, 2, 3, 4, 0, 0, 0, 4};
    hair_asset asset = {.strand_set = HAIR_STRAND_SET_GUIDES,
                        .strands = {.positions = positions,
                                    .vertices = vertices,
                                    .radii = radii,
                                    .colors = colors,
                                    .groups = groups,
                                    .strand_count = STRANDS,
                                    .vertex_count = VERTICES},
                        .scalp_positions = scalp,
                        .scalp_triangles = triangles,
                        .scalp_density = density,
                        .scalp_uvs = uvs,
                        .scalp_joints = joints,
                        .scalp_weights = weights,
                        .scalp_vertex_count = 4,
                        .scalp_triangle_count = 2,
                        .scalp_joint_count = 5};
    fill_strands(positions, colors);
    if (has_all) {
        asset.strands.guides = guides;
        asset.joint_names = names;
        asset.joint_names_size = sizeof names;
        add_named(&asset);
    }
    return hair_test_write_file(&asset, HAIR_FORMAT_GROOM);
}

struct hair_test_file hair_test_groomfile(void)
{
    return write_groomfile(true);
}

struct hair_test_file hair_test_old_groomfile(void)
{
    return write_groomfile(false);
}

size_t hair_test_find_chunk(const struct hair_test_file* file, const char* letters)
{
    size_t at = 32;
    const char* name = letters[4] ? letters + 5 : "";
    while (at + 16 <= file->size && (memcmp(file->bytes + at, letters, 4) != 0 ||
                                     memcmp(file->bytes + at + 16, name, strlen(name)) != 0))
        at += 16 + (size_t)hair_read_u64(file->bytes + at + 4);
    if (at + 16 > file->size) fail_msg("there is no chunk %s", letters);
    return at;
}

void hair_test_resize_chunk(struct hair_test_file* file, const char* letters, size_t at, int count)
{
    size_t chunk = hair_test_find_chunk(file, letters), place = chunk + 16 + at;
    size_t inserted = count > 0 ? (size_t)count : 0, removed = count < 0 ? (size_t)-count : 0;
    unsigned char* bytes = calloc(1, file->size + inserted);
    assert_non_null(bytes);
    memcpy(bytes, file->bytes, place);
    memcpy(bytes + place + inserted, file->bytes + place + removed, file->size - place - removed);
    hair_write_u64(bytes + chunk + 4, hair_read_u64(bytes + chunk + 4) + inserted - removed);
    free(file->bytes);
    file->bytes = bytes;
    file->room = file->size += inserted - removed;
    hair_write_u64(file->bytes + 16, file->size);
    hair_test_seal(file->bytes, file->size);
}
