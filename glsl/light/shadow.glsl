// shadow.glsl - the fraction of a light that passes through hair and past opaque geometry in front
// of a point.
//
// The fraction through hair is that of vertex_transmittance.comp for strand vertices, where it is
// known. Otherwise it is exponential in the depth of hair that the light's shadow map shows (Beer
// 1852), averaged over taps around the point, and fewer strands than there are. The fraction past
// opaque geometry is 0 or 1, filtered over the texels around the point.
#include "draw_params.glsl"
#include "light/shadow_map.glsl"

layout(binding = HAIR_UNIT_SHADOW) uniform sampler2D hair_shadow_map[HAIR_SHADOW_MAPS];
layout(binding = HAIR_UNIT_LIGHT) uniform usamplerBuffer light_texture;

// Return the depth in a map at a place. After a texture of an array with a variable index, Mesa's
// llvmpipe reads other textures wrongly if they were not read before. The application's text may
// read them in any order, so its programs have constant indices. They are slower on llvmpipe.
float depth_in_map(sampler2D maps[HAIR_SHADOW_MAPS], uint map, vec2 at)
{
#ifdef HAIR_USER_SHADER
    switch (map) {
    case 0u: return textureLod(maps[0], at, 0.0).r;
    case 1u: return textureLod(maps[1], at, 0.0).r;
    case 2u: return textureLod(maps[2], at, 0.0).r;
    default: return textureLod(maps[3], at, 0.0).r;
    }
#else
    return textureLod(maps[map], at, 0.0).r;
#endif
}

#define SHADOW_TAPS 8
#define SHADOW_RADIUS 5.0 // Texels.

// Rotation by the golden angle, 2.399963 radians.
const mat2 GOLDEN_TURN = mat2(-0.7373688, 0.6754903, -0.6754903, -0.7373688);

// Return the fraction of the sky, 0, or of a light, from 1, that meets no strand. y is the number
// of strands met. `strand` is a number of the vertex cache.
vec2 light_found(uint which, uint strand, float t)
{
    float at = clamp(t, 0.0, 1.0) * float(draw.segments), k = min(floor(at), float(draw.segments) - 1.0);
    int   i  = int((strand * (draw.segments + 1u) + uint(k)) * draw.light_values + which);
    vec2  a  = unpackHalf2x16(texelFetch(light_texture, i).x);
    return mix(a, unpackHalf2x16(texelFetch(light_texture, i + int(draw.light_values)).x), at - k);
}

// Return the fraction of a light that meets no strand on its way to a strand. `met` is the number
// of strands that light meets.
float light_through_strands(uint number, uint strand, float t, out float met)
{
    vec2 found = light_found(number + 1u, strand, t);
    met        = found.y;
    return found.x;
}

// Return the mean number of strands that light meets but a shadow map does not show. A texel has
// only the strand that is nearest to the light. `met` is the number of strands that the map shows.
// The constants are fitted to the fractions of HAIR_SELF_SHADOW_STRANDS.
float strands_between(float met)
{
    const float FIT_HIDDEN = 0.53, FIT_FIRST = 0.2;
    return FIT_HIDDEN * sqrt(met / (met + FIT_FIRST));
}

// Return the fraction of a light that passes through the hair in front of a point. `met` is the
// number of strands that light meets.
float light_through_depth(uint number, vec3 position, uint seed, out float met)
{
    vec4 more = draw.light[number * HAIR_LIGHT_VECTORS + HAIR_LIGHT_MORE];
    uint map  = uint(more.w);
    met       = 0.0;
    // The number of taps is not constant, because some compilers would unroll the loop for each of
    // the maps.
    int taps = map < uint(HAIR_SHADOW_MAPS) ? SHADOW_TAPS : 0;
    if (taps == 0) return 1.0;
    vec3  at    = find_place_in_map(map, position);
    vec2  texel = 1.0 / (vec2(textureSize(hair_shadow_map[map], 0)) * draw.map_part[map].zw);
    float angle = 6.2831853 * fract(float(seed & 1023u) * 0.618034),
          from_light = distance_to_light(number, position);
    vec2  arm   = texel * vec2(cos(angle), sin(angle));
    float sum   = 0.0;
    for (int i = 0; i < taps; ++i) {
        // Vogel's spiral covers the disc evenly. It is rotated per strand to hide the pattern.
        float r     = SHADOW_RADIUS * sqrt((float(i) + 0.5) / float(SHADOW_TAPS));
        vec2  tap   = find_in_part(map, at.xy + r * arm);
        float depth = depth_from_light(map, depth_in_map(hair_shadow_map, map, tap));
        float n     = more.z * max(metres_behind(number, at.z, depth, from_light), 0.0);
        sum += exp(-n);
        met += n;
        arm = GOLDEN_TURN * arm;
    }
    met /= float(SHADOW_TAPS);
    float shown = -log(clamp(sum / float(SHADOW_TAPS), 1e-6, 1.0)), between = strands_between(shown);
    met += between;
    return exp(-shown - between);
}

#ifdef HAIR_OPAQUE_SHADOWS
layout(binding = HAIR_UNIT_BODY) uniform sampler2D opaque_shadow_map[HAIR_SHADOW_MAPS];

// Return the fraction of a light that passes opaque geometry, from 3 x 3 texels with the weights of
// a quadratic B-spline. A point that is nearer to its occluder than the bias is lit. Texels are
// read one by one, because Mesa's llvmpipe aborts on gathers from arrays of textures.
float light_past_bodies(uint number, vec3 position)
{
    vec4 own = draw.light[number * HAIR_LIGHT_VECTORS + HAIR_LIGHT_MAP];
    uint map = uint(own.x);
    int  taps = map < uint(HAIR_SHADOW_MAPS) ? 9 : 0; // Not constant, as above.
    if (taps == 0) return 1.0;
    vec3  at    = find_place_in_map(map, position);
    float min_value = at.z - own.y * depth_by_metre(number, at.z, distance_to_light(number, position)),
          sum = 0.0;
    uint  part_of = uint(HAIR_SHADOW_MAPS) + map;
    vec2  size  = vec2(textureSize(opaque_shadow_map[map], 0)) * draw.map_part[part_of].zw;
    vec2  place = clamp(at.xy, -9.0, 9.0) * size;
    vec2  first = floor(place), part = place - first, rest = 1.0 - part;
    mat3x2 weight = mat3x2(0.5 * rest * rest, 0.5 + part * rest, 0.5 * part * part);
    for (int i = 0; i < taps; ++i) {
        ivec2 k = ivec2(i % 3, i / 3);
        vec2  tap   = find_in_part(part_of, (first + vec2(k) - 0.5) / size);
        float depth = depth_in_map(opaque_shadow_map, map, tap);
        sum += min_value <= depth_from_light(map, depth) ? weight[k.x].x * weight[k.y].y : 0.0;
    }
    return sum;
}
#else
float light_past_bodies(uint number, vec3 position) { return 1.0; }
#endif
