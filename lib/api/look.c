// look.c - public calls on looks: kinds, colours, and curls made from an example.
#include "lib/api/api.h"

#include <string.h>

#define MAX_VERTICES 65536u // Maximum number of an example.

static const char* const kinds[] = {
    [HAIR_LOOK_NATURAL] = "natural", [HAIR_LOOK_STRAIGHT] = "straight",
    [HAIR_LOOK_WAVY] = "wavy",       [HAIR_LOOK_CURLY] = "curly",
    [HAIR_LOOK_COILY] = "coily",     [HAIR_LOOK_FRIZZY] = "frizzy",
    [HAIR_LOOK_SHORT] = "short",     [HAIR_LOOK_2A] = "2a",
    [HAIR_LOOK_2B] = "2b",           [HAIR_LOOK_2C] = "2c",
    [HAIR_LOOK_3A] = "3a",           [HAIR_LOOK_3B] = "3b",
    [HAIR_LOOK_3C] = "3c",           [HAIR_LOOK_4A] = "4a",
    [HAIR_LOOK_4B] = "4b",           [HAIR_LOOK_4C] = "4c",
};

const char* hair_look_name(hair_look_preset kind)
{
    return (unsigned)kind < HAIR_LOOK_COUNT ? kinds[kind] : NULL;
}

static void wave(hair_look* look)
{
    look->clump.weight = (hair_curve){{0, 0.15f, 0.35f, 0.5f, 0.6f, 0.68f, 0.74f, 0.8f}};
    look->curl.radius = 0.009f;
    look->curl.profile = (hair_curve){{0, 0.15f, 0.45f, 0.8f, 1, 1.1f, 1.1f, 1}};
    look->curl.wavelength = 0.085f;
    look->curl.flatness = 0.4f;
    look->curl.guide_phase = 0.5f;
    look->curl.strand_phase = 0.06f;
    look->curl.spread = 0.08f;
    look->curl.guide_spread = 0.2f;
    look->curl.variation = 0.3f;
    look->curl.left_fraction = 0.5f;
}

static void curl(hair_look* look)
{
    look->clump.weight = (hair_curve){{0, 0.35f, 0.65f, 0.82f, 0.9f, 0.94f, 0.96f, 0.97f}};
    look->clump.width = (hair_curve){{1, 0.95f, 0.8f, 0.65f, 0.55f, 0.5f, 0.5f, 0.55f}};
    look->curl.radius = 0.012f;
    look->curl.profile = (hair_curve){{0, 0.25f, 0.65f, 0.9f, 1, 1.05f, 1, 0.9f}};
    look->curl.wavelength = 0.05f;
    look->curl.strand_phase = 0.08f;
    look->curl.spread = 0.03f;
    look->curl.guide_spread = 0.25f;
    look->curl.variation = 0.3f;
    look->curl.left_fraction = 0.5f;
    look->strays.tip_fraction = 0.4f;
}

static void coil(hair_look* look)
{
    look->clump.weight = (hair_curve){{0, 0.3f, 0.5f, 0.65f, 0.75f, 0.8f, 0.85f, 0.9f}};
    look->curl.radius = 0.0045f;
    look->curl.profile = (hair_curve){{0, 0.8f, 1, 1, 1, 1, 1, 0.9f}};
    look->curl.wavelength = 0.018f;
    look->curl.strand_phase = 0.2f;
    look->curl.spread = 0.15f;
    look->curl.guide_spread = 0.2f;
    look->curl.variation = 0.25f;
    look->curl.left_fraction = 0.5f;
    look->strays.fraction = 0.25f;
}

static void frizz(hair_look* look)
{
    look->clump.weight = (hair_curve){{0, 0, 0.03f, 0.08f, 0.14f, 0.2f, 0.25f, 0.3f}};
    look->strays.tip_fraction = 0.5f;
    look->strays.tip_distance = (hair_curve){{0, 0, 0.001f, 0.003f, 0.008f, 0.018f, 0.035f, 0.06f}};
    look->strays.fraction = 0.35f;
    look->strays.distance = (hair_curve){{0, 0.01f, 0.025f, 0.035f, 0.04f, 0.045f, 0.05f, 0.055f}};
    look->strays.frizz = (hair_curve){{0, 0.0012f, 0.0022f, 0.003f, 0.0035f, 0.004f, 0.0045f, 0.005f}};
    look->strays.frizz_wavelength = 0.012f;
}

