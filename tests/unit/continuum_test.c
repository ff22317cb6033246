// continuum_test.c - solved rods and chains agree with values of books and of other programs.
#include "tests/support/support.h"

#include <math.h>

#include "tests/reference/continuum.h"

#define PI 3.141592653589793

static void elastica_equals_its_table(void** state)
{
    (void)state;
    static const double table[][4] = {
        // Columns: gamma, across, down, and down / across.
        {0.1, 0.99991073, 0.01249844, 0.01249955},  {0.3, 0.99919788, 0.03745790, 0.03748797},
        {1, 0.99124640, 0.12347140, 0.12456177},    {3, 0.93151121, 0.33964839, 0.36462083},
        {5, 0.84665718, 0.49590504, 0.58572118},    {10, 0.65635376, 0.70019972, 1.06680232},
        {30, 0.34276368, 0.87309242, 2.54721393},   {50, 0.24501476, 0.90791712, 3.70556099},
        {100, 0.15922338, 0.93752394, 5.88810462},  {300, 0.08629137, 0.96500637, 11.1831162},
        {1000, 0.04598645, 0.98114127, 21.3354405}, {3000, 0.02622497, 0.98919618, 37.7196365},
        {10000, 0.01426089, 0.99410993, 69.7088296}};
    for (size_t i = 0; i < sizeof table / sizeof *table; ++i) {
        struct hair_reference_elastica e = hair_reference_elastica(table[i][0], 0, 0);
        hair_test_near("across", i, e.across, table[i][1], 5.1e-9);
        hair_test_near("down", i, e.down, table[i][2], 5.1e-9);
        hair_test_near("ratio", i, e.down / e.across, table[i][3], 1e-8 * table[i][3] + 5.1e-9);
    }
}

static void elastica_with_a_tip_load_equals_its_table(void** state)
{
    (void)state;
    static const double table[][3] = {{1, 0.30172077, 0.94356676},
                                      {2, 0.49345748, 0.83935828},
                                      {5, 0.71379152, 0.61237164},
                                      {10, 0.81060902, 0.44500440}};
    for (size_t i = 0; i < 4; ++i) {
        struct hair_reference_elastica e = hair_reference_elastica(0, table[i][0], 0);
        hair_test_near("down", i, e.down, table[i][1], 5.1e-9);
        hair_test_near("across", i, e.across, table[i][2], 5.1e-9);
    }
}

// Check the limits: gamma / 8 for a small weight, and sqrt(gamma / 2) for a large one.
static void elastica_approaches_its_two_limits(void** state)
{
    (void)state;
    struct hair_reference_elastica light = hair_reference_elastica(1e-4, 0, 0);
    hair_test_near("light", 0, light.down / light.across, 1e-4 / 8, 1e-12);
    struct hair_reference_elastica heavy = hair_reference_elastica(1e5, 0, 0);
    hair_test_near("heavy", 0, heavy.down / heavy.across / sqrt(1e5 / 2), 1, 0.01);
}

// Check a small weight with a clamp at any angle. The tip sinks by cos^2 / 8 of the weight, and
// moves sideways accordingly.
static void a_stiff_elastica_leaves_its_clamp_straight(void** state)
{
    (void)state;
    for (int k = -7; k <= 7; ++k) {
        double angle = 0.2 * k, sinks = 1e-5 / 8 * cos(angle);
        struct hair_reference_elastica e = hair_reference_elastica(1e-5, 0, angle);
        hair_test_near("across", (size_t)(k + 7), e.across, cos(angle) - sinks * sin(angle), 1e-10);
        hair_test_near("down", (size_t)(k + 7), e.down, sin(angle) + sinks * cos(angle), 1e-10);
        hair_test_near("tip", (size_t)(k + 7), e.tip, angle + 1e-5 / 6 * cos(angle), 1e-10);
    }
}

static void critical_weights_come_from_zeros_of_bessel_functions(void** state)
{
    (void)state;
    double greenhill = hair_reference_bessel_zero(-1.0 / 3, 1);
    hair_test_near("greenhill", 0, 2.25 * greenhill * greenhill, 7.8373474389, 1e-10);
    hair_test_near("lateral", 0, 6 * hair_reference_bessel_zero(-1.0 / 6, 1), 12.85376332, 5.1e-9);
    hair_test_near("lateral, tip load", 0, 2 * hair_reference_bessel_zero(-0.25, 1), 4.01259934, 5.1e-9);
    hair_test_near("half", 0, hair_reference_bessel_zero(0.5, 5), 5 * PI, 1e-8); // J_1/2 is a sine.
}

static void hanging_chain_swings_at_bessel_frequencies(void** state)
{
    (void)state;
    static const double zeros[] = {2.4048255577, 5.5200781103, 8.6537279129};
    static const double hertz[] = {1.094328, 2.511940, 3.937923};
    static const double heavy[][4] = {{1, 1.05642248, 4.08168676, 7.73750314},
                                      {10, 1.00793371, 10.2764263, 20.4041314},
                                      {100, 1.00082912, 31.52606, 63.00445}};
    for (uint32_t n = 1; n <= 3; ++n) {
        hair_test_near("zero", n, hair_reference_bessel_zero(0, n), zeros[n - 1], 1e-10);
        hair_test_near("swing", n, hair_reference_chain_frequency(n, 0.3, 9.81, 0) / (2 * PI), hertz[n - 1],
                       5.1e-7);
        for (int k = 0; k < 3; ++k)
            hair_test_near("with a tip", n, hair_reference_chain_frequency(n, 1, 1, heavy[k][0]), heavy[k][n],
                           1e-7 * heavy[k][n]);
    }
}

