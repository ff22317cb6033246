// colors.c - colours along strands. They are resampled at a few points at even distances from root
// to tip, before the vertices that they came with are changed.
#include "lib/asset/strands.h"

#include <math.h>
#include <string.h>

static double segment_length(const float* p)
{
    double x = (double)p[3] - p[0], y = (double)p[4] - p[1], z = (double)p[5] - p[2];
    double length = sqrt(x * x + y * y + z * z);
    return length < 1e30 ? length : 0; // Segments that are not finite are removed later.
}

void hair_strand_colors(const float* positions, uint32_t vertices, const float* colors, float* out)
{
    HAIR_ASSERT(vertices > 0);
    double length = 0, passed = 0;
    for (uint32_t i = 1; i < vertices; ++i) length += segment_length(positions + 3 * (size_t)(i - 1));
    uint32_t at = 0; // segment that contains the point
    double each = vertices > 1 ? segment_length(positions) : 0;
    for (int k = 0; k < HAIR_STRAND_COLORS; ++k) {
        double place = length * k / (HAIR_STRAND_COLORS - 1);
        while (at + 2 < vertices && place > passed + each) {
            passed += each;
            each = segment_length(positions + 3 * (size_t)++at);
        }
        HAIR_ASSERT(at + 1 < vertices || vertices == 1);
        float t = each > 0 ? (float)fmin(fmax((place - passed) / each, 0), 1) : 0;
        const float *a = colors + 3 * (size_t)at, *b = vertices > 1 ? a + 3 : a;
        for (int c = 0; c < 3; ++c) out[3 * k + c] = a[c] + t * (b[c] - a[c]);
    }
}

void hair_strand_even_colors(const float* colors, uint32_t count, float* out)
{
    for (int k = 0; k < HAIR_STRAND_COLORS; ++k) {
        float at = (float)(count - 1) * (float)k / (HAIR_STRAND_COLORS - 1);
        uint32_t i = (uint32_t)at, j = i + 1 < count ? i + 1 : i;
        HAIR_ASSERT(i < count && j < count);
        for (int c = 0; c < 3; ++c)
            out[3 * k + c] = colors[3 * i + (uint32_t)c] +
                             (at - (float)i) * (colors[3 * j + (uint32_t)c] - colors[3 * i + (uint32_t)c]);
    }
}

void hair_strand_color_at(const float* colors, float t, float out[3])
{
    float at = fminf(fmaxf(t, 0), 1) * (HAIR_STRAND_COLORS - 1);
    int i = at < HAIR_STRAND_COLORS - 2 ? (int)at : HAIR_STRAND_COLORS - 2;
    HAIR_ASSERT(i >= 0 && i + 1 < HAIR_STRAND_COLORS);
    for (int c = 0; c < 3; ++c)
        out[c] = colors[3 * i + c] + (at - (float)i) * (colors[3 * i + 3 + c] - colors[3 * i + c]);
}

float hair_from_srgb(float c)
{
    return c <= 0.04045f ? c / 12.92f : powf((c + 0.055f) / 1.055f, 2.4f);
}

float hair_to_srgb(float c)
{
    return c <= 0.0031308f ? 12.92f * c : 1.055f * powf(c, 1 / 2.4f) - 0.055f;
}

void hair_strand_reverse_colors(float* colors)
{
    for (int i = 0, j = HAIR_STRAND_COLORS - 1; i < j; ++i, --j)
        for (int c = 0; c < 3; ++c) {
            float was = colors[3 * i + c];
            colors[3 * i + c] = colors[3 * j + c];
            colors[3 * j + c] = was;
        }
}
