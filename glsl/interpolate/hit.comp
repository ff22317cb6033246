// hit.comp - the first vertex of each follower that is inside a solid (Tariq 2010): by a thread that stops there, or with
// HAIR_GROUP_PER_FOLLOWER by a work group that looks at several vertices at once. The root is where it is: only what comes
// after it counts. With HAIR_PREPASS hit.tese has found it.
#version 450 core
#include "follower.glsl"
#include "field.glsl"
#include "workgroup.glsl"

#ifdef HAIR_GROUP_PER_FOLLOWER
layout(local_size_x = HAIR_HIT_THREADS) in;
#else
layout(local_size_x = HAIR_GROUP_SIZE) in;
#endif

layout(std430, binding = HAIR_BIND_HIT) writeonly restrict buffer hit_buffer { float hit[]; };
layout(std430, binding = HAIR_BIND_LIST) restrict buffer list_buffer { uint list[]; };

bool is_inside(hair_follower follower, uint k, bool beyond)
{
    float t = float(k) / float(draw.segments);
    return field_distance(interpolate(follower, t, UNTOUCHED, beyond).position) < 0.0;
}

#ifdef HAIR_PREPASS
layout(binding = HAIR_UNIT_SHADOW) uniform sampler2D prepass_texture;

float find_first(uint number, hair_follower follower)
{
    return texelFetch(prepass_texture, ivec2(number % HAIR_HIT_COLUMNS, number / HAIR_HIT_COLUMNS), 0).x;
}
#elif defined(HAIR_GROUP_PER_FOLLOWER)
shared uint least;

float find_first(uint number, hair_follower follower)
{
    uint found  = HAIR_NO_SOLID;
    bool longer = follower.length_ratio > 1.0;
    if (gl_LocalInvocationID.x == 0u) least = found;
    for (uint from = 1u; from <= draw.segments && found == HAIR_NO_SOLID; from += HAIR_HIT_THREADS) {
        uint k = from + gl_LocalInvocationID.x;
        synchronise();
        bool inside = false;
        if (k <= draw.segments && !longer) inside = is_inside(follower, k, false); // Without a read of tangents.
        if (k <= draw.segments && longer) inside = is_inside(follower, k, true);
        if (inside) atomicMin(least, k);
        synchronise();
        found = least;
    }
    return found == HAIR_NO_SOLID ? HAIR_NO_HIT : float(found);
}
#else
float find_first(uint number, hair_follower follower)
{
    // Where loops are run for several followers at once, that for all but the longest needs half as much of memory.
    uint last = draw.segments, k = 1u;
    if (follower.length_ratio <= 1.0)
        while (k <= last && !is_inside(follower, k, false)) ++k;
    else
        while (k <= last && !is_inside(follower, k, true)) ++k;
    return k <= last ? float(k) : HAIR_NO_HIT;
}
#endif

void main()
{
#ifdef HAIR_GROUP_PER_FOLLOWER
    uint number = hair_group();
#else
    uint number = hair_group() * HAIR_GROUP_SIZE + gl_LocalInvocationID.x;
#endif
    if (number == 0u) list[1u - draw.turn] = 0u; // For the next time.
    if (number >= draw.followers) return;
    hair_follower follower = fetch_follower(number);
    bool          switches = draw.collision == HAIR_COLLISION_IS_SWITCH;
    bool          minds    = !switches || follower.multi > 0.0;
    float         first    = HAIR_NO_HIT;
    if (minds) first = find_first(number, follower);
#ifdef HAIR_GROUP_PER_FOLLOWER
    if (gl_LocalInvocationID.x > 0u) return;
#endif
    hit[number] = first;
    if (first < HAIR_NO_HIT && !switches) list[2u + atomicAdd(list[draw.turn], 1u)] = number;
}
