// feedback_test.c - the solver redblack moves guides by transform feedback as by compute.
#include "tests/support/support.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "lib/api/api.h"
#include "tests/support/handmade.h"

struct fixture {
    struct hair_test* test;
    hair_groom* groom;
    hair_instance* hair[2]; // The first runs by compute, the second by transform feedback.
    double length; // Length of the longest guide, in metres.
    uint32_t vertices;
};

static struct fixture start(void** state, const hair_physics* physics)
{
    struct fixture f = {.test = *state};
    struct hair_test_handmade wanted = hair_test_handmade_default();
    wanted.fewest = 2, wanted.max = 41, wanted.guides = 40;
    f.groom = hair_test_groom(&f.test->host.host, wanted);
    f.vertices = f.groom->info.guide_vertex_count;
    for (uint32_t i = 0; i < wanted.guides; ++i)
        f.length = fmax(f.length, (double)f.groom->guides[i].arc_length);
    for (int i = 0; i < 2; ++i) {
        hair_desc desc = hair_desc_default();
        desc.solver = HAIR_SOLVER_REDBLACK;
        desc.thread_mapping = i ? HAIR_THREAD_MAPPING_FEEDBACK : HAIR_THREAD_MAPPING_WORKGROUP_PER_GUIDE;
        desc.physics = physics;
        hair_test_ok(f.test, hair_create(f.test->context, f.groom, &desc, &f.hair[i]));
    }
    return f;
}

static void finish(struct fixture* f)
{
    hair_destroy(f->hair[0]);
    hair_destroy(f->hair[1]);
    hair_groom_destroy(f->groom);
}

// Step both instances with a head that turns and moves, and a capsule that comes nearer. Return the
// maximum difference of coordinates, relative to the length.
static double step(struct fixture* f, int frame, double* moved)
{
    static float was[3 * 4096], at[2][3 * 4096];
    float a = 0.15f * (float)frame, worst = 0;
    float head[16] = {cosf(a), 0, -sinf(a), 0, 0, 1, 0, 0, sinf(a), 0, cosf(a), 0, 0.02f * a, 0.1f * a, 0, 1};
    hair_collider collider = hair_collider_default();
    uint32_t count;
    collider.shape = HAIR_SHAPE_CAPSULE;
    collider.size[0] = 0.05f, collider.size[1] = 0.1f;
    collider.position[0] = 0.2f - 0.01f * (float)frame;
    hair_test_ok(f->test, hair_read_positions(f->hair[0], HAIR_READ_GUIDES, was, f->vertices, &count));
    for (int i = 0; i < 2; ++i) {
        hair_test_ok(f->test, hair_set_colliders(f->hair[i], &collider, 1, sizeof collider));
        hair_test_ok(f->test, hair_set_transform(f->hair[i], head));
        hair_test_ok(f->test, hair_step(f->hair[i], 1.0f / 60));
        hair_test_ok(f->test, hair_read_positions(f->hair[i], HAIR_READ_GUIDES, at[i], f->vertices, &count));
    }
    for (uint32_t i = 0; i < 3 * count; ++i) {
        worst = fmaxf(worst, fabsf(at[0][i] - at[1][i]));
        *moved = fmax(*moved, (double)fabsf(at[0][i] - was[i]));
        assert_true(isfinite(at[1][i]));
    }
    return (double)worst / f->length;
}

static void transform_feedback_and_compute_agree_for_five_steps(void** state)
{
    for (int off = 0; off < 3; ++off) { // All forces, no angular forces, or no angular constraints.
        hair_physics physics = hair_physics_default();
        double worst = 0, moved = 0;
        if (off == 1) physics.redblack.angular_hz = 0;
        if (off == 2) physics.redblack.bend = 0;
        struct fixture f = start(state, &physics);
        for (int frame = 1; frame <= 5; ++frame) worst = fmax(worst, step(&f, frame, &moved));
        print_message("    off by up to %.2g lengths after moves of up to %.2g m\n", worst, moved);
        assert_true(moved > 0.01);
        assert_true(worst <= 1e-6);
        finish(&f);
    }
}

static void only_nonfinite_strands_are_reset(void** state)
{
    struct fixture f = start(state, NULL);
    struct hair_state* bad = calloc(f.vertices, sizeof *bad);
    double moved = 0;
    uint32_t guide = 7, first = f.groom->guides[guide].first, count;
    float* at = malloc(3 * sizeof *at * f.vertices);
    for (int i = 0; i < 2; ++i) {
        glFinish();
        glGetNamedBufferSubData(f.hair[i]->sim.state, 0, (GLsizeiptr)(f.vertices * sizeof *bad), bad);
        bad[first + 3].position.y = NAN;
        glNamedBufferSubData(f.hair[i]->sim.state, 0, (GLsizeiptr)(f.vertices * sizeof *bad), bad);
    }
    (void)step(&f, 1, &moved);
    hair_test_ok(f.test, hair_read_positions(f.hair[1], HAIR_READ_GUIDES, at, f.vertices, &count));
    for (uint32_t i = 0; i < 3 * count; ++i) assert_true(isfinite(at[i]));
    assert_true(step(&f, 2, &moved) <= 1e-6);
    free(bad);
    free(at);
    finish(&f);
}

static void transform_feedback_of_other_solvers_is_refused(void** state)
{
    struct hair_test* test = *state;
    hair_groom* groom = hair_test_groom(&test->host.host, hair_test_handmade_default());
    hair_instance* hair = NULL;
    hair_desc desc = hair_desc_default();
    desc.thread_mapping = HAIR_THREAD_MAPPING_FEEDBACK;
    hair_test_refused(test, hair_create(test->context, groom, &desc, &hair), HAIR_ERROR_ARGUMENT,
                      "which only the solver redblack has");
    assert_null(hair);
    hair_groom_destroy(groom);
}

int main(void)
{
    if (hair_test_skips()) return 0;
    const struct CMUnitTest tests[] = {
        HAIR_TEST(transform_feedback_and_compute_agree_for_five_steps),
        HAIR_TEST(only_nonfinite_strands_are_reset),
        HAIR_TEST(transform_feedback_of_other_solvers_is_refused),
    };
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
