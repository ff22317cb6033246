// fluid_test.c - each pass of the fluid agrees with its reference in double precision.
#include "tests/support/fluids.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "lib/base/math.h"
#include "tests/reference/fluid.h"

#define CELLS 16

static uint32_t cubed(uint32_t n)
{
    return n * n * n;
}

static double* any_numbers(size_t count, double max, uint32_t seed)
{
    double* out = malloc(count * sizeof *out);
    for (size_t i = 0; i < count; ++i) out[i] = (double)(float)(max * 2 * ((double)hair_random(&seed) - 0.5));
    return out;
}

static void check(const char* what, const double* got, const double* expected, size_t count, double tolerance)
{
    for (size_t i = 0; i < count; ++i) hair_test_near(what, i, got[i], expected[i], tolerance);
}

// Check that faces are between `min` and `max`. Slots without a face hold nothing.
static void check_faces(const char* what, const double* got, const double* min, const double* max,
                        double tolerance)
{
    uint32_t side = CELLS + 1, slots = cubed(side);
    for (uint32_t i = 0; i < 3 * slots; ++i) {
        uint32_t at[3] = {i % slots % side, i % slots / side % side, i % slots / (side * side)};
        int there = 1;
        for (uint32_t k = 0; k < 3; ++k) there &= at[k] < CELLS || k == i / slots;
        if (there) hair_test_near(what, i, got[i], fmin(fmax(got[i], min[i]), max[i]), tolerance);
    }
}

// Openness of faces -------------------------------------------------------------------------------

static void begin(struct hair_test* test, struct hair_test_fluid* f)
{
    struct hair_fluid_desc desc = hair_test_fluid_desc(CELLS);
    hair_test_fluid_begin(test, &desc, 1, f);
    hair_fluid_place(&f->fluid, &f->now);
}

// Return the distance from the ball in cells. `user` is the middle of the ball.
static double from_ball(const double place[3], const void* user)
{
    const double* middle = user;
    double cell = (double)HAIR_TEST_FLUID_SIDE / CELLS, sum = 0;
    for (int k = 0; k < 3; ++k) sum += (place[k] - middle[k]) * (place[k] - middle[k]);
    return sqrt(sum) - (double)HAIR_TEST_FLUID_BALL / cell;
}

// Move and rotate the head with the ball, and check faces. The box moves by whole cells.
static void face_fractions_equal_the_uncovered_area(void** state)
{
    struct hair_test_fluid f;
    double middle[3], max = 0, cell = (double)HAIR_TEST_FLUID_SIDE / CELLS;
    begin(*state, &f);
    f.now.head = (struct hair_pose){{3.013, -1.5, 0.022}, {0.36f, 0.48f, 0, 0.8f}};
    hair_fluid_place(&f.fluid, &f.now);
    for (int k = 0; k < 3; ++k) {
        middle[k] = f.now.head.position[k] / cell - f.fluid.origin[k];
        hair_test_near("whole cells", (size_t)k, f.fluid.origin[k], round(f.fluid.origin[k]), 0);
        hair_test_near("middle", (size_t)k, middle[k], CELLS / 2.0, 0.5);
    }
    double* open = hair_test_fluid_open(&f, 0);
    for (uint32_t i = 0; i < f.faces; ++i) {
        uint32_t side = CELLS + 1, axis = i / cubed(side), slot = i % cubed(side);
        int32_t at[3] = {(int32_t)(slot % side), (int32_t)(slot / side % side),
                         (int32_t)(slot / (side * side))};
        if (at[0] == CELLS || at[1] == CELLS || at[2] == CELLS) continue;
        double expected = hair_reference_open(axis, at, from_ball, middle);
        // The error of the field is the rounding of half floats and the chord of 5 mm. Together
        // they are at most 1/40 of a cell, all along a face.
        hair_test_near("openness", i, open[i], expected, 0.1);
        max = fmax(max, fabs(open[i] - expected));
    }
    print_message("    off by at most %.4f\n", max);
    free(open);
    hair_test_fluid_end(&f);
}

static void coarse_face_fractions_are_means_of_four(void** state)
{
    struct hair_test_fluid f;
    begin(*state, &f);
    double *fine = hair_test_fluid_open(&f, 0), *coarse = hair_test_fluid_open(&f, 1);
    double* expected = calloc(3 * cubed(CELLS / 2 + 1), sizeof *expected);
    hair_reference_coarsen(CELLS, fine, expected);
    check("openness", coarse, expected, 3 * cubed(CELLS / 2 + 1), 0.51 / 1023);
    free(fine), free(coarse), free(expected);
    hair_test_fluid_end(&f);
}

