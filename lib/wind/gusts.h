// gusts.h - turbulence as a texture that repeats: homogeneous, alike every way, free of divergence.
#ifndef HAIR_WIND_GUSTS_H
#define HAIR_WIND_GUSTS_H

#include "lib/base/host.h"
#include "glsl/shared.h"

// A sum of waves whose energies are von Karman's (1948), with L the integral length scale along the wind,
//
//   E(k) ~ k^4 / (1 + (k l)^2)^(17/6),  l = L / 0.7468
//
// as far as the texture holds them: HAIR_GUST_NODES^3 texels, xyz and a 0, over HAIR_GUST_LENGTHS L; what it does not hold
// the others make up for. Read linearly, its components have a standard deviation of 1, all three together. From the seed
// alone. NULL: no memory.
float* hair_gusts_make(const hair_host* host, uint32_t seed);

#endif
