// resolve_tiles.frag - composition of what raster.comp found, sample by sample: the depth, and the
// colour of the visible segment. The colour is interpolated between shaded vertices, as it is on a
// drawn ribbon.
#version 450 core
#include "draw/raster.glsl"

#ifdef HAIR_DEPTH
layout(std430, binding = HAIR_BIND_NEAREST) readonly restrict buffer nearest_buffer { uint nearest[]; };
#define DEPTH(at) nearest[at]
#else
layout(std430, binding = HAIR_BIND_NEAREST) readonly restrict buffer nearest_buffer { uvec2 nearest[]; };
#define DEPTH(at) nearest[at].y
layout(binding = HAIR_UNIT_SHADED) uniform samplerBuffer shaded_texture;
layout(location = 0) out vec4 color;

vec4 color_of(uint segment, vec2 place)
{
    raster_ribbon r = ribbon_of(segment);
    float fraction, depth, width;
    bool  is_there;
    sees(outline_of(r), place, fraction, depth);
    vec2  w = mix(vec2(r.middle[0].w), vec2(r.middle[1].w), r.seen);
    // Fraction along the strand, from the fraction along the picture.
    float there = fraction * w.x / mix(w.y, w.x, fraction);
    int   at = vertex_of(segment, width, is_there);
    return mix(texelFetch(shaded_texture, at), texelFetch(shaded_texture, at + 1),
               mix(r.seen.x, r.seen.y, there));
}
#endif

void main()
{
    uvec2 pixel  = uvec2(gl_FragCoord.xy) - uvec2(raster.first_x, raster.first_y);
    uint  number = raster.samples > 1u ? uint(gl_SampleID) : 0u;
    uint  at     = (pixel.y * raster.columns + pixel.x) * raster.samples + number;
    if (pixel.x >= raster.columns || pixel.y >= raster.rows || DEPTH(at) == HAIR_NOBODY) discard;
    gl_FragDepth = raster.depth_from + raster.depth_by * uintBitsToFloat(DEPTH(at) ^ raster.flips);
#ifndef HAIR_DEPTH
    color = color_of(nearest[at].x, vec2(pixel) + sample_at(number));
#endif
}