// Check colliders that rotate and translate. Each face's wall has the speed of the ball there.
static void wall_velocity_is_that_of_the_collider(void** state)
{
    struct hair_test_fluid f;
    const double spin = 0.1 * 60, cell = (double)HAIR_TEST_FLUID_SIDE / CELLS;
    begin(*state, &f);
    hair_collider ball = f.colliders.current.collider[0];
    hair_colliders_end_step(&f.colliders);
    ball.position[1] = 0.01f;
    ball.rotation[2] = sinf(0.05f), ball.rotation[3] = cosf(0.05f);
    hair_test_ok(f.test, hair_colliders_set(&f.test->host.host, &f.colliders, &ball, 1, sizeof ball));
    hair_fluid_place(&f.fluid, &f.now);
    double *open = hair_test_fluid_open(&f, 0),
           *wall = hair_test_floats(f.fluid.wall_velocity.buffer, f.faces);
    size_t closed = 0, slots = f.faces / 3, side = CELLS + 1;
    for (size_t i = 0; i < 2 * slots; ++i) {
        size_t slot = i % slots;
        if (open[i] > 0.5) continue;
        double x = ((double)(slot % side) + (i < slots ? 0 : 0.5)) * cell - 0.4;
        double y = ((double)(slot / side % side) + (i < slots ? 0.5 : 0)) * cell - 0.4 - 0.01;
        if (slot % side == CELLS || slot / side % side == CELLS || slot / side / side == CELLS) continue;
        hair_test_near("wall", i, wall[i], i < slots ? -spin * y : 0.6 + spin * x, 1e-4);
        ++closed;
    }
    assert_true(closed > 20);
    free(open), free(wall);
    hair_test_fluid_end(&f);
}

// Advection ---------------------------------------------------------------------------------------

// Fill the texture, whose format is half floats. Multiples of 1/16 are exact up to 64.
static double* put_air(struct hair_test_fluid* f, double max)
{
    double* air = any_numbers(3 * f->count, max, 5);
    float* texel = calloc(4 * f->count, sizeof *texel);
    for (size_t i = 0; i < 3 * f->count; ++i) {
        air[i] = round(air[i] * 16) / 16;
        texel[4 * (i / 3) + i % 3] = (float)air[i];
    }
    const uint32_t size[3] = {f->cells, f->cells, f->cells};
    hair_gl_fill_texture_3d(f->fluid.gl, f->fluid.air, size, texel);
    free(texel);
    return air;
}

// Maximum error of texture coordinates, in cells. OpenGL requires no precision of filtering, and
// some GPUs have eight bits per texel side. Rounded down to eight bits, which is the worse
// direction, air of up to 3 m/s comes from 0.012 cells off.
#define BLUR 0.03

static void advection_equals_the_reference_in_a_moved_grid(void** state)
{
    struct hair_test_fluid f;
    begin(*state, &f);
    double *before = any_numbers(f.faces, 3, 1), *air = put_air(&f, 3), gone = 0, between = 0;
    f.now.head.position[0] = 2.2 * (double)HAIR_TEST_FLUID_SIDE / CELLS;
    f.now.wind = hair_v3(4, 1, -2);
    hair_fluid_place(&f.fluid, &f.now);
    hair_test_put_floats(f.fluid.velocity[0].buffer, before, f.faces);
    hair_fluid_advect(&f.fluid);
    struct hair_reference_flow flow = {CELLS,      {2, 0, 0},   CELLS / (60 * (double)HAIR_TEST_FLUID_SIDE),
                                       {4, 1, -2}, {-1, 1, -2}, before,
                                       air,        BLUR};
    double *min = calloc(f.faces, sizeof *min), *max = calloc(f.faces, sizeof *max);
    double* got[2] = {hair_test_floats(f.fluid.velocity[1].buffer, f.faces),
                      hair_test_floats(f.fluid.velocity[2].buffer, f.faces)};
    hair_reference_carry(&flow, min, max);
    check_faces("carried", got[0], min, max, 0.02);
    hair_reference_correct(&flow, got[0], min, max);
    check_faces("corrected", got[1], min, max, 0.02);
    for (size_t i = 0; i < f.faces; ++i) gone += fabs(got[1][i] - got[0][i]) / (double)f.faces;
    for (size_t i = 0; i < f.faces; ++i) between += (max[i] - min[i]) / (double)f.faces;
    print_message("    corrected by %.3f m/s in the mean, known to %.3f\n", gone, between);
    assert_true(gone > 5 * between);
    free(before), free(air), free(min), free(max), free(got[0]), free(got[1]);
    hair_test_fluid_end(&f);
}

