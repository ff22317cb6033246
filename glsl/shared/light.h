// light.h - colours of strands, lights and self-shadowing.
#ifndef HAIR_SHARED_LIGHT_H
#define HAIR_SHARED_LIGHT_H

#define HAIR_LIGHTS 16     // Maximum per view.
#define HAIR_SHADOW_MAPS 4 // Maximum for all lights of a view.
// Maximum of a drawn colour. Half-float formats can hold it.
#define HAIR_MAX_LIGHT 64000.0

// Size of the fibre table.
#define HAIR_FIBRE_COLUMNS 64
#define HAIR_FIBRE_ROWS 16
#define HAIR_FIBRE_LAYERS 3
#define HAIR_FIBRE_MU 0.5 // Absorption per radius at the middle of the columns.

#define HAIR_DENSITY_NODES 1048576u // Maximum nodes of the density grid.
// Words that hold the light values of a node. The first word holds two.
#define HAIR_NODE_WORDS(values) ((values) > 1u ? (values) - 1u : 1u)
#define HAIR_SPLAT_ROUNDS 2u // Segments of each thread that fills the density grid.
// Units of hair whose projected area equals one face of a cell.
#define HAIR_DENSITY_UNITS 65536.0

// Colours of strands.
struct hair_tint {
    hair_vec4 ramp[HAIR_CURVE_INTERVALS + 1]; // rgb: reflectance at equal steps along a strand.
    hair_vec4 streak; // rgb: reflectance of streaks. w: fraction of strands that are streaks.
    float     brightness;    // Relative spread between strands.
    float     hue;           // Relative spread of red against blue between strands.
    float     roughness;     // Relative spread between strands.
    float     tilt;          // Relative spread between strands.
    float     root_darkening;    // Fraction of the light lost at the root.
    float     root_recovery; // 1 / fraction of the strand over which the loss at the root fades.
    float     streak_clumping;  // Fraction of strands that are streaks together with their lock.
    float     sparkle;
    float     groom_color;       // Blend factor of the groom's colours.
    float     groom_color_power; // Exponent that darkens the groom's colours.
    hair_uint unused0, unused1;
};
HAIR_SIZE(hair_tint)

// xyz with w = 0: unit direction to the light. xyz with w = 1: position of the light from the
// head's origin, m.
#define HAIR_LIGHT_TO 0
// rgb: irradiance, for lights with a position at 1 m. w: squared distance below which the light
// gets no brighter, m^2.
#define HAIR_LIGHT_COLOR 1
// Axis of a spot light. xyz: unit direction towards the light. w: cosine at which its cone begins.
#define HAIR_LIGHT_AXIS 2
// x: slope of the brightness by the cosine. y: 1 / range squared, 1/m^2. 0 for an unlimited range.
// z: absorption, 1/m. w: index of its shadow map of hair. HAIR_SHADOW_MAPS for none.
#define HAIR_LIGHT_MORE 3
// x: index of its depth map of opaque geometry. HAIR_SHADOW_MAPS for none. y: bias of that map, m.
// z: metres per unit of depth of both maps. w: depth of an infinitely distant point in the
// perspective of both maps. 0 for orthographic maps.
#define HAIR_LIGHT_MAP 4
#define HAIR_LIGHT_VECTORS 5

#endif
