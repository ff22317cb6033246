// settings.c - Every setting of a capture that a user can set by name.
#include "tools/common/settings.h"
#include "tools/common/file.h"

#include <errno.h>
#include <math.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#define MAX_TARGETS 3
#define MAX_CHOICES 5
#define MAX_EXAMPLE ((size_t)16 << 20) // bytes
#define CURVE_PLACES (int)(sizeof(hair_curve) / sizeof(float))

enum kind { FLOAT, COUNT, SWITCH, CURVE, PRESET, LOOK, COLOR, LIKE };

// Key of a setting and its destinations. There are several if several descriptors have the same
// field.
struct row {
    const char* key;
    const char* about;
    enum kind kind;
    uint16_t target[MAX_TARGETS]; // offsets into hair_settings, 0 ends the list
    const char* choice[MAX_CHOICES]; // names of the values 0, 1, …
};

#define AT(member) (uint16_t) offsetof(struct hair_settings, member)

static const struct row rows[] = {
    {"scale", "of the file's units to metres", FLOAT, {AT(import.scale)}, {0}},
    {"up", "axis of the file that points up", COUNT, {AT(import.up)}, {"y", "z", "x"}},
    {"tip_first", "strands of the file run from tip to root", SWITCH, {AT(import.tip_first)}, {"off", "on"}},
    {"keep_fraction", "of the file's strands to keep", FLOAT, {AT(import.keep_fraction)}, {0}},
    {"vertices",
     "of every strand, resampled; 0: as it is",
     COUNT,
     {AT(import.strand_vertices), AT(style.strand_vertices)},
     {0}},
    {"length", "of the style's own lengths", FLOAT, {AT(style.length)}, {0}},
    {"guides", "strands to simulate", COUNT, {AT(groom.guide_count), AT(style.guide_count)}, {0}},
    {"guide_vertices", "most vertices simulated in each", COUNT, {AT(groom.guide_vertices)}, {0}},
    {"followers", "strands to grow between guides", COUNT, {AT(groom.follower_count)}, {0}},
    {"clump_radius", "of what grows around a guide without a scalp, m", FLOAT, {AT(groom.clump_radius)}, {0}},
    {"seed", "of every random choice", COUNT, {AT(import.seed), AT(style.seed), AT(groom.seed)}, {0}},

    {"solver", "of the motion", COUNT, {AT(desc.solver)}, {"direct", "accurate", "follow", "redblack"}},
    {"substep", "length of a substep, s; 0: as the solver wants", FLOAT, {AT(desc.substep)}, {0}},
    {"thread_mapping",
     "of guides to GPU threads",
     COUNT,
     {AT(desc.thread_mapping)},
     {"auto", "workgroup_per_guide", "thread_per_guide", "feedback"}},
    {"hit_method",
     "how followers inside colliders are found",
     COUNT,
     {AT(desc.hit_method)},
     {"auto", "compute", "prepass"}},
    {"max_dt", "longest time a step advances, s", FLOAT, {AT(desc.max_dt)}, {0}},
    {"preset", "kind of hair, which sets some of the numbers below", PRESET, {AT(physics)}, {0}},
    {"gravity.x", "m/s^2", FLOAT, {AT(physics.gravity[0])}, {0}},
    {"gravity.y", "m/s^2", FLOAT, {AT(physics.gravity[1])}, {0}},
    {"gravity.z", "m/s^2", FLOAT, {AT(physics.gravity[2])}, {0}},
    {"damping", "decay rate of velocity relative to the air, 1/s", FLOAT, {AT(physics.damping)}, {0}},
    {"shape.frequency_root",
     "pull to the rest pose at the root, Hz",
     FLOAT,
     {AT(physics.shape.frequency_root)},
     {0}},
    {"shape.frequency_tip", "the same at the tip, Hz", FLOAT, {AT(physics.shape.frequency_tip)}, {0}},
    {"redblack.angular_hz",
     "redblack: pull to the rest angle, Hz",
     FLOAT,
     {AT(physics.redblack.angular_hz)},
     {0}},
    {"redblack.bend",
     "redblack: fraction of the bend that an iteration removes",
     FLOAT,
     {AT(physics.redblack.bend)},
     {0}},
    {"redblack.iterations",
     "redblack: of constraints in a substep",
     COUNT,
     {AT(physics.redblack.iterations)},
     {0}},
    {"hair_hair.cohesion",
     "decay rate of velocity relative to the hair around, 1/s",
     FLOAT,
     {AT(physics.hair_hair.cohesion)},
     {0}},
    {"hair_hair.pressure_stiffness",
     "resistance to being denser than at rest, m^2/s^2",
     FLOAT,
     {AT(physics.hair_hair.pressure_stiffness)},
     {0}},
    {"substep_rate",
     "fraction of the solver's own substeps that is made",
     FLOAT,
     {AT(physics.substep_rate)},
     {0}},
    {"offscreen_substep_rate",
     "the same while no view shows the hair",
     FLOAT,
     {AT(physics.offscreen_substep_rate)},
     {0}},
    {"sleep_threshold",
     "how near to where it comes to rest hair sleeps, m",
     FLOAT,
     {AT(physics.sleep_threshold)},
     {0}},
    {"collision.margin", "distance kept to colliders, m", FLOAT, {AT(physics.collision.margin)}, {0}},
    {"fiber.youngs_modulus", "Young's modulus of a hair, Pa", FLOAT, {AT(physics.fiber.youngs_modulus)}, {0}},
    {"fiber.poisson_ratio", "its Poisson's ratio", FLOAT, {AT(physics.fiber.poisson_ratio)}, {0}},
    {"fiber.radius", "of a hair's section, m", FLOAT, {AT(physics.fiber.radius)}, {0}},
    {"fiber.density", "of a hair, kg/m^3", FLOAT, {AT(physics.fiber.density)}, {0}},
    {"fiber.flatness", "short by long axis of its section", FLOAT, {AT(physics.fiber.flatness)}, {0}},
    {"shape.stiffness_root",
     "of a guide, as a multiple of a hair's, at the root",
     FLOAT,
     {AT(physics.shape.stiffness_root)},
     {0}},
    {"shape.stiffness_tip", "the same at the tip", FLOAT, {AT(physics.shape.stiffness_tip)}, {0}},
    {"shape.gravity_preload",
     "fraction of gravity that the rest shape bears",
     FLOAT,
     {AT(physics.shape.gravity_preload)},
     {0}},
    {"root", "how the scalp holds it", COUNT, {AT(physics.root)}, {"clamped", "hinged", "free"}},
    {"tip_mass", "hung on the tip, as a multiple of the strand's", FLOAT, {AT(physics.tip_mass)}, {0}},
    {"wind.x", "velocity of the air, m/s", FLOAT, {AT(wind.velocity[0])}, {0}},
    {"wind.y", "", FLOAT, {AT(wind.velocity[1])}, {0}},
    {"wind.z", "", FLOAT, {AT(wind.velocity[2])}, {0}},
    {"wind.still_air",
     "the law of its drag acts where none blows too",
     SWITCH,
     {AT(wind.still_air)},
     {"off", "on"}},
    {"wind.model",
     "how air moves: as it would by itself, or round head and colliders",
     COUNT,
     {AT(wind.model)},
     {"ambient", "fluid"}},
    {"wind.fluid.resolution", "of the fluid: cells along a side", COUNT, {AT(wind.fluid.resolution)}, {0}},
    {"wind.fluid.grid_size", "of the fluid: its side, m", FLOAT, {AT(wind.fluid.grid_size)}, {0}},
    {"wind.fluid.projection",
     "of the fluid",
     COUNT,
     {AT(wind.fluid.projection)},
     {"multigrid", "relaxation", "jacobi"}},
    {"wind.fluid.projection_iterations", "of that", COUNT, {AT(wind.fluid.projection_iterations)}, {0}},
    {"wind.turbulence.intensity",
     "standard deviation of gusts, as a fraction of that",
     FLOAT,
     {AT(wind.turbulence.intensity)},
     {0}},
    {"wind.turbulence.length", "their integral length scale, m", FLOAT, {AT(wind.turbulence.length)}, {0}},
    {"wind.turbulence.seed", "of gusts", COUNT, {AT(wind.turbulence.seed)}, {0}},
    {"wind.shelter", "how much head and colliders divert it", FLOAT, {AT(wind.shelter)}, {0}},
    {"wind.fluid.drag_strand_count",
     "that slow the fluid down",
     COUNT,
     {AT(wind.fluid.drag_strand_count)},
     {0}},
    {"wind.density", "of the air, kg/m^3", FLOAT, {AT(wind.density)}, {0}},
    {"wind.viscosity", "of the air, Pa s", FLOAT, {AT(wind.viscosity)}, {0}},
    {"drag", "of wind, as a multiple of that of a single hair", FLOAT, {AT(physics.drag)}, {0}},
    {"collision.friction",
     "Coulomb's coefficient with colliders",
     FLOAT,
     {AT(physics.collision.friction)},
     {0}},

    {"render_path",
     "of drawing",
     COUNT,
     {AT(view.render_path)},
     {"tessellation", "cached", "compute", "auto", "procedural"}},
    {"primitive", "that strands are drawn as", COUNT, {AT(view.primitive)}, {"ribbons", "lines"}},
    {"coverage", "of pixels by thin strands", COUNT, {AT(view.coverage)}, {"msaa", "alpha"}},
    {"opacity", "of shares", FLOAT, {AT(view.opacity)}, {0}},
    {"hide", "leave out hair behind the head", SWITCH, {AT(hides)}, {"off", "on"}},
    {"lod", "level of detail", SWITCH, {AT(has_lod)}, {"off", "on"}},
    {"lod.strand_fraction", "fraction of the strands drawn, at most", FLOAT, {AT(lod.strand_fraction)}, {0}},
    {"lod.segment_fraction", "fraction of their segments, at most", FLOAT, {AT(lod.segment_fraction)}, {0}},
    {"lod.width_exponent",
     "power of 1 / share that strands are wider by",
     FLOAT,
     {AT(lod.width_exponent)},
     {0}},
    {"lod.per_patch", "by how large each patch appears", SWITCH, {AT(lod.per_patch)}, {"off", "on"}},
    {"lod.strand_pixels", "dynamic: least width of a strand", FLOAT, {AT(lod.strand_pixels)}, {0}},
    {"lod.segment_pixels", "dynamic: least length of a segment", FLOAT, {AT(lod.segment_pixels)}, {0}},
    {"lod.min_strand_fraction",
     "dynamic: minimum fraction of strands",
     FLOAT,
     {AT(lod.min_strand_fraction)},
     {0}},
    {"lod.importance", "dynamic: factor of how large hair appears", FLOAT, {AT(lod.importance)}, {0}},
    {"lod.occluded_importance",
     "dynamic: the same for hair behind the head",
     FLOAT,
     {AT(lod.occluded_importance)},
     {0}},
    {"slice", "of the field, or of air, with --show", COUNT, {AT(view.slice)}, {"none", "x", "y", "z"}},
    {"slice_at", "where, as a fraction of the field's box", FLOAT, {AT(view.slice_at)}, {0}},
    {"field_voxel", "side of a voxel of the field, m", FLOAT, {AT(desc.field_voxel)}, {0}},
    {"look", "kind of look, which sets strand, clump, strays and curl below", LOOK, {AT(look)}, {0}},
    {"color", "of hair, which sets color.root to color.spread", COLOR, {AT(look)}, {0}},
    {"color.root.r", "diffuse reflectance at the root", FLOAT, {AT(look.color.root[0])}, {0}},
    {"color.root.g", "", FLOAT, {AT(look.color.root[1])}, {0}},
    {"color.root.b", "", FLOAT, {AT(look.color.root[2])}, {0}},
    {"color.tip.r", "the same at the tip", FLOAT, {AT(look.color.tip[0])}, {0}},
    {"color.tip.g", "", FLOAT, {AT(look.color.tip[1])}, {0}},
    {"color.tip.b", "", FLOAT, {AT(look.color.tip[2])}, {0}},
    {"color.spread", "of brightness between strands", FLOAT, {AT(look.color.spread)}, {0}},
    {"color.tint_red", "times the red of these, from root to tip", CURVE, {AT(look.color.tint_red)}, {0}},
    {"color.tint_green", "times the green", CURVE, {AT(look.color.tint_green)}, {0}},
    {"color.tint_blue", "times the blue", CURVE, {AT(look.color.tint_blue)}, {0}},
    {"color.hue_spread", "of red against blue between strands", FLOAT, {AT(look.color.hue_spread)}, {0}},
    {"color.root_darkening",
     "fraction of the colour that is lost at the root",
     FLOAT,
     {AT(look.color.root_darkening)},
     {0}},
    {"color.root_darkening_length",
     "fraction of the strand over which it comes back",
     FLOAT,
     {AT(look.color.root_darkening_length)},
     {0}},
    {"color.streaks",
     "fraction of the strands that have another colour",
     FLOAT,
     {AT(look.color.streaks)},
     {0}},
    {"color.streak_color.r", "theirs", FLOAT, {AT(look.color.streak_color[0])}, {0}},
    {"color.streak_color.g", "", FLOAT, {AT(look.color.streak_color[1])}, {0}},
    {"color.streak_color.b", "", FLOAT, {AT(look.color.streak_color[2])}, {0}},
    {"color.streak_clumping",
     "fraction of strands that go by their lock",
     FLOAT,
     {AT(look.color.streak_clumping)},
     {0}},
    {"color.groom_colors",
     "fraction of the colours that a haircut has of its own",
     FLOAT,
     {AT(look.color.groom_colors)},
     {0}},
    {"wetness", "darker, smoother, drawn together", FLOAT, {AT(look.wetness)}, {0}},
    {"shading.model", "of strands", COUNT, {AT(look.shading.model)}, {"fibres", "lines"}},
    {"shading.roughness.along", "of fibres", FLOAT, {AT(look.shading.roughness[0])}, {0}},
    {"shading.roughness.round", "of fibres", FLOAT, {AT(look.shading.roughness[1])}, {0}},
    {"shading.cuticle_tilt", "of the scales of fibres, radians", FLOAT, {AT(look.shading.cuticle_tilt)}, {0}},
    {"shading.roughness_spread",
     "of roughness between strands",
     FLOAT,
     {AT(look.shading.roughness_spread)},
     {0}},
    {"shading.cuticle_tilt_spread",
     "of tilt between strands",
     FLOAT,
     {AT(look.shading.cuticle_tilt_spread)},
     {0}},
    {"shading.scattering",
     "fraction of the light from other fibres that is heeded",
     FLOAT,
     {AT(look.shading.scattering)},
     {0}},
    {"shading.specular.white", "strength of the first highlight", FLOAT, {AT(look.shading.specular[0])}, {0}},
    {"shading.specular.tinted", "strength of the second", FLOAT, {AT(look.shading.specular[1])}, {0}},
    {"shading.gloss.white", "exponent of the first highlight", FLOAT, {AT(look.shading.gloss[0])}, {0}},
    {"shading.gloss.tinted", "exponent of the second", FLOAT, {AT(look.shading.gloss[1])}, {0}},
    {"shading.sparkle", "how the second highlight glitters", FLOAT, {AT(look.shading.sparkle)}, {0}},
    {"strand.radius", "of a drawn strand, m", FLOAT, {AT(look.strand.radius)}, {0}},
    {"strand.taper", "as a fraction of that, from root to tip", CURVE, {AT(look.strand.taper)}, {0}},
    {"strand.length", "fraction of every strand that is drawn", FLOAT, {AT(look.strand.length)}, {0}},
    {"strand.length_variation",
     "most by which strands are shorter at random, as a share",
     FLOAT,
     {AT(look.strand.length_variation)},
     {0}},
    {"clump.interpolation",
     "what followers are made of",
     COUNT,
     {AT(look.clump.interpolation)},
     {"mixed", "single", "multi"}},
    {"clump.weight", "from three guides to one, from root to tip", CURVE, {AT(look.clump.weight)}, {0}},
    {"clump.width", "offsets from one guide, as a multiple", CURVE, {AT(look.clump.width)}, {0}},
    {"strays.tip_fraction",
     "fraction of strands that stray near their tips",
     FLOAT,
     {AT(look.strays.tip_fraction)},
     {0}},
    {"strays.tip_distance", "how far, in lengths", CURVE, {AT(look.strays.tip_distance)}, {0}},
    {"strays.fraction", "fraction of strands that stray all along", FLOAT, {AT(look.strays.fraction)}, {0}},
    {"strays.distance", "how far, in lengths", CURVE, {AT(look.strays.distance)}, {0}},
    {"strays.frizz", "how far every strand kinks, m", CURVE, {AT(look.strays.frizz)}, {0}},
    {"strays.frizz_wavelength",
     "from one of its kinks to the next, m",
     FLOAT,
     {AT(look.strays.frizz_wavelength)},
     {0}},
    {"curl.radius", "of curls or waves, m", FLOAT, {AT(look.curl.radius)}, {0}},
    {"curl.profile", "as a multiple of that, from root to tip", CURVE, {AT(look.curl.profile)}, {0}},
    {"curl.wavelength", "along the strand, of a turn, m", FLOAT, {AT(look.curl.wavelength)}, {0}},
    {"curl.turns", "beside those, from root to tip", FLOAT, {AT(look.curl.turns)}, {0}},
    {"curl.flatness", "0: a helix; 1: a wave in a plane", FLOAT, {AT(look.curl.flatness)}, {0}},
    {"curl.left_fraction",
     "fraction of guides whose strands turn to the left",
     FLOAT,
     {AT(look.curl.left_fraction)},
     {0}},
    {"curl.guide_phase", "how far apart guides are, turns", FLOAT, {AT(look.curl.guide_phase)}, {0}},
    {"curl.strand_phase", "and strands of one guide, turns", FLOAT, {AT(look.curl.strand_phase)}, {0}},
    {"curl.spread", "of radius and length of turns", FLOAT, {AT(look.curl.spread)}, {0}},
    {"fit_curl", "a turn of the first strand of this file (.hair, .tfx), m", LIKE, {AT(look)}, {0}},
    {"curl.shape", "the course of a turn", COUNT, {AT(look.curl.shape)}, {"helix", "example"}},
    {"self_shadow.method",
     "of hair on itself, is found by",
     COUNT,
     {AT(look.self_shadow.method)},
     {"depth", "strands"}},
    {"self_shadow.cell",
     "of strands: cells of the grid of how much hair there is, m",
     FLOAT,
     {AT(look.self_shadow.cell)},
     {0}},
    {"self_shadow.absorption", "of light by hair, 1/m", FLOAT, {AT(look.self_shadow.absorption)}, {0}},
    {"followers.density", "fraction of the followers drawn", FLOAT, {AT(look.followers.density)}, {0}},
    {"strand.segments", "of a drawn strand", COUNT, {AT(look.strand.segments)}, {0}},
    {"followers.collision",
     "what becomes of followers inside colliders",
     COUNT,
     {AT(look.followers.collision)},
     {"push_out", "single_guide", "none"}},
    {"followers.map_set",
     "of the scene's maps, from 0; between two a blend",
     FLOAT,
     {AT(look.followers.map_set)},
     {0}},
    {"light_direction.x", "from the hair towards the light", FLOAT, {AT(light.direction[0])}, {0}},
    {"light_direction.y", "", FLOAT, {AT(light.direction[1])}, {0}},
    {"light_direction.z", "", FLOAT, {AT(light.direction[2])}, {0}},
    {"light.r", "irradiance of the light", FLOAT, {AT(light.color[0])}, {0}},
    {"light.g", "", FLOAT, {AT(light.color[1])}, {0}},
    {"light.b", "", FLOAT, {AT(light.color[2])}, {0}},
    {"ambient.r", "irradiance of the surroundings", FLOAT, {AT(view.ambient[0])}, {0}},
    {"ambient.g", "", FLOAT, {AT(view.ambient[1])}, {0}},
    {"ambient.b", "", FLOAT, {AT(view.ambient[2])}, {0}},
};

