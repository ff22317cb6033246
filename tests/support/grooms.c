// grooms.c - strands and scalps from which grooms are made, and followers evaluated as they are
// drawn.
#include "tests/support/grooms.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

struct hair_test_strands hair_test_strands_make(uint32_t count, uint32_t max)
{
    return (struct hair_test_strands){.positions = malloc(3 * (size_t)count * max * sizeof(float)),
                                      .vertices = malloc(count * sizeof(uint32_t))};
}

void hair_test_strands_free(struct hair_test_strands* strands)
{
    free(strands->positions);
    free(strands->vertices);
    memset(strands, 0, sizeof *strands);
}

void hair_test_strands_add(struct hair_test_strands* strands, uint32_t vertices,
                           hair_vec3 (*point)(float t, uint32_t strand, const void* user), const void* user)
{
    for (uint32_t i = 0; i < vertices; ++i) {
        float t = vertices > 1 ? (float)i / (float)(vertices - 1) : 0;
        hair_store3(strands->positions + 3 * (size_t)strands->vertex_count++, point(t, strands->count, user));
    }
    strands->vertices[strands->count++] = vertices;
}

static hair_vec3 fur(float t, uint32_t strand, const void* user)
{
    (void)user;
    uint32_t random = hair_hash(strand);
    float length = 0.015f + 0.01f * hair_random(&random);
    hair_vec3 root = {hair_random(&random), 0, hair_random(&random)};
    float lean = 0.5f + 0.2f * hair_random(&random);
    return hair_add(root, hair_scale(hair_v3(lean * t, 1 - 0.3f * t, 0.1f * sinf(9 * root.x)), length * t));
}

struct hair_test_strands hair_test_fur(uint32_t count)
{
    struct hair_test_strands strands = hair_test_strands_make(count, 8);
    for (uint32_t i = 0; i < count; ++i) hair_test_strands_add(&strands, 3 + i % 6, fur, NULL);
    return strands;
}

struct hair_test_scalp hair_test_scalp_make(uint32_t cells, float size)
{
    struct hair_test_scalp scalp = {.vertex_count = (cells + 1) * (cells + 1),
                                    .triangle_count = 2 * cells * cells};
    scalp.positions = malloc(3 * scalp.vertex_count * sizeof(float));
    scalp.triangles = malloc(3 * scalp.triangle_count * sizeof(uint32_t));
    for (uint32_t i = 0; i < scalp.vertex_count; ++i) {
        float x = size * (float)(i % (cells + 1)) / (float)cells;
        float z = size * (float)(i / (cells + 1)) / (float)cells;
        hair_store3(scalp.positions + 3 * i, hair_v3(x, 0, z));
    }
    for (uint32_t i = 0; i < cells * cells; ++i) {
        uint32_t a = i / cells * (cells + 1) + i % cells, b = a + 1, c = a + cells + 1, d = c + 1;
        uint32_t six[6] = {a, c, b, b, c, d};
        memcpy(scalp.triangles + 6 * i, six, sizeof six);
    }
    return scalp;
}

void hair_test_scalp_free(struct hair_test_scalp* scalp)
{
    free(scalp->positions);
    free(scalp->triangles);
    memset(scalp, 0, sizeof *scalp);
}

hair_groom_desc hair_test_groom_desc(const struct hair_test_host* host,
                                     const struct hair_test_strands* strands)
{
    hair_groom_desc desc = hair_groom_desc_default();
    desc.host = &host->host;
    desc.positions = strands->positions;
    desc.strand_vertices = strands->vertices;
    desc.strand_count = strands->count;
    desc.strand_groups = strands->groups;
    desc.strand_attributes = strands->attributes;
    desc.strand_attribute_count = strands->attribute_count;
    if (strands->scalp) hair_test_set_scalp(&desc, strands->scalp);
    return desc;
}

void hair_test_set_scalp(hair_groom_desc* desc, const struct hair_test_scalp* scalp)
{
    desc->strand_set = HAIR_STRAND_SET_GUIDES;
    desc->scalp_positions = scalp->positions;
    desc->scalp_triangles = scalp->triangles;
    desc->scalp_vertex_count = scalp->vertex_count;
    desc->scalp_triangle_count = scalp->triangle_count;
}

