// scalp_test.c - roots follow a scalp that the application skins, wherever it moves.
#include "tests/support/skinned.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "lib/api/api.h"

#define STEP (1.0f / 30)

// Make a nod about an axis beside the scalp, and a walk.
static void pose_at(float time, float m[16])
{
    float turn = 0.5f * sinf(4 * time), c = cosf(turn), s = sinf(turn);
    float own[16] = {1, 0, 0, 0, 0, c, s, 0, 0, -s, c, 0, 0.3f * time, 0.05f * sinf(9 * time), 0, 1};
    memcpy(m, own, sizeof own);
}

static void carry(const float m[16], const float* from, float* out)
{
    for (int i = 0; i < HAIR_TEST_SCALP_VERTICES; ++i)
        for (int k = 0; k < 3; ++k)
            out[3 * i + k] =
                m[k] * from[3 * i] + m[4 + k] * from[3 * i + 1] + m[8 + k] * from[3 * i + 2] + m[12 + k];
}

// Maximum distance between both instances, in metres. In a step a head moves its origin along a
// line and rotates about the origin. Every root of a scalp moves along its own line. Both differ by
// at most r (1 - cos(half the rotation)). Here that is 0.2 m (1 - cos 0.034) = 0.12 mm in the
// middle of a step, and 0 at its ends. Hair with roots jerked by this distance is apart by a few
// times the distance.
#define CHORD 1e-3

static void rigidly_moved_scalp_equals_a_moved_head(void** state)
{
    static const hair_solver solvers[] = {HAIR_SOLVER_DIRECT, HAIR_SOLVER_ACCURATE, HAIR_SOLVER_FOLLOW,
                                          HAIR_SOLVER_REDBLACK};
    struct hair_test* test = *state;
    static struct hair_test_points a, b;
    for (int i = 0; i < 5; ++i) {
        hair_thread_mapping mapping =
            i == 4 ? HAIR_THREAD_MAPPING_WORKGROUP_PER_GUIDE : HAIR_THREAD_MAPPING_AUTO;
        struct hair_test_skinned head = hair_test_skinned_make(test, solvers[i % 4], mapping),
                                 scalp = hair_test_skinned_make(test, solvers[i % 4], mapping);
        double max = 0, went = 0, apart[2] = {0};
        float time = 0;
        for (int frame = 1; frame <= 25; ++frame) {
            float m[16];
            float dt = frame % 5 == 4 ? 0.001f : STEP; // The step has several substeps, or none.
            time += dt;
            pose_at(time, m);
            hair_test_ok(test, hair_set_transform(head.hair, m));
            carry(m, scalp.rest, scalp.positions);
            hair_test_skinned_set(test, &scalp);
            hair_test_ok(test, hair_step(head.hair, dt));
            hair_test_ok(test, hair_step(scalp.hair, dt));
            hair_test_read_points(test, head.hair, HAIR_READ_FOLLOWERS, &a);
            hair_test_read_points(test, scalp.hair, HAIR_READ_FOLLOWERS, &b);
            max = fmax(max, hair_test_points_distance(&a, &b));
            for (uint32_t k = 0; k < HAIR_TEST_SCALP_FOLLOWERS; ++k)
                apart[0] =
                    fmax(apart[0],
                         (double)hair_distance(hair_load3(a.at + 3 * k * (HAIR_TEST_SCALP_SEGMENTS + 1)),
                                               hair_load3(b.at + 3 * k * (HAIR_TEST_SCALP_SEGMENTS + 1))));
            hair_test_read_points(test, head.hair, HAIR_READ_GUIDES, &a);
            hair_test_read_points(test, scalp.hair, HAIR_READ_GUIDES, &b);
            apart[1] = fmax(apart[1], hair_test_points_distance(&a, &b));
            if (frame == 1) continue;
            went = fmax(went, (double)hair_distance(hair_load3(a.at), hair_v3(0, 0, 0)));
        }
        print_message(
            "    way %d: followers within %.2g mm, their roots within %.2g mm, guides within %.2g mm\n", i,
            max * 1e3, apart[0] * 1e3, apart[1] * 1e3);
        assert_true(went > 0.2);
        assert_true(max < CHORD && apart[1] < CHORD);
        assert_true(apart[0] < 2e-6);
        hair_destroy(head.hair), hair_destroy(scalp.hair);
    }
}

