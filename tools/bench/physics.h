// physics.h - Functions that the files of the suite `physics` share.
#ifndef HAIR_TOOLS_BENCH_PHYSICS_H
#define HAIR_TOOLS_BENCH_PHYSICS_H

#include "tools/bench/live_scene.h"

#define BENCH_RODS 2 // rod solvers that the suite tests
extern const hair_solver bench_rod_solvers[BENCH_RODS];

// Value of `limit` for a row without a limit.
#define BENCH_NO_LIMIT (-1.0)

// Add a row with relative_error = |measured / expected - 1|, or |measured| if `expected` is 0. The
// row passes if relative_error is at most `limit`.
json_t* bench_physics_row(struct bench_live_scene* live, const char* name, double expected, double measured,
                          double limit, const char* reference);

// Create the scene with the solver's own substep, shortened if needed such that it divides `dt`.
// Strands are read at the end of the last substep. Return false if the library refused.
bool bench_live_in_step(struct bench* bench, struct bench_scene* scene, double dt,
                        struct bench_live_scene* out);

// Return a level straight strand of `length` whose root is at x = `root`, with a damping of 4/s.
struct bench_scene bench_level_scene(const struct bench* bench, hair_solver solver, uint32_t vertices,
                                     double root, double length);

// Return the maximum distance between corresponding vertices, or NaN if any position is NaN.
double bench_farthest(const double* a, const double* b, uint32_t vertices);

// Run the cases of the suite. Their files are physics_rest.c, physics_swing.c, physics_order.c,
// physics_same.c, drag.c, physics_body.c, physics_spin.c, physics_capstan.c and physics_fine.c.
void bench_cantilever(struct bench* bench);
void bench_catenary(struct bench* bench);
void bench_bend_twist(struct bench* bench);
void bench_lateral_buckling(struct bench* bench);
void bench_chain_modes(struct bench* bench);
void bench_pendulums(struct bench* bench);
void bench_order(struct bench* bench);
void bench_energy(struct bench* bench);
void bench_frame_rates(struct bench* bench);
void bench_vertex_counts(struct bench* bench);
void bench_drag(struct bench* bench);
void bench_still_air(struct bench* bench);
void bench_whip_energy(struct bench* bench);
void bench_free_bodies(struct bench* bench);
void bench_head_spin(struct bench* bench);
void bench_capstan(struct bench* bench);
void bench_tip_masses(struct bench* bench);
void bench_fine_segments(struct bench* bench);

#endif
