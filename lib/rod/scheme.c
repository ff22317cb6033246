// scheme.c - the choice between the scheme of straight rods and the mixed scheme.
#include "lib/rod/rod_shape.h"

// Maximum strain at a vertex of a straight strand, in radians. Rounding leaves this much of a
// straight strand in any direction.
#define STRAIGHT_STRAIN 5e-5

static bool is_curved(const struct hair_rod_shape* s)
{
    for (uint32_t i = 0; i + 1 < s->count; ++i) {
        hair_dvec3 strain = hair_dscale((hair_dvec3){s->turn[i].x, s->turn[i].y, s->turn[i].z}, 2);
        double stiffness = hair_rod_stiffness(s, i);
        if (stiffness > 0) strain = hair_dadd(strain, hair_dscale(hair_rod_excess(s, i, stiffness), -1));
        if (hair_dlength(strain) > STRAIGHT_STRAIN) return true;
    }
    return false;
}

// Return whether some stiffness is too large to factor the matrix of straight rods in single
// precision.
static bool is_fine(const struct hair_rod_shape* s, double h)
{
    for (uint32_t i = 0; i + 1 < s->count; ++i)
        if (hair_rod_stiffness(s, i) > hair_rod_max_stiffness(s, i, h)) return true;
    return false;
}

// Return whether a guide has too many vertices for the scheme of straight rods under direct. A
// guide of more than HAIR_ROD_MAX_PLAIN vertices loses its length when a spinning head pulls it
// taut, unless its substeps are as many times shorter. Even then, friction may make it tremble.
static bool is_long(uint32_t vertices, bool is_held, double substep)
{
    double longest = HAIR_ROD_FRAME / hair_rod_substeps_of_straight(vertices);
    return vertices > HAIR_ROD_MAX_PLAIN && (is_held || substep > longest * (1 + 1e-6));
}

bool hair_rods_are_long(const struct hair_guide* guides, uint32_t count)
{
    for (uint32_t i = 0; i < count; ++i)
        if (guides[i].count > HAIR_ROD_MAX_PLAIN) return true;
    return false;
}

bool hair_rods_are_mixed(const struct hair_guide* guides, const struct hair_rest* rest,
                         const struct hair_rod_borne* borne, uint32_t count, const hair_physics* physics,
                         hair_solver solver, bool is_held, double substep)
{
    double h = substep > 0 ? substep : HAIR_ROD_FRAME / HAIR_ROD_PER_FRAME_DIRECT;
    if (physics->fiber.flatness < 1) return true;
    for (uint32_t i = 0; i < count; ++i) {
        struct hair_rod_shape shape;
        if (solver == HAIR_SOLVER_DIRECT && is_long(guides[i].count, is_held, substep)) return true;
        hair_rod_shape_with(guides + i, rest, borne, physics, &shape);
        if (is_curved(&shape) || is_fine(&shape, h) || hair_rod_tautness(&shape) > 0) return true;
    }
    return false;
}

bool hair_rods_differ(const hair_physics* a, const hair_physics* b)
{
    for (int k = 0; k < 3; ++k)
        if (a->gravity[k] != b->gravity[k]) return true;
    return a->damping != b->damping || a->shape.frequency_root != b->shape.frequency_root ||
           a->shape.frequency_tip != b->shape.frequency_tip ||
           a->fiber.youngs_modulus != b->fiber.youngs_modulus ||
           a->fiber.poisson_ratio != b->fiber.poisson_ratio || a->fiber.radius != b->fiber.radius ||
           a->fiber.density != b->fiber.density || a->fiber.flatness != b->fiber.flatness ||
           a->shape.stiffness_root != b->shape.stiffness_root ||
           a->shape.stiffness_tip != b->shape.stiffness_tip ||
           a->shape.gravity_preload != b->shape.gravity_preload || a->root != b->root ||
           a->tip_mass != b->tip_mass;
}
