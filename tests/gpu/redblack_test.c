// redblack_test.c - the solver on the GPU moves every guide as the double-precision reference does.
#include "tests/support/passes.h"
#include "tests/support/scene.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "lib/base/math.h"

#define STATES 4096 // Maximum number of guide vertices in a test.

// A groom and a state. The parameters switch every part of the solver on or off.
struct fixture {
    struct hair_test_scene scene;
    struct hair_step_params params;
    struct hair_state state[STATES];
    uint32_t random;
};

static hair_quat turn_about(hair_vec3 axis, float angle)
{
    axis = hair_scale(hair_normalize(axis, hair_v3(0, 1, 0)), sinf(angle / 2));
    return (hair_quat){axis.x, axis.y, axis.z, cosf(angle / 2)};
}

static hair_vec4 vec4_of_quat(hair_quat q)
{
    return (hair_vec4){q.x, q.y, q.z, q.w};
}

static void scatter(struct fixture* f, float away, float moved)
{
    hair_test_scatter(f->scene.groom, away, moved, &f->random, f->state);
}

// Start with all of the solver switched off. Only pinned vertices move.
static struct fixture start_with(void** state, struct hair_test_handmade wanted)
{
    struct fixture f = {.scene = hair_test_scene_make(*state, NULL), .random = 12345};
    hair_desc desc = hair_desc_default();
    desc.solver = HAIR_SOLVER_REDBLACK;
    hair_test_scene_add(&f.scene, &wanted, &desc);
    f.params.gravity.w = 1.0f / 120;
    f.params.substeps = 1;
    f.params.guides = f.scene.groom->info.guide_count;
    for (int i = 0; i < HAIR_STEP_SUBSTEPS; ++i)
        f.params.substep[i] =
            (struct hair_substep){{0, 0, 0, 1}, {0, 0, 0, (float)(i + 1) / HAIR_STEP_SUBSTEPS}};
    scatter(&f, 0.2f * wanted.segment, 0.1f * wanted.segment);
    return f;
}

// Start with one guide of each number of vertices up to `max`.
static struct fixture start_up_to(void** state, uint32_t max)
{
    struct hair_test_handmade wanted = hair_test_handmade_default();
    wanted.guides = max - 1, wanted.fewest = 2, wanted.max = max;
    return start_with(state, wanted);
}

static struct fixture start(void** state)
{
    return start_up_to(state, 64);
}

static void move_head(struct fixture* f)
{
    for (int i = 0; i < HAIR_STEP_SUBSTEPS; ++i) {
        float fraction = (float)(i + 1) / 5;
        f->params.substep[i] = (struct hair_substep){
            vec4_of_quat(turn_about(hair_v3(1, 2, 3), 0.2f * fraction)), {0.005f, -0.002f, 0.003f, fraction}};
    }
}

static void put_colliders(struct fixture* f)
{
    f->params.collision_margin = 0.001f;
    f->params.colliders = 3;
    f->params.collider[0] = (struct hair_capsule){.start = {{0, 0, 0, 0.09f}, {0, 0, 0, 0.09f}},
                                                  .end = {{0, 0, 0, 0.09f}, {0, 0, 0, 0.09f}}};
    f->params.collider[1] =
        (struct hair_capsule){.start = {{-0.2f, 0.2f, 0, 0.05f}, {0.2f, 0.25f, 0, 0.05f}},
                              .end = {{-0.2f, 0.25f, 0.01f, 0.05f}, {0.2f, 0.22f, 0.03f, 0.05f}}};
    f->params.collider[2] =
        (struct hair_capsule){.start = {{0.1f, 0.3f, 0.1f, 0.04f}, {0.1f, 0.3f, 0.1f, 0.04f}},
                              .end = {{0.1f, 0.28f, 0.08f, 0.04f}, {0.1f, 0.28f, 0.08f, 0.04f}}};
}

