// strands.h - strands as plain arrays, and the one place where foreign ones are made fit.
#ifndef HAIR_ASSET_STRANDS_H
#define HAIR_ASSET_STRANDS_H

#include "lib/base/host.h"
#include "lib/base/math.h"

#include <stdbool.h>

#define HAIR_STRAND_MAX_VERTICES 256
#define HAIR_STRAND_COLORS 8 // even places from root to tip

struct hair_strands {
    float* positions; // xyz per vertex, root first
    uint32_t* vertices; // of each strand
    float* radii; // of each strand at its root, in the unit of the positions; NULL: none known
    float* colors; // linear rgb at HAIR_STRAND_COLORS places of each strand; NULL: none known
    uint32_t strand_count;
    uint32_t vertex_count;
};

// A foreign point in metres, +y up. Proper rotations: nothing is mirrored.
static inline hair_vec3 hair_import_point(const hair_import* import, hair_vec3 p)
{
    hair_vec3 q = hair_scale(p, import->scale);
    switch (import->up) {
    case HAIR_UP_Z: return hair_v3(q.x, q.z, -q.y);
    case HAIR_UP_X: return hair_v3(-q.y, q.x, q.z);
    case HAIR_UP_Y: break;
    }
    return q;
}

// Scale, turn, thin out, repair and resample strands in place (the arrays may be replaced by shorter ones).
// Afterwards every strand has 2 to 256 finite vertices, no segment shorter than 1e-5 of its length, and a
// length of at least 10 micrometres. import->strand_vertices of 1 is taken as 2. It may be that no strand is
// left: strand_count 0.
hair_result hair_strands_clean(const hair_host* host, const hair_import* import, struct hair_strands* strands,
                               hair_repairs* repairs);
void hair_strands_free(const hair_host* host, struct hair_strands* strands);

// Of a polyline: `count` points at equal distances along it, the ends kept. count >= 2.
void hair_strand_resample(const float* positions, uint32_t vertices, float* out, uint32_t count);

// Length of a polyline.
double hair_strand_length(const float* positions, uint32_t vertices);

// Remove vertices nearer to the one before than 1e-5 of the length. Returns how many are left.
uint32_t hair_strand_merge(float* positions, uint32_t vertices);

// Split the longest segments in half until there are `count` vertices.
void hair_strand_split(float* positions, uint32_t vertices, uint32_t count);

// colors.c: of colours of each vertex, or of `count` even places, those of HAIR_STRAND_COLORS; of these, the one at t.
void hair_strand_colors(const float* positions, uint32_t vertices, const float* colors, float* out);
void hair_strand_even_colors(const float* colors, uint32_t count, float* out);
void hair_strand_color_at(const float* colors, float t, float out[3]);
void hair_strand_reverse_colors(float* colors);
float hair_from_srgb(float c);
float hair_to_srgb(float c);

// Whether it is long enough and no segment of it too short.
bool hair_strand_is_fit(const float* positions, uint32_t vertices);

#endif
