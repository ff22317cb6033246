// strand_color.glsl - the colour of a strand along its length, and random variation of its colour,
// its roughness and the tilt of its scales.
#include "draw_params.glsl"
#include "random.glsl"

#define SPARKLES 48.0 // Along a strand.

float spread(float by, float random_) { return 1.0 + by * (2.0 * random_ - 1.0); }

// Return whether a strand is a streak. Either all strands of a lock decide together, or each strand
// decides by itself.
bool is_streak(uint seed, uint lock)
{
    bool together = random(seed + 8u) < draw.tint.streak_clumping;
    return random(together ? lock + 0x2c1b3c6du : seed + 9u) < draw.tint.streak.w;
}

vec3 ramp_at(float t)
{
    float along = t * float(HAIR_CURVE_INTERVALS);
    int   k     = min(int(along), HAIR_CURVE_INTERVALS - 1);
    return mix(draw.tint.ramp[k].rgb, draw.tint.ramp[k + 1].rgb, along - float(k));
}

// Return the colour of a strand at t with its random variation. `bright` is the strand's own random
// number for brightness. `color` is its colour without the variation.
vec3 tint_of(uint seed, uint lock, float t, float bright, vec3 color)
{
    if (is_streak(seed, lock)) color = draw.tint.streak.rgb;
    float red = draw.tint.hue * (2.0 * random(seed + 10u) - 1.0);
    color *= vec3(1.0 + red, 1.0, 1.0 - red);
    float back = clamp(t * draw.tint.root_recovery, 0.0, 1.0);
    float lost = draw.tint.root_darkening * (1.0 - back * back * (3.0 - 2.0 * back));
    return color * ((1.0 - lost) * spread(draw.tint.brightness, bright));
}

// Return the factor of the tilt of a strand's scales.
float tilt_of(float random_) { return spread(draw.tint.tilt, random_); }

// Return the factor of the variance of a strand's longitudinal lobes.
float variance_of(uint seed)
{
    float rough = max(spread(draw.tint.roughness, random(seed + 11u)), 0.2);
    return rough * rough;
}

// Return the factor of glints at t, in [0, 2]. It is a smooth random number along the strand.
float sparkle_at(uint seed, float t)
{
    float at = t * SPARKLES, k = floor(at), x = at - k;
    float a = random(seed + 0x68bc21ebu + uint(k)), b = random(seed + 0x68bc21ecu + uint(k));
    return spread(draw.tint.sparkle, mix(a, b, x * x * (3.0 - 2.0 * x)));
}
