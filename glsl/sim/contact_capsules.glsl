// contact_capsules.glsl - colliders as capsules, or as their bounding capsules, at times of a
// substep.
#include "sim/solids.glsl"

// Fractions of the step that are done at the start and end of the substep.
float share_then, share_now;

struct capsule { // A collider at one moment, with the margin
    vec3  start, axis;
    float radius, square; // `square` is the squared length of the axis, m^2
};

capsule solid_at(uint k, float share)
{
    vec4 a = mix(SOLID_START(k, 0), SOLID_END(k, 0), share);
    vec4 b = mix(SOLID_START(k, 1), SOLID_END(k, 1), share);
    vec3 axis = b.xyz - a.xyz;
    return capsule(a.xyz, axis, a.w + params.margin, max(dot(axis, axis), 1e-12));
}

float nearest_share(vec3 position, capsule solid)
{
    return clamp(dot(position - solid.start, solid.axis) / solid.square, 0.0, 1.0);
}

vec3 from_axis(vec3 position, capsule solid)
{
    return position - solid.start - nearest_share(position, solid) * solid.axis;
}

// Return an upper bound of how far collider k moves in the substep.
float moves_of(uint k) { return SOLID_SPIN(k).w * (share_now - share_then); }

// solid_then() and solid_now() return a capsule at the start and end of the substep. If a guide has
// several threads, each of them computes other capsules, once per moment. A capsule written by
// share_solid() is visible after SOLIDS_MEET, and in the next substep by solid_then().
#if defined(HAIR_ANY) || defined(HAIR_THREAD_PER_GUIDE)
#define SOLIDS_MEET
void    begin_solids() {}
void    next_solids() {}
void    share_solid(uint k, capsule now) {}
capsule solid_then(uint k) { return solid_at(k, share_then); }
capsule solid_now(uint k) { return solid_at(k, share_now); }
#else
// find_solids() votes before it reads the capsules.
#define SOLIDS_MEET MEET_TO_VOTE
#define MOMENTS uint(2 * HAIR_FEW_SOLIDS)
// Capsules of each guide at two moments, in alternating halves.
shared vec4 shared_start[MOMENTS * GROUP_GUIDES], shared_axis[MOMENTS * GROUP_GUIDES];
// Index of the first capsule at the end of the substep.
uint moment;

void share_solid(uint k, capsule now)
{
    shared_start[moment + k] = vec4(now.start, now.radius);
    shared_axis[moment + k]  = vec4(now.axis, now.square);
}

// Write the capsules that the first substep starts from.
void begin_solids()
{
    moment = MOMENTS * guide_of_group;
    for (uint k = lane; k < params.solids; k += lanes) share_solid(k, solid_at(k, share_now));
}
uint moment_before() { return 2u * MOMENTS * guide_of_group + uint(HAIR_FEW_SOLIDS) - moment; }
void next_solids() { moment = moment_before(); }

capsule shared_solid(uint n) { return capsule(shared_start[n].xyz, shared_axis[n].xyz, shared_start[n].w, shared_axis[n].w); }
capsule solid_then(uint k) { return shared_solid(moment_before() + k); }
capsule solid_now(uint k) { return shared_solid(moment + k); }
#endif
