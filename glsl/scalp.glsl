// scalp.glsl - the skinned scalp and its root bindings: buffers of the scalp motion passes.
#include "shared.h"
#include "workgroup.glsl"

layout(std430, binding = HAIR_BIND_RIDE) buffer ride_buffer { hair_ride rides[]; };
layout(std430, binding = HAIR_BIND_SCALP) buffer scalp_buffer { float scalp[]; };
layout(std430, binding = HAIR_BIND_SCALP_REST) readonly buffer scalp_rest_buffer { float scalp_rest[]; };
layout(std430, binding = HAIR_BIND_SEAT) readonly buffer seat_buffer { hair_seat seats[]; };
layout(std140, binding = HAIR_BIND_SCALP_PARAMS) uniform scalp_params_buffer { hair_scalp_params on; };
#include "sim/ride.glsl"

// Return the position of a scalp vertex, in the head's frame.
vec3 vertex_now(uint i)
{
    vec3 at = vec3(scalp[3u * i], scalp[3u * i + 1u], scalp[3u * i + 2u]);
    return rotate(on.rotation, at + on.offset.xyz);
}
vec3 vertex_at_rest(uint i) { return vec3(scalp_rest[3u * i], scalp_rest[3u * i + 1u], scalp_rest[3u * i + 2u]); }

// Return the point on the scalp to which a root is bound.
vec3 foot_of(hair_seat seat)
{
    return (1.0 - seat.weight1 - seat.weight2) * vertex_now(seat.corner0) + seat.weight1 * vertex_now(seat.corner1) +
           seat.weight2 * vertex_now(seat.corner2);
}
