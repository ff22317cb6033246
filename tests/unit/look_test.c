// look_test.c - the presets, colours and fitted curls of looks are valid, and tangents of the
// styled strands are the slopes of their positions.
#include "tests/support/support.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "lib/base/math.h"
#include "tests/reference/reference.h"

static void first_presets_are_the_defaults(void** state)
{
    (void)state;
    hair_look look = hair_look_default(), untouched = look;
    assert_int_equal(hair_look_apply_preset(&look, HAIR_LOOK_NATURAL), HAIR_OK);
    assert_int_equal(hair_look_color(&look, HAIR_COLOR_BROWN), HAIR_OK);
    assert_memory_equal(&look, &untouched, sizeof look);
}

static void shape_and_color_presets_are_independent(void** state)
{
    (void)state;
    hair_look kind[HAIR_LOOK_COUNT], color[HAIR_COLOR_COUNT];
    for (int i = 0; i < HAIR_LOOK_COUNT; ++i) {
        kind[i] = hair_look_default();
        hair_look_color(&kind[i], HAIR_COLOR_RED);
        hair_look red = kind[i];
        kind[i].followers.density = 0.5f;
        for (int again = 0; again < 2; ++again) // Independent of the previous settings.
            assert_int_equal(
                hair_look_apply_preset(&kind[i], (hair_look_preset)(again ? i : (i + 1) % HAIR_LOOK_COUNT)),
                HAIR_OK);
        assert_memory_equal(kind[i].color.root, red.color.root, sizeof red.color.root);
        assert_true(kind[i].followers.density == 0.5f && kind[i].color.spread == red.color.spread);
        for (int k = 0; k < i; ++k) assert_memory_not_equal(&kind[i], &kind[k], sizeof kind[i]);
    }
    for (int i = 0; i < HAIR_COLOR_COUNT; ++i) {
        color[i] = hair_look_default();
        color[i].curl.radius = 0.01f;
        assert_int_equal(hair_look_color(&color[i], (hair_color)i), HAIR_OK);
        assert_int_equal(hair_look_color(&color[i], (hair_color)i), HAIR_OK);
        assert_true(color[i].curl.radius == 0.01f);
        for (int k = 0; k < i; ++k) assert_memory_not_equal(&color[i], &color[k], sizeof color[i]);
    }
}

// Compute the lightness, chroma and hue in degrees of a linear colour in CIELAB, under D65.
static void find_lab(const float color[3], double* lightness, double* chroma, double* hue)
{
    // Rows of the matrix from sRGB to XYZ are divided by the white point.
    static const double to_xyz[3][3] = {
        {0.4339, 0.3762, 0.1899}, {0.2126, 0.7152, 0.0722}, {0.0177, 0.1095, 0.8728}};
    double f[3];
    for (int i = 0; i < 3; ++i) {
        double sum = 0;
        for (int k = 0; k < 3; ++k) sum += to_xyz[i][k] * (double)color[k];
        f[i] = cbrt(sum);
    }
    double a = 500 * (f[0] - f[1]), b = 200 * (f[1] - f[2]);
    *lightness = 116 * f[1] - 16, *chroma = hypot(a, b), *hue = atan2(b, a) * (180 / 3.14159265);
}

// Check that light hair has no tint of khaki, and is not as saturated as dyed hair.
static void light_colors_are_those_of_natural_hair(void** state)
{
    (void)state;
    static const struct {
        hair_color color;
        double min_lightness, max_lightness, max_chroma, min_hue, max_hue;
    } rows[] = {{HAIR_COLOR_BLOND, 50, 66, 24, 65, 77},
                {HAIR_COLOR_RED, 30, 45, 38, 50, 60},
                {HAIR_COLOR_WHITE, 75, 85, 10, 70, 100}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; ++i) {
        hair_look look = hair_look_default();
        assert_int_equal(hair_look_color(&look, rows[i].color), HAIR_OK);
        for (int end = 0; end < 2; ++end) {
            double lightness, chroma, hue;
            find_lab(end ? look.color.tip : look.color.root, &lightness, &chroma, &hue);
            assert_true(lightness >= rows[i].min_lightness && lightness <= rows[i].max_lightness);
            assert_true(chroma <= rows[i].max_chroma && hue >= rows[i].min_hue && hue <= rows[i].max_hue);
        }
    }
}

// Compute the reflectance of dense hair of an absorption per radius (Chiang et al. 2016, eq. 9).
static double find_reflectance(double absorption, double b)
{
    double d = 5.969 - 0.215 * b + 2.532 * b * b - 10.73 * pow(b, 3) + 5.574 * pow(b, 4) + 0.245 * pow(b, 5);
    return exp(-d * sqrt(absorption));
}

