// fluid_flow_test.c - the fluid as a whole: flow round a ball and in a box, and recovery from
// hostile input.
#include "tests/support/fluids.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "lib/base/math.h"
#include "tests/reference/fluid.h"
#include "lib/wind/gusts.h"

#define WIND 5.0

static void begin(struct hair_test* test, uint32_t cells, int ball, struct hair_test_fluid* f)
{
    struct hair_fluid_desc desc = hair_test_fluid_desc(cells);
    hair_test_fluid_begin(test, &desc, ball, f);
}

static void advance(struct hair_test_fluid* f, int steps)
{
    for (int i = 0; i < steps; ++i) hair_fluid_step(&f->fluid, &f->now);
}

static double fastest(const struct hair_test_fluid* f)
{
    double *velocity = hair_test_fluid_velocity(f), max = 0;
    for (size_t i = 0; i < f->faces; ++i) {
        if (!isfinite(velocity[i])) fail_msg("velocity %zu is not finite", i);
        max = fmax(max, fabs(velocity[i]));
    }
    free(velocity);
    return max;
}

// Projection --------------------------------------------------------------------------------------

static void projection_leaves_no_divergence(void** state)
{
    static const struct {
        const char* name;
        hair_fluid_method method;
        uint32_t cycles, cells;
    } ways[] = {{"multigrid", HAIR_FLUID_MULTIGRID, 4, 32},
                {"relaxation", HAIR_FLUID_RELAXATION, 60, 16},
                {"jacobi", HAIR_FLUID_JACOBI, 200, 16}};
    for (int i = 0; i < 3; ++i) {
        struct hair_test_fluid f;
        struct hair_fluid_desc desc = hair_test_fluid_desc(ways[i].cells);
        desc.method = ways[i].method;
        desc.cycles = ways[i].cycles;
        hair_test_fluid_begin(*state, &desc, 1, &f);
        advance(&f, 3);
        double* right = hair_test_floats(f.fluid.rhs.buffer, f.count);
        double fraction = hair_test_fluid_left(&f) / hair_test_rms(right, f.count);
        print_message("    %s, %u: %.1e is left\n", ways[i].name, ways[i].cycles, fraction);
        assert_true(fraction <= 1e-3);
        free(right);
        hair_test_fluid_end(&f);
    }
}

// Flow round a ball -------------------------------------------------------------------------------

// Return the net flow through the sphere one cell outside the ball, relative to the inflow.
static double flux(const struct hair_test_fluid* f)
{
    enum { POINTS = 20000 };
    double *velocity = hair_test_fluid_velocity(f), sum = 0, in = 0;
    double radius = 1 + (double)HAIR_TEST_FLUID_BALL * f->cells / (double)HAIR_TEST_FLUID_SIDE;
    for (int i = 0; i < POINTS; ++i) { // The points are distributed evenly along a spiral.
        double z = 1 - (2 * i + 1.0) / POINTS, side = sqrt(1 - z * z), flow = 0;
        double normal[3] = {side * cos(2.399963 * i), side * sin(2.399963 * i), z}, place[3];
        for (int k = 0; k < 3; ++k) place[k] = f->cells / 2.0 + radius * normal[k];
        for (int k = 0; k < 3; ++k) flow += normal[k] * hair_test_fluid_at(f, velocity, k, place);
        sum += flow;
        if (flow < 0) in -= flow;
    }
    free(velocity);
    return sum / in;
}

static void add(const struct hair_test_fluid* f, double* sum)
{
    double* velocity = hair_test_fluid_velocity(f);
    for (size_t i = 0; i < f->faces; ++i) sum[i] += velocity[i];
    free(velocity);
}

// Return the root mean square difference of the velocity from its mirror image in a plane along the
// wind.
static double one_sided(const struct hair_test_fluid* f, const double* velocity, int axis)
{
    double sum = 0, n = f->cells;
    for (size_t i = 0; i < f->count; ++i) {
        double place[3] = {(double)(i % f->cells) + 0.5, (double)(i / f->cells % f->cells) + 0.5,
                           (double)(i / f->cells / f->cells) + 0.5};
        double mirrored[3] = {place[0], place[1], place[2]};
        mirrored[axis] = n - place[axis];
        for (int k = 0; k < 3; ++k) {
            double other = (k == axis ? -1 : 1) * hair_test_fluid_at(f, velocity, k, mirrored);
            double off = hair_test_fluid_at(f, velocity, k, place) - other;
            sum += off * off / (double)f->count;
        }
    }
    return sqrt(sum);
}

// Return the velocity along the wind, on the line through the ball's middle. The point is `radii`
// radii behind the middle.
static double behind(const struct hair_test_fluid* f, const double* velocity, double radii)
{
    double n = f->cells, cell = (double)HAIR_TEST_FLUID_SIDE / n;
    double place[3] = {n / 2 + radii * (double)HAIR_TEST_FLUID_BALL / cell, n / 2, n / 2};
    return hair_test_fluid_at(f, velocity, 0, place);
}

