// raster_clear.comp - clearing of all samples, and of the command that draws the tiles with hair. A
// thread clears four numbers, because the length of the buffer is a multiple of four.
#version 450 core
#include "workgroup.glsl"
#include "shared.h"
layout(local_size_x = HAIR_GROUP_SIZE) in;

layout(std140, binding = HAIR_BIND_RASTER) uniform raster_buffer { hair_raster_params raster; };
layout(std430, binding = HAIR_BIND_NEAREST) writeonly restrict buffer nearest_buffer { uvec4 nearest[]; };
layout(std430, binding = HAIR_BIND_TILE) writeonly restrict buffer tile_buffer { uint tile[]; };

#ifdef HAIR_DEPTH
#define NUMBERS 1u // Numbers per sample.
#else
#define NUMBERS 2u
#endif
#ifdef HAIR_ALPHA_COVERAGE
#define NONE 0u
#else
#define NONE HAIR_NOBODY
#endif

void main()
{
    uint i = hair_group() * HAIR_GROUP_SIZE + gl_LocalInvocationID.x;
    if (i < HAIR_TILE_FIRST) tile[i] = i == HAIR_TILE_INSTANCES ? 1u : 0u;
    if (4u * i < raster.columns * raster.rows * raster.samples * NUMBERS) nearest[i] = uvec4(NONE);
}
