// strand_light.c - Light that reaches strands, by rays and by layers.
#include "tools/bench/strand_light.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "lib/base/assert.h"

static uint32_t hash(uint32_t x)
{
    x = (x ^ (x >> 16)) * 0x7feb352du;
    x = (x ^ (x >> 15)) * 0x846ca68bu;
    return x ^ (x >> 16);
}

static float fraction_of(uint32_t* random)
{
    *random = *random * 1664525u + 1013904223u;
    return (float)(hash(*random) >> 8) / 16777216.0f;
}

bool bench_strands_make(const float* positions, uint32_t count, uint32_t each, float radius,
                        const float to_light[3], struct bench_strands* out)
{
    float z[3], x[3], y[3], l = 0;
    *out = (struct bench_strands){.count = count, .each = each, .radius = radius};
    out->seen = malloc((size_t)count * each * 3 * sizeof(float));
    if (!out->seen) return false;
    for (int i = 0; i < 3; ++i) l += to_light[i] * to_light[i];
    for (int i = 0; i < 3; ++i) z[i] = to_light[i] / sqrtf(l);
    float side = hypotf(z[0], z[2]);
    x[0] = z[2] / side, x[1] = 0, x[2] = -z[0] / side;
    y[0] = z[1] * x[2], y[1] = z[2] * x[0] - z[0] * x[2], y[2] = -z[1] * x[0];
    for (int k = 0; k < 3; ++k) out->lower[k] = 1e9f, out->upper[k] = -1e9f;
    for (size_t i = 0; i < (size_t)count * each; ++i) {
        const float* p = positions + 3 * i;
        const float* axes[] = {x, y, z};
        for (int k = 0; k < 3; ++k) {
            float at = axes[k][0] * p[0] + axes[k][1] * p[1] + axes[k][2] * p[2];
            out->seen[3 * i + (size_t)k] = at;
            out->lower[k] = fminf(out->lower[k], at - 2 * radius);
            out->upper[k] = fmaxf(out->upper[k], at + 2 * radius);
        }
    }
    return true;
}

void bench_strands_free(struct bench_strands* strands)
{
    free(strands->seen);
    strands->seen = NULL;
}

// Rays --------------------------------------------------------------------------------------------

// Segments sorted by the cells of a grid perpendicular to the light.
struct cells {
    uint32_t size[2];
    float side;
    uint32_t* first; // one more than cells
    uint32_t* segment;
};

static void range_of(const struct bench_strands* s, const struct cells* cells, size_t v, uint32_t range[2][2])
{
    for (int k = 0; k < 2; ++k) {
        float a = s->seen[3 * v + (size_t)k], b = s->seen[3 * (v + 1) + (size_t)k];
        float low = fminf(a, b) - s->radius - s->lower[k], high = fmaxf(a, b) + s->radius - s->lower[k];
        range[k][0] = (uint32_t)fmaxf(low / cells->side, 0);
        range[k][1] = (uint32_t)fmaxf(high / cells->side, 0);
        if (range[k][1] >= cells->size[k]) range[k][1] = cells->size[k] - 1;
    }
}

// Count the segments of each cell, or fill the cells in a second pass. A segment's bounding box is
// used, which fits short segments well.
static void sort_segments(const struct bench_strands* s, struct cells* cells, bool fills)
{
    for (size_t n = 0; n < s->count; ++n)
        for (size_t k = 0; k + 1 < s->each; ++k) {
            uint32_t range[2][2];
            size_t v = n * s->each + k;
            range_of(s, cells, v, range);
            for (uint32_t y = range[1][0]; y <= range[1][1]; ++y)
                for (uint32_t x = range[0][0]; x <= range[0][1]; ++x) {
                    size_t cell = (size_t)y * cells->size[0] + x;
                    if (fills)
                        cells->segment[--cells->first[cell + 1]] = (uint32_t)v;
                    else
                        ++cells->first[cell + 1];
                }
        }
}

