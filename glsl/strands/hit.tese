// hit.tese - the first vertex of each follower that is inside a collider, by the method of Tariq
// 2010. Every vertex is drawn as a point. All points of a follower go to one texel, where MIN
// blending keeps the smallest number.
#version 450 core
#include "strands/follower.glsl"
#include "field.glsl"
layout(isolines, equal_spacing, point_mode) in;

layout(location = 0) patch in uvec4 lines;

layout(location = 0) flat out float found;

void main()
{
    uint  line    = uint(gl_TessCoord.y * float(lines.y) + 0.5);
    uint  k       = lines.z + uint(gl_TessCoord.x * float(lines.w) + 0.5);
    uint  number  = lines.x + line;
    uvec2 texel   = uvec2(number % HAIR_HIT_COLUMNS, number / HAIR_HIT_COLUMNS);
    vec2  size    = vec2(HAIR_HIT_COLUMNS, (draw.followers + HAIR_HIT_COLUMNS - 1u) / HAIR_HIT_COLUMNS);
    vec3  p       = interpolate(fetch_follower(number), float(k) / float(draw.segments), UNTOUCHED).position;
    found         = k > 0u && field_distance(p) < 0.0 ? float(k) : HAIR_NO_HIT;
    gl_Position   = vec4((vec2(texel) + 0.5) / size * 2.0 - 1.0, 0.0, 1.0);
}
