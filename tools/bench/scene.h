// scene.h - One strand with its material, solver and head, as measured by a row, and its conversion
// to a rod of tests/reference.
#ifndef HAIR_TOOLS_BENCH_SCENE_H
#define HAIR_TOOLS_BENCH_SCENE_H

#include <hair/hair.h>

#include "tests/reference/rod.h"

#define BENCH_MAX_VERTICES 256
#define BENCH_PI 3.14159265358979323846
#define BENCH_GRAVITY 9.81

struct bench_scene {
    float positions[3 * BENCH_MAX_VERTICES]; // at rest, in the head's frame
    uint32_t vertices;
    uint32_t strands; // identical strands
    hair_solver solver;
    hair_thread_mapping mapping;
    double substep; // s, 0 uses the solver's default
    double max_dt; // s
    hair_physics physics;
    hair_wind wind;

    struct hair_reference_rod_pose head; // at the start
};

// Return a scene of one strand without vertices. Pull, damping, margin and gravity preload are 0,
// which leaves a rod under gravity.
struct bench_scene bench_scene_default(void);

// Set a straight strand of `length` from `root` along the unit vector `along`.
void bench_scene_straight(struct bench_scene* scene, uint32_t vertices, double length, const double root[3],
                          const double along[3]);

// Set vertices on a circular arc from the origin. The arc starts along `along` and turns by `turn`
// radians towards `across`.
void bench_scene_arc(struct bench_scene* scene, uint32_t vertices, double length, double turn,
                     const double along[3], const double across[3]);

// Set Young's modulus such that rho A g L^3 / (E I) is `gamma` with g = 9.81 m/s^2 and a round
// section.
void bench_scene_set_gamma(struct bench_scene* scene, double length, double gamma);

// Return the length along the chords, m.
double bench_scene_length(const struct bench_scene* scene);

// Bending stiffness about the section's x and z and twist stiffness, in N m^2, and mass per length,
// in kg/m.
struct bench_section {
    double bend[2], twist, line_density;
};
struct bench_section bench_section_of(const hair_physics* physics);

// Return a rotation by `angle` about the unit vector `axis` through the origin, followed by a
// translation.
struct hair_reference_rod_pose bench_pose(const double axis[3], double angle, const double move[3]);
void bench_matrix(const struct hair_reference_rod_pose* pose, float matrix[16]);

// Return whether the solver has the energy of the chord between tangents. This energy is that of
// straight strands. It needs no frames, and differs from the energy of turns by discretization.
bool bench_has_chord_energy(const struct bench_scene* scene);

// Create the strand as a rod in double precision. Return NULL if its numbers do not make a rod.
struct hair_reference_rod* bench_reference(const struct bench_scene* scene);

const char* bench_solver_name(hair_solver solver);

#endif