static void flow_around_a_ball_is_symmetric_with_a_calm_wake(void** state)
{
    enum { BEFORE = 30, STEPS = 60 };
    struct hair_test_fluid f;
    begin(*state, 32, 1, &f);
    double* mean = calloc(f.faces, sizeof *mean);
    advance(&f, BEFORE);
    double through = flux(&f);
    for (int i = 0; i < STEPS; ++i) {
        advance(&f, 1);
        add(&f, mean);
        through = fmax(fabs(through), fabs(flux(&f)));
    }
    for (size_t i = 0; i < f.faces; ++i) mean[i] /= STEPS * WIND;
    double side[2] = {one_sided(&f, mean, 1), one_sided(&f, mean, 2)};
    double place[3] = {16, 16 + 1.5 * 4, 16}, beside = hair_test_fluid_at(&f, mean, 0, place);
    double lee = 0;
    for (double radii = 1.5; radii <= 2.5; radii += 0.25) lee += fabs(behind(&f, mean, radii)) / 5;
    print_message(
        "    of the wind: %.1e through, %.3f and %.3f one-sided, %.2f before, %.2f beside, %.2f behind\n",
        through, side[0], side[1], behind(&f, mean, -1.5), beside, lee);
    assert_true(through <= 0.01);
    assert_true(side[0] <= 0.05 && side[1] <= 0.05);
    assert_true(behind(&f, mean, -1.5) < 0.85 && beside > 1.05 && lee < 0.6);
    free(mean);
    hair_test_fluid_end(&f);
}

static void uniform_wind_stays_uniform_around_a_moving_head(void** state)
{
    struct hair_test_fluid f;
    begin(*state, 16, 0, &f);
    for (int i = 0; i < 8; ++i) {
        f.now.head.position[0] += 0.07 * i, f.now.head.position[1] -= 0.013 * i;
        advance(&f, 1);
        double* velocity = hair_test_fluid_velocity(&f);
        for (size_t k = 0; k < f.faces; ++k) {
            size_t side = f.cells + 1, slot = k % (side * side * side), axis = k / (side * side * side);
            size_t at[3] = {slot % side, slot / side % side, slot / side / side};
            int there = 1;
            for (size_t a = 0; a < 3; ++a) there &= at[a] < f.cells || a == axis;
            if (there) hair_test_near("velocity", k, velocity[k], axis ? 0 : WIND, 1e-4);
        }
        free(velocity);
    }
    // A change of the wind takes effect at once.
    f.now.wind = hair_v3(-2, 0, 7);
    advance(&f, 1);
    double *velocity = hair_test_fluid_velocity(&f), middle[3] = {8, 8, 8};
    hair_test_near("changed", 0, hair_test_fluid_at(&f, velocity, 0, middle), -2, 1e-3);
    hair_test_near("changed", 2, hair_test_fluid_at(&f, velocity, 2, middle), 7, 1e-3);
    free(velocity);
    hair_test_fluid_end(&f);
}

// Compare the middle of the fluid with the pattern that the wind carries unchanged: their
// correlation, and the fraction of energy that arrives.
static void gusts_enter_the_grid_and_travel_with_the_wind(void** state)
{
    struct hair_test_fluid f;
    struct hair_wind_state air = {0};
    hair_wind wind = hair_wind_default();
    begin(*state, 32, 0, &f);
    wind.velocity[0] = (float)WIND, wind.turbulence.intensity = 0.2f, wind.turbulence.length = 0.5f;
    hair_test_ok(f.test, hair_wind_ensure(&air, &f.test->context->gl, &wind));
    float* texel = hair_gusts_make(&f.test->host.host, wind.turbulence.seed);
    assert_non_null(texel);
    double alike = 0, there = 0, all = 0;
    for (int i = 0; i < 60; ++i) { // After 0.16 s the air in the box has been replaced.
        f.now.gusts = hair_wind_find_gusts(&air, &wind, &f.now.head);
        advance(&f, 1);
        air.moved[0] += WIND * f.now.dt;
        if (i < 15 || i % 5) continue;
        struct hair_wind_gusts now = hair_wind_find_gusts(&air, &wind, &f.now.head);
        double* velocity = hair_test_fluid_velocity(&f);
        for (int k = 0; k < 6 * 6 * 6; ++k) {
            double place[3] = {7 + 3.5 * (k % 6), 7 + 3.5 * (k / 6 % 6), 7 + 3.5 * (k / 36)}, gust[3];
            hair_test_gust_at(&f, &now, texel, place, gust);
            for (int c = 0; c < 3; ++c) {
                double is = hair_test_fluid_at(&f, velocity, c, place) - (c ? 0 : WIND);
                alike += is * gust[c], there += is * is, all += gust[c] * gust[c];
            }
        }
        free(velocity);
    }
    print_message("    correlation with what the wind brings %.3f, of its energy %.3f\n",
                  alike / sqrt(there * all), there / all);
    assert_true(alike > 0.8 * sqrt(there * all) && fabs(there / all - 1) < 0.3);
    hair_free(&f.test->host.host, texel);
    hair_wind_free_state(&air, &f.test->context->gl);
    hair_test_fluid_end(&f);
}

