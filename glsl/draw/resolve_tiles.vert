// resolve_tiles.vert - the tiles of the picture that contain hair, as two triangles each.
#version 450 core
#include "shared.h"

layout(std140, binding = HAIR_BIND_RASTER) uniform raster_buffer { hair_raster_params raster; };
layout(binding = HAIR_UNIT_TILE) uniform usamplerBuffer tile_texture;

void main()
{
    int  place  = gl_VertexID / int(HAIR_TILE_CORNERS);
    uint number = texelFetch(tile_texture, int(HAIR_TILE_FIRST) + place).x;
    uint corner = uint(gl_VertexID) % HAIR_TILE_CORNERS;
    corner      = corner < 3u ? corner : corner - 2u;
    uvec2 tile  = uvec2(number % raster.across, number / raster.across) + uvec2(corner & 1u, corner >> 1u);
    vec2  fraction = min(vec2(tile * HAIR_RASTER_TILE) / vec2(raster.columns, raster.rows), 1.0);
    gl_Position    = vec4(mix(raster.part.xy, raster.part.zw, fraction), 0.0, 1.0);
}
