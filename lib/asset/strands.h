// strands.h - strands as plain arrays, and the functions that make imported strands valid.
#ifndef HAIR_ASSET_STRANDS_H
#define HAIR_ASSET_STRANDS_H

#include "lib/base/host.h"
#include "lib/base/math.h"

#include <stdbool.h>

#define HAIR_STRAND_MAX_VERTICES 256
#define HAIR_ATTRIBUTE_KINDS 12 // Number of values of hair_strand_attribute_kind.
#define HAIR_MAX_ATTRIBUTES 32 // Maximum of hair_groom_desc.strand_attribute_count.
#define HAIR_STRAND_COLORS 8 // Number of points with a colour, at even distances from root to tip.

struct hair_strands {
    float* positions; // xyz per vertex, root first
    uint32_t* vertices; // of each strand
    float* radii; // of each strand at its root, in the unit of the positions. NULL if unknown.
    float* colors; // linear rgb at HAIR_STRAND_COLORS points of each strand. NULL if unknown.
    uint8_t* groups; // of each strand, below HAIR_MAX_STRAND_GROUPS. NULL if all are 0.
    uint32_t strand_count;
    uint32_t vertex_count;
    // Factor of each strand, by hair_strand_attribute_kind. NULL if all are 1.
    float* factors[HAIR_ATTRIBUTE_KINDS];
    uint8_t* guides; // 1 for each strand that is a guide, otherwise 0. NULL if unknown.
};

// Range of the factors of an attribute.
struct hair_attribute_range {
    float min, max;
};
struct hair_attribute_range hair_attribute_range_of(hair_strand_attribute_kind kind);
// Return the name of a kind, such as "stiffness".
const char* hair_attribute_name_of(hair_strand_attribute_kind kind);

// Return an imported point in metres, +y up. Only proper rotations are used, so nothing is
// mirrored.
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

// Scale, rotate, thin out, repair and resample strands in place, in tasks. Shorter arrays may
// replace the given ones.
//
// Afterwards every strand has 2 to 256 finite vertices, no segment shorter than 1e-5 of its length,
// and a length of at least 10 micrometres. A value of 1 of import->strand_vertices counts as 2. A
// strand_count of 0 means that no strand is left.
hair_result hair_strands_clean(const hair_host* host, const hair_tasks* tasks, const hair_import* import,
                               struct hair_strands* strands, hair_import_stats* repairs);
void hair_strands_free(const hair_host* host, struct hair_strands* strands);

// Sample a polyline at `count` points at equal distances along it. The ends are kept. Requires
// count >= 2.
void hair_strand_resample(const float* positions, uint32_t vertices, float* out, uint32_t count);

// Return the length of a polyline.
double hair_strand_length(const float* positions, uint32_t vertices);

// Remove vertices closer to the previous one than 1e-5 of the length. Return how many are left.
uint32_t hair_strand_merge(float* positions, uint32_t vertices);

// Split the longest segments in half until there are `count` vertices.
void hair_strand_split(float* positions, uint32_t vertices, uint32_t count);

// Compute the colours at the HAIR_STRAND_COLORS points from the colours of all vertices.
void hair_strand_colors(const float* positions, uint32_t vertices, const float* colors, float* out);
// Compute the colours at the HAIR_STRAND_COLORS points from `count` colours at even distances.
void hair_strand_even_colors(const float* colors, uint32_t count, float* out);
// Interpolate the colours of the HAIR_STRAND_COLORS points at t, from 0 at the root to 1 at the
// tip.
void hair_strand_color_at(const float* colors, float t, float out[3]);
void hair_strand_reverse_colors(float* colors);
float hair_from_srgb(float c);
float hair_to_srgb(float c);

// Return whether the strand is long enough and has no segment that is too short.
bool hair_strand_is_fit(const float* positions, uint32_t vertices);

#endif
