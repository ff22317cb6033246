// paths_test.c - path tracing of light among fibres agrees with known results.
#include "tests/support/support.h"

#include <math.h>
#include <stdlib.h>

#include "lib/light/fibre.h"
#include "tests/reference/paths.h"

#define STRANDS 400
#define RAYS 20000

static const struct hair_fibre usual = {0.3f, 0.3f, 1.55f, 1};

static float fraction(void)
{
    return (float)(rand() % 100000) / 1e5f;
}

static struct hair_reference_fibre fibre_of(const struct hair_fibre* of, double tilt, hair_fibre_table table)
{
    float variance[3];
    hair_fibre_fill(of, table);
    hair_fibre_variances(of->along, variance);
    return (struct hair_reference_fibre){&table[0][0][0], (double)variance[0], tilt};
}

// Fill a box of 0.1 m with straight strands in random directions.
static void fill(float* positions)
{
    for (int i = 0; i < 6 * STRANDS; ++i) positions[i] = 0.1f * fraction();
}

// Make rays along -z onto the box from above.
static void look_down(double* from, double* way, int rays)
{
    for (int i = 0; i < 3 * rays; ++i) {
        from[i] = i % 3 == 2 ? 1 : 0.01 + 0.08 * (double)fraction();
        way[i] = i % 3 == 2 ? -1 : 0;
    }
}

static void white_strands_are_invisible_in_a_white_furnace(void** state)
{
    (void)state;
    static hair_fibre_table table;
    static float positions[6 * STRANDS];
    static double from[3 * RAYS], way[3 * RAYS];
    static const double mu[1] = {0};
    static const float radii[] = {2e-4f, 8e-4f};
    static struct hair_reference_glow glow;
    fill(positions);
    look_down(from, way, RAYS);
    for (int i = 0; i < 2; ++i) {
        struct hair_reference_hair hair = {.positions = positions,
                                           .count = STRANDS,
                                           .each = 2,
                                           .radius = (double)radii[i],
                                           .fibre = fibre_of(&usual, 0, table),
                                           .mu = mu,
                                           .colors = 1,
                                           .sky = 1};
        hair_reference_paths(&hair, from, way, RAYS, 1, &glow);
        print_message("    radius %g: of %u rays %.4f, give or take %.4f\n", (double)radii[i],
                      (unsigned)glow.met, glow.often[0][0], glow.error[0][0]);
        hair_test_near("radiance", (size_t)i, glow.often[0][0], 1, 0.005);
    }
}

static void lone_strand_scatters_like_one_fibre(void** state)
{
    (void)state;
    static hair_fibre_table table;
    static const float positions[] = {0.05f, -1, 0, 0.05f, 1, 0};
    static const double mu[3] = {0.1, 0.3, 2}, tangent[3] = {0, 1, 0}, eye[3] = {0, 0, 1};
    static const double light[6] = {0.48, 0.64, 0.6, 0, -0.6, -0.8};
    static double from[3 * RAYS], way[3 * RAYS];
    static struct hair_reference_glow glow;
    struct hair_reference_hair hair = {.positions = positions,
                                       .count = 1,
                                       .each = 2,
                                       .radius = 0.01,
                                       .fibre = fibre_of(&usual, 0.05, table),
                                       .mu = mu,
                                       .colors = 3,
                                       .to_light = light,
                                       .lights = 2};
    look_down(from, way, RAYS);
    hair_reference_paths(&hair, from, way, RAYS, 1, &glow);
    hair_test_near("fraction of rays", 0, (double)glow.met / RAYS, 0.25, 0.02); // 2 cm of 8.
    for (int l = 0; l < 2; ++l) {
        double expected[3], cosine = sqrt(1 - light[3 * l + 1] * light[3 * l + 1]);
        hair_reference_scatter(&hair.fibre, tangent, light + 3 * l, eye, mu, 3, expected);
        for (int i = 0; i < 3; ++i) {
            hair_test_near("radiance", (size_t)i, glow.often[l][i], cosine * expected[i], 1e-9);
            hair_test_near("once", (size_t)i, glow.once[l][i], cosine * expected[i], 1e-9);
        }
    }
}

// Check the density of sampled directions. Any density gives the right mean if directions are
// sampled by it. The mean of 1 / density is the area of the unit sphere, and the mean of scattered
// light agrees with the furnace test.
static void sampled_directions_have_the_stated_density(void** state)
{
    (void)state;
    static hair_fibre_table table;
    static const double tilts[] = {0, 0.05, 0.3}, tangent[3] = {0, 1, 0}, none[1] = {0};
    const double pi = 3.14159265358979;
    for (int t = 0; t < 3; ++t) {
        struct hair_fibre rough = {0.6f, 0.6f, 1.55f, 1};
        struct hair_reference_fibre fibre = fibre_of(&rough, tilts[t], table);
        for (int e = 0; e < 4; ++e) {
            const double eye[3] = {cos(0.35 * e), sin(0.35 * e), 0};
            double chosen = 0, even = 0;
            int count = 20000;
            for (int i = 0; i < count; ++i) {
                double random[3], light[3], scattered, phi = 2 * pi * (double)fraction(),
                                                       y = 2 * (double)fraction() - 1;
                for (int k = 0; k < 3; ++k) random[k] = (double)fraction();
                double density = hair_reference_choose(&fibre, tangent, eye, random, light);
                hair_reference_scatter(&fibre, tangent, light, eye, none, 1, &scattered);
                chosen += scattered * sqrt(1 - light[1] * light[1]) / density / count;
                const double any[3] = {sqrt(1 - y * y) * cos(phi), y, sqrt(1 - y * y) * sin(phi)};
                hair_reference_scatter(&fibre, tangent, any, eye, none, 1, &scattered);
                even += scattered * sqrt(1 - y * y) * 4 * pi / count;
            }
            print_message("    tilt %g, eye at %g: %.4f, of even directions %.4f\n", tilts[t], 0.35 * e,
                          chosen, even);
            hair_test_near("light", (size_t)(4 * t + e), chosen, even, 0.05);
            if (tilts[t] <= 0) hair_test_near("furnace", (size_t)e, chosen, 1, 0.01);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(white_strands_are_invisible_in_a_white_furnace),
        cmocka_unit_test(lone_strand_scatters_like_one_fibre),
        cmocka_unit_test(sampled_directions_have_the_stated_density),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
