// beams.h - three beams whose frequencies are measured, and the swings of other guides.
#ifndef HAIR_TESTS_SUPPORT_BEAMS_H
#define HAIR_TESTS_SUPPORT_BEAMS_H

#include "tests/support/live_hair.h"

#define HAIR_TEST_BEAMS 3
#define HAIR_TEST_BEAM_STEP (1.0 / 240) // s

// Return vertical beams of 3 cm, 0.1 m apart along x from the origin, with groups.
struct hair_test_strands hair_test_beams(const uint8_t groups[HAIR_TEST_BEAMS]);
// Return physics without gravity, damping, a shape frequency and sleep.
hair_physics hair_test_without_forces(void);
// Move the head by a millimetre at once. Measure at which frequencies the tips swing about rest.
void hair_test_measure_frequencies(struct hair_test_living* living, double hz[HAIR_TEST_BEAMS]);

// Swing the head for half a second, and read the guides.
void hair_test_swing(struct hair_test_living* living);

#endif
