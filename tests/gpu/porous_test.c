// porous_test.c - hair as a porous obstacle in the fluid. Its drag agrees with the reference in
// double precision, with decay, and with potential flow. The fluid stays sound at any density.
#include "tests/support/fluids.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "lib/api/api.h"
#include "lib/base/math.h"
#include "tests/reference/drag.h"
#include "tests/reference/fluid.h"
#include "lib/sim/hair_grid.h"
#include "tests/support/live_hair.h"

#define WIND 5.0
#define NU (1.82e-5 / 1.204)
#define DIAMETER 8e-5

// Begin a fluid with hair. A mass of 2^20 at a node stands for `density` metres of strands per
// cubic metre.
static void begin(struct hair_test* test, uint32_t cells, int ball, double density, struct hair_test_fluid* f)
{
    struct hair_fluid_desc desc = hair_test_fluid_desc(cells);
    double node = (double)HAIR_TEST_FLUID_SIDE / (cells < 32 ? cells : 32);
    hair_test_fluid_begin(test, &desc, ball, f);
    hair_test_ok(test, hair_fluid_ensure_hair(&f->fluid, 1));
    f->now.strands = (struct hair_fluid_strands){density * node * node * node / 1048576,
                                                 (float)(DIAMETER / NU), (float)NU};
}

static size_t node_count(const struct hair_test_fluid* f)
{
    size_t nodes = hair_fluid_nodes(&f->fluid);
    return nodes * nodes * nodes;
}

static void put_hair(struct hair_test_fluid* f, const int32_t* grid)
{
    glFinish();
    glNamedBufferSubData(f->fluid.hair.grid.buffer, 0, (GLsizeiptr)(4 * node_count(f) * sizeof *grid), grid);
}

// Fill the nodes with a fraction of the density, which `shape` gives.
static void fill(struct hair_test_fluid* f, double (*shape)(const double place[3]))
{
    size_t n = hair_fluid_nodes(&f->fluid);
    int32_t* grid = calloc(4 * n * n * n, sizeof *grid);
    for (size_t i = 0; i < n * n * n; ++i) { // Positions in the box are from 0 to 1.
        double place[3] = {((double)(i % n) + 0.5) / (double)n, ((double)(i / n % n) + 0.5) / (double)n,
                           ((double)(i / n / n) + 0.5) / (double)n};
        grid[4 * i] = (int32_t)(shape(place) * 1048576);
    }
    put_hair(f, grid);
    free(grid);
}

static void advance(struct hair_test_fluid* f, int steps)
{
    for (int i = 0; i < steps; ++i) {
        hair_fluid_place(&f->fluid, &f->now);
        hair_fluid_move(&f->fluid);
    }
}

// Check faces in hair that moves at random, among colliders, and in a box that has moved.
static void hair_reduces_face_fractions_like_the_reference(void** state)
{
    struct hair_test_fluid f;
    uint32_t random = 3;
    begin(*state, 16, 1, 5e5, &f);
    advance(&f, 3);
    size_t nodes = node_count(&f);
    float* texel = malloc(4 * f.count * sizeof *texel);
    int32_t* grid = calloc(4 * nodes, sizeof *grid);
    double *air = malloc(3 * f.count * sizeof *air), *density = calloc(nodes, sizeof *density);
    double* flux = calloc(3 * nodes, sizeof *flux);
    glGetTextureImage(f.fluid.air, 0, GL_RGBA, GL_FLOAT, (GLsizei)(4 * f.count * sizeof *texel), texel);
    for (size_t i = 0; i < 3 * f.count; ++i) air[i] = (double)texel[4 * (i / 3) + i % 3];
    for (size_t i = 0; i < nodes; ++i) {
        grid[4 * i] = i % 5 < 2 ? 0 : (int32_t)(1048576 * hair_random(&random));
        density[i] = grid[4 * i] * (5e5 / 1048576);
        for (int k = 0; k < 3; ++k) {
            grid[4 * i + 1 + k] = (int32_t)((hair_random(&random) - 0.5f) * (float)grid[4 * i]);
            flux[3 * i + k] = (double)HAIR_GRID_SPEED * grid[4 * i + 1 + k] * (5e5 / 1048576);
        }
    }
    put_hair(&f, grid);
    f.now.head.position[0] += 2.2 * (double)HAIR_TEST_FLUID_SIDE / 16;
    hair_fluid_place(&f.fluid, &f.now);
    double *open = hair_test_fluid_open(&f, 0),
           *wall = hair_test_floats(f.fluid.wall_velocity.buffer, f.faces);
    hair_fluid_bind(&f.fluid);
    hair_fluid_apply_porosity(&f.fluid);
    struct hair_reference_flow flow = {.cells = 16,
                                       .shift = {2, 0, 0},
                                       .cells_per = 16 / (60 * (double)HAIR_TEST_FLUID_SIDE),
                                       .wind = {WIND, 0, 0},
                                       .air = air};
    struct hair_reference_thicket hair = {16, density, flux, DIAMETER / NU, NU / 60};
    hair_reference_hold(&flow, &hair, open, wall);
    struct hair_fluid_buffer bare = f.fluid.face_fraction;
    f.fluid.face_fraction = f.fluid.hair.face_fraction;
    double *got = hair_test_fluid_open(&f, 0), min = 1;
    double* closing = hair_test_floats(f.fluid.hair.wall_velocity.buffer, f.faces);
    f.fluid.face_fraction = bare;
    for (uint32_t i = 0; i < f.faces; ++i) {
        uint32_t slot = i % (uint32_t)(f.faces / 3), axis = i / (uint32_t)(f.faces / 3);
        uint32_t at[3] = {slot % 17, slot / 17 % 17, slot / 289};
        int there = 1;
        for (uint32_t k = 0; k < 3; ++k) there &= at[k] < 16 || k == axis;
        if (!there) continue;
        // Openness has steps of 1 / 1023. A nearly closed face may be off by one more step.
        hair_test_near("open", i, got[i], open[i],
                       1.1 / 1023 + (open[i] > 0 && open[i] < 1.0 / 1023 ? 1.0 : 0) / 1023);
        if (got[i] < 0.95) hair_test_near("wall", i, closing[i], wall[i], 0.15);
        min = fmin(min, got[i] > 0 ? got[i] : 1);
    }
    print_message("    as little as %.3f is open\n", min);
    assert_true(min < 0.3);
    free(texel), free(grid), free(air), free(density), free(flux), free(open), free(wall), free(got),
        free(closing);
    hair_test_fluid_end(&f);
}