static void switch_all_on(struct fixture* f)
{
    f->params.gravity = (hair_vec4){0.5f, -9.81f, -0.25f, 1.0f / 120};
    f->params.keep = 0.97f;
    f->params.shape_frequency_root = 25;
    f->params.shape_frequency_tip = 3;
    f->params.angular = 150;
    f->params.bend = 0.1f;
    f->params.iterations = 20;
    move_head(f);
    put_colliders(f);
}

// Return the maximum error of a position, by the probabilistic bound of Higham and Mary 2019 ("A
// New Approach to Probabilistic Rounding Error Analysis").
//
// After n operations the error is at most l sqrt(n) u |x|, except for a fraction 2 exp(-l^2 / 2) of
// all cases. Here u = 2^-24 is the unit roundoff. |x| is at most 1 m, the distance from the head's
// origin. A million comparisons need l = 6.
//
// n counts operations that round at the size of a position. All others work on differences between
// neighbours, which are a hundredth of it. A substep has 4 operations to integrate, and 4 for the
// angular force. An iteration has 1 for each of two distance and two bend links, and 2 for each
// collider.
//
// Constraints hardly increase errors. A link divides errors among its ends, and no collider here
// pushes by more than half its radius. Hence the factor 2.
static double tolerance(const struct fixture* f)
{
    const struct hair_step_params* params = &f->params;

    double substep = 4 + (params->angular > 0 ? 4 : 0);
    double iteration = (params->bend > 0 ? 4 : 2) + 2 * params->colliders;
    return 2 * 6 * sqrt(params->substeps * (substep + params->iterations * iteration)) / 16777216;
}

static void run_pass(struct fixture* f, hair_gl_pass pass)
{
    struct hair_gl* gl = &f->scene.test->context->gl;
    size_t size = f->scene.groom->info.guide_vertex_count * sizeof *f->state;
    hair_test_ok(f->scene.test, hair_gl_ensure_program(gl, pass));
    // One driver loses data that is written to a buffer while a dispatch writes the buffer.
    glFinish();
    glNamedBufferSubData(f->scene.hair->sim.state, 0, (GLsizeiptr)size, f->state);
    glNamedBufferSubData(f->scene.hair->sim.step, 0, sizeof f->params, &f->params);
    hair_gl_enter(gl);
    hair_sim_bind(&f->scene.hair->sim);
    hair_gl_run(gl, pass, f->params.guides);
    hair_gl_leave(gl);
    glGetNamedBufferSubData(f->scene.hair->sim.state, 0, (GLsizeiptr)size, f->state);
}

static void run(struct fixture* f)
{
    run_pass(f, hair_gl_pass_for(HAIR_GL_REDBLACK, f->scene.groom->max_vertices));
}

static double largest(const hair_vec4* a, const double* b)
{
    double x = fabs(a->x - b[0]), y = fabs(a->y - b[1]), z = fabs(a->z - b[2]);
    return x + y + z == x + y + z ? fmax(x, fmax(y, z)) : INFINITY;
}

static struct hair_reference_vertex in_double(const struct hair_state* state)
{
    hair_vec4 p = state->position, d = state->displacement;
    return (struct hair_reference_vertex){{p.x, p.y, p.z}, {d.x, d.y, d.z}};
}

