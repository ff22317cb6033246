// settings_texts.c - What --help says of settings, and the names of their choices.
#include "tools/common/settings_texts.h"

#include <stddef.h>
#include <string.h>

// Settings in the order of --help. A number without a row follows them.
static const struct {
    const char *key, *about;
    const char* choices; // Names of the values 0, 1, … NULL is none.
} texts[] = {
    {"scale", "of the file's units to metres", NULL},
    {"up", "axis of the file that points up", "y, z, x"},
    {"tip_first", "strands of the file run from tip to root", NULL},
    {"keep_fraction", "of the file's strands to keep", NULL},
    {"vertices", "of every strand, resampled; 0: as it is", NULL},
    {"length", "of the style's own lengths", NULL},
    {"guides", "strands to simulate", NULL},
    {"guide_vertices", "maximum number of simulated vertices of each", NULL},
    {"followers", "strands to grow between guides", NULL},
    {"clump_radius", "of what grows around a guide without a scalp, m", NULL},
    {"seed", "of every random choice", NULL},

    {"solver", "of the motion", "direct, accurate, follow, redblack"},
    {"substep", "length of a substep, s; 0: as the solver wants", NULL},
    {"thread_mapping", "of guides to GPU threads", "auto, workgroup_per_guide, thread_per_guide, feedback"},
    {"hit_method", "how followers inside colliders are found", "auto, compute, prepass"},
    {"max_dt", "longest time a step advances, s", NULL},
    {"preset", "kind of hair, which sets some of the numbers below", NULL},
    {"gravity.x", "m/s^2", NULL},
    {"gravity.y", "m/s^2", NULL},
    {"gravity.z", "m/s^2", NULL},
    {"damping", "decay rate of velocity relative to the air, 1/s", NULL},
    {"shape.frequency_root", "pull to the rest pose at the root, Hz", NULL},
    {"shape.frequency_tip", "the same at the tip, Hz", NULL},
    {"redblack.angular_hz", "redblack: pull to the rest angle, Hz", NULL},
    {"redblack.bend", "redblack: fraction of the bend that an iteration removes", NULL},
    {"redblack.iterations", "redblack: of constraints in a substep", NULL},
    {"hair_hair.cohesion", "decay rate of velocity relative to the hair around, 1/s", NULL},
    {"hair_hair.pressure_stiffness", "resistance to being denser than at rest, m^2/s^2", NULL},
    {"substep_rate", "fraction of the solver's own substeps that is made", NULL},
    {"offscreen_substep_rate", "the same while no view shows the hair", NULL},
    {"sleep_threshold", "how near to where it comes to rest hair sleeps, m", NULL},
    {"collision.margin", "distance kept to colliders, m", NULL},
    {"fiber.youngs_modulus", "Young's modulus of a hair, Pa", NULL},
    {"fiber.poisson_ratio", "its Poisson's ratio", NULL},
    {"fiber.radius", "of a hair's section, m", NULL},
    {"fiber.density", "of a hair, kg/m^3", NULL},
    {"fiber.flatness", "short by long axis of its section", NULL},
    {"shape.stiffness_root", "of a guide, as a multiple of a hair's, at the root", NULL},
    {"shape.stiffness_tip", "the same at the tip", NULL},
    {"shape.gravity_preload", "fraction of gravity that the rest shape bears", NULL},
    {"root", "how the scalp holds it", "clamped, hinged, free"},
    {"tip_mass", "hung on the tip, as a multiple of the strand's", NULL},
    {"wind.x", "velocity of the air, m/s", NULL},
    {"wind.y", "", NULL},
    {"wind.z", "", NULL},
    {"wind.still_air", "the law of its drag acts where none blows too", NULL},
    {"wind.model", "how air moves: as it would by itself, or round head and colliders", "ambient, fluid"},
    {"wind.fluid.resolution", "of the fluid: cells along a side", NULL},
    {"wind.fluid.grid_size", "of the fluid: its side, m", NULL},
    {"wind.fluid.projection", "of the fluid", "multigrid, relaxation, jacobi"},
    {"wind.fluid.projection_iterations", "of that", NULL},
    {"wind.turbulence.intensity", "standard deviation of gusts, as a fraction of that", NULL},
    {"wind.turbulence.length", "their integral length scale, m", NULL},
    {"wind.turbulence.seed", "of gusts", NULL},
    {"wind.shelter", "how much head and colliders divert it", NULL},
    {"wind.fluid.drag_strand_count", "that slow the fluid down", NULL},
    {"wind.density", "of the air, kg/m^3", NULL},
    {"wind.viscosity", "of the air, Pa s", NULL},
    {"drag", "of wind, as a multiple of that of a single hair", NULL},
    {"collision.friction", "Coulomb's coefficient with colliders", NULL},

    {"render_path", "of drawing", "tessellation, cached, compute, auto, procedural"},
    {"primitive", "that strands are drawn as", "ribbons, lines"},
    {"coverage", "of pixels by thin strands", "msaa, alpha"},
    {"opacity", "of strands with coverage=alpha", NULL},
    {"hide", "leave out hair behind the head", NULL},
    {"lod", "level of detail", NULL},
    {"lod.strand_fraction", "maximum fraction of the strands drawn", NULL},
    {"lod.segment_fraction", "maximum fraction of their segments", NULL},
    {"lod.width_exponent", "power of 1 / fraction that strands are wider by", NULL},
    {"lod.per_patch", "by how large each patch appears", NULL},
    {"lod.strand_pixels", "dynamic: minimum width of a strand", NULL},
    {"lod.segment_pixels", "dynamic: minimum length of a segment", NULL},
    {"lod.min_strand_fraction", "dynamic: minimum fraction of strands", NULL},
    {"lod.importance", "dynamic: factor of how large hair appears", NULL},
    {"lod.occluded_importance", "dynamic: the same for hair behind the head", NULL},
    {"slice", "of the field, or of air, with --show", "none, x, y, z"},
    {"slice_at", "where, as a fraction of the field's box", NULL},
    {"field_voxel", "side of a voxel of the field, m", NULL},
    {"look", "kind of look, which sets strand, clump, strays and curl below", NULL},
    {"color", "of hair, which sets color.root to color.spread", NULL},
    {"color.root.r", "diffuse reflectance at the root", NULL},
    {"color.root.g", "", NULL},
    {"color.root.b", "", NULL},
    {"color.tip.r", "the same at the tip", NULL},
    {"color.tip.g", "", NULL},
    {"color.tip.b", "", NULL},
    {"color.spread", "of brightness between strands", NULL},
    {"color.tint_red", "times the red of these, from root to tip", NULL},
    {"color.tint_green", "times the green", NULL},
    {"color.tint_blue", "times the blue", NULL},
    {"color.hue_spread", "of red against blue between strands", NULL},
    {"color.root_darkening", "fraction of the colour that is lost at the root", NULL},
    {"color.root_darkening_length", "fraction of the strand over which it comes back", NULL},
    {"color.streaks", "fraction of the strands that have another colour", NULL},
    {"color.streak_color.r", "colour of streaks", NULL},
    {"color.streak_color.g", "", NULL},
    {"color.streak_color.b", "", NULL},
    {"color.streak_clumping", "fraction of strands with a streak exactly when their guide has one", NULL},
    {"color.groom_colors", "fraction of the colours that a haircut has of its own", NULL},
    {"wetness", "darker, smoother, drawn together", NULL},
    {"shading.model", "of strands", "fibres, lines"},
    {"shading.roughness.along", "of fibres", NULL},
    {"shading.roughness.round", "of fibres", NULL},
    {"shading.cuticle_tilt", "of the scales of fibres, radians", NULL},
    {"shading.roughness_spread", "of roughness between strands", NULL},
    {"shading.cuticle_tilt_spread", "of tilt between strands", NULL},
    {"shading.scattering", "fraction of the light from other fibres that counts", NULL},
    {"shading.specular.white", "strength of the first highlight", NULL},
    {"shading.specular.tinted", "strength of the second", NULL},
    {"shading.gloss.white", "exponent of the first highlight", NULL},
    {"shading.gloss.tinted", "exponent of the second", NULL},
    {"shading.sparkle", "how the second highlight glitters", NULL},
    {"strand.radius", "of a drawn strand, m", NULL},
    {"strand.taper", "as a fraction of that, from root to tip", NULL},
    {"strand.length", "fraction of every strand that is drawn", NULL},
    {"strand.length_variation", "maximum fraction by which strands are shorter at random", NULL},
    {"clump.interpolation", "what followers are made of", "mixed, single, multi"},
    {"clump.weight", "from three guides to one, from root to tip", NULL},
    {"clump.width", "offsets from one guide, as a multiple", NULL},
    {"strays.tip_fraction", "fraction of strands that stray near their tips", NULL},
    {"strays.tip_distance", "how far, in lengths", NULL},
    {"strays.fraction", "fraction of strands that stray all along", NULL},
    {"strays.distance", "how far, in lengths", NULL},
    {"strays.frizz", "how far every strand kinks, m", NULL},
    {"strays.frizz_wavelength", "from one of its kinks to the next, m", NULL},
    {"curl.radius", "of curls or waves, m", NULL},
    {"curl.profile", "as a multiple of that, from root to tip", NULL},
    {"curl.wavelength", "along the strand, of a turn, m", NULL},
    {"curl.turns", "beside those, from root to tip", NULL},
    {"curl.flatness", "0: a helix; 1: a wave in a plane", NULL},
    {"curl.left_fraction", "fraction of guides whose strands turn to the left", NULL},
    {"curl.guide_phase", "how far apart guides are, turns", NULL},
    {"curl.strand_phase", "and strands of one guide, turns", NULL},
    {"curl.spread", "of radius and length of turns", NULL},
    {"fit_curl", "a turn of the first strand of this file (.hair, .tfx), m", NULL},
    {"curl.shape", "the course of a turn", "helix, example"},
    {"self_shadow.method", "of hair on itself, is found by", "depth, strands"},
    {"self_shadow.cell", "of strands: cells of the grid of how much hair there is, m", NULL},
    {"self_shadow.absorption", "of light by hair, 1/m", NULL},
    {"followers.density", "fraction of the followers drawn", NULL},
    {"strand.segments", "of a drawn strand", NULL},
    {"followers.collision", "what becomes of followers inside colliders", "push_out, single_guide, none"},
    {"followers.map_set", "of the scene's maps, from 0; between two a blend", NULL},
    {"light_direction.x", "from the hair towards the light", NULL},
    {"light_direction.y", "", NULL},
    {"light_direction.z", "", NULL},
    {"light.r", "irradiance of the light", NULL},
    {"light.g", "", NULL},
    {"light.b", "", NULL},
    {"ambient.r", "irradiance of the surroundings", NULL},
    {"ambient.g", "", NULL},
    {"ambient.b", "", NULL},
};

