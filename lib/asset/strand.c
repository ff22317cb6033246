// strand.c - one strand as a polyline: its length, merging of repeated vertices, and sampling.
#include "lib/asset/strands.h"

#include <math.h>
#include <string.h>

#define SHORTEST 1e-5 // Minimum length of a strand, m. A tenth of a hair's own width.
#define SHORTEST_SEGMENT 1e-5 // Minimum length of a segment as a fraction of the strand's length.

static double point_distance(const float* a, const float* b)
{
    double x = (double)b[0] - a[0], y = (double)b[1] - a[1], z = (double)b[2] - a[2];
    return sqrt(x * x + y * y + z * z);
}

static void copy_vertex(float* to, const float* from)
{
    memmove(to, from, 3 * sizeof *to);
}

static void mix_points(const float* a, const float* b, double t, float* out)
{
    for (int i = 0; i < 3; ++i) out[i] = (float)(a[i] + t * ((double)b[i] - a[i]));
}

double hair_strand_length(const float* positions, uint32_t vertices)
{
    double length = 0;
    for (size_t i = 1; i < vertices; ++i)
        length += point_distance(positions + 3 * (i - 1), positions + 3 * i);
    return length;
}

uint32_t hair_strand_merge(float* positions, uint32_t vertices)
{
    // A second round finds vertices only where rounding of the length decides.
    for (;;) {
        double min = SHORTEST_SEGMENT * hair_strand_length(positions, vertices);
        uint32_t kept = vertices ? 1 : 0;
        for (size_t i = 1; i < vertices; ++i)
            if (point_distance(positions + 3 * ((size_t)kept - 1), positions + 3 * i) >= min)
                copy_vertex(positions + 3 * (size_t)kept++, positions + 3 * i);
        HAIR_ASSERT(kept <= vertices);
        if (kept == vertices) return kept;
        vertices = kept;
    }
}

void hair_strand_resample(const float* positions, uint32_t vertices, float* out, uint32_t count)
{
    HAIR_ASSERT(vertices >= 2 && count >= 2 && positions != out);
    double step = hair_strand_length(positions, vertices) / (count - 1);
    double start = 0; // Distance from the root at which `segment` starts.
    uint32_t segment = 0;
    double length = point_distance(positions, positions + 3);
    for (uint32_t i = 0; i + 1 < count; ++i) {
        double at = step * i;
        while (at > start + length && segment + 2 < vertices) {
            start += length;
            ++segment;
            length = point_distance(positions + 3 * (size_t)segment, positions + 3 * ((size_t)segment + 1));
        }
        HAIR_ASSERT(segment + 1 < vertices);
        double t = length > 0 ? fmin((at - start) / length, 1) : 0;
        mix_points(positions + 3 * (size_t)segment, positions + 3 * ((size_t)segment + 1), t,
                   out + 3 * (size_t)i);
    }
    copy_vertex(out + 3 * ((size_t)count - 1), positions + 3 * ((size_t)vertices - 1));
}

static uint32_t find_longest(const float* positions, uint32_t vertices)
{
    uint32_t longest = 0;
    double length = -1;
    for (uint32_t i = 0; i + 1 < vertices; ++i) {
        double own = point_distance(positions + 3 * (size_t)i, positions + 3 * ((size_t)i + 1));
        if (own > length) {
            length = own;
            longest = i;
        }
    }
    return longest;
}

void hair_strand_split(float* positions, uint32_t vertices, uint32_t count)
{
    HAIR_ASSERT(vertices >= 2 && vertices <= count);
    for (; vertices < count; ++vertices) {
        size_t longest = find_longest(positions, vertices);
        HAIR_ASSERT(longest + 1 < vertices);
        float* tail = positions + 3 * (longest + 1);
        memmove(tail + 3, tail, 3 * (vertices - longest - 1) * sizeof *tail);
        mix_points(tail - 3, tail + 3, 0.5, tail);
    }
}

bool hair_strand_is_fit(const float* positions, uint32_t vertices)
{
    double length = hair_strand_length(positions, vertices);
    if (!(length >= SHORTEST)) return false;
    for (size_t i = 1; i < vertices; ++i)
        if (point_distance(positions + 3 * (i - 1), positions + 3 * i) < SHORTEST_SEGMENT * length)
            return false;
    return true;
}
