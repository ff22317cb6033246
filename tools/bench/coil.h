// coil.h - A helical strand for the suites.
#ifndef HAIR_TOOLS_BENCH_COIL_H
#define HAIR_TOOLS_BENCH_COIL_H

#include "tools/bench/scene.h"

struct bench_coil {
    double radius; // m
    double pitch; // m a turn
    double turns;
    uint32_t vertices;
};

// Make a helix that is rooted at the origin and whose axis is along -y.
void bench_scene_coil(struct bench_scene* scene, const struct bench_coil* coil);

#endif