static void pigment_and_dye_absorb_together(void** state)
{
    (void)state;
    static const double eumelanin[3] = {0.419, 0.697, 1.37}, pheomelanin[3] = {0.187, 0.4, 1.05};
    hair_look look = hair_look_default();
    look.pigment.weight = 0.75f, look.pigment.eumelanin = 0.3f, look.pigment.pheomelanin = 0.6f;
    look.pigment.tip_fraction = 0.25f, look.pigment.dye[1] = 0.4f, look.pigment.dye[2] = 0;
    look.shading.roughness[1] = 0.55f;
    float root[3], tip[3];
    assert_int_equal(hair_look_find_colors(&look, root, tip), HAIR_OK);
    for (int k = 0; k < 3; ++k) {
        double melanin = 0.3 * eumelanin[k] + 0.6 * pheomelanin[k], dye = k == 0 ? 1 : k == 1 ? 0.4 : 0.001;
        double d = -log(find_reflectance(1, 0.55)), dyed = pow(log(dye) / d, 2);
        double at_root = find_reflectance(melanin + dyed, 0.55),
               at_tip = find_reflectance(0.25 * melanin + dyed, 0.55);
        hair_test_near("root", (size_t)k, root[k], 0.25 * look.color.root[k] + 0.75 * at_root, 1e-6);
        hair_test_near("tip", (size_t)k, tip[k], 0.25 * look.color.tip[k] + 0.75 * at_tip, 1e-6);
    }
    assert_int_equal(hair_look_color(&look, HAIR_COLOR_BLOND), HAIR_OK); // A preset has no pigment.
    assert_int_equal(hair_look_find_colors(&look, root, tip), HAIR_OK);
    assert_memory_equal(root, look.color.root, sizeof root);
    assert_memory_equal(tip, look.color.tip, sizeof tip);
    assert_int_equal(hair_look_find_colors(NULL, root, tip), HAIR_ERROR_ARGUMENT);
    assert_int_equal(hair_look_find_colors(&look, NULL, tip), HAIR_ERROR_ARGUMENT);
    look.pigment.dye[0] = 1.5f;
    assert_int_equal(hair_look_find_colors(&look, root, tip), HAIR_ERROR_ARGUMENT);
}

// Check that more eumelanin makes darker hair, that tips are lighter than roots, and that
// pheomelanin makes hair redder.
static void pigment_goes_from_blond_to_black(void** state)
{
    (void)state;
    static const float amounts[] = {0.1f, 0.3f, 1.3f, 8};
    double last = 100, hue_of[2];
    for (size_t i = 0; i < sizeof amounts / sizeof *amounts; ++i) {
        double lightness, chroma, hue;
        float root[3], tip[3];
        hair_look look = hair_look_default();
        look.pigment.weight = 1, look.pigment.eumelanin = amounts[i], look.pigment.pheomelanin = 0;
        assert_int_equal(hair_look_find_colors(&look, root, tip), HAIR_OK);
        find_lab(root, &lightness, &chroma, &hue);
        assert_true(lightness < last - 8 && root[0] > root[1] && root[1] > root[2]);
        for (int k = 0; k < 3; ++k) assert_true(tip[k] > root[k]);
        last = lightness;
    }
    assert_true(last < 12);
    for (int red = 0; red < 2; ++red) { // Pheomelanin absorbs more of the blue, and makes hair red.
        double lightness, chroma;
        float root[3], tip[3];
        hair_look look = hair_look_default();
        look.pigment.weight = 1, look.pigment.eumelanin = red ? 0.1f : 0.8f;
        look.pigment.pheomelanin = red ? 1.2f : 0;
        assert_int_equal(hair_look_find_colors(&look, root, tip), HAIR_OK);
        find_lab(root, &lightness, &chroma, &hue_of[red]);
    }
    assert_true(hue_of[1] < hue_of[0] && hue_of[1] > 30);
}

static void presets_have_distinct_names(void** state)
{
    (void)state;
    for (int i = 0; i < HAIR_LOOK_COUNT; ++i)
        for (int k = 0; k < i; ++k)
            assert_string_not_equal(hair_look_name((hair_look_preset)i), hair_look_name((hair_look_preset)k));
    for (int i = 0; i < HAIR_COLOR_COUNT; ++i)
        for (int k = 0; k < i; ++k)
            assert_string_not_equal(hair_color_name((hair_color)i), hair_color_name((hair_color)k));
    assert_null(hair_look_name(HAIR_LOOK_COUNT));
    assert_null(hair_color_name(HAIR_COLOR_COUNT));
}

