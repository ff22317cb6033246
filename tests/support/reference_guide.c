// reference_guide.c - a guide of the reference, and checks of its points.
#include "tests/support/reference_guide.h"

#include <math.h>

struct hair_reference_guide hair_test_guide_whole(const struct hair_test_guide* f)
{
    return (struct hair_reference_guide){&f->guide, f->rest, &f->params};
}

struct hair_test_guide hair_test_guide_straight_down(uint32_t count, float link)
{
    struct hair_test_guide f = {// The root frame is half a turn about x, so y points down.
                                .guide = {.root_frame = {1, 0, 0, 0}, .count = count}};
    for (uint32_t i = 0; i < count; ++i) {
        f.rest[i].position = (hair_vec4){0, -link * (float)i, 0, i + 1 < count ? link : 0};
        f.state[i].position[1] = (double)(-link * (float)i);
    }
    f.params.keep = 1;
    f.params.iterations = 1;
    f.params.substeps = 1;
    f.params.guides = 1;
    f.params.gravity.w = 0.01f;
    f.params.rotation_before = f.params.rotation_after = f.params.rotation_now = (hair_vec4){0, 0, 0, 1};
    for (int i = 0; i < HAIR_STEP_SUBSTEPS; ++i)
        f.params.substep[i] = (struct hair_substep){{0, 0, 0, 1}, {0, 0, 0, (float)(i + 1)}};
    return f;
}

double hair_test_distance3(const double* a, const double* b)
{
    return sqrt((a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]) +
                (a[2] - b[2]) * (a[2] - b[2]));
}

void hair_test_near3(const char* what, const double* a, double x, double y, double z, double tolerance)
{
    hair_test_near(what, 0, a[0], x, tolerance);
    hair_test_near(what, 1, a[1], y, tolerance);
    hair_test_near(what, 2, a[2], z, tolerance);
}
