// body.glsl - the grid of a body, a mesh that deforms: buffers of the passes that compute its
// distances. Positions are in voxels from the first node.
#include "shared.h"
#include "workgroup.glsl"

#define BODY_NONE 4294967295u // Value of `nearest` at a node that no triangle is near.

layout(std140, binding = HAIR_BIND_BODY) uniform body_buffer { hair_body_params params; };
layout(std430, binding = HAIR_BIND_BODY_POSITION) readonly buffer position_buffer { float position[]; };
layout(std430, binding = HAIR_BIND_BODY_TRIANGLE) readonly buffer triangle_buffer { uint triangle[]; };
// Distance to the nearest triangle in its upper bits and the index of that triangle in its lower
// bits. The least of these numbers does not depend on the order of threads.
layout(std430, binding = HAIR_BIND_BODY_NEAREST) buffer nearest_buffer { uint nearest[]; };
// Number of surfaces that a column along x enters, less those it leaves, between the node before
// and the node.
layout(std430, binding = HAIR_BIND_BODY_CROSSING) buffer crossing_buffer { int crossing[]; };

vec3 body_vertex(uint k)
{
    uint i = 3u * triangle[k];
    return vec3(position[i], position[i + 1u], position[i + 2u]);
}

float body_fraction(vec3 p, vec3 a, vec3 b)
{
    return clamp(dot(p - a, b - a) / max(dot(b - a, b - a), 1e-30), 0.0, 1.0);
}

// Return the point of a triangle that is nearest to p.
vec3 nearest_of_triangle(vec3 p, vec3 a, vec3 b, vec3 c)
{
    vec3  normal = cross(b - a, c - a);
    float square = dot(normal, normal);
    vec2  weight = vec2(dot(cross(p - a, c - a), normal), dot(cross(b - a, p - a), normal));
    if (square > 1e-20 && min(weight.x, weight.y) >= 0.0 && weight.x + weight.y <= square)
        return a + (weight.x * (b - a) + weight.y * (c - a)) / square;
    vec3  ab = mix(a, b, body_fraction(p, a, b)), bc = mix(b, c, body_fraction(p, b, c)),
          ca = mix(c, a, body_fraction(p, c, a));
    float x = dot(p - ab, p - ab), y = dot(p - bc, p - bc), z = dot(p - ca, p - ca);
    return x <= y && x <= z ? ab : y <= z ? bc : ca;
}
