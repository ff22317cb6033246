// energy.comp - the mechanical energy of guides after a step in which nothing does work on them,
// and whether it grows.
//
// With damping c and kinetic energy T, the energy E of a guide falls by 2 c T per second, and by
// more in contact. The pass adds half of this up as loss. E + loss must not grow. The test thus
// also finds a guide that gains exactly what damping removes.
//
// The velocities of some methods are those of the middle of a substep. With these, the E of an
// oscillation of angular frequency w varies by the fraction w h / 2. The pass therefore compares
// maxima over windows of time, which an oscillation does not change. A thread loops over the
// vertices of a guide.
#version 450 core
#include "sim/buffers.glsl"
#include "rotation.glsl"
#include "sim/rod_buffers.glsl"
layout(local_size_x = HAIR_GROUP_SIZE) in;

#define NONE 1e37
#define GROWTH 0.25       // Fraction of the kinetic energy by which windows may differ
// Relative error of lengths that solvers leave. Gravity turns the error into energy.
#define LENGTH_GRAIN 3e-4
// Error of the turn at a vertex by rounding of positions and frames, rad.
#define TURN_GRAIN 1e-5

layout(std430, binding = HAIR_BIND_ENERGY) restrict buffer energy_buffer { hair_energy energy[]; };
layout(std140, binding = HAIR_BIND_ENERGY_PARAMS) uniform energy_params_buffer { hair_energy_params watch; };

float grain; // Uncertainty of the guide's energy

// Add the energy of a vertex that is not held.
void add_vertex(uint i, vec3 root, bool has_rate, inout vec4 sum)
{
    float over_mass = rod_segment(i).y;
    if (over_mass == 0.0) return;
    vec3  at = state[i].position.xyz, hv = has_rate ? history[i].rate.xyz : state[i].displacement.xyz;
    float fall = dot(params.gravity.xyz, at - root), mass = 1.0 / over_mass;
    sum.x += 0.5 * mass * watch.rate * watch.rate * dot(hv, hv);
    sum.y -= mass * fall;
    grain += LENGTH_GRAIN * mass * abs(fall);
    vec3 away = rotate(params.rotation_now, rest[i].position.xyz) - at;
    sum.w += 0.5 * mass * rod_segment(i).z * dot(away, away);
}

#ifdef HAIR_MIXED
// Return the difference of the hinge's turn from rest, between the frames of segments i-1 and i. w
// is its energy. `ratio` is the hinge's own. mixed.glsl has the equations.
vec4 bend_of(uint i, vec4 before, vec3 ratio)
{
    vec4  q = quat_multiply(quat_conjugate(before), material[i]), strain = rod_strain(i);
    q *= q.w < 0.0 ? -1.0 : 1.0;
    vec3  off = 2.0 * q.xyz - strain.xyz;
    float real = 2.0 * q.w - rod_segment(i).w;
    return vec4(off, 0.5 * strain.w * (dot(off, ratio * off) + ratio.z * real * real));
}
#else
// Return the difference of the directions at vertex i. w is its energy. bending.glsl has the
// equations.
vec4 bend_of(uint i, vec3 before)
{
    vec3 off = normalize(state[i + 1u].position.xyz - state[i].position.xyz) - before;
    return vec4(off, 0.5 * rod_strain(i).w * dot(off, off));
}
#endif

void add_bending(uint g, uint first, uint count, inout vec4 sum)
{
    vec4 scalp = quat_multiply(params.rotation_now, guide[g].root_frame);
    for (uint i = first; i + 1u < first + count; ++i) {
#ifdef HAIR_MIXED
        vec3 ratio = i > first ? params.ratio.xyz : root_ratio_of(g);
        vec4 bend  = bend_of(i, i > first ? material[i - 1u] : scalp, ratio);
#else
        vec4 bend = bend_of(i, i > first ? normalize(state[i].position.xyz - state[i - 1u].position.xyz)
                                         : along_of(scalp));
#endif
        sum.z += bend.w;
        grain += rod_strain(i).w * (length(bend.xyz) + TURN_GRAIN) * TURN_GRAIN;
    }
}

// Return the updated window of a guide. `total` is its energy, and `kinetic` the kinetic part.
vec4 next_window(vec4 window, float total, float kinetic, float damping)
{
    if (watch.begins != 0u) window = vec4(NONE, -NONE, 0.0, 0.0);
    window.z += damping * kinetic * watch.time;
    window.y = max(window.y, total + window.z);
    window.w = max(window.w, kinetic);
    if (watch.ends == 0u) return window;
    bool grows = window.y > window.x + (GROWTH * window.w + grain);
    if (grows) atomicAdd(solver_stats[HAIR_SOLVER_STATS_GAINING], 1u);
    float bound = (grows ? window.y : min(window.x, window.y)) - window.z;
    return vec4(bound, -NONE, 0.0, 0.5 * window.w);
}

void main()
{
    uint g = hair_group() * HAIR_GROUP_SIZE + gl_LocalInvocationID.x;
    if (g >= params.guides) return;
    uint first = guide[g].first, count = guide[g].count;
    vec3 root  = state[first].position.xyz;
    vec4 sum   = vec4(0.0);
    grain      = 0.0;
    // A free root falls, so that gravity's energy is relative to the head's origin.
    if (rod_segment(first).y > 0.0) root = vec3(0.0);
    bool has_rate = state[first].position.w >= 2.0;
    for (uint i = first; i < first + count; ++i) add_vertex(i, root, has_rate, sum);
    add_bending(g, first, count, sum);
    energy[g].now    = sum;
    energy[g].window = next_window(energy[g].window, sum.x + sum.y + sum.z + sum.w, sum.x,
                                   damping_of(g));
}