static double nowhere(const double place[3])
{
    (void)place;
    return 0;
}

// Return 1 in a slab along the wind, from end to end of the box. Pressure has no effect in it.
static double slab(const double place[3])
{
    return fabs(place[1] - 0.5) < 0.1 ? 1 : 0;
}

// Return the decay rate of air by one metre of strands per cubic metre, in m^2/s. `speed` is the
// speed of the air relative to the strands.
static double rate(double speed)
{
    double reynolds = speed * DIAMETER / NU;
    return NU * (hair_reference_drag_across(reynolds) * reynolds + hair_reference_drag_along(reynolds)) / 3;
}

static void wind_in_a_slab_of_hair_decays_by_drag(void** state)
{
    enum { STEPS = 12 };
    struct hair_test_fluid f;
    const double density = 1e5, dt = 1.0 / 240, place[3] = {24, 16, 16}, outside[3] = {24, 25, 16};
    begin(*state, 32, 0, density, &f);
    f.now.dt = dt;
    fill(&f, nowhere);
    advance(&f, 1); // The wind fills the box.
    fill(&f, slab);
    double speed = WIND, rough = WIND;
    for (int i = 0; i < STEPS; ++i) {
        advance(&f, 1);
        rough /= 1 + density * rate(rough) * dt;
        for (int k = 0; k < 100; ++k) speed -= density * rate(speed) * speed * dt / 100;
    }
    double *velocity = hair_test_fluid_velocity(&f), in = hair_test_fluid_at(&f, velocity, 0, place);
    print_message("    %.3f m/s after %g s, %.3f by implicit steps, %.3f exactly; %.3f outside\n", in,
                  STEPS * dt, rough, speed, hair_test_fluid_at(&f, velocity, 0, outside));
    hair_test_near("by implicit steps", 0, in / rough, 1, 0.01);
    hair_test_near("exactly", 0, in / speed, 1, 0.05);
    hair_test_near("outside", 0, hair_test_fluid_at(&f, velocity, 0, outside), WIND, 0.02);
    assert_true(in < 0.6 * WIND);
    free(velocity);
    hair_test_fluid_end(&f);
}

static double ball(const double place[3])
{
    double cell = (double)HAIR_TEST_FLUID_SIDE, sum = 0;
    for (int k = 0; k < 3; ++k) sum += (place[k] - 0.5) * (place[k] - 0.5) * cell * cell;
    return sqrt(sum) < (double)HAIR_TEST_FLUID_BALL ? 1 : 0;
}

// Check a porous ball in a flow that begins at once. With a transmitted fraction b, the flow inside
// is 3 b / (2 + b) of the wind, as in a dielectric ball.
static void flow_through_a_porous_ball_equals_potential_flow(void** state)
{
    static const double densities[] = {2e5, 1e6, 1e7};
    for (int i = 0; i < 3; ++i) {
        struct hair_test_fluid f;
        const double place[3] = {16, 16, 16};
        begin(*state, 32, 0, densities[i], &f);
        fill(&f, nowhere);
        advance(&f, 1);
        fill(&f, ball);
        advance(&f, 1);
        double* velocity = hair_test_fluid_velocity(&f);
        double through = 1 / (1 + densities[i] * rate(WIND) / 60), expected = 3 * through / (2 + through);
        double in = hair_test_fluid_at(&f, velocity, 0, place) / WIND;
        double* right = hair_test_floats(f.fluid.rhs.buffer, f.count);
        double left = hair_test_fluid_left(&f) / hair_test_rms(right, f.count);
        print_message(
            "    %.3f let through: %.3f of the wind inside, %.3f expected; %.1e of divergence left\n",
            through, in, expected, left);
        hair_test_near("inside", (size_t)i, in, expected, 0.03);
        assert_true(left < 5e-3);
        free(velocity), free(right);
        hair_test_fluid_end(&f);
    }
}

