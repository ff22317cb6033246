// raster_clear.comp - clearing of all samples, and of the commands that draw the tiles with hair. A
// thread clears vectors of four numbers, because the length of the buffer is a multiple of four.
#version 450 core
#include "workgroup.glsl"
#include "draw/raster_params.glsl"
layout(local_size_x = HAIR_GROUP_SIZE) in;

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

// Return number i of the commands before anything is drawn.
uint command_number(uint i, uint heads)
{
#ifdef HAIR_BATCH
    own_head = min(i / HAIR_TILE_FIRST, heads - 1u);
    uint start = HAIR_TILE_CORNERS * draw.first_tile;
#else
    uint start = 0u;
#endif
    uint k = i % HAIR_TILE_FIRST;
    return k == HAIR_TILE_INSTANCES ? 1u : k == HAIR_TILE_START ? start : 0u;
}

void main()
{
    uint first = HAIR_CLEARED_BY_GROUP * hair_group() + gl_LocalInvocationID.x;
#ifdef HAIR_BATCH
    uint samples = batch[0].samples, heads = batch[0].heads;
#else
    uint samples = raster.columns * raster.rows * raster.samples, heads = 1u;
#endif
    for (uint n = 0u; n < HAIR_CLEARED_BY_GROUP; n += HAIR_GROUP_SIZE) {
        uint i = first + n;
        if (i < heads * HAIR_TILE_FIRST) tile[i] = command_number(i, heads);
        if (4u * i < samples * NUMBERS) nearest[i] = uvec4(NONE);
    }
}
