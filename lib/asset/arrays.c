// arrays.c - strands and scalps from the arrays of an application: copied, checked, and converted
// to metres and +y up.
#include "lib/asset/arrays.h"

#include "lib/asset/text.h"

#include <math.h>
#include <string.h>

#define FARTHEST 1e6f // Maximum distance from the origin, m, as for strands.
#define MIN_VERTICES 4096 // Minimum number of vertices of a task.

static hair_result count_strand_vertices(const hair_host* host, const hair_groom_desc* desc, uint32_t* out)
{
    uint64_t sum = 0; // fits 2^22 strands of 2^32 vertices
    for (uint32_t i = 0; i < desc->strand_count; ++i) sum += desc->strand_vertices[i];
    if (sum > UINT32_MAX)
        return hair_fail(host, HAIR_ERROR_ARGUMENT,
                         "hair_groom_desc.strand_vertices add up to %llu, not in [0, %u]",
                         (unsigned long long)sum, UINT32_MAX);
    *out = (uint32_t)sum;
    return HAIR_OK;
}

static hair_result check_array(const hair_host* host, const char* what, const float* numbers, size_t count,
                               float max)
{
    for (size_t i = 0; i < count; ++i)
        if (!(numbers[i] >= 0 && numbers[i] <= max)) // NaN fails too.
            return hair_fail(host, HAIR_ERROR_ARGUMENT, "hair_groom_desc.%s[%zu] is %g, not in [0, %g]", what,
                             i, (double)numbers[i], (double)max);
    return HAIR_OK;
}

static hair_result copy_groups(const hair_host* host, const hair_groom_desc* desc,
                               struct hair_strands* strands)
{
    const uint8_t* groups = desc->strand_groups;
    if (!groups) return HAIR_OK;
    for (uint32_t i = 0; i < strands->strand_count; ++i)
        if (groups[i] >= HAIR_MAX_STRAND_GROUPS)
            return hair_fail(host, HAIR_ERROR_ARGUMENT,
                             "hair_groom_desc.strand_groups[%u] is %u, not in [0, %d]", i, groups[i],
                             HAIR_MAX_STRAND_GROUPS - 1);
    strands->groups = hair_alloc(host, strands->strand_count, sizeof *groups);
    if (!strands->groups) return hair_fail_memory(host, "strands");
    memcpy(strands->groups, groups, strands->strand_count * sizeof *groups);
    return HAIR_OK;
}

static hair_result copy_guides(const hair_host* host, const hair_groom_desc* desc,
                               struct hair_strands* strands)
{
    const uint8_t* guides = desc->strand_guides;
    if (!guides || desc->strand_set == HAIR_STRAND_SET_GUIDES) return HAIR_OK;
    for (uint32_t i = 0; i < strands->strand_count; ++i)
        if (guides[i] > 1)
            return hair_fail(host, HAIR_ERROR_ARGUMENT,
                             "hair_groom_desc.strand_guides[%u] is %u, not in [0, 1]", i, guides[i]);
    strands->guides = hair_alloc(host, strands->strand_count, sizeof *guides);
    if (!strands->guides) return hair_fail_memory(host, "strands");
    memcpy(strands->guides, guides, strands->strand_count * sizeof *guides);
    return HAIR_OK;
}

// Copy the groups, guides, radii, factors and colours of strands.
static hair_result copy_rest(const hair_host* host, const hair_groom_desc* desc, struct hair_strands* strands)
{
    uint32_t each = desc->color_count, count = strands->strand_count;
    HAIR_TRY(copy_groups(host, desc, strands));
    HAIR_TRY(copy_guides(host, desc, strands));
    HAIR_TRY(hair_strands_copy_factors(host, desc, strands));
    if (desc->strand_radii) {
        HAIR_TRY(check_array(host, "strand_radii", desc->strand_radii, count, FARTHEST));
        strands->radii = hair_alloc(host, count, sizeof *strands->radii);
        if (!strands->radii) return hair_fail_memory(host, "strands");
        memcpy(strands->radii, desc->strand_radii, count * sizeof *strands->radii);
    }
    if (!desc->colors) return HAIR_OK;
    HAIR_TRY(check_array(host, "colors", desc->colors,
                         3 * (each ? (size_t)each * count : (size_t)strands->vertex_count), 1));
    strands->colors = hair_alloc(host, count, 3 * HAIR_STRAND_COLORS * sizeof *strands->colors);
    if (!strands->colors) return hair_fail_memory(host, "the colours of strands");
    size_t first = 0;
    for (uint32_t i = 0; i < count; ++i) {
        float* out = strands->colors + 3 * HAIR_STRAND_COLORS * (size_t)i;
        if (each)
            hair_strand_even_colors(desc->colors + 3 * (size_t)each * i, each, out);
        else if (strands->vertices[i])
            hair_strand_colors(desc->positions + 3 * first, strands->vertices[i], desc->colors + 3 * first,
                               out);
        first += strands->vertices[i];
    }
    return HAIR_OK;
}

