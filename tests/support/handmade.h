// handmade.h - synthetic grooms, so that tests of motion and drawing know their contents.
#ifndef HAIR_TESTS_SUPPORT_HANDMADE_H
#define HAIR_TESTS_SUPPORT_HANDMADE_H

#include "lib/groom/groom.h"

struct hair_test_handmade {
    // Number of guides, with roots on a ball of radius 0.1 m around the head's origin.
    uint32_t guides;
    uint32_t fewest, max; // range of vertices per guide, used in turn
    const uint32_t* vertices; // vertices of each guide instead of the range. NULL disables.
    float segment; // mean length, m
    float turn; // maximum angle between segments, rad
    // Number of followers. Follower i has 1 + i / 65536 times the look's radius.
    uint32_t followers;
    uint32_t each; // followers per patch
    float density; // of every patch
    uint32_t seed;
};

// Return the description of a small groom. A test changes the values that it needs.
struct hair_test_handmade hair_test_handmade_default(void);

// Make a groom. Free it with hair_groom_destroy().
hair_groom* hair_test_groom(const hair_host* host, struct hair_test_handmade wanted);

// Set every guide to its rest pose, with each vertex moved by up to `away` along each axis and
// displaced by up to `moved`, m.
void hair_test_scatter(const hair_groom* groom, float away, float moved, uint32_t* random,
                       struct hair_state* state);

#endif
