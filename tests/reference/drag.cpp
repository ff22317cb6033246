// drag.cpp - Correlations for the drag of cylinders.
#include "tests/reference/drag.h"

#include <cmath>

#include "tests/reference/convert.h"

double hair_reference_drag_across(double reynolds)
{
    return 1 + 9.75 * std::pow(reynolds, -0.744);
}

double hair_reference_drag_along(double reynolds)
{
    const double pi = 3.14159265358979323846, prandtl = 1;
    return pi * (0.3 + 0.62 * std::sqrt(reynolds) * std::cbrt(prandtl) /
                           std::pow(1 + std::pow(0.4 / prandtl, 2.0 / 3), 0.25));
}

void hair_reference_drag(const struct hair_reference_air* air, double diameter, double damping,
                         const double velocity[3], const double along[3], double force[3])
{
    const Vector3d u = vector_of(velocity), t = vector_of(along), by = u.dot(t) * t, across = u - by;
    const double speed = across.norm(), reynolds = speed * diameter * air->density / air->viscosity;
    Vector3d f = std::fmax(hair_reference_drag_along(reynolds) * air->viscosity - damping, 0) * by;
    if (reynolds > 0) {
        const double rate = hair_reference_drag_across(reynolds) * air->density * diameter / 2 * speed;
        f += std::fmax(rate - damping, 0) * across;
    }
    store(f, force);
}
