// gusts.h - turbulence as a repeating texture. It is homogeneous, isotropic and free of divergence.
#ifndef HAIR_WIND_GUSTS_H
#define HAIR_WIND_GUSTS_H

#include "lib/base/host.h"
#include "glsl/shared.h"

// Return a sum of waves with the energy spectrum of von Karman (1948). L is the integral length
// scale along the wind.
//
//   E(k) ~ k^4 / (1 + (k l)^2)^(17/6),  l = L / 0.7468
//
// The spectrum is cut off to what the texture can hold, HAIR_GUST_NODES^3 texels over
// HAIR_GUST_LENGTHS L. A texel holds xyz and a 0. The waves are scaled to make up for the missing
// ones. Read linearly, the components have a standard deviation of 1, taken over all three. The
// result depends only on the seed. NULL means out of memory.
float* hair_gusts_make(const hair_host* host, uint32_t seed);

#endif