#define ROW_COUNT (sizeof rows / sizeof *rows)

struct hair_settings hair_settings_default(void)
{
    struct hair_settings settings = {.import = hair_import_default(),
                                     .style = hair_style_desc_default(),
                                     .groom = hair_groom_desc_default(),
                                     .physics = hair_physics_default(),
                                     .wind = hair_wind_default(),
                                     .look = hair_look_default(),
                                     .desc = hair_desc_default(),
                                     .view = hair_view_default(),
                                     .light = hair_light_default(),
                                     .lod = hair_lod_default()};
    settings.import.scale = HAIR_SCALE_GUESSED;
    return settings;
}

static const struct row* find(const char* key)
{
    for (size_t i = 0; i < ROW_COUNT; ++i)
        if (!strcmp(rows[i].key, key)) return &rows[i];
    return NULL;
}

static void store(struct hair_settings* settings, const struct row* row, const void* value)
{
    for (int i = 0; i < MAX_TARGETS && (i == 0 || row->target[i]); ++i)
        memcpy((char*)settings + row->target[i], value, row->kind == SWITCH ? sizeof(bool) : 4);
}

// Set a switch from "off" or "on", or from 0 or 1.
static bool set_switch(struct hair_settings* settings, const struct row* row, const char* value)
{
    bool is_on = !strcmp(value, "1") || !strcmp(value, row->choice[1]);
    if (!is_on && strcmp(value, "0") && strcmp(value, row->choice[0])) return false;
    store(settings, row, &is_on);
    return true;
}