// Pressure ----------------------------------------------------------------------------------------

struct pressed {
    struct hair_test_fluid f;
    double *open[2], *wall, *velocity, *right, *pressure;
};

static void begin_pressed(struct hair_test* test, hair_fluid_method method, struct pressed* p)
{
    struct hair_fluid_desc desc = hair_test_fluid_desc(CELLS);
    desc.method = method;
    hair_test_fluid_begin(test, &desc, 1, &p->f);
    struct hair_test_fluid* f = &p->f;
    hair_fluid_place(&f->fluid, &f->now);
    p->wall = any_numbers(f->faces, 1, 2);
    hair_test_put_floats(f->fluid.wall_velocity.buffer, p->wall, f->faces);
    for (uint32_t i = 0; i < 2; ++i)
        p->open[i] = method == HAIR_FLUID_MULTIGRID || !i ? hair_test_fluid_open(f, i) : NULL;
    p->velocity = any_numbers(f->faces, 3, 3);
    hair_test_put_floats(f->fluid.velocity[2].buffer, p->velocity, f->faces);
    p->right = any_numbers(f->count + f->count / 8, 1, 4);
    p->pressure = any_numbers(f->count + f->count / 8, 1, 5);
    hair_test_put_floats(f->fluid.rhs.buffer, p->right, f->count + f->count / 8);
    hair_test_put_floats(f->fluid.pressure[0].buffer, p->pressure, f->count + f->count / 8);
}

static void end_pressed(struct pressed* p)
{
    free(p->open[0]), free(p->open[1]), free(p->wall), free(p->velocity), free(p->right), free(p->pressure);
    hair_test_fluid_end(&p->f);
}

static void check_buffer(const char* what, GLuint buffer, size_t first, const double* expected, size_t count,
                         double tolerance)
{
    double* got = hair_test_floats(buffer, first + count);
    check(what, got + first, expected, count, tolerance);
    free(got);
}

static void divergence_is_the_inflow_of_cells(void** state)
{
    struct pressed p;
    begin_pressed(*state, HAIR_FLUID_MULTIGRID, &p);
    struct hair_fluid* fluid = &p.f.fluid;
    hair_fluid_run(fluid, HAIR_GL_FLUID_DIVERGENCE, 0, 0, (uint32_t)p.f.count);
    hair_reference_inflow(CELLS, p.open[0], p.wall, p.velocity, p.right);
    check_buffer("right side", fluid->rhs.buffer, 0, p.right, p.f.count, 1e-5);
    double* none = calloc(p.f.count, sizeof *none);
    check_buffer("pressure", fluid->pressure[0].buffer, 0, none, p.f.count, 0);
    free(none);
    end_pressed(&p);
}

static void pressure_sweeps_equal_the_reference(void** state)
{
    struct pressed p;
    begin_pressed(*state, HAIR_FLUID_MULTIGRID, &p);
    for (uint32_t color = 0; color < 2; ++color) {
        hair_fluid_run(&p.f.fluid, HAIR_GL_FLUID_SMOOTH, 0, color, (uint32_t)p.f.count / 2);
        hair_reference_relax(CELLS, p.open[0], p.right, color, 1.15, p.pressure);
        check_buffer("one color", p.f.fluid.pressure[0].buffer, 0, p.pressure, p.f.count, 2e-6);
    }
    end_pressed(&p);
    begin_pressed(*state, HAIR_FLUID_JACOBI, &p);
    for (int i = 0; i < 2; ++i) {
        hair_fluid_run(&p.f.fluid, HAIR_GL_FLUID_JACOBI, 0, 0, (uint32_t)p.f.count);
        hair_reference_relax(CELLS, p.open[0], p.right, 2, 1, p.pressure);
        check_buffer("all", p.f.fluid.pressure[p.f.fluid.current_pressure].buffer, 0, p.pressure, p.f.count,
                     2e-6);
    }
    end_pressed(&p);
}

