// attribute_look_test.c - curls, frizz, locks, highlights, radii and colours that differ by
// attributes of strands and by maps, measured in metres, turns per metre, radians and pixels.
#include "tests/support/arcs.h"
#include "tests/support/beams.h"
#include "tests/support/looks.h"
#include "tests/support/passes.h"
#include "tests/support/render_paths.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tests/support/grooms.h"

#define STRANDS 40
#define SEGMENTS 40u
#define EACH (SEGMENTS + 1)
#define CELLS 4
#define SIDE 240
#define PI 3.14159265358979

// Straight strands of half a metre on a scalp of 1 m, with a factor of each strand and a map that
// grows by 0.5 along x.
struct rows {
    struct hair_test_scene scene;
    float of_strands[STRANDS]; // Factors of the first attribute.
    float others[STRANDS]; // Factors of all others.
    float map[(CELLS + 1) * (CELLS + 1)];
    float x[STRANDS]; // Root of each strand, m.
};

static hair_look plain_look(void)
{
    hair_look look = hair_look_default();
    look.strand.segments = SEGMENTS;
    look.strays.tip_fraction = look.strays.fraction = 0;
    look.clump.interpolation = HAIR_INTERPOLATION_SINGLE;
    return look;
}

// Start with attributes of `count` kinds. Followers are the strands if
// `followers` is 0.
static void start(struct hair_test* test, const hair_strand_attribute_kind* kinds, uint32_t count,
                  uint32_t followers, struct rows* out)
{
    const hair_look look = plain_look();
    struct hair_test_strands strands = hair_test_strands_make(STRANDS, 8);
    struct hair_test_scalp scalp = hair_test_scalp_make(CELLS, 1);
    hair_strand_attribute attributes[8];
    out->scene = hair_test_scene_make(test, NULL);
    for (uint32_t i = 0; i < STRANDS; ++i) {
        uint32_t random = hair_hash(i);
        out->x[i] = hair_random(&random);
        // Half of the guides lean, so that locks are not parallel to guides.
        hair_vec3 way = hair_v3(i % 2 ? 0.3f : 0, 1, 0);
        hair_test_add_straight(&strands, 8, hair_v3(out->x[i], 0, hair_random(&random)),
                               followers ? way : hair_v3(0, 1, 0), 0.5f);
    }
    for (uint32_t i = 0; i < sizeof out->map / sizeof *out->map; ++i)
        out->map[i] = 0.5f + 0.5f * scalp.positions[3 * (size_t)i];
    for (uint32_t i = 0; i < count; ++i) {
        attributes[i] = hair_strand_attribute_default();
        attributes[i].kind = kinds[i];
        attributes[i].strand_values = i ? out->others : out->of_strands;
        attributes[i].map.source = HAIR_MAP_SOURCE_VERTICES;
        attributes[i].map.values = out->map;
    }
    strands.scalp = &scalp, strands.attributes = attributes, strands.attribute_count = count;
    hair_groom_desc desc = hair_test_groom_desc(&test->host, &strands);
    desc.follower_count = followers;
    out->scene.groom = hair_test_groom_of(&desc);
    hair_desc of = hair_desc_default();
    of.look = &look;
    hair_test_ok(test, hair_create(test->context, out->scene.groom, &of, &out->scene.hair));
    hair_test_scalp_free(&scalp);
    hair_test_strands_free(&strands);
}

// Return the expected factor of a follower that is a strand.
static double factor_of(const struct rows* rows, const float* values, uint32_t follower)
{
    uint32_t strand = rows->scene.groom->followers[follower].guide0;
    return (double)values[strand] * (0.5 + 0.5 * (double)rows->x[strand]);
}

// Measure the root mean square distance from the plain strand, m, and the turns around it, 1/m.
static void measure(const float* plain, const float* moved, double* rms, double* turns)
{
    double square = 0, angle = 0, along = 0;
    for (size_t k = 0; k < SEGMENTS; ++k) {
        hair_vec3 a = hair_sub(hair_load3(moved + 3 * k), hair_load3(plain + 3 * k));
        hair_vec3 b = hair_sub(hair_load3(moved + 3 * k + 3), hair_load3(plain + 3 * k + 3));
        hair_vec3 axis = hair_sub(hair_load3(plain + 3 * k + 3), hair_load3(plain + 3 * k));
        double step = (double)hair_length(axis);
        square += (double)hair_dot(a, a) / SEGMENTS;
        angle += fabs(atan2((double)hair_dot(hair_cross(a, b), axis) / step, (double)hair_dot(a, b)));
        along += step;
    }
    *rms = sqrt(square);
    *turns = angle / (2 * PI * along);
}

