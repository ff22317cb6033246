// rod_statics.h - poses of one guide under gravity and the pull to its groom. The functions test
// poses for stability and find poses of rest. They are the reference of lib/rod/block_statics.h,
// which computes several guides at once.
#ifndef HAIR_TESTS_SUPPORT_ROD_STATICS_H
#define HAIR_TESTS_SUPPORT_ROD_STATICS_H

#include "lib/rod/rod_shape.h"

#include <stdbool.h>

// Result of hair_rod_preload_gravity().
struct hair_rod_preload {
    double stiffest; // Largest multiple of the stiffness. 1 if no vertex is stiffened.
    double sag; // Largest distance of a vertex at rest from the groom, m. 0 if the groom holds.
    int sags;
};
// Set stress and rest_real of a new shape so that the shape holds its groom, and stiffen the shape
// as far as this needs. This is the reference of hair_rods_preload_gravity().
struct hair_rod_preload hair_rod_preload_gravity(struct hair_rod_shape* shape);

struct hair_rod_pose {
    hair_dquat frame[HAIR_MAX_GUIDE_VERTICES]; // Frame of segment i.
    hair_dquat turn[HAIR_MAX_GUIDE_VERTICES]; // Rotation from frame i-1 to frame i, w >= 0.
    hair_dvec3 place[HAIR_MAX_GUIDE_VERTICES]; // Position of vertex i, from the root.
    hair_dvec3 force[HAIR_MAX_GUIDE_VERTICES]; // Force on all beyond segment i, in frame i.
    hair_dvec3 stress[HAIR_MAX_GUIDE_VERTICES]; // Derivative of vertex i's energy by its strain.
    // Derivative of vertex i's energy by 2 w, where w is the real part of `turn`.
    double real_stress[HAIR_MAX_GUIDE_VERTICES];
};

// Rest shape of a vertex. xyz is the rest strain. w is 2 w at rest.
typedef hair_dquat hair_rod_rest;

// Set frames, turns and places of a pose. The scalp keeps its frame.
void hair_rod_pose_at(const struct hair_rod_shape* shape, const hair_dquat* frames,
                      struct hair_rod_pose* out);

// Set the forces of a pose to the pull to the groom and `gravity` times the shape's load.
void hair_rod_load(const struct hair_rod_shape* shape, double gravity, struct hair_rod_pose* pose);

// Set the stress to the one that balances the forces, where 2 w at rest equals 2 w of the pose.
void hair_rod_balance(const struct hair_rod_shape* shape, struct hair_rod_pose* pose);

// Set the stress that results from the shape's stiffness and a rest shape.
void hair_rod_strain(const struct hair_rod_shape* shape, const hair_rod_rest* rest,
                     struct hair_rod_pose* pose);

// Return whether all small undamped motions about the pose are oscillations with more than the
// given squared angular frequency. The pose is stable if this holds for 0. The forces and the
// stress of the pose are set.
bool hair_rod_is_stable(const struct hair_rod_shape* shape, const struct hair_rod_pose* pose,
                        double squared_frequency);

// Second derivatives of a vertex's energy by the turns a before and b after it. See
// rod_variation.c.
struct hair_rod_hinge {
    double before[6], after[6]; // Entries 00, 10, 11, 20, 21 and 22 by a a and by b b.
    double between[3][3]; // Row r has the derivatives by component r of b.
};

// Columns of the derivative of a segment by its turn, of which the second is 0. See
// rod_variation.c.
struct hair_rod_swing {
    double x[3], z[3];
};

// Terms of a segment in the energy of small motions.
struct hair_rod_segment_terms {
    hair_dvec3 force; // Force on all beyond the segment, in its frame, times its length.
    double pull; // Stiffness of the pull at the end of the segment, less that of slow motions.
    struct hair_rod_swing swing;
};

// Stability of a pose for any stiffness. Everything that the stiffness does not change is computed
// once.
struct hair_rod_stability {
    struct hair_rod_stability_vertex {
        struct hair_rod_hinge unit; // Part of the hinge that is multiplied by the stiffness.
        double self, between[3][3]; // Part of the hinge that the stress causes.
        struct hair_rod_segment_terms terms;
    } vertex[HAIR_MAX_GUIDE_VERTICES];
};

// Prepare tests for small motions of at least the given squared angular frequency.
void hair_rod_prepare_stability(const struct hair_rod_shape* shape, const struct hair_rod_pose* pose,
                                double squared_frequency, struct hair_rod_stability* out);

// Return the result of hair_rod_is_stable() with the present stiffness of the shape.
bool hair_rod_test_stability(const struct hair_rod_shape* shape, const struct hair_rod_pose* pose,
                             const struct hair_rod_stability* stability);

// Find the turns of the segments, in their own frames, that minimise the energy to second order
// about the pose. `slope` is the derivative of the energy by the turns. `shift` is added to the
// diagonal of the matrix of second derivatives. Return false if there is no minimum.
bool hair_rod_find_step(const struct hair_rod_shape* shape, const struct hair_rod_pose* pose, double shift,
                        const hair_dvec3* slope, hair_dvec3* out);

// Move a pose to a stable equilibrium under `gravity` times the load, by at most `steps` steps of
// Newton's method. Return the maximum torque that is left on a segment. The torque is relative to
// that of the whole weight at the end of the whole strand.
double hair_rod_settle(const struct hair_rod_shape* shape, const hair_rod_rest* rest, double gravity,
                       uint32_t steps, struct hair_rod_pose* pose);

#endif
