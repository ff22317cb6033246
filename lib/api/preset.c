// preset.c - presets of physics for kinds of hair.
#include "lib/api/api.h"

// Parameters of the presets. Human hair is 50 to 120 um thick and has a modulus of about 4 GPa.
// Water reduces the modulus by more than half and makes hair heavier. Frizz keeps locks apart, and
// they bend as something thicker than a hair.
static const struct {
    const char* name;
    float radius, young, density, flatness, stiffness, damping, friction;
} presets[] = {
    [HAIR_PRESET_NATURAL] = {"natural", 4e-5f, 4e9f, 1300, 1, 1, 4, 0.3f},
    [HAIR_PRESET_FINE] = {"fine", 2.7e-5f, 3.5e9f, 1300, 0.9f, 1, 6, 0.25f},
    [HAIR_PRESET_THICK] = {"thick", 5.5e-5f, 4.5e9f, 1300, 1, 1, 3, 0.3f},
    [HAIR_PRESET_WET] = {"wet", 4e-5f, 1.5e9f, 1800, 1, 1, 8, 0.8f},
    [HAIR_PRESET_FRIZZY] = {"frizzy", 4e-5f, 4e9f, 1300, 0.6f, 8, 7, 0.5f},
};

const char* hair_preset_name(hair_preset preset)
{
    return (unsigned)preset < HAIR_PRESET_COUNT ? presets[preset].name : NULL;
}

hair_result hair_physics_preset(hair_physics* physics, hair_preset preset)
{
    if (!physics || (unsigned)preset >= HAIR_PRESET_COUNT) return HAIR_ERROR_ARGUMENT;
    const hair_host silent = {0};
    hair_physics own;
    HAIR_TRY(HAIR_COPY_IN(&silent, hair_physics, physics, &own));
    own.fiber.radius = presets[preset].radius;
    own.fiber.youngs_modulus = presets[preset].young;
    own.fiber.density = presets[preset].density;
    own.fiber.flatness = presets[preset].flatness;
    own.shape.stiffness_root = own.shape.stiffness_tip = presets[preset].stiffness;
    own.damping = presets[preset].damping;
    own.collision.friction = presets[preset].friction;
    return HAIR_COPY_OUT(&silent, hair_physics, &own, physics);
}
