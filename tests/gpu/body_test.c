// body_test.c - opaque geometry blocks the light on its way to hair. Tests cover both self-shadow
// methods, all shadings, every light, and maps with and without perspective. Programs without
// opaque geometry have no code for it.
#include "tests/support/scene.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define SIZE 256
#define TEXELS 64
#define HALF 0.3f // Half of the side of the visible square, in metres.
#define PLATE 0.1f // Height z of a plate across the light, in metres.
#define BIAS 0.004f

struct fixture {
    struct hair_test_scene scene;
    hair_shader* shader;
    hair_light light[4];
    GLuint map[4], open;
    float pixels[4 * SIZE * SIZE];
};

static const char through_glsl[] =
    "vec4 hair_shade(hair_fragment f) { return vec4(hair_light_through(f, 0u), f.position + 1.0); }\n";
static const char lights_glsl[] =
    "vec4 hair_shade(hair_fragment f)\n"
    "{\n"
    "    vec4 sum = vec4(0.0);\n"
    "    for (uint i = 0u; i < hair_lights(); ++i) sum[i] = hair_light_through(f, i);\n"
    "    return sum;\n"
    "}\n";

static GLuint make_map(float depth)
{
    GLuint map;
    glCreateTextures(GL_TEXTURE_2D, 1, &map);
    glTextureStorage2D(map, 1, GL_DEPTH_COMPONENT32F, TEXELS, TEXELS);
    glClearTexImage(map, 0, GL_DEPTH_COMPONENT, GL_FLOAT, &depth);
    return map;
}

// Make a matrix that looks straight down -z at a square of side 2 HALF. The depth is (1 - z) / 2
// for the eye and for the light.
static void look_down(float matrix[16])
{
    memset(matrix, 0, 16 * sizeof *matrix);
    matrix[0] = matrix[5] = 1 / HALF;
    matrix[10] = -1;
    matrix[15] = 1;
}

static struct fixture* start(void** state)
{
    struct fixture* f = calloc(1, sizeof *f);
    struct hair_test_handmade wanted = hair_test_handmade_default();
    hair_look look = hair_look_default();
    wanted.followers = 160;
    look.strand.segments = 8, look.strand.radius = 0.002f;
    f->scene = hair_test_scene_of(*state, &wanted, &look);
    hair_test_frame_make(&f->scene.frame, SIZE, SIZE, GL_RGBA32F, 0);
    look_down(f->scene.view.projection);
    f->open = make_map(1);
    for (int i = 0; i < 4; ++i) {
        f->map[i] = make_map(1);
        f->scene.view.ambient[i % 3] = 0;
        f->light[i] = hair_light_default();
        f->light[i].direction[0] = f->light[i].direction[1] = 0, f->light[i].direction[2] = 1;
        f->light[i].opaque_bias = BIAS;
        look_down(f->light[i].shadow_matrix);
    }
    f->light[0].hair_shadow_map = f->open;
    return f;
}

static void finish(struct fixture* f)
{
    hair_shader_destroy(f->shader);
    glDeleteTextures(4, f->map);
    glDeleteTextures(1, &f->open);
    hair_test_scene_free(&f->scene);
    free(f);
}

static void shade_by(struct fixture* f, const char* glsl)
{
    hair_shader_desc desc = hair_shader_desc_default();
    desc.glsl = glsl;
    desc.at = HAIR_SHADE_PIXELS;
    hair_test_ok(f->scene.test, hair_shader_create(f->scene.test->context, &desc, &f->shader));
    f->scene.view.shader = f->shader;
}

static void set_look(struct fixture* f, hair_self_shadow shadow, hair_shading shading)
{
    hair_look look = f->scene.hair->geometry.look;
    look.self_shadow.method = shadow, look.shading.model = shading;
    hair_test_ok(f->scene.test, hair_set_look(f->scene.hair, &look));
}

static void draw(struct fixture* f, uint32_t lights)
{
    f->scene.view.lights = f->light;
    f->scene.view.light_count = lights;
    hair_test_draw_in(&f->scene.frame, f->scene.test, f->scene.hair, &f->scene.view, f->pixels);
}

// Fill the columns of texels in [from, to).
static void put_plate(GLuint map, int from, int to, float depth)
{
    glClearTexSubImage(map, 0, from, 0, 0, to - from, TEXELS, 1, GL_DEPTH_COMPONENT, GL_FLOAT, &depth);
}

static double across(int pixel)
{
    return ((pixel % SIZE + 0.5) / SIZE * 2 - 1) * (double)HALF;
}

