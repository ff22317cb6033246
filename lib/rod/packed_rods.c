// packed_rods.c - rods in the layout of glsl/sim/rod_buffers.glsl.
#include "lib/rod/packed_rods.h"

#define PINS_OF_VECTOR 4

size_t hair_rods_packed_count(uint32_t guides, uint32_t vertices, struct hair_rod_parts parts)
{
    size_t count = 2 * (size_t)vertices + guides;
    if (parts.has_factor_euler) count += vertices;
    if (parts.has_factor) count += vertices;
    return parts.has_pins ? count + (vertices + PINS_OF_VECTOR - 1) / PINS_OF_VECTOR : count;
}

void hair_rods_pack(const struct hair_guide* guide, uint32_t index, uint32_t guides, uint32_t vertices,
                    const struct hair_rod* rod, struct hair_rod_parts parts, hair_vec4* out)
{
    hair_vec4 *of_guide = out + 2 * (size_t)vertices + index, *euler = out + 2 * (size_t)vertices + guides;
    hair_vec4* factor = euler + vertices;
    struct hair_rod_parts before = parts;
    before.has_pins = false;
    float* pin = &out[hair_rods_packed_count(guides, vertices, before)].x;
    HAIR_ASSERT(index < guides && (parts.has_factor_euler || !parts.has_factor));
    *of_guide = rod->factor_euler;
    of_guide->w = rod[guide->count - 1].factor_euler.w;
    for (uint32_t k = 0, i = guide->first; k < guide->count; ++k, ++i) {
        out[2 * (size_t)i] = rod[k].strain;
        out[2 * (size_t)i + 1] = rod[k].segment;
        if (parts.has_factor_euler) euler[i] = rod[k].factor_euler;
        if (parts.has_factor) factor[i] = rod[k].factor;
        if (parts.has_pins) pin[i] = rod[k].factor.w;
    }
}
