// strand.frag - a pixel of a strand: its colour, or its numbers or velocity in place of the colour.
// With HAIR_MOTION_OUTPUT the velocity is beside the colour.
#version 450 core
#include "draw_params.glsl"
#include "eye.glsl"
#include "draw/varyings.glsl"
#ifdef HAIR_MOTION
#include "draw/motion.glsl"
#endif
#if !defined(HAIR_IDS) && (!defined(HAIR_MOTION) || defined(HAIR_MOTION_OUTPUT))
#include "draw/encode.glsl"
#endif
#ifdef HAIR_USER_PIXELS
#include "light/shading.glsl"
#endif

layout(location = 2) in vec3 strand_color;
#ifdef HAIR_NUMBERED
layout(location = 0) in vec4 strand_position;
layout(location = 1) in vec3 strand_tangent;
layout(location = 3) flat in uvec3 strand_numbers;
layout(location = 4) in vec4 strand_place;
#endif
#ifdef HAIR_MOTION
layout(location = 5) in vec3 clip_now;
layout(location = 6) in vec3 clip_before;
#endif
#ifdef HAIR_ALPHA_COVERAGE
#include "draw/coverage.glsl"
layout(location = 7) noperspective in vec4 strand_fraction;
#endif

#ifdef HAIR_IDS
layout(location = 0) out uvec4 color;

void main()
{
    color = uvec4(strand_numbers.xy + 1u, uint(clamp(strand_place.x, 0.0, 1.0) * 65535.0 + 0.5), 0u);
}
#elif defined(HAIR_MOTION) && !defined(HAIR_MOTION_OUTPUT)
layout(location = 0) out vec4 color;

void main() { color = motion_between(clip_before, clip_now); }
#else
layout(location = 0) out vec4 color;
#ifdef HAIR_MOTION
layout(location = 1) out vec4 motion;
#endif

#ifdef HAIR_USER_PIXELS
vec4 shade_pixel()
{
    hair_fragment f;
    f.position = strand_position.xyz;
    f.tangent  = normalize(strand_tangent);
    f.to_eye   = normalize(towards_eye(draw.eye, f.position));
    f.t        = clamp(strand_place.x, 0.0, 1.0);
    f.uv       = strand_place.yz;
    f.across   = clamp(strand_place.w, -1.0, 1.0);
    f.color    = max(strand_color, 0.0);
    f.strand   = strand_numbers.x;
    f.cached   = strand_numbers.x;
    f.lock     = lock_of(strand_numbers.y);
    f.group    = group_of_lock(strand_numbers.y);
    f.seed     = strand_numbers.z;
    f.random   = random(f.seed + 7u);
    return hair_shade(f);
}
#else
vec4 shade_pixel() { return vec4(strand_color, 1.0); }
#endif

// Write the colour. If a segment covers a pixel but not its centre, colours are extrapolated. They
// may then be negative, or exceed what half-float formats hold.
void main()
{
    vec4 shaded = shade_pixel();
    color       = min(mix(vec4(0.0), shaded, greaterThan(shaded, vec4(0.0))), HAIR_MAX_LIGHT);
    color.rgb   = encode_color(color.rgb, draw.encode);
#ifdef HAIR_ALPHA_COVERAGE
    color *= coverage_of(strand_fraction) * draw.viewport.w;
#endif
#ifdef HAIR_MOTION
    motion = motion_between(clip_before, clip_now);
#ifdef HAIR_ALPHA_COVERAGE
    motion *= color.a; // Blended like the colour.
#endif
#endif
}
#endif
