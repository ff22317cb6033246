// live_scene.h - A scene that is simulated through the library's public interface, stepped, read
// and timed.
#ifndef HAIR_TOOLS_BENCH_LIVE_SCENE_H
#define HAIR_TOOLS_BENCH_LIVE_SCENE_H

#include "tools/bench/bench.h"
#include "tools/bench/scene.h"
#include "tools/bench/timer.h"

struct bench_live_scene {
    struct bench* bench;
    const struct bench_scene* scene; // must outlive this struct
    hair_groom* groom;
    hair_instance* hair;
    double substep; // s
    float* read; // buffer for all strands
    float positions[3 * BENCH_MAX_VERTICES]; // rest positions after the groom's repairs
    double length; // length of the strand, m
    double lengths[BENCH_MAX_VERTICES];
};

// Create the scene. Return false after writing the reason to bench->sentence.
bool bench_live(struct bench* bench, const struct bench_scene* scene, struct bench_live_scene* out);
void bench_free_live_scene(struct bench_live_scene* live);

// Reset to the rest state with the head at its start. Return false if the library refused.
bool bench_restart(struct bench_live_scene* live);

// Simulate one frame with the head at `head` at its end. NULL keeps the head in place. Return false
// if the library refused.
bool bench_step(struct bench_live_scene* live, const struct hair_reference_rod_pose* head, double dt);

// Return the number of substeps in a frame of 1/60 s.
double bench_substeps(const struct bench_live_scene* live);

// Simulate frames of 1/60 s until the strand moves by less than a millionth of its length in half a
// second. Stop after 30 s. Return false if the library refused.
bool bench_settle(struct bench_live_scene* live, double* positions);

// Read the first strand in world space after its last substep. Return false if the library refused.
bool bench_read(struct bench_live_scene* live, double* positions);

// Return whether all strands equal the first one bitwise.
bool bench_strands_are_alike(struct bench_live_scene* live);

// Return the maximum |length / rest length - 1| of the segments.
double bench_stretch(const struct bench_live_scene* live, const double* positions);

bool bench_are_finite(const double* positions, uint32_t vertices);

// Measure the time of `frames` frames, repeatedly from rest. heads[k] is the head at the end of
// frame k. NULL keeps the head in place. The caller has run these frames before, so that all
// shaders are compiled.
bool bench_time(struct bench_live_scene* live, uint32_t frames, const struct hair_reference_rod_pose* heads,
                double dt, struct bench_times* out);

// Columns of solver and material that every row has.
#define BENCH_MATERIAL_COLUMNS                                                                               \
    "solver", "thread_mapping", "substep", "youngs_modulus", "poisson_ratio", "fiber_radius",                \
        "fiber_density", "flatness", "damping"
void bench_set_material(json_t* row, const struct bench_live_scene* live);

#endif
