/// fibre.h - Scattering of one hair fibre in double precision, as scatter_once in
/// glsl/light/fibre.glsl.
#ifndef HAIR_TESTS_REFERENCE_FIBRE_H
#define HAIR_TESTS_REFERENCE_FIBRE_H

#include "glsl/shared.h"

#ifdef __cplusplus
extern "C" {
#endif

struct hair_reference_fibre {
    /// Table of lib/light/fibre.h, HAIR_FIBRE_LAYERS of HAIR_FIBRE_ROWS of HAIR_FIBRE_COLUMNS.
    const hair_vec4* table;
    double variance; ///< Longitudinal variance of R, rad^2.
    double tilt; ///< Tilt of the scales, rad.
};

/// Compute the scattering from a light to the eye in 1/sr for each of `count` colours. Directions
/// are unit vectors away from the fibre. The unit tangent points to the tip. `mu` is the absorption
/// per radius of each colour.
void hair_reference_scatter(const struct hair_reference_fibre* fibre, const double tangent[3],
                            const double to_light[3], const double to_eye[3], const double* mu, int count,
                            double* out);

/// Choose a direction towards light that reaches the eye, from three random numbers in [0, 1). The
/// density is about proportional to the scattering without absorption. Return the density of the
/// direction, 1/sr.
double hair_reference_choose(const struct hair_reference_fibre* fibre, const double tangent[3],
                             const double to_eye[3], const double random[3], double to_light[3]);

#ifdef __cplusplus
}
#endif

#endif
