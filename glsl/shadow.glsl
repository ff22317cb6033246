// shadow.glsl - how much of a light comes through the hair and past the bodies in front of a point: exponential in the
// depth of what its shadow map says lies between (Beer 1852), averaged over taps around it.
#include "draw_params.glsl"

layout(binding = HAIR_UNIT_SHADOW) uniform sampler2D shadow_texture[HAIR_SHADOW_MAPS];

#define SHADOW_TAPS 8
#define SHADOW_RADIUS 5.0 // texels

const mat2 GOLDEN_TURN = mat2(-0.7373688, 0.6754903, -0.6754903, -0.7373688); // by 2.399963 radians

// x: share that meets no strand on its way; yzw: shares that come through if each strand that is met takes as much as
// `taken` of it. met: strands that are met.
vec4 light_through(uint number, vec3 position, uint seed, vec3 taken, out float met)
{
    vec4 more = draw.light[number * HAIR_LIGHT_VECTORS + HAIR_LIGHT_MORE];
    uint map  = uint(more.w);
    met       = 0.0;
    // So many that no compiler unrolls the loop, which some do for each of the maps.
    int taps = map < uint(HAIR_SHADOW_MAPS) ? SHADOW_TAPS : 0;
    if (taps == 0) return vec4(1.0);
    vec3  at    = (draw.shadow[map] * vec4(position, 1.0)).xyz;
    vec2  texel = 1.0 / vec2(textureSize(shadow_texture[map], 0));
    float angle = 6.2831853 * fract(float(seed & 1023u) * 0.618034);
    vec2  arm   = texel * vec2(cos(angle), sin(angle));
    vec4  sum   = vec4(0.0);
    for (int i = 0; i < taps; ++i) {
        // Vogel's spiral: even over the disc, turned for each strand so that no pattern shows.
        float r     = SHADOW_RADIUS * sqrt((float(i) + 0.5) / float(SHADOW_TAPS));
        float depth = textureLod(shadow_texture[map], at.xy + r * arm, 0.0).r;
        float n     = more.z * max(at.z - depth, 0.0);
        sum += exp(-n * vec4(1.0, taken));
        met += n;
        arm = GOLDEN_TURN * arm;
    }
    met /= float(SHADOW_TAPS);
    return sum / float(SHADOW_TAPS);
}
