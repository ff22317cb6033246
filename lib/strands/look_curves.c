// look_curves.c - curves of a look along a strand, as cubic polynomials for shaders.
#include "lib/strands/geometry.h"

#include "lib/base/curve.h"

// Iterations of Gauss-Seidel over a turn. The remaining error is below float precision.
#define SWEEPS 24

static void write_curve(hair_curve curve, struct hair_strand_look* out, int number)
{
    HAIR_ASSERT((size_t)((number + 1) * HAIR_CURVE_INTERVALS) <= sizeof out->curve / sizeof *out->curve);
    hair_curve_to_cubics(&curve, out->curve + number * HAIR_CURVE_INTERVALS);
}

// Write the periodic spline with two continuous derivatives through equally spaced values.
static void write_turn(const float at[HAIR_TURN_PLACES], float scale, hair_vec4* out)
{
    float slope[HAIR_TURN_PLACES] = {0};
    for (int sweep = 0; sweep < SWEEPS; ++sweep)
        for (int i = 0; i < HAIR_TURN_PLACES; ++i) {
            int before = (i + HAIR_TURN_PLACES - 1) % HAIR_TURN_PLACES, after = (i + 1) % HAIR_TURN_PLACES;
            slope[i] = 0.25f * (3 * (at[after] - at[before]) - slope[before] - slope[after]);
        }
    for (int i = 0; i < HAIR_TURN_PLACES; ++i) {
        int after = (i + 1) % HAIR_TURN_PLACES;
        out[i] = hair_cubic_between(scale * at[i], scale * at[after], scale * slope[i], scale * slope[after]);
    }
}

static void write_turns(const hair_look* look, struct hair_strand_look* out)
{
    float circle[2][HAIR_TURN_PLACES];
    for (int i = 0; i < HAIR_TURN_PLACES; ++i) {
        circle[0][i] = cosf(6.2831853f * (float)i / HAIR_TURN_PLACES);
        circle[1][i] = sinf(6.2831853f * (float)i / HAIR_TURN_PLACES);
    }
    int like = look->curl.shape == HAIR_CURL_SHAPE_EXAMPLE;
    write_turn(like ? look->curl.profile_x : circle[0], 1, out->loop);
    write_turn(like ? look->curl.profile_z : circle[1], 1 - look->curl.flatness,
               out->loop + HAIR_TURN_PLACES);
}

// Return the clump curve. Single and multi interpolation are its limits 1 and 0.
static hair_curve clump_of(const hair_look* look)
{
    if (look->clump.interpolation == HAIR_INTERPOLATION_SINGLE) return hair_curve_line(1, 1);
    if (look->clump.interpolation == HAIR_INTERPOLATION_MULTI) return hair_curve_line(0, 0);
    return look->clump.weight;
}

float hair_curve_max(const hair_curve* curve)
{
    float max = curve->at[0];
    for (int i = 1; i <= HAIR_CURVE_INTERVALS; ++i) max = fmaxf(max, curve->at[i]);
    return max;
}

// Length of a displacement by 1 along both of the axes across a strand.
#define DIAGONAL 1.4142136f

float hair_look_max_stray(const hair_look* look)
{
    float tip = look->strays.tip_fraction > 0 ? hair_curve_max(&look->strays.tip_distance) : 0;
    float all = look->strays.fraction > 0 ? hair_curve_max(&look->strays.distance) : 0;
    return DIAGONAL * (tip + all);
}

float hair_look_max_offset(const hair_look* look)
{
    float curl = look->curl.radius * (1 + look->curl.spread) * (1 + look->curl.guide_spread) *
                 (1 + look->curl.variation) * hair_curve_max(&look->curl.profile);
    return DIAGONAL * (curl + hair_curve_max(&look->strays.frizz));
}

void hair_look_write_curves(const hair_look* look, struct hair_strand_look* out)
{
    write_curve(look->strand.taper, out, HAIR_CURVE_TAPER);
    write_curve(clump_of(look), out, HAIR_CURVE_CLUMP);
    write_curve(look->clump.width, out, HAIR_CURVE_CLUMP_WIDTH);
    write_curve(look->strays.tip_distance, out, HAIR_CURVE_TIP_STRAY);
    write_curve(look->strays.distance, out, HAIR_CURVE_STRAY);
    write_curve(look->strays.frizz, out, HAIR_CURVE_FRIZZ);
    write_curve(look->curl.profile, out, HAIR_CURVE_CURL);
    write_turns(look, out);
    out->tip_stray_fraction = look->strays.tip_fraction;
    out->stray_fraction = look->strays.fraction;
    HAIR_ASSERT(look->strays.frizz_wavelength > 0 && look->curl.wavelength > 0);
    out->kinks = 1 / look->strays.frizz_wavelength;
    out->drawn = look->strand.length;
    out->length_variation = look->strand.length_variation;
    out->curl_radius = look->curl.radius;
    out->curl_waves = 1 / look->curl.wavelength;
    out->curl_turns = look->curl.turns;
    out->curl_guide_phase = look->curl.guide_phase;
    out->curl_strand_phase = look->curl.strand_phase;
    out->curl_spread = look->curl.spread;
    out->curl_left_fraction = look->curl.left_fraction;
    out->curl_guide_spread = look->curl.guide_spread;
    out->curl_variation = look->curl.variation;
    out->frizz_fraction = look->strays.frizz_fraction;
    out->max_stray = hair_look_max_stray(look);
    out->max_offset = hair_look_max_offset(look);
    out->max_width = fmaxf(hair_curve_max(&look->clump.width), 1);
}

bool hair_look_is_styled(const hair_look* look)
{
    return look->strand.length < 1 || look->strand.length_variation > 0 ||
           hair_curve_max(&look->strays.frizz) > 0 ||
           look->curl.radius * hair_curve_max(&look->curl.profile) > 0;
}