#define TEXT_COUNT (sizeof texts / sizeof *texts)

// Return the i-th name of a preset that sets several numbers, or NULL.
static const char* preset_of(const char* key, int i)
{
    if (!strcmp(key, "preset")) return hair_preset_name((hair_preset)i);
    if (!strcmp(key, "look")) return hair_look_name((hair_look_preset)i);
    return strcmp(key, "color") ? NULL : hair_color_name((hair_color)i);
}

const char* hair_setting_choices(const char* key, char out[128])
{
    struct hair_setting setting;
    size_t used = 0;
    for (int i = 0; preset_of(key, i); ++i)
        used += (size_t)snprintf(out + used, 128 - used, "%s%s", i ? ", " : "", preset_of(key, i));
    if (used) return out;
    if (hair_setting_find(key, &setting) && setting.kind == HAIR_SETTING_BOOL) return "off, on";
    for (size_t i = 0; i < TEXT_COUNT; ++i)
        if (!strcmp(texts[i].key, key)) return texts[i].choices;
    return NULL;
}

bool hair_setting_choose(const char* choices, const char* name, uint32_t* out)
{
    size_t length = strcspn(name, ",");
    *out = 0;
    if (!length || name[length]) return false;
    for (const char* at = choices; at; ++*out) {
        if (!strncmp(at, name, length) && (!at[length] || at[length] == ',')) return true;
        at = strchr(at, ',');
        if (at) at += 2;
    }
    return false;
}

