// capsules.c - Distance from a set of capsules.
#include "tools/bench/capsules.h"

#include <math.h>

static double distance_from(const hair_collider* capsule, const float at[3])
{
    const float* q = capsule->rotation;
    double x = (double)q[0], y = (double)q[1], z = (double)q[2], w = (double)q[3];
    double axis[3] = {2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w)}, arm[3], along = 0;
    double half = (double)capsule->size[1], square = 0;
    for (int k = 0; k < 3; ++k) {
        arm[k] = (double)at[k] - (double)capsule->position[k];
        along += arm[k] * axis[k];
    }
    along = fmin(fmax(along, -half), half);
    for (int k = 0; k < 3; ++k) square += (arm[k] - along * axis[k]) * (arm[k] - along * axis[k]);
    return sqrt(square) - (double)capsule->size[0];
}

double bench_capsule_distance(const hair_collider* capsules, uint32_t count, const float at[3])
{
    double min = INFINITY;
    for (uint32_t i = 0; i < count; ++i) min = fmin(min, distance_from(&capsules[i], at));
    return min;
}
