// dispatch_test.c - a pass that is divided into many dispatches computes the same bits, and what
// takes a GPU long is divided.
#include <stdio.h>
#include <string.h>

#include "tests/support/instances.h"
#include "tests/support/passes.h"
#include "tests/support/ways.h"

#include "lib/api/api.h"

#define SIDE 64 // pixels
#define STEPS 4

struct result {
    struct hair_test_points points;
    float pixels[4 * SIDE * SIDE];
};

// Let each dispatch have at most `max` work groups.
static void limit_groups(struct hair_gl* gl, uint32_t max)
{
    for (uint32_t i = 0; i < gl->programs; ++i)
        gl->program[i]->max_groups = gl->program[i]->max_groups_of_threads = max;
}

// Simulate hair that touches a ball, and draw the hair with light and shadow.
static void simulate(struct hair_test* test, float turn, struct result* out)
{
    struct hair_test_handmade groom = hair_test_handmade_default();
    groom.guides = 100;
    groom.turn = turn;
    hair_desc desc = hair_test_way(hair_test_instance_way);
    hair_physics physics = hair_physics_default();
    hair_look look = hair_look_default();
    physics.hair_hair.cohesion = 2;
    look.self_shadow.method = HAIR_SELF_SHADOW_STRANDS;
    desc.physics = &physics;
    desc.look = &look;
    struct hair_test_scene scene = hair_test_scene_make(test, NULL);
    hair_test_scene_add(&scene, &groom, &desc);
    hair_collider ball = hair_collider_default();
    ball.size[0] = 0.15f;
    ball.position[1] = -0.1f;
    hair_test_ok(test, hair_set_colliders(scene.hair, &ball, 1, sizeof ball));
    hair_test_instance_swing(test, scene.hair, 0, STEPS);
    hair_view view = hair_test_view_by(HAIR_RENDER_PATH_COMPUTE);
    hair_test_set_orthographic(&view, 4, 0.5f, 0);
    view.primitive = HAIR_PRIMITIVE_RIBBONS;
    hair_test_draw(&scene, &view, SIDE, SIDE, 1, out->pixels, NULL);
    hair_test_read_points(test, scene.hair, HAIR_READ_FOLLOWERS, &out->points);
    hair_test_scene_free(&scene);
}

// Simulate with dispatches of one work group that are expected to take `dispatch_ms`, and whole.
static void check_divided(struct hair_test* test, float turn, double dispatch_ms, double tolerance)
{
    static struct result whole, divided;
    struct hair_gl* gl = &test->context->gl;
    int software = gl->software;
    gl->software = 0;
    simulate(test, turn, &whole);
    limit_groups(gl, 1);
    gl->dispatch_ms = dispatch_ms;
    simulate(test, turn, &divided);
    gl->dispatch_ms = HAIR_GL_DISPATCH_MS;
    gl->software = software;
    limit_groups(gl, 0);
    double alpha = hair_test_mean_alpha(whole.pixels, sizeof whole.pixels / sizeof *whole.pixels);
    double away = hair_test_points_distance(&whole.points, &divided.points);
    printf("    %u vertices, mean alpha %.4f, %.3g m\n", whole.points.count, alpha, away);
    assert_true(whole.points.count > 500 && alpha > 0.002);
    assert_int_equal(whole.points.count, divided.points.count);
    assert_true(away <= tolerance);
    if (tolerance > 0) return;
    assert_memory_equal(whole.points.at, divided.points.at, 3 * whole.points.count * sizeof *whole.points.at);
    assert_memory_equal(whole.pixels, divided.pixels, sizeof whole.pixels);
}

static void divided_passes_compute_the_same_bits(void** state)
{
    check_divided(*state, 0.3f, HAIR_GL_DISPATCH_MS, 0);
    check_divided(*state, 0.05f, 1e-9, 0);
}

// A dispatch turns the frames of a curled guide that fell back to another method onto its segments.
static void divided_curls_of_accurate_differ_by_rounding(void** state)
{
    bool accurate = hair_test_way(hair_test_instance_way).solver == HAIR_SOLVER_ACCURATE;
    check_divided(*state, 0.3f, 1e-9, accurate ? hair_test_way_rounding(hair_test_instance_way) : 0);
}

