// flow.h - The fluid around a ball without hair, measured by the suite `wind`.
#ifndef HAIR_TOOLS_BENCH_FLOW_H
#define HAIR_TOOLS_BENCH_FLOW_H

#include <epoxy/gl.h> // before headers that include OpenGL's own

#include "lib/api/api.h"
#include "tools/bench/bench.h"

#define FLOW_SIDE 0.8f // side of the box, m
#define FLOW_BALL 0.1f // radius of the ball in its middle, m
#define FLOW_WIND 5.0 // m/s along x

struct bench_flow {
    struct bench* bench;
    hair_groom* groom; // the field is around this groom
    struct hair_collider_field field;
    struct hair_colliders colliders;
    struct hair_fluid fluid;
    struct hair_fluid_now now;
    size_t faces, cells; // numbers of velocity components and of cells
};

// Create the fluid and enter the OpenGL state until bench_flow_die(). Return false after logging
// the reason.
bool bench_flow_live(struct bench* bench, const struct hair_fluid_desc* desc, bool ball,
                     struct bench_flow* out);
void bench_flow_die(struct bench_flow* flow);
bool bench_flow_step(struct bench_flow* flow);

// Return the divergence that hair_fluid_solve() leaves, as a fraction of the divergence before.
double bench_flow_residual(const struct bench_flow* flow);
// Return all velocities after the last step. Release them with free().
double* bench_flow_velocity(const struct bench_flow* flow);
// Return one velocity component at a place in cells from the box's corner.
double bench_flow_at(const struct bench_flow* flow, const double* velocity, int axis, const double place[3]);
// Return the net flux through the sphere one cell outside the ball, as a fraction of the inflow.
double bench_flow_flux(const struct bench_flow* flow, const double* velocity);
// Return the root mean square difference from the mirror image in a plane along the wind.
double bench_flow_asymmetry(const struct bench_flow* flow, const double* velocity, int axis);
// Return the velocity along the wind at a position along the wind and beside it, in radii from the
// ball's middle.
double bench_flow_beside(const struct bench_flow* flow, const double* velocity, double along, double beside);
double bench_flow_energy(const double* velocity, size_t faces);

// Add rows that compare the closed-form wind around the ball with the fluid's mean velocity.
// Defined in wake.c.
void bench_lee_compare(const struct bench_flow* flow, const double* mean);
// Add rows of the cost of both models. Defined in wake.c.
void bench_lee_cost(struct bench* bench);

#endif
