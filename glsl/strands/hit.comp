// hit.comp - the first vertex of each follower that is inside a collider (Tariq 2010). One thread
// per follower stops at that vertex. With HAIR_HIT_GROUP several threads share the vertices of a
// follower. The root is fixed and is not tested. With HAIR_PREPASS hit.tese has already found the
// vertex.
#version 450 core
#include "strands/follower.glsl"
#include "field.glsl"
#include "workgroup.glsl"

// Neighbouring threads take neighbouring followers at the same vertex. Such followers mostly have
// the same guides, which are then read once for all of them.
#ifdef HAIR_HIT_GROUP
layout(local_size_x = HAIR_HIT_FOLLOWERS, local_size_y = HAIR_HIT_THREADS) in;
#else
layout(local_size_x = HAIR_GROUP_SIZE) in;
#endif

layout(std430, binding = HAIR_BIND_HIT) writeonly restrict buffer hit_buffer { float hit[]; };
layout(std430, binding = HAIR_BIND_LIST) restrict buffer list_buffer { uint list[]; };

#ifdef HAIR_PREPASS
layout(binding = HAIR_UNIT_SHADOW) uniform sampler2D prepass_texture;

float find_first(uint number, hair_follower follower)
{
    return texelFetch(prepass_texture, ivec2(number % HAIR_HIT_COLUMNS, number / HAIR_HIT_COLUMNS), 0).x;
}
#else
bool is_inside(hair_follower follower, uint k, bool beyond)
{
    float t = float(k) / float(draw.segments);
    return field_distance(interpolate(follower, t, UNTOUCHED, beyond).position) < 0.0;
}

float find_first(uint number, hair_follower follower)
{
    // There are two loops, because several followers run at once, and the loop for followers within
    // their guides reads half as much memory.
    uint last = draw.segments, k = 1u + gl_LocalInvocationID.y;
    if (follower.length_ratio <= 1.0)
        while (k <= last && !is_inside(follower, k, false)) k += gl_WorkGroupSize.y;
    else
        while (k <= last && !is_inside(follower, k, true)) k += gl_WorkGroupSize.y;
    return k <= last ? float(k) : HAIR_NO_HIT;
}
#endif

#ifdef HAIR_HIT_GROUP
shared float found[HAIR_HIT_THREADS][HAIR_HIT_FOLLOWERS];

float min_of_all(float first)
{
    found[gl_LocalInvocationID.y][gl_LocalInvocationID.x] = first;
    synchronise();
    for (uint i = 1u; i < HAIR_HIT_THREADS; ++i) first = min(first, found[i][gl_LocalInvocationID.x]);
    return first;
}
#else
float min_of_all(float first) { return first; }
#endif

void main()
{
    uint number = hair_group() * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
    if (number == 0u) list[1u - draw.parity] = 0u; // Cleared for the next run.
    hair_follower follower = fetch_follower(min(number, draw.followers - 1u));
    bool          switches = draw.follower_collision == HAIR_COLLISION_IS_SINGLE_GUIDE;
    bool          minds    = !switches || follower.multi > 0.0;
    float         first    = min_of_all(minds ? find_first(number, follower) : HAIR_NO_HIT);
    if (number >= draw.followers || gl_LocalInvocationID.y > 0u) return;
    hit[number] = first;
    if (first < HAIR_NO_HIT && !switches) list[2u + atomicAdd(list[draw.parity], 1u)] = number;
}
