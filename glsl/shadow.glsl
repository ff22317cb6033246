// shadow.glsl - how much of a light comes through the hair and past the bodies in front of a point. Through hair as light.comp
// has found it for vertices of strands; else exponential in the depth of what the light's shadow map says lies between (Beer
// 1852), averaged over taps around it. Past bodies all or nothing, smoothly over the texels around.
#include "draw_params.glsl"
#include "maps.glsl"

layout(binding = HAIR_UNIT_SHADOW) uniform sampler2D shadow_texture[HAIR_SHADOW_MAPS];
layout(binding = HAIR_UNIT_LIGHT) uniform usamplerBuffer light_texture;

#define SHADOW_TAPS 8
#define SHADOW_RADIUS 5.0 // texels

const mat2 GOLDEN_TURN = mat2(-0.7373688, 0.6754903, -0.6754903, -0.7373688); // by 2.399963 radians

// Of the sky (0) or a light (from 1): the share that meets no strand, and how many are met.
vec2 light_found(uint which, uint strand, float t)
{
    float at = clamp(t, 0.0, 1.0) * float(draw.segments), k = min(floor(at), float(draw.segments) - 1.0);
    int   i  = int((strand * (draw.segments + 1u) + uint(k)) * draw.lit + which);
    vec2  a  = unpackHalf2x16(texelFetch(light_texture, i).x);
    return mix(a, unpackHalf2x16(texelFetch(light_texture, i + int(draw.lit)).x), at - k);
}

// x: share that meets no strand on its way; yzw: shares that come through if each strand that is met takes as much as
// `taken` of it. met: strands that are met, of which a Poisson process has at least one where light meets any.
vec4 light_through_strands(uint number, uint strand, float t, vec3 taken, out float met)
{
    vec2  found = light_found(number + 1u, strand, t);
    float none  = exp(-found.y);
    vec3  if_any = found.y > 1e-3 ? (exp(-found.y * taken) - none) / (1.0 - none) : 1.0 - taken;
    met          = found.y;
    return vec4(found.x, found.x + (1.0 - found.x) * if_any);
}

vec4 light_through_depth(uint number, vec3 position, uint seed, vec3 taken, out float met)
{
    vec4 more = draw.light[number * HAIR_LIGHT_VECTORS + HAIR_LIGHT_MORE];
    uint map  = uint(more.w);
    met       = 0.0;
    // So many that no compiler unrolls the loop, which some do for each of the maps.
    int taps = map < uint(HAIR_SHADOW_MAPS) ? SHADOW_TAPS : 0;
    if (taps == 0) return vec4(1.0);
    vec3  at    = place_in_map(map, position);
    vec2  texel = 1.0 / vec2(textureSize(shadow_texture[map], 0));
    float angle = 6.2831853 * fract(float(seed & 1023u) * 0.618034), from_light = distance_to_light(number, position);
    vec2  arm   = texel * vec2(cos(angle), sin(angle));
    vec4  sum   = vec4(0.0);
    for (int i = 0; i < taps; ++i) {
        // Vogel's spiral: even over the disc, turned for each strand so that no pattern shows.
        float r     = SHADOW_RADIUS * sqrt((float(i) + 0.5) / float(SHADOW_TAPS));
        float depth = textureLod(shadow_texture[map], at.xy + r * arm, 0.0).r;
        float n     = more.z * max(metres_behind(number, at.z, depth, from_light), 0.0);
        sum += exp(-n * vec4(1.0, taken));
        met += n;
        arm = GOLDEN_TURN * arm;
    }
    met /= float(SHADOW_TAPS);
    return sum / float(SHADOW_TAPS);
}

#ifdef HAIR_BLOCKED
layout(binding = HAIR_UNIT_BODY) uniform sampler2D body_texture[HAIR_SHADOW_MAPS];

// Of three by three texels, weighed as a quadratic B-spline has it; all that is nearer to what hides it than the bias is lit.
// By single texels: Mesa's llvmpipe aborts where arrays of textures are gathered from.
float light_past_bodies(uint number, vec3 position)
{
    vec4 own = draw.light[number * HAIR_LIGHT_VECTORS + HAIR_LIGHT_MAP];
    uint map = uint(own.x);
    int  taps = map < uint(HAIR_SHADOW_MAPS) ? 9 : 0; // As above.
    if (taps == 0) return 1.0;
    vec3  at    = place_in_map(map, position);
    float least = at.z - own.y * depth_by_metre(number, at.z, distance_to_light(number, position)), sum = 0.0;
    vec2  size  = vec2(textureSize(body_texture[map], 0)), place = clamp(at.xy, -9.0, 9.0) * size;
    vec2  first = floor(place), part = place - first, rest = 1.0 - part;
    mat3x2 weight = mat3x2(0.5 * rest * rest, 0.5 + part * rest, 0.5 * part * part);
    for (int i = 0; i < taps; ++i) {
        ivec2 k = ivec2(i % 3, i / 3);
        float depth = textureLod(body_texture[map], (first + vec2(k) - 0.5) / size, 0.0).r;
        sum += least <= depth ? weight[k.x].x * weight[k.y].y : 0.0;
    }
    return sum;
}
#else
float light_past_bodies(uint number, vec3 position) { return 1.0; }
#endif