// Make a turn of a helix about an oblique axis.
static void make_helix(float* positions, uint32_t vertices, double radius, double height)
{
    for (uint32_t i = 0; i < vertices; ++i) {
        double t = (double)i / (vertices - 1), x = radius * cos(6.283185307179586 * t),
               y = radius * sin(6.283185307179586 * t), z = height * t;
        positions[3 * i + 0] = (float)(3 + 0.36 * x - 0.8 * y + 0.48 * z);
        positions[3 * i + 1] = (float)(1 + 0.48 * x + 0.6 * y + 0.64 * z);
        positions[3 * i + 2] = (float)(2 - 0.8 * x + 0.6 * z);
    }
}

static void fit_curl_recognizes_a_helix(void** state)
{
    (void)state;
    static float positions[3 * 200];
    hair_look look = hair_look_default();
    make_helix(positions, 200, 0.007, 0.04);
    assert_int_equal(hair_look_fit_curl(&look, positions, 200), HAIR_OK);
    assert_int_equal(look.curl.shape, HAIR_CURL_SHAPE_EXAMPLE);
    hair_test_near("radius", 0, look.curl.radius, 0.007, 2e-5);
    hair_test_near("wavelength", 0, look.curl.wavelength, 0.04, 1e-6);
    double start = atan2((double)look.curl.profile_z[0], (double)look.curl.profile_x[0]), hand = 0;
    for (int i = 0; i < 16; ++i) {
        double angle = atan2((double)look.curl.profile_z[i], (double)look.curl.profile_x[i]) - start;
        if (i == 1) hand = sin(angle) > 0 ? 1 : -1;
        hair_test_near("radius", i, hypot((double)look.curl.profile_x[i], (double)look.curl.profile_z[i]), 1,
                       0.003);
        hair_test_near("angle", i, cos(hand * angle - 6.283185307179586 * i / 16), 1, 1e-4);
    }
}

static void fit_curl_refuses_invalid_examples(void** state)
{
    (void)state;
    static float positions[3 * 70000];
    hair_look look = hair_look_default(), untouched = look;
    make_helix(positions, 70000, 0.007, 0.04);
    assert_int_equal(hair_look_fit_curl(NULL, positions, 20), HAIR_ERROR_ARGUMENT);
    assert_int_equal(hair_look_fit_curl(&look, NULL, 20), HAIR_ERROR_ARGUMENT);
    assert_int_equal(hair_look_fit_curl(&look, positions, 2), HAIR_ERROR_ARGUMENT);
    assert_int_equal(hair_look_fit_curl(&look, positions, 70000), HAIR_ERROR_ARGUMENT);
    make_helix(positions, 30, 0.007, 0.0001); // The turn is almost closed.
    assert_int_equal(hair_look_fit_curl(&look, positions, 30), HAIR_ERROR_ARGUMENT);
    make_helix(positions, 30, 0.2, 0.04);
    assert_int_equal(hair_look_fit_curl(&look, positions, 30), HAIR_ERROR_ARGUMENT);
    static const float wrong[] = {NAN, INFINITY, -INFINITY, 1e30f};
    for (int i = 0; i < 4; ++i) {
        make_helix(positions, 30, 0.007, 0.04);
        positions[40] = wrong[i];
        assert_int_equal(hair_look_fit_curl(&look, positions, 30), HAIR_ERROR_ARGUMENT);
    }
    assert_memory_equal(&look, &untouched, sizeof look);
    // The strand is straight. It has no curl, and the result is finite.
    make_helix(positions, 30, 0, 0.04);
    assert_int_equal(hair_look_fit_curl(&look, positions, 30), HAIR_OK);
    assert_true(look.curl.radius < 1e-6f);
    // The strand has no length.
    for (int i = 0; i < 30; ++i) memcpy(positions + 3 * i, positions, 12);
    assert_int_equal(hair_look_fit_curl(&look, positions, 30), HAIR_ERROR_ARGUMENT);
    assert_int_equal(hair_look_apply_preset(&look, HAIR_LOOK_COUNT), HAIR_ERROR_ARGUMENT);
    assert_int_equal(hair_look_apply_preset(NULL, HAIR_LOOK_CURLY), HAIR_ERROR_ARGUMENT);
    assert_int_equal(hair_look_color(&look, HAIR_COLOR_COUNT), HAIR_ERROR_ARGUMENT);
    memset(&look, 0, sizeof look); // The default function did not make this look.
    assert_int_equal(hair_look_apply_preset(&look, HAIR_LOOK_CURLY), HAIR_ERROR_VERSION);
    assert_int_equal(hair_look_color(&look, HAIR_COLOR_RED), HAIR_ERROR_VERSION);
}