// Check that hair behind the plate is black, and that hair beside it is as bright as without the
// plate. Pixels within 6 cm of the edge are ignored, because segments interpolate light between
// vertices.
static void hair_behind_an_opaque_body_is_black_by_every_method(void** state)
{
    static float open[4 * SIZE * SIZE];
    for (int i = 0; i < 4; ++i) {
        struct fixture* f = start(state);
        uint32_t dark = 0, lit = 0;
        set_look(f, i % 2 ? HAIR_SELF_SHADOW_STRANDS : HAIR_SELF_SHADOW_DEPTH,
                 i / 2 ? HAIR_SHADING_LINES : HAIR_SHADING_FIBRES);
        draw(f, 1);
        memcpy(open, f->pixels, sizeof open);
        put_plate(f->map[0], 0, TEXELS / 2, 0.25f);
        f->light[0].opaque_shadow_map = f->map[0];
        draw(f, 1);
        for (int p = 0; p < SIZE * SIZE; ++p) {
            const float *now = f->pixels + 4 * p, *was = open + 4 * p;
            if (!(was[0] > 0) || fabs(across(p)) < 0.06) continue;
            for (int k = 0; k < 3; ++k)
                hair_test_near(across(p) < 0 ? "behind" : "beside", (size_t)p, (double)now[k],
                               across(p) < 0 ? 0 : (double)was[k], 1e-5 * (1 + (double)was[k]));
            ++*(across(p) < 0 ? &dark : &lit);
        }
        print_message("    %u pixels behind it, %u beside it\n", dark, lit);
        assert_true(dark > 200 && lit > 200);
        finish(f);
    }
}

// Return the fraction of light behind `depth` metres of hair after the first strand, by the default
// absorption and the fit of light/shadow.glsl.
static double through_hair(double depth)
{
    double met = 200 * depth;
    return exp(-met - 0.53 * sqrt(met / (met + 0.2)));
}

// Compare the transmitted light behind a plate in the map of hair with that behind a plate in the
// map of opaque geometry. Each depends on the distance of the strand behind the plate.
static void opaque_shadow_is_full_beyond_its_bias_in_metres(void** state)
{
    for (int shadow = 0; shadow < 2; ++shadow) {
        struct fixture* f = start(state);
        double sum[2] = {0}, max = 0, min = 1;
        uint32_t count[2] = {0};
        shade_by(f, through_glsl);
        set_look(f, (hair_self_shadow)shadow, HAIR_SHADING_FIBRES);
        put_plate(f->map[0], 0, TEXELS, (1 - PLATE) / 2);
        for (int body = 0; body < 2; ++body) {
            f->light[0].hair_shadow_map = body ? f->open : f->map[0];
            f->light[0].opaque_shadow_map = body ? f->map[0] : 0;
            draw(f, 1);
            for (int p = 0; p < SIZE * SIZE; ++p) {
                const float* pixel = f->pixels + 4 * p;
                double behind = (double)PLATE - ((double)pixel[3] - 1), through = (double)pixel[0];
                if (pixel[3] <= 0) continue;
                if (behind > 0.004 + 1e-4 && behind < 0.006) sum[body] += through, ++count[body];
                if (body && behind > (double)BIAS + 1e-4) max = fmax(max, through);
                if (body && behind < (double)BIAS - 1e-4 && behind > 0) min = fmin(min, through);
            }
        }
        print_message("    5 mm behind a plate: %.4f by the map of hair, %.4f by that of bodies\n",
                      sum[0] / count[0], sum[1] / count[1]);
        assert_true(count[0] > 20 && count[1] > 20);
        hair_test_near("beyond the bias", 0, max, 0, 0);
        assert_true(min > 0.5); // Within the bias, all light that hair lets through remains.
        if (shadow == HAIR_SELF_SHADOW_DEPTH)
            hair_test_near("as hair", 0, sum[0] / count[0], through_hair(0.005), 0.04);
        finish(f);
    }
}

static void each_light_uses_its_own_opaque_shadow_map(void** state)
{
    struct fixture* f = start(state);
    uint32_t held[4] = {0};
    shade_by(f, lights_glsl);
    f->light[0].hair_shadow_map = 0; // A light may have either map, both, or none.
    f->light[2].hair_shadow_map = f->open;
    for (int i = 0; i < 4; ++i) {
        f->light[i].opaque_shadow_map = i == 1 ? 0 : f->map[i];
        put_plate(f->map[i], 16 * i, 16 * (i + 1), 0);
    }
    draw(f, 4);
    for (int p = 0; p < SIZE * SIZE; ++p) {
        double at = (across(p) / (double)HALF + 1) * TEXELS / 2, edge = fabs(remainder(at, 16));
        int column = (int)(at / 16);
        // Pixels within 1.6 texels of the edge are ignored, because B-splines reach 1.5 texels.
        if (f->pixels[4 * p + 1] <= 0 || edge < 1.6) continue;
        ++held[column];
        for (int i = 0; i < 4; ++i)
            hair_test_near("light", (size_t)(4 * p + i), (double)f->pixels[4 * p + i],
                           i == column && i != 1 ? 0 : 1, 1e-5);
    }
    print_message("    %u, %u, %u and %u pixels\n", held[0], held[1], held[2], held[3]);
    assert_true(held[0] > 20 && held[1] > 20 && held[2] > 20 && held[3] > 20);
    finish(f);
}

