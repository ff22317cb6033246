// image_error_test.c - the difference of two pictures agrees with the published evaluator of FLIP.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

// Tools are not linked into tests.
#include "tools/common/flip.h"
#include "tools/common/image_error.c"

enum { WIDTH = 64, HEIGHT = 48, PIXELS = WIDTH * HEIGHT };

// Paint ramps, edges of arcs, and noise. `which` selects one of two similar pictures.
static void paint(int which, float* out)
{
    for (int y = 0; y < HEIGHT; ++y)
        for (int x = 0; x < WIDTH; ++x, out += 3) {
            double noise = ((x * 7919 + y * 104729 + which * 15485863) >> 3) % 97 / 96.0;
            double arc = (x * x + y * y * (2 + which)) / 400 % 2;
            out[0] = (float)(x / (WIDTH - 1.0) * (1 - 0.1 * which));
            out[1] = (float)(0.5 * arc + 0.5 * y / (HEIGHT - 1.0));
            out[2] = (float)(0.7 * noise + 0.3 * arc);
        }
}

static void fill(const float color[3], float* out)
{
    for (int i = 0; i < PIXELS; ++i) memcpy(out + 3 * i, color, 3 * sizeof *color);
}

static double mean(const float* map)
{
    double sum = 0;
    for (int i = 0; i < PIXELS; ++i) sum += map[i];
    return sum / PIXELS;
}

static void flip_map_equals_the_published_evaluator(void** state)
{
    (void)state;
    // Values of flip-evaluator 1.7 in float arithmetic, for these two pictures, LDR, 67.0206 pixels
    // per degree.
    static const struct {
        int x, y;
        double error;
    } expected[] = {{0, 0, 0.034409329},   {63, 0, 0.275648713},  {0, 47, 0.762485921},
                    {63, 47, 0.701918185}, {31, 20, 0.907634437}, {10, 40, 0.109654687},
                    {50, 13, 0.454609245}, {22, 5, 0.127966315}};
    static float a[3 * PIXELS], b[3 * PIXELS], map[PIXELS];
    paint(0, a);
    paint(1, b);
    assert_true(hair_flip(a, b, WIDTH, HEIGHT, HAIR_FLIP_DISPLAY, map));
    for (size_t i = 0; i < sizeof expected / sizeof *expected; ++i) {
        double found = map[expected[i].y * WIDTH + expected[i].x];
        print_message("(%d, %d): %.6f, expected %.6f\n", expected[i].x, expected[i].y, found,
                      expected[i].error);
        assert_true(fabs(found - expected[i].error) < 1e-4);
    }
    print_message("mean %.7f\n", mean(map));
    assert_true(fabs(mean(map) - 0.431912631) < 1e-5);
}

static void flip_pixels_per_degree_equal_the_published_evaluator(void** state)
{
    (void)state;
    static float a[3 * PIXELS], b[3 * PIXELS], map[PIXELS];
    paint(0, a);
    paint(1, b);
    assert_true(hair_flip(a, b, WIDTH, HEIGHT, 32, map));
    assert_true(fabs(mean(map) - 0.576780021) < 1e-5);
}

static void flip_color_distances_equal_the_published_evaluator(void** state)
{
    (void)state;
    static const struct {
        float a[3], b[3];
        double error;
    } expected[] = {{{0, 0, 0}, {1, 1, 1}, 0.967390954},
                    {{0, 1, 0}, {0, 0, 1}, 1}, // The maximum.
                    {{0.5f, 0.5f, 0.5f}, {0.52f, 0.5f, 0.5f}, 0.077514656},
                    {{1, 0, 0}, {0, 1, 1}, 0.979907870}};
    static float a[3 * PIXELS], b[3 * PIXELS], map[PIXELS];
    for (size_t i = 0; i < sizeof expected / sizeof *expected; ++i) {
        fill(expected[i].a, a);
        fill(expected[i].b, b);
        assert_true(hair_flip(a, b, WIDTH, HEIGHT, HAIR_FLIP_DISPLAY, map));
        print_message("%zu: %.6f, expected %.6f\n", i, mean(map), expected[i].error);
        assert_true(fabs(mean(map) - expected[i].error) < 1e-4);
    }
}

static void image_error_is_symmetric_and_zero_for_equal_images(void** state)
{
    (void)state;
    static float a[3 * PIXELS], b[3 * PIXELS], there[PIXELS], back[PIXELS];
    static double max;
    paint(0, a);
    paint(1, b);
    assert_true(hair_flip(a, a, WIDTH, HEIGHT, HAIR_FLIP_DISPLAY, there));
    for (int i = 0; i < PIXELS; ++i) assert_true(there[i] == 0);
    assert_true(hair_flip(a, b, WIDTH, HEIGHT, HAIR_FLIP_DISPLAY, there));
    assert_true(hair_flip(b, a, WIDTH, HEIGHT, HAIR_FLIP_DISPLAY, back));
    for (int i = 0; i < PIXELS; ++i) {
        assert_true(there[i] == back[i] && there[i] >= 0 && there[i] <= 1);
        max = fmax(max, there[i]);
    }
    assert_true(max > 0.9);
}

