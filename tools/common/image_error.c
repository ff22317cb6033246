// image_error.c - FLIP and PSNR over the covered part of a picture.
#include "tools/common/image_error.h"

#include "tools/common/flip.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// Rectangle of a picture that affects the errors of a mask's pixels.
struct part {
    uint32_t x, y, width, height;
};

static struct part part_of(const unsigned char* mask, uint32_t width, uint32_t height)
{
    uint32_t lower[2] = {width, height}, upper[2] = {0, 0};
    for (uint32_t y = 0; y < height; ++y)
        for (uint32_t x = 0; x < width; ++x) {
            if (!mask[(size_t)y * width + x]) continue;
            uint32_t left = x < HAIR_FLIP_REACH ? 0 : x - HAIR_FLIP_REACH, right = x + HAIR_FLIP_REACH + 1;
            uint32_t below = y < HAIR_FLIP_REACH ? 0 : y - HAIR_FLIP_REACH, above = y + HAIR_FLIP_REACH + 1;
            if (left < lower[0]) lower[0] = left;
            if (below < lower[1]) lower[1] = below;
            if (right > upper[0]) upper[0] = right < width ? right : width;
            if (above > upper[1]) upper[1] = above < height ? above : height;
        }
    if (!upper[0]) return (struct part){0};
    return (struct part){lower[0], lower[1], upper[0] - lower[0], upper[1] - lower[1]};
}

static void copy_part(const struct part* part, const float* from, uint32_t width, float* to)
{
    size_t row = 3 * (size_t)part->width;
    for (uint32_t y = 0; y < part->height; ++y)
        memcpy(to + y * row, from + 3 * ((size_t)(part->y + y) * width + part->x), row * sizeof *to);
}

static void sum_up(const struct part* part, const float* a, const float* b, const float* map,
                   const unsigned char* mask, uint32_t width, struct hair_image_error* out)
{
    double square = 0;
    for (uint32_t y = 0; y < part->height; ++y)
        for (uint32_t x = 0; x < part->width; ++x) {
            size_t i = (size_t)y * part->width + x;
            if (!mask[(size_t)(part->y + y) * width + part->x + x]) continue;
            ++out->pixels;
            out->flip += (double)map[i];
            for (size_t k = 3 * i; k < 3 * i + 3; ++k) square += pow((double)(a[k] - b[k]), 2);
        }
    out->flip /= out->pixels;
    out->psnr = -10 * log10(square / (3.0 * out->pixels));
}

bool hair_image_error(const float* reference, const float* test, const unsigned char* mask, uint32_t width,
                      uint32_t height, struct hair_image_error* out)
{
    struct part part = part_of(mask, width, height);
    size_t pixels = (size_t)part.width * part.height;
    float* a = calloc(7 * pixels + 1, sizeof *a);
    *out = (struct hair_image_error){0};
    if (!a) return false;
    float *b = a + 3 * pixels, *map = b + 3 * pixels;
    copy_part(&part, reference, width, a);
    copy_part(&part, test, width, b);
    bool ok = pixels > 0 && hair_flip(a, b, part.width, part.height, HAIR_FLIP_DISPLAY, map);
    if (ok) sum_up(&part, a, b, map, mask, width, out);
    free(a);
    return ok;
}

// Dilate along one axis. `step` is the distance between pixels of a line, `stride` the distance
// between lines.
static void dilate(const unsigned char* in, unsigned char* out, uint32_t length, size_t step, uint32_t lines,
                   size_t stride, uint32_t by)
{
    for (uint32_t line = 0; line < lines; ++line) {
        for (uint32_t i = 0; i < length; ++i) {
            if (!in[line * stride + i * step]) continue;
            uint32_t first = i < by ? 0 : i - by, last = by < length - i ? i + by : length - 1;
            for (uint32_t k = first; k <= last; ++k) out[line * stride + k * step] = 1;
        }
    }
}

bool hair_mask_dilate(unsigned char* mask, uint32_t width, uint32_t height, uint32_t by)
{
    size_t count = (size_t)width * height;
    unsigned char* across = calloc(count, 1);
    if (!across) return false;
    dilate(mask, across, width, 1, height, width, by);
    memset(mask, 0, count);
    dilate(across, mask, height, width, width, 1, by);
    free(across);
    return true;
}
