// contact_capsules.glsl - colliders as capsules, or as their bounding capsules, at times of a
// substep.
#include "sim/colliders.glsl"

// Fractions of the step that are done at the start and end of the substep.
float fraction_then, fraction_now;

struct capsule { // A collider at one moment, with the margin
    vec3  start, axis;
    float radius, square; // `square` is the squared length of the axis, m^2
};

capsule collider_at(uint k, float fraction)
{
    vec4 a = mix(COLLIDER_START(k, 0), COLLIDER_END(k, 0), fraction);
    vec4 b = mix(COLLIDER_START(k, 1), COLLIDER_END(k, 1), fraction);
    vec3 axis = b.xyz - a.xyz;
    return capsule(a.xyz, axis, a.w + params.collision_margin, max(dot(axis, axis), 1e-12));
}

float nearest_fraction(vec3 position, capsule collider)
{
    return clamp(dot(position - collider.start, collider.axis) / collider.square, 0.0, 1.0);
}

vec3 from_axis(vec3 position, capsule collider)
{
    return position - collider.start - nearest_fraction(position, collider) * collider.axis;
}

// Return an upper bound of how far collider k moves in the substep.
float moves_of(uint k) { return COLLIDER_SPIN(k).w * (fraction_now - fraction_then); }

// collider_then() and collider_now() return a capsule at the start and end of the substep. If a
// guide has several threads, each of them computes other capsules, once per moment. A capsule
// written by store_collider() is visible after COLLIDERS_BARRIER, and in the next substep by
// collider_then().
#if defined(HAIR_COLLIDER_GRID) || defined(HAIR_THREAD_PER_GUIDE)
#define COLLIDERS_BARRIER
void    begin_colliders() {}
void    next_colliders() {}
void    store_collider(uint k, capsule now) {}
capsule collider_then(uint k) { return collider_at(k, fraction_then); }
capsule collider_now(uint k) { return collider_at(k, fraction_now); }
#else
// find_colliders() votes before it reads the capsules.
#define COLLIDERS_BARRIER VOTE_BARRIER
#define MOMENTS uint(2 * HAIR_FEW_COLLIDERS)
// Capsules of each guide at two moments, in alternating halves.
shared vec4 shared_start[MOMENTS * GROUP_GUIDES], shared_axis[MOMENTS * GROUP_GUIDES];
// Index of the first capsule at the end of the substep.
uint moment;

void store_collider(uint k, capsule now)
{
    shared_start[moment + k] = vec4(now.start, now.radius);
    shared_axis[moment + k]  = vec4(now.axis, now.square);
}

// Write the capsules that the first substep starts from.
void begin_colliders()
{
    moment = MOMENTS * guide_of_group;
    for (uint k = lane; k < params.colliders; k += lanes) store_collider(k, collider_at(k, fraction_now));
}
uint moment_before() { return 2u * MOMENTS * guide_of_group + uint(HAIR_FEW_COLLIDERS) - moment; }
void next_colliders() { moment = moment_before(); }

capsule shared_collider(uint n)
{
    return capsule(shared_start[n].xyz, shared_axis[n].xyz, shared_start[n].w, shared_axis[n].w);
}
capsule collider_then(uint k) { return shared_collider(moment_before() + k); }
capsule collider_now(uint k) { return shared_collider(moment + k); }
#endif