static void curls_have_the_radius_and_frequency_of_their_strand(void** state)
{
    static const hair_strand_attribute_kind kinds[2] = {HAIR_STRAND_ATTRIBUTE_CURL_RADIUS,
                                                        HAIR_STRAND_ATTRIBUTE_CURL_FREQUENCY};
    struct rows rows;
    for (int i = 0; i < STRANDS; ++i) {
        rows.of_strands[i] = 0.5f + 2.5f * (float)i / STRANDS;
        rows.others[i] = 3 - rows.of_strands[i];
    }
    start(*state, kinds, 2, 0, &rows);
    hair_look look = plain_look();
    float* plain = hair_test_read_look(&rows.scene, &look);
    look.curl.radius = 0.004f, look.curl.wavelength = 0.125f, look.curl.spread = 0;
    look.curl.profile = hair_curve_line(1, 1);
    float* curled = hair_test_read_look(&rows.scene, &look);
    double off[2] = {0}, min = 9, max = 0;
    for (uint32_t i = 0; i < STRANDS; ++i) {
        double rms, turns, radius = factor_of(&rows, rows.of_strands, i);
        measure(plain + 3 * EACH * i, curled + 3 * EACH * i, &rms, &turns);
        off[0] = fmax(off[0], fabs(rms / 0.004 / radius - 1));
        off[1] = fmax(off[1], fabs(turns / 8 / factor_of(&rows, rows.others, i) - 1));
        min = fmin(min, radius), max = fmax(max, radius);
    }
    printf("factors from %.2f to %.2f: %.1e off in metres, %.1e in turns\n", min, max, off[0], off[1]);
    assert_true(off[0] < 2e-3 && off[1] < 2e-3 && min < 0.6 && max > 2);
    free(plain), free(curled);
    hair_test_scene_free(&rows.scene);
}

static void frizz_moves_strands_by_the_factor_of_their_strand(void** state)
{
    static const hair_strand_attribute_kind kind = HAIR_STRAND_ATTRIBUTE_FRIZZ;
    struct rows rows, usual;
    for (int i = 0; i < STRANDS; ++i) rows.of_strands[i] = i % 4 == 0 ? 0 : 0.1f * (float)i;
    start(*state, &kind, 1, 0, &rows);
    start(*state, NULL, 0, 0, &usual);
    hair_look look = plain_look();
    float* plain = hair_test_read_look(&rows.scene, &look);
    look.strays.frizz = hair_curve_line(0.002f, 0.002f), look.strays.frizz_wavelength = 0.1f;
    float *moved = hair_test_read_look(&rows.scene, &look), *once = hair_test_read_look(&usual.scene, &look);
    double off = 0, max = 0;
    for (uint32_t i = 0; i < STRANDS; ++i)
        for (uint32_t k = 3 * EACH * i; k < 3 * EACH * (i + 1); ++k) {
            double wanted = factor_of(&rows, rows.of_strands, i) * ((double)once[k] - (double)plain[k]);
            off = fmax(off, fabs((double)moved[k] - (double)plain[k] - wanted));
            max = fmax(max, fabs(wanted));
        }
    printf("%.2f mm at most, %.4f mm off\n", 1e3 * max, 1e3 * off);
    assert_true(max > 2e-3 && off < 5e-6);
    free(plain), free(moved), free(once);
    hair_test_scene_free(&rows.scene);
    hair_test_scene_free(&usual.scene);
}

