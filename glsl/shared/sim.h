// sim.h - guides in motion: the solvers' state, parameters and results.
#ifndef HAIR_SHARED_SIM_H
#define HAIR_SHARED_SIM_H

// Maximum Newton steps of the mixed scheme in a substep. The first is for a work group, the second
// for a thread that solves a guide of n vertices.
#define HAIR_MIXED_STEPS 16u
#define HAIR_MIXED_STEPS_BY_THREAD(n) ((n) <= 32 ? 16u : (n) <= 64 ? 12u : (n) <= 128 ? 8u : 5u)
// Vectors in a row of the mixed scheme. See glsl/sim/mixed_rows.glsl.
#define HAIR_MIXED_ROW_VECTORS 14u

// Counters at HAIR_BIND_SOLVER_STATS. hair_solver_stats defines what they count.
#define HAIR_SOLVER_STATS_EULER_FALLBACKS 0
#define HAIR_SOLVER_STATS_FOLLOW_FALLBACKS 1
#define HAIR_SOLVER_STATS_RESET 2
#define HAIR_SOLVER_STATS_OVEREXTENDED 3
#define HAIR_SOLVER_STATS_PARTS 4
#define HAIR_SOLVER_STATS_GAINING 5
#define HAIR_SOLVER_STATS_COUNT 6
// Results of motion.comp at HAIR_BIND_FOUND. hair_solver_stats defines them.
#define HAIR_FOUND_RESTLESS 0
#define HAIR_FOUND_OVERSTRETCHED 1
#define HAIR_FOUND_FASTEST 2 // m/s, as bits of a float.
#define HAIR_FOUND_STRETCH 3 // Relative error of a length, as bits of a float.
#define HAIR_FOUND_COUNT 4
// Assumed maximum distance by which the fitting of lengths moves a vertex beyond its free motion,
// in metres.
#define HAIR_CONTACT_FIT 0.02
// Texels per guide vertex at HAIR_IMAGE_IMPULSE. Texels 0 and 1: impulses of two colliders, each
// divided by line density, m^2/s. w: number of the collider in the solver, from 1. Texels 2 and 3:
// their parts along normals. w of texel 2: collider that the vertex touched last, from 1.
#define HAIR_IMPULSE_TEXELS 4
// Numbers per collider at HAIR_BIND_IMPULSE_SUM. There are 13 integers of 64 bits in units of
// HAIR_IMPULSE_UNIT: impulse, its moment about the head's origin, its part along normals, place
// times size of each impulse, and size. The number of vertices follows.
#define HAIR_IMPULSE_WORDS 28
#define HAIR_IMPULSE_UNIT 9.094947017729282e-13 // 2^-40 m^2/s.
// Guides per work group in programs with HAIR_PASS1, one subgroup per guide.
#define HAIR_PASS1_GUIDES 28
// Two headers, used alternately, follow the counters at HAIR_SOLVER_STATS_COUNT. A header holds the
// work group counts x, y and z of an indirect dispatch over a list of guides, then the list's
// length. The guide numbers of the current dispatch's list begin at HAIR_SOLVER_STATS_LISTS.
#define HAIR_SOLVER_STATS_LIST 4 // Numbers in a header.
#define HAIR_SOLVER_STATS_LISTS (HAIR_SOLVER_STATS_COUNT + 2 * HAIR_SOLVER_STATS_LIST)

// A guide vertex in motion. Positions are relative to the head's origin, because floats then
// resolve micrometres far from the world's origin. The displacement is stored and not differenced,
// for the same reason.
struct hair_state {
    // xyz: position along the world's axes from the head's origin, at the end of the substep, m. w
    // of a guide's first vertex: known history. 0 means none, and the guide is at rest. 1 means the
    // displacement. 2 means hair_history as well. See predict.glsl.
    hair_vec4 position;
    // xyz: displacement over the last substep, in the world, m. w: tension / line density, m^2/s^2.
    hair_vec4 displacement;
};
HAIR_SIZE(hair_state)

