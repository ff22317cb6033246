// resolve_tiles.vert - the tiles of the picture that contain hair, as two triangles each.
#version 450 core
#include "draw/raster_params.glsl"

#ifdef HAIR_BATCH
#define TILES (uint(HAIR_BATCH_HEADS) * HAIR_TILE_FIRST)
flat out uint head_of_tile;
#else
#define TILES HAIR_TILE_FIRST
#endif
layout(binding = HAIR_UNIT_TILE) uniform usamplerBuffer tile_texture;

void main()
{
    int  place  = gl_VertexID / int(HAIR_TILE_CORNERS);
    uint number = texelFetch(tile_texture, int(TILES) + place).x;
#ifdef HAIR_BATCH
    own_head = head_of_tile = number >> HAIR_BATCH_TILE_BITS;
    number &= (1u << HAIR_BATCH_TILE_BITS) - 1u;
#endif
    uint corner = uint(gl_VertexID) % HAIR_TILE_CORNERS;
    corner      = corner < 3u ? corner : corner - 2u;
    uvec2 tile  = uvec2(number % raster.across, number / raster.across) + uvec2(corner & 1u, corner >> 1u);
    vec2  fraction = min(vec2(tile * HAIR_RASTER_TILE) / vec2(raster.columns, raster.rows), 1.0);
    gl_Position    = vec4(mix(raster.part.xy, raster.part.zw, fraction), 0.0, 1.0);
}
