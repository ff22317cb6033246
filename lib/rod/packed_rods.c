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

void hair_rods_pack(const struct hair_guide* guide, uint32_t first, uint32_t count, uint32_t guides,
                    uint32_t vertices, const struct hair_rod* rod, struct hair_rod_parts parts,
                    hair_vec4* out)
{
    hair_vec4 *of_guide = out + 2 * (size_t)vertices + first, *euler = out + 2 * (size_t)vertices + guides;
    hair_vec4* factor = euler + vertices;
    struct hair_rod_parts before = parts;
    before.has_pins = false;
    float* pin = &out[hair_rods_packed_count(guides, vertices, before)].x;
    HAIR_ASSERT(count > 0 && first + count <= guides && (parts.has_factor_euler || !parts.has_factor));
    for (uint32_t g = 0; g < count; ++g) {
        const struct hair_rod *root = rod + guide[g].first, *tip = root + guide[g].count - 1;
        of_guide[g] = root->factor_euler;
        of_guide[g].w = tip->factor_euler.w;
        for (uint32_t i = guide[g].first; i < guide[g].first + guide[g].count; ++i) {
            out[2 * (size_t)i] = rod[i].strain;
            out[2 * (size_t)i + 1] = rod[i].segment;
            if (parts.has_factor_euler) euler[i] = rod[i].factor_euler;
            if (parts.has_factor) factor[i] = rod[i].factor;
            if (parts.has_pins) pin[i] = rod[i].factor.w;
        }
    }
}
