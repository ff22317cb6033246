// shadow.glsl - how much light comes through the hair and past the bodies in front of a point: exponential in the
// depth of what the shadow map says lies between (Beer 1852), averaged over taps around it.
#include "draw_params.glsl"

layout(binding = HAIR_UNIT_SHADOW) uniform sampler2D shadow_texture;

#define SHADOW_TAPS 8

float light_through(vec3 position, uint seed)
{
    if (draw.light.w <= 0.0) return 1.0;
    vec3  at    = (draw.shadow * vec4(position, 1.0)).xyz;
    vec2  texel = 1.0 / vec2(textureSize(shadow_texture, 0));
    float angle = 6.2831853 * fract(float(seed & 1023u) * 0.618034);
    float sum   = 0.0;
    for (int i = 0; i < SHADOW_TAPS; ++i) {
        // Vogel's spiral: even over the disc, turned for each strand so that no pattern shows.
        float r     = 5.0 * sqrt((float(i) + 0.5) / float(SHADOW_TAPS));
        float theta = angle + 2.399963 * float(i);
        float depth = textureLod(shadow_texture, at.xy + r * texel * vec2(cos(theta), sin(theta)), 0.0).r;
        sum += exp(-draw.light.w * max(at.z - depth, 0.0));
    }
    return sum / float(SHADOW_TAPS);
}