// Check substeps that become longer and shorter, either between two substeps or at once. Some of
// them end before a step begins.
static void rigid_scalp_equals_a_head_when_substeps_change(void** state)
{
    static const float rates[] = {1, 0.25f, 0.5f, 1, 1, 0.0625f};
    struct hair_test* test = *state;
    static struct hair_test_points a, b;
    float time = 0;
    struct hair_test_skinned head =
                                 hair_test_skinned_make(test, HAIR_SOLVER_DIRECT, HAIR_THREAD_MAPPING_AUTO),
                             scalp =
                                 hair_test_skinned_make(test, HAIR_SOLVER_DIRECT, HAIR_THREAD_MAPPING_AUTO);
    hair_physics physics = hair_physics_default();
    double max[2] = {0};
    for (int frame = 1; frame <= 90; ++frame) {
        float m[16];
        physics.substep_rate = rates[frame / 5 % 6];
        // This change does not wait for the end of a substep.
        if (frame % 30 == 0) physics.fiber.youngs_modulus *= 1.1f;
        float dt = frame % 10 == 5 ? STEP : 1.0f / 250;
        time += dt;
        pose_at(time, m);
        carry(m, scalp.rest, scalp.positions);
        hair_test_ok(test, hair_set_transform(head.hair, m));
        hair_test_skinned_set(test, &scalp);
        for (int i = 0; i < 2; ++i) {
            struct hair_test_skinned* s = i ? &scalp : &head;
            hair_test_ok(test, hair_set_physics(s->hair, &physics));
            hair_test_ok(test, hair_step(s->hair, dt));
        }
        for (int i = 0; i < 2; ++i) {
            hair_test_read_points(test, head.hair, i ? HAIR_READ_SMOOTH : HAIR_READ_GUIDES, &a);
            hair_test_read_points(test, scalp.hair, i ? HAIR_READ_SMOOTH : HAIR_READ_GUIDES, &b);
            max[i] = fmax(max[i], hair_test_points_distance(&a, &b));
        }
    }
    print_message("    guides within %.2g mm, drawn within %.2g mm\n", max[0] * 1e3, max[1] * 1e3);
    assert_true(max[0] < CHORD && max[1] < CHORD);
    hair_destroy(head.hair), hair_destroy(scalp.hair);
}

// Check a scalp at rest, passed in the head's space. It changes nothing, with any collider.
// Followers are an exception, because the first segments of guides are slightly bent, and followers
// would leave the scalp by this distance.
static void scalp_at_rest_in_a_moving_head_changes_nothing(void** state)
{
    struct hair_test* test = *state;
    static struct hair_test_points a, b, c, d;
    double max[2] = {0};
    struct hair_test_skinned head =
                                 hair_test_skinned_make(test, HAIR_SOLVER_DIRECT, HAIR_THREAD_MAPPING_AUTO),
                             scalp =
                                 hair_test_skinned_make(test, HAIR_SOLVER_DIRECT, HAIR_THREAD_MAPPING_AUTO);
    hair_physics physics = hair_physics_default();
    hair_collider colliders[2] = {hair_collider_default(), hair_collider_default()};
    physics.hair_hair.cohesion = 5;
    colliders[0].size[0] = 0.04f;
    colliders[1].shape = HAIR_SHAPE_BOX;
    for (int i = 0; i < 2; ++i) {
        colliders[i].position[0] = 0.15f * (float)i, colliders[i].position[1] = 0.08f,
        colliders[i].position[2] = 0.1f;
        if (i) colliders[i].size[0] = colliders[i].size[1] = colliders[i].size[2] = 0.03f;
    }
    for (int frame = 1; frame <= 12; ++frame) {
        float m[16];
        pose_at(STEP * (float)frame, m);
        for (int i = 0; i < 2; ++i) {
            struct hair_test_skinned* s = i ? &scalp : &head;
            hair_test_ok(test, hair_set_physics(s->hair, &physics));
            hair_test_ok(test, hair_set_colliders(s->hair, colliders, 2, sizeof *colliders));
            hair_test_ok(test, hair_set_transform(s->hair, m));
            if (i) hair_test_ok(test, hair_set_scalp(s->hair, s->rest, HAIR_TEST_SCALP_VERTICES, 12, m));
            hair_test_ok(test, hair_step(s->hair, STEP));
            hair_test_read_points(test, s->hair, HAIR_READ_GUIDES, i ? &b : &a);
            hair_test_read_points(test, s->hair, HAIR_READ_FOLLOWERS, i ? &d : &c);
        }
        max[0] = fmax(max[0], hair_test_points_distance(&a, &b)),
        max[1] = fmax(max[1], hair_test_points_distance(&c, &d));
    }
    print_message("    guides within %.2g mm, followers within %.2g mm\n", max[0] * 1e3, max[1] * 1e3);
    assert_true(max[0] < 1e-4 && max[1] < 4e-3);
    hair_destroy(head.hair), hair_destroy(scalp.hair);
}

