// builtin.c - JSON text of the built-in scenes, styles and motions.
#include "tools/common/builtin.h"

#include <stddef.h>

// Three-quarter front view. The vertical field of view of 24 degrees is that of a 56 mm lens on 35
// mm film.
#define CAMERA "'camera': {'eye': [0.50, 1.60, 0.985], 'target': [0.0, 1.525, 0.0], 'fov': 24}"

// The back of the head, seen from its left.
#define BEHIND " 'camera': {'eye': [0.97, 1.66, -0.45], 'target': [0.0, 1.52, 0.0], 'fov': 27}"

// A warm key light from the side puts highlights along the hair. A cool light from behind rims the
// hair, and a weak one beside the camera fills the shadows of the face.
#define LIGHTS                                                                                               \
    "'light': {'direction': [0.75, 0.75, 0.35], 'color': [4.6, 4.3, 3.9], 'ambient': [0.42, 0.45, 0.5]}, "   \
    "'lights': [{'direction': [0.35, 0.5, -0.95], 'color': [1.1, 1.15, 1.25]}], "
#define SHADED                                                                                               \
    "'self_shadow.method': 'strands', 'self_shadow.cell': 0.006, 'shading.roughness.along': 0.2, "           \
    "'shading.roughness.round': 0.35, 'strand.taper': '1,1,1,0.98,0.92,0.8,0.55,0.15', 'color.spread': "     \
    "0.5, 'color.hue_spread': 0.12, 'shading.roughness_spread': 0.2, 'color.root_darkening': 0.35"
// A few strands fly away from the others and break the outline, and some kink.
#define SETTINGS                                                                                             \
    SHADED ", 'strays.frizz_fraction': 0.12, 'strays.frizz': "                                               \
           "'0,0.0015,0.002,0.002,0.002,0.002,0.002,0.002', 'strays.frizz_wavelength': 0.035"
#define FLYAWAY "'strays.fraction': 0.03, 'strays.distance': '0,0.02,0.03,0.035,0.035,0.035,0.035,0.035'"
#define STUDIO LIGHTS "'settings': {" SETTINGS ", 'strand.length_variation': 0.45, " FLYAWAY "}"
// Coils need more locks, which are spikes otherwise.
#define LOCKED                                                                                               \
    LIGHTS "'settings': {" SETTINGS ", 'guides': 300, 'strand.length_variation': 0.45, " FLYAWAY "}"
// Hair that is cut to one length needs more locks, whose ends are close together.
#define BLUNT LIGHTS "'settings': {" SETTINGS ", 'guides': 400, 'strand.length_variation': 0.15, " FLYAWAY "}"
// Strands that stray as far as from loose hair would hide how a braid is woven.
#define WOVEN                                                                                                \
    LIGHTS "'settings': {" SHADED ", 'strand.length_variation': 0.45, 'strays.fraction': 0.03, "             \
           "'strays.distance': '0,0.02,0.015,0.006,0.005,0.005,0.005,0.008', 'strays.frizz_fraction': "      \
           "0.05, 'strays.frizz': '0,0.0015,0.0015,0.001,0.001,0.001,0.001,0.001', "                         \
           "'strays.frizz_wavelength': 0.035}"
// Short strands lie less in line with each other.
#define CROPPED                                                                                              \
    LIGHTS "'settings': {" SETTINGS ", 'guides': 400, 'strand.length_variation': 0.35, "                     \
           "'strays.fraction': 0.15, 'strays.distance': '0,0.03,0.05,0.07,0.08,0.08,0.08,0.08'}"

const struct hair_builtin hair_builtin_scenes[] = {
    {"demo", "{'style': 'long', 'motion': 'demo', 'breath': 0.005, 'settle': 0.5, 'frames': 120, 'picture': "
             "30, " CAMERA ", " STUDIO "}"},
    {"still", "{'style': 'long', 'motion': 'still', 'frames': 30, 'picture': 29, " CAMERA "}"},
    {"ponytail", "{'style': 'ponytail', 'motion': 'demo', 'settle': 0.5, 'frames': 120, 'picture': 45," BEHIND
                 ", " STUDIO "}"},
    {"afro", "{'style': 'afro', 'motion': 'demo', 'settle': 0.5, 'frames': 120, 'picture': 45,"
             " 'camera': {'eye': [0.53, 1.62, 1.06], 'target': [0.0, 1.58, 0.0], 'fov': 24}, " LOCKED "}"},
    {"fringe", "{'style': 'fringe', 'motion': 'demo', 'settle': 0.5, 'frames': 120, 'picture': 30, " CAMERA
               ", " BLUNT "}"},
    {"fade", "{'style': 'fade', 'motion': 'demo', 'settle': 0.5, 'frames': 120, 'picture': 30, " CAMERA
             ", " CROPPED "}"},
    {"bun", "{'style': 'bun', 'motion': 'demo', 'settle': 0.5, 'frames': 120, 'picture': 45," BEHIND
            ", " STUDIO "}"},
    {"braid", "{'style': 'braid', 'motion': 'demo', 'settle': 0.5, 'frames': 120, 'picture': 45," BEHIND
              ", " WOVEN "}"},
    {"fur", "{'fur': {'strands': 80000, 'length': 0.03, 'comb': [1.5, -2, 0.3], 'ball': 0.1}, 'motion': "
            "'shake', 'frames': 60, 'picture': 20, " LIGHTS "'settings': {" SHADED
            ", 'color': 'blond', 'clump.weight': '0,0,0.03,0.09,0.16,0.23,0.28,0.3', "
            "'strand.radius': 7e-5, 'strand.segments': 8, 'guides': 1000, 'redblack.iterations': 8, "
            "'shape.frequency_root': 8, 'shape.frequency_tip': 6}}"},
    {"wind",
     "{'style': 'long', 'motion': 'still', 'settle': 0.5, 'frames': 150, 'picture': 24,"
     " 'camera': {'eye': [0.3, 1.6, 1.7], 'target': [0.13, 1.575, 0.0], 'fov': 22},"
     " 'wind': {'velocity': [2.6, 0, -1.5], 'model': 'fluid', 'fluid.grid_size': 1, 'turbulence.intensity': "
     "0.4, 'turbulence.length': 0.25}," LIGHTS "'settings': {" SETTINGS
     ", 'drag': 0.5, 'shape.frequency_root': 3, 'shape.frequency_tip': 0.3}}"},
    {NULL, NULL},
};