// Step the GPU and the reference from one state. Check that their results agree.
static void compare(struct fixture* f, const char* what)
{
    static struct hair_reference_vertex expected[STATES];
    uint32_t vertices = f->scene.groom->info.guide_vertex_count;
    double limit = tolerance(f), worst = 0, moved = 0;
    for (uint32_t i = 0; i < vertices; ++i) expected[i] = in_double(&f->state[i]);
    for (uint32_t g = 0; g < f->params.guides; ++g) {
        const struct hair_guide* guide = &f->scene.groom->guides[g];
        hair_reference_redblack(
            (struct hair_reference_guide){guide, f->scene.groom->rest + guide->first, &f->params},
            expected + guide->first);
    }
    for (uint32_t i = 0; i < vertices; ++i)
        moved = fmax(moved, largest(&f->state[i].position, expected[i].position));
    run(f);
    for (uint32_t i = 0; i < vertices; ++i) {
        double error = fmax(largest(&f->state[i].position, expected[i].position),
                            largest(&f->state[i].displacement, expected[i].displacement));
        worst = fmax(worst, error);
        if (!(error <= limit)) {
            print_message("    %s: vertex %u\n", what, i);
            hair_test_near("x", i, f->state[i].position.x, expected[i].position[0], limit);
            hair_test_near("y", i, f->state[i].position.y, expected[i].position[1], limit);
            hair_test_near("z", i, f->state[i].position.z, expected[i].position[2], limit);
            fail_msg("its displacement is wrong by %g", error);
        }
    }
    print_message("    %s: moved up to %.2g m, off by up to %.2g m of %.2g m\n", what, moved, worst, limit);
}

static void integration_equals_the_reference(void** state)
{
    struct fixture f = start(state);
    f.params.gravity = (hair_vec4){0.5f, -9.81f, -0.25f, 1.0f / 120};
    f.params.keep = 0.97f;
    f.params.shape_frequency_root = 25;
    f.params.shape_frequency_tip = 3;
    move_head(&f);
    compare(&f, "integrate");
    hair_test_scene_free(&f.scene);
}

static void angular_forces_equal_the_reference(void** state)
{
    struct fixture f = start(state);
    f.params.angular = 5000;
    scatter(&f, 0.002f, 0);
    compare(&f, "angular");
    hair_test_scene_free(&f.scene);
}

static void distance_constraints_equal_the_reference(void** state)
{
    struct fixture f = start(state);
    f.params.iterations = 1;
    scatter(&f, 0.002f, 0);
    compare(&f, "1 iteration");
    f.params.iterations = 20;
    scatter(&f, 0.002f, 0);
    compare(&f, "20 iterations");
    hair_test_scene_free(&f.scene);
}

// Compare angular constraints. In the rest pose the distance constraints have nothing to do. The
// rest lengths over two segments are then increased.
static void angular_constraints_equal_the_reference(void** state)
{
    struct fixture f = start(state);
    for (uint32_t i = 0; i < f.scene.groom->info.guide_vertex_count; ++i)
        f.scene.groom->rest[i].direction.w *= 1.1f;
    glNamedBufferSubData(f.scene.hair->sim.rest, 0,
                         f.scene.groom->info.guide_vertex_count * sizeof *f.scene.groom->rest,
                         f.scene.groom->rest);
    f.params.bend = 0.5f;
    f.params.iterations = 1;
    scatter(&f, 0, 0);
    compare(&f, "bend");
    hair_test_scene_free(&f.scene);
}

static void collisions_equal_the_reference(void** state)
{
    struct fixture f = start(state);
    f.params.iterations = 1;
    put_colliders(&f);
    scatter(&f, 0, 0);
    compare(&f, "collide");
    hair_test_scene_free(&f.scene);
}

static void vertices_end_outside_of_colliders(void** state)
{
    struct fixture f = start(state);
    switch_all_on(&f);
    f.params.colliders = 1;
    f.params.substeps = 5;
    run(&f);
    for (uint32_t g = 0; g < f.params.guides; ++g)
        for (uint32_t i = 2; i < f.scene.groom->guides[g].count; ++i) {
            hair_vec4 p = f.state[f.scene.groom->guides[g].first + i].position;
            assert_true(hair_length(hair_v3(p.x, p.y, p.z)) > 0.091f - 1e-6f);
        }
    hair_test_scene_free(&f.scene);
}

static void one_to_five_substeps_equal_the_reference(void** state)
{
    for (uint32_t substeps = 1; substeps <= 5; ++substeps) {
        struct fixture f = start(state);
        switch_all_on(&f);
        f.params.substeps = substeps;
        char what[32];
        snprintf(what, sizeof what, "%u substeps", substeps);
        compare(&f, what);
        hair_test_scene_free(&f.scene);
    }
}

