/// guide_rod.h - A guide of a groom as a rod of the reference, with the numbers of its physics.
#ifndef HAIR_TESTS_REFERENCE_GUIDE_ROD_H
#define HAIR_TESTS_REFERENCE_GUIDE_ROD_H

#include <hair/hair.h>

#include "glsl/shared.h"
#include "tests/reference/rod.h"

#ifdef __cplusplus
extern "C" {
#endif

/// A guide at rest, and what acts on it. The mass of a metre of hair is the unit of mass, as in
/// lib/rod/rod.h.
struct hair_reference_guide_rod {
    const struct hair_guide* guide;
    const struct hair_rest* rest; ///< Rest data of its guide->count vertices.
    const hair_physics* physics;
    const hair_wind* wind; ///< Its velocity, still_air, density and viscosity act.
    const double* stiffen; ///< Multiple of the stiffness per vertex. NULL means 1.
    /// 1 if the library solves straight guides with the energy of curved ones.
    int is_mixed;
    const struct hair_reference_rod_pose* head; ///< Pose at the start. NULL is the origin.
};

/// Create the guide at rest in its groom. Its rest strain balances gravity if the physics preloads
/// any of it. Return NULL if its numbers do not make a rod.
struct hair_reference_rod* hair_reference_guide_rod_create(const struct hair_reference_guide_rod* guide);

/// Return the factor of hair_reference_drag for a wind, per mass. It is 0 where no wind blows.
double hair_reference_guide_rod_drag(const hair_physics* physics, const hair_wind* wind);

#ifdef __cplusplus
}
#endif

#endif