// A pin of a guide vertex, beside the scalp. Pins are in the order of guides and their vertices.
struct hair_held {
    // xyz: target at the end of the step, m. w: 0 if the target is in groom space, -1 if it is in
    // the world, from the head's origin.
    hair_vec4 place;
    // Span that ends at this pin. x, y: pinned vertices at its ends, counted from the guide's root.
    // z: length between them at rest, m. 0 if nothing holds the guide before this pin. w: 1 if the
    // next pin in the list is of the same guide.
    hair_vec4 span;
};
HAIR_SIZE(hair_held)

// History of a guide vertex for BDF2, beside its state. Velocities are stored as displacements per
// substep.
struct hair_history {
    hair_vec4 rate;        // xyz: at the end of the last substep, m.
    // xyz: at the end of the substep before the last, m. w: 1 if the vertex touched a collider at
    // the end of the last substep.
    hair_vec4 rate_before;
};
HAIR_SIZE(hair_history)

// Pose of the head at the end of a substep.
struct hair_substep {
    hair_vec4 rotation;     // Unit quaternion.
    // xyz: displacement of the head's origin over the substep, m. w: fraction of the step done at
    // its end.
    hair_vec4 displacement;
};
HAIR_SIZE(hair_substep)

// Parameters of a step that all its substeps share. Frequencies are angular.
struct hair_step_params {
    hair_vec4 gravity;   // xyz: m/s^2. w: length of a substep, s.
    float     keep;      // Fraction of the velocity left after a substep: exp(-damping dt).
    float     shape_frequency_root; // Frequency of the pull to the rest pose at the root, 1/s.
    float     shape_frequency_tip; // Frequency of the pull at the tip, 1/s.
    float     angular; // Square of the frequency of angular forces, 1/s^2.
    float     bend;    // Fraction of the bending error that an iteration corrects.
    float     collision_margin;  // m.
    hair_uint iterations;
    hair_uint substeps;
    hair_uint guides;
    hair_uint colliders;
    hair_uint smooth_vertices; // Per guide.
    float     alpha;           // Current time within the last substep. 0 is its start, 1 its end.
    hair_vec4 rotation_before; // Head rotation at the start of the last substep.
    hair_vec4 rotation_after;  // Head rotation at the end of the last substep.
    hair_vec4 rotation_now;
    hair_vec4 last_displacement; // xyz: displacement of the head's origin over the last substep, m.
    // Parameters of the rod solvers.
    hair_vec4 rotation_start; // Head rotation at the start of the first substep of this dispatch.
    // Stiffness about the section's x axis, about the strand's axis, and about the section's z
    // axis. All are relative to bending.
    hair_vec4 ratio;
    // h (1 - exp(-damping h)) / damping, s^2, with h the length of a substep. Displacement per
    // acceleration.
    float     kick;
    float     damping;        // 1/s.
    float     friction;
    float     fraction_start; // Fraction of the step done before this dispatch.
    // Factor of displacements after a change of the substep's length. Otherwise 1.
    float     rescale;
    hair_uint vertices; // Vertices of all guides. All solvers have this member.
    hair_uint bodies; // One bit per collider that is not a capsule, of HAIR_FEW_COLLIDERS.
    hair_uint rounds; // Rounds of implicit.glsl's cyclic reduction before its last.
    hair_uint list;   // 0 or 1. This dispatch's header in solver_stats[].
    hair_uint substep_first; // Index in `substep` at which this dispatch begins.
    hair_uint part_rounds; // Loop iterations that parts of a substep may take. See leap_parts.glsl.
    hair_uint list_guides; // Guides of the list per work group of the second program.
    hair_uint simulated; // Number of guides that are simulated.
    hair_uint guide_stride; // One guide of so many is simulated, in the order of guides.
    hair_uint guide_order; // Index in solver_stats[] of the order of guides.
    // Fraction of the difference from its parent that a derived guide keeps over the dispatch.
    float     guide_keep;
    // Parameters of the grid for looking up any number of colliders, from the head's origin.
    hair_vec4 cells_lower; // xyz: lower corner, m. w: 1 / side of a cell, 1/m.
    hair_uint cells_x, cells_y, cells_z;
    // Half the length of a vertex's path on which the grid finds everything that it can touch, m.
    float     cells_slack;
    HAIR_STRUCT(hair_substep) substep[HAIR_STEP_SUBSTEPS];
    HAIR_STRUCT(hair_capsule) collider[HAIR_STEP_COLLIDERS];
    HAIR_STRUCT(hair_contact_body) body[HAIR_STEP_COLLIDERS];
    HAIR_STRUCT(hair_contact_mesh) mesh[HAIR_FEW_COLLIDERS];
};
HAIR_SIZE(hair_step_params)

