// colliders.vert - the bounding box of a collider. One instance per collider, 36 vertices.
#version 450 core
#include "draw/debug_params.glsl"

layout(location = 0) out vec3 box_position; // Position in the collider's axes.
layout(location = 1) flat out vec3 face;    // Outward normal.
layout(location = 2) flat out int number;

void main()
{
    hair_debug_collider own = params.shown[gl_InstanceID];
    // Two triangles on each of six sides.
    int   side   = gl_VertexID / 6, corner = gl_VertexID % 6, axis = side / 2;
    ivec2 at     = ivec2((0x32 >> corner) & 1, (0x2c >> corner) & 1);
    bvec3 upper  = bvec3(false);
    upper[axis]           = side % 2 == 1;
    upper[(axis + 1) % 3] = at.x == 1;
    upper[(axis + 2) % 3] = at.y == 1;
    box_position = mix(own.lower.xyz, own.upper.xyz, upper);
    face         = vec3(0.0);
    face[axis]   = side % 2 == 1 ? 1.0 : -1.0;
    number       = gl_InstanceID;
    gl_Position  = to_clip(own.collider.position.xyz + rotate(own.collider.rotation, box_position));
}
