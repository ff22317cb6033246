// groomfile_scalp.c - the scalp of .groom files: its mesh, density, texture coordinates and joints.
#include "lib/asset/groomfile.h"
#include "lib/asset/text.h"

#include <math.h>

#define FARTHEST 1e6f // Maximum distance from the origin, m, as for strands.
#define MAX_COUNT 4194304 // Maximum number of vertices and of triangles, as of hair_groom_desc.
#define MAX_JOINTS 65536

static hair_result read_triangles(const struct hair_groom_chunk* chunk, size_t at, hair_asset* asset)
{
    size_t corners = 3 * (size_t)asset->scalp_triangle_count;
    asset->scalp_triangles = hair_alloc(chunk->source->host, corners, sizeof *asset->scalp_triangles);
    if (!asset->scalp_triangles) return hair_fail_memory(chunk->source->host, "the scalp of a file");
    for (size_t i = 0; i < corners; ++i) {
        uint32_t corner = asset->scalp_triangles[i] = hair_read_u32(chunk->content + at + 4 * i);
        if (corner >= asset->scalp_vertex_count)
            return HAIR_FAIL_CHUNK(chunk, "has the corner %u, not in [0, %u]", corner,
                                   asset->scalp_vertex_count - 1);
    }
    return HAIR_OK;
}

static hair_result read_mesh(const struct hair_groom_chunk* chunk, hair_asset* asset)
{
    if (chunk->size < 8) return hair_check_chunk_size(chunk, 8);
    uint32_t vertices = asset->scalp_vertex_count = hair_read_u32(chunk->content);
    uint32_t triangles = asset->scalp_triangle_count = hair_read_u32(chunk->content + 4);
    if (vertices < 3 || vertices > MAX_COUNT || triangles - 1 >= MAX_COUNT)
        return HAIR_FAIL_CHUNK(chunk, "has %u vertices and %u triangles, not in [3, %d] and [1, %d]",
                               vertices, triangles, MAX_COUNT, MAX_COUNT);
    HAIR_TRY(hair_check_chunk_size(chunk, 8 + 12 * ((uint64_t)vertices + triangles)));
    float limit = 2 * FARTHEST / chunk->source->import->scale;
    HAIR_TRY(hair_read_groom_floats(chunk, 8, 3 * (size_t)vertices,
                                    (struct hair_attribute_range){-limit, limit}, &asset->scalp_positions));
    for (size_t i = 0; i < vertices; ++i) {
        float* p = asset->scalp_positions + 3 * i;
        hair_vec3 at = hair_import_point(chunk->source->import, hair_load3(p));
        if (!(hair_length(at) <= FARTHEST))
            return HAIR_FAIL_CHUNK(chunk, "has the vertex (%g, %g, %g), not within %g m of the origin",
                                   (double)at.x, (double)at.y, (double)at.z, (double)FARTHEST);
        hair_store3(p, at);
    }
    return read_triangles(chunk, 8 + 12 * (size_t)vertices, asset);
}

static hair_result check_joints(const struct hair_groom_chunk* chunk, const hair_asset* asset)
{
    for (size_t i = 0; i < asset->scalp_vertex_count; ++i) {
        const uint16_t* joints = asset->scalp_joints + 4 * i;
        const float* w = asset->scalp_weights + 4 * i;
        float sum = w[0] + w[1] + w[2] + w[3];
        for (int k = 0; k < 4; ++k)
            if (joints[k] >= asset->scalp_joint_count)
                return HAIR_FAIL_CHUNK(chunk, "has the joint %u of vertex %zu, not in [0, %u]", joints[k], i,
                                       asset->scalp_joint_count - 1);
        if (!(fabsf(sum - 1) <= HAIR_MAX_WEIGHT_ERROR))
            return HAIR_FAIL_CHUNK(chunk, "has weights of vertex %zu whose sum is %g, not in [%g, %g]", i,
                                   (double)sum, 1 - (double)HAIR_MAX_WEIGHT_ERROR,
                                   1 + (double)HAIR_MAX_WEIGHT_ERROR);
    }
    return HAIR_OK;
}

