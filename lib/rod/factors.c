// factors.c - physics of a guide by its factors.
#include "lib/rod/rod.h"

#include <math.h>

// Maxima of hair_physics.
#define MAX_YOUNGS_MODULUS 1e12f
#define MAX_DAMPING 1000.0f
#define MAX_FREQUENCY 30.0f

bool hair_factors_are_equal(const struct hair_guide_factors* a, const struct hair_guide_factors* b)
{
    return a->stiffness == b->stiffness && a->damping == b->damping &&
           a->shape_frequency == b->shape_frequency && a->gravity_preload == b->gravity_preload;
}

hair_physics hair_physics_multiply(const hair_physics* physics, const struct hair_guide_factors* factors)
{
    hair_physics own = *physics;
    own.fiber.youngs_modulus = fminf(own.fiber.youngs_modulus * factors->stiffness, MAX_YOUNGS_MODULUS);
    own.damping = fminf(own.damping * factors->damping, MAX_DAMPING);
    own.shape.frequency_root = fminf(own.shape.frequency_root * factors->shape_frequency, MAX_FREQUENCY);
    own.shape.frequency_tip = fminf(own.shape.frequency_tip * factors->shape_frequency, MAX_FREQUENCY);
    own.shape.gravity_preload = fminf(own.shape.gravity_preload * factors->gravity_preload, 1);
    return own;
}