// A moving collider -------------------------------------------------------------------------------

static void moving_ball_drags_still_air_along(void** state)
{
    struct hair_test_fluid f;
    hair_collider ball;
    begin(*state, 32, 1, &f);
    f.now.wind = hair_v3(0, 0, 0);
    // The collider moves with the head, and the box follows the head by whole cells.
    for (int i = 0; i < 6; ++i) {
        ball = f.colliders.current.collider[0];
        hair_colliders_end_step(&f.colliders);
        f.now.head.position[0] += WIND / 60;
        ball.position[0] = (float)f.now.head.position[0];
        hair_test_ok(f.test, hair_colliders_set(&f.test->host.host, &f.colliders, &ball, 1, sizeof ball));
        advance(&f, 1);
    }
    double *velocity = hair_test_fluid_velocity(&f), place[3] = {0, 16, 16}, n = f.cells;
    double cell = (double)HAIR_TEST_FLUID_SIDE / n;
    double middle = f.now.head.position[0] / cell - f.fluid.origin[0];
    place[0] = middle + (double)HAIR_TEST_FLUID_BALL / cell + 1;
    double ahead = hair_test_fluid_at(&f, velocity, 0, place);
    place[0] = middle, place[1] = 16 + (double)HAIR_TEST_FLUID_BALL / cell + 1;
    double beside = hair_test_fluid_at(&f, velocity, 0, place);
    // The irrotational flow has (R / r)^3 of the ball's speed ahead, and half as much in the other
    // direction beside.
    print_message("    %.2f of its speed ahead, %.2f beside\n", ahead / WIND, beside / WIND);
    assert_true(ahead > 0.35 * WIND && ahead < 0.8 * WIND);
    assert_true(beside < 0);
    free(velocity);
    hair_test_fluid_end(&f);
}

// A closed box ------------------------------------------------------------------------------------

static double energy(const double* velocity, size_t count)
{
    double rms = hair_test_rms(velocity, count);
    return rms * rms * (double)count / 2;
}

static void closed_grid_keeps_its_air_and_loses_energy(void** state)
{
    struct hair_test_fluid f;
    struct hair_fluid_desc desc = hair_test_fluid_desc(32);
    desc.closed = 1;
    desc.cycles = 6;
    hair_test_fluid_begin(*state, &desc, 0, &f);
    f.now.wind = hair_v3(0, 0, 0);
    advance(&f, 1);
    // Two rolls without divergence: the curl of sin(pi x) sin(pi y) along z, and the curl of sin(pi
    // y) sin(pi z) along x.
    double *velocity = calloc(f.faces, sizeof *velocity), pi = 3.14159265358979, n = f.cells;
    size_t side = f.cells + 1, slots = side * side * side;
    for (size_t i = 0; i < slots; ++i) {
        double x = (double)(i % side) / n, y = (double)(i / side % side) / n,
               z = (double)(i / side / side) / n;
        double half = 0.5 / n;
        velocity[i] = sin(pi * x) * cos(pi * (y + half));
        velocity[i + slots] = -cos(pi * (x + half)) * sin(pi * y) + sin(pi * y) * cos(pi * (z + half));
        velocity[i + 2 * slots] = -cos(pi * (y + half)) * sin(pi * z);
        if (i % side == f.cells) velocity[i + slots] = velocity[i + 2 * slots] = 0;
        if (i / side % side == f.cells) velocity[i] = velocity[i + 2 * slots] = 0;
        if (i / side / side == f.cells) velocity[i] = velocity[i + slots] = 0;
    }
    for (int k = 0; k < 3; ++k) hair_test_put_floats(f.fluid.velocity[k].buffer, velocity, f.faces);
    hair_fluid_run(&f.fluid, HAIR_GL_FLUID_EXPORT_VELOCITY, 0, 0, (uint32_t)f.count);
    double first = energy(velocity, f.faces), last = first;
    free(velocity);
    for (int i = 0; i < 20; ++i) {
        advance(&f, 1);
        velocity = hair_test_fluid_velocity(&f);
        double now = energy(velocity, f.faces), out = 0;
        for (size_t k = 0; k < slots; ++k) {
            size_t at[3] = {k % side, k / side % side, k / side / side};
            for (size_t a = 0; a < 3; ++a)
                if (at[a] == 0 || at[a] == f.cells) out = fmax(out, fabs(velocity[a * slots + k]));
        }
        hair_test_near("through walls", (size_t)i, out, 0, 0);
        assert_true(now <= last * 1.001);
        last = now;
        free(velocity);
    }
    print_message("    %.3f of the energy is left after a third of a second\n", last / first);
    assert_true(last / first > 0.9);
    hair_test_fluid_end(&f);
}