static bool set_choice(struct hair_settings* settings, const struct row* row, const char* value)
{
    for (uint32_t i = 0; i < MAX_CHOICES && row->choice[i]; ++i)
        if (!strcmp(row->choice[i], value)) {
            store(settings, row, &i);
            return true;
        }
    return false;
}

// Return the i-th name of a preset that sets several numbers, or NULL.
static const char* preset_of(enum kind kind, int i)
{
    if (kind == PRESET) return hair_preset_name((hair_preset)i);
    return kind == LOOK ? hair_look_name((hair_look_preset)i) : hair_color_name((hair_color)i);
}

static bool set_preset(struct hair_settings* settings, enum kind kind, const char* value)
{
    int preset = 0;
    while (preset_of(kind, preset) && strcmp(preset_of(kind, preset), value)) ++preset;
    if (kind == PRESET) return hair_physics_preset(&settings->physics, (hair_preset)preset) == HAIR_OK;
    if (kind == LOOK) return hair_look_apply_preset(&settings->look, (hair_look_preset)preset) == HAIR_OK;
    return hair_look_color(&settings->look, (hair_color)preset) == HAIR_OK;
}

// Set the curl from the first strand of a file. The whole strand is one turn.
static bool set_curl_like(struct hair_settings* settings, const char* path)
{
    struct hair_bytes bytes;
    hair_asset* asset = NULL;
    hair_asset_desc desc = hair_asset_desc_default();
    hair_asset_info info = hair_asset_info_default();
    if (!hair_file_read("curl_like", path, MAX_EXAMPLE, &bytes)) return false;
    hair_result result = hair_asset_read(&desc, bytes.data, bytes.size, &asset);
    if (!result) result = hair_asset_describe(asset, &info);
    if (!result) result = hair_look_fit_curl(&settings->look, info.positions, info.strand_vertices[0]);
    hair_asset_destroy(asset);
    free(bytes.data);
    return result == HAIR_OK;
}