// Check more colliders than a step's parameters hold. They are searched where the hair may be,
// which the head does not determine.
static void scalp_far_from_the_head_meets_colliders_there(void** state)
{
    struct hair_test* test = *state;
    static struct hair_test_points a, b, free;
    struct hair_test_skinned near =
                                 hair_test_skinned_make(test, HAIR_SOLVER_DIRECT, HAIR_THREAD_MAPPING_AUTO),
                             far = hair_test_skinned_make(test, HAIR_SOLVER_DIRECT, HAIR_THREAD_MAPPING_AUTO),
                             none =
                                 hair_test_skinned_make(test, HAIR_SOLVER_DIRECT, HAIR_THREAD_MAPPING_AUTO);
    hair_collider colliders[HAIR_STEP_COLLIDERS + 8];
    float m[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 4, 0, 0, 1};
    for (int at = 0; at < 2; ++at) {
        for (int i = 0; i < HAIR_STEP_COLLIDERS + 8; ++i) {
            colliders[i] = hair_collider_default();
            colliders[i].size[0] = 0.01f;
            colliders[i].position[0] = (float)(4 * at) + 0.025f * (float)(i % 9);
            colliders[i].position[1] = 0.08f;
            colliders[i].position[2] = 0.025f * (float)(i / 9);
        }
        struct hair_test_skinned* s = at ? &far : &near;
        hair_test_ok(test,
                     hair_set_colliders(s->hair, colliders, HAIR_STEP_COLLIDERS + 8, sizeof *colliders));
        hair_test_ok(test, hair_set_scalp(s->hair, s->rest, HAIR_TEST_SCALP_VERTICES, 12, at ? m : NULL));
        hair_test_ok(test, hair_reset(s->hair));
    }
    for (int frame = 0; frame < 6; ++frame) {
        hair_test_ok(test, hair_step(near.hair, STEP));
        hair_test_ok(test, hair_step(far.hair, STEP));
        hair_test_ok(test, hair_step(none.hair, STEP));
    }
    hair_test_read_points(test, near.hair, HAIR_READ_GUIDES, &a);
    hair_test_read_points(test, far.hair, HAIR_READ_GUIDES, &b);
    hair_test_read_points(test, none.hair, HAIR_READ_GUIDES, &free);
    for (uint32_t i = 0; i < b.count; ++i) b.at[3 * i] -= 4;
    print_message("    within %.2g mm of hair near the head, which colliders move by %.2g mm\n",
                  hair_test_points_distance(&a, &b) * 1e3, hair_test_points_distance(&a, &free) * 1e3);
    assert_true(hair_test_points_distance(&a, &free) > 0.02 && hair_test_points_distance(&a, &b) < 0.02);
    hair_destroy(near.hair), hair_destroy(far.hair), hair_destroy(none.hair);
}

static void stretch(const struct hair_test_skinned* s, float by, float* out)
{
    for (int i = 0; i < 3 * HAIR_TEST_SCALP_VERTICES; ++i) out[i] = s->rest[i] * by;
}

// Check that roots move with the scalp, and that hair keeps its shape and direction.
static void stretched_scalp_takes_every_root_along(void** state)
{
    struct hair_test* test = *state;
    static struct hair_test_points rest[3], now[3];
    for (int redblack = 0; redblack < 2; ++redblack) {
        struct hair_test_skinned s = hair_test_skinned_make(
            test, redblack ? HAIR_SOLVER_REDBLACK : HAIR_SOLVER_DIRECT, HAIR_THREAD_MAPPING_AUTO);
        for (int i = 0; i < 3; ++i) hair_test_read_points(test, s.hair, (hair_read_source)i, &rest[i]);
        stretch(&s, 1.1f, s.positions);
        hair_test_skinned_set(test, &s);
        hair_test_ok(test, hair_reset(s.hair));
        for (int stepped = 0; stepped < 2; ++stepped) {
            for (int i = 0; i < 3; ++i) hair_test_read_points(test, s.hair, (hair_read_source)i, &now[i]);
            const uint32_t each[3] = {10, 2 * 9 + 1, HAIR_TEST_SCALP_SEGMENTS + 1};
            for (int i = 0; i < 3; ++i)
                for (uint32_t k = 0; k < now[i].count / each[i]; ++k)
                    for (uint32_t c = 0; c < 3; ++c)
                        hair_test_near("root", k, (double)now[i].at[3 * k * each[i] + c],
                                       1.1 * (double)rest[i].at[3 * k * each[i] + c], 1e-6);
            if (stepped) break;
            for (uint32_t k = 0; k < 3 * now[0].count; ++k) {
                uint32_t root = k / 30 * 30 + k % 3;
                hair_test_near("guide", k, (double)(now[0].at[k] - now[0].at[root]),
                               (double)(rest[0].at[k] - rest[0].at[root]), 1e-6);
            }
            for (int i = 0; i < 5; ++i) hair_test_ok(test, hair_step(s.hair, STEP));
        }
        hair_destroy(s.hair);
    }
}

