// accuracy.h - Motions of the suite `accuracy`.
#ifndef HAIR_TOOLS_BENCH_ACCURACY_H
#define HAIR_TOOLS_BENCH_ACCURACY_H

#include "tools/bench/bench.h"
#include "tools/bench/scene.h"

#define BENCH_MOTION_FRAMES 60
#define BENCH_MOTION_FRAME (1.0 / 60) // s

// Place of a collider of a motion, in the plane z = 0.
struct bench_place {
    float x, y, radius; // m
};

// A reference solution.
struct bench_truth {
    double* positions; // per run, frame and vertex, NULL until computed
    char reference[96];
};

// A scene in motion and its reference solutions.
struct bench_motion {
    const char* name;
    struct bench_scene scene;
    double length; // m
    uint32_t frames;
    struct hair_reference_rod_pose heads[BENCH_MOTION_FRAMES];
    bool moves; // uses `heads`
    hair_collider colliders[2];
    uint32_t collider_count;
    const struct bench_place* places; // of the last collider, one for each run
    uint32_t runs; // number of runs, 1 without colliders
    uint32_t fine_substeps; // substeps per frame of the reference with colliders
    struct bench_truth truth[2]; // the second with the energy of the chord between tangents
};

// Make straight strands on a head that yaws.
void bench_make_shake(const struct bench* bench, uint32_t vertices, struct bench_motion* out);
// Make straight strands that fall on colliders.
void bench_make_contact(const struct bench* bench, uint32_t vertices, struct bench_motion* out);
// Make a horizontal chain without bending stiffness that is released.
void bench_make_swing(const struct bench* bench, uint32_t vertices, struct bench_motion* out);
// Make a level strand with bending stiffness that is released.
void bench_make_whip(const struct bench* bench, uint32_t vertices, struct bench_motion* out);
// Make a strand that the head spins up.
void bench_make_taut(const struct bench* bench, uint32_t vertices, struct bench_motion* out);

// Make a clamped strand with a plane wave at rest. Gravity of 30 degrees from its axis sets in.
void bench_make_wave(const struct bench* bench, struct bench_motion* out);
// Make a clamped curl, as bench_make_wave().
void bench_make_curl(const struct bench* bench, struct bench_motion* out);
// Make the curl of bench_make_curl(), which swings onto a level bar.
void bench_make_curl_contact(const struct bench* bench, struct bench_motion* out);
// Make a clamped coil, as bench_make_wave().
void bench_make_coil(const struct bench* bench, struct bench_motion* out);

// Move the last collider of a motion to its place in run `run`.
void bench_set_place(struct bench_motion* motion, uint32_t run);

#endif