// Hostile input -----------------------------------------------------------------------------------

static void air_stays_finite_and_bounded_and_recovers(void** state)
{
    struct hair_test_fluid f;
    begin(*state, 16, 1, &f);
    struct hair_fluid_now kept = f.now;
    for (int i = 0; i < 40; ++i) {
        f.now = kept;
        f.now.dt = i % 4 == 0 ? 0.1 : i % 4 == 1 ? 1e-5 : 1.0 / 60;
        if (i % 2) f.now.wind = hair_v3(1000, -1000, 1000);
        if (i % 3 == 0) f.now.wind = hair_v3(0, 0, 0);
        if (i % 5 == 0) f.now.head.position[1] = 1e9;
        if (i % 7 == 0) f.now.head.rotation = (hair_quat){0, 1, 0, 0};
        if (i % 8 == 0) f.now.wind = hair_v3(NAN, INFINITY, 1);
        hair_collider ball = f.colliders.current.collider[0];
        hair_colliders_end_step(&f.colliders);
        ball.position[2] = i % 11 == 0 ? 1e6f : 0.01f * (float)(i % 3);
        ball.rotation[0] = i % 2 ? 1.0f : 0.0f, ball.rotation[3] = i % 2 ? 0.0f : 1.0f;
        hair_test_ok(f.test, hair_colliders_set(&f.test->host.host, &f.colliders, &ball, 1, sizeof ball));
        advance(&f, 1);
        assert_true(fastest(&f) <= 1e4);
    }
    hair_collider ball = f.colliders.current.collider[0];
    memset(ball.position, 0, sizeof ball.position);
    hair_test_ok(f.test, hair_colliders_set(&f.test->host.host, &f.colliders, &ball, 1, sizeof ball));
    hair_colliders_end_step(&f.colliders);
    f.now = kept;
    advance(&f, 60);
    double max = fastest(&f);
    print_message("    %.2f of the wind is the fastest a second later\n", max / WIND);
    assert_true(max < 2 * WIND && fabs(flux(&f)) < 0.05);
    hair_test_fluid_end(&f);
}

static void equal_inputs_give_equal_bits(void** state)
{
    double* velocity[2];
    size_t faces = 0;
    for (int run = 0; run < 2; ++run) {
        struct hair_test_fluid f;
        begin(*state, 16, 1, &f);
        faces = f.faces;
        for (int i = 0; i < 10; ++i) {
            f.now.wind.y = (float)(i % 3);
            advance(&f, 1);
        }
        velocity[run] = hair_test_fluid_velocity(&f);
        hair_test_fluid_end(&f);
    }
    assert_memory_equal(velocity[0], velocity[1], faces * sizeof *velocity[0]);
    free(velocity[0]), free(velocity[1]);
}

static void refused_memory_is_an_error_that_leaks_nothing(void** state)
{
    struct hair_test* test = *state;
    struct hair_fluid fluid;
    struct hair_fluid_desc desc = hair_test_fluid_desc(16);
    size_t bytes = test->host.live;
    for (uint32_t refused = 0;; ++refused) {
        test->host.refuse = test->host.allocations + 1 + refused;
        hair_result result = hair_fluid_create(&fluid, &test->context->gl, &desc);
        test->host.refuse = 0;
        if (result == HAIR_OK) break;
        hair_test_refused(test, result, HAIR_ERROR_MEMORY, "out of memory for");
        assert_int_equal(test->host.live, bytes);
        assert_null(fluid.gl);
    }
    hair_fluid_destroy(&fluid);
}

int main(void)
{
    if (hair_test_skips()) return 0;
    const struct CMUnitTest tests[] = {
        HAIR_TEST(projection_leaves_no_divergence),
        HAIR_TEST(flow_around_a_ball_is_symmetric_with_a_calm_wake),
        HAIR_TEST(uniform_wind_stays_uniform_around_a_moving_head),
        HAIR_TEST(gusts_enter_the_grid_and_travel_with_the_wind),
        HAIR_TEST(moving_ball_drags_still_air_along),
        HAIR_TEST(closed_grid_keeps_its_air_and_loses_energy),
        HAIR_TEST(air_stays_finite_and_bounded_and_recovers),
        HAIR_TEST(equal_inputs_give_equal_bits),
        HAIR_TEST(refused_memory_is_an_error_that_leaks_nothing),
    };
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