#define HAIR_GRID_NODES 32       // Maximum along an axis.
// Integers per node of the hair-hair grid. Index 0 is the mass. The constants below are the other
// indices. Positions are relative to the node, in cells.
#define HAIR_GRID_NODE_NUMBERS 18
#define HAIR_GRID_MOMENTUM 1u    // Three.
#define HAIR_GRID_VOLUME 4u      // One.
#define HAIR_GRID_MOMENT 5u      // Three: mass times position.
#define HAIR_GRID_ANGULAR 8u     // Three: angular momentum.
#define HAIR_GRID_SQUARES 11u    // Three: mass times position squared, xx, yy and zz.
#define HAIR_GRID_PRODUCTS 14u   // Three: mass times position squared, yz, zx and xy.
// Sum of mass times the mass of the same guide at the node, times hair_grid_params.per_strand.
#define HAIR_GRID_ALIKE 17u
// Maximum speed along an axis relative to the head, m/s. Greater speeds are clamped to it.
#define HAIR_GRID_SPEED 16.0f

// Contribution of a guide vertex to the hair-hair grid, in the grid's units.
struct hair_grid_splat {
    hair_uint mass, volume;
    hair_uint first, end; // Vertices of its guide.
};
HAIR_SIZE(hair_grid_splat)

// Hair at a node of the hair-hair grid. Positions are relative to the node, in cells. All 0 without
// hair.
struct hair_grid_node {
    hair_vec4 centre; // xyz: centre of mass. w: 0 for a strand alone, 1 from two strands on.
    // xyz: velocity of the centre, divided by HAIR_GRID_SPEED. w: fraction of the volume that is
    // above what the node holds.
    hair_vec4 speed;
    hair_vec4 turn; // xyz: angular velocity, in the unit of speeds per cell. w: 0.
};
HAIR_SIZE(hair_grid_node)

// Parameters of the hair-hair grid of mass, momentum and volume. The grid moves with the head.
struct hair_grid_params {
    hair_vec4 rotation; // Head rotation at the end of the last substep.
    // xyz: displacement of the head's origin over the last substep, m. w: speed per displacement,
    // 1/s.
    hair_vec4 moved;
    hair_vec4 lower;    // xyz: node 0, in the head's frame, m. w: spacing of nodes, m.
    hair_uint nodes_x, nodes_y, nodes_z;
    hair_uint vertices;  // Vertices of all guides.
    float     cohesion;  // Rate at which relative velocities are removed, 1/s.
    float     pressure_stiffness;    // Pressure coefficient, m^2/s^2.
    // Cells travelled to the middle of a block at HAIR_GRID_SPEED. 0 leaves positions as they are.
    float     ahead;
    // 1 / mass, in units, of a length of strand that never lies at one node.
    float     per_strand;
};
HAIR_SIZE(hair_grid_params)

// Parameters of the activity test of guides that may have come to rest.
struct hair_activity_params {
    hair_uint vertices; // Vertices of all guides.
    hair_uint parity;     // 0 or 1. The answer that is written. The other one is cleared.
    hair_uint anchors;  // 1 if the current positions become the anchors.
    float     rate;     // Speed per displacement, 1/s.
};
HAIR_SIZE(hair_activity_params)

// Parameters by which motion.comp measures guides after the last substep.
struct hair_motion_params {
    hair_vec4 turn;  // Rotation of the head over the last substep, unit quaternion.
    // xyz: displacement of the head over the last substep, m. w: speed per displacement, 1/s.
    hair_vec4 moved;
    hair_uint guides;
    // Time for which nothing has driven the guides, s. Below 0 no guide is restless.
    float     calm;
    float     wait;  // Time that damping needs to calm any guide, s.
    float     creep; // Time added to `wait` per metre of a guide's length, s/m.
};
HAIR_SIZE(hair_motion_params)

// Parameters by which energy.comp watches the guides after a step.
struct hair_energy_params {
    hair_uint begins; // 1 if this step begins a new observation.
    hair_uint ends;   // 1 if the window ends with this step.
    float     time;   // Length of the step's substeps, s.
    float     rate;   // Speed per displacement, 1/s.
};
HAIR_SIZE(hair_energy_params)