// Check hair of extreme density, which acts like a moving collider. Air near it is no faster than
// the wind, and moves with the hair.
static void air_stays_finite_in_hair_of_any_density(void** state)
{
    struct hair_test_fluid f;
    begin(*state, 16, 1, 1e30, &f);
    size_t nodes = node_count(&f);
    int32_t* grid = calloc(4 * nodes, sizeof *grid);
    for (size_t i = 0; i < nodes; ++i) {
        size_t x = i % 16, y = i / 16 % 16, z = i / 256;
        int in = x > 3 && x < 12 && y > 3 && y < 12 && z > 3 && z < 12;
        grid[4 * i] = in ? INT32_MAX / 2 : 0, grid[4 * i + 2] = grid[4 * i] / 16; // 1 m/s up
    }
    put_hair(&f, grid);
    for (int i = 0; i < 12; ++i) {
        f.now.dt = i % 3 ? 1.0 / 60 : 0.1;
        f.now.wind = i % 4 == 1 ? hair_v3(1000, -1000, 1000) : hair_v3(5, 0, 0);
        advance(&f, 1);
        double* velocity = hair_test_fluid_velocity(&f);
        for (size_t k = 0; k < f.faces; ++k) assert_true(isfinite(velocity[k]) && fabs(velocity[k]) <= 1e4);
        free(velocity);
    }
    f.now.dt = 1.0 / 60;
    f.now.wind = hair_v3(5, 0, 0);
    advance(&f, 20);
    double *velocity = hair_test_fluid_velocity(&f), place[3] = {5, 8, 8};
    hair_test_near("along the wind", 0, hair_test_fluid_at(&f, velocity, 0, place), 0, 0.1);
    hair_test_near("with the hair", 0, hair_test_fluid_at(&f, velocity, 1, place), 1, 0.1);
    free(velocity), free(grid);
    hair_test_fluid_end(&f);
}

// Check a head of few guides, which stand for many strands.
static void hair_drag_shelters_hair_behind_and_costs_nothing_off(void** state)
{
    struct hair_test_living living;
    struct hair_test_strands strands = hair_test_strands_make(65, 8);
    hair_physics physics = hair_test_loose(0);
    hair_wind wind = hair_wind_default();
    double way[2];
    physics.drag = 0.3f;
    for (int i = 0; i < 64; ++i) // A curtain across the wind, and one strand behind it.
        hair_test_add_straight(
            &strands, 8, hair_v3(-0.06f + 0.02f * (float)(i / 16), 0.05f, -0.15f + 0.02f * (float)(i % 16)),
            hair_v3(0, -1, 0), 0.15f);
    hair_test_add_straight(&strands, 8, hair_v3(0.12f, 0.05f, 0), hair_v3(0, -1, 0), 0.1f);
    wind.model = HAIR_WIND_FLUID;
    wind.velocity[0] = 2;
    for (int k = 0; k < 2; ++k) {
        hair_desc desc = hair_test_rods(HAIR_SOLVER_DIRECT, HAIR_THREAD_MAPPING_AUTO, 0, &physics);
        hair_test_live(*state, &strands, &desc, &living);
        wind.fluid.drag_strand_count = k ? 50000 : 0;
        hair_test_wind_coupling(&living, &wind);
        hair_test_wait(&living, 30);
        hair_test_read_guides(&living);
        way[k] = (double)(hair_test_tip(&living, 64).x - 0.12f);
        hair_test_healthy(&living);
        if (k) {
            GLuint grid = living.hair->sim.wind_coupling.fluid.hair.grid.buffer,
                   fraction = living.hair->sim.wind_coupling.splat;
            assert_true(glIsBuffer(grid) && glIsBuffer(fraction));
            wind.fluid.drag_strand_count = 0;
            hair_test_wind_coupling(&living, &wind);
            hair_test_wait(&living, 1);
            assert_false(glIsBuffer(grid) || glIsBuffer(fraction));
        }
        hair_test_die(&living);
    }
    hair_test_strands_free(&strands);
    print_message("    blown by %.4f m, by %.4f m behind 50,000 strands\n", way[0], way[1]);
    assert_true(way[1] < 0.6 * way[0]);
}

int main(void)
{
    if (hair_test_skips()) return 0;
    const struct CMUnitTest tests[] = {
        HAIR_TEST(hair_reduces_face_fractions_like_the_reference),
        HAIR_TEST(wind_in_a_slab_of_hair_decays_by_drag),
        HAIR_TEST(flow_through_a_porous_ball_equals_potential_flow),
        HAIR_TEST(air_stays_finite_in_hair_of_any_density),
        HAIR_TEST(hair_drag_shelters_hair_behind_and_costs_nothing_off),
    };
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
