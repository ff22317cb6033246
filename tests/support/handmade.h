// handmade.h - grooms made by hand, so that tests of motion and drawing know what they look at.
#ifndef HAIR_TESTS_SUPPORT_HANDMADE_H
#define HAIR_TESTS_SUPPORT_HANDMADE_H

#include "lib/groom/groom.h"

struct hair_test_handmade {
    uint32_t guides; // with roots on a ball of radius 0.1 m around the head's origin
    uint32_t fewest, most; // vertices of each, in turn
    const uint32_t* vertices; // of each guide, in place of the above. NULL: none
    float segment; // m, on average
    float turn; // rad: greatest angle between segments
    uint32_t followers; // the i-th has 1 + i / 65536 of the look's radius
    uint32_t each; // followers of a patch
    float density; // of every patch
    uint32_t seed;
};

// A small one. Change what the test is about.
struct hair_test_handmade hair_test_handmade_default(void);

// hair_groom_destroy undoes it.
hair_groom* hair_test_groom(const hair_host* host, struct hair_test_handmade wanted);

// Every guide in its rest pose, but each vertex up to `away` from it along each axis, and displaced as far as
// `moved`. m.
void hair_test_scatter(const hair_groom* groom, float away, float moved, uint32_t* random,
                       struct hair_state* state);

#endif
