// coil.h - a helical strand, for the suites.
#ifndef HAIR_TOOLS_BENCH_COIL_H
#define HAIR_TOOLS_BENCH_COIL_H

#include "tools/bench/scene.h"

struct bench_coil {
    double radius; // m
    double pitch; // m a turn
    double turns;
    uint32_t vertices;
};

// A helix rooted at the origin, whose axis points along -y.
void bench_scene_coil(struct bench_scene* scene, const struct bench_coil* coil);

#endif