// A type of Walker's scale. Wide curls form locks. Narrow ones wind strand by strand.
static const struct curl_type {
    float diameter, turn; // m
    float flatness;
    hair_curve profile, weight;
    float strand_phase, spread; // between strands of a guide
    float frizz_fraction, frizz; // frizz in m, at the tip
} types[] = {
#define WAVE_WEIGHT                                                                                          \
    {                                                                                                        \
        {                                                                                                    \
            0, 0.1f, 0.25f, 0.4f, 0.52f, 0.62f, 0.7f, 0.76f                                                  \
        }                                                                                                    \
    }
#define LOCK_WEIGHT                                                                                          \
    {                                                                                                        \
        {                                                                                                    \
            0, 0.4f, 0.75f, 0.92f, 0.97f, 1, 1, 1                                                            \
        }                                                                                                    \
    }
#define COIL_WEIGHT                                                                                          \
    {                                                                                                        \
        {                                                                                                    \
            0, 0.35f, 0.6f, 0.75f, 0.82f, 0.86f, 0.9f, 0.92f                                                 \
        }                                                                                                    \
    }
    {0.018f,
     0.120f,
     0.6f,
     {{0, 0, 0.08f, 0.25f, 0.55f, 0.85f, 1, 1}},
     WAVE_WEIGHT,
     0.05f,
     0.04f,
     0.08f,
     0.001f},
    {0.020f,
     0.090f,
     0.5f,
     {{0, 0.05f, 0.25f, 0.6f, 0.9f, 1, 1, 1}},
     WAVE_WEIGHT,
     0.05f,
     0.03f,
     0.12f,
     0.0015f},
    {0.022f, 0.065f, 0.35f, {{0, 0.15f, 0.5f, 0.85f, 1, 1, 1, 1}}, LOCK_WEIGHT, 0.04f, 0.03f, 0.18f, 0.002f},
    {0.025f, 0.055f, 0, {{0, 0.2f, 0.6f, 0.9f, 1, 1, 1, 1}}, LOCK_WEIGHT, 0.03f, 0.02f, 0.18f, 0.002f},
    {0.014f, 0.034f, 0, {{0, 0.4f, 0.85f, 1, 1, 1, 1, 1}}, LOCK_WEIGHT, 0.03f, 0.016f, 0.2f, 0.002f},
    {0.008f, 0.021f, 0, {{0, 0.6f, 1, 1, 1, 1, 1, 1}}, LOCK_WEIGHT, 0.04f, 0.015f, 0.25f, 0.002f},
    {0.005f, 0.013f, 0, {{0, 0.9f, 1, 1, 1, 1, 1, 1}}, COIL_WEIGHT, 0.12f, 0.03f, 0.25f, 0.0015f},
    {0.004f, 0.009f, 0.6f, {{0, 1, 1, 1, 1, 1, 1, 1}}, COIL_WEIGHT, 0.2f, 0.06f, 0.35f, 0.0015f},
    {0.003f, 0.007f, 0.2f, {{0, 1, 1, 1, 1, 1, 1, 1}}, COIL_WEIGHT, 0.3f, 0.08f, 0.4f, 0.0015f},
#undef WAVE_WEIGHT
#undef LOCK_WEIGHT
#undef COIL_WEIGHT
};

static void apply_type(hair_look* look, const struct curl_type* type)
{
    look->clump.weight = type->weight;
    look->clump.width = (hair_curve){{1, 0.9f, 0.75f, 0.62f, 0.55f, 0.52f, 0.55f, 0.65f}};
    look->curl.radius = 0.5f * type->diameter;
    look->curl.profile = type->profile;
    look->curl.wavelength = type->turn;
    look->curl.flatness = type->flatness;
    look->curl.strand_phase = type->strand_phase;
    look->curl.spread = type->spread;
    look->curl.guide_spread = 0.25f;
    look->curl.variation = 0.3f;
    look->curl.left_fraction = 0.5f;
    look->strays.fraction = 0.06f;
    look->strays.tip_fraction = 0.4f;
    look->strays.frizz_fraction = type->frizz_fraction;
    look->strays.frizz = hair_curve_line(0, type->frizz);
    look->strays.frizz_wavelength = 0.02f;
}

