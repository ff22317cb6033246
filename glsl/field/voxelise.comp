// voxelise.comp - one brick of the distance field. Each voxel gets the exact distance from its
// centre to the nearest of the colliders that reach into the brick, and the number of that
// collider. One work group per brick, one thread per voxel. The colliders of a brick with many
// come in several rounds, because a work group must not take long.
#version 450 core
#include "field_params.glsl"
#include "workgroup.glsl"
#include "field/shape.glsl"
layout(local_size_x = HAIR_BRICK, local_size_y = HAIR_BRICK, local_size_z = HAIR_BRICK) in;

#define DEEPEST 6e4 // m. A half float can hold it.

layout(std430, binding = HAIR_BIND_BRICK) readonly buffer brick_buffer { hair_field_brick brick[]; };
layout(std430, binding = HAIR_BIND_BRICK_COLLIDER) readonly buffer member_buffer { uint member[]; };
// A texture, because one driver reads storage buffers many times as slowly.
layout(binding = HAIR_UNIT_WORK) uniform usamplerBuffer collider_texture;
layout(binding = HAIR_IMAGE_FIELD, r16f) uniform image3D field_image;
#ifdef HAIR_NUMBERS
layout(binding = HAIR_IMAGE_COLLIDER, r32ui) uniform uimage3D collider_image;
#endif

hair_field_collider fetch_collider(uint i)
{
    int              at = int(i) * HAIR_COLLIDER_TEXELS;
    hair_field_collider collider;
    uvec4            last = texelFetch(collider_texture, at + 5);
    collider.position = uintBitsToFloat(texelFetch(collider_texture, at));
    collider.rotation = uintBitsToFloat(texelFetch(collider_texture, at + 1));
    collider.size     = uintBitsToFloat(texelFetch(collider_texture, at + 2));
    collider.shape = last.x, collider.number = last.y;
#ifdef HAIR_MESHES
    uvec4 nodes = texelFetch(collider_texture, at + 4);
    collider.grid  = uintBitsToFloat(texelFetch(collider_texture, at + 3));
    collider.nodes_x = nodes.x, collider.nodes_y = nodes.y, collider.nodes_z = nodes.z,
    collider.first = nodes.w;
#endif
    return collider;
}

void main()
{
    hair_field_brick own      = brick[hair_group()];
    ivec3            corner   = ivec3(own.at & 1023u, (own.at >> 10) & 1023u, own.at >> 20) * HAIR_BRICK;
    ivec3            voxel    = corner + ivec3(gl_LocalInvocationID);
    vec3             position = field.lower.xyz + (vec3(voxel) + 0.5) * field.lower.w;
    float            nearest  = field.inverse.w;
    uint             number   = HAIR_NO_COLLIDER;
    if (own.round > 0u) {
        nearest = imageLoad(field_image, voxel).x;
#ifdef HAIR_NUMBERS
        number = imageLoad(collider_image, voxel).x;
#endif
    }
    for (uint i = own.first; i < own.first + own.count; ++i) {
        hair_field_collider other    = fetch_collider(member[i]);
        float            distance = collider_distance(other, position);
        if (distance < nearest) {
            nearest = distance;
            number  = other.number;
        }
    }
    imageStore(field_image, voxel, vec4(max(nearest, -DEEPEST)));
#ifdef HAIR_NUMBERS
    imageStore(collider_image, voxel, uvec4(number));
#endif
}
