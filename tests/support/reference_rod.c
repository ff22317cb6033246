#include "tests/support/reference_rod.h"

#include <math.h>
#include <string.h>

#include "tests/support/support.h"

#define PI 3.141592653589793

void hair_test_plane_make(struct hair_test_plane* p, uint32_t vertices, double angle, double gamma)
{
    p->desc = hair_reference_rod_desc_default();
    for (uint32_t i = 0; i < vertices; ++i) {
        p->lengths[i] = 1.0 / (vertices - 1);
        p->positions[3 * i] = i * p->lengths[i] * sin(angle);
        p->positions[3 * i + 1] = -(i * p->lengths[i]) * cos(angle);
        p->positions[3 * i + 2] = 0;
    }
    p->desc.vertices = vertices;
    p->desc.positions = p->positions;
    p->desc.lengths = p->lengths;
    p->desc.line_density = 1;
    p->desc.bend[0] = p->desc.bend[1] = 1;
    p->desc.twist = 1 / 1.45;
    p->desc.plain_clamp = 1;
    p->desc.gravity[1] = -gamma;
    p->desc.root_frame[2] = sin((angle - PI) / 2); // rotates y by angle - pi about z
    p->desc.root_frame[3] = cos((angle - PI) / 2);
}

void hair_test_plane_curl(struct hair_test_plane* p, double turn)
{
    double at[3] = {0, 0, 0};
    for (uint32_t i = 0; i < p->desc.vertices; ++i) {
        double angle = turn * (i + 0.5) / (p->desc.vertices - 1);
        memcpy(p->positions + 3 * i, at, sizeof at);
        at[0] += p->lengths[0] * sin(angle);
        at[1] -= p->lengths[0] * cos(angle);
    }
    hair_reference_rod_strain(p->desc.vertices, p->positions, p->desc.root_frame, p->strain);
    p->desc.rest_strain = p->strain;
}

struct hair_reference_rod* hair_test_rod(const struct hair_reference_rod_desc* desc)
{
    struct hair_reference_rod* rod = hair_reference_rod_create(desc);
    assert_non_null(rod);
    return rod;
}

void hair_test_rod_rest(struct hair_reference_rod* rod)
{
    struct hair_reference_rod_rested rested = hair_reference_rod_rest(rod);
    assert_true(rested.converged);
    assert_true(rested.residual < 1e-12);
}

void hair_test_rod_tip(const struct hair_reference_rod* rod, double tip[3])
{
    double x[3 * HAIR_TEST_MAX];
    hair_reference_rod_positions(rod, x);
    memcpy(tip, x + 3 * (hair_reference_rod_vertices(rod) - 1), 3 * sizeof *tip);
}

double hair_test_extrapolate(double coarse, double fine)
{
    return fine + (fine - coarse) / 3;
}
