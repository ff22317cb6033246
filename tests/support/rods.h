// rods.h - one guide, its physics, and the data that the solvers of rods make of it.
#ifndef HAIR_TESTS_SUPPORT_RODS_H
#define HAIR_TESTS_SUPPORT_RODS_H

#include "lib/rod/rod.h"

struct hair_test_rod {
    struct hair_guide guide;
    struct hair_rest rest[HAIR_MAX_GUIDE_VERTICES];
    hair_physics physics;
    struct hair_rod_borne borne[HAIR_MAX_GUIDE_VERTICES]; // by hair_test_rod_hold()
    struct hair_rods_report report;
    struct hair_rod rod[HAIR_MAX_GUIDE_VERTICES]; // by hair_test_rod_write()
};

// Return hair with the design's reference values: Young's modulus 3 GPa, radius 0.05 mm, Poisson's
// ratio 0.45. Free it with free().
struct hair_test_rod* hair_test_rod_make(void);

// Place the guide through the positions, with frames carried along as in a groom.
void hair_test_rod_place(struct hair_test_rod* f, uint32_t count, const float* positions);
// Place the guide straight, `angle` from down, in the plane of x and y.
void hair_test_rod_straight(struct hair_test_rod* f, uint32_t count, double length, double angle);
// Place the guide as a corkscrew about a slanting axis, with uneven segments of about that length.
void hair_test_rod_curl(struct hair_test_rod* f, uint32_t count, double segment);

void hair_test_rod_hold(struct hair_test_rod* f);
// Holds it first.
void hair_test_rod_write(struct hair_test_rod* f, hair_solver solver, double substep);
// Return whether the mixed scheme is to solve the rod.
bool hair_test_rod_is_mixed(struct hair_test_rod* f, hair_solver solver, bool is_held, double substep);
// Return the solver's own choice.
double hair_test_rod_substep(struct hair_test_rod* f, hair_solver solver);
// Return bending stiffness over mass per length, m^4/s^2.
double hair_test_rod_bend(const hair_physics* physics);

#endif
