/// drag.h - Drag of a cylinder in air in double precision, per metre of an infinite cylinder.
#ifndef HAIR_TESTS_REFERENCE_DRAG_H
#define HAIR_TESTS_REFERENCE_DRAG_H

#ifdef __cplusplus
extern "C" {
#endif

/// Return the drag coefficient across the cylinder, 1 + 9.75 Re^-0.744, the form of White 1991, for
/// Reynolds numbers Re from 0.1 to 400. The coefficient is the force per metre over half the
/// density, the diameter and the squared velocity.
double hair_reference_drag_across(double reynolds);

/// Return the drag along the cylinder, the force per metre over viscosity and velocity. `reynolds`
/// is the Reynolds number of the flow across. Momentum along a yawed cylinder is carried by the
/// flow across and diffuses as heat does at a Prandtl number of 1 (Sears 1948). The drag is pi
/// times the Nusselt number of Churchill and Bernstein 1977.
double hair_reference_drag_along(double reynolds);

struct hair_reference_air {
    double density; ///< kg/m^3.
    double viscosity; ///< Dynamic viscosity, Pa s.
};

/// Compute the force in N/m on a cylinder along the unit vector `along`. The diameter is in m.
/// `velocity` is the velocity of the air relative to the cylinder, in m/s. The forces across and
/// along are each smaller by `damping`, in kg/(m s), times the velocity, but not below 0.
void hair_reference_drag(const struct hair_reference_air* air, double diameter, double damping,
                         const double velocity[3], const double along[3], double force[3]);

#ifdef __cplusplus
}
#endif

#endif