// Locks blend linearly, so a follower lies between itself without a lock and itself in a full one.
static void locks_have_the_weight_of_the_map_and_the_strands(void** state)
{
    static const hair_strand_attribute_kind kind = HAIR_STRAND_ATTRIBUTE_CLUMP;
    struct rows rows, usual;
    for (int i = 0; i < STRANDS; ++i) rows.of_strands[i] = i % 2 ? 1 : 0.5f;
    start(*state, &kind, 1, 500, &rows);
    start(*state, NULL, 0, 500, &usual);
    hair_look look = plain_look();
    look.clump.interpolation = HAIR_INTERPOLATION_MIXED;
    look.clump.weight = hair_curve_line(0, 0);
    float* open = hair_test_read_look(&usual.scene, &look);
    look.clump.weight = hair_curve_line(0, 1);
    float *locked = hair_test_read_look(&usual.scene, &look),
          *found = hair_test_read_look(&rows.scene, &look);
    double off = 0, max = 0;
    for (uint32_t i = 0; i < 500; ++i) {
        const struct hair_follower* f = &rows.scene.groom->followers[i];
        double factor = (1 - (double)f->weight1 - (double)f->weight2) * (double)rows.of_strands[f->guide0] +
                        (double)f->weight1 * (double)rows.of_strands[f->guide1] +
                        (double)f->weight2 * (double)rows.of_strands[f->guide2];
        factor *= 0.5 + 0.5 * (double)open[3 * EACH * i];
        for (uint32_t k = 3 * EACH * i; k < 3 * EACH * (i + 1); ++k) {
            double whole = (double)locked[k] - (double)open[k];
            off = fmax(off, fabs((double)found[k] - (double)open[k] - factor * whole));
            max = fmax(max, fabs(whole));
        }
    }
    printf("%.1f mm at most, %.4f mm off\n", 1e3 * max, 1e3 * off);
    assert_true(max > 0.02 && off < 5e-4 * max);
    free(open), free(locked), free(found);
    hair_test_scene_free(&rows.scene);
    hair_test_scene_free(&usual.scene);
}

static void highlight_is_as_wide_as_the_roughness_of_its_strand(void** state)
{
    static const float of_strands[2] = {0.5f, 1};
    hair_strand_attribute roughness = hair_strand_attribute_default();
    roughness.kind = HAIR_STRAND_ATTRIBUTE_ROUGHNESS, roughness.strand_values = of_strands;
    for (int model = 0; model < 2; ++model) {
        struct hair_test_arcs usual, arcs;
        hair_test_arcs_start(*state, model == 1, NULL, &usual);
        hair_test_arcs_start(*state, model == 1, &roughness, &arcs);
        for (int path = 0; path < HAIR_TEST_PATHS; ++path) {
            double own[2], width[2];
            hair_test_arcs_measure(&usual, hair_test_paths[path], own);
            hair_test_arcs_measure(&arcs, hair_test_paths[path], width);
            printf("model %d, path %d: %.4f and %.4f rad, not %.4f\n", model, path, width[0], width[1],
                   own[0]);
            hair_test_near("width", 0, width[0], own[0] / 2, 0.05 * own[0]);
            hair_test_near("width", 1, width[1], own[1], 0.005 * own[1]);
        }
        hair_test_arcs_free(&arcs);
        hair_test_arcs_free(&usual);
    }
}

