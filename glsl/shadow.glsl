// shadow.glsl - how much light comes through the hair and past the bodies in front of a point: exponential in the
// depth of what the shadow map says lies between (Beer 1852), averaged over taps around it.
#include "draw_params.glsl"

layout(binding = HAIR_UNIT_SHADOW) uniform sampler2D shadow_texture;

#define SHADOW_TAPS 8
#define SHADOW_RADIUS 5.0 // texels

const mat2 GOLDEN_TURN = mat2(-0.7373688, 0.6754903, -0.6754903, -0.7373688); // by 2.399963 radians

// x: share that meets no strand on its way; yzw: shares that come through if each strand that is met takes as much as
// `taken` of it. met: strands that are met.
vec4 light_through(vec3 position, uint seed, vec3 taken, out float met)
{
    met = 0.0;
    if (draw.light.w <= 0.0) return vec4(1.0);
    vec3  at    = (draw.shadow * vec4(position, 1.0)).xyz;
    vec2  texel = 1.0 / vec2(textureSize(shadow_texture, 0));
    float angle = 6.2831853 * fract(float(seed & 1023u) * 0.618034);
    vec2  arm   = texel * vec2(cos(angle), sin(angle));
    vec4  sum   = vec4(0.0);
    for (int i = 0; i < SHADOW_TAPS; ++i) {
        // Vogel's spiral: even over the disc, turned for each strand so that no pattern shows.
        float r     = SHADOW_RADIUS * sqrt((float(i) + 0.5) / float(SHADOW_TAPS));
        float depth = textureLod(shadow_texture, at.xy + r * arm, 0.0).r;
        float n     = draw.light.w * max(at.z - depth, 0.0);
        sum += exp(-n * vec4(1.0, taken));
        met += n;
        arm = GOLDEN_TURN * arm;
    }
    met /= float(SHADOW_TAPS);
    return sum / float(SHADOW_TAPS);
}