// Switch parts off, one bit of `off` each: angular forces, bend, collisions, pull, and all
// iterations except one.
static void switch_off(struct fixture* f, int off)
{
    if (off & 1) f->params.angular = 0;
    if (off & 2) f->params.bend = 0;
    if (off & 4) f->params.colliders = 0;
    if (off & 8) f->params.shape_frequency_root = f->params.shape_frequency_tip = 0;
    if (off & 16) f->params.iterations = 1;
}

// Check with every part off alone, and on alone.
static void stages_switched_off_or_alone_equal_the_reference(void** state)
{
    for (int i = 0; i < 10; ++i) {
        struct fixture f = start(state);
        int bit = 1 << (i % 5), off = i < 5 ? bit : 31 - bit;
        switch_all_on(&f);
        f.params.substeps = 3;
        switch_off(&f, off);
        char what[32];
        snprintf(what, sizeof what, "without %c%c%c%c%c", off & 1 ? 'a' : '-', off & 2 ? 'b' : '-',
                 off & 4 ? 'c' : '-', off & 8 ? 'p' : '-', off & 16 ? 'i' : '-');
        compare(&f, what);
        hair_test_scene_free(&f.scene);
    }
}

// Check hair_step from its input to the positions of guides. The head turns and moves, and a
// collider moves, in a step of four substeps.
static void hair_step_with_all_inputs_equals_the_reference(void** state)
{
    struct fixture f = start(state);
    hair_physics physics = hair_physics_default();
    // No value is its default, which may change.
    physics.damping = 3, physics.shape.frequency_root = 5, physics.shape.frequency_tip = 0.75f,
    physics.redblack.angular_hz = 1.5f;
    physics.redblack.bend = 0.15f, physics.redblack.iterations = 19, physics.collision.margin = 0.002f,
    physics.gravity[0] = 1;
    hair_test_ok(f.scene.test, hair_set_physics(f.scene.hair, &physics));
    hair_collider collider = {HAIR_SHAPE_CAPSULE, {0.1f, 0.25f, 0}, {0, 0, (float)sin(0.4), (float)cos(0.4)},
                              {0.05f, 0.1f},      .scale = 1,       .friction = 1};
    hair_test_ok(f.scene.test, hair_set_colliders(f.scene.hair, &collider, 1, sizeof collider));
    hair_test_ok(f.scene.test, hair_reset(f.scene.hair));
    double angle = 0.3, to[3] = {0.04, -0.01, 0.02};
    float transform[16] = {(float)cos(angle),
                           0,
                           (float)-sin(angle),
                           0,
                           0,
                           1,
                           0,
                           0,
                           (float)sin(angle),
                           0,
                           (float)cos(angle),
                           0,
                           (float)to[0],
                           (float)to[1],
                           (float)to[2],
                           1};
    hair_test_ok(f.scene.test, hair_set_transform(f.scene.hair, transform));
    hair_collider there = collider;
    there.position[1] += 0.03f;
    hair_test_ok(f.scene.test, hair_set_colliders(f.scene.hair, &there, 1, sizeof there));
    hair_test_ok(f.scene.test, hair_step(f.scene.hair, 4.0f / 120));

    struct hair_step_params* p = &f.params;
    double dt = (double)(float)(1.0 / 120), tau = 6.283185307179586;
    p->gravity = (hair_vec4){1, physics.gravity[1], physics.gravity[2], (float)dt};
    p->keep = (float)exp(-3 * dt);
    p->shape_frequency_root = (float)(tau * 5);
    p->shape_frequency_tip = (float)(tau * 0.75);
    p->angular = (float)(tau * tau * 1.5 * 1.5);
    p->bend = 0.15f;
    p->collision_margin = 0.002f;
    p->iterations = 19;
    p->substeps = 4;
    p->colliders = 1;
    for (int i = 0; i < 4; ++i) {
        float fraction = (float)(i + 1) / 4;
        p->substep[i] =
            (struct hair_substep){{0, (float)sin(angle * fraction / 2), 0, (float)cos(angle * fraction / 2)},
                                  {(float)(to[0] / 4), (float)(to[1] / 4), (float)(to[2] / 4), fraction}};
    }
    for (int end = 0; end < 2; ++end) {
        float x = (float)((end ? -1 : 1) * sin(0.8) * 0.1), y = (float)((end ? 1 : -1) * cos(0.8) * 0.1);
        p->collider[0].start[end] = (hair_vec4){0.1f + x, 0.25f + y, 0, 0.05f};
        p->collider[0].end[end] =
            (hair_vec4){(float)(0.1 + x - to[0]), (float)(0.28 + y - to[1]), (float)-to[2], 0.05f};
    }
    static struct hair_reference_vertex expected[STATES];
    static float got[3 * STATES];
    uint32_t count;
    scatter(&f, 0, 0);
    for (uint32_t i = 0; i < f.scene.groom->info.guide_vertex_count; ++i)
        expected[i] = in_double(&f.state[i]);
    for (uint32_t g = 0; g < p->guides; ++g) {
        const struct hair_guide* guide = &f.scene.groom->guides[g];
        hair_reference_redblack((struct hair_reference_guide){guide, f.scene.groom->rest + guide->first, p},
                                expected + guide->first);
    }
    hair_test_ok(f.scene.test, hair_read_positions(f.scene.hair, HAIR_READ_GUIDES, got, STATES, &count));
    assert_int_equal(count, f.scene.groom->info.guide_vertex_count);
    for (uint32_t i = 0; i < count; ++i)
        for (int k = 0; k < 3; ++k)
            hair_test_near("guide vertex", i, got[3 * i + k], expected[i].position[k] + to[k],
                           2 * tolerance(&f));
    hair_test_scene_free(&f.scene);
}

