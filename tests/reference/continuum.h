/// continuum.h - Known solutions for rods and chains, in closed form or from equations of one
/// variable solved to ten digits. The code is independent of rod.h, which is tested against it.
#ifndef HAIR_TESTS_REFERENCE_CONTINUUM_H
#define HAIR_TESTS_REFERENCE_CONTINUUM_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

// continuum.cpp -----------------------------------------------------------------------------------

/// Return the n-th positive zero, counted from 1, of the Bessel function J of an order above -1.
/// Zeros up to 20 are supported.
double hair_reference_bessel_zero(double order, uint32_t n);
/// Return the arithmetic-geometric mean.
double hair_reference_agm(double a, double b);
/// Return the period of a pendulum of this amplitude, in rad, [0, pi), as a multiple of the period
/// of small swings.
double hair_reference_pendulum_period(double amplitude);
/// Return the n-th root b L, counted from 1, of cosh(b L) cos(b L) = -1 for a beam clamped at one
/// end. The beam's angular frequency is b^2 sqrt(B / (rho A)). L is the length, B the bending
/// stiffness, rho A the mass per length.
double hair_reference_beam_root(uint32_t n);

/// Return the angular frequency of the n-th small swing, counted from 1, of a hanging chain without
/// stiffness. The tip carries `tip` times the chain's mass.
double hair_reference_chain_frequency(uint32_t n, double length, double gravity, double tip);
/// Return the angular frequency of the n-th small swing of `links` massless rods with point masses
/// at their lower ends.
double hair_reference_linkage_frequency(uint32_t n, uint32_t links, const double* lengths,
                                        const double* masses, double gravity);

/// A plane rod of unit length and bending stiffness.
struct hair_reference_elastica {
    double across, down; ///< From clamp to tip.
    double tip; ///< Angle below the horizontal, rad.
};
/// Return the rest shape under the rod's weight `gamma` and a weight `load` at the tip. The clamp
/// is `angle` below the horizontal, in rad, (-pi/2, pi/2). If there are several shapes, the lowest
/// one is returned.
struct hair_reference_elastica hair_reference_elastica(double gamma, double load, double angle);

/// Shape of a chain of unit length and weight between two pins of equal height, `span` apart, (0,
/// 1).
struct hair_reference_catenary {
    double sag;
    double slope; ///< At the pins, below the horizontal, rad.
    double tension; ///< At the pins.
};
/// Return the shape of a continuous chain.
struct hair_reference_catenary hair_reference_catenary(double span);
/// Return the shape of an even number of `links` equal links with their weight at their ends.
struct hair_reference_catenary hair_reference_catenary_of_links(double span, uint32_t links);

// linkage.cpp -------------------------------------------------------------------------------------

/// Advance massless rods that hang from each other in a plane, with point masses at their lower
/// ends, by `dt`. Angles are from straight down, in rad. `steps` is the number of integration steps
/// of order 16. 100 steps per second suffice for 4 links of 0.3 m in total, and 400 for 8 links.
/// The energy indicates the error.
void hair_reference_linkage_advance(uint32_t links, const double* lengths, const double* masses,
                                    double gravity, double dt, uint32_t steps, double* angles, double* rates);
/// Return the total energy of such a linkage.
double hair_reference_linkage_energy(uint32_t links, const double* lengths, const double* masses,
                                     double gravity, const double* angles, const double* rates);

#ifdef __cplusplus
}
#endif

#endif
