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

layout(std430, binding = HAIR_BIND_BODY_CHANGE) buffer change_buffer { hair_body_change change; };

// Return the first or the last column along x, as its y and z, that may change.
uvec2 first_changed() { return uvec2(change.first_y, change.first_z); }
uvec2 last_changed() { return uvec2(change.last_y, change.last_z); }

// Return the corners of the triangle t.
mat3 body_triangle(uint t)
{
    uvec3 i = 3u * uvec3(triangle[3u * t], triangle[3u * t + 1u], triangle[3u * t + 2u]);
    return mat3(position[i.x], position[i.x + 1u], position[i.x + 2u], position[i.y], position[i.y + 1u],
                position[i.y + 2u], position[i.z], position[i.z + 1u], position[i.z + 2u]);
}

float body_fraction(vec3 p, vec3 a, vec3 b)
{
    return clamp(dot(p - a, b - a) / max(dot(b - a, b - a), 1e-30), 0.0, 1.0);
}

// Return the weights of the corners of a triangle at the point that is nearest to p.
vec3 nearest_weights(vec3 p, vec3 a, vec3 b, vec3 c)
{
    vec3  normal = cross(b - a, c - a);
    float square = dot(normal, normal);
    vec2  weight = vec2(dot(cross(p - a, c - a), normal), dot(cross(b - a, p - a), normal));
    if (square > 1e-20 && min(weight.x, weight.y) >= 0.0 && weight.x + weight.y <= square)
        return vec3(square - weight.x - weight.y, weight) / square;
    float ab = body_fraction(p, a, b), bc = body_fraction(p, b, c), ca = body_fraction(p, c, a);
    vec3  x = mix(a, b, ab) - p, y = mix(b, c, bc) - p, z = mix(c, a, ca) - p;
    vec3  far = vec3(dot(x, x), dot(y, y), dot(z, z));
    return far.x <= far.y && far.x <= far.z ? vec3(1.0 - ab, ab, 0.0)
           : far.y <= far.z                 ? vec3(0.0, 1.0 - bc, bc)
                                            : vec3(ca, 0.0, 1.0 - ca);
}
