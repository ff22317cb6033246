// light_test.c - lights of a view: they add up, weaken with distance, end at their limits, and
// always give finite pixels.
#include "tests/support/scene.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define SIZE 48
#define VALUES (4 * SIZE * SIZE)

struct fixture {
    struct hair_test_scene scene;
    hair_light light[16];
};

static struct fixture start(void** state, hair_shading shading)
{
    struct fixture f;
    hair_look look = hair_look_default();
    look.shading.model = shading, look.strand.segments = 8, look.strand.radius = 0.002f;
    look.shading.roughness[0] = look.shading.roughness[1] = 0.05f; // These are the sharpest lobes.
    f.scene = hair_test_scene_of(*state, NULL, &look);
    hair_test_frame_make(&f.scene.frame, SIZE, SIZE, GL_RGBA32F, 0);
    // The view looks straight down -z at a square of 0.6 m.
    hair_test_set_orthographic(&f.scene.view, 1 / 0.3f, -1, 0);
    for (int i = 0; i < 16; ++i) f.light[i] = hair_light_default();
    for (int i = 0; i < 3; ++i) f.scene.view.ambient[i] = 0;
    return f;
}

static void draw(struct fixture* f, uint32_t lights, float pixels[VALUES])
{
    f->scene.view.lights = f->light;
    f->scene.view.light_count = lights;
    hair_test_draw_in(&f->scene.frame, f->scene.test, f->scene.hair, &f->scene.view, pixels);
}

static double sum_of(const float pixels[VALUES])
{
    double sum = 0;
    for (int i = 0; i < VALUES; ++i) sum += i % 4 < 3 ? (double)pixels[i] : 0;
    return sum;
}

static void hair_without_light_is_black_but_drawn(void** state)
{
    struct fixture f = start(state, HAIR_SHADING_FIBRES);
    static float pixels[VALUES];
    draw(&f, 0, pixels);
    double covered = SIZE * SIZE * hair_test_mean_alpha(pixels, VALUES);
    print_message("    %g pixels\n", covered);
    assert_true(covered > 20);
    assert_true(sum_of(pixels) == 0);
    hair_test_scene_free(&f.scene);
}

static void light_of_several_lights_is_their_sum(void** state)
{
    struct fixture f = start(state, HAIR_SHADING_FIBRES);
    static float alone[3][VALUES], together[VALUES];
    f.light[0].direction[0] = -1;
    f.light[1].kind = HAIR_LIGHT_POINT;
    f.light[1].position[1] = 0.4f, f.light[1].position[2] = 0.3f;
    f.light[1].color[2] = 0.5f;
    f.light[2].kind = HAIR_LIGHT_SPOT;
    f.light[2].position[0] = 1;
    f.light[2].direction[0] = 1, f.light[2].direction[1] = f.light[2].direction[2] = 0;
    draw(&f, 3, together);
    for (int i = 2; i >= 0; --i) {
        f.light[0] = f.light[i];
        if (i == 0) f.light[0] = hair_light_default(), f.light[0].direction[0] = -1;
        draw(&f, 1, alone[i]);
        assert_true(sum_of(alone[i]) > 1);
    }
    for (int i = 0; i < VALUES; ++i)
        if (i % 4 < 3) {
            double sum = (double)alone[0][i] + (double)alone[1][i] + (double)alone[2][i];
            hair_test_near("light", (size_t)i, (double)together[i], sum, 1e-4 * (1 + sum));
        }
    hair_test_scene_free(&f.scene);
}

static void point_light_falls_with_the_square_of_distance(void** state)
{
    struct fixture f = start(state, HAIR_SHADING_FIBRES);
    static float sun[VALUES], lamp[VALUES];
    f.light[0].direction[0] = f.light[0].direction[1] = 0, f.light[0].direction[2] = 1;
    draw(&f, 1, sun);
    f.light[0].kind = HAIR_LIGHT_POINT;
    f.light[0].position[2] = 1000;
    for (int i = 0; i < 3; ++i) f.light[0].color[i] = 3e6f / 4;
    draw(&f, 1, lamp);
    hair_test_near("light of a lamp 1 km off", 0, sum_of(lamp) / sum_of(sun), 0.25, 0.001);
    f.light[0].range = 1100;
    draw(&f, 1, lamp);
    double faded = 1 - pow(1000.0 / 1100, 4);
    hair_test_near("near the end of its range", 0, sum_of(lamp) / sum_of(sun), 0.25 * faded * faded, 0.001);
    f.light[0].range = 999;
    draw(&f, 1, lamp);
    hair_test_near("beyond its range", 0, sum_of(lamp), 0, 0);
    hair_test_scene_free(&f.scene);
}