static void restriction_and_prolongation_equal_the_reference(void** state)
{
    struct pressed p;
    begin_pressed(*state, HAIR_FLUID_MULTIGRID, &p);
    struct hair_fluid* fluid = &p.f.fluid;
    size_t coarse = p.f.count / 8;
    double *left = calloc(p.f.count, sizeof *left), *right = calloc(coarse, sizeof *right);
    hair_reference_prolong(CELLS, p.pressure + p.f.count, p.pressure);
    hair_fluid_run(fluid, HAIR_GL_FLUID_PROLONG, 0, 0, (uint32_t)p.f.count);
    check_buffer("pressure", fluid->pressure[0].buffer, 0, p.pressure, p.f.count, 1e-6);
    hair_fluid_run(fluid, HAIR_GL_FLUID_RESTRICT, 0, 0, (uint32_t)coarse);
    hair_reference_residual(CELLS, p.open[0], p.right, p.pressure, left);
    hair_reference_restrict(CELLS, left, right);
    check_buffer("right side", fluid->rhs.buffer, p.f.count, right, coarse, 3e-5);
    free(left), free(right);
    end_pressed(&p);
}

// Check 16 sweeps of over-relaxation by 1.4, from no pressure.
static void coarsest_level_is_solved_exactly(void** state)
{
    struct pressed p;
    begin_pressed(*state, HAIR_FLUID_MULTIGRID, &p);
    size_t count = p.f.count / 8;
    double *own = calloc(count, sizeof *own), *left = calloc(count, sizeof *left);
    double* right = p.right + p.f.count;
    hair_fluid_run(&p.f.fluid, HAIR_GL_FLUID_COARSE_SOLVE, 1, 0, 1);
    for (uint32_t i = 0; i < 32; ++i) hair_reference_relax(CELLS / 2, p.open[1], right, i % 2, 1.4, own);
    check_buffer("pressure", p.f.fluid.pressure[0].buffer, p.f.count, own, count, 1e-4);
    hair_reference_residual(CELLS / 2, p.open[1], right, own, left);
    double fraction = hair_test_rms(left, count) / hair_test_rms(right, count);
    print_message("    %.1e of the right side is left\n", fraction);
    assert_true(fraction < 1e-3);
    free(own), free(left);
    end_pressed(&p);
}

static void velocities_lose_the_pressure_gradient_and_are_exported(void** state)
{
    struct pressed p;
    begin_pressed(*state, HAIR_FLUID_MULTIGRID, &p);
    double* air = calloc(3 * p.f.count, sizeof *air);
    float* texel = calloc(4 * p.f.count, sizeof *texel);
    hair_fluid_project(&p.f.fluid);
    hair_reference_release(CELLS, p.open[0], p.wall, p.pressure, p.velocity);
    double* got = hair_test_fluid_velocity(&p.f);
    check_faces("velocity", got, p.velocity, p.velocity, 1e-6);
    hair_reference_air(CELLS, p.velocity, air);
    glGetTextureImage(p.f.fluid.air, 0, GL_RGBA, GL_FLOAT, (GLsizei)(4 * p.f.count * sizeof *texel), texel);
    for (size_t i = 0; i < 3 * p.f.count; ++i)
        hair_test_near("air", i, (double)texel[4 * (i / 3) + i % 3], air[i], 2e-3);
    free(air), free(texel), free(got);
    end_pressed(&p);
}

int main(void)
{
    if (hair_test_skips()) return 0;
    const struct CMUnitTest tests[] = {
        HAIR_TEST(face_fractions_equal_the_uncovered_area),
        HAIR_TEST(coarse_face_fractions_are_means_of_four),
        HAIR_TEST(wall_velocity_is_that_of_the_collider),
        HAIR_TEST(advection_equals_the_reference_in_a_moved_grid),
        HAIR_TEST(divergence_is_the_inflow_of_cells),
        HAIR_TEST(pressure_sweeps_equal_the_reference),
        HAIR_TEST(restriction_and_prolongation_equal_the_reference),
        HAIR_TEST(coarsest_level_is_solved_exactly),
        HAIR_TEST(velocities_lose_the_pressure_gradient_and_are_exported),
    };
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
