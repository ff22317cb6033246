// golden.c - Comparison of pictures with those of an earlier run.
#include "tests/support/golden.h"

#include "tests/support/support.h"

#include <math.h>
#include <png.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tools/common/flip.h"

// Two runs on one driver give equal pictures. Pictures of an SSE4.1 CPU and of an AVX2 CPU differed
// by an RMSE of 0.00004.
#define MAX_RMSE 0.003
#define MAX_BAD_PIXELS 0.002 // fraction of pixels whose distance is above a quarter
// Limits of FLIP between zink over lavapipe and llvmpipe, which round differently.
#define MAX_FLIP 0.01
#define MAX_FLIP_PERCENTILE 0.1 // the error that 99 % of the pixels do not exceed

void hair_test_read_png(const char* path, uint8_t* pixels, uint32_t width, uint32_t height)
{
    png_image image = {.version = PNG_IMAGE_VERSION};
    if (!png_image_begin_read_from_file(&image, path))
        fail_msg("%s cannot be read; HAIR_BLESS=1 makes a golden picture, which you then look at", path);
    assert_int_equal(image.width, width);
    assert_int_equal(image.height, height);
    image.format = PNG_FORMAT_RGB;
    assert_true(png_image_finish_read(&image, NULL, pixels, 0, NULL));
}

double hair_test_color_distance(const uint8_t* a, const uint8_t* b)
{
    double sum = 0;
    for (int k = 0; k < 3; ++k) sum += pow((a[k] - b[k]) / 255.0, 2);
    return sqrt(sum / 3);
}

size_t hair_test_distinct_colors(const uint8_t* pixels, uint32_t width, uint32_t height)
{
    static uint8_t seen[1 << 15];
    memset(seen, 0, sizeof seen);
    size_t count = 0;
    for (size_t i = 0; i < (size_t)width * height; ++i, pixels += 3) {
        unsigned key = (unsigned)(pixels[0] >> 3 << 10 | pixels[1] >> 3 << 5 | pixels[2] >> 3);
        count += !seen[key];
        seen[key] = 1;
    }
    return count;
}

// Return whether the renderer's name begins with that text.
static bool is_renderer(const char* name)
{
    hair_egl* egl = NULL;
    assert_int_equal(hair_egl_create(NULL, -1, &egl), HAIR_OK);
    const char* renderer = (const char*)glGetString(GL_RENDERER);
    bool is = strncmp(renderer, name, strlen(name)) == 0;
    hair_egl_destroy(egl);
    return is;
}

static void write_png(const char* path, const uint8_t* pixels, uint32_t width, uint32_t height)
{
    png_image image = {.version = PNG_IMAGE_VERSION, .width = width, .height = height};
    image.format = PNG_FORMAT_RGB;
    assert_true(png_image_write_to_file(&image, path, 0, pixels, 0, NULL));
}

static void check_equal(const char* name, const uint8_t* pixels, const uint8_t* before, size_t count)
{
    size_t bad = 0;
    double square = 0;
    for (size_t i = 0; i < count; ++i) {
        double distance = hair_test_color_distance(pixels + 3 * i, before + 3 * i);
        square += distance * distance;
        bad += distance > 0.25;
    }
    double rmse = sqrt(square / (double)count), fraction = (double)bad / (double)count;
    print_message("%s: rmse %.5f, pixels further off than a quarter %.5f\n", name, rmse, fraction);
    assert_true(rmse <= MAX_RMSE && fraction <= MAX_BAD_PIXELS);
}

static void check_similar(const char* name, const uint8_t* pixels, const uint8_t* before, uint32_t width,
                          uint32_t height)
{
    size_t count = (size_t)width * height, bad = 0;
    float* a = malloc(7 * count * sizeof *a);
    assert_non_null(a);
    float *b = a + 3 * count, *map = b + 3 * count;
    for (size_t i = 0; i < 3 * count; ++i) {
        a[i] = (float)before[i] / 255;
        b[i] = (float)pixels[i] / 255;
    }
    assert_true(hair_flip(a, b, width, height, HAIR_FLIP_DISPLAY, map));
    double sum = 0;
    for (size_t i = 0; i < count; ++i) {
        sum += map[i];
        bad += map[i] > MAX_FLIP_PERCENTILE;
    }
    free(a);
    double flip = sum / (double)count, fraction = (double)bad / (double)count;
    print_message("%s: FLIP %.5f to llvmpipe, above %g in %.5f of the pixels\n", name, flip,
                  MAX_FLIP_PERCENTILE, fraction);
    assert_true(flip <= MAX_FLIP && fraction <= 0.01);
}

void hair_test_golden(const char* name, const uint8_t* pixels, uint32_t width, uint32_t height)
{
    bool is_llvmpipe = is_renderer("llvmpipe");
    if (!is_llvmpipe && !is_renderer("zink")) {
        print_message("%s: no golden of this renderer, none compared\n", name);
        return;
    }
    char path[256];
    snprintf(path, sizeof path, "tests/golden/llvmpipe/%s.png", name);
    if (is_llvmpipe && getenv("HAIR_BLESS")) write_png(path, pixels, width, height);

    uint8_t* before = malloc(3 * (size_t)width * height);
    assert_non_null(before);
    hair_test_read_png(path, before, width, height);
    if (is_llvmpipe)
        check_equal(name, pixels, before, (size_t)width * height);
    else
        check_similar(name, pixels, before, width, height);
    free(before);
}