struct copying {
    const float* from;
    float* to;
    struct hair_division division; // of the vertices
};

static void copy_positions(uint32_t index, void* data)
{
    const struct copying* copying = data;
    size_t first = 3 * (size_t)index * copying->division.each;
    size_t end = 3 * (size_t)hair_division_end(&copying->division, index);
    memcpy(copying->to + first, copying->from + first, (end - first) * sizeof *copying->to);
}

static hair_result copy_strands(const hair_host* host, const hair_tasks* tasks, const hair_groom_desc* desc,
                                struct hair_strands* strands)
{
    HAIR_TRY(count_strand_vertices(host, desc, &strands->vertex_count));
    strands->strand_count = desc->strand_count;
    strands->positions = hair_alloc_undefined(host, strands->vertex_count, 3 * sizeof(float));
    strands->vertices = hair_alloc_undefined(host, strands->strand_count, sizeof(uint32_t));
    if (!strands->positions || !strands->vertices) return hair_fail_memory(host, "strands");
    struct copying copying = {.from = desc->positions,
                              .to = strands->positions,
                              .division = hair_divide(strands->vertex_count, MIN_VERTICES)};
    hair_run_tasks(tasks, copy_positions, &copying, copying.division.tasks);
    memcpy(strands->vertices, desc->strand_vertices, strands->strand_count * sizeof(uint32_t));
    return copy_rest(host, desc, strands);
}

hair_result hair_strands_import(const hair_host* host, const hair_tasks* tasks, const hair_groom_desc* desc,
                                const hair_import* import, struct hair_strands* strands,
                                hair_import_stats* repairs)
{
    HAIR_TRY(copy_strands(host, tasks, desc, strands));
    HAIR_TRY(hair_strands_clean(host, tasks, import, strands, repairs));
    if (strands->strand_count) return HAIR_OK;
    return hair_fail(
        host, HAIR_ERROR_ARGUMENT,
        "hair_groom_desc.positions: none of %u strands can be used: %u have fewer than two vertices "
        "left, %u are too short; %u vertices were not finite, %u repeated",
        desc->strand_count, repairs->dropped_single, repairs->dropped_short, repairs->removed_nonfinite,
        repairs->removed_repeated);
}

// Scalp -------------------------------------------------------------------------------------------

static hair_result check_triangles(const hair_host* host, const hair_groom_desc* desc)
{
    for (size_t i = 0; i < 3 * (size_t)desc->scalp_triangle_count; ++i)
        if (desc->scalp_triangles[i] >= desc->scalp_vertex_count)
            return hair_fail(host, HAIR_ERROR_ARGUMENT,
                             "hair_groom_desc.scalp_triangles[%zu] is %u, not in [0, %u]", i,
                             desc->scalp_triangles[i], desc->scalp_vertex_count - 1);
    return HAIR_OK;
}

static hair_result check_density(const hair_host* host, const hair_groom_desc* desc)
{
    for (uint32_t i = 0; desc->scalp_density && i < desc->scalp_vertex_count; ++i)
        if (!(desc->scalp_density[i] >= 0 && desc->scalp_density[i] <= 1))
            return hair_fail(host, HAIR_ERROR_ARGUMENT,
                             "hair_groom_desc.scalp_density[%u] is %g, not in [0, 1]", i,
                             (double)desc->scalp_density[i]);
    return HAIR_OK;
}

hair_result hair_scalp_check(const hair_host* host, const hair_groom_desc* desc)
{
    HAIR_TRY(check_triangles(host, desc));
    return check_density(host, desc);
}

hair_result hair_scalp_place(const hair_host* host, const hair_groom_desc* desc, const hair_import* import,
                             float* positions)
{
    for (size_t i = 0; i < desc->scalp_vertex_count; ++i) {
        const float* p = desc->scalp_positions + 3 * i;
        hair_vec3 at = hair_import_point(import, hair_load3(p));
        if (!(hair_length(at) <= FARTHEST)) // NaN fails too.
            return hair_fail(
                host, HAIR_ERROR_ARGUMENT,
                "hair_groom_desc.scalp_positions: vertex %zu is (%g, %g, %g), not within %g m of the origin",
                i, (double)p[0], (double)p[1], (double)p[2], (double)FARTHEST);
        hair_store3(positions + 3 * i, at);
    }
    return HAIR_OK;
}

// Assets ------------------------------------------------------------------------------------------

// Copy an array. The copy of NULL is NULL.
static hair_result copy_array(const hair_host* host, const void* from, size_t count, size_t size, void** out)
{
    if (!from) return HAIR_OK;
    *out = hair_alloc(host, count, size);
    if (!*out) return hair_fail_memory(host, "the scalp");
    memcpy(*out, from, count * size);
    return HAIR_OK;
}

