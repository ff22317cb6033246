// arcs.h - two strands that bend around the x axis towards the viewer, and their highlights.
#ifndef HAIR_TESTS_SUPPORT_ARCS_H
#define HAIR_TESTS_SUPPORT_ARCS_H

#include "tests/support/scene.h"

struct hair_test_arcs {
    struct hair_test_scene scene;
    hair_light light;
    hair_view view;
};

// Make arcs of 0.1 m, the left one in group 0 and the right one in group 1. A depth texture lets
// occlusion culling run, and hides nothing. NULL `attribute` disables attributes.
void hair_test_arcs_start(struct hair_test* test, bool is_lines, const hair_strand_attribute* attribute,
                          struct hair_test_arcs* out);
// Draw by a render path. Measure the widths of both highlights at half their height, in radians of
// the strands' direction.
void hair_test_arcs_measure(struct hair_test_arcs* arcs, hair_render_path path, double width[2]);
void hair_test_arcs_free(struct hair_test_arcs* arcs);

#endif
