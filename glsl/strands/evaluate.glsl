// evaluate.glsl - the position of a follower, by the one function that every drawing path
// evaluates. With HAIR_HITS the function takes account of followers inside colliders and of their
// repair.
#include "strands/follower.glsl"
#include "strands/repair.glsl"

layout(binding = HAIR_UNIT_HIT) uniform samplerBuffer hit_texture;
layout(binding = HAIR_UNIT_REPAIR) uniform samplerBuffer repair_texture;

vec4 repair_control(int first, int i) { return texelFetch(repair_texture, first + i); }

// Interpolate single-strand from the first vertex inside a collider on, blended over a zone above
// it (Tariq 2010).
hair_point switch_at(hair_follower follower, float t, float hit)
{
    float x = clamp((t - hit) / HAIR_SWITCH_ZONE + 1.0, 0.0, 1.0);
    float freed = x * x * (3.0 - 2.0 * x), slope = 6.0 * x * (1.0 - x) / HAIR_SWITCH_ZONE;
    return interpolate(
        follower, t,
        repair(vec3(0.0), vec3(0.0), draw.push_out_weight * freed, draw.push_out_weight * slope));
}

#ifdef HAIR_HITS
hair_point evaluate(hair_follower follower, uint number, float t)
{
    float hit = texelFetch(hit_texture, int(number)).x;
    if (hit > float(draw.segments)) return interpolate(follower, t, UNTOUCHED);
    if (draw.follower_collision == HAIR_COLLISION_IS_SINGLE_GUIDE)
        return switch_at(follower, t, hit / float(draw.segments));
    int   first = int(number) * HAIR_REPAIR_CONTROLS;
    float at    = t * (1.0 + draw.push_out_weight * repair_control(first, 0).x);
    repair r    = repair_at(first, at);
    return interpolate(follower, at,
                       repair(draw.push_out_weight * r.away, draw.push_out_weight * r.away_slope,
                              draw.push_out_weight * r.freed, draw.push_out_weight * r.freed_slope));
}
#else
hair_point evaluate(hair_follower follower, uint number, float t)
{
    return interpolate(follower, t, UNTOUCHED);
}
#endif
