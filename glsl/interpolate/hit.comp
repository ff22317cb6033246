// hit.comp - the first vertex of each follower that is inside a solid (Tariq 2010), a thread per follower that stops
// there. The root is where it is: only what comes after it counts. With HAIR_PREPASS hit.tese has found it.
#version 450 core
#include "follower.glsl"
#include "field.glsl"
#include "workgroup.glsl"
layout(local_size_x = HAIR_GROUP_SIZE) in;

layout(std430, binding = HAIR_BIND_HIT) writeonly restrict buffer hit_buffer { float hit[]; };
layout(std430, binding = HAIR_BIND_LIST) restrict buffer list_buffer { uint list[]; };

#ifdef HAIR_PREPASS
layout(binding = HAIR_UNIT_SHADOW) uniform sampler2D prepass_texture;

float find_first(uint number, hair_follower follower)
{
    return texelFetch(prepass_texture, ivec2(number % HAIR_HIT_COLUMNS, number / HAIR_HIT_COLUMNS), 0).x;
}
#else
float find_first(uint number, hair_follower follower)
{
    for (uint k = 1u; k <= draw.segments; ++k) {
        vec3 p = interpolate(follower, float(k) / float(draw.segments), UNTOUCHED).position;
        if (field_distance(p) < 0.0) return float(k);
    }
    return HAIR_NO_HIT;
}
#endif

void main()
{
    uint number = hair_group() * HAIR_GROUP_SIZE + gl_LocalInvocationID.x;
    if (number == 0u) list[1u - draw.turn] = 0u; // For the next time.
    if (number >= draw.followers) return;
    hair_follower follower = fetch_follower(number);
    bool          switches = draw.collision == HAIR_COLLISION_IS_SWITCH;
    bool          minds    = !switches || follower.multi > 0.0;
    float         first    = minds ? find_first(number, follower) : HAIR_NO_HIT;
    hit[number] = first;
    if (first < HAIR_NO_HIT && !switches) list[2u + atomicAdd(list[draw.turn], 1u)] = number;
}