static struct hair_guide_spline_point guide_at(const struct hair_groom* groom, uint32_t guide, float u)
{
    struct hair_guide_spline spline;
    hair_guide_spline_fit(groom, guide, &spline);
    return hair_guide_spline_at(&spline, u);
}

hair_groom* hair_test_groom_of(const hair_groom_desc* desc)
{
    hair_groom* groom = NULL;
    assert_int_equal(hair_groom_create(desc, &groom), HAIR_OK);
    return groom;
}

void hair_test_refuse_groom(struct hair_test_host* test, const hair_groom_desc* desc, const char* words)
{
    hair_groom* groom = NULL;
    assert_int_equal(hair_groom_create(desc, &groom), HAIR_ERROR_ARGUMENT);
    assert_null(groom);
    assert_int_equal(test->errors, 1);
    if (!strstr(test->sentence, words)) fail_msg("\"%s\" does not say \"%s\"", test->sentence, words);
    test->errors = 0;
}

static float unpack(uint32_t bits)
{
    return (float)(int16_t)(bits & 0xffffu) / 32767;
}

static hair_vec3 shape_vertex(const struct hair_groom* groom, const struct hair_follower* follower,
                              uint32_t k)
{
    const uint32_t* shapes = (const uint32_t*)(groom->followers + groom->info.follower_count);
    const uint32_t* own =
        shapes + (size_t)4 * HAIR_SHAPE_TEXELS(groom->shape_vertices) * (size_t)follower->offset[3].w + 2 * k;
    return hair_scale(hair_v3(unpack(own[0]), unpack(own[0] >> 16), unpack(own[1])), follower->offset[2].w);
}

hair_vec3 hair_test_own(const struct hair_groom* groom, const struct hair_follower* follower, float t)
{
    struct hair_guide_spline_point root = guide_at(groom, follower->guide0, 0);
    float along = t * (float)(groom->shape_vertices - 1);
    uint32_t k = (uint32_t)along < groom->shape_vertices - 2 ? (uint32_t)along : groom->shape_vertices - 2;
    hair_vec3 p[4];
    for (uint32_t i = 0; i < 4; ++i) p[i] = shape_vertex(groom, follower, k + i);
    // The algorithm of Barry and Goldman 1988 for Catmull-Rom splines.
    float x = along - (float)k;
    hair_vec3 a = hair_lerp(p[0], p[1], x + 1), b = hair_lerp(p[1], p[2], x),
              c = hair_lerp(p[2], p[3], x - 1);
    hair_vec3 d = hair_lerp(a, b, (x + 1) / 2), e = hair_lerp(b, c, x / 2);
    hair_vec3 at = hair_add(hair_test_xyz(follower->offset[0]), hair_lerp(d, e, x));
    return hair_add(root.position, hair_rotate(root.frame, at));
}

hair_vec3 hair_test_single(const struct hair_groom* groom, const struct hair_follower* follower, float t)
{
    if (follower->multi < 0) return hair_test_own(groom, follower, t);
    struct hair_guide_spline_point guide = guide_at(groom, follower->guide0, t * follower->length_ratio);
    hair_vec3 p[4];
    for (int i = 0; i < 4; ++i) p[i] = hair_test_xyz(follower->offset[i]);
    for (int n = 3; n > 0; --n) // De Casteljau's algorithm.
        for (int i = 0; i < n; ++i) p[i] = hair_lerp(p[i], p[i + 1], t);
    return hair_add(guide.position, hair_rotate(guide.frame, p[0]));
}

hair_vec3 hair_test_multi(const struct hair_groom* groom, const struct hair_follower* follower, float t)
{
    float u = t * follower->length_ratio;
    struct hair_guide_spline_point g0 = guide_at(groom, follower->guide0, u);
    struct hair_guide_spline_point g1 = guide_at(groom, follower->guide1, u);
    struct hair_guide_spline_point g2 = guide_at(groom, follower->guide2, u);
    float w0 = 1 - follower->weight1 - follower->weight2;
    hair_vec3 own = {follower->offset[1].w, follower->offset[2].w, follower->offset[3].w};
    hair_vec3 blended =
        hair_add(hair_scale(g1.position, follower->weight1), hair_scale(g2.position, follower->weight2));
    return hair_add(hair_add(hair_scale(g0.position, w0), blended), hair_rotate(g0.frame, own));
}
