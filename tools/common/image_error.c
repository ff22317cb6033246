// image_error.c - FLIP and PSNR over the covered part of a picture.
#include "tools/common/image_error.h"

#include "tools/common/flip.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

bool hair_image_error(const float* reference, const float* test, const unsigned char* mask, uint32_t width,
                      uint32_t height, struct hair_image_error* out)
{
    size_t count  = (size_t)width * height;
    float* map    = malloc(count * sizeof *map);
    double square = 0;
    *out          = (struct hair_image_error){0};
    if (!map || !hair_flip(reference, test, width, height, HAIR_FLIP_DISPLAY, map)) {
        free(map);
        return false;
    }
    for (size_t i = 0; i < count; ++i) {
        if (!mask[i]) continue;
        ++out->pixels;
        out->flip += (double)map[i];
        for (size_t k = 3 * i; k < 3 * i + 3; ++k) square += pow((double)(reference[k] - test[k]), 2);
    }
    free(map);
    if (!out->pixels) return false;
    out->flip /= out->pixels;
    out->psnr = -10 * log10(square / (3.0 * out->pixels));
    return true;
}

// Along one axis: `step` apart lie the pixels of a line, `stride` apart the lines.
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
    size_t         count  = (size_t)width * height;
    unsigned char* across = calloc(count, 1);
    if (!across) return false;
    dilate(mask, across, width, 1, height, width, by);
    memset(mask, 0, count);
    dilate(across, mask, height, width, width, 1, by);
    free(across);
    return true;
}