static void guides_move_equally_in_a_larger_work_group(void** state)
{
    static struct hair_state smallest[STATES];
    struct fixture f = start_up_to(state, 32);
    switch_all_on(&f);
    f.params.substeps = 5;
    for (int larger = 0; larger < 4; ++larger) {
        f.random = 12345;
        scatter(&f, 0.002f, 0.001f);
        run_pass(&f, HAIR_GL_REDBLACK | HAIR_GL_SIZE(larger));
        if (!larger) memcpy(smallest, f.state, sizeof smallest);
        assert_memory_equal(smallest, f.state, f.scene.groom->info.guide_vertex_count * sizeof *smallest);
    }
    hair_test_scene_free(&f.scene);
}

// Compare one to ten guides with these numbers of vertices, each time with a longer guide among
// them. They cover every size of the work group, with guides that fill it and guides that leave
// most of it idle. None is longer than 1 m, as tolerance() requires.
static void guides_of_2_to_256_vertices_equal_the_reference(void** state)
{
    static const uint32_t vertices[] = {2, 3, 32, 33, 64, 65, 128, 129, 255, 256};
    for (uint32_t guides = 1; guides <= sizeof vertices / sizeof *vertices; ++guides) {
        uint32_t max = vertices[guides - 1];
        struct hair_test_handmade wanted = hair_test_handmade_default();
        wanted.guides = guides, wanted.vertices = vertices;
        wanted.segment = max > 64 ? 0.64f / (float)max : 0.01f;
        struct fixture f = start_with(state, wanted);
        switch_all_on(&f);
        f.params.substeps = 3;
        char what[32];
        snprintf(what, sizeof what, "up to %u vertices", max);
        compare(&f, what);
        hair_test_scene_free(&f.scene);
    }
}

