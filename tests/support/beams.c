// beams.c - three beams whose frequencies are measured, and the swings of other guides.
#include "tests/support/beams.h"

#include <math.h>

#define PI 3.14159265358979
#define SAMPLES 360

// Return the frequency with the largest amplitude in samples, by Hann's window.
static double find_peak(const double* sample)
{
    double peak = 0, max = 0;
    for (double hz = 0.5; hz < 30; hz += 0.01) {
        double re = 0, im = 0;
        for (int k = 0; k < SAMPLES; ++k) {
            double weight = sample[k] * (1 - cos(2 * PI * (k + 0.5) / SAMPLES));
            re += weight * cos(2 * PI * hz * k * HAIR_TEST_BEAM_STEP);
            im += weight * sin(2 * PI * hz * k * HAIR_TEST_BEAM_STEP);
        }
        if (re * re + im * im > max) max = re * re + im * im, peak = hz;
    }
    return peak;
}

void hair_test_measure_frequencies(struct hair_test_living* living, double hz[HAIR_TEST_BEAMS])
{
    static double sample[HAIR_TEST_BEAMS][SAMPLES];
    struct hair_reference_rod_pose head = hair_test_pose_of(hair_v3(0, 0, 1e-3f), hair_v3(0, 1, 0), 0);
    for (int k = 0; k < SAMPLES; ++k) {
        hair_test_advance(living, &head, HAIR_TEST_BEAM_STEP);
        hair_test_read_guides(living);
        for (uint32_t g = 0; g < HAIR_TEST_BEAMS; ++g)
            sample[g][k] = (double)hair_test_tip(living, g).z - 1e-3;
    }
    for (uint32_t g = 0; g < HAIR_TEST_BEAMS; ++g) hz[g] = find_peak(sample[g]);
}

struct hair_test_strands hair_test_beams(const uint8_t groups[HAIR_TEST_BEAMS])
{
    struct hair_test_strands strands = hair_test_strands_make(HAIR_TEST_BEAMS, 9);
    for (int g = 0; g < HAIR_TEST_BEAMS; ++g)
        hair_test_add_straight(&strands, 9, hair_v3(0.1f * (float)g, 0, 0), hair_v3(0, -1, 0), 0.03f);
    strands.groups = groups;
    return strands;
}

hair_physics hair_test_without_forces(void)
{
    hair_physics physics = hair_physics_default();
    physics.gravity[1] = 0, physics.damping = 0;
    physics.shape.frequency_root = physics.shape.frequency_tip = 0;
    physics.sleep_threshold = 0;
    return physics;
}

void hair_test_swing(struct hair_test_living* living)
{
    for (int i = 0; i < 30; ++i) {
        struct hair_reference_rod_pose head = hair_test_pose_of(hair_v3(0.02f * sinf(0.4f * (float)i), 0, 0),
                                                                hair_v3(0, 1, 0), 0.3 * sin(0.3 * i));
        hair_test_advance(living, &head, 1.0 / 60);
    }
    hair_test_read_guides(living);
}
