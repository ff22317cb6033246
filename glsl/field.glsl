// field.glsl - samples of the distance field: distance to the nearest collider, direction out of
// it, and its number, if the field has numbers.
//
// Positions and directions are relative to the head's origin, in metres along the world's axes, as
// in all other drawing code. Outside the box, and beyond the band around colliders, the distance is
// field.inverse.w, which is greater than 0. The gradient there is 0 or nearly 0.
#ifndef HAIR_FIELD_GLSL
#define HAIR_FIELD_GLSL

#include "field_params.glsl"
#include "rotation.glsl"

layout(binding = HAIR_UNIT_FIELD) uniform sampler3D field_texture;
layout(binding = HAIR_UNIT_COLLIDER) uniform usampler3D field_collider_texture;

// Return a position as a fraction of the box along each of its sides.
vec3 field_place(vec3 position)
{
    return (rotate(quat_conjugate(field.rotation), position) - field.lower.xyz) * field.inverse.xyz;
}

bool field_holds(vec3 place) { return all(equal(place, clamp(place, 0.0, 1.0))); }

// Return the signed distance, m. It is below 0 inside a collider.
float field_distance(vec3 position)
{
    vec3 place = field_place(position);
    return field_holds(place) ? textureLod(field_texture, place, 0.0).x : field.inverse.w;
}

// Return the gradient of the distance, which points out of the nearest collider. Its length is 1
// except near edges and where colliders are equally near.
vec3 field_gradient(vec3 position)
{
    vec3 place = field_place(position);
    if (!field_holds(place)) return vec3(0.0);
    // Differences along the four diagonals of a tetrahedron. Each is half a voxel long along every
    // axis.
    vec3  h = 0.5 * field.lower.w * field.inverse.xyz;
    float a = textureLod(field_texture, place + h * vec3(1.0, 1.0, 1.0), 0.0).x;
    float b = textureLod(field_texture, place + h * vec3(1.0, -1.0, -1.0), 0.0).x;
    float c = textureLod(field_texture, place + h * vec3(-1.0, 1.0, -1.0), 0.0).x;
    float d = textureLod(field_texture, place + h * vec3(-1.0, -1.0, 1.0), 0.0).x;
    return rotate(field.rotation, vec3(a + b - c - d, a - b + c - d, a - b - c + d)) / (2.0 * field.lower.w);
}

// Return the index in hair_set_colliders of the collider that is nearest to a place of
// field_place(), or HAIR_NO_COLLIDER.
uint field_collider(vec3 place)
{
    if (!field_holds(place)) return HAIR_NO_COLLIDER;
    ivec3 size = textureSize(field_collider_texture, 0);
    return texelFetch(field_collider_texture, min(ivec3(place * vec3(size)), size - 1), 0).x;
}

#endif