static bool set_number(struct hair_settings* settings, const struct row* row, const char* value)
{
    char* end;
    errno = 0;
    double wide = strtod(value, &end);
    float number = (float)wide;
    bool is_text = end == value || *end;
    if (is_text || !isfinite(number)) return false;
    if (row->kind == FLOAT) {
        store(settings, row, &number);
        return true;
    }
    if (wide < 0 || wide > UINT32_MAX || wide != floor(wide)) return false;
    uint32_t count = (uint32_t)wide;
    store(settings, row, &count);
    return true;
}

// Parse a curve such as "0.6" or "0,1". The numbers are evenly spaced from root to tip, at most as
// many as the curve has.
static bool set_curve(struct hair_settings* settings, const struct row* row, const char* value)
{
    hair_curve curve;
    float number[CURVE_PLACES];
    int count = 0;
    for (const char* at = value;; ++at) {
        char* end;
        double wide = strtod(at, &end);
        if (end == at || count == CURVE_PLACES || !isfinite((float)wide)) return false;
        number[count++] = (float)wide;
        if (!*end) break;
        if (*end != ',') return false;
        at = end;
    }
    for (int i = 0; i < CURVE_PLACES; ++i) {
        float along = (float)(i * (count - 1)) / (CURVE_PLACES - 1);
        int k = (int)along < count - 1 ? (int)along : count - 1;
        int next = k + 1 < count ? k + 1 : k;
        curve.at[i] = number[k] + (along - (float)k) * (number[next] - number[k]);
    }
    memcpy((char*)settings + row->target[0], &curve, sizeof curve);
    return true;
}

