// resolve_tiles.frag - composition of what raster.comp found, sample by sample: the depth, and the
// colour between two shaded vertices, as it is on a drawn ribbon, with HAIR_MOTION_OUTPUT also the
// motion between two vertices of the vertex cache. With HAIR_ALPHA_COVERAGE it is
// the opacity of all ribbons in a pixel.
#version 450 core
#include "draw/raster_params.glsl"

#ifdef HAIR_BATCH
flat in uint head_of_tile;
#endif
#ifdef HAIR_DEPTH
layout(std430, binding = HAIR_BIND_NEAREST) readonly restrict buffer nearest_buffer { uint nearest[]; };
#define NUMBER(at) nearest[at]
#else
layout(std430, binding = HAIR_BIND_NEAREST) readonly restrict buffer nearest_buffer { uvec2 nearest[]; };
#define NUMBER(at) nearest[at].y
layout(binding = HAIR_UNIT_SHADED) uniform samplerBuffer shaded_texture;
#endif

#ifdef HAIR_ALPHA_COVERAGE
layout(location = 0) out vec4 opacity;

void write(uint at)
{
    if (NUMBER(at) == 0u) discard;
    opacity = vec4(1.0 - exp2(float(NUMBER(at)) / -HAIR_OPACITY_SCALE));
}
#else
#ifndef HAIR_DEPTH
#include "draw/encode.glsl"

layout(location = 0) out vec4 color;
#endif

#ifdef HAIR_MOTION_OUTPUT
#include "draw_params.glsl"
#include "draw/motion.glsl"

layout(binding = HAIR_UNIT_CACHED_POSITION) uniform samplerBuffer cached_position_texture;
layout(binding = HAIR_UNIT_BEFORE) uniform samplerBuffer before_texture;
layout(location = 1) out vec4 motion;

vec4 motion_at(int vertex, float fraction)
{
    vec3 now    = mix(texelFetch(cached_position_texture, vertex).xyz,
                      texelFetch(cached_position_texture, vertex + 1).xyz, fraction);
    vec3 before = mix(texelFetch(before_texture, vertex).xyz, texelFetch(before_texture, vertex + 1).xyz,
                      fraction);
    return motion_between((draw.before_to_clip * vec4(before, 1.0)).xyw,
                          (draw.now_to_clip * vec4(now, 1.0)).xyw);
}
#endif

void write(uint at)
{
    if (NUMBER(at) == HAIR_NOBODY) discard;
    gl_FragDepth = raster.depth_from + raster.depth_by * uintBitsToFloat(NUMBER(at) ^ raster.flips);
#ifndef HAIR_DEPTH
    uint  place    = nearest[at].x;
    int   vertex   = first_vertex() + int(place >> raster.fraction_bits);
    float steps    = float(1u << raster.fraction_bits);
    float fraction = (float(place & ((1u << raster.fraction_bits) - 1u)) + 0.5) / steps;
    color = mix(texelFetch(shaded_texture, vertex), texelFetch(shaded_texture, vertex + 1), fraction);
    color.rgb = encode_color(color.rgb, raster.encode);
#ifdef HAIR_MOTION_OUTPUT
    motion = motion_at(vertex, fraction);
#endif
#endif
}
#endif

void main()
{
#ifdef HAIR_BATCH
    own_head = head_of_tile;
#endif
    uvec2 pixel = uvec2(gl_FragCoord.xy) - uvec2(raster.first_x, raster.first_y);
    if (pixel.x >= raster.columns || pixel.y >= raster.rows) discard;
    write(first_sample() + (pixel.y * raster.columns + pixel.x) * raster.samples +
          (raster.samples > 1u ? uint(gl_SampleID) % raster.samples : 0u));
}
