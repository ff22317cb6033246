// living.h - a scene brought to life through the library's public interface, stepped, read and timed.
#ifndef HAIR_TOOLS_BENCH_LIVING_H
#define HAIR_TOOLS_BENCH_LIVING_H

#include "tools/bench/bench.h"
#include "tools/bench/scene.h"
#include "tools/bench/timer.h"

struct bench_living {
    struct bench* bench;
    const struct bench_scene* scene; // outlives it
    hair_groom* groom;
    hair_instance* hair;
    double substep; // s
    float* read; // of all strands
    float positions[3 * BENCH_MOST_VERTICES]; // at rest, as the groom has them
    double length; // of the strand, m
    double lengths[BENCH_MOST_VERTICES];
};

// False: the library refused, and bench->sentence says why.
bool bench_live(struct bench* bench, const struct bench_scene* scene, struct bench_living* out);
void bench_die(struct bench_living* living);

// Back to rest, the head where it starts. False: the library refused.
bool bench_restart(struct bench_living* living);

// One frame with the head at `head` at its end (NULL: it stays). False: the library refused.
bool bench_step(struct bench_living* living, const struct hair_reference_rod_pose* head, double dt);

// Substeps in a frame of 1/60 s.
double bench_substeps(const struct bench_living* living);

// Frames of 1/60 s until the strand moves by less than a millionth of its length in half a second, 30 s at most.
// False: the library refused.
bool bench_settle(struct bench_living* living, double* positions);

// The first strand, in the world, after its last substep. False: the library refused.
bool bench_read(struct bench_living* living, double* positions);

// Whether all strands are the first to the bit.
bool bench_strands_are_alike(struct bench_living* living);

// Largest |length / rest length - 1| of the segments.
double bench_stretch(const struct bench_living* living, const double* positions);

bool bench_are_finite(const double* positions, uint32_t vertices);

// `frames` frames, again and again from rest. heads[k]: the head at the end of frame k (NULL: it stays). All must be
// warm: they have been run before.
bool bench_time(struct bench_living* living, uint32_t frames, const struct hair_reference_rod_pose* heads,
                double dt, struct bench_times* out);

// What every row says of its solver and material.
#define BENCH_MATERIAL_COLUMNS                                                                               \
    "solver", "mapping", "substep", "young", "poisson", "fiber_radius", "fiber_density", "flatness", "damping"
void bench_set_material(json_t* row, const struct bench_living* living);

#endif