static bool make_cells(const struct bench_strands* s, struct cells* cells)
{
    cells->side = 0.0015f;
    for (int k = 0; k < 2; ++k) cells->size[k] = 1 + (uint32_t)((s->upper[k] - s->lower[k]) / cells->side);
    size_t count = (size_t)cells->size[0] * cells->size[1];
    cells->first = calloc(count + 2, sizeof *cells->first);
    if (!cells->first) return false;
    sort_segments(s, cells, false);
    for (size_t i = 1; i <= count; ++i) cells->first[i] += cells->first[i - 1];
    cells->segment = malloc(((size_t)cells->first[count] + 1) * sizeof *cells->segment);
    if (!cells->segment) return false;
    cells->first[count + 1] = cells->first[count];
    sort_segments(s, cells, true); // The second pass moves each cell's end to its start.
    return true;
}

static bool is_met(const struct bench_strands* s, const struct cells* cells, const float from[3], size_t own)
{
    uint32_t at[2];
    for (int k = 0; k < 2; ++k) {
        float cell = (from[k] - s->lower[k]) / cells->side;
        if (cell < 0 || cell >= (float)cells->size[k]) return false;
        at[k] = (uint32_t)cell;
    }
    size_t cell = (size_t)at[1] * cells->size[0] + at[0];
    for (uint32_t i = cells->first[cell + 1]; i < cells->first[cell + 2]; ++i) {
        size_t v = cells->segment[i];
        const float *a = s->seen + 3 * v, *b = a + 3;
        if (v / s->each == own) continue;
        float dx = b[0] - a[0], dy = b[1] - a[1], px = from[0] - a[0], py = from[1] - a[1];
        float t = (px * dx + py * dy) / fmaxf(dx * dx + dy * dy, 1e-12f);
        if (t < 0 || t > 1 || a[2] + t * (b[2] - a[2]) < from[2]) continue;
        px -= t * dx, py -= t * dy;
        if (px * px + py * py < s->radius * s->radius) return true;
    }
    return false;
}

bool bench_light_by_rays(const struct bench_strands* s, uint32_t rays, uint32_t seed, float* out)
{
    struct cells cells = {.side = 0};
    HAIR_ASSERT(rays > 0);
    bool ok = make_cells(s, &cells);
    for (size_t v = 0; ok && v < (size_t)s->count * s->each; ++v) {
        uint32_t random = hash((uint32_t)v ^ seed * 0x9e3779b9u), free_ = 0;
        size_t own = v / s->each, k = v % s->each;
        for (uint32_t i = 0; i < rays; ++i) {
            float along = ((float)i + fraction_of(&random)) / (float)rays - 0.5f, from[3];
            float across = s->radius * (2 * fraction_of(&random) - 1);
            size_t next = along < 0 ? (k ? v - 1 : v) : (k + 1 < s->each ? v + 1 : v);
            const float *a = s->seen + 3 * v, *b = s->seen + 3 * next;
            float fraction = fabsf(along), dx = b[0] - a[0], dy = b[1] - a[1],
                  l = fmaxf(hypotf(dx, dy), 1e-9f);
            for (int j = 0; j < 3; ++j) from[j] = a[j] + fraction * (b[j] - a[j]);
            from[0] -= across * dy / l;
            from[1] += across * dx / l;
            free_ += !is_met(s, &cells, from, own);
        }
        out[v] = (float)free_ / (float)rays;
    }
    free(cells.first);
    free(cells.segment);
    return ok;
}

// Layers ------------------------------------------------------------------------------------------

#define MAX_LAYERS 8
#define TAPS 8

struct layers {
    float texel;
    int size[2];
    uint32_t count;
    float depth[MAX_LAYERS + 1]; // depths of the ends of layers, relative to the first strand
    float* nearest; // per texel
    float* opacity; // per texel and layer, cumulative
};

