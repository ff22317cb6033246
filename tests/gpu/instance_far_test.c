// instance_far_test.c - one head of hair that is teleported, jumps, or is far from the origin.
#include "tests/support/instances.h"

#include <math.h>
#include <string.h>

#include "lib/base/math.h"
#include "tests/support/ways.h"

#define MAX 4096

// Convert a point from the world to the head's coordinates: translate by the negative position, and
// rotate back.
static void to_head(const float transform[16], const float* p, float out[3])
{
    float d[3] = {p[0] - transform[12], p[1] - transform[13], p[2] - transform[14]};
    for (int k = 0; k < 3; ++k)
        out[k] = transform[4 * k] * d[0] + transform[4 * k + 1] * d[1] + transform[4 * k + 2] * d[2];
}

static void compare_in_heads(const struct hair_test_points* a, const float at_a[16],
                             const struct hair_test_points* b, const float at_b[16], double tolerance)
{
    assert_int_equal(a->count, b->count);
    for (uint32_t i = 0; i < a->count; ++i) {
        float pa[3], pb[3];
        to_head(at_a, a->at + 3 * i, pa);
        to_head(at_b, b->at + 3 * i, pb);
        for (int k = 0; k < 3; ++k) hair_test_near("vertex", i, pa[k], pb[k], tolerance);
    }
}

static void teleport_keeps_shape_and_motion(void** state)
{
    static struct hair_test_points before, after;
    static const hair_read_source whats[] = {HAIR_READ_GUIDES, HAIR_READ_SMOOTH, HAIR_READ_FOLLOWERS};
    struct hair_test* test = *state;
    hair_groom* groom = hair_test_groom(&test->host.host, hair_test_handmade_default());
    hair_instance* hair = hair_test_instance_make(test, groom);
    hair_instance* other = hair_test_instance_make(test, groom);
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
        hair_test_instance_swing(test, i ? other : hair, 0, 12);
        // The time is between two ends of substeps.
        hair_test_ok(test, hair_step(i ? other : hair, 0.003f));
    }
    hair_test_set_pose(0.5f * sinf(3.3f), 0.05f * sinf(4.4f), 0, 0,
                       here); // The head's pose after hair_test_instance_swing().
    hair_test_set_pose(2.5f, 3, -1, 2, there);
    hair_test_ok(test, hair_teleport(hair, there));
    for (int steps = 0; steps < 5; ++steps) {
        for (int i = 0; i < 3; ++i) {
            hair_test_read_points(test, other, whats[i], &before);
            hair_test_read_points(test, hair, whats[i], &after);
            compare_in_heads(&before, here, &after, there, hair_test_way_rounding(hair_test_instance_way));
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
    static struct hair_test_points strands;
    struct hair_test* test = *state;
    hair_groom* groom = hair_test_groom(&test->host.host, hair_test_handmade_default());
    hair_instance* hair = hair_test_instance_make(test, groom);
    float there[16];
    hair_test_set_pose(0, 0.5f, 0, 0, there);
    hair_test_ok(test, hair_set_transform(hair, there));
    hair_test_ok(test, hair_step(hair, 1.0f / 60));
    hair_test_read_points(test, hair, HAIR_READ_GUIDES, &strands);
    uint32_t tip = groom->guides[0].count - 1;
    hair_test_near("root", 0, strands.at[0], groom->rest[0].position.x + 0.5, 1e-6);
    // The tip lags behind.
    assert_true(strands.at[3 * tip] < groom->rest[tip].position.x + 0.45f);
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
    hair_groom* groom = hair_test_groom(&test->host.host, hair_test_handmade_default());
    double stretch[2];
    for (int far = 0; far < 2; ++far) {
        hair_instance* hair = hair_test_instance_make(test, groom);
        float there[16];
        hair_test_set_pose(0, far ? 1e5f : 0, 0, 0, there);
        hair_test_ok(test, hair_teleport(hair, there));
        hair_test_instance_swing(test, hair, far ? 1e5f : 0, 60);
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
    hair_groom* groom = hair_test_groom(&test->host.host, hair_test_handmade_default());
    size_t size = groom->info.guide_vertex_count * sizeof *near;
    for (int out = 0; out < 2; ++out) {
        hair_instance* hair = NULL;
        hair_desc desc = hair_test_way(hair_test_instance_way);
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

// Check that hair follows the head over any distance in one step, wherever in a substep the step
// ends.
static void head_that_jumps_1000_km_keeps_its_hair(void** state)
{
    static struct hair_test_points strands;
    struct hair_test* test = *state;
    hair_groom* groom = hair_test_groom(&test->host.host, hair_test_handmade_default());
    hair_instance* hair = hair_test_instance_make(test, groom);
    const float far[] = {1e6f, 0, 1e9f, -1e9f, 0};
    for (size_t i = 0; i < sizeof far / sizeof *far; ++i) {
        float there[16];
        hair_test_set_pose(0, 0, far[i], 0, there);
        hair_test_ok(test, hair_set_transform(hair, there));
        hair_test_ok(test, hair_step(hair, 0.013f));
        hair_test_read_points(test, hair, HAIR_READ_SMOOTH, &strands);
        for (uint32_t k = 0; k < strands.count; ++k) {
            hair_test_near("x", k, strands.at[3 * k], 0, 1);
            hair_test_near("y", k, strands.at[3 * k + 1], far[i], 1);
        }
    }
    hair_destroy(hair);
    hair_groom_destroy(groom);
}

int main(void)
{
    if (hair_test_skips()) return 0;
    const struct CMUnitTest tests[] = {
        HAIR_TEST(teleport_keeps_shape_and_motion),
        HAIR_TEST(set_transform_far_away_is_no_teleport),
        HAIR_TEST(stretch_far_from_the_origin_is_not_greater),
        HAIR_TEST(still_head_far_from_the_origin_gives_equal_bits),
        HAIR_TEST(head_that_jumps_1000_km_keeps_its_hair),
    };
    return hair_test_run_every_way(tests, sizeof tests / sizeof *tests);
}
