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

float length_of(int samples, float slide)
{
    for (int i = 1 + lane; i <= samples; i += LANES)
        depth[AT(i)] = distance(pushed_at(i, samples, slide), pushed_at(i - 1, samples, slide));
    WAIT();
    float total = 0.0;
    for (int i = 1; i <= samples; ++i) total += depth[AT(i)];
    WAIT();
    return total;
}

// Set how far control points are freed, by the depths of the unrepaired strand in colliders. Return
// the greatest depth.
float free_controls(int samples)
{
    float deepest = 0.0;
    for (int i = 1; i <= samples; ++i) deepest = max(deepest, depth[AT(i)]);
    for (int c = lane; c < HAIR_REPAIR_CONTROLS; c += LANES) {
        float freed = 0.0;
        for (int i = 1; i <= samples; ++i) {
            int from = clamp(i * HAIR_REPAIR_INTERVALS / samples - AHEAD, 0, HAIR_REPAIR_CONTROLS - 1);
            if (from <= c) freed = max(freed, clamp((depth[AT(i)] - SHALLOW) / (DEEP - SHALLOW), 0.0, 1.0));
        }
        control[OF(c)] = vec4(0.0, 0.0, 0.0, freed);
    }
    WAIT();
    return deepest;
}

// Measure the unrepaired strand, whose vertices are placed. Return its length, and its greatest
// depth.
float measure(int samples, out float deepest)
{
    for (int i = 1 + lane; i <= samples; i += LANES) depth[AT(i)] = max(-field_distance(vertex_at(i)), 0.0);
    WAIT();
    deepest = free_controls(samples);
    return length_of(samples, 1.0); // Nothing is displaced yet.
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

void main()
{
    uint first = hair_group() * HAIR_REPAIR_FOLLOWERS, count = list[draw.parity];
    if (first >= count) return;
    // Threads beyond the end of the list do the work of its last follower again, because all
    // threads of a work group must meet at barriers.
    uint          number   = list[2u + min(first + uint(follower_of_group), count - 1u)];
    int           samples  = int(min(draw.segments, HAIR_REPAIR_SAMPLES));
    hair_follower follower = fetch_follower(number);
#if HAIR_REPAIR_LANES > 1
    if (lane == 0) pushed[0] = pushed[1] = 0u;
#endif
    for (int i = lane; i < HAIR_REPAIR_CONTROLS; i += LANES)
        control[OF(i)] = vec4(0.0);
    WAIT();
    float deepest, slide = 1.0;
    place(follower, samples, slide);
    float wanted = measure(samples, deepest);
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
