// instance_test.c - one head of hair as an application uses it: reset, teleported, far away, beside
// others.
#include "tests/support/scene.h"
#include "tests/support/support.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "lib/base/math.h"
#include "tests/support/ways.h"

#define MAX 4096

static int way; // Solver and mapping. main runs all tests for each.

struct strands {
    float positions[3 * MAX];
    uint32_t vertices;
};

static void identity(float out[16])
{
    for (int i = 0; i < 16; ++i) out[i] = i % 5 == 0;
}

// Make a rotation about the y axis and a translation.
static void pose(float angle, float x, float y, float z, float out[16])
{
    identity(out);
    out[0] = out[10] = cosf(angle);
    out[2] = -sinf(angle), out[8] = sinf(angle);
    out[12] = x, out[13] = y, out[14] = z;
}

static hair_groom* make_groom(struct hair_test* test)
{
    return hair_test_groom(&test->host.host, hair_test_handmade_default());
}

static hair_instance* make(struct hair_test* test, const hair_groom* groom)
{
    hair_instance* hair = NULL;
    hair_desc desc = hair_test_way(way);
    hair_test_ok(test, hair_create(test->context, groom, &desc, &hair));
    return hair;
}

static void read(struct hair_test* test, hair_instance* hair, hair_read_source what, struct strands* out)
{
    hair_test_ok(test, hair_read_positions(hair, what, out->positions, MAX, &out->vertices));
    assert_in_range(out->vertices, 1, MAX);
}

// Swing the head to and fro around x, for `steps` steps of 1/60 s.
static void swing(struct hair_test* test, hair_instance* hair, float x, int steps)
{
    float transform[16];
    for (int i = 0; i < steps; ++i) {
        pose(0.5f * sinf(0.3f * (float)i), x + 0.05f * sinf(0.4f * (float)i), 0, 0, transform);
        hair_test_ok(test, hair_set_transform(hair, transform));
        hair_test_ok(test, hair_step(hair, 1.0f / 60));
    }
}

static void a_new_instance_is_in_its_rest_pose(void** state)
{
    static struct strands strands;
    struct hair_test* test = *state;
    hair_groom* groom = make_groom(test);
    hair_instance* hair = make(test, groom);
    read(test, hair, HAIR_READ_GUIDES, &strands);
    assert_int_equal(strands.vertices, groom->info.guide_vertex_count);
    for (uint32_t i = 0; i < strands.vertices; ++i) {
        hair_test_near("x", i, strands.positions[3 * i], groom->rest[i].position.x, 1e-7);
        hair_test_near("y", i, strands.positions[3 * i + 1], groom->rest[i].position.y, 1e-7);
        hair_test_near("z", i, strands.positions[3 * i + 2], groom->rest[i].position.z, 1e-7);
    }
    hair_destroy(hair);
    hair_groom_destroy(groom);
}

static void reset_instance_equals_a_new_instance(void** state)
{
    static struct strands used, fresh;
    static const hair_read_source whats[] = {HAIR_READ_GUIDES, HAIR_READ_SMOOTH};
    struct hair_test* test = *state;
    hair_groom* groom = make_groom(test);
    hair_instance* hair = make(test, groom);
    hair_instance* other = make(test, groom);
    float back[16];
    swing(test, hair, 0, 10);
    hair_test_ok(test, hair_step(hair, 0.003f));
    identity(back);
    hair_test_ok(test, hair_set_transform(hair, back));
    hair_test_ok(test, hair_reset(hair));
    for (int steps = 0; steps < 3; ++steps) {
        for (int i = 0; i < 2; ++i) {
            read(test, hair, whats[i], &used);
            read(test, other, whats[i], &fresh);
            assert_memory_equal(used.positions, fresh.positions, 12 * fresh.vertices);
        }
        hair_test_ok(test, hair_step(hair, 1.0f / 60));
        hair_test_ok(test, hair_step(other, 1.0f / 60));
    }
    hair_destroy(hair);
    hair_destroy(other);
    hair_groom_destroy(groom);
}

