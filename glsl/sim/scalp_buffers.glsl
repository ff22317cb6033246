// scalp_buffers.glsl - the skinned scalp and its root bindings: buffers of the scalp motion
// passes.
#include "shared.h"
#include "workgroup.glsl"

layout(std430, binding = HAIR_BIND_ROOT_TRANSFORM) buffer root_transform_buffer
{
    hair_root_transform root_transforms[];
};
layout(std430, binding = HAIR_BIND_SCALP) buffer scalp_buffer { float scalp[]; };
layout(std430, binding = HAIR_BIND_SCALP_REST) readonly buffer scalp_rest_buffer { float scalp_rest[]; };
layout(std430, binding = HAIR_BIND_ROOT_BINDING) readonly buffer root_binding_buffer
{
    hair_root_binding root_bindings[];
};
layout(std140, binding = HAIR_BIND_SCALP_PARAMS) uniform scalp_params_buffer { hair_scalp_params on; };
#include "sim/root_transforms.glsl"

// Return the position of a scalp vertex, in the head's frame.
vec3 vertex_now(uint i)
{
    vec3 at = vec3(scalp[3u * i], scalp[3u * i + 1u], scalp[3u * i + 2u]);
    return rotate(on.rotation, at + on.offset.xyz);
}
vec3 vertex_at_rest(uint i)
{
    return vec3(scalp_rest[3u * i], scalp_rest[3u * i + 1u], scalp_rest[3u * i + 2u]);
}

// Return the point on the scalp to which a root is bound.
vec3 bound_point(hair_root_binding root_binding)
{
    return (1.0 - root_binding.weight1 - root_binding.weight2) * vertex_now(root_binding.corner0) +
           root_binding.weight1 * vertex_now(root_binding.corner1) +
           root_binding.weight2 * vertex_now(root_binding.corner2);
}
