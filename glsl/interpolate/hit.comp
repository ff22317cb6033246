// hit.comp - the first vertex of each follower that is inside a solid (Tariq 2010), a thread per follower that stops
// there. The root is where it is: only what comes after it counts.
#version 450 core
#include "follower.glsl"
#include "field.glsl"
#include "workgroup.glsl"
layout(local_size_x = HAIR_GROUP_SIZE) in;

layout(std430, binding = HAIR_BIND_HIT) writeonly restrict buffer hit_buffer { float hit[]; };
layout(std430, binding = HAIR_BIND_LIST) restrict buffer list_buffer { uint list[]; };

void main()
{
    uint number = hair_group() * HAIR_GROUP_SIZE + gl_LocalInvocationID.x;
    if (number == 0u) list[1u - draw.turn] = 0u; // For the next time.
    if (number >= draw.followers) return;
    hair_follower follower = fetch_follower(number);
    float         first    = HAIR_NO_HIT;
    bool          switches = draw.collision == HAIR_COLLISION_IS_SWITCH;
    uint          last     = switches && follower.multi == 0.0 ? 0u : draw.segments;
    for (uint k = 1u; k <= last; ++k) {
        vec3 p = interpolate(follower, float(k) / float(draw.segments), UNTOUCHED).position;
        if (field_distance(p) < 0.0) {
            first = float(k);
            break;
        }
    }
    hit[number] = first;
    if (first < HAIR_NO_HIT && !switches) list[2u + atomicAdd(list[draw.turn], 1u)] = number;
}
