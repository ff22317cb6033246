// field.glsl - the field, sampled: how far the nearest solid is, which way is out of it, and which one it is.
//
// Positions and directions are those of everything else that draws: in metres from the head's origin, along the world's
// axes. Beyond the band that is kept around solids, and outside the box, the distance is field.inverse.w, greater than
// 0, and the gradient is 0 or nearly so.
#ifndef HAIR_FIELD_GLSL
#define HAIR_FIELD_GLSL

#include "field_params.glsl"
#include "rotation.glsl"

layout(binding = HAIR_UNIT_FIELD) uniform sampler3D field_texture;
layout(binding = HAIR_UNIT_SOLID) uniform usampler3D field_solid_texture;

// As a share of the box along each of its sides.
vec3 field_place(vec3 position)
{
    return (rotate(quat_conjugate(field.rotation), position) - field.lower.xyz) * field.inverse.xyz;
}

bool field_holds(vec3 place) { return all(equal(place, clamp(place, 0.0, 1.0))); }

// m; below 0 inside a solid.
float field_distance(vec3 position)
{
    vec3 place = field_place(position);
    return field_holds(place) ? textureLod(field_texture, place, 0.0).x : field.inverse.w;
}

// By how much the distance grows per metre, which points out of the nearest solid. Its length is 1 but where solids
// are as near as each other or end in an edge.
vec3 field_gradient(vec3 position)
{
    vec3 place = field_place(position);
    if (!field_holds(place)) return vec3(0.0);
    // Differences along the four diagonals of a tetrahedron, each half a voxel long along every axis.
    vec3  h = 0.5 * field.lower.w * field.inverse.xyz;
    float a = textureLod(field_texture, place + h * vec3(1.0, 1.0, 1.0), 0.0).x;
    float b = textureLod(field_texture, place + h * vec3(1.0, -1.0, -1.0), 0.0).x;
    float c = textureLod(field_texture, place + h * vec3(-1.0, 1.0, -1.0), 0.0).x;
    float d = textureLod(field_texture, place + h * vec3(-1.0, -1.0, 1.0), 0.0).x;
    return rotate(field.rotation, vec3(a + b - c - d, a - b + c - d, a - b - c + d)) / (2.0 * field.lower.w);
}

// Its place among those of hair_set_solids, or HAIR_NO_SOLID.
uint field_solid(vec3 position)
{
    vec3 place = field_place(position);
    if (!field_holds(place)) return HAIR_NO_SOLID;
    ivec3 size = textureSize(field_solid_texture, 0);
    return texelFetch(field_solid_texture, min(ivec3(place * vec3(size)), size - 1), 0).x;
}

#endif
