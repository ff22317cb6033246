// fibre.h - table of how one fibre scatters light around its axis, as a rough, absorbing dielectric
// cylinder (Marschner et al. 2003; d'Eon et al. 2011). It also holds what many fibres do to light
// (Zinke et al. 2008). The mean of elliptic cylinders in all directions stands for flat fibres.
#ifndef HAIR_LIGHT_FIBRE_H
#define HAIR_LIGHT_FIBRE_H

#include "glsl/shared.h"

// Parameters of the table.
struct hair_fibre {
    float around; // Azimuthal roughness, in [0.05, 1].
    float along; // Longitudinal roughness, in [0.05, 1].
    float index; // Index of refraction.
    float flatness; // Ratio of the axes of the cross section, in [0.2, 1].
};

// Table of four lobes. R is reflected, TT transmitted, and TRT reflected once inside. The fourth
// lobe holds all light reflected inside more often.
//
// table[0] and table[1].xyz are functions of phi / pi and of a cosine. phi is the angle between
// light and eye around the axis. The cosine is that of half the angle between their cones. table[0]
// is the density of each lobe by phi without absorption, in 1/radian. table[1].xyz is the path of
// TT, TRT and the fourth lobe inside the fibre, in radii of a circle of the same area.
//
// table[1].w is a factor that conserves energy. It is a function of the cosine of either direction
// alone.
//
// table[2] is a function of mu / (mu + HAIR_FIBRE_MU) and of the cosine. mu is the absorption per
// radius. table[2] holds the fractions that a fibre sends on and back of light from one side, then
// the longitudinal variances of both.
typedef hair_vec4 hair_fibre_table[HAIR_FIBRE_LAYERS][HAIR_FIBRE_ROWS][HAIR_FIBRE_COLUMNS];

void hair_fibre_fill(const struct hair_fibre* fibre, hair_fibre_table table);

// Compute the longitudinal variances of R, TT and TRT for a roughness in [0.05, 1] (Chiang et al.
// 2016, equation 7).
void hair_fibre_variances(float roughness, float out[3]);

// Return d, by which dense hair of the absorption mu per radius has the reflectance
// exp(-d * sqrt(mu)), for the roughness around the axis (Chiang et al. 2016, equation 9).
float hair_fibre_darkening(float roughness);

// Return the scale of the logistic distribution around the axis (Chiang et al. 2016, equation 8).
float hair_fibre_scale(float roughness);

#endif
