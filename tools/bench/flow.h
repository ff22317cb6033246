// flow.h - the fluid about a ball, by itself: what the suite `wind` measures.
#ifndef HAIR_TOOLS_BENCH_FLOW_H
#define HAIR_TOOLS_BENCH_FLOW_H

#include <epoxy/gl.h> // before what includes OpenGL's own header

#include "lib/api/api.h"
#include "tools/bench/bench.h"

#define FLOW_SIDE 0.8f // m: of the box
#define FLOW_BALL 0.1f // m: radius of the ball in its middle
#define FLOW_WIND 5.0 // m/s along x

struct bench_flow {
    struct bench* bench;
    hair_groom* groom; // the field is around it
    struct hair_solid_field field;
    struct hair_solids solids;
    struct hair_fluid fluid;
    struct hair_fluid_now now;
    size_t faces, cells; // of velocities; of cells
};

// With the OpenGL state entered until it dies. False: the log says why.
bool bench_flow_live(struct bench* bench, const struct hair_fluid_desc* desc, bool ball,
                     struct bench_flow* out);
void bench_flow_die(struct bench_flow* flow);
bool bench_flow_step(struct bench_flow* flow);

// What is left to be driven out of cells after hair_fluid_solve, as a share of what was.
double bench_flow_residual(const struct bench_flow* flow);
// Where the last step left it: to be freed; and one component at a place in cells from the box's corner.
double* bench_flow_velocity(const struct bench_flow* flow);
double bench_flow_at(const struct bench_flow* flow, const double* velocity, int axis, const double place[3]);
// Through the sphere one cell around the ball, as a share of what comes in through it.
double bench_flow_flux(const struct bench_flow* flow, const double* velocity);
// Root mean square difference from the mirror image in a plane along the wind.
double bench_flow_asymmetry(const struct bench_flow* flow, const double* velocity, int axis);
// Along the wind, so many of its radii from the ball's middle along it and beside it.
double bench_flow_beside(const struct bench_flow* flow, const double* velocity, double along, double beside);
double bench_flow_energy(const double* velocity, size_t faces);

// lee.c: rows of air by formulas against the fluid's mean, by the wind, past the ball; and of what either costs.
void bench_lee_compare(const struct bench_flow* flow, const double* mean);
void bench_lee_cost(struct bench* bench);

#endif
