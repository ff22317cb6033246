// coil.c - A helical strand.
#include "tools/bench/coil.h"

#include <math.h>

void bench_scene_coil(struct bench_scene* scene, const struct bench_coil* coil)
{
    scene->vertices = coil->vertices;
    for (uint32_t i = 0; i < coil->vertices; ++i) {
        double turn = coil->turns * i / (coil->vertices - 1), angle = 2 * BENCH_PI * turn;
        scene->positions[3 * i] = (float)(coil->radius * (cos(angle) - 1));
        scene->positions[3 * i + 1] = (float)(-coil->pitch * turn);
        scene->positions[3 * i + 2] = (float)(coil->radius * sin(angle));
    }
}
