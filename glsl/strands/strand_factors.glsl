// strand_factors.glsl - factors by which the looks of single strands differ from those of their
// groups.
#ifndef HAIR_STRAND_FACTORS_GLSL
#define HAIR_STRAND_FACTORS_GLSL

#include "draw_params.glsl"

#ifdef HAIR_STRAND_FACTORS
layout(binding = HAIR_UNIT_STRAND_FACTOR) uniform samplerBuffer factor_texture;

// Return a factor of a follower. The buffer has only the factors in use. The slots have 4 bits
// each: the place of a factor beside the others of its follower, from 1, or 0 if all are 1.
float strand_factor(uint number, int factor)
{
    uint slot = draw.strand.factor_slots >> 4 * factor & 15u;
    if (slot == 0u) return 1.0;
    return texelFetch(factor_texture, int(number * draw.strand.factor_count + slot - 1u)).x;
}

// Number of the follower that was fetched last.
uint fetched = 0u;

void note_fetched(uint number) { fetched = number; }
#define STRAND_FACTOR(factor) strand_factor(fetched, factor)
#define VARIANCE_FACTOR(number) strand_factor(number, HAIR_FACTOR_VARIANCE)
#else
void note_fetched(uint number) {}
#define STRAND_FACTOR(factor) 1.0
#define VARIANCE_FACTOR(number) 1.0
#endif

#endif