// Let a GPU simulate two frames. Return the runs of the solver in the second.
static uint32_t runs_of_solver(struct hair_test* test, double dispatch_ms)
{
    struct hair_gl* gl = &test->context->gl;
    struct hair_test_handmade groom = hair_test_handmade_default();
    hair_desc desc = hair_test_way(hair_test_instance_way);
    struct hair_test_scene scene = hair_test_scene_make(test, NULL);
    hair_test_scene_add(&scene, &groom, &desc);
    int software = gl->software;
    gl->software = 0;
    gl->dispatch_ms = dispatch_ms;
    hair_test_instance_swing(test, scene.hair, 0, 1);
    uint32_t before = hair_test_runs_of(gl, "sim/");
    hair_test_instance_swing(test, scene.hair, 0, 1);
    uint32_t runs = hair_test_runs_of(gl, "sim/") - before;
    gl->dispatch_ms = HAIR_GL_DISPATCH_MS;
    gl->software = software;
    hair_test_scene_free(&scene);
    return runs;
}

static void ordinary_hair_takes_a_dispatch_a_step(void** state)
{
    struct hair_test* test = *state;
    uint32_t whole = runs_of_solver(test, HAIR_GL_DISPATCH_MS), divided = runs_of_solver(test, 1e-9);
    printf("    %u runs, divided %u\n", whole, divided);
    assert_in_range(whole, 1, 2);
    assert_true(divided >= 2 * whole);
}

// Return how many dispatches a step of 1/60 s takes by a solver of so many substeps.
static uint32_t count_dispatches(hair_solver solver, uint32_t guides, uint32_t vertices, uint32_t substeps)
{
    struct hair_gl gl = {.dispatch_ms = HAIR_GL_DISPATCH_MS};
    struct hair_rods rods = {.mixed = 1};
    struct hair_sim sim = {.gl = &gl,
                           .rods = solver == HAIR_SOLVER_REDBLACK ? NULL : &rods,
                           .solver = solver,
                           .guides = guides,
                           .max_vertices = vertices,
                           .guide_vertices = guides * vertices};
    uint32_t at_once = hair_sim_substeps_in_time(&sim), count = 0;
    for (uint32_t done = 0; done < substeps; done += at_once) {
        uint32_t now = substeps - done < at_once ? substeps - done : at_once;
        uint32_t each = hair_sim_guides_in_time(&sim, now);
        count += (guides + each - 1) / each;
    }
    return count;
}

// The times of whole dispatches are those of `hair-bench dispatch` on an H100.
static void long_work_is_divided_by_its_measured_time(void** state)
{
    static const struct {
        hair_solver solver;
        uint32_t guides, vertices, substeps;
        double ms;
    } measured[] = {
        {HAIR_SOLVER_DIRECT, 10201, 32, 4, 1.04},   {HAIR_SOLVER_ACCURATE, 10201, 32, 24, 3.13},
        {HAIR_SOLVER_FOLLOW, 10201, 32, 2, 0.75},   {HAIR_SOLVER_REDBLACK, 10201, 32, 2, 0.27},
        {HAIR_SOLVER_DIRECT, 102400, 32, 4, 18.75}, {HAIR_SOLVER_REDBLACK, 102400, 32, 2, 8.13},
        {HAIR_SOLVER_DIRECT, 1024, 256, 4, 24.61},  {HAIR_SOLVER_ACCURATE, 1024, 256, 24, 89.18},
    };
    (void)state;
    for (size_t i = 0; i < sizeof measured / sizeof *measured; ++i) {
        uint32_t count = count_dispatches(measured[i].solver, measured[i].guides, measured[i].vertices,
                                          measured[i].substeps);
        double each = measured[i].ms / count;
        printf("    solver %d, %u guides of %u: %u dispatches, %.2f ms each\n", (int)measured[i].solver,
               measured[i].guides, measured[i].vertices, count, each);
        assert_true(each <= 2);
        assert_true(measured[i].ms > 2 || count == 1);
        assert_true(count <= 1 + 1.5 * measured[i].ms);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {HAIR_TEST(divided_passes_compute_the_same_bits),
                                       HAIR_TEST(divided_curls_of_accurate_differ_by_rounding),
                                       HAIR_TEST(ordinary_hair_takes_a_dispatch_a_step),
                                       HAIR_TEST(long_work_is_divided_by_its_measured_time)};
    return hair_test_run_every_way(tests, 4);
}