// Set a lamp 1 m before the head's origin. The frustum is 0.4 of the distance to each side, from
// 0.2 m to 3 m.
static void look_from_lamp(hair_light* light)
{
    float *m = light->shadow_matrix, near = 0.2f, far = 3;
    light->kind = HAIR_LIGHT_SPOT;
    light->position[2] = 1;
    memset(m, 0, sizeof light->shadow_matrix);
    m[0] = m[5] = 1 / 0.4f;
    m[10] = -(far + near) / (far - near);
    m[11] = -1;
    m[14] = m[10] * -1 - 2 * far * near / (far - near);
    m[15] = 1;
}

// Check a plate of opaque geometry on one side, and a plate in the map of hair. The depths of both
// give metres along each ray.
static void opaque_shadow_maps_may_be_in_perspective(void** state)
{
    for (int shadow = 0; shadow < 2; ++shadow) {
        struct fixture* f = start(state);
        uint32_t dark = 0, lit = 0;
        shade_by(f, through_glsl);
        set_look(f, (hair_self_shadow)shadow, HAIR_SHADING_FIBRES);
        look_from_lamp(&f->light[0]);
        const float* m = f->light[0].shadow_matrix;
        float clip = m[10] * PLATE + m[14], depth = 0.5f + 0.5f * clip / (1 - PLATE);
        put_plate(f->map[0], 0, 30, depth);
        f->light[0].opaque_shadow_map = f->map[0];
        draw(f, 1);
        for (int p = 0; p < SIZE * SIZE; ++p) {
            const float* pixel = f->pixels + 4 * p;
            double x = (double)pixel[1] - 1, z = (double)pixel[3] - 1, reach = 1 - z;
            double texel = (x / reach / 0.4 + 1) * TEXELS / 2;
            double behind = ((double)PLATE - z) * hypot(hypot(x, (double)pixel[2] - 1), reach) / reach;
            if (pixel[3] <= 0 || fabs(texel - 30) < 1.6 || fabs(behind - (double)BIAS) < 2e-4) continue;
            if (texel < 30 && behind > (double)BIAS) {
                hair_test_near("behind", (size_t)p, (double)pixel[0], 0, 0);
                ++dark;
            } else {
                assert_true(shadow == HAIR_SELF_SHADOW_STRANDS ? pixel[0] > 0.2f : pixel[0] > 0.9999f);
                ++lit;
            }
        }
        print_message("    %u pixels behind it, %u beside and before it\n", dark, lit);
        assert_true(dark > 100 && lit > 100);
        f->light[0].opaque_shadow_map = 0, f->light[0].hair_shadow_map = f->map[0];
        put_plate(f->map[0], 0, TEXELS, depth);
        draw(f, 1);
        for (int p = 0; p < SIZE * SIZE && shadow == HAIR_SELF_SHADOW_DEPTH; ++p) {
            const float* pixel = f->pixels + 4 * p;
            double x = (double)pixel[1] - 1, z = (double)pixel[3] - 1, reach = 1 - z;
            double behind = ((double)PLATE - z) * hypot(hypot(x, (double)pixel[2] - 1), reach) / reach;
            if (pixel[3] <= 0 || behind < 0) continue;
            hair_test_near("metres", (size_t)p, (double)pixel[0], through_hair(behind), 0.003);
        }
        finish(f);
    }
}

static uint32_t count_passes(const struct fixture* f, const char* words)
{
    hair_timing timing[128];
    uint32_t count = hair_get_timings(f->scene.test->context, timing, 128), found = 0;
    for (uint32_t i = 0; i < count && i < 128; ++i) found += strstr(timing[i].pass, words) != NULL;
    return found;
}

static void programs_have_no_opaque_shadows_without_a_map(void** state)
{
    struct fixture* f = start(state);
    hair_memory before = hair_memory_default(), after = hair_memory_default();
    uint32_t known = count_passes(f, "opaque_shadows");
    f->scene.view.render_path = HAIR_RENDER_PATH_CACHED;
    draw(f, 1);
    hair_test_ok(f->scene.test, hair_get_memory(f->scene.test->context, &before));
    assert_int_equal(count_passes(f, "opaque_shadows"), known);
    f->light[0].opaque_shadow_map = f->map[0];
    draw(f, 1);
    assert_int_equal(count_passes(f, "opaque_shadows"), known + 1);
    hair_test_ok(f->scene.test, hair_get_memory(f->scene.test->context, &after));
    assert_int_equal(before.bytes, after.bytes);
    f->scene.view.pass = HAIR_PASS_DEPTH; // This pass has no light.
    draw(f, 1);
    assert_int_equal(count_passes(f, "opaque_shadows"), known + 1);
    finish(f);
}