static bool set_value(struct hair_settings* settings, const struct row* row, const char* value)
{
    if (row->kind == CURVE) return set_curve(settings, row, value);
    if (row->kind == PRESET || row->kind == LOOK || row->kind == COLOR)
        return set_preset(settings, row->kind, value);
    if (row->kind == LIKE) return set_curl_like(settings, value);
    if (row->kind == SWITCH) return set_switch(settings, row, value);
    return row->choice[0] ? set_choice(settings, row, value) : set_number(settings, row, value);
}

// Return the i-th name that a row accepts, or NULL.
static const char* choice_of(const struct row* row, int i)
{
    if (row->kind == PRESET || row->kind == LOOK || row->kind == COLOR) return preset_of(row->kind, i);
    return i < MAX_CHOICES ? row->choice[i] : NULL;
}

static const char* choices_of(const struct row* row, char out[128])
{
    size_t used = 0;
    for (int i = 0; choice_of(row, i); ++i)
        used += (size_t)snprintf(out + used, 128 - used, "%s%s", i ? ", " : "", choice_of(row, i));
    return out;
}

static void complain_of_value(const char* tool, const struct row* row, const char* value)
{
    char names[128];
    if (choice_of(row, 0)) {
        hair_complain(tool, "%s is %s, not one of: %s", row->key, *value ? value : "empty",
                      choices_of(row, names));
        return;
    }
    const char* kind = row->kind == COUNT   ? "a whole number"
                       : row->kind == LIKE  ? "a file whose first strand is a turn of 1 mm to 10 m"
                       : row->kind == CURVE ? "one to eight finite numbers with commas between"
                                            : "a finite number";
    hair_complain(tool, "%s is %s, not %s", row->key, *value ? value : "empty", kind);
}

