/// air.h - Closed-form wind in double precision, which tests and benchmarks compare
/// glsl/wind/air.glsl with.
#ifndef HAIR_TESTS_REFERENCE_AIR_H
#define HAIR_TESTS_REFERENCE_AIR_H

#ifdef __cplusplus
extern "C" {
#endif

/// Compute the wind around a ball, in m/s. `place` is relative to the ball's middle, in its radii.
void hair_reference_around_ball(const double wind[3], const double place[3], double out[3]);

#ifdef __cplusplus
}
#endif

#endif
