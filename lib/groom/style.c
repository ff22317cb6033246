// style.c - the built-in haircuts as assets, with one guide per vertex of the built-in scalp.
#include "lib/groom/style.h"
#include "lib/groom/style_body.h"
#include "lib/groom/style_grow.h"

#define HAIRLINE_DENSITY 0.3f // Fraction of the full density at the hairline.
#define SHOWN_DENSITY 0.08f // Fraction where all hair is combed away from the hairline.
#define HAIRLINE_WIDTH 0.012f // Height above the hairline of the full density, m.
#define SHOWN_WIDTH 0.022f // Height where all hair is combed away from the hairline, m.
#define FINEST 0.4f // Radius of hair at the hairline, as a fraction of the radius of other hair.
#define FINE_HEIGHT 0.02f // Height above the hairline of the full radius, m.

static hair_result grow_guides(const hair_host* host, const hair_style_desc* desc, struct hair_asset* asset)
{
    uint32_t count = asset->scalp_vertex_count;
    uint32_t each = desc->strand_vertices ? desc->strand_vertices : hair_style_vertices(desc->style);
    struct hair_style_path* path = hair_alloc(host, 1, sizeof *path);
    asset->strands.positions = hair_alloc(host, (size_t)count * each, 3 * sizeof(float));
    asset->strands.vertices = hair_alloc(host, count, sizeof(uint32_t));
    if (!path || !asset->strands.positions || !asset->strands.vertices) {
        hair_free(host, path);
        return hair_fail_memory(host, "the guides of a haircut");
    }
    for (uint32_t i = 0; i < count; ++i) {
        hair_style_grow(desc->style, i, hair_load3(asset->scalp_positions + 3 * i), desc->length, desc->seed,
                        path);
        HAIR_ASSERT(2 <= path->count && path->count <= HAIR_STYLE_PATH_POINTS && each >= 2);
        hair_strand_resample(&path->point[0].x, path->count, asset->strands.positions + 3 * (size_t)i * each,
                             each);
        asset->strands.vertices[i] = each;
    }
    asset->strands.strand_count = count;
    asset->strands.vertex_count = count * each;
    asset->file_strands = count;
    asset->file_vertices = count * each;
    hair_free(host, path);
    return HAIR_OK;
}

// Return whether all hair is combed away from the hairline, which shows.
static bool shows_hairline(hair_style style)
{
    return style == HAIR_STYLE_SHORT || style == HAIR_STYLE_FADE || style == HAIR_STYLE_PONYTAIL ||
           style == HAIR_STYLE_BUN || style == HAIR_STYLE_BRAID;
}

// Let the density fall off towards the hairline, which no head has as a sharp edge. The hairline is
// uneven.
static hair_result thin_hairline(const hair_host* host, const hair_style_desc* desc, struct hair_asset* asset)
{
    struct hair_parting parting = hair_style_parting(desc->style);
    bool shows = shows_hairline(desc->style);
    float density = shows ? SHOWN_DENSITY : HAIRLINE_DENSITY, width = shows ? SHOWN_WIDTH : HAIRLINE_WIDTH;
    asset->scalp_density = hair_alloc(host, asset->scalp_vertex_count, sizeof(float));
    if (!asset->scalp_density) return hair_fail_memory(host, "the density of a haircut");
    for (uint32_t i = 0; i < asset->scalp_vertex_count; ++i) {
        hair_vec3 p = hair_load3(asset->scalp_positions + 3 * (size_t)i), unit = hair_skull_unit(p);
        float above = p.y - hair_scalp_hairline(atan2f(unit.x, unit.z));
        float edge = density * (1 + 0.6f * hair_noise(p, 0.009f, hair_hash(desc->seed + 71u)));
        // Hair runs away from a parting on both sides, and would leave a triangle of skin there.
        float beside = parting.exists && p.z > 0 ? fabsf(p.x - hair_parting_x(parting, p.z)) : 1;
        edge = hair_mix(edge, 1, hair_smooth(0.020f, 0.006f, beside));
        asset->scalp_density[i] = hair_mix(edge, 1, hair_smooth(0.002f, width, above));
    }
    return HAIR_OK;
}

// Let hair of the hairline be finer than other hair, as on a head. Thick hair would draw its edge.
static hair_result refine_hairline(const hair_host* host, hair_style style, struct hair_asset* asset)
{
    if (!shows_hairline(style)) return HAIR_OK;
    float* values = hair_alloc(host, asset->scalp_vertex_count, sizeof(float));
    if (!values) return hair_fail_memory(host, "the radii of a haircut");
    hair_map* map = &hair_asset_add_attribute(asset, HAIR_STRAND_ATTRIBUTE_RADIUS)->map;
    map->source = HAIR_MAP_SOURCE_VERTICES;
    map->values = values;
    for (uint32_t i = 0; i < asset->scalp_vertex_count; ++i) {
        hair_vec3 p = hair_load3(asset->scalp_positions + 3 * (size_t)i), unit = hair_skull_unit(p);
        float above = p.y - hair_scalp_hairline(atan2f(unit.x, unit.z));
        values[i] = hair_mix(FINEST, 1, hair_smooth(0, FINE_HEIGHT, above));
    }
    return HAIR_OK;
}

static hair_result build_style(const hair_host* host, const hair_style_desc* desc, struct hair_asset* asset)
{
    asset->host = *host;
    asset->format = HAIR_FORMAT_NONE;
    asset->strand_set = HAIR_STRAND_SET_GUIDES;
    struct hair_scalp scalp;
    HAIR_TRY(hair_scalp_build(host, desc->guide_count, hair_style_parting(desc->style), desc->seed, &scalp));
    asset->scalp_positions = scalp.positions;
    asset->scalp_triangles = scalp.triangles;
    asset->scalp_vertex_count = scalp.vertex_count;
    asset->scalp_triangle_count = scalp.triangle_count;
    HAIR_TRY(thin_hairline(host, desc, asset));
    HAIR_TRY(refine_hairline(host, desc->style, asset));
    return grow_guides(host, desc, asset);
}

hair_result hair_style_build(const hair_host* host, const hair_style_desc* desc, hair_asset** out)
{
    struct hair_asset* asset = hair_alloc(host, 1, sizeof *asset);
    if (!asset) return hair_fail_memory(host, "a haircut");
    hair_result result = build_style(host, desc, asset);
    if (result)
        hair_asset_free(asset);
    else
        *out = asset;
    return result;
}
