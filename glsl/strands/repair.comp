// repair.comp - the curves of strands/repair.glsl that push the followers in the list of hit.comp
// out of colliders. A work group has HAIR_REPAIR_FOLLOWERS of them, with HAIR_REPAIR_LANES threads
// each, which share the vertices of a follower.
//
// A strand that is deep inside has guides on different sides of the collider. It is freed of all
// guides but its own (Tariq 2010), from well above the first vertex inside. Vertices that remain
// inside are pushed out by strands/repair_push.glsl. Then the curve is drawn to the length that the
// strand had before.
#version 450 core
#include "strands/follower.glsl"
#include "field.glsl"
#include "strands/repair_push.glsl"
layout(local_size_x = HAIR_REPAIR_FOLLOWERS * HAIR_REPAIR_LANES) in;

layout(std430, binding = HAIR_BIND_REPAIR) writeonly restrict buffer repair_buffer { uvec2 halves[]; };
layout(std430, binding = HAIR_BIND_LIST) readonly restrict buffer list_buffer { uint list[]; };

#define LENGTHS 4u        // Maximum updates of the length.
#define SAME_LENGTH 1e-4  // Relative change of the length after which it is not updated again.
// Depths up to which a strand keeps its guides and from which it is freed of them, m. The closer
// they are, the faster a strand leaves its guides.
#define SHALLOW 0.002
#define DEEP 0.025
#define AHEAD 1           // Intervals above a vertex inside from which it is freed.

#if HAIR_REPAIR_LANES > 1
#define TURNS uint(HAIR_REPAIR_TURNS)
#else
#define TURNS 1u
#endif

shared float sum_of_part[HAIR_REPAIR_THREADS * HAIR_REPAIR_FOLLOWERS];
// Depth of the deepest vertex that frees control points from this one on, as bits.
shared uint depth_at[HAIR_REPAIR_CONTROLS * HAIR_REPAIR_FOLLOWERS];

// Compute the vertices of the strand without its displacement.
void place(hair_follower follower, int samples, float slide)
{
    for (int i = lane; i <= samples; i += LANES) {
        float t = slide * float(i) / float(samples);
        repair r = UNTOUCHED;
        r.freed  = repair_at(follower_of_group, t).freed;
        keep_vertex(i, interpolate(follower, t, r).position);
    }
    WAIT();
}

// Return a vertex with its displacement.
vec3 pushed_at(int i, int samples, float slide)
{
    return vertex_at(i) + repair_at(follower_of_group, slide * float(i) / float(samples)).away;
}

// Return the length. Every HAIR_REPAIR_THREADS-th segment is in a sum of its own, which one thread
// of a work group adds up.
float length_of(int samples, float slide)
{
    for (int part = lane; part < HAIR_REPAIR_THREADS; part += LANES) {
        float sum = 0.0;
        for (int i = 1 + part; i <= samples; i += HAIR_REPAIR_THREADS)
            sum += distance(pushed_at(i, samples, slide), pushed_at(i - 1, samples, slide));
        sum_of_part[OF(part)] = sum;
    }
    WAIT();
    float total = 0.0;
    for (int part = 0; part < HAIR_REPAIR_THREADS; ++part) total += sum_of_part[OF(part)];
    WAIT();
    return total;
}

// Set how far control points are freed, by the depths of the unrepaired strand in colliders. Return
// the greatest depth.
float free_controls(int samples)
{
    for (int c = lane; c < HAIR_REPAIR_CONTROLS; c += LANES) depth_at[OF(c)] = 0u;
    WAIT();
    for (int i = 1 + lane; i <= samples; i += LANES) {
        float depth = max(-field_distance(vertex_at(i)), 0.0);
        int   from  = clamp(i * HAIR_REPAIR_INTERVALS / samples - AHEAD, 0, HAIR_REPAIR_CONTROLS - 1);
        // The bits of floats that are not negative have the order of the floats.
        if (depth > 0.0) atomicMax(depth_at[OF(from)], floatBitsToUint(depth));
    }
    WAIT();
    float deepest = 0.0;
    for (int c = 0; c < HAIR_REPAIR_CONTROLS; ++c) {
        deepest = max(deepest, uintBitsToFloat(depth_at[OF(c)]));
        if (c % LANES != lane) continue;
        control[OF(c)] = vec4(0.0, 0.0, 0.0, clamp((deepest - SHALLOW) / (DEEP - SHALLOW), 0.0, 1.0));
    }
    WAIT();
    return deepest;
}

// Write the control points of a follower.
void write(uint number, float slide)
{
    for (int i = lane; i < HAIR_REPAIR_CONTROLS; i += LANES) {
        vec4 c = control[OF(i)];
        if (i == 0) c.xyz = vec3(slide - 1.0, 0.0, 0.0);
        // The test uses bits, because comparisons with NaN may be compiled away. Control points
        // that half floats cannot hold become 0.
        if ((floatBitsToUint(dot(c, c)) & 0x7fffffffu) > floatBitsToUint(1e8)) c = vec4(0.0);
        halves[number * HAIR_REPAIR_CONTROLS + uint(i)] = uvec2(packHalf2x16(c.xy), packHalf2x16(c.zw));
    }
}

void repair_follower(uint place_in_list)
{
    uint number  = list[2u + place_in_list];
    int  samples = int(min(draw.segments, HAIR_REPAIR_SAMPLES));
    hair_follower follower = fetch_follower(number);
#if HAIR_REPAIR_LANES > 1
    if (lane == 0) pushed[0] = pushed[1] = 0u;
#endif
    for (int i = lane; i < HAIR_REPAIR_CONTROLS; i += LANES)
        control[OF(i)] = vec4(0.0);
    WAIT();
    float deepest, slide = 1.0;
    place(follower, samples, slide);
    deepest      = free_controls(samples);
    float wanted = length_of(samples, 1.0); // Nothing is displaced yet.
    float margin = draw.collision_margin * smoothstep(0.0, SHALLOW, deepest);
    for (uint i = 0u; i < LENGTHS; ++i) {
        // A strand that keeps its guides is where it was measured.
        if (i > 0u || deepest > SHALLOW) place(follower, samples, slide);
        push_out(samples, slide, margin);
        float was = slide;
        slide = clamp(slide * wanted / max(length_of(samples, slide), 1e-6), 0.5, 2.0);
        if (abs(slide - was) < SAME_LENGTH) break;
    }
    write(number, slide);
}

void main()
{
    uint count = list[draw.parity], first = hair_group() * HAIR_REPAIR_FOLLOWERS;
    uint stride = hair_group_count() * HAIR_REPAIR_FOLLOWERS;
    // Threads beyond the end of the list do the work of its last follower again, because all
    // threads of a work group must meet at barriers.
    for (uint turn = 0u; turn < TURNS && first < count; ++turn, first += stride) {
        repair_follower(min(first + uint(follower_of_group), count - 1u));
        WAIT(); // The next follower overwrites what threads have in common.
    }
}