// Check convergence. With half the last mass, twice the links leave a quarter of the discrete
// chain's error.
static void linkages_swing_at_the_frequencies_of_the_table(void** state)
{
    (void)state;
    static const double half[] = {3.76111581, 3.76490768, 3.76578662};
    static const double full[] = {3.70543446, 3.73620681, 3.75124771};
    double length[63], mass[63];
    for (uint32_t k = 0; k < 3; ++k) {
        uint32_t links = (16u << k) - 1;
        for (uint32_t i = 0; i < links; ++i) length[i] = mass[i] = 1.0 / links;
        hair_test_near("full", k, hair_reference_linkage_frequency(1, links, length, mass, 9.81), full[k],
                       5.1e-9);
        mass[links - 1] /= 2;
        hair_test_near("half", k, hair_reference_linkage_frequency(1, links, length, mass, 9.81), half[k],
                       5.1e-9);
    }
    double one[] = {1, 1}, first = hair_reference_linkage_frequency(1, 2, one, one, 1),
           second = hair_reference_linkage_frequency(2, 2, one, one, 1);
    hair_test_near("double pendulum", 1, first * first, 2 - sqrt(2), 1e-12);
    hair_test_near("double pendulum", 2, second * second, 2 + sqrt(2), 1e-12);
}

static void pendulum_of_large_amplitude_swings_slower(void** state)
{
    (void)state;
    static const double periods[] = {1.0174087976, 1.0731820071, 1.1803405990, 1.3728805006, 1.7622037295};
    // Gauss's constant.
    hair_test_near("agm", 0, hair_reference_agm(1, sqrt(2)), 1.198140234735592, 1e-15);
    for (int k = 0; k < 5; ++k)
        hair_test_near("period", (size_t)k, hair_reference_pendulum_period((k + 1) * PI / 6), periods[k],
                       5.1e-11);
}

static void clamped_beam_has_its_characteristic_roots(void** state)
{
    (void)state;
    static const double roots[] = {1.875104068712, 4.694091132974, 7.854757438238};
    for (uint32_t n = 1; n <= 3; ++n)
        hair_test_near("root", n, hair_reference_beam_root(n), roots[n - 1], 5.1e-13);
}

static void chain_between_pins_equals_the_catenary_table(void** state)
{
    (void)state;
    struct hair_reference_catenary near = hair_reference_catenary(0.5), far = hair_reference_catenary(0.8);
    hair_test_near("sag", 0, near.sag, 0.3981941779, 5.1e-11);
    hair_test_near("sag", 1, far.sag, 0.2654375091, 5.1e-11);
    hair_test_near("slope", 0, near.slope * 180 / PI, 77.0668, 5.1e-5);
    hair_test_near("slope", 1, far.slope * 180 / PI, 55.9254, 5.1e-5);
    hair_test_near("tension", 0, near.tension, 0.5130142855, 5.1e-11);
    hair_test_near("tension", 1, far.tension, 0.6036393882, 5.1e-11);
    hair_test_near("links", 32, hair_reference_catenary_of_links(0.5, 32).sag, 0.3985581647, 5.1e-11);
    hair_test_near("links", 64, hair_reference_catenary_of_links(0.5, 64).sag, 0.3982847188, 5.1e-11);
    struct hair_reference_catenary many = hair_reference_catenary_of_links(0.8, 20000);
    hair_test_near("many links", 0, many.sag, far.sag, 1e-8);
    hair_test_near("many links", 1, many.tension, far.tension, 1e-4);
}

// Check linkages of equal masses released from the horizontal. The values for 2 and 4 links are
// from another program.
static void falling_linkages_equal_their_table(void** state)
{
    (void)state;
    static const double tips[2][3][2] = {
        {{0.11478618, -0.27354274}, {-0.28873588, -0.06118200}, {0.25349989, -0.13947456}},
        {{0.07876279, -0.28679205}, {-0.28469660, -0.05196286}, {0.27991150, -0.07555125}}};
    static const double times[] = {0.25, 0.25, 0.5};
    for (uint32_t k = 0; k < 2; ++k) {
        uint32_t links = 2u << k;
        double length[4], mass[4], angle[4], rate[4] = {0, 0, 0, 0};
        for (uint32_t i = 0; i < links; ++i) length[i] = 0.3 / links, mass[i] = 1, angle[i] = PI / 2;
        for (int at = 0; at < 3; ++at) {
            hair_reference_linkage_advance(links, length, mass, 9.81, times[at], (uint32_t)(400 * times[at]),
                                           angle, rate);
            double x = 0, y = 0;
            for (uint32_t i = 0; i < links; ++i)
                x += length[i] * sin(angle[i]), y -= length[i] * cos(angle[i]);
            hair_test_near("x", 3 * k + (size_t)at, x, tips[k][at][0], 5.1e-9);
            hair_test_near("y", 3 * k + (size_t)at, y, tips[k][at][1], 5.1e-9);
        }
        hair_test_near("energy", links, hair_reference_linkage_energy(links, length, mass, 9.81, angle, rate),
                       0, 1e-11);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(elastica_equals_its_table),
        cmocka_unit_test(elastica_with_a_tip_load_equals_its_table),
        cmocka_unit_test(elastica_approaches_its_two_limits),
        cmocka_unit_test(a_stiff_elastica_leaves_its_clamp_straight),
        cmocka_unit_test(critical_weights_come_from_zeros_of_bessel_functions),
        cmocka_unit_test(hanging_chain_swings_at_bessel_frequencies),
        cmocka_unit_test(linkages_swing_at_the_frequencies_of_the_table),
        cmocka_unit_test(pendulum_of_large_amplitude_swings_slower),
        cmocka_unit_test(clamped_beam_has_its_characteristic_roots),
        cmocka_unit_test(chain_between_pins_equals_the_catenary_table),
        cmocka_unit_test(falling_linkages_equal_their_table),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
