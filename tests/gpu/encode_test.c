// encode_test.c - hair_view.encode: colours in sRGB are those of a linear picture, encoded, by
// every render path and with a shader of the application.
#include "tests/support/render_paths.h"
#include "tests/support/scene.h"

#include <math.h>
#include <stdio.h>

#define SIDE 64

static float linear[4 * SIDE * SIDE], encoded[4 * SIDE * SIDE];

static double encode(double value)
{
    return value <= 0.0031308 ? 12.92 * value : 1.055 * pow(value, 1 / 2.4) - 0.055;
}

static struct hair_test_scene start(void** state)
{
    hair_look look = hair_look_default();
    look.strand.radius = 0.003f;
    struct hair_test_scene scene = hair_test_scene_of(*state, NULL, &look);
    hair_test_ok(scene.test, hair_step(scene.hair, 1.0f / 60));
    hair_test_set_orthographic(&scene.view, 2, -0.5f, -0.2f);
    return scene;
}

// Draw with both encodings.
static void draw_both(struct hair_test_scene* scene)
{
    scene->view.encode = HAIR_ENCODING_LINEAR;
    hair_test_draw(scene, &scene->view, SIDE, SIDE, 0, linear, NULL);
    scene->view.encode = HAIR_ENCODING_SRGB;
    hair_test_draw(scene, &scene->view, SIDE, SIDE, 0, encoded, NULL);
}

// Check that every pixel of opaque hair is the encoded linear one. Bright and dark ones must occur.
static void check_pixels(const char* name)
{
    uint32_t dark = 0, bright = 0;
    for (int i = 0; i < 4 * SIDE * SIDE; ++i) {
        double value = (double)linear[i];
        hair_test_near(name, (size_t)i, (double)encoded[i], i % 4 == 3 ? value : encode(value),
                       2e-3 * (1 + value));
        dark += i % 4 < 3 && value > 0 && value < 0.02;
        bright += i % 4 < 3 && value > 0.02;
    }
    assert_true(dark > 0 && bright > 100);
}

static void srgb_is_the_encoded_linear_picture_by_every_path(void** state)
{
    struct hair_test_scene scene = start(state);
    for (int i = 0; i < HAIR_TEST_PATHS; ++i) {
        char name[32];
        snprintf(name, sizeof name, "path %d", i);
        scene.view.render_path = hair_test_paths[i];
        draw_both(&scene);
        check_pixels(name);
    }
    hair_test_scene_free(&scene);
}

static void srgb_encodes_colors_of_a_shader(void** state)
{
    struct hair_test_scene scene = start(state);
    hair_shader_desc desc = hair_shader_desc_default();
    desc.glsl = "vec4 hair_shade(hair_fragment f) { return vec4(0.01, f.t, 4.0, 1.0); }\n";
    for (int at = HAIR_SHADE_VERTICES; at <= HAIR_SHADE_PIXELS; ++at) {
        desc.at = (hair_shade_at)at;
        hair_test_ok(scene.test, hair_shader_create(scene.test->context, &desc, &scene.view.shader));
        draw_both(&scene);
        check_pixels("shader");
        hair_shader_destroy(scene.view.shader);
    }
    hair_test_scene_free(&scene);
}

// Alpha is coverage, which no encoding changes. Sums of encoded colours are brighter.
static void coverage_is_the_same_in_both_encodings(void** state)
{
    struct hair_test_scene scene = start(state);
    double sums[2] = {0, 0};
    scene.view.coverage = HAIR_COVERAGE_ALPHA;
    draw_both(&scene);
    for (int i = 0; i < 4 * SIDE * SIDE; ++i)
        if (i % 4 == 3)
            hair_test_near("alpha", (size_t)i, (double)encoded[i], (double)linear[i], 1e-6);
        else
            sums[0] += (double)linear[i], sums[1] += (double)encoded[i];
    assert_true(sums[0] > 1 && sums[1] > 1.2 * sums[0]);
    hair_test_scene_free(&scene);
}

// Depth, indices and motion have no colours to encode.
static void passes_without_colors_are_not_encoded(void** state)
{
    struct hair_test_scene scene = start(state);
    const hair_pass passes[] = {HAIR_PASS_OPACITY, HAIR_PASS_MOTION};
    for (size_t i = 0; i < sizeof passes / sizeof *passes; ++i) {
        scene.view.pass = passes[i];
        draw_both(&scene);
        assert_memory_equal(linear, encoded, sizeof linear);
    }
    hair_test_scene_free(&scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        HAIR_TEST(srgb_is_the_encoded_linear_picture_by_every_path),
        HAIR_TEST(srgb_encodes_colors_of_a_shader),
        HAIR_TEST(coverage_is_the_same_in_both_encodings),
        HAIR_TEST(passes_without_colors_are_not_encoded),
    };
    if (hair_test_skips()) return 0;
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