// Make three guides on circles of their own, with 64 samples each.
#define SAMPLES 64
static void make_guides(struct hair_reference_sample* samples, double bend)
{
    static const double root[3][3] = {{0, 0, 0}, {0.02, 0, 0}, {0, 0, 0.03}};
    for (int g = 0; g < 3; ++g)
        for (int k = 0; k < SAMPLES; ++k) {
            struct hair_reference_sample* sample = &samples[g * SAMPLES + k];
            double length = 0.2 + 0.03 * g, s = length * k / (SAMPLES - 1);
            double curve = bend * (1 + 0.2 * g), angle = curve * s, c = cos(angle / 2), half = sin(angle / 2);
            *sample = (struct hair_reference_sample){.to_root = s, .tangent = {sin(angle), cos(angle), 0}};
            sample->position[0] = root[g][0] + (curve > 0 ? (1 - cos(angle)) / curve : 0);
            sample->position[1] = root[g][1] + (curve > 0 ? sin(angle) / curve : s);
            sample->position[2] = root[g][2];
            sample->frame[2] = -half, sample->frame[3] = c;
        }
}

// Return the maximum angle between a tangent and the difference of positions around it.
static double worst_tangent(hair_look look, double bend, double step)
{
    static struct hair_reference_sample samples[3 * SAMPLES];
    double worst = 0;
    make_guides(samples, bend);
    for (uint32_t seed = 0; seed < 40; ++seed)
        for (double t = 0.011; t < 0.98; t += 0.0173) {
            struct hair_follower follower = {.guide1 = 1,
                                             .guide2 = 2,
                                             .seed = hair_hash(seed),
                                             .weight1 = 0.3f,
                                             .weight2 = 0.3f,
                                             .length_ratio = 0.9f,
                                             .multi = 1,
                                             .offset = {{0.004f, 0, 0.005f, 1},
                                                        {0.004f, 0, 0.001f, 0.001f},
                                                        {0.001f, 0, 0.002f, 0},
                                                        {0, 0, 0.001f, 0.002f}}};
            struct hair_reference_point before, at, after;
            hair_reference_follower(&follower, &look, SAMPLES, samples, t - step, NULL, &before);
            hair_reference_follower(&follower, &look, SAMPLES, samples, t, NULL, &at);
            hair_reference_follower(&follower, &look, SAMPLES, samples, t + step, NULL, &after);
            double way[3], length = 0, along = 0;
            for (int i = 0; i < 3; ++i) way[i] = after.position[i] - before.position[i];
            for (int i = 0; i < 3; ++i) length += way[i] * way[i], along += way[i] * at.tangent[i];
            worst = fmax(worst, acos(fmin(along / sqrt(length), 1)));
        }
    return worst;
}

static void tangents_are_derivatives_of_positions(void** state)
{
    (void)state;
    for (int kind = 0; kind < HAIR_LOOK_COUNT; ++kind)
        for (int mode = 0; mode <= HAIR_INTERPOLATION_MULTI; ++mode) {
            hair_look look = hair_look_default();
            assert_int_equal(hair_look_apply_preset(&look, (hair_look_preset)kind), HAIR_OK);
            look.clump.interpolation = (hair_interpolation)mode;
            double straight = worst_tangent(look, 0, 1e-6), bent = worst_tangent(look, 10, 1e-6);
            print_message("    %s %d: %.2g rad, with bent guides %.2g\n",
                          hair_look_name((hair_look_preset)kind), mode, straight, bent);
            assert_true(straight < 1e-3);
            // Positions are linear between samples of a guide, and tangents are not. The angle is
            // half of 10 rad/m times 3.5 mm.
            assert_true(bent < 0.05);
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(first_presets_are_the_defaults),
        cmocka_unit_test(shape_and_color_presets_are_independent),
        cmocka_unit_test(light_colors_are_those_of_natural_hair),
        cmocka_unit_test(pigment_and_dye_absorb_together),
        cmocka_unit_test(pigment_goes_from_blond_to_black),
        cmocka_unit_test(presets_have_distinct_names),
        cmocka_unit_test(fit_curl_recognizes_a_helix),
        cmocka_unit_test(fit_curl_refuses_invalid_examples),
        cmocka_unit_test(tangents_are_derivatives_of_positions),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
