/// air.h - air by formulas, in double precision: what tests and benchmarks hold glsl/wind/air.glsl to.
#ifndef HAIR_REFERENCE_AIR_H
#define HAIR_REFERENCE_AIR_H

#ifdef __cplusplus
extern "C" {
#endif

/// The wind around a ball, m/s. `place`: from its middle, in its radii.
void hair_reference_around_ball(const double wind[3], const double place[3], double out[3]);

#ifdef __cplusplus
}
#endif

#endif