hair_result hair_look_apply_preset(hair_look* look, hair_look_preset kind)
{
    // Segments of 0.4 m of hair, at eight per turn, as far as 256 suffice.
    static const uint32_t segments[] = {
        [HAIR_LOOK_WAVY] = 64, [HAIR_LOOK_CURLY] = 96, [HAIR_LOOK_COILY] = 192, [HAIR_LOOK_FRIZZY] = 96,
        [HAIR_LOOK_2A] = 32,   [HAIR_LOOK_2B] = 40,    [HAIR_LOOK_2C] = 52,     [HAIR_LOOK_3A] = 60,
        [HAIR_LOOK_3B] = 96,   [HAIR_LOOK_3C] = 152,   [HAIR_LOOK_4A] = 248,    [HAIR_LOOK_4B] = 256,
        [HAIR_LOOK_4C] = 256};
    if (!look || (unsigned)kind >= HAIR_LOOK_COUNT) return HAIR_ERROR_ARGUMENT;
    const hair_host silent = {0};
    hair_look own, fresh = hair_look_default();
    HAIR_TRY(HAIR_COPY_IN(&silent, hair_look, look, &own));
    own.strand.taper = fresh.strand.taper;
    own.strand.length = fresh.strand.length;
    own.strand.length_variation = fresh.strand.length_variation;
    own.clump = fresh.clump;
    own.strays = fresh.strays;
    own.curl = fresh.curl;
    if (kind == HAIR_LOOK_STRAIGHT) {
        own.strays.tip_fraction = 0.1f;
        own.strays.fraction = 0;
        own.clump.weight = hair_curve_line(0, 0.4f);
    }
    if (kind == HAIR_LOOK_WAVY) wave(&own);
    if (kind == HAIR_LOOK_CURLY) curl(&own);
    if (kind == HAIR_LOOK_COILY) coil(&own);
    if (kind == HAIR_LOOK_FRIZZY) frizz(&own);
    if (kind >= HAIR_LOOK_2A) apply_type(&own, &types[kind - HAIR_LOOK_2A]);
    if (kind == HAIR_LOOK_SHORT) {
        own.strand.length = 0.32f;
        own.strand.length_variation = 0.3f;
        own.clump.weight = hair_curve_line(0, 0.25f);
        own.strays.tip_fraction = 0.5f;
    }
    if (own.strand.segments < segments[kind]) own.strand.segments = segments[kind];
    return HAIR_COPY_OUT(&silent, hair_look, &own, look);
}

// Natural blond, red and white hair is darker and less saturated than dyed hair. look_test.c has
// their bounds in CIELAB.
static const struct {
    const char* name;
    float root[3], tip[3], spread;
} colors[] = {
    [HAIR_COLOR_BROWN] = {"brown", {0.13f, 0.055f, 0.024f}, {0.26f, 0.13f, 0.06f}, 0.4f},
    [HAIR_COLOR_DARK_BROWN] = {"dark_brown", {0.05f, 0.024f, 0.014f}, {0.09f, 0.046f, 0.027f}, 0.35f},
    [HAIR_COLOR_BLACK] = {"black", {0.011f, 0.01f, 0.01f}, {0.018f, 0.0163f, 0.017f}, 0.3f},
    [HAIR_COLOR_BLOND] = {"blond", {0.308f, 0.192f, 0.104f}, {0.449f, 0.307f, 0.175f}, 0.3f},
    [HAIR_COLOR_RED] = {"red", {0.149f, 0.053f, 0.023f}, {0.282f, 0.097f, 0.033f}, 0.35f},
    [HAIR_COLOR_AUBURN] = {"auburn", {0.1f, 0.03f, 0.015f}, {0.17f, 0.056f, 0.029f}, 0.35f},
    [HAIR_COLOR_GRAY] = {"gray", {0.25f, 0.25f, 0.255f}, {0.38f, 0.38f, 0.385f}, 0.6f},
    [HAIR_COLOR_WHITE] = {"white", {0.611f, 0.562f, 0.488f}, {0.666f, 0.617f, 0.537f}, 0.15f},
    [HAIR_COLOR_BLUE] = {"blue", {0.016f, 0.045f, 0.17f}, {0.03f, 0.11f, 0.34f}, 0.3f},
};

const char* hair_color_name(hair_color color)
{
    return (unsigned)color < HAIR_COLOR_COUNT ? colors[color].name : NULL;
}

hair_result hair_look_color(hair_look* look, hair_color color)
{
    if (!look || (unsigned)color >= HAIR_COLOR_COUNT) return HAIR_ERROR_ARGUMENT;
    const hair_host silent = {0};
    hair_look own;
    HAIR_TRY(HAIR_COPY_IN(&silent, hair_look, look, &own));
    memcpy(own.color.root, colors[color].root, sizeof own.color.root);
    memcpy(own.color.tip, colors[color].tip, sizeof own.color.tip);
    own.color.spread = colors[color].spread;
    own.pigment.weight = 0;
    return HAIR_COPY_OUT(&silent, hair_look, &own, look);
}

