// tint.glsl - what colour a strand has along it, and what chance makes of its colour, its roughness and its scales.
#include "draw_params.glsl"
#include "random.glsl"

#define SPARKLES 48.0 // along a strand

float spread(float by, float random_) { return 1.0 + by * (2.0 * random_ - 1.0); }

// Strands of a lock have what it has, or each its own.
bool is_streak(uint seed, uint lock)
{
    bool together = random(seed + 8u) < draw.tint.streak_locks;
    return random(together ? lock + 0x2c1b3c6du : seed + 9u) < draw.tint.streak.w;
}

vec3 ramp_at(float t)
{
    float along = t * float(HAIR_CURVE_INTERVALS);
    int   k     = min(int(along), HAIR_CURVE_INTERVALS - 1);
    return mix(draw.tint.ramp[k].rgb, draw.tint.ramp[k + 1].rgb, along - float(k));
}

// `bright`: the strand's own random number for that. `color`: what it has at t before chance.
vec3 tint_of(uint seed, uint lock, float t, float bright, vec3 color)
{
    if (is_streak(seed, lock)) color = draw.tint.streak.rgb;
    float red = draw.tint.hue * (2.0 * random(seed + 10u) - 1.0);
    color *= vec3(1.0 + red, 1.0, 1.0 - red);
    float back = clamp(t * draw.tint.root_recovery, 0.0, 1.0);
    float lost = draw.tint.root_shade * (1.0 - back * back * (3.0 - 2.0 * back));
    return color * ((1.0 - lost) * spread(draw.tint.brightness, bright));
}

// As a multiple, of the tilt of its scales; and of the variance of its lobes along it.
float tilt_of(float random_) { return spread(draw.tint.tilt, random_); }

float variance_of(uint seed)
{
    float rough = max(spread(draw.tint.roughness, random(seed + 11u)), 0.2);
    return rough * rough;
}

// What glitters, from 0 to 2: a smooth random number along the strand.
float sparkle_at(uint seed, float t)
{
    float at = t * SPARKLES, k = floor(at), x = at - k;
    float a = random(seed + 0x68bc21ebu + uint(k)), b = random(seed + 0x68bc21ecu + uint(k));
    return spread(draw.tint.sparkle, mix(a, b, x * x * (3.0 - 2.0 * x)));
}