// Convert a point from the world to the head's coordinates: translate by the negative position, and
// rotate back.
static void to_head(const float transform[16], const float* p, float out[3])
{
    float d[3] = {p[0] - transform[12], p[1] - transform[13], p[2] - transform[14]};
    for (int k = 0; k < 3; ++k)
        out[k] = transform[4 * k] * d[0] + transform[4 * k + 1] * d[1] + transform[4 * k + 2] * d[2];
}

static void compare_in_heads(const struct strands* a, const float at_a[16], const struct strands* b,
                             const float at_b[16], double tolerance)
{
    assert_int_equal(a->vertices, b->vertices);
    for (uint32_t i = 0; i < a->vertices; ++i) {
        float pa[3], pb[3];
        to_head(at_a, a->positions + 3 * i, pa);
        to_head(at_b, b->positions + 3 * i, pb);
        for (int k = 0; k < 3; ++k) hair_test_near("vertex", i, pa[k], pb[k], tolerance);
    }
}

static void teleport_keeps_shape_and_motion(void** state)
{
    static struct strands before, after;
    static const hair_read_source whats[] = {HAIR_READ_GUIDES, HAIR_READ_SMOOTH, HAIR_READ_FOLLOWERS};
    struct hair_test* test = *state;
    hair_groom* groom = make_groom(test);
    hair_instance* hair = make(test, groom);
    hair_instance* other = make(test, groom);
    hair_look look = hair_look_default();
    hair_physics still = hair_physics_default();
    float here[16], there[16];
    look.strand.segments = 8;
    // Gravity has a fixed direction in the world. Without gravity, all rotations of the world are
    // equivalent.
    memset(still.gravity, 0, sizeof still.gravity);
    for (int i = 0; i < 2; ++i) {
        hair_test_ok(test, hair_set_look(i ? other : hair, &look));
        hair_test_ok(test, hair_set_physics(i ? other : hair, &still));
        swing(test, i ? other : hair, 0, 12);
        // The time is between two ends of substeps.
        hair_test_ok(test, hair_step(i ? other : hair, 0.003f));
    }
    pose(0.5f * sinf(3.3f), 0.05f * sinf(4.4f), 0, 0, here); // The head's pose after swing().
    pose(2.5f, 3, -1, 2, there);
    hair_test_ok(test, hair_teleport(hair, there));
    for (int steps = 0; steps < 5; ++steps) {
        for (int i = 0; i < 3; ++i) {
            read(test, other, whats[i], &before);
            read(test, hair, whats[i], &after);
            compare_in_heads(&before, here, &after, there, hair_test_way_rounding(way));
        }
        // The teleport must not add motion.
        hair_test_ok(test, hair_step(other, 1.0f / 60));
        hair_test_ok(test, hair_step(hair, 1.0f / 60));
    }
    hair_destroy(hair);
    hair_destroy(other);
    hair_groom_destroy(groom);
}

static void set_transform_far_away_is_no_teleport(void** state)
{
    static struct strands strands;
    struct hair_test* test = *state;
    hair_groom* groom = make_groom(test);
    hair_instance* hair = make(test, groom);
    float there[16];
    pose(0, 0.5f, 0, 0, there);
    hair_test_ok(test, hair_set_transform(hair, there));
    hair_test_ok(test, hair_step(hair, 1.0f / 60));
    read(test, hair, HAIR_READ_GUIDES, &strands);
    uint32_t tip = groom->guides[0].count - 1;
    hair_test_near("root", 0, strands.positions[0], groom->rest[0].position.x + 0.5, 1e-6);
    // The tip lags behind.
    assert_true(strands.positions[3 * tip] < groom->rest[tip].position.x + 0.45f);
    hair_destroy(hair);
    hair_groom_destroy(groom);
}

