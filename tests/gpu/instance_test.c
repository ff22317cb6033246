// instance_test.c - one head of hair as an application uses it: reset, on colliders, beside others,
// and under any calls.
#include "tests/support/instances.h"
#include "tests/support/tessellated.h"

#include <math.h>
#include <string.h>

#include "lib/base/math.h"

static void a_new_instance_is_in_its_rest_pose(void** state)
{
    static struct hair_test_points strands;
    struct hair_test* test = *state;
    hair_groom* groom = hair_test_groom(&test->host.host, hair_test_handmade_default());
    hair_instance* hair = hair_test_instance_make(test, groom);
    hair_test_read_points(test, hair, HAIR_READ_GUIDES, &strands);
    assert_int_equal(strands.count, groom->info.guide_vertex_count);
    for (uint32_t i = 0; i < strands.count; ++i) {
        hair_test_near("x", i, strands.at[3 * i], groom->rest[i].position.x, 1e-7);
        hair_test_near("y", i, strands.at[3 * i + 1], groom->rest[i].position.y, 1e-7);
        hair_test_near("z", i, strands.at[3 * i + 2], groom->rest[i].position.z, 1e-7);
    }
    hair_destroy(hair);
    hair_groom_destroy(groom);
}

static void reset_instance_equals_a_new_instance(void** state)
{
    static struct hair_test_points used, fresh;
    static const hair_read_source whats[] = {HAIR_READ_GUIDES, HAIR_READ_SMOOTH};
    struct hair_test* test = *state;
    hair_groom* groom = hair_test_groom(&test->host.host, hair_test_handmade_default());
    hair_instance* hair = hair_test_instance_make(test, groom);
    hair_instance* other = hair_test_instance_make(test, groom);
    float back[16];
    hair_test_instance_swing(test, hair, 0, 10);
    hair_test_ok(test, hair_step(hair, 0.003f));
    hair_test_set_identity(back);
    hair_test_ok(test, hair_set_transform(hair, back));
    hair_test_ok(test, hair_reset(hair));
    for (int steps = 0; steps < 3; ++steps) {
        for (int i = 0; i < 2; ++i) {
            hair_test_read_points(test, hair, whats[i], &used);
            hair_test_read_points(test, other, whats[i], &fresh);
            assert_memory_equal(used.at, fresh.at, 12 * fresh.count);
        }
        hair_test_ok(test, hair_step(hair, 1.0f / 60));
        hair_test_ok(test, hair_step(other, 1.0f / 60));
    }
    hair_destroy(hair);
    hair_destroy(other);
    hair_groom_destroy(groom);
}

static void strands_rest_on_a_collider_moved_into_them(void** state)
{
    static struct hair_test_points strands;
    struct hair_test* test = *state;
    hair_groom* groom = hair_test_groom(&test->host.host, hair_test_handmade_default());
    hair_instance* hair = hair_test_instance_make(test, groom);
    hair_physics physics = hair_physics_default();
    hair_test_ok(test, hair_set_physics(hair, &physics));
    for (int i = 0; i <= 60; ++i) {
        hair_collider colliders[2] = {
            {HAIR_SHAPE_SPHERE, {0, 0, 0}, {0, 0, 0, 1}, {0.09f, 0}, .scale = 1, .friction = 1},
            {HAIR_SHAPE_CAPSULE,
             {0.3f - 0.0025f * (float)i, 0.1f, 0},
             {0, 0, 0, 1},
             {0.04f, 0.1f},
             .scale = 1,
             .friction = 1}};
        hair_test_ok(test, hair_set_colliders(hair, colliders, 2, sizeof *colliders));
        hair_test_ok(test, hair_step(hair, 1.0f / 60));
    }
    hair_test_read_points(test, hair, HAIR_READ_GUIDES, &strands);
    double touching = 0;
    for (uint32_t g = 0; g < groom->info.guide_count; ++g)
        for (uint32_t i = 2; i < groom->guides[g].count; ++i) {
            const float* p = strands.at + 3 * (groom->guides[g].first + i);
            // Height of the nearest point on the capsule's axis.
            float y = fminf(fmaxf(p[1], 0), 0.2f);
            double from_axis = hypot(hypot(p[0] - 0.15, p[1] - y), p[2]);
            hair_test_near("inside the sphere", i, fmin(sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]), 0.091),
                           0.091, 1e-5);
            hair_test_near("inside the capsule", i, fmin(from_axis, 0.041), 0.041, 1e-5);
            touching += from_axis < 0.0411;
        }
    assert_true(touching > 0);
    hair_destroy(hair);
    hair_groom_destroy(groom);
}

