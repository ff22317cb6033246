// picture.c - A picture of hair as it is shown, with the tone curve of hair-capture but without its
// noise.
#include "tools/bench/picture.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define AROUND 8 // pixels

bool bench_picture_make(uint32_t size, struct bench_picture* out)
{
    size_t pixels = (size_t)size * size;
    *out = (struct bench_picture){.size = size};
    out->rgba = calloc(4 * pixels, sizeof *out->rgba);
    out->shown = calloc(3 * pixels, sizeof *out->shown);
    return out->rgba && out->shown;
}

void bench_picture_free(struct bench_picture* picture)
{
    free(picture->rgba);
    free(picture->shown);
    free(picture->mask);
    *picture = (struct bench_picture){0};
}

// Apply the tone curve, linear up to 0.5, then a shoulder that approaches white asymptotically,
// then the sRGB curve.
static double encode(double light)
{
    double c = light > 0.5 ? 1 - 0.5 * exp(1 - 2 * light) : fmax(light, 0);
    return c <= 0.0031308 ? 12.92 * c : 1.055 * pow(c, 1 / 2.4) - 0.055;
}

void bench_picture_finish(struct bench_picture* picture, uint32_t count, double exposure)
{
    size_t pixels = (size_t)picture->size * picture->size;
    picture->coverage = 0;
    for (size_t i = 0; i < 4 * pixels; ++i) picture->rgba[i] /= count;
    for (size_t i = 0; i < pixels; ++i) {
        picture->coverage += picture->rgba[4 * i + 3];
        for (size_t k = 0; k < 3; ++k)
            picture->shown[3 * i + k] = (float)encode(exposure * picture->rgba[4 * i + k]);
    }
}

bool bench_picture_cover(struct bench_picture* picture)
{
    size_t pixels = (size_t)picture->size * picture->size;
    if (!picture->mask) picture->mask = malloc(pixels);
    if (!picture->mask) return false;
    for (size_t i = 0; i < pixels; ++i) picture->mask[i] = picture->rgba[4 * i + 3] > 0;
    return hair_mask_dilate(picture->mask, picture->size, picture->size, AROUND);
}

bool bench_picture_compare(const struct bench_picture* where, const struct bench_picture* reference,
                           const struct bench_picture* test, struct hair_image_error* out)
{
    return hair_image_error(reference->shown, test->shown, where->mask, where->size, where->size, out);
}