hair_result hair_look_find_colors(const hair_look* look, float root[3], float tip[3])
{
    if (!look || !root || !tip) return HAIR_ERROR_ARGUMENT;
    const hair_host silent = {0};
    hair_look own;
    HAIR_TRY(HAIR_COPY_IN(&silent, hair_look, look, &own));
    hair_look_apply_pigment(&own);
    memcpy(root, own.color.root, sizeof own.color.root);
    memcpy(tip, own.color.tip, sizeof own.color.tip);
    return HAIR_OK;
}

// Curls from an example --------------------------------------------------------------------------

struct example {
    const float* positions;
    uint32_t vertices;
    hair_vec3 first, x, z; // first vertex, and unit vectors across the axis
    float length;
};

static hair_vec3 vertex_of(const struct example* e, uint32_t i)
{
    return hair_sub(hair_load3(e->positions + 3 * (size_t)i), e->first);
}

// Compute the x and z coordinates across the axis at `fraction` of the length. Search from
// segment `i` on, which starts `before` metres along the example.
static void look_at(const struct example* e, float fraction, uint32_t* i, float* before, float out[2])
{
    float at = fraction * e->length, link = hair_distance(vertex_of(e, *i), vertex_of(e, *i + 1));
    HAIR_ASSERT(*i + 1 < e->vertices);
    while (*i + 2 < e->vertices && *before + link < at) {
        *before += link;
        ++*i;
        link = hair_distance(vertex_of(e, *i), vertex_of(e, *i + 1));
    }
    float along = link > 0 ? fminf((at - *before) / link, 1) : 0;
    hair_vec3 p = hair_lerp(vertex_of(e, *i), vertex_of(e, *i + 1), along);
    out[0] = hair_dot(p, e->x);
    out[1] = hair_dot(p, e->z);
}

// Find one turn of the curl. Its ends are on a line along its axis, so that it can be repeated. The
// axis goes through its middle.
static void find_turn(const struct example* e, float turn[2][HAIR_TURN_PLACES], float* radius)
{
    float mean[2] = {0, 0}, before = 0;
    uint32_t at = 0;
    for (int i = 0; i < HAIR_TURN_PLACES; ++i) {
        float point[2];
        look_at(e, (float)i / HAIR_TURN_PLACES, &at, &before, point);
        for (int k = 0; k < 2; ++k) {
            turn[k][i] = point[k];
            mean[k] += point[k] / HAIR_TURN_PLACES;
        }
    }
    *radius = 0;
    for (int i = 0; i < HAIR_TURN_PLACES; ++i) {
        for (int k = 0; k < 2; ++k) turn[k][i] -= mean[k];
        *radius = fmaxf(*radius, hypotf(turn[0][i], turn[1][i]));
    }
}

static int is_usable(const float* positions, uint32_t vertices)
{
    if (!positions || vertices < 3 || vertices > MAX_VERTICES) return 0;
    for (size_t i = 0; i < 3 * (size_t)vertices; ++i)
        if (!(fabsf(positions[i]) <= 1e6f)) return 0;
    return 1;
}

hair_result hair_look_fit_curl(hair_look* look, const float* positions, uint32_t vertex_count)
{
    if (!look || !is_usable(positions, vertex_count)) return HAIR_ERROR_ARGUMENT;
    const hair_host silent = {0};
    hair_look own;
    HAIR_TRY(HAIR_COPY_IN(&silent, hair_look, look, &own));

    struct example e = {.positions = positions, .vertices = vertex_count, .first = hair_load3(positions)};
    hair_vec3 chord = vertex_of(&e, vertex_count - 1);
    float axis = hair_length(chord), turn[2][HAIR_TURN_PLACES];
    if (!(axis >= 0.001f && axis <= 10)) return HAIR_ERROR_ARGUMENT;
    chord = hair_scale(chord, 1 / axis);
    HAIR_ASSERT(hair_is_unit(chord));
    e.x = hair_perpendicular(chord);
    e.z = hair_cross(e.x, chord);
    for (uint32_t i = 0; i + 1 < vertex_count; ++i)
        e.length += hair_distance(vertex_of(&e, i), vertex_of(&e, i + 1));
    find_turn(&e, turn, &own.curl.radius);
    if (!(own.curl.radius <= 0.1f)) return HAIR_ERROR_ARGUMENT;
    float unit = fmaxf(own.curl.radius, 1e-9f);
    for (int i = 0; i < HAIR_TURN_PLACES; ++i) {
        own.curl.profile_x[i] = turn[0][i] / unit;
        own.curl.profile_z[i] = turn[1][i] / unit;
    }
    own.curl.shape = HAIR_CURL_SHAPE_EXAMPLE;
    own.curl.wavelength = axis;
    own.curl.turns = 0;
    return HAIR_COPY_OUT(&silent, hair_look, &own, look);
}