static void draw(struct hair_test* test, hair_instance* hair, const struct hair_test_frame* frame,
                 float* pixels)
{
    hair_view view = hair_test_tessellated();
    view.primitive = HAIR_PRIMITIVE_LINES; // Ribbons are much narrower than these pixels.
    // The view is 0.8 m wide around the head, along -z.
    hair_test_set_orthographic(&view, 2.5f, -0.5f, -0.3f);
    hair_test_draw_in(frame, test, hair, &view, pixels);
}

#define SIDE 64

static void instances_do_not_affect_each_other(void** state)
{
    static struct hair_test_points alone[2], beside[2];
    static float seen_alone[2][4 * SIDE * SIDE], seen_beside[2][4 * SIDE * SIDE];
    struct hair_test* test = *state;
    hair_groom* groom = hair_test_groom(&test->host.host, hair_test_handmade_default());
    hair_collider collider = {HAIR_SHAPE_SPHERE, {0.1f, 0.2f, 0}, {0, 0, 0, 1},
                              {0.05f, 0},        .scale = 1,      .friction = 1};
    hair_instance* hair[2];
    struct hair_test_frame frame;
    hair_test_frame_make(&frame, SIDE, SIDE, GL_RGBA32F, 0);
    for (int i = 0; i < 2; ++i) {
        hair[i] = hair_test_instance_make(test, groom);
        if (i) hair_test_ok(test, hair_set_colliders(hair[i], &collider, 1, sizeof collider));
        for (int n = 0; n < 20; ++n) hair_test_ok(test, hair_step(hair[i], i ? 1.0f / 60 : 1.0f / 40));
        hair_test_read_points(test, hair[i], HAIR_READ_SMOOTH, &alone[i]);
        draw(test, hair[i], &frame, seen_alone[i]);
        hair_destroy(hair[i]);
    }
    for (int i = 0; i < 2; ++i) hair[i] = hair_test_instance_make(test, groom);
    hair_test_ok(test, hair_set_colliders(hair[1], &collider, 1, sizeof collider));
    for (int n = 0; n < 20; ++n)
        for (int i = 0; i < 2; ++i) {
            hair_test_ok(test, hair_step(hair[i], i ? 1.0f / 60 : 1.0f / 40));
            draw(test, hair[1 - i], &frame, seen_beside[1 - i]);
        }
    for (int i = 0; i < 2; ++i) {
        hair_test_read_points(test, hair[i], HAIR_READ_SMOOTH, &beside[i]);
        draw(test, hair[i], &frame, seen_beside[i]);
        assert_memory_equal(alone[i].at, beside[i].at, 12 * alone[i].count);
        assert_memory_equal(seen_alone[i], seen_beside[i], sizeof seen_alone[i]);
        hair_destroy(hair[i]);
    }
    assert_memory_not_equal(alone[0].at, alone[1].at, 12 * alone[0].count);
    int covered = 0;
    for (int i = 0; i < SIDE * SIDE; ++i) covered += seen_alone[0][4 * i + 3] > 0;
    assert_true(covered > 50);
    hair_test_frame_free(&frame);
    hair_groom_destroy(groom);
}

static void the_groom_may_be_destroyed_while_instances_use_it(void** state)
{
    static struct hair_test_points kept, gone;
    struct hair_test* test = *state;
    hair_groom* groom = hair_test_groom(&test->host.host, hair_test_handmade_default());
    hair_instance* hair = hair_test_instance_make(test, groom);
    hair_instance* other = hair_test_instance_make(test, groom);
    hair_test_instance_swing(test, hair, 0, 5);
    hair_groom_destroy(groom);
    hair_test_instance_swing(test, other, 0, 5);
    hair_test_read_points(test, hair, HAIR_READ_FOLLOWERS, &kept);
    hair_test_read_points(test, other, HAIR_READ_FOLLOWERS, &gone);
    assert_memory_equal(kept.at, gone.at, 12 * kept.count);
    hair_destroy(hair);
    hair_destroy(other);
}

