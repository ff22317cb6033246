// cut_scene.h - hair to cut: two guides, and a square of hanging hair whose drawn strands are read.
#ifndef HAIR_TESTS_SUPPORT_CUT_SCENE_H
#define HAIR_TESTS_SUPPORT_CUT_SCENE_H

#include "tests/support/live_hair.h"
#include "tests/support/scene.h"

#define HAIR_TEST_CUT_CURL 2 // Guides of hair_test_cut_live().
#define HAIR_TEST_CUT_ROW 4 // Guides of a row. There are as many rows.
#define HAIR_TEST_CUT_GUIDES (HAIR_TEST_CUT_ROW * HAIR_TEST_CUT_ROW)
#define HAIR_TEST_CUT_HEIGHT 1.7f // Height of the roots, m.
#define HAIR_TEST_CUT_LENGTH 0.3f // Length of the guides, m.

// Make a straight guide and a curl, which a solver and mapping of ways.h moves.
void hair_test_cut_live(struct hair_test* test, int way, struct hair_test_living* out);
// Step from one frame of 1/60 s to another, while the head shakes.
void hair_test_cut_shake(struct hair_test_living* living, int from, int to);
void hair_test_cut_lengths(struct hair_test_living* living, float straight, float curl);

// All drawn strands at one time.
struct hair_test_drawn {
    float* positions;
    uint32_t count, vertices; // Number of strands, and of the vertices of each.
};

// Return a square of hanging strands. Every second one is in group 1. Each strand has a radius and
// colours of its own. NULL selects the default look, or the head at the origin.
struct hair_test_scene hair_test_cut_scene(struct hair_test* test, hair_strand_set set, const hair_desc* desc,
                                           const hair_look* look, const float transform[16]);
// Return the same with the attributes and the scalp of a desc. NULL adds none.
struct hair_test_scene hair_test_cut_scene_with(struct hair_test* test, hair_strand_set set,
                                                const hair_desc* desc, const hair_look* look,
                                                const float transform[16], const hair_groom_desc* attributes);
// Step frames of 1/60 s in which the head swings by 5 cm.
void hair_test_cut_swing(const struct hair_test_scene* scene, int frames);

// Read the drawn strands. Free the positions.
struct hair_test_drawn hair_test_read_drawn(const struct hair_test* test, hair_instance* hair);
hair_vec3 hair_test_drawn_at(const struct hair_test_drawn* drawn, uint32_t strand, uint32_t vertex);
double hair_test_drawn_length(const struct hair_test_drawn* drawn, uint32_t strand);
double hair_test_drawn_length_of_all(const struct hair_test_drawn* drawn);

#endif
