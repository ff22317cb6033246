/// continuum.h - what is known of rods and chains without simulating them: closed forms, and equations of one
/// variable solved to ten digits. None of it shares code with rod.h, which is tested against it.
#ifndef HAIR_REFERENCE_CONTINUUM_H
#define HAIR_REFERENCE_CONTINUUM_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

// continuum.cpp ---------------------------------------------------------------------------------------------

/// The n-th positive zero, from 1, of the Bessel function J of an order above -1. Zeros to 20.
double hair_reference_bessel_zero(double order, uint32_t n);
/// Arithmetic-geometric mean.
double hair_reference_agm(double a, double b);
/// Period of a pendulum of this amplitude, rad, [0, pi), as a multiple of that of small swings.
double hair_reference_pendulum_period(double amplitude);
/// n-th root b L, from 1, of a beam clamped at one end: cosh cos = -1. It swings at b^2 sqrt(B / rho A).
double hair_reference_beam_root(uint32_t n);

/// Angular frequency of the n-th small swing, from 1, of a hanging chain without stiffness, at whose tip hangs
/// `tip` times its own mass.
double hair_reference_chain_frequency(uint32_t n, double length, double gravity, double tip);
/// The same of `links` rods without mass, with point masses at their lower ends.
double hair_reference_linkage_frequency(uint32_t n, uint32_t links, const double* lengths,
                                        const double* masses, double gravity);

/// A plane rod of unit length and bending stiffness.
struct hair_reference_elastica {
    double across, down; ///< From clamp to tip.
    double tip; ///< Angle below the horizontal, rad.
};
/// Under its own weight `gamma` and a weight `load` at the tip, clamped `angle` below the horizontal, rad,
/// (-pi/2, pi/2). Where there are several, the one that hangs lowest.
struct hair_reference_elastica hair_reference_elastica(double gamma, double load, double angle);

/// A chain of unit length and weight between two pins of one height, `span` apart, (0, 1).
struct hair_reference_catenary {
    double sag;
    double slope; ///< At the pins, below the horizontal, rad.
    double tension; ///< There.
};
struct hair_reference_catenary hair_reference_catenary(double span);
/// Of `links` equal links, even in number, with their weight at their ends.
struct hair_reference_catenary hair_reference_catenary_of_links(double span, uint32_t links);

// linkage.cpp -----------------------------------------------------------------------------------------------

/// Rods without mass hung from each other in a plane, with point masses at their lower ends; angles from
/// straight down, rad, and their rates. On by `dt` in `steps` of order 16: 100 a second are enough for 4 links
/// of 0.3 m in all, and 400 for 8. The energy tells.
void hair_reference_linkage_advance(uint32_t links, const double* lengths, const double* masses,
                                    double gravity, double dt, uint32_t steps, double* angles, double* rates);
double hair_reference_linkage_energy(uint32_t links, const double* lengths, const double* masses,
                                     double gravity, const double* angles, const double* rates);

#ifdef __cplusplus
}
#endif

#endif