static hair_result read_joints(const struct hair_groom_chunk* chunk, hair_asset* asset)
{
    size_t vertices = asset->scalp_vertex_count;
    HAIR_TRY(hair_check_chunk_size(chunk, 4 + 24 * (uint64_t)vertices));
    asset->scalp_joint_count = hair_read_u32(chunk->content);
    if (asset->scalp_joint_count - 1 >= MAX_JOINTS)
        return HAIR_FAIL_CHUNK(chunk, "has %u joints, not in [1, %d]", asset->scalp_joint_count, MAX_JOINTS);
    asset->scalp_joints = hair_alloc(chunk->source->host, vertices, 4 * sizeof *asset->scalp_joints);
    if (!asset->scalp_joints) return hair_fail_memory(chunk->source->host, "the scalp of a file");
    for (size_t i = 0; i < 4 * vertices; ++i)
        asset->scalp_joints[i] = (uint16_t)hair_read_u16(chunk->content + 4 + 2 * i);
    HAIR_TRY(hair_read_groom_floats(chunk, 4 + 8 * vertices, 4 * vertices,
                                    (struct hair_attribute_range){0, 1}, &asset->scalp_weights));
    return check_joints(chunk, asset);
}

static hair_result read_joint_names(const struct hair_groom_chunk* chunk, hair_asset* asset)
{
    if (!asset->scalp_joint_count)
        return HAIR_FAIL_CHUNK(chunk, "needs a chunk \"%s\"", hair_groom_letters[HAIR_CHUNK_SKIN]);
    uint32_t names = 0;
    for (size_t i = 0; i < chunk->size; ++i) names += chunk->content[i] == 0;
    if (names != asset->scalp_joint_count || chunk->content[chunk->size - 1])
        return HAIR_FAIL_CHUNK(chunk, "has %u names that end in a byte 0, not %u", names,
                               asset->scalp_joint_count);
    if (!hair_text_is_utf8(chunk->content, chunk->size))
        return HAIR_FAIL_CHUNK(chunk, "has a name that is not %s", "UTF-8");
    asset->joint_names = hair_alloc(chunk->source->host, chunk->size, 1);
    if (!asset->joint_names) return hair_fail_memory(chunk->source->host, "the names of joints");
    memcpy(asset->joint_names, chunk->content, chunk->size);
    asset->joint_names_size = chunk->size;
    return HAIR_OK;
}

hair_result hair_read_groom_scalp(const struct hair_groom_chunk chunks[HAIR_CHUNK_COUNT], hair_asset* asset)
{
    const struct hair_groom_chunk *density = &chunks[HAIR_CHUNK_DENSITY], *uvs = &chunks[HAIR_CHUNK_UVS];
    if (chunks[HAIR_CHUNK_SCALP].letters) HAIR_TRY(read_mesh(&chunks[HAIR_CHUNK_SCALP], asset));
    size_t vertices = asset->scalp_vertex_count;
    for (int i = HAIR_CHUNK_DENSITY; i <= HAIR_CHUNK_SKIN; ++i)
        if (chunks[i].letters && !vertices)
            return HAIR_FAIL_CHUNK(&chunks[i], "needs a chunk \"%s\"", hair_groom_letters[HAIR_CHUNK_SCALP]);
    if (density->letters) {
        HAIR_TRY(hair_check_chunk_size(density, 4 * (uint64_t)vertices));
        HAIR_TRY(hair_read_groom_floats(density, 0, vertices, (struct hair_attribute_range){0, 1},
                                        &asset->scalp_density));
    }
    if (uvs->letters) {
        HAIR_TRY(hair_check_chunk_size(uvs, 8 * (uint64_t)vertices));
        HAIR_TRY(hair_read_groom_floats(uvs, 0, 2 * vertices, (struct hair_attribute_range){-1e6f, 1e6f},
                                        &asset->scalp_uvs));
    }
    if (chunks[HAIR_CHUNK_SKIN].letters) HAIR_TRY(read_joints(&chunks[HAIR_CHUNK_SKIN], asset));
    const struct hair_groom_chunk* names = &chunks[HAIR_CHUNK_JOINT_NAMES];
    return names->letters ? read_joint_names(names, asset) : HAIR_OK;
}