static void strands_rest_on_a_collider_moved_into_them(void** state)
{
    static struct strands strands;
    struct hair_test* test = *state;
    hair_groom* groom = make_groom(test);
    hair_instance* hair = make(test, groom);
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
    read(test, hair, HAIR_READ_GUIDES, &strands);
    double touching = 0;
    for (uint32_t g = 0; g < groom->info.guide_count; ++g)
        for (uint32_t i = 2; i < groom->guides[g].count; ++i) {
            const float* p = strands.positions + 3 * (groom->guides[g].first + i);
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

// Return the maximum relative stretch or compression of a guide's segment. It is measured in the
// state, because floats of the world are spaced by millimetres out there.
static double greatest_stretch(hair_instance* hair, const hair_groom* groom)
{
    static struct hair_state state[MAX];
    double worst = 0;
    glGetNamedBufferSubData(hair->sim.state, 0, groom->info.guide_vertex_count * sizeof *state, state);
    for (uint32_t g = 0; g < groom->info.guide_count; ++g)
        for (uint32_t i = groom->guides[g].first; i + 1 < groom->guides[g].first + groom->guides[g].count;
             ++i) {
            hair_vec4 a = state[i].position, b = state[i + 1].position;
            double length = hair_distance(hair_v3(a.x, a.y, a.z), hair_v3(b.x, b.y, b.z));
            worst = fmax(worst, fabs(length / groom->rest[i].position.w - 1));
        }
    return worst;
}

static void stretch_far_from_the_origin_is_not_greater(void** state)
{
    struct hair_test* test = *state;
    hair_groom* groom = make_groom(test);
    double stretch[2];
    for (int far = 0; far < 2; ++far) {
        hair_instance* hair = make(test, groom);
        float there[16];
        pose(0, far ? 1e5f : 0, 0, 0, there);
        hair_test_ok(test, hair_teleport(hair, there));
        swing(test, hair, far ? 1e5f : 0, 60);
        stretch[far] = greatest_stretch(hair, groom);
        hair_destroy(hair);
    }
    print_message("    stretch %.4f at the origin, %.4f at 1e5 m\n", stretch[0], stretch[1]);
    // Floats at 1e5 m are spaced by 8 mm, so the head itself jerks by 8 mm.
    assert_true(stretch[1] <= stretch[0] + 0.02);
    hair_groom_destroy(groom);
}

// Check that a head at rest far away gives the same bits as at the origin, because positions are
// relative to the head.
static void still_head_far_from_the_origin_gives_equal_bits(void** state)
{
    static struct hair_state near[MAX], far[MAX];
    struct hair_test* test = *state;
    hair_groom* groom = make_groom(test);
    size_t size = groom->info.guide_vertex_count * sizeof *near;
    for (int out = 0; out < 2; ++out) {
        hair_instance* hair = NULL;
        hair_desc desc = hair_test_way(way);
        hair_collider collider = {HAIR_SHAPE_SPHERE, {out ? 1e5f : 0, 0, 0}, {0, 0, 0, 1}, {0.095f, 0},
                                  .scale = 1,        .friction = 1};
        desc.transform[12] = out ? 1e5f : 0;
        hair_test_ok(test, hair_create(test->context, groom, &desc, &hair));
        hair_test_ok(test, hair_set_colliders(hair, &collider, 1, sizeof collider));
        for (int i = 0; i < 30; ++i) hair_test_ok(test, hair_step(hair, 1.0f / 60));
        glGetNamedBufferSubData(hair->sim.state, 0, (GLsizeiptr)size, out ? far : near);
        hair_destroy(hair);
    }
    assert_memory_equal(near, far, size);
    hair_groom_destroy(groom);
}

static void draw(struct hair_test* test, hair_instance* hair, const struct hair_test_frame* frame,
                 float* pixels)
{
    hair_view view = hair_view_default();
    view.primitive = HAIR_PRIMITIVE_LINES; // Ribbons are much narrower than these pixels.
    // The view is 0.8 m wide around the head, along -z.
    hair_test_set_orthographic(&view, 2.5f, -0.5f, -0.3f);
    hair_test_draw_in(frame, test, hair, &view, pixels);
}

#define SIDE 64

static void instances_do_not_affect_each_other(void** state)
{
    static struct strands alone[2], beside[2];
    static float seen_alone[2][4 * SIDE * SIDE], seen_beside[2][4 * SIDE * SIDE];
    struct hair_test* test = *state;
    hair_groom* groom = make_groom(test);
    hair_collider collider = {HAIR_SHAPE_SPHERE, {0.1f, 0.2f, 0}, {0, 0, 0, 1},
                              {0.05f, 0},        .scale = 1,      .friction = 1};
    hair_instance* hair[2];
    struct hair_test_frame frame;
    hair_test_frame_make(&frame, SIDE, SIDE, GL_RGBA32F, 0);
    for (int i = 0; i < 2; ++i) {
        hair[i] = make(test, groom);
        if (i) hair_test_ok(test, hair_set_colliders(hair[i], &collider, 1, sizeof collider));
        for (int n = 0; n < 20; ++n) hair_test_ok(test, hair_step(hair[i], i ? 1.0f / 60 : 1.0f / 40));
        read(test, hair[i], HAIR_READ_SMOOTH, &alone[i]);
        draw(test, hair[i], &frame, seen_alone[i]);
        hair_destroy(hair[i]);
    }
    for (int i = 0; i < 2; ++i) hair[i] = make(test, groom);
    hair_test_ok(test, hair_set_colliders(hair[1], &collider, 1, sizeof collider));
    for (int n = 0; n < 20; ++n)
        for (int i = 0; i < 2; ++i) {
            hair_test_ok(test, hair_step(hair[i], i ? 1.0f / 60 : 1.0f / 40));
            draw(test, hair[1 - i], &frame, seen_beside[1 - i]);
        }
    for (int i = 0; i < 2; ++i) {
        read(test, hair[i], HAIR_READ_SMOOTH, &beside[i]);
        draw(test, hair[i], &frame, seen_beside[i]);
        assert_memory_equal(alone[i].positions, beside[i].positions, 12 * alone[i].vertices);
        assert_memory_equal(seen_alone[i], seen_beside[i], sizeof seen_alone[i]);
        hair_destroy(hair[i]);
    }
    assert_memory_not_equal(alone[0].positions, alone[1].positions, 12 * alone[0].vertices);
    int covered = 0;
    for (int i = 0; i < SIDE * SIDE; ++i) covered += seen_alone[0][4 * i + 3] > 0;
    assert_true(covered > 50);
    hair_test_frame_free(&frame);
    hair_groom_destroy(groom);
}

static void the_groom_may_be_destroyed_while_instances_use_it(void** state)
{
    static struct strands kept, gone;
    struct hair_test* test = *state;
    hair_groom* groom = make_groom(test);
    hair_instance* hair = make(test, groom);
    hair_instance* other = make(test, groom);
    swing(test, hair, 0, 5);
    hair_groom_destroy(groom);
    swing(test, other, 0, 5);
    read(test, hair, HAIR_READ_FOLLOWERS, &kept);
    read(test, other, HAIR_READ_FOLLOWERS, &gone);
    assert_memory_equal(kept.positions, gone.positions, 12 * kept.vertices);
    hair_destroy(hair);
    hair_destroy(other);
}

// Check that every vertex is finite after any call of the application.
static void strands_stay_finite_under_any_calls(void** state)
{
    static struct strands strands;
    struct hair_test* test = *state;
    hair_groom* groom = make_groom(test);
    hair_instance* hair = make(test, groom);
    uint32_t random = 7;
    for (int i = 0; i < 100; ++i) {
        hair_physics physics = hair_physics_default();
        float there[16], far = powf(10, 8 * hair_random(&random) - 2);
        pose(6.28f * hair_random(&random), far, -far, 0, there);
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
            read(test, hair, (hair_read_source)what, &strands);
            for (uint32_t k = 0; k < 3 * strands.vertices; ++k) assert_true(isfinite(strands.positions[k]));
        }
    }
    hair_destroy(hair);
    hair_groom_destroy(groom);
}

// Check that hair follows the head over any distance in one step, wherever in a substep the step
// ends.
static void head_that_jumps_1000_km_keeps_its_hair(void** state)
{
    static struct strands strands;
    struct hair_test* test = *state;
    hair_groom* groom = make_groom(test);
    hair_instance* hair = make(test, groom);
    const float far[] = {1e6f, 0, 1e9f, -1e9f, 0};
    for (size_t i = 0; i < sizeof far / sizeof *far; ++i) {
        float there[16];
        pose(0, 0, far[i], 0, there);
        hair_test_ok(test, hair_set_transform(hair, there));
        hair_test_ok(test, hair_step(hair, 0.013f));
        read(test, hair, HAIR_READ_SMOOTH, &strands);
        for (uint32_t k = 0; k < strands.vertices; ++k) {
            hair_test_near("x", k, strands.positions[3 * k], 0, 1);
            hair_test_near("y", k, strands.positions[3 * k + 1], far[i], 1);
        }
    }
    hair_destroy(hair);
    hair_groom_destroy(groom);
}

// Check a step that is a small part of a substep and ends the substep. Colliders must be at their
// last positions, and not beyond.
static void tiny_step_moves_no_collider_too_far(void** state)
{
    static struct strands before, after;
    struct hair_test* test = *state;
    hair_groom* groom = make_groom(test);
    hair_instance* hair = make(test, groom);
    hair_physics physics = hair_physics_default();
    memset(physics.gravity, 0, sizeof physics.gravity);
    hair_test_ok(test, hair_set_physics(hair, &physics));
    hair_collider collider = {HAIR_SHAPE_SPHERE, {0, 3, 0}, {0, 0, 0, 1}, {1, 0}, .scale = 1, .friction = 1};
    hair_test_ok(test, hair_set_colliders(hair, &collider, 1, sizeof collider));
    hair_test_ok(test, hair_step(hair, (float)((1 - 3e-6) / 120)));
    read(test, hair, HAIR_READ_GUIDES, &before);
    for (int i = 0; i < 110; ++i) {
        // The last height is 1.4 m, where the collider touches no hair.
        collider.position[1] -= 0.0145f;
        hair_test_ok(test, hair_set_colliders(hair, &collider, 1, sizeof collider));
        hair_test_ok(test, hair_step(hair, 2e-8f / 120));
        read(test, hair, HAIR_READ_GUIDES, &after);
        for (uint32_t k = 0; k < 3 * after.vertices; ++k)
            hair_test_near("position", k, after.positions[k], before.positions[k], 1e-3);
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
        HAIR_TEST(teleport_keeps_shape_and_motion),
        HAIR_TEST(set_transform_far_away_is_no_teleport),
        HAIR_TEST(strands_rest_on_a_collider_moved_into_them),
        HAIR_TEST(stretch_far_from_the_origin_is_not_greater),
        HAIR_TEST(still_head_far_from_the_origin_gives_equal_bits),
        HAIR_TEST(instances_do_not_affect_each_other),
        HAIR_TEST(the_groom_may_be_destroyed_while_instances_use_it),
        HAIR_TEST(head_that_jumps_1000_km_keeps_its_hair),
        HAIR_TEST(tiny_step_moves_no_collider_too_far),
        HAIR_TEST(strands_stay_finite_under_any_calls),
    };
    int failed = 0;
    for (way = 0; way < HAIR_TEST_WAYS; ++way)
        failed +=
            cmocka_run_group_tests_name(hair_test_way_name(way), tests, hair_test_start, hair_test_finish);
    return failed;
}
