// golden.c - Comparison of pictures with those of an earlier run.
#include "tests/support/golden.h"

#include "tests/support/support.h"

#include <math.h>
#include <png.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// Two runs on one driver give equal pictures. Pictures of an SSE4.1 CPU and of an AVX2 CPU differed
// by an RMSE of 0.00004.
#define MAX_RMSE 0.003
#define MAX_BAD_PIXELS 0.002 // fraction of pixels whose distance is above a quarter

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

// Return the folder of this renderer's pictures, or NULL without one.
static const char* renderer_folder(void)
{
    hair_egl* egl = NULL;
    assert_int_equal(hair_egl_create(NULL, -1, &egl), HAIR_OK);
    const char* renderer = (const char*)glGetString(GL_RENDERER);
    const char* folder = strncmp(renderer, "llvmpipe", 8) == 0 ? "tests/golden/llvmpipe" : NULL;
    hair_egl_destroy(egl);
    return folder;
}

static void write_png(const char* path, const uint8_t* pixels, uint32_t width, uint32_t height)
{
    png_image image = {.version = PNG_IMAGE_VERSION, .width = width, .height = height};
    image.format = PNG_FORMAT_RGB;
    assert_true(png_image_write_to_file(&image, path, 0, pixels, 0, NULL));
}

void hair_test_golden(const char* name, const uint8_t* pixels, uint32_t width, uint32_t height)
{
    const char* folder = renderer_folder();
    if (!folder) {
        print_message("%s: no golden of this renderer, none compared\n", name);
        return;
    }
    char path[256];
    snprintf(path, sizeof path, "%s/%s.png", folder, name);
    if (getenv("HAIR_BLESS")) write_png(path, pixels, width, height);

    size_t count = (size_t)width * height, bad = 0;
    uint8_t* before = malloc(3 * count);
    assert_non_null(before);
    hair_test_read_png(path, before, width, height);
    double square = 0;
    for (size_t i = 0; i < count; ++i) {
        double distance = hair_test_color_distance(pixels + 3 * i, before + 3 * i);
        square += distance * distance;
        bad += distance > 0.25;
    }
    free(before);
    double rmse = sqrt(square / (double)count), fraction = (double)bad / (double)count;
    print_message("%s: rmse %.5f, pixels further off than a quarter %.5f\n", name, rmse, fraction);
    assert_true(rmse <= MAX_RMSE && fraction <= MAX_BAD_PIXELS);
}