bool hair_settings_set(const char* tool, struct hair_settings* settings, const char* key, const char* value)
{
    const struct row* row = find(key);
    if (!row) {
        hair_complain(tool, "there is no setting %s; --help lists them", *key ? key : "without a name");
        return false;
    }
    if (set_value(settings, row, value)) return true;
    complain_of_value(tool, row, value);
    return false;
}

// Print one number if all values of the curve are equal.
static void print_curve(const void* value, char* text, size_t size)
{
    hair_curve curve;
    size_t used = 0;
    int same = 1;
    memcpy(&curve, value, sizeof curve);
    while (same < CURVE_PLACES && curve.at[same] == curve.at[0]) ++same;
    for (int i = 0; i < (same == CURVE_PLACES ? 1 : CURVE_PLACES) && used < size; ++i)
        used += (size_t)snprintf(text + used, size - used, "%s%g", i ? "," : "", (double)curve.at[i]);
}

void hair_settings_print(FILE* file)
{
    struct hair_settings settings = hair_settings_default();
    for (size_t i = 0; i < ROW_COUNT; ++i) {
        const struct row* row = &rows[i];
        const char* value = (const char*)&settings + row->target[0];
        uint32_t count;
        float number;
        memcpy(&count, value, sizeof count);
        memcpy(&number, value, sizeof number);
        if (row->kind == SWITCH) count = *(const bool*)value;
        char text[64], names[128];
        if (choice_of(row, 0))
            snprintf(text, sizeof text, "%s",
                     choice_of(row, row->kind == COUNT || row->kind == SWITCH ? (int)count : 0));
        else if (row->kind == LIKE)
            snprintf(text, sizeof text, "none");
        else if (row->kind == CURVE)
            print_curve(value, text, sizeof text);
        else if (row->kind == COUNT)
            snprintf(text, sizeof text, "%u", count);
        else if (number == HAIR_SCALE_GUESSED)
            snprintf(text, sizeof text, "guessed");
        else
            snprintf(text, sizeof text, "%g", (double)number);
        fprintf(file, "  %-32s %-12s %s", row->key, text, row->about);
        if (choice_of(row, 0)) fprintf(file, ": %s", choices_of(row, names));
        fprintf(file, "\n");
    }
}