// Check guides of two vertices. The scalp pins two vertices, so that such a guide is always in its
// rest pose under the head.
static void a_guide_of_two_vertices_is_rigid(void** state)
{
    struct hair_test_handmade wanted = hair_test_handmade_default();
    wanted.fewest = wanted.max = 2;
    struct fixture f = start_with(state, wanted);
    switch_all_on(&f);
    f.params.substeps = 4;
    run(&f);
    hair_vec4 turn = f.params.substep[3].rotation;
    for (uint32_t i = 0; i < f.scene.groom->info.guide_vertex_count; ++i) {
        hair_vec4 rest = f.scene.groom->rest[i].position, p = f.state[i].position;
        hair_vec3 aim =
            hair_rotate((hair_quat){turn.x, turn.y, turn.z, turn.w}, hair_v3(rest.x, rest.y, rest.z));
        hair_test_near("x", i, p.x, aim.x, 1e-7);
        hair_test_near("y", i, p.y, aim.y, 1e-7);
        hair_test_near("z", i, p.z, aim.z, 1e-7);
    }
    hair_test_scene_free(&f.scene);
}

// Check a strand that is not finite. All its vertices return to the rest pose in one substep, and
// the other strands are unaffected.
static void only_nonfinite_strands_are_reset(void** state)
{
    static const float bad[] = {NAN, INFINITY, -INFINITY, 3e38f, 1e6f};
    static struct hair_state sound[STATES];
    for (size_t n = 0; n < sizeof bad / sizeof *bad; ++n) {
        struct fixture f = start(state);
        switch_all_on(&f);
        f.params.shape_frequency_root = f.params.shape_frequency_tip =
            0; // A positive frequency would bring 1e6 m back.
        run(&f);
        memcpy(sound, f.state, sizeof sound);

        f.random = 12345;
        scatter(&f, 0.002f, 0.001f);
        struct hair_guide broken = f.scene.groom->guides[17];
        if (n % 2)
            f.state[broken.first + 9].displacement.y = bad[n];
        else
            f.state[broken.first + 9].position.z = bad[n];
        run(&f);
        for (uint32_t i = 0; i < f.scene.groom->info.guide_vertex_count; ++i) {
            if (i < broken.first || i >= broken.first + broken.count) {
                assert_memory_equal(&f.state[i], &sound[i], sizeof sound[i]);
                continue;
            }
            hair_vec4 q = f.params.substep[0].rotation, p = f.scene.groom->rest[i].position;
            hair_vec3 rest = hair_rotate((hair_quat){q.x, q.y, q.z, q.w}, hair_v3(p.x, p.y, p.z));
            hair_test_near("x", i, f.state[i].position.x, rest.x, 1e-6);
            hair_test_near("y", i, f.state[i].position.y, rest.y, 1e-6);
            hair_test_near("z", i, f.state[i].position.z, rest.z, 1e-6);
            assert_memory_equal(&f.state[i].displacement, &f.params.substep[0].displacement,
                                3 * sizeof(float));
        }
        hair_test_scene_free(&f.scene);
    }
}

int main(void)
{
    if (hair_test_skips()) return 0;
    const struct CMUnitTest tests[] = {
        HAIR_TEST(integration_equals_the_reference),
        HAIR_TEST(angular_forces_equal_the_reference),
        HAIR_TEST(distance_constraints_equal_the_reference),
        HAIR_TEST(angular_constraints_equal_the_reference),
        HAIR_TEST(collisions_equal_the_reference),
        HAIR_TEST(vertices_end_outside_of_colliders),
        HAIR_TEST(one_to_five_substeps_equal_the_reference),
        HAIR_TEST(stages_switched_off_or_alone_equal_the_reference),
        HAIR_TEST(hair_step_with_all_inputs_equals_the_reference),
        HAIR_TEST(guides_move_equally_in_a_larger_work_group),
        HAIR_TEST(guides_of_2_to_256_vertices_equal_the_reference),
        HAIR_TEST(a_guide_of_two_vertices_is_rigid),
        HAIR_TEST(only_nonfinite_strands_are_reset),
    };
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
