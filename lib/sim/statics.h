// statics.h - poses of one guide under gravity and the pull to its groom: whether they are stable,
// and where it rests.
#ifndef HAIR_SIM_STATICS_H
#define HAIR_SIM_STATICS_H

#include "lib/sim/rod_shape.h"

struct hair_rod_pose {
    hair_dquat frame[HAIR_MAX_GUIDE_VERTICES]; // of segment i
    hair_dquat turn[HAIR_MAX_GUIDE_VERTICES]; // from the frame of segment i-1 to that of i, w >= 0
    hair_dvec3 place[HAIR_MAX_GUIDE_VERTICES]; // of vertex i, from the root
    hair_dvec3 force[HAIR_MAX_GUIDE_VERTICES]; // on all beyond segment i, as its frame sees it
    hair_dvec3 stress[HAIR_MAX_GUIDE_VERTICES]; // derivative of vertex i's energy by its strain
    double real_stress[HAIR_MAX_GUIDE_VERTICES]; // derivative by 2 w, w the real part of `turn`
};

// Rest shape of a vertex. x, y, z: rest strain; w: 2 w at rest.
typedef hair_dquat hair_rod_rest;

// Set frames, turns and places. The scalp keeps its frame.
void hair_rod_pose_at(const struct hair_rod_shape* shape, const hair_dquat* frames,
                      struct hair_rod_pose* out);

// Set the forces to those of the pull and of `gravity` times the shape's load.
void hair_rod_load(const struct hair_rod_shape* shape, double gravity, struct hair_rod_pose* pose);

// Set the stress to the one that balances the forces, if 2 w at rest is that of the pose.
void hair_rod_balance(const struct hair_rod_shape* shape, struct hair_rod_pose* pose);

// Set the stress to that of the shape's stiffness with this rest shape.
void hair_rod_strain(const struct hair_rod_shape* shape, const hair_rod_rest* rest,
                     struct hair_rod_pose* pose);

// Return whether, undamped, all small motions about the pose are oscillations at more than that
// squared angular frequency; above 0 the pose is stable. The pose's forces and stress are those
// that it has.
int hair_rod_is_stable(const struct hair_rod_shape* shape, const struct hair_rod_pose* pose,
                       double squared_frequency);

// Find the turns of the segments, as their frames see them, to where the energy is least if it is
// taken to second order about the pose. `slope` is its derivative by the turns. `shift` is added to
// the diagonal of its matrix. Return 0 when there is no least.
int hair_rod_find_step(const struct hair_rod_shape* shape, const struct hair_rod_pose* pose, double shift,
                       const hair_dvec3* slope, hair_dvec3* out);

// Move a pose to where it is stable under `gravity` times the load, by at most so many steps of
// Newton's method. Return the torque that is left on a segment, at most, over that of the whole
// weight at the end of the whole strand.
double hair_rod_settle(const struct hair_rod_shape* shape, const hair_rod_rest* rest, double gravity,
                       uint32_t steps, struct hair_rod_pose* pose);

#endif
