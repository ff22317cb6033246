// physics.h - what the files of the suite `physics` share.
#ifndef HAIR_TOOLS_BENCH_PHYSICS_H
#define HAIR_TOOLS_BENCH_PHYSICS_H

#include "tools/bench/living.h"

#define BENCH_RODS 2 // Solvers of rods that the suite holds to physics.
extern const hair_solver bench_rod_solvers[BENCH_RODS];

// `limit` of a row that has none.
#define BENCH_NO_LIMIT (-1.0)

// A row with relative_error = |measured / expected - 1|, or |measured| where 0 is expected; it passes when that is
// within `limit`.
json_t* bench_physics_row(struct bench_living* living, const char* name, double expected, double measured,
                          double limit, const char* reference);

// Create the scene with the substep that the solver wants, shortened where needed so that it divides `dt`: strands
// are read where the last substep left them. Return false when the library refused.
bool bench_live_in_step(struct bench* bench, struct bench_scene* scene, double dt, struct bench_living* out);

// Return a level straight strand of `length` whose root is at x = `root`, with a damping of 4/s.
struct bench_scene bench_level_scene(const struct bench* bench, hair_solver solver, uint32_t vertices,
                                     double root, double length);

// Return the greatest distance between vertices of the same number, or NaN where a position is.
double bench_farthest(const double* a, const double* b, uint32_t vertices);

// physics_rest.c, physics_swing.c, physics_order.c, physics_same.c, drag.c, physics_body.c, physics_spin.c,
// physics_capstan.c, physics_fine.c: the cases.
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
void bench_whip_energy(struct bench* bench);
void bench_free_bodies(struct bench* bench);
void bench_head_spin(struct bench* bench);
void bench_capstan(struct bench* bench);
void bench_tip_masses(struct bench* bench);
void bench_fine_segments(struct bench* bench);

#endif