// Instances of a groom share their followers, but not those whose roots move.
static void scalp_of_one_instance_moves_no_other(void** state)
{
    struct hair_test* test = *state;
    static struct hair_test_points rest, own, now;
    struct hair_test_skinned s = hair_test_skinned_make(test, HAIR_SOLVER_DIRECT, HAIR_THREAD_MAPPING_AUTO);
    hair_instance* other = NULL;
    hair_desc desc = hair_desc_default();
    desc.look = &s.hair->geometry.look;
    hair_test_ok(test, hair_create(test->context, s.hair->groom, &desc, &other));
    hair_test_read_points(test, other, HAIR_READ_FOLLOWERS, &rest);
    stretch(&s, 1.2f, s.positions);
    hair_test_skinned_set(test, &s);
    hair_test_ok(test, hair_reset(s.hair));
    hair_test_read_points(test, s.hair, HAIR_READ_FOLLOWERS, &own);
    hair_test_ok(test, hair_reset(other));
    hair_test_read_points(test, other, HAIR_READ_FOLLOWERS, &now);
    assert_true(hair_test_points_distance(&rest, &own) > 0.01);
    assert_memory_equal(rest.at, now.at, 3 * rest.count * sizeof *rest.at);
    hair_destroy(s.hair);
    hair_test_ok(test, hair_reset(other));
    hair_test_read_points(test, other, HAIR_READ_FOLLOWERS, &now);
    assert_memory_equal(rest.at, now.at, 3 * rest.count * sizeof *rest.at);
    hair_destroy(other);
}

// Check a scalp that is passed in a moving space, far away or near. The head sees no difference.
static void scalp_far_from_the_origin_moves_hair_equally(void** state)
{
    struct hair_test* test = *state;
    static struct hair_test_points a, b;
    struct hair_test_skinned near =
                                 hair_test_skinned_make(test, HAIR_SOLVER_DIRECT, HAIR_THREAD_MAPPING_AUTO),
                             far = hair_test_skinned_make(test, HAIR_SOLVER_DIRECT, HAIR_THREAD_MAPPING_AUTO);
    float m[16] = {0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 4096, -2048, 512, 1}, own[16];
    float away[16];
    memcpy(away, m, sizeof m);
    hair_physics physics = hair_physics_default();
    physics.gravity[1] = 0; // Gravity has a fixed direction in the world.
    hair_test_ok(test, hair_set_physics(near.hair, &physics));
    hair_test_ok(test, hair_set_physics(far.hair, &physics));
    hair_test_ok(test, hair_teleport(far.hair, m));
    for (int frame = 1; frame <= 8; ++frame) {
        if (frame == 5) {
            away[12] += 1024;
            hair_test_ok(test, hair_teleport(far.hair, away));
        }
        hair_test_skinned_bulge(&near, STEP * (float)frame);
        hair_test_skinned_set(test, &near);
        hair_test_ok(test, hair_set_scalp(far.hair, near.positions, HAIR_TEST_SCALP_VERTICES, 12, away));
        hair_test_ok(test, hair_step(near.hair, STEP));
        hair_test_ok(test, hair_step(far.hair, STEP));
    }
    hair_test_read_points(test, near.hair, HAIR_READ_FOLLOWERS, &a);
    hair_test_read_points(test, far.hair, HAIR_READ_FOLLOWERS, &b);
    // Moves positions back to the other instance. Floats at 5 km are spaced by 0.5 mm.
    for (uint32_t i = 0; i < b.count; ++i) {
        hair_vec3 p = hair_sub(hair_load3(b.at + 3 * i), hair_v3(away[12], away[13], away[14]));
        hair_store3(b.at + 3 * i, hair_v3(p.y, -p.x, p.z));
    }
    double apart = hair_test_points_distance(&a, &b);
    if (!(apart < 4e-3)) fail_msg("%g m apart", apart);
    memcpy(own, m, sizeof own);
    hair_destroy(near.hair), hair_destroy(far.hair);
}

int main(void)
{
    if (hair_test_skips()) return 0;
    const struct CMUnitTest tests[] = {
        HAIR_TEST(rigidly_moved_scalp_equals_a_moved_head),
        HAIR_TEST(rigid_scalp_equals_a_head_when_substeps_change),
        HAIR_TEST(scalp_at_rest_in_a_moving_head_changes_nothing),
        HAIR_TEST(scalp_far_from_the_head_meets_colliders_there),
        HAIR_TEST(stretched_scalp_takes_every_root_along),
        HAIR_TEST(scalp_of_one_instance_moves_no_other),
        HAIR_TEST(scalp_far_from_the_origin_moves_hair_equally),
    };
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