static long texel_of(const struct layers* layers, float x, float y)
{
    int at[2] = {(int)floorf(x), (int)floorf(y)};
    if (at[0] < 0 || at[1] < 0 || at[0] >= layers->size[0] || at[1] >= layers->size[1]) return -1;
    return (long)at[1] * layers->size[0] + at[0];
}

static void draw_layers(const struct bench_strands* s, struct layers* layers, bool opacity)
{
    for (size_t n = 0; n < s->count; ++n)
        for (size_t k = 0; k + 1 < s->each; ++k) {
            const float *a = s->seen + 3 * (n * s->each + k), *b = a + 3;
            float across = hypotf(b[0] - a[0], b[1] - a[1]);
            int steps = 1 + (int)(2 * across / layers->texel);
            float covers = across * 2 * s->radius / (layers->texel * layers->texel) / (float)steps;
            for (int i = 0; i < steps; ++i) {
                float t = ((float)i + 0.5f) / (float)steps, p[3];
                for (int j = 0; j < 3; ++j) p[j] = a[j] + t * (b[j] - a[j]);
                long at = texel_of(layers, (p[0] - s->lower[0]) / layers->texel,
                                   (p[1] - s->lower[1]) / layers->texel);
                if (at < 0) continue;
                if (!opacity) layers->nearest[at] = fmaxf(layers->nearest[at], p[2]);
                for (uint32_t l = 0; opacity && l < layers->count; ++l)
                    if (layers->nearest[at] - p[2] < layers->depth[l + 1])
                        layers->opacity[(size_t)at * layers->count + l] += covers;
            }
        }
}

static float opacity_at(const struct layers* layers, long at, float z)
{
    if (at < 0) return 0;
    float deep = layers->nearest[at] - z, before = 0;
    const float* opacity = layers->opacity + (size_t)at * layers->count;
    if (deep <= 0) return 0;
    for (uint32_t l = 0; l < layers->count; before = opacity[l++])
        if (deep < layers->depth[l + 1])
            return before + (opacity[l] - before) * (deep - layers->depth[l]) /
                                (layers->depth[l + 1] - layers->depth[l]);
    return before;
}

bool bench_light_by_layers(const struct bench_strands* s, float texel, uint32_t count, float first,
                           float deeper, float* out)
{
    struct layers layers = {.texel = texel, .count = count};
    HAIR_ASSERT(count > 0);
    for (int k = 0; k < 2; ++k) layers.size[k] = 1 + (int)((s->upper[k] - s->lower[k]) / texel);
    for (uint32_t l = 0; l < count; ++l, first *= deeper) layers.depth[l + 1] = layers.depth[l] + first;
    layers.depth[count] = 1e3f; // The last layer contains all the rest.
    size_t texels = (size_t)layers.size[0] * (size_t)layers.size[1];
    layers.nearest = malloc(texels * sizeof(float));
    layers.opacity = calloc(texels * count, sizeof(float));
    bool ok = layers.nearest && layers.opacity;
    for (size_t i = 0; ok && i < texels; ++i) layers.nearest[i] = -1e9f;
    if (ok) draw_layers(s, &layers, false);
    if (ok) draw_layers(s, &layers, true);
    for (size_t v = 0; ok && v < (size_t)s->count * s->each; ++v) {
        const float* p = s->seen + 3 * v;
        float turn = 6.2831853f * (float)(hash((uint32_t)(v / s->each)) & 1023u) / 1024, sum = 0;
        for (int i = 0; i < TAPS; ++i, turn += 2.399963f) {
            float r = 2 * sqrtf(((float)i + 0.5f) / TAPS);
            long at = texel_of(&layers, (p[0] - s->lower[0]) / texel + r * cosf(turn),
                               (p[1] - s->lower[1]) / texel + r * sinf(turn));
            sum += expf(-opacity_at(&layers, at, p[2]));
        }
        out[v] = sum / TAPS;
    }
    free(layers.nearest);
    free(layers.opacity);
    return ok;
}
