// gusts_test.c - the texture of gusts: spectrum, standard deviation, zero divergence, and seed.
#include "tests/support/support.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "lib/base/math.h"
#include "lib/wind/gusts.h"

#define N HAIR_GUST_NODES
#define PI 3.14159265358979323846

static float* make(struct hair_test_host* host, uint32_t seed)
{
    float* gusts = hair_gusts_make(&host->host, seed);
    assert_non_null(gusts);
    return gusts;
}

static double at(const float* gusts, int x, int y, int z, int c)
{
    return (double)gusts[4 * (((z + N) % N * N + (y + N) % N) * N + (x + N) % N) + c];
}

static double between(const float* gusts, const double place[3], int c)
{
    int low[3];
    double part[3], sum = 0;
    for (int k = 0; k < 3; ++k) low[k] = (int)floor(place[k]), part[k] = place[k] - low[k];
    for (int i = 0; i < 8; ++i) {
        double weight = 1;
        for (int k = 0; k < 3; ++k) weight *= i >> k & 1 ? part[k] : 1 - part[k];
        sum += weight * at(gusts, low[0] + (i & 1), low[1] + (i >> 1 & 1), low[2] + (i >> 2), c);
    }
    return sum;
}

static void gust_texture_has_a_standard_deviation_of_1(void** state)
{
    struct hair_test_host* host = *state;
    float* gusts = make(host, 1);
    uint32_t random = 5;
    double square[3] = {0, 0, 0}, mean[3] = {0, 0, 0}, all = 0;
    for (int i = 0; i < 100000; ++i) {
        double place[3];
        for (int k = 0; k < 3; ++k) place[k] = N * (double)hair_random(&random);
        for (int c = 0; c < 3; ++c) {
            double u = between(gusts, place, c);
            square[c] += u * u / 100000, mean[c] += u / 100000;
        }
    }
    for (int c = 0; c < 3; ++c) {
        print_message("    component %d: %.3f, mean %.3g\n", c, sqrt(square[c]), mean[c]);
        assert_true(fabs(sqrt(square[c]) - 1) < 0.15 && fabs(mean[c]) < 0.02);
        all += square[c] / 3;
    }
    assert_true(fabs(sqrt(all) - 1) < 0.01);
    hair_free(&host->host, gusts);
}

// Check the divergence. `slope` is the spectral derivative along an axis.
static void gust_texture_is_free_of_divergence(void** state)
{
    struct hair_test_host* host = *state;
    float* gusts = make(host, 1);
    double slope[N], divergence = 0, size = 0;
    for (int k = 1; k < N; ++k) slope[k] = (k % 2 ? -0.5 : 0.5) / tan(k * PI / N);
    for (int i = 0; i < N * N * N; ++i) {
        int x = i % N, y = i / N % N, z = i / N / N;
        double by[3] = {0, 0, 0};
        for (int k = 1; k < N; ++k) {
            by[0] += slope[k] * at(gusts, x - k, y, z, 0);
            by[1] += slope[k] * at(gusts, x, y - k, z, 1);
            by[2] += slope[k] * at(gusts, x, y, z - k, 2);
        }
        divergence += (by[0] + by[1] + by[2]) * (by[0] + by[1] + by[2]);
        size += by[0] * by[0] + by[1] * by[1] + by[2] * by[2];
    }
    print_message("    divergence %.2g of the slopes\n", sqrt(divergence / size));
    assert_true(divergence < 1e-8 * size);
    hair_free(&host->host, gusts);
}

// Check the spectrum along x of the x component: F(k) ~ (1 + (k l)^2)^(-5/6), with wave number k
// and length scale l. Waves so short that the texture lacks others of similar length are left out.
static void gust_texture_has_von_karmans_spectrum(void** state)
{
    struct hair_test_host* host = *state;
    double power[7] = {0}, scale = 0;
    for (uint32_t seed = 1; seed <= 4; ++seed) {
        float* gusts = make(host, seed);
        for (int line = 0; line < N * N; ++line)
            for (int n = 1; n <= 6; ++n) {
                double re = 0, im = 0;
                for (int x = 0; x < N; ++x) {
                    double u = at(gusts, x, line % N, line / N, 0);
                    re += u * cos(2 * PI * n * x / N), im += u * sin(2 * PI * n * x / N);
                }
                power[n] += re * re + im * im;
            }
        hair_free(&host->host, gusts);
    }
    for (int n = 1; n <= 6; ++n) {
        double kl = 2 * PI * n / (HAIR_GUST_LENGTHS * 0.7468);
        power[n] *= pow(1 + kl * kl, 5.0 / 6);
        scale += power[n] / 6;
    }
    for (int n = 1; n <= 6; ++n) {
        print_message("    wave %d: %.3f of the formula\n", n, power[n] / scale);
        assert_true(fabs(power[n] / scale - 1) < 0.2);
    }
}

static void gust_texture_depends_only_on_its_seed(void** state)
{
    struct hair_test_host* host = *state;
    float *a = make(host, 3), *b = make(host, 3), *c = make(host, 4);
    size_t size = 4 * (size_t)N * N * N * sizeof *a;
    assert_memory_equal(a, b, size);
    assert_true(memcmp(a, c, size) != 0);
    hair_free(&host->host, a);
    hair_free(&host->host, b);
    hair_free(&host->host, c);
}

static int start(void** state)
{
    static struct hair_test_host host;
    hair_test_host_init(&host);
    *state = &host;
    return 0;
}

static int finish(void** state)
{
    return (int)((struct hair_test_host*)*state)->blocks;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(gust_texture_has_a_standard_deviation_of_1, start, finish),
        cmocka_unit_test_setup_teardown(gust_texture_is_free_of_divergence, start, finish),
        cmocka_unit_test_setup_teardown(gust_texture_has_von_karmans_spectrum, start, finish),
        cmocka_unit_test_setup_teardown(gust_texture_depends_only_on_its_seed, start, finish),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