// Mechanical energy of a guide, divided by its mass per metre, m^3/s^2.
struct hair_energy {
    // x: kinetic energy. y: energy of gravity, 0 at the root. z: energy of bending and twist. w:
    // energy of the pull to the rest pose.
    hair_vec4 now;
    // x: upper bound of energy and loss. y: their maximum in this window. z: half of the energy
    // that damping has taken in this window. w: greatest kinetic energy. Each earlier window counts
    // half as much as the one after it.
    hair_vec4 window;
};
HAIR_SIZE(hair_energy)

// Times of hair_root_transform.
#define HAIR_ROOT_TRANSFORM_THEN 0 // End of the last substep before this step.
#define HAIR_ROOT_TRANSFORM_START 1  // Start of this step.
#define HAIR_ROOT_TRANSFORM_END 2    // End of this step.
#define HAIR_ROOT_TRANSFORM_BEFORE 3 // Start of the last substep done.
#define HAIR_ROOT_TRANSFORM_AFTER 4  // End of the last substep done.
#define HAIR_ROOT_TRANSFORMS 5

// Scalp motion of a guide's root in the head. The rest pose is rotated about the root, then
// shifted.
struct hair_root_transform {
    hair_vec4 shift[HAIR_ROOT_TRANSFORMS]; // xyz: m, in the head's frame.
    hair_vec4 turn[HAIR_ROOT_TRANSFORMS];  // Unit quaternions.
};
HAIR_SIZE(hair_root_transform)

// Joints that move a vertex of the scalp, and their weights. The sum of the weights is 1.
struct hair_vertex_joints {
    hair_uint joint0, joint1, joint2, joint3;
    hair_vec4 weights;
};
HAIR_SIZE(hair_vertex_joints)

// Matrix of a joint, by rows. It takes a position at rest to the space of the application.
struct hair_joint {
    hair_vec4 row0, row1, row2; // xyz: linear part. w: translation, m.
};
HAIR_SIZE(hair_joint)

// Guide whose length changes, before the change.
struct hair_length_change {
    hair_uint guide;
    hair_uint count; // Number of vertices.
    float     last;  // Length of the last segment, m.
    hair_uint unused0;
};
HAIR_SIZE(hair_length_change)

// Bit of hair_target_params.flags.
#define HAIR_TARGETS_RESET 1u // There is no history. Vertices get their weights at once.

// Parameters of target poses. A target in the head's frame is rotation (position + offset).
struct hair_target_params {
    hair_vec4 rotation;
    hair_vec4 offset; // xyz: m.
    // Factor of the weight along the strand: cubic polynomials of the intervals.
    hair_vec4 along[HAIR_CURVE_INTERVALS];
    float     max_change; // Maximum change of a weight in a substep.
    float     strength; // Factor of all weights. 0 while the targets end, otherwise 1.
    hair_uint flags; // HAIR_TARGETS_ bits.
    hair_uint unused0;
};
HAIR_SIZE(hair_target_params)

// Bits of hair_scalp_params.what.
#define HAIR_SCALP_CHANGED 1u // The scalp was set since the last step.
#define HAIR_SCALP_RESET 2u // There is no history.
#define HAIR_SCALP_AGAIN 4u // The step has already begun. Only its substeps continue.

// Parameters of the passes of a skinned scalp. A position in the head's frame is rotation (position
// + offset).
struct hair_scalp_params {
    hair_vec4 rotation;
    hair_vec4 offset;   // xyz: m.
    hair_uint vertices; // Vertices of the scalp.
    hair_uint guides;
    hair_uint followers;
    hair_uint first, stride; // First position and stride in the application's buffer, in floats.
    hair_uint flags;          // HAIR_SCALP_ bits.
    hair_uint substeps;      // Substeps of this step.
    // Fraction of the step done at the start of its last substep, where it has two or more.
    float     fraction_before;
    float     fraction_after;   // Fraction of the step done at the end of its last substep.
    hair_uint smooth_vertices;
    hair_uint unused0, unused1;
};
HAIR_SIZE(hair_scalp_params)

#endif