// Settings that keep each haircut in shape against gravity. Every style sets every key, because one
// style can replace another. A curl needs about eight vertices a turn, more than a wave. Followers
// of wide curls follow one guide, because the mean of curls of different phases is no curl.
#define SMOOTH "'guide_vertices': 32, 'strand.segments': 24, "
#define CURLED "'guide_vertices': 64, 'strand.segments': 64, "
// Wide curls with fewer segments are polygons.
#define WOUND "'guide_vertices': 64, 'strand.segments': 128, "
#define EVEN "'clump.weight': '0,0,0.07,0.18,0.32,0.46,0.56,0.6', 'clump.width': 1"
// Loose hair parts into pointed locks. Without them a veil of strands hangs before the face.
#define POINTED                                                                                              \
    "'clump.weight': '0,0.05,0.2,0.4,0.6,0.75,0.85,0.9', 'clump.width': '1,1,0.95,0.85,0.75,0.65,0.5,0.4'"
// Strands between guides of two strands of a braid would fill the gap between these.
#define BRAIDED "'clump.weight': '0,0,0.4,1,1,1,1,1', 'clump.width': '1,0.9,0.5,0.28,0.24,0.24,0.24,0.3'"
// Stubble has no locks. Strands in parallel with one guide each would be blotches.
#define UNPARTED "'clump.weight': '0,0,0,0.03,0.06,0.1,0.15,0.2', 'clump.width': 1"
#define LOCKS                                                                                                \
    "'clump.weight': '0,0.4,0.75,0.92,0.97,1,1,1', 'clump.width': '1,0.9,0.75,0.62,0.55,0.52,0.55,0.65'"
// Coils of neighbouring guides have different phases. Near the roots, strands between them would be
// straight and show the skin.
#define COILS "'clump.weight': '0,0.6,0.75,0.75,0.7,0.65,0.6,0.6', 'clump.width': 1"
// Long guides of tied hair buckle on the head when it moves, and lift patches, unless their roots
// are held firmly. A ponytail needs more than 18 Hz.
#define HELD(root, tip, angular)                                                                             \
    "{'shape.frequency_root': " #root ", 'shape.frequency_tip': " #tip ", 'redblack.angular_hz': " #angular  \
    ", "

const struct hair_builtin hair_builtin_styles[] = {
    {"long", HELD(6, 1, 8) SMOOTH POINTED "}"},
    {"bob", HELD(8, 3, 8) SMOOTH POINTED "}"},
    {"short", HELD(10, 6, 8) SMOOTH POINTED "}"},
    {"ponytail", HELD(26, 1.5, 8) SMOOTH EVEN "}"},
    {"fringe", HELD(8, 4, 8) SMOOTH POINTED "}"},
    {"fade", HELD(12, 10, 8) SMOOTH UNPARTED "}"},
    {"bun", HELD(12, 12, 8) CURLED EVEN "}"},
    {"braid", HELD(18, 2, 8) CURLED BRAIDED "}"},
    {"curly", HELD(8, 3, 4) WOUND LOCKS "}"},
    {"afro", HELD(12, 8, 8) CURLED COILS "}"},
    {NULL, NULL},
};

const struct hair_builtin hair_builtin_motions[] = {
    {"still", "[]"},
    {"shake", "[{'time': 0}, {'time': 0.3, 'rotation': [30, 0, 4]}, {'time': 0.8, 'rotation': [-32, 0, -4]},"
              " {'time': 1.3, 'rotation': [28, 0, 4]}, {'time': 1.7}]"},
    {"turn",
     "[{'time': 0}, {'time': 0.8, 'rotation': [-35, 4, 0]}, {'time': 1.4, 'rotation': [-35, 4, 0]},"
     " {'time': 2.4, 'rotation': [35, -2, 0]}, {'time': 3.0, 'rotation': [35, -2, 0]}, {'time': 3.8}]"},
    {"demo",
     "[{'time': 0}, {'time': 0.35, 'rotation': [26, 2, 6]}, {'time': 0.85, 'rotation': [-32, 0, -8]},"
     " {'time': 1.35, 'rotation': [34, 2, 8]}, {'time': 1.8, 'rotation': [-20, 0, -5]},"
     " {'time': 2.2, 'rotation': [0, 4, 0]}, {'time': 3.0, 'rotation': [35, -6, 10]}, {'time': 4.0}]"},
    {NULL, NULL},
};