static void radius_is_a_factor_in_pixels(void** state)
{
    static const float of_strands[3] = {1, 3, 0.5f}, radii[3] = {1, 1, 1};
    float of_vertices[25];
    for (int i = 0; i < 25; ++i) of_vertices[i] = 0.5f;
    static uint32_t ids[4 * SIDE * SIDE];
    struct hair_test_scene scene = hair_test_scene_make(*state, NULL);
    struct hair_test_strands strands = hair_test_strands_make(3, 4);
    struct hair_test_scalp scalp = hair_test_scalp_make(4, 1);
    hair_strand_attribute radius = hair_strand_attribute_default();
    hair_look look = plain_look();
    for (int g = 0; g < 3; ++g)
        hair_test_add_straight(&strands, 4, hair_v3(0.06f * (float)(g - 1), 0.1f, 0), hair_v3(0, -1, 0),
                               0.2f);
    radius.kind = HAIR_STRAND_ATTRIBUTE_RADIUS, radius.strand_values = of_strands;
    radius.map.source = HAIR_MAP_SOURCE_VERTICES, radius.map.values = of_vertices;
    strands.attributes = &radius, strands.attribute_count = 1, strands.scalp = &scalp;
    hair_groom_desc groom = hair_test_groom_desc(&scene.test->host, &strands);
    groom.strand_radii = radii, groom.strand_set = HAIR_STRAND_SET_FULL, groom.guide_count = 3;
    scene.groom = hair_test_groom_of(&groom);
    hair_desc desc = hair_desc_default();
    look.strand.radius = 1e-2f, look.strand.taper = hair_curve_line(1, 1), desc.look = &look;
    hair_test_ok(scene.test, hair_create(scene.test->context, scene.groom, &desc, &scene.hair));
    hair_view view = hair_test_view_by(HAIR_RENDER_PATH_AUTO);
    hair_test_set_orthographic(&view, 10, 3, 0);
    hair_test_draw_ids(scene.test, scene.hair, &view, SIDE, ids);
    int width[3] = {0}, own = (int)(2 * 5e-3 * 10 * SIDE / 2 + 0.5);
    for (int x = 0; x < SIDE; ++x)
        if (ids[4 * (SIDE / 2 * SIDE + x)]) ++width[3 * x / SIDE];
    printf("%d, %d and %d pixels\n", width[0], width[1], width[2]);
    assert_in_range(width[0], own - 1, own + 1);
    assert_in_range(width[1], 3 * own - 1, 3 * own + 1);
    assert_in_range(width[2], own / 2 - 1, own / 2 + 1);
    hair_test_scalp_free(&scalp);
    hair_test_strands_free(&strands);
    hair_test_scene_free(&scene);
}

// Make three white strands of 3 cm, which are rooted at 1/6, 1/2 and 5/6 of the width of a scalp.
static struct hair_test_scene make_white(struct hair_test* test)
{
    static float uvs[50];
    struct hair_test_scene scene = hair_test_scene_make(test, NULL);
    struct hair_test_strands strands = hair_test_strands_make(3, 4);
    struct hair_test_scalp scalp = hair_test_scalp_make(4, 0.3f);
    hair_look look = plain_look();
    hair_desc desc = hair_desc_default();
    for (int g = 0; g < 3; ++g)
        hair_test_add_straight(&strands, 4, hair_v3(0.1f * (float)(g - 1), 0.015f, 0), hair_v3(0, -1, 0),
                               0.03f);
    for (uint32_t i = 0; i < 25; ++i) {
        uvs[2 * i] = scalp.positions[3 * i] / 0.3f;
        scalp.positions[3 * i] -= 0.15f, scalp.positions[3 * i + 2] -= 0.15f;
    }
    strands.scalp = &scalp;
    hair_groom_desc groom = hair_test_groom_desc(&test->host, &strands);
    groom.strand_set = HAIR_STRAND_SET_FULL, groom.scalp_uvs = uvs, groom.guide_count = 3;
    scene.groom = hair_test_groom_of(&groom);
    look.strand.radius = 5e-3f, look.strand.taper = hair_curve_line(1, 1), desc.look = &look;
    look.shading.model = HAIR_SHADING_LINES, look.color.spread = 0;
    look.shading.specular[0] = look.shading.specular[1] = 0;
    for (int c = 0; c < 3; ++c) look.color.root[c] = look.color.tip[c] = 1;
    hair_test_ok(test, hair_create(test->context, scene.groom, &desc, &scene.hair));
    hair_test_scalp_free(&scalp);
    hair_test_strands_free(&strands);
    return scene;
}

