// collide.h - colliders of the solvers, and the grid in which they are looked up.
#ifndef HAIR_SHARED_COLLIDE_H
#define HAIR_SHARED_COLLIDE_H

#define HAIR_STEP_COLLIDERS 64        // Maximum colliders in the parameters of a dispatch.
// Maximum colliders that the rod solvers test one by one. Grids are faster for more.
#define HAIR_FEW_COLLIDERS 16
#define HAIR_CELL_COLLIDERS 64        // Maximum colliders of a grid cell.
// Loop iterations over the colliders of a cell in a substep, where a thread counts them. See
// lib/sim/loop_budget.c.
#define HAIR_CONTACT_ROUNDS 4000
#define HAIR_CONTACT_TEXELS 13 // Per hair_contact.
// Bits of a cell member that are the number of its hair_contact.
#define HAIR_ENTRY_NUMBER 1048575u
#define HAIR_ENTRY_WALKED 16777216u // Bit of a cell member that is neither a sphere nor a capsule.
#define HAIR_ENTRY_LONG 33554432u   // Bit of a cell member that is not a sphere.

// A sphere with two equal ends, a capsule, or a capsule around another shape. It is given at the
// start and at the end of the step, from the head's origin.
struct hair_capsule {
    hair_vec4 start[2]; // xyz: ends of the axis, m. w: radius, m.
    hair_vec4 end[2];
    // xyz: rotation about its own axis over the step, radians. A sphere may rotate about any axis.
    // w: maximum distance that an end travels, m.
    hair_vec4 spin;
};
HAIR_SIZE(hair_capsule)

// The collider itself, where a hair_capsule only encloses it, at the start and at the end of the
// step.
struct hair_contact_body {
    // xyz: from the head's origin, m. [0].w: rounding, m. [1].w: factor of the friction.
    hair_vec4 position[2];
    hair_vec4 rotation[2]; // Unit quaternions of one hemisphere.
    hair_vec4 size;        // xyz: as the shape says, m. w: hair_shape.
};
HAIR_SIZE(hair_contact_body)

// Grid of a collision mesh.
struct hair_contact_mesh {
    hair_vec4 grid; // xyz: first node, m. w: spacing of nodes, m.
    hair_uint nodes_x, nodes_y, nodes_z;
    hair_uint first; // Index of its first node.
};
HAIR_SIZE(hair_contact_mesh)

// A collider, for scenes with any number of them.
struct hair_contact {
    HAIR_STRUCT(hair_capsule) around; // The collider, or a sphere around it.
    // size.x of a collision mesh is its scale. size.y is 1 if it has deformed over the step.
    HAIR_STRUCT(hair_contact_body) body;
    HAIR_STRUCT(hair_contact_mesh) mesh;
    // Sphere around the collider during the rest of the step. xyz: centre, m. w: radius with the
    // margin, m.
    hair_vec4 ball;
};
HAIR_SIZE(hair_contact)

#endif
