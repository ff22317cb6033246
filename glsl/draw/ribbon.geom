// ribbon.geom - a segment as a ribbon that faces the eye. The ribbon has its true width, or reaches
// all pixels that it partly covers.
#version 450 core
#include "draw_params.glsl"
#include "draw/varyings.glsl"
#include "draw/ribbon.glsl"
layout(lines) in;
layout(triangle_strip, max_vertices = 4) out;

layout(location = 0) in vec4 strand_position[];
layout(location = 1) in vec3 strand_tangent[];
layout(location = 2) in vec3 strand_color[];
layout(location = 2) out vec3 ribbon_color;
#ifdef HAIR_NUMBERED
layout(location = 3) flat in uvec3 strand_numbers[];
layout(location = 4) in vec4 strand_place[];
layout(location = 0) out vec4 ribbon_position;
layout(location = 1) out vec3 ribbon_tangent;
layout(location = 3) flat out uvec3 ribbon_numbers;
layout(location = 4) out vec4 ribbon_place;
#endif
#ifdef HAIR_MOTION
layout(location = 5) in vec3 clip_now[];
layout(location = 6) in vec3 clip_before[];
layout(location = 5) out vec3 ribbon_now;
layout(location = 6) out vec3 ribbon_before;
#endif
#ifdef HAIR_ALPHA_COVERAGE
layout(location = 7) noperspective out vec4 ribbon_fraction;
#endif

void pass_on(int end, float across)
{
    ribbon_color = strand_color[end];
#ifdef HAIR_NUMBERED
    ribbon_position = strand_position[end];
    ribbon_tangent  = strand_tangent[end];
    ribbon_numbers  = strand_numbers[end];
    ribbon_place    = vec4(strand_place[end].xyz, across);
#endif
#ifdef HAIR_MOTION
    ribbon_now    = clip_now[end];
    ribbon_before = clip_before[end];
#endif
}

#ifdef HAIR_ALPHA_COVERAGE
// Return the factor by which the ribbon must be widened. `fraction` receives the vertex's
// coverage terms, see draw/coverage.glsl.
float widen(vec4 center, vec3 side, out vec4 fraction)
{
    vec4 clip = draw.view_to_clip * (draw.view * center),
         by = draw.view_to_clip * (draw.view * vec4(side, 0.0));
    vec2  pixel = 0.5 * draw.viewport.xy * (by.xy - clip.xy / clip.w * by.w) / clip.w;
    float half_ = length(pixel);
    if (!(half_ > 1e-9)) return 0.0;
    vec2 n = abs(pixel) / half_; // A square pixel seen along the strand is a trapezoid.
    fraction  = vec4(half_ + draw.viewport.z, half_, 0.5 * (n.x + n.y), 0.5 * abs(n.x - n.y));
    return fraction.x / half_;
}
#endif

void main()
{
    for (int end = 0; end < 2; ++end) {
        vec3  center = strand_position[end].xyz;
        vec3  side   = side_of(strand_position[end], strand_tangent[end]);
#ifdef HAIR_ALPHA_COVERAGE
        vec4 fraction = vec4(0.0);
        side *= widen(vec4(center, 1.0), side, fraction);
#endif
        for (int k = -1; k <= 1; k += 2) {
            pass_on(end, float(k));
#ifdef HAIR_ALPHA_COVERAGE
            ribbon_fraction = vec4(float(k) * fraction.x, fraction.yzw);
#endif
            gl_Position = draw.view_to_clip * (draw.view * vec4(center + float(k) * side, 1.0));
            EmitVertex();
        }
    }
    EndPrimitive();
}
