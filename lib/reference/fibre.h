/// fibre.h - what one fibre of hair scatters, in double precision: glsl/fibre.glsl's scatter_once.
#ifndef HAIR_REFERENCE_FIBRE_H
#define HAIR_REFERENCE_FIBRE_H

#include "glsl/shared.h"

#ifdef __cplusplus
extern "C" {
#endif

struct hair_reference_fibre {
    /// As lib/draw/fibre.h has it: HAIR_FIBRE_LAYERS of HAIR_FIBRE_ROWS of HAIR_FIBRE_COLUMNS.
    const hair_vec4* table;
    double variance; ///< Of R along the fibre. Radians^2.
    double tilt; ///< Of its scales. Radians.
};

/// From a light to the eye, both unit and away from the fibre, whose unit tangent goes to its tip. mu: absorption per radius of
/// each of `count` colours. out: 1/sr of each.
void hair_reference_scatter(const struct hair_reference_fibre* fibre, const double tangent[3],
                            const double to_light[3], const double to_eye[3], const double* mu, int count,
                            double* out);

/// Towards where light may have come that reaches the eye: a direction chosen about as such light is strong where nothing
/// is absorbed, by three numbers in [0, 1). Returns its density, 1/sr.
double hair_reference_choose(const struct hair_reference_fibre* fibre, const double tangent[3],
                             const double to_eye[3], const double random[3], double to_light[3]);

#ifdef __cplusplus
}
#endif

#endif
