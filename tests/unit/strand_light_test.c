// strand_light_test.c - light past strands of a grating, which transmits the fraction that it
// leaves open.
#include "tests/support/support.h"

#include <math.h>

#include "tools/bench/strand_light.c"

#define BARS 400
#define EACH 11

// Fill in bars along x, 1 mm apart and 20 cm long, 5 cm above a strand across them. The light is
// from above.
static void fill(float* positions)
{
    for (int n = 0; n <= BARS; ++n)
        for (int k = 0; k < EACH; ++k) {
            float* p = positions + 3 * (n * EACH + k);
            float t = (float)k / (EACH - 1) - 0.5f;
            p[0] = n < BARS ? 0.2f * t : 0;
            p[1] = n < BARS ? 0.05f : 0;
            p[2] = n < BARS ? 0.001f * ((float)n - BARS / 2) : 0.3f * t;
        }
}

static struct bench_strands make(float radius)
{
    static float positions[3 * (BARS + 1) * EACH];
    static const float up[3] = {1e-3f, 1, 1e-3f};
    struct bench_strands strands;
    fill(positions);
    assert_true(bench_strands_make(positions, BARS + 1, EACH, radius, up, &strands));
    return strands;
}

static void rays_hit_the_covered_fraction_of_a_grating(void** state)
{
    (void)state;
    static const float radii[] = {5e-5f, 1.5e-4f, 3e-4f};
    static float light[(BARS + 1) * EACH];
    for (int i = 0; i < 3; ++i) {
        struct bench_strands strands = make(radii[i]);
        assert_true(bench_light_by_rays(&strands, 1024, 1, light));
        for (int k = 1; k < EACH - 1; ++k)
            hair_test_near("fraction", (size_t)k, (double)light[BARS * EACH + k], 1 - 2000 * (double)radii[i],
                           0.02);
        for (int k = 0; k < EACH; ++k)
            hair_test_near("a bar", (size_t)k, (double)light[EACH * 200 + k], 1, 0);
        bench_strands_free(&strands);
    }
}

// Check layers. They have no positions within a texel, so strands are independent of each other.
static void random_layers_hit_the_expected_strand_count(void** state)
{
    (void)state;
    static float light[(BARS + 1) * EACH];
    struct bench_strands strands = make(1.5e-4f);
    assert_true(bench_light_by_layers(&strands, 0.002f, 4, 0.02f, 2, light));
    for (int k = 1; k < EACH - 1; ++k)
        hair_test_near("through layers", (size_t)k, (double)light[BARS * EACH + k], exp(-0.3), 0.08);
    bench_strands_free(&strands);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rays_hit_the_covered_fraction_of_a_grating),
        cmocka_unit_test(random_layers_hit_the_expected_strand_count),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
