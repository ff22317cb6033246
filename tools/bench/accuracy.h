// accuracy.h - the motions of the suite `accuracy`.
#ifndef HAIR_TOOLS_BENCH_ACCURACY_H
#define HAIR_TOOLS_BENCH_ACCURACY_H

#include "tools/bench/bench.h"
#include "tools/bench/scene.h"

#define BENCH_MOTION_FRAMES 60
#define BENCH_MOTION_FRAME (1.0 / 60) // s

// A scene in motion and what the reference makes of it.
struct bench_motion {
    const char* name;
    struct bench_scene scene;
    double length; // m
    uint32_t frames;
    struct hair_reference_rod_pose heads[BENCH_MOTION_FRAMES];
    bool moves; // heads are in use
    hair_solid solids[2];
    uint32_t solid_count;
    uint32_t runs; // the motion has: of contact one for each shoulder, else 1
    double* truth; // per run, frame and vertex; NULL: not found yet
    char reference[96];
};

// Straight strands: yawed with the head, over solids, without bending, let go level, spun up by the
// head.
void bench_make_shake(const struct bench* bench, uint32_t vertices, struct bench_motion* out);
void bench_make_contact(const struct bench* bench, uint32_t vertices, struct bench_motion* out);
void bench_make_swing(const struct bench* bench, uint32_t vertices, struct bench_motion* out);
void bench_make_whip(const struct bench* bench, uint32_t vertices, struct bench_motion* out);
void bench_make_taut(const struct bench* bench, uint32_t vertices, struct bench_motion* out);

// Strands that are curved at rest, clamped, when gravity sets in 30 degrees from their axis.
void bench_make_wave(const struct bench* bench, struct bench_motion* out);
void bench_make_curl(const struct bench* bench, struct bench_motion* out);
void bench_make_coil(const struct bench* bench, struct bench_motion* out);

// Put the shoulder of a contact motion where the run `run` has it.
void bench_set_shoulder(struct bench_motion* motion, uint32_t run);

#endif
