// fibre.h - how one fibre scatters light round its axis, as a table: a rough dielectric cylinder that absorbs
// (Marschner et al. 2003; d'Eon et al. 2011), and what many of them do to it (Zinke et al. 2008).
#ifndef HAIR_DRAW_FIBRE_H
#define HAIR_DRAW_FIBRE_H

#include "glsl/shared.h"

// What it depends on.
struct hair_fibre {
    float around; // roughness, [0.05, 1]
    float along; // the same
    float index; // of refraction
};

// Lobes: R reflected, TT through, TRT reflected inside once, and all that are reflected inside more often.
//
// table[0], over phi / pi of the angle between light and eye round the axis, and the cosine of half that between their
// cones: density by phi of each lobe without absorption, 1/radian. table[1], over the same: how far light of TT, TRT
// and the rest has gone inside, in radii; and, over the cosine of either direction alone, a factor by which no light is
// lost. table[2], over mu / (mu + HAIR_FIBRE_MU) of the absorption per radius mu, and
// the same cosine: shares that a fibre sends on and back of light that comes from one side; and the longitudinal
// variances of both.
typedef hair_vec4 hair_fibre_table[HAIR_FIBRE_LAYERS][HAIR_FIBRE_ROWS][HAIR_FIBRE_COLUMNS];

void hair_fibre_fill(const struct hair_fibre* fibre, hair_fibre_table table);

// Longitudinal variances of R, TT and TRT for a roughness in [0.05, 1] (Chiang et al. 2016, equation 7).
void hair_fibre_variances(float roughness, float out[3]);

// Scale of the logistic distribution round the axis (the same, equation 8).
float hair_fibre_scale(float roughness);

#endif
