// ground_truth.c - Mean of many pictures that are shifted by fractions of a pixel.
#include "tools/bench/ground_truth.h"

#include <epoxy/gl.h>
#include <math.h>
#include <string.h>

#define MAX_PIXELS 2048 // maximum pixels per side drawn at once

bool bench_ground_truth_create(uint32_t size, struct bench_ground_truth* out)
{
    memset(out, 0, sizeof *out);
    return bench_picture_make(size, &out->half[0]) && bench_picture_make(size, &out->half[1]) &&
           bench_picture_make(size, &out->whole);
}

void bench_ground_truth_free(struct bench_ground_truth* ground_truth)
{
    bench_picture_free(&ground_truth->half[0]);
    bench_picture_free(&ground_truth->half[1]);
    bench_picture_free(&ground_truth->whole);
}

uint32_t bench_max_samples(void)
{
    GLint max = 1;
    glGetIntegerv(GL_MAX_SAMPLES, &max);
    return (uint32_t)max;
}

// Compute the i-th shift. Any number of shifts is evenly distributed over the square (Roberts 2018,
// multiples of powers of the plastic number). Each shift is followed by its opposite, because a
// shift of the whole mean is worse than a little noise.
static void jitter(uint32_t i, float size, float out[2])
{
    const double step[2] = {0.7548776662466927, 0.5698402909980532};
    for (int k = 0; k < 2; ++k) {
        double at = fmod(0.5 + step[k] * (i / 2 + 1), 1) - 0.5;
        out[k] = (float)(i % 2 ? -at : at) * size;
    }
}

// Sum every second pair of the pictures.
static bool take_half(struct bench_studio* studio, uint32_t half, struct bench_shot* shot, uint32_t pictures,
                      float shadow_texels, struct bench_picture* out)
{
    memset(out->rgba, 0, 4 * sizeof *out->rgba * out->size * out->size);
    for (uint32_t i = 0; i < pictures; ++i) {
        if (i / 2 % 2 != half) continue;
        jitter(i, 1 / (float)shot->supersample, shot->jitter);
        jitter(i, shadow_texels, shot->shadow_jitter);
        if (!bench_studio_set(studio, shot) || !bench_studio_draw(studio, NULL) ||
            !bench_studio_add(studio, out->rgba))
            return false;
    }
    bench_picture_finish(out, pictures / 2, (double)studio->scene.exposure);
    return true;
}

bool bench_ground_truth_render(struct bench_studio* studio, const struct bench_shot* shot, uint32_t samples,
                               float shadow_texels, struct bench_ground_truth* out)
{
    struct bench_shot fine = *shot;
    uint32_t size = studio->size, side = 1, max = bench_max_samples();
    while (2 * side * size <= MAX_PIXELS && side < 8) side *= 2;
    fine.samples = max < 8 ? max : 8;
    fine.supersample = side;
    uint32_t each = fine.samples * side * side, pictures = (samples + each - 1) / each;
    pictures = (pictures + 3) / 4 * 4;
    for (uint32_t i = 0; i < 2; ++i)
        if (!take_half(studio, i, &fine, pictures, shadow_texels, &out->half[i])) return false;
    for (size_t i = 0; i < 4 * (size_t)size * size; ++i)
        out->whole.rgba[i] = out->half[0].rgba[i] + out->half[1].rgba[i];
    bench_picture_finish(&out->whole, 2, (double)studio->scene.exposure);
    return true;
}
