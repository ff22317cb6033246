/// drag.h - what air does to a cylinder in it, in double precision: by a metre of it, as if it were endless.
#ifndef HAIR_REFERENCE_DRAG_H
#define HAIR_REFERENCE_DRAG_H

#ifdef __cplusplus
extern "C" {
#endif

/// Of the flow across it, by its Reynolds number: force of a metre over half the density, the diameter and the squared
/// velocity: 1 + 9.75 Re^-0.744, the form of White 1991, of Reynolds numbers from 0.1 to 400.
double hair_reference_drag_across(double reynolds);

/// Of the flow along it, by the Reynolds number of that across: force of a metre over viscosity and velocity. What goes
/// along a yawed cylinder is carried by what goes across, and diffuses as heat does at a Prandtl number of 1 (Sears 1948):
/// pi times the Nusselt number of Churchill and Bernstein 1977.
double hair_reference_drag_along(double reynolds);

struct hair_reference_air {
    double density; ///< kg/m^3.
    double viscosity; ///< Dynamic. Pa s.
};

/// N/m, of air that goes by at `velocity`, m/s, on a cylinder along the unit vector `along`. m.
void hair_reference_drag(const struct hair_reference_air* air, double diameter, const double velocity[3],
                         const double along[3], double force[3]);

#ifdef __cplusplus
}
#endif

#endif
