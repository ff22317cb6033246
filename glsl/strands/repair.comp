// repair.comp - the curves of strands/repair.glsl that push followers out of colliders. One thread
// per follower of the list of hit.comp.
//
// A strand that is deep inside has guides on different sides of the collider. It is freed of all
// guides but its own (Tariq 2010), from well above the first vertex inside. Vertices that remain
// inside are pushed out along the gradient of the distance field by Kaczmarz's method. For one
// vertex after another, it makes the smallest change of control points that brings the vertex to
// the surface. It repeats this several times. Then the curve is drawn to the length that the strand
// had before.
#version 450 core
#include "strands/follower.glsl"
#include "field.glsl"
#include "strands/repair.glsl"
#include "workgroup.glsl"
layout(local_size_x = HAIR_REPAIR_THREADS) in;

layout(std430, binding = HAIR_BIND_REPAIR) writeonly restrict buffer repair_buffer { uvec2 halves[]; };
layout(std430, binding = HAIR_BIND_LIST) readonly restrict buffer list_buffer { uint list[]; };

#define ROUNDS 10u        // Passes of pushing between updates of the length.
#define LENGTHS 4u        // Updates of the length.
// Depths up to which a strand keeps its guides and from which it is freed of them, m. The closer
// they are, the faster a strand leaves its guides.
#define SHALLOW 0.002
#define DEEP 0.025
#define AHEAD 1           // Intervals above a vertex inside from which it is freed.

shared vec4  control[HAIR_REPAIR_CONTROLS * HAIR_REPAIR_THREADS];
shared float vertex[3 * (HAIR_REPAIR_SAMPLES + 1) * HAIR_REPAIR_THREADS];

vec4 repair_control(int first, int i) { return control[i * HAIR_REPAIR_THREADS + first]; }

vec3 vertex_at(uint i)
{
    uint at = 3u * i * HAIR_REPAIR_THREADS + gl_LocalInvocationID.x;
    return vec3(vertex[at], vertex[at + HAIR_REPAIR_THREADS], vertex[at + 2u * HAIR_REPAIR_THREADS]);
}

void keep_vertex(uint i, vec3 p)
{
    uint at = 3u * i * HAIR_REPAIR_THREADS + gl_LocalInvocationID.x;
    vertex[at] = p.x, vertex[at + HAIR_REPAIR_THREADS] = p.y, vertex[at + 2u * HAIR_REPAIR_THREADS] = p.z;
}

// Measure the unrepaired strand. Return its length. `deepest` is its greatest depth in a collider.
// Set how far its control points are freed.
float look(int own, hair_follower follower, uint samples, out float deepest)
{
    float total = 0.0;
    deepest     = 0.0;
    vec3 before = vec3(0.0);
    for (uint i = 0u; i <= samples; ++i) {
        float t = float(i) / float(samples);
        vec3  p = interpolate(follower, t, UNTOUCHED).position;
        if (i > 0u) {
            float depth = -field_distance(p);
            float freed = clamp((depth - SHALLOW) / (DEEP - SHALLOW), 0.0, 1.0);
            int   from  = clamp(int(t * float(HAIR_REPAIR_INTERVALS)) - AHEAD, 0, HAIR_REPAIR_CONTROLS - 1);
            int   at    = from * HAIR_REPAIR_THREADS + own;
            control[at].w = max(control[at].w, freed);
            deepest = max(deepest, depth);
            total += distance(p, before);
        }
        before = p;
    }
    for (int i = 1; i < HAIR_REPAIR_CONTROLS; ++i) {
        int at        = i * HAIR_REPAIR_THREADS + own;
        control[at].w = max(control[at].w, control[at - HAIR_REPAIR_THREADS].w);
    }
    return total;
}

// Compute the vertices of the strand without its displacement.
void place(int own, hair_follower follower, uint samples, float slide)
{
    for (uint i = 0u; i <= samples; ++i) {
        float t = slide * float(i) / float(samples);
        repair r = UNTOUCHED;
        r.freed  = repair_at(own, t).freed;
        keep_vertex(i, interpolate(follower, t, r).position);
    }
}

// Move the curve by `step` at t with the smallest change of control points.
void push(int own, float t, vec3 step)
{
    float x;
    int   k      = spline_place(t, x);
    vec4  weight = spline(x);
    if (k == 0) weight = vec4(0.0, 0.0, weight.z - weight.x, weight.w);
    if (k == 1) weight.x = 0.0;
    step /= max(dot(weight, weight), 1e-4);
    for (int i = k == 0 ? 2 : 0; i < 4; ++i)
        control[(k - 1 + i) * HAIR_REPAIR_THREADS + own].xyz += weight[i] * step;
}

void push_out(int own, uint samples, float slide, float margin)
{
    for (uint round = 0u; round < ROUNDS; ++round)
        for (uint i = 1u; i <= samples; ++i) {
            float t     = slide * float(i) / float(samples);
            vec3  p     = vertex_at(i) + repair_at(own, t).away;
            float short_of = margin - field_distance(p);
            if (short_of > 0.0) push(own, t, short_of * direction_or(field_gradient(p), vec3(0.0, 1.0, 0.0)));
        }
}

float length_of(int own, uint samples, float slide)
{
    vec3  before = vertex_at(0u);
    float total  = 0.0;
    for (uint i = 1u; i <= samples; ++i) {
        vec3 p = vertex_at(i) + repair_at(own, slide * float(i) / float(samples)).away;
        total += distance(p, before);
        before = p;
    }
    return total;
}

void main()
{
    uint slot = hair_group() * HAIR_REPAIR_THREADS + gl_LocalInvocationID.x;
    if (slot >= list[draw.parity]) return;
    int           own      = int(gl_LocalInvocationID.x);
    uint          number   = list[2u + slot];
    uint          samples  = min(draw.segments, HAIR_REPAIR_SAMPLES);
    hair_follower follower = fetch_follower(number);
    for (int i = 0; i < HAIR_REPAIR_CONTROLS; ++i) control[i * HAIR_REPAIR_THREADS + own] = vec4(0.0);

    float deepest;
    float wanted = look(own, follower, samples, deepest);
    float margin = draw.collision_margin * smoothstep(0.0, SHALLOW, deepest);
    float slide  = 1.0;
    for (uint i = 0u; i < LENGTHS; ++i) {
        place(own, follower, samples, slide);
        push_out(own, samples, slide, margin);
        slide = clamp(slide * wanted / max(length_of(own, samples, slide), 1e-6), 0.5, 2.0);
    }
    control[own].xyz = vec3(slide - 1.0, 0.0, 0.0);
    for (int i = 0; i < HAIR_REPAIR_CONTROLS; ++i) {
        vec4 c = control[i * HAIR_REPAIR_THREADS + own];
        // The test uses bits, because comparisons with NaN may be compiled away. Control points
        // that half floats cannot hold become 0.
        if ((floatBitsToUint(dot(c, c)) & 0x7fffffffu) > floatBitsToUint(1e8)) c = vec4(0.0);
        halves[number * HAIR_REPAIR_CONTROLS + uint(i)] = uvec2(packHalf2x16(c.xy), packHalf2x16(c.zw));
    }
}
