// packed_rods.h - rods in the layout of the shaders, which hold no more than a scheme reads.
#ifndef HAIR_ROD_PACKED_RODS_H
#define HAIR_ROD_PACKED_RODS_H

#include "lib/rod/rod.h"

// Optional members of packed rods. See glsl/sim/rod_buffers.glsl.
struct hair_rod_parts {
    bool has_factor_euler; // True for the scheme of straight rods, and for follow.
    bool has_factor; // True if in addition no reduction replaces the factors.
    bool has_pins; // True if vertices are pinned.
};

// Return the number of vectors of packed rods.
size_t hair_rods_packed_count(uint32_t guides, uint32_t vertices, struct hair_rod_parts parts);

// Pack the rods of a guide with the given index. `rod` has the vertices of the guide. `out` has
// those of all `guides`.
void hair_rods_pack(const struct hair_guide* guide, uint32_t index, uint32_t guides, uint32_t vertices,
                    const struct hair_rod* rod, struct hair_rod_parts parts, hair_vec4* out);

#endif
