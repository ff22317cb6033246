// contact_capsules.glsl - solids as capsules, or what is around them, at the moments of a substep.
#include "sim/solids.glsl"

float share_then, share_now; // of the step that is done at the substep's start and end

struct capsule { // a solid at one moment, with the margin
    vec3  start, axis;
    float radius, square; // of the axis, m^2
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

// How far it moves in the substep, at most.
float moves_of(uint k) { return SOLID_SPIN(k).w * (share_now - share_then); }

// At the start and at the end of the substep: solid_then, solid_now. Threads that have a guide together work out each moment
// once, each for another solid: what share_solid() shares is seen after SOLIDS_MEET, and as solid_then() in the next substep.
#if defined(HAIR_ANY) || defined(HAIR_THREAD_PER_GUIDE)
#define SOLIDS_MEET
void    begin_solids() {}
void    next_solids() {}
void    share_solid(uint k, capsule now) {}
capsule solid_then(uint k) { return solid_at(k, share_then); }
capsule solid_now(uint k) { return solid_at(k, share_now); }
#else
#define SOLIDS_MEET MEET_TO_VOTE // as find_solids does before it looks at them
#define MOMENTS uint(2 * HAIR_FEW_SOLIDS)
shared vec4 shared_start[MOMENTS * GROUP_GUIDES], shared_axis[MOMENTS * GROUP_GUIDES]; // of each guide the two, in turn
uint moment; // where that of the substep's end is

void share_solid(uint k, capsule now)
{
    shared_start[moment + k] = vec4(now.start, now.radius);
    shared_axis[moment + k]  = vec4(now.axis, now.square);
}

// What the first substep begins with.
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