static hair_result copy_scalp(const hair_groom_desc* desc, const hair_import* import, hair_asset* asset)
{
    const hair_host* host = &asset->host;
    size_t vertices = desc->scalp_vertex_count, triangles = desc->scalp_triangle_count;
    void *positions = NULL, *corners = NULL, *density = NULL, *uvs = NULL;
    HAIR_TRY(hair_scalp_check(host, desc));
    HAIR_TRY(hair_check_uvs(host, desc));
    hair_result result = copy_array(host, desc->scalp_positions, vertices, 12, &positions);
    if (!result) result = copy_array(host, desc->scalp_triangles, triangles, 12, &corners);
    if (!result) result = copy_array(host, desc->scalp_density, vertices, 4, &density);
    if (!result) result = copy_array(host, desc->scalp_uvs, vertices, 8, &uvs);
    asset->scalp_positions = positions;
    asset->scalp_triangles = corners;
    asset->scalp_density = density;
    asset->scalp_uvs = uvs;
    asset->scalp_vertex_count = desc->scalp_vertex_count;
    asset->scalp_triangle_count = desc->scalp_triangle_count;
    return result ? result : hair_scalp_place(host, desc, import, asset->scalp_positions);
}

static hair_result check_skin(const hair_host* host, const struct hair_skin_arrays* skin, uint32_t vertices)
{
    for (size_t i = 0; i < vertices; ++i) {
        float sum = 0;
        for (size_t k = 4 * i; k < 4 * i + 4; ++k) {
            if (skin->joints[k] >= skin->joint_count)
                return hair_fail(host, HAIR_ERROR_ARGUMENT, "scalp_joints[%zu] is %u, not in [0, %u]", k,
                                 skin->joints[k], skin->joint_count - 1);
            if (!(skin->weights[k] >= 0 && skin->weights[k] <= 1)) // NaN fails too.
                return hair_fail(host, HAIR_ERROR_ARGUMENT, "scalp_weights[%zu] is %g, not in [0, 1]", k,
                                 (double)skin->weights[k]);
            sum += skin->weights[k];
        }
        if (!(fabsf(sum - 1) <= HAIR_MAX_WEIGHT_ERROR))
            return hair_fail(host, HAIR_ERROR_ARGUMENT,
                             "the sum of scalp_weights of vertex %zu is %g, not in [%g, %g]", i, (double)sum,
                             1 - (double)HAIR_MAX_WEIGHT_ERROR, 1 + (double)HAIR_MAX_WEIGHT_ERROR);
    }
    return HAIR_OK;
}

static hair_result copy_joint_names(const struct hair_skin_arrays* skin, hair_asset* asset)
{
    const char* end = skin->joint_names;
    void* names = NULL;
    if (!end) return HAIR_OK;
    for (uint32_t i = 0; i < skin->joint_count; ++i) {
        size_t size = strlen(end);
        if (!hair_text_is_utf8(end, size))
            return hair_fail(&asset->host, HAIR_ERROR_ARGUMENT, "scalp_joint_names: name %u is not UTF-8", i);
        end += size + 1;
    }
    asset->joint_names_size = (size_t)(end - skin->joint_names);
    HAIR_TRY(copy_array(&asset->host, skin->joint_names, asset->joint_names_size, 1, &names));
    asset->joint_names = names;
    return HAIR_OK;
}

static hair_result copy_skin(const struct hair_skin_arrays* skin, hair_asset* asset)
{
    void *joints = NULL, *weights = NULL;
    HAIR_TRY(check_skin(&asset->host, skin, asset->scalp_vertex_count));
    hair_result result = copy_array(&asset->host, skin->joints, asset->scalp_vertex_count, 8, &joints);
    if (!result) result = copy_array(&asset->host, skin->weights, asset->scalp_vertex_count, 16, &weights);
    asset->scalp_joints = joints;
    asset->scalp_weights = weights;
    asset->scalp_joint_count = skin->joint_count;
    return result ? result : copy_joint_names(skin, asset);
}

static hair_result fill_asset(const hair_groom_desc* desc, const hair_import* import,
                              const struct hair_skin_arrays* skin, hair_asset* asset)
{
    asset->strand_set = desc->strand_set;
    asset->file_strands = desc->strand_count;
    for (uint32_t i = 0; i < desc->strand_count; ++i) asset->file_vertices += desc->strand_vertices[i];
    const hair_tasks tasks = {0};
    HAIR_TRY(hair_strands_import(&asset->host, &tasks, desc, import, &asset->strands, &asset->repairs));
    if (desc->scalp_positions) HAIR_TRY(copy_scalp(desc, import, asset));
    if (desc->scalp_positions) HAIR_TRY(hair_asset_copy_maps(desc, asset));
    hair_asset_link_factors(asset);
    return skin->joints ? copy_skin(skin, asset) : HAIR_OK;
}

hair_result hair_asset_from_arrays(const hair_host* host, const hair_groom_desc* desc,
                                   const hair_import* import, const struct hair_skin_arrays* skin,
                                   hair_asset** out)
{
    hair_asset* asset = hair_alloc(host, 1, sizeof *asset);
    if (!asset) return hair_fail_memory(host, "hair_asset");
    asset->host = *host;
    hair_result result = fill_asset(desc, import, skin, asset);
    if (result)
        hair_asset_free(asset);
    else
        *out = asset;
    return result;
}
