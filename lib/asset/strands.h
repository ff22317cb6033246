// strands.h - strands as plain arrays, and the one place where foreign ones are made fit.
#ifndef HAIR_ASSET_STRANDS_H
#define HAIR_ASSET_STRANDS_H

#include "lib/base/host.h"

#define HAIR_STRAND_MAX_VERTICES 256

struct hair_strands {
    float*    positions; // xyz per vertex, root first
    uint32_t* vertices;  // of each strand
    float*    radii;     // of each strand, m; NULL: none known
    uint32_t  strand_count;
    uint32_t  vertex_count;
};

// Scale, turn, thin out, repair and resample strands in place (the arrays may be replaced by shorter ones).
// Afterwards every strand has 2 to 256 finite vertices, no segment shorter than 1e-5 of its length, and a
// length of at least 10 micrometres. No strand at all may be left: strand_count 0.
hair_result hair_strands_clean(const hair_host* host, const hair_import* import, struct hair_strands* strands,
                               hair_repairs* repairs);
void        hair_strands_free(const hair_host* host, struct hair_strands* strands);

// Of a polyline: `count` points at equal distances along it, the ends kept. count >= 2.
void hair_strand_resample(const float* positions, uint32_t vertices, float* out, uint32_t count);

#endif