static void invisible_detail_has_less_image_error(void** state)
{
    (void)state;
    static float a[3 * PIXELS], b[3 * PIXELS], map[PIXELS];
    for (int i = 0; i < PIXELS; ++i)
        for (int k = 0; k < 3; ++k) {
            // A chequerboard of pixels, and its inverse.
            a[3 * i + k] = (float)((i + i / WIDTH) % 2);
            b[3 * i + k] = 1 - a[3 * i + k];
        }
    double before = 1;
    for (int per_degree = 10; per_degree <= 80; per_degree *= 2) {
        assert_true(hair_flip(a, b, WIDTH, HEIGHT, (float)per_degree, map));
        print_message("%d pixels per degree: %.4f\n", per_degree, mean(map));
        assert_true(mean(map) < before);
        before = mean(map);
    }
    assert_true(before < 0.1);
}

static void image_error_counts_only_masked_pixels(void** state)
{
    (void)state;
    static float a[3 * PIXELS], b[3 * PIXELS];
    static unsigned char mask[PIXELS];
    struct hair_image_error error;
    fill((float[3]){0.5f, 0.5f, 0.5f}, a);
    memcpy(b, a, sizeof b);
    assert_false(hair_image_error(a, b, mask, WIDTH, HEIGHT, &error));
    for (int y = 0; y < HEIGHT; ++y)
        for (int x = 0; x < WIDTH; ++x) {
            mask[y * WIDTH + x] = x < 10;
            if (x >= 40) b[3 * (y * WIDTH + x)] = 1;
        }
    assert_true(hair_image_error(a, b, mask, WIDTH, HEIGHT, &error));
    assert_true(error.flip == 0 && isinf(error.psnr) && error.psnr > 0 && error.pixels == 10 * HEIGHT);
    memset(mask, 1, sizeof mask);
    for (int i = 0; i < 3 * PIXELS; ++i) b[i] = a[i] + 0.01f;
    assert_true(hair_image_error(a, b, mask, WIDTH, HEIGHT, &error));
    assert_true(fabs(error.psnr - 40) < 1e-3 && error.flip > 0 && error.pixels == PIXELS);
}

static void cropping_unmasked_pixels_keeps_the_image_error(void** state)
{
    (void)state;
    static float a[3 * PIXELS], b[3 * PIXELS], map[PIXELS];
    static unsigned char mask[PIXELS];
    struct hair_image_error error;
    double sum = 0;
    paint(0, a);
    paint(1, b);
    assert_true(hair_flip(a, b, WIDTH, HEIGHT, HAIR_FLIP_DISPLAY, map));
    for (int y = 20; y < 30; ++y)
        for (int x = 15; x < 40; ++x) {
            mask[y * WIDTH + x] = 1;
            sum += map[y * WIDTH + x];
        }
    assert_true(hair_image_error(a, b, mask, WIDTH, HEIGHT, &error));
    assert_int_equal(error.pixels, 250);
    assert_true(fabs(error.flip - sum / 250) < 1e-6);
}

static void mask_grows_by_a_square_within_the_image(void** state)
{
    (void)state;
    static unsigned char mask[PIXELS];
    mask[20 * WIDTH + 30] = mask[WIDTH - 1] = 1;
    assert_true(hair_mask_dilate(mask, WIDTH, HEIGHT, 8));
    for (int y = 0; y < HEIGHT; ++y)
        for (int x = 0; x < WIDTH; ++x) {
            int near = (abs(x - 30) <= 8 && abs(y - 20) <= 8) || (x >= WIDTH - 9 && y <= 8);
            assert_int_equal(mask[y * WIDTH + x] != 0, near);
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(flip_map_equals_the_published_evaluator),
        cmocka_unit_test(flip_pixels_per_degree_equal_the_published_evaluator),
        cmocka_unit_test(flip_color_distances_equal_the_published_evaluator),
        cmocka_unit_test(image_error_is_symmetric_and_zero_for_equal_images),
        cmocka_unit_test(invisible_detail_has_less_image_error),
        cmocka_unit_test(image_error_counts_only_masked_pixels),
        cmocka_unit_test(cropping_unmasked_pixels_keeps_the_image_error),
        cmocka_unit_test(mask_grows_by_a_square_within_the_image),
    };
    return cmocka_run_group_tests_name("image error", tests, NULL, NULL);
}
