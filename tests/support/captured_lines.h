// captured_lines.h - the vertices of lines that the library draws.
#ifndef HAIR_TESTS_SUPPORT_CAPTURED_LINES_H
#define HAIR_TESTS_SUPPORT_CAPTURED_LINES_H

#include "tests/support/render_paths.h"
#include "tests/support/support.h"

#define HAIR_TEST_CAPTURED_PATHS 3 // The first paths in hair_test_paths draw lines by vertices.

struct hair_test_vertex {
    float x, y, z, radius; // The output strand_position of strand.tese.
};

struct hair_test_lines {
    struct hair_test_vertex* vertices; // Two per segment, in drawing order.
    size_t segments;
    uint64_t generated, draws;
};

// Return a look without taper. The radius of a follower then identifies it (grooms.c).
hair_look hair_test_even_look(uint32_t segments);

// Draw lines by hair_draw, and return the captured vertices instead of pixels. `hits` is 1 if
// colliders are in reach. `lod` may be NULL. The caller frees the vertices.
struct hair_test_lines hair_test_capture_lines(struct hair_test* test, hair_instance* hair, size_t path,
                                               size_t max_segments, int hits, const hair_lod* lod);

// Sort strands by follower. Tessellators draw the isolines of a patch in any order, and orders
// differ between GPUs and llvmpipe.
void hair_test_sort_lines(struct hair_test_lines* lines);

#endif
