// field.h - the distance field.
#ifndef HAIR_SHARED_FIELD_H
#define HAIR_SHARED_FIELD_H

// Side of a brick, voxels. A work group writes one brick of the distance field.
#define HAIR_BRICK 8
#define HAIR_COLLIDER_TEXELS 6 // Per hair_field_collider.
#define HAIR_NO_COLLIDER 4294967295u // A collider's number that means that no collider is near.

// Place and range of the distance field.
struct hair_field_params {
    hair_vec4 rotation; // Head rotation, unit quaternion.
    // xyz: lower corner of the field's box in the head's frame, m. w: side of a voxel, m.
    hair_vec4 lower;
    // xyz: 1 / sides of the box, 1/m. w: distance that stands for all greater distances, m.
    hair_vec4 inverse;
};
HAIR_SIZE(hair_field_params)

// A collider in the head's frame.
struct hair_field_collider {
    hair_vec4 position; // xyz: m. w: rounding, m.
    hair_vec4 rotation; // Unit quaternion from its own axes to the head's.
    hair_vec4 size;     // xyz: as its shape says, m. w of a collision mesh: its scale.
    hair_vec4 grid;     // Grid of a collision mesh. xyz: first node, m. w: spacing of nodes, m.
    hair_uint nodes_x, nodes_y, nodes_z;
    hair_uint first;  // Index of its first node.
    hair_uint shape;  // hair_shape.
    hair_uint number; // Index among the instance's colliders.
    hair_uint unused0, unused1;
};
HAIR_SIZE(hair_field_collider)

// HAIR_BRICK^3 voxels, and colliders that reach into them. A brick with many colliders occurs
// several times.
struct hair_field_brick {
    hair_uint at;    // Position among bricks: x + (y << 10) + (z << 20).
    hair_uint first; // First member.
    hair_uint count;
    hair_uint round; // Number of work groups that must write the brick before.
};
HAIR_SIZE(hair_field_brick)

// Distance from a triangle of a body in which nodes find their nearest triangle, voxels.
#define HAIR_BODY_BAND 2
// Steps per voxel of the distance by which nodes find their nearest triangle.
#define HAIR_BODY_STEPS 4096
#define HAIR_BODY_TRIANGLE_BITS 18 // Bits of the index of a triangle.
#define HAIR_BODY_THREADS 32 // Threads in a work group of body_line.comp.

// Grid of a body.
struct hair_body_params {
    hair_uint nodes_x, nodes_y, nodes_z;
    hair_uint first; // Index of its first node among those of all meshes.
    hair_uint triangles;
    hair_uint is_closed; // 1 if the body has an inside.
    float     voxel; // Distance between nodes, m.
    float     shell; // Half the thickness of a body without an inside, m.
    hair_vec4 origin;       // xyz: first node, m.
    hair_vec4 lower, upper; // xyz: corners of the box of the vertices, voxels from the first node.
    hair_uint vertices;
    // Index of the first number in the application's buffer, and numbers from vertex to vertex.
    hair_uint given_first, given_stride;
    hair_uint is_first; // 1 if the body had no shape before.
};
HAIR_SIZE(hair_body_params)

// Part of a body that changes from one shape to the next. Threads find minima and maxima of it.
struct hair_body_change {
    // Box of the triangles that move, from both shapes, in bits of floats, voxels from the first
    // node. Nothing moves if the lower corner is above the upper corner.
    hair_uint lower_x, lower_y, lower_z, upper_x, upper_y, upper_z;
    // First and last column along x that has a node whose distance may change.
    hair_uint first_y, first_z, last_y, last_z;
    hair_uint unused0, unused1;
};
HAIR_SIZE(hair_body_change)

#endif
