// furry.h - fur on a scalp with attributes of strands.
#ifndef HAIR_TESTS_SUPPORT_FURRY_H
#define HAIR_TESTS_SUPPORT_FURRY_H

#include "tests/support/grooms.h"

#define HAIR_TEST_FURRY_STRANDS 300
#define HAIR_TEST_FURRY_CELLS 8
#define HAIR_TEST_FURRY_VERTICES ((HAIR_TEST_FURRY_CELLS + 1) * (HAIR_TEST_FURRY_CELLS + 1))

// Fur on a scalp of 1 m, with two attributes of the same kind, one of strands and one map.
struct hair_test_furry {
    struct hair_test_strands strands;
    struct hair_test_scalp scalp;
    hair_groom_desc desc;
    hair_strand_attribute attributes[2];
    float of_strands[HAIR_TEST_FURRY_STRANDS], of_vertices[HAIR_TEST_FURRY_VERTICES],
        of_triangles[2 * HAIR_TEST_FURRY_CELLS * HAIR_TEST_FURRY_CELLS], uvs[2 * HAIR_TEST_FURRY_VERTICES];
};

// Make the fur, for which `desc` creates a groom with attributes of a kind.
void hair_test_furry_make(struct hair_test_host* host, hair_strand_attribute_kind kind,
                          struct hair_test_furry* furry);
void hair_test_furry_free(struct hair_test_furry* furry);

#endif