static void odd_maps_and_matrices_give_finite_colors(void** state)
{
    struct fixture* f = start(state);
    GLuint odd[3];
    const float nan_[4] = {NAN, NAN, NAN, NAN};
    glCreateTextures(GL_TEXTURE_2D, 3, odd);
    glTextureStorage2D(odd[0], 1, GL_R32F, 1, 1);
    glClearTexImage(odd[0], 0, GL_RED, GL_FLOAT, nan_);
    glTextureStorage2D(odd[1], 3, GL_RGBA16F, 5, 3);
    glTextureStorage2D(odd[2], 1, GL_DEPTH24_STENCIL8, 1, 7);
    for (int i = 0; i < 3 * 6; ++i) {
        hair_light* light = &f->light[0];
        light->kind = HAIR_LIGHT_DIRECTIONAL;
        look_down(light->shadow_matrix);
        light->opaque_shadow_map = odd[i % 3];
        light->opaque_bias = i % 2 ? 1.0f : 0.0f;
        switch (i / 3) {
        case 1: light->shadow_matrix[0] = light->shadow_matrix[13] = 3e38f; break;
        case 2: memset(light->shadow_matrix, 0, 15 * sizeof(float)); break;
        case 3: look_from_lamp(light), light->position[2] = 0; break;
        case 4:
            look_from_lamp(light), light->shadow_matrix[14] = -0.4f, light->shadow_matrix[15] = 0;
            break; // Some of the hair is behind the lamp.
        case 5: look_from_lamp(light), light->shadow_matrix[14] = -3e38f; break;
        default: break;
        }
        set_look(f, i % 2 ? HAIR_SELF_SHADOW_STRANDS : HAIR_SELF_SHADOW_DEPTH, HAIR_SHADING_FIBRES);
        draw(f, 1);
        for (int p = 0; p < 4 * SIZE * SIZE; ++p)
            if (!(f->pixels[p] >= 0 && f->pixels[p] <= 65504))
                fail_msg("%d: value %d is %g", i, p, (double)f->pixels[p]);
    }
    glDeleteTextures(3, odd);
    finish(f);
}

static void texture_that_is_no_shadow_map_is_refused(void** state)
{
    struct fixture* f = start(state);
    float* m = f->light[0].shadow_matrix;
    f->scene.view.lights = f->light;
    f->light[0].opaque_shadow_map = 4711;
    hair_test_refused(f->scene.test, hair_draw(f->scene.hair, &f->scene.view), HAIR_ERROR_ARGUMENT,
                      "hair_view.lights[0].opaque_shadow_map is 4711, not a 2D texture");
    f->light[0].opaque_shadow_map = f->map[0];
    f->light[0].opaque_bias = 2;
    hair_test_refused(f->scene.test, hair_draw(f->scene.hair, &f->scene.view), HAIR_ERROR_ARGUMENT,
                      "hair_light.opaque_bias is 2, not in [0, 1]");
    f->light[0].opaque_bias = 0;
    look_from_lamp(&f->light[0]);
    hair_test_ok(f->scene.test, hair_draw(f->scene.hair, &f->scene.view));
    for (int i = 0; i < 3; ++i) {
        float was = m[i == 0 ? 10 : i == 1 ? 2 : 14];
        m[i == 0   ? 10
          : i == 1 ? 2
                   : 14] = i == 0   ? 0.5f
                           : i == 1 ? 0.3f
                                    : 2; // Against the light, oblique, and reversed.
        hair_test_refused(f->scene.test, hair_draw(f->scene.hair, &f->scene.view), HAIR_ERROR_ARGUMENT,
                          "lights[0].shadow_matrix is neither orthographic nor in perspective");
        m[i == 0 ? 10 : i == 1 ? 2 : 14] = was;
    }
    f->light[0].kind = HAIR_LIGHT_DIRECTIONAL;
    hair_test_refused(f->scene.test, hair_draw(f->scene.hair, &f->scene.view), HAIR_ERROR_ARGUMENT,
                      "not orthographic");
    finish(f);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        HAIR_TEST(hair_behind_an_opaque_body_is_black_by_every_method),
        HAIR_TEST(opaque_shadow_is_full_beyond_its_bias_in_metres),
        HAIR_TEST(each_light_uses_its_own_opaque_shadow_map),
        HAIR_TEST(opaque_shadow_maps_may_be_in_perspective),
        HAIR_TEST(programs_have_no_opaque_shadows_without_a_map),
        HAIR_TEST(odd_maps_and_matrices_give_finite_colors),
        HAIR_TEST(texture_that_is_no_shadow_map_is_refused),
    };
    if (hair_test_skips()) return 0;
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
