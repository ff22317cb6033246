// energy.comp - the mechanical energy of guides after a step in which nothing does work on them, and whether it grows.
//
// With damping c and kinetic energy T the energy E of a guide falls by 2 c T a second, and by more in contact. Half of
// that is added up as loss: E + loss may not grow. So a guide is found out as well that gains what damping takes from it.
//
// Velocities of some methods are those of the middle of a substep. E of an oscillation at w then swings by w h / 2 of it.
// Therefore the greatest values of windows of time are compared, which an oscillation leaves alike. A thread goes over the
// vertices of a guide.
#version 450 core
#include "buffers.glsl"
#include "rotation.glsl"
#include "sim/rod_buffers.glsl"
layout(local_size_x = HAIR_GROUP_SIZE) in;

#define NONE 1e37
#define GROWTH 0.25       // of the kinetic energy, that windows may differ by
#define LENGTH_GRAIN 3e-4 // relative error of lengths that solvers leave; gravity makes energy of it
#define TURN_GRAIN 1e-5   // rad, that rounding of positions and frames makes of the turn at a vertex

layout(std430, binding = HAIR_BIND_ENERGY) restrict buffer energy_buffer { hair_energy energy[]; };
layout(std140, binding = HAIR_BIND_ENERGY_PARAMS) uniform energy_params_buffer { hair_energy_params watch; };

float grain; // of the energy of the guide

vec3 along_of(vec4 q) { return rotate(q, vec3(0.0, 1.0, 0.0)); }

// Add the energy of a vertex that nothing holds.
void add_vertex(uint i, vec3 root, bool has_rate, inout vec4 sum)
{
    float over_mass = rod[i].segment.y;
    if (over_mass == 0.0) return;
    vec3  at = state[i].position.xyz, hv = has_rate ? history[i].rate.xyz : state[i].displacement.xyz;
    float fall = dot(params.gravity.xyz, at - root), mass = 1.0 / over_mass;
    sum.x += 0.5 * mass * watch.rate * watch.rate * dot(hv, hv);
    sum.y -= mass * fall;
    grain += LENGTH_GRAIN * mass * abs(fall);
    vec3 away = rotate(params.rotation_now, rest[i].position.xyz) - at;
    sum.w += 0.5 * mass * rod[i].segment.z * dot(away, away);
}

#ifdef HAIR_MIXED
// Return how far the turn from the frame before to that of segment i is from rest, and its energy in w: see mixed.glsl.
vec4 bend_of(uint i, vec4 before)
{
    vec4  q = quat_multiply(quat_conjugate(before), material[i]), strain = rod[i].strain;
    q *= q.w < 0.0 ? -1.0 : 1.0;
    vec3  off = 2.0 * q.xyz - strain.xyz;
    float real = 2.0 * q.w - rod[i].segment.w;
    return vec4(off, 0.5 * strain.w * (dot(off, params.ratio.xyz * off) + params.ratio.z * real * real));
}
#else
// Return the difference of the directions at vertex i, and its energy in w: see bending.glsl.
vec4 bend_of(uint i, vec3 before)
{
    vec3 off = normalize(state[i + 1u].position.xyz - state[i].position.xyz) - before;
    return vec4(off, 0.5 * rod[i].strain.w * dot(off, off));
}
#endif

void add_bending(uint g, uint first, uint count, inout vec4 sum)
{
    vec4 scalp = quat_multiply(params.rotation_now, guide[g].root_frame);
    for (uint i = first; i + 1u < first + count; ++i) {
#ifdef HAIR_MIXED
        vec4 bend = bend_of(i, i > first ? material[i - 1u] : scalp);
#else
        vec4 bend = bend_of(i, i > first ? normalize(state[i].position.xyz - state[i - 1u].position.xyz) : along_of(scalp));
#endif
        sum.z += bend.w;
        grain += rod[i].strain.w * (length(bend.xyz) + TURN_GRAIN) * TURN_GRAIN;
    }
}

// Return what is watched from now on. `total`: the energy; `kinetic`: of it.
vec4 next_window(vec4 window, float total, float kinetic)
{
    if (watch.begins != 0u) window = vec4(NONE, -NONE, 0.0, 0.0);
    window.z += params.damping * kinetic * watch.time;
    window.y = max(window.y, total + window.z);
    window.w = max(window.w, kinetic);
    if (watch.ends == 0u) return window;
    bool grows = window.y > window.x + (GROWTH * window.w + grain);
    if (grows) atomicAdd(health[HAIR_HEALTH_GAINING], 1u);
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
    if (rod[first].segment.y > 0.0) root = vec3(0.0); // A free one falls.
    bool has_rate = state[first].position.w >= 2.0;
    for (uint i = first; i < first + count; ++i) add_vertex(i, root, has_rate, sum);
    add_bending(g, first, count, sum);
    energy[g].now    = sum;
    energy[g].window = next_window(energy[g].window, sum.x + sum.y + sum.z + sum.w, sum.x);
}
