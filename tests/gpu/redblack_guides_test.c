// redblack_guides_test.c - the solver redblack by hair_step with all inputs, for guides of any
// number of vertices, in any work group, and with states that are not finite.
#include "tests/support/redblack.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "lib/base/math.h"

// Check hair_step from its input to the positions of guides. The head turns and moves, and a
// collider moves, in a step of four substeps.
static void hair_step_with_all_inputs_equals_the_reference(void** state)
{
    struct hair_test_redblack f = hair_test_redblack_start(*state, 64);
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
    static struct hair_reference_vertex expected[HAIR_TEST_REDBLACK_STATES];
    static float got[3 * HAIR_TEST_REDBLACK_STATES];
    uint32_t count;
    hair_test_redblack_scatter(&f, 0, 0);
    for (uint32_t i = 0; i < f.scene.groom->info.guide_vertex_count; ++i)
        expected[i] = hair_test_redblack_vertex(&f.state[i]);
    for (uint32_t g = 0; g < p->guides; ++g) {
        const struct hair_guide* guide = &f.scene.groom->guides[g];
        hair_reference_redblack((struct hair_reference_guide){guide, f.scene.groom->rest + guide->first, p},
                                expected + guide->first);
    }
    hair_test_ok(f.scene.test,
                 hair_read_positions(f.scene.hair, HAIR_READ_GUIDES, got, HAIR_TEST_REDBLACK_STATES, &count));
    assert_int_equal(count, f.scene.groom->info.guide_vertex_count);
    for (uint32_t i = 0; i < count; ++i)
        for (int k = 0; k < 3; ++k)
            hair_test_near("guide vertex", i, got[3 * i + k], expected[i].position[k] + to[k],
                           2 * hair_test_redblack_tolerance(&f));
    hair_test_scene_free(&f.scene);
}

static void guides_move_equally_in_a_larger_work_group(void** state)
{
    static struct hair_state smallest[HAIR_TEST_REDBLACK_STATES];
    struct hair_test_redblack f = hair_test_redblack_start(*state, 32);
    hair_test_redblack_switch_on(&f);
    f.params.substeps = 5;
    for (int larger = 0; larger < 4; ++larger) {
        f.random = 12345;
        hair_test_redblack_scatter(&f, 0.002f, 0.001f);
        hair_test_redblack_run_pass(&f, HAIR_GL_REDBLACK | HAIR_GL_SIZE(larger));
        if (!larger) memcpy(smallest, f.state, sizeof smallest);
        assert_memory_equal(smallest, f.state, f.scene.groom->info.guide_vertex_count * sizeof *smallest);
    }
    hair_test_scene_free(&f.scene);
}

// Compare one to ten guides with these numbers of vertices, each time with a longer guide among
// them. They cover every size of the work group, with guides that fill it and guides that leave
// most of it idle. None is longer than 1 m, as hair_test_redblack_tolerance() requires.
static void guides_of_2_to_256_vertices_equal_the_reference(void** state)
{
    static const uint32_t vertices[] = {2, 3, 32, 33, 64, 65, 128, 129, 255, 256};
    for (uint32_t guides = 1; guides <= sizeof vertices / sizeof *vertices; ++guides) {
        uint32_t max = vertices[guides - 1];
        struct hair_test_handmade wanted = hair_test_handmade_default();
        wanted.guides = guides, wanted.vertices = vertices;
        wanted.segment = max > 64 ? 0.64f / (float)max : 0.01f;
        struct hair_test_redblack f = hair_test_redblack_start_with(*state, wanted);
        hair_test_redblack_switch_on(&f);
        f.params.substeps = 3;
        char what[32];
        snprintf(what, sizeof what, "up to %u vertices", max);
        hair_test_redblack_compare(&f, what);
        hair_test_scene_free(&f.scene);
    }
}

// Check guides of two vertices. The scalp pins two vertices, so that such a guide is always in its
// rest pose under the head.
static void a_guide_of_two_vertices_is_rigid(void** state)
{
    struct hair_test_handmade wanted = hair_test_handmade_default();
    wanted.fewest = wanted.max = 2;
    struct hair_test_redblack f = hair_test_redblack_start_with(*state, wanted);
    hair_test_redblack_switch_on(&f);
    f.params.substeps = 4;
    hair_test_redblack_run(&f);
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
    static struct hair_state sound[HAIR_TEST_REDBLACK_STATES];
    for (size_t n = 0; n < sizeof bad / sizeof *bad; ++n) {
        struct hair_test_redblack f = hair_test_redblack_start(*state, 64);
        hair_test_redblack_switch_on(&f);
        f.params.shape_frequency_root = f.params.shape_frequency_tip =
            0; // A positive frequency would bring 1e6 m back.
        hair_test_redblack_run(&f);
        memcpy(sound, f.state, sizeof sound);

        f.random = 12345;
        hair_test_redblack_scatter(&f, 0.002f, 0.001f);
        struct hair_guide broken = f.scene.groom->guides[17];
        if (n % 2)
            f.state[broken.first + 9].displacement.y = bad[n];
        else
            f.state[broken.first + 9].position.z = bad[n];
        hair_test_redblack_run(&f);
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
        HAIR_TEST(hair_step_with_all_inputs_equals_the_reference),
        HAIR_TEST(guides_move_equally_in_a_larger_work_group),
        HAIR_TEST(guides_of_2_to_256_vertices_equal_the_reference),
        HAIR_TEST(a_guide_of_two_vertices_is_rigid),
        HAIR_TEST(only_nonfinite_strands_are_reset),
    };
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
