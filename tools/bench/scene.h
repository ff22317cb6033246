// scene.h - one strand, its material, its solver, its head: what a row measures; and the same as a rod of
// lib/reference.
#ifndef HAIR_TOOLS_BENCH_SCENE_H
#define HAIR_TOOLS_BENCH_SCENE_H

#include <hair/hair.h>

#include "lib/reference/rod.h"

#define BENCH_MOST_VERTICES 256
#define BENCH_PI 3.14159265358979323846
#define BENCH_GRAVITY 9.81

struct bench_scene {
    float positions[3 * BENCH_MOST_VERTICES]; // at rest, in the head's frame
    uint32_t vertices;
    uint32_t strands; // alike
    hair_solver solver;
    hair_mapping mapping;
    double substep; // s; 0: as the solver wants
    double max_dt; // s
    hair_physics physics;
    hair_wind wind;

    struct hair_reference_rod_pose head; // at the start
};

// No pull, damping, margin or hold: what is left is a rod in gravity. One strand, of no vertices.
struct bench_scene bench_scene_default(void);

// A straight strand of `length` from `root`, along the unit vector `along`.
void bench_scene_straight(struct bench_scene* scene, uint32_t vertices, double length, const double root[3],
                          const double along[3]);

// Vertices on a circular arc, rooted at 0, that leaves along `along` and turns by `turn` radians towards `across`.
void bench_scene_arc(struct bench_scene* scene, uint32_t vertices, double length, double turn,
                     const double along[3], const double across[3]);

// Young's modulus such that rho A g L^3 / (E I) is `gamma` under the 9.81 m/s^2, its section being round.
void bench_scene_set_gamma(struct bench_scene* scene, double length, double gamma);

double bench_scene_length(const struct bench_scene* scene); // m, along the chords

// Bending stiffness about the section's x and z, and that of twist, N m^2; mass of a metre, kg.
struct bench_section {
    double bend[2], twist, line_density;
};
struct bench_section bench_section_of(const hair_physics* physics);

// Turned by `angle` about the unit vector `axis` through the origin, then moved.
struct hair_reference_rod_pose bench_pose(const double axis[3], double angle, const double move[3]);
void bench_matrix(const struct hair_reference_rod_pose* pose, float matrix[16]);

// The strand in double precision. NULL: its numbers make no rod.
struct hair_reference_rod* bench_reference(const struct bench_scene* scene);

const char* bench_solver_name(hair_solver solver);

#endif