// Check that every vertex is finite after any call of the application.
static void strands_stay_finite_under_any_calls(void** state)
{
    static struct hair_test_points strands;
    struct hair_test* test = *state;
    hair_groom* groom = hair_test_groom(&test->host.host, hair_test_handmade_default());
    hair_instance* hair = hair_test_instance_make(test, groom);
    uint32_t random = 7;
    for (int i = 0; i < 100; ++i) {
        hair_physics physics = hair_physics_default();
        float there[16], far = powf(10, 8 * hair_random(&random) - 2);
        hair_test_set_pose(6.28f * hair_random(&random), far, -far, 0, there);
        for (int k = 0; k < 3; ++k) physics.gravity[k] = 2000 * hair_random(&random) - 1000;
        physics.damping = 1000 * hair_random(&random),
        physics.shape.frequency_root = 30 * hair_random(&random);
        physics.redblack.angular_hz = 30 * hair_random(&random), physics.redblack.bend = hair_random(&random);
        physics.redblack.iterations = 1 + (uint32_t)(40 * hair_random(&random));
        hair_collider collider = {HAIR_SHAPE_CAPSULE, {far, -far, 0},
                                  {0, 0, 0, 1},       {1e-3f + 10 * hair_random(&random), far},
                                  .scale = 1,         .friction = 1};
        hair_test_ok(test, hair_set_physics(hair, &physics));
        hair_test_ok(test, hair_set_colliders(hair, &collider, (uint32_t)i % 2, sizeof collider));
        hair_test_ok(test, i % 7 ? hair_set_transform(hair, there) : hair_teleport(hair, there));
        hair_test_ok(test, hair_step(hair, 0.1f * hair_random(&random)));
        for (int what = 0; what < 2; ++what) {
            hair_test_read_points(test, hair, (hair_read_source)what, &strands);
            for (uint32_t k = 0; k < 3 * strands.count; ++k) assert_true(isfinite(strands.at[k]));
        }
    }
    hair_destroy(hair);
    hair_groom_destroy(groom);
}

// Check a step that is a small part of a substep and ends the substep. Colliders must be at their
// last positions, and not beyond.
static void tiny_step_moves_no_collider_too_far(void** state)
{
    static struct hair_test_points before, after;
    struct hair_test* test = *state;
    hair_groom* groom = hair_test_groom(&test->host.host, hair_test_handmade_default());
    hair_instance* hair = hair_test_instance_make(test, groom);
    hair_physics physics = hair_physics_default();
    memset(physics.gravity, 0, sizeof physics.gravity);
    hair_test_ok(test, hair_set_physics(hair, &physics));
    hair_collider collider = {HAIR_SHAPE_SPHERE, {0, 3, 0}, {0, 0, 0, 1}, {1, 0}, .scale = 1, .friction = 1};
    hair_test_ok(test, hair_set_colliders(hair, &collider, 1, sizeof collider));
    hair_test_ok(test, hair_step(hair, (float)((1 - 3e-6) / 120)));
    hair_test_read_points(test, hair, HAIR_READ_GUIDES, &before);
    for (int i = 0; i < 110; ++i) {
        // The last height is 1.4 m, where the collider touches no hair.
        collider.position[1] -= 0.0145f;
        hair_test_ok(test, hair_set_colliders(hair, &collider, 1, sizeof collider));
        hair_test_ok(test, hair_step(hair, 2e-8f / 120));
        hair_test_read_points(test, hair, HAIR_READ_GUIDES, &after);
        for (uint32_t k = 0; k < 3 * after.count; ++k)
            hair_test_near("position", k, after.at[k], before.at[k], 1e-3);
    }
    hair_destroy(hair);
    hair_groom_destroy(groom);
}

int main(void)
{
    if (hair_test_skips()) return 0;
    const struct CMUnitTest tests[] = {
        HAIR_TEST(a_new_instance_is_in_its_rest_pose),
        HAIR_TEST(reset_instance_equals_a_new_instance),
        HAIR_TEST(strands_rest_on_a_collider_moved_into_them),
        HAIR_TEST(instances_do_not_affect_each_other),
        HAIR_TEST(the_groom_may_be_destroyed_while_instances_use_it),
        HAIR_TEST(tiny_step_moves_no_collider_too_far),
        HAIR_TEST(strands_stay_finite_under_any_calls),
    };
    return hair_test_run_every_way(tests, sizeof tests / sizeof *tests);
}