// Print one number if all values of the curve are equal.
static void print_curve(const void* value, char* text, size_t size)
{
    hair_curve curve;
    size_t used = 0;
    int same = 1;
    memcpy(&curve, value, sizeof curve);
    while (same < HAIR_SETTING_CURVE_POINTS && curve.at[same] == curve.at[0]) ++same;
    for (int i = 0; i < (same == HAIR_SETTING_CURVE_POINTS ? 1 : HAIR_SETTING_CURVE_POINTS) && used < size;
         ++i)
        used += (size_t)snprintf(text + used, size - used, "%s%g", i ? "," : "", (double)curve.at[i]);
}

// Print a number, or its name if it has one.
static void print_value(const struct hair_setting* setting, const char* choices, char* text, size_t size)
{
    const struct hair_settings settings = hair_settings_default();
    const char* value = (const char*)&settings + setting->offset;
    uint32_t count = 0;
    float number;
    if (setting->kind == HAIR_SETTING_CURVE) {
        print_curve(value, text, size);
        return;
    }
    memcpy(&number, value, sizeof number);
    if (setting->kind == HAIR_SETTING_BOOL)
        count = *(const bool*)value;
    else
        memcpy(&count, value, sizeof count);
    for (uint32_t i = 0; choices && i < count; ++i) choices = strchr(choices, ',') + 2;
    if (choices)
        snprintf(text, size, "%.*s", (int)strcspn(choices, ","), choices);
    else if (setting->kind == HAIR_SETTING_UINT)
        snprintf(text, size, "%u", count);
    else if (number == HAIR_SCALE_GUESSED)
        snprintf(text, size, "guessed");
    else
        snprintf(text, size, "%g", (double)number);
}

static void print_setting(FILE* file, const char* key, const char* about)
{
    struct hair_setting setting;
    char text[64], names[128];
    const char* choices = hair_setting_choices(key, names);
    if (hair_setting_find(key, &setting))
        print_value(&setting, choices, text, sizeof text);
    else
        snprintf(text, sizeof text, "%s", preset_of(key, 0) ? preset_of(key, 0) : "none");
    fprintf(file, "  %-32s %-12s %s", key, text, about);
    if (choices) fprintf(file, ": %s", choices);
    fprintf(file, "\n");
}

static bool has_text(const char* key)
{
    for (size_t i = 0; i < TEXT_COUNT; ++i)
        if (!strcmp(texts[i].key, key)) return true;
    return false;
}

void hair_settings_print(FILE* file)
{
    struct hair_setting setting;
    for (size_t i = 0; i < TEXT_COUNT; ++i) print_setting(file, texts[i].key, texts[i].about);
    for (size_t at = 0; hair_setting_next(&at, &setting);)
        if (!has_text(setting.key)) print_setting(file, setting.key, "");
}