static void strands_have_the_colour_of_the_map_at_their_root(void** state)
{
    static const float colors[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    static float white[4 * SIDE * SIDE], pixels[4 * SIDE * SIDE];
    struct hair_test_scene scene = make_white(*state);
    GLuint map;
    glCreateTextures(GL_TEXTURE_2D, 1, &map);
    glTextureStorage2D(map, 1, GL_RGB32F, 3, 1);
    glTextureSubImage2D(map, 0, 0, 0, 3, 1, GL_RGB, GL_FLOAT, colors);
    glTextureParameteri(map, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    for (int path = 0; path < HAIR_TEST_PATHS; ++path) {
        hair_view view = hair_test_view_by(hair_test_paths[path]);
        hair_test_set_orthographic(&view, 6, 3, 0);
        hair_test_draw(&scene, &view, SIDE, SIDE, 0, white, NULL);
        view.color_texture = map;
        hair_test_draw(&scene, &view, SIDE, SIDE, 0, pixels, NULL);
        double off = 0;
        int count[3] = {0};
        for (int i = 0; i < SIDE * SIDE; ++i) {
            const float *was = white + 4 * (size_t)i, *now = pixels + 4 * (size_t)i;
            int third = 3 * (i % SIDE) / SIDE;
            count[third] += was[3] > 0.9f && was[0] > 0.1f;
            for (int c = 0; c < 3; ++c)
                off = fmax(off, fabs((double)now[c] - (double)(was[c] * colors[3 * third + c])));
        }
        printf("path %d: %d, %d and %d pixels are %.1e off\n", path, count[0], count[1], count[2], off);
        assert_true(count[0] > 100 && count[1] > 100 && count[2] > 100 && off < 1e-6);
    }
    glDeleteTextures(1, &map);
    hair_test_scene_free(&scene);
}

// Check that kinds that shaders do not read take no memory and no program, and that the others take
// 2 bytes each.
static void factors_cost_two_bytes_of_each_follower(void** state)
{
    static const hair_strand_attribute_kind used[3] = {HAIR_STRAND_ATTRIBUTE_FRIZZ,
                                                       HAIR_STRAND_ATTRIBUTE_CLUMP,
                                                       HAIR_STRAND_ATTRIBUTE_CURL_RADIUS},
                                            other[2] = {HAIR_STRAND_ATTRIBUTE_RADIUS,
                                                        HAIR_STRAND_ATTRIBUTE_STIFFNESS};
    struct hair_test* test = *state;
    struct rows rows, without, with;
    uint64_t bytes[4] = {hair_test_gpu_bytes(test)};
    const uint32_t runs = hair_test_runs_of(&test->context->gl, "_strand_factors");
    hair_look look = plain_look();
    look.clump.interpolation = HAIR_INTERPOLATION_MIXED;
    look.curl.radius = 0.004f, look.strays.frizz = hair_curve_line(0, 0.002f);
    for (int i = 0; i < STRANDS; ++i)
        rows.of_strands[i] = rows.others[i] = with.of_strands[i] = with.others[i] = 1;
    start(test, NULL, 0, 300, &without);
    float* plain = hair_test_read_look(&without.scene, &look);
    bytes[1] = hair_test_gpu_bytes(test);
    start(test, other, 2, 300, &rows);
    float* same = hair_test_read_look(&rows.scene, &look);
    bytes[2] = hair_test_gpu_bytes(test);
    assert_memory_equal(same, plain, 3 * sizeof *plain * 300 * EACH);
    assert_int_equal(hair_test_runs_of(&test->context->gl, "_strand_factors"), runs);
    assert_int_equal(bytes[2] - bytes[1], bytes[1] - bytes[0]);
    start(test, used, 3, 300, &with);
    free(same);
    same = hair_test_read_look(&with.scene, &look);
    bytes[3] = hair_test_gpu_bytes(test);
    assert_true(memcmp(same, plain, 3 * sizeof *plain * 300 * EACH) != 0);
    assert_true(hair_test_runs_of(&test->context->gl, "_strand_factors") > runs);
    assert_int_equal(bytes[3] - bytes[2], bytes[1] - bytes[0] + 3 * 2 * 300);
    free(plain), free(same);
    hair_test_scene_free(&rows.scene);
    hair_test_scene_free(&without.scene);
    hair_test_scene_free(&with.scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        HAIR_TEST(curls_have_the_radius_and_frequency_of_their_strand),
        HAIR_TEST(frizz_moves_strands_by_the_factor_of_their_strand),
        HAIR_TEST(locks_have_the_weight_of_the_map_and_the_strands),
        HAIR_TEST(highlight_is_as_wide_as_the_roughness_of_its_strand),
        HAIR_TEST(radius_is_a_factor_in_pixels),
        HAIR_TEST(strands_have_the_colour_of_the_map_at_their_root),
        HAIR_TEST(factors_cost_two_bytes_of_each_follower),
    };
    if (hair_test_skips()) return 0;
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