static void spot_light_shines_only_into_its_cone(void** state)
{
    struct fixture f = start(state, HAIR_SHADING_LINES);
    static float point[VALUES], spot[VALUES];
    uint32_t inside = 0, outside = 0;
    f.light[0].kind = HAIR_LIGHT_POINT;
    f.light[0].position[2] = 2;
    draw(&f, 1, point);
    f.light[0].kind = HAIR_LIGHT_SPOT;
    f.light[0].direction[0] = f.light[0].direction[1] = 0, f.light[0].direction[2] = 1;
    // Radii of 10 and 12 cm in a half width of 30 cm.
    f.light[0].inner_angle = 0.05f, f.light[0].outer_angle = 0.06f;
    draw(&f, 1, spot);
    for (int i = 0; i < SIZE * SIZE; ++i) {
        double r = 0.6 / SIZE * hypot(i % SIZE + 0.5 - SIZE / 2.0, i / SIZE + 0.5 - SIZE / 2.0);
        if (point[4 * i] <= 0) continue;
        // Strands are nearer than the surface they cover, so the limits leave a margin.
        if (r < 0.07) {
            hair_test_near("inside", (size_t)i, (double)spot[4 * i], (double)point[4 * i],
                           1e-4 * (double)point[4 * i]);
            ++inside;
        } else if (r > 0.16) {
            hair_test_near("outside", (size_t)i, (double)spot[4 * i], 0, 0);
            ++outside;
        }
    }
    assert_true(inside > 5 && outside > 5);
    hair_test_scene_free(&f.scene);
}

// Check spherical harmonics. A uniform sky equals harmonics of order 0. A sky that is brighter
// above lights surfaces that face up more.
static void sky_equals_its_spherical_harmonics(void** state)
{
    struct fixture f = start(state, HAIR_SHADING_FIBRES);
    float sky[27] = {0};
    static float even[VALUES], pixels[VALUES];
    for (int i = 0; i < 3; ++i) f.scene.view.ambient[i] = 2;
    draw(&f, 0, even);
    // The divisor is pi times 0.282095.
    for (int i = 0; i < 3; ++i) f.scene.view.ambient[i] = 0, sky[i] = 2 / 0.886227f;
    f.scene.view.sky = sky;
    draw(&f, 0, pixels);
    hair_test_near("an even sky", 0, sum_of(pixels) / sum_of(even), 1, 1e-5);
    sky[8] = sky[0] / 2; // Along z, towards the eye, which sees the surfaces that face it.
    draw(&f, 0, pixels);
    // The visible half of a cylinder receives pi / 4 of the harmonics of order 1, which are 2/3 pi
    // times 0.488603.
    double more = 0.5 * 3.14159265 / 4 * 1.023328 / 0.886227;
    print_message("    %.4f times as bright\n", sum_of(pixels) / sum_of(even));
    assert_true(sum_of(pixels) / sum_of(even) > 1 && sum_of(pixels) / sum_of(even) < 1 + more + 1e-4);
    hair_test_scene_free(&f.scene);
}

// Check the brightest lights, on vertices of strands and infinitely far, in nearly undefined
// directions.
static void colors_are_finite_half_floats_under_any_light(void** state)
{
    for (int shading = 0; shading < 2; ++shading) {
        struct fixture f = start(state, (hair_shading)shading);
        static float pixels[VALUES], vertices[3 * 4096];
        uint32_t count;
        float sky[27];
        hair_test_ok(f.scene.test,
                     hair_read_positions(f.scene.hair, HAIR_READ_FOLLOWERS, vertices, 4096, &count));
        for (int i = 0; i < 16; ++i) {
            f.light[i].kind = (hair_light_kind)(i % 3);
            memcpy(f.light[i].position, vertices + 3 * (37 * i % 4096), 3 * sizeof(float));
            for (int k = 0; k < 3; ++k)
                f.light[i].color[k] = 1e6f, f.light[i].direction[k] = k == i % 2 ? 2e-12f : 0;
            f.light[i].source_radius = 0.001f;
        }
        f.light[13].position[0] = 1e9f, f.light[10].direction[2] = 1e6f, f.light[5].range = 1e-6f;
        for (int i = 0; i < 27; ++i) sky[i] = i % 2 ? 1e6f : -1e6f;
        f.scene.view.sky = sky;
        draw(&f, 16, pixels);
        for (int i = 0; i < VALUES; ++i)
            if (!(pixels[i] >= 0 && pixels[i] <= 65504)) fail_msg("value %d is %g", i, (double)pixels[i]);
        assert_true(sum_of(pixels) > 1e5);
        hair_test_scene_free(&f.scene);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        HAIR_TEST(hair_without_light_is_black_but_drawn),
        HAIR_TEST(light_of_several_lights_is_their_sum),
        HAIR_TEST(point_light_falls_with_the_square_of_distance),
        HAIR_TEST(spot_light_shines_only_into_its_cone),
        HAIR_TEST(sky_equals_its_spherical_harmonics),
        HAIR_TEST(colors_are_finite_half_floats_under_any_light),
    };
    if (hair_test_skips()) return 0;
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
