// scalp_joints_test.c - a scalp that the library skins by the joints of the application.
#include "tests/support/skinned.h"

#include <math.h>
#include <string.h>

#include "lib/api/api.h"
#include "tests/reference/reference.h"
#include "tests/support/glstate.h"
#include "tests/support/passes.h"

#define STEP (1.0f / 30)
#define VERTICES HAIR_TEST_SCALP_VERTICES
#define JOINTS 7

// Joints of the test scalp. The last one is stretched and sheared.
struct rig {
    uint16_t joints[4 * VERTICES];
    float weights[4 * VERTICES];
    float matrices[16 * JOINTS];
};

static struct rig make_rig(void)
{
    struct rig rig;
    uint32_t random = 5;
    for (int i = 0; i < VERTICES; ++i) {
        float sum = 0, *weights = rig.weights + 4 * i;
        for (int k = 0; k < 4; ++k) {
            rig.joints[4 * i + k] = (uint16_t)(hair_random(&random) * JOINTS);
            weights[k] = k < 1 + i % 4 ? 0.1f + hair_random(&random) : 0;
            sum += weights[k];
        }
        // Weights that are rounded do not have the sum 1 exactly.
        for (int k = 0; k < 4; ++k) weights[k] = roundf(255 * weights[k] / sum) / 255;
    }
    return rig;
}

static void pose_joints(struct rig* rig, float time)
{
    for (int j = 0; j < JOINTS; ++j) {
        float angle = 0.3f * sinf(3 * time + (float)j), c = cosf(angle), s = sinf(angle);
        float shear = j == JOINTS - 1 ? 0.2f * time : 0;
        float m[16] = {c, s, 0, 0, -s, c, 0, 0, 0, shear, 1 + shear, 0, 0.2f * time, 0.02f * (float)j * time,
                       0, 1};
        memcpy(rig->matrices + 16 * j, m, sizeof m);
    }
}

static void set_weights(struct hair_test* test, hair_instance* hair, const struct rig* rig)
{
    hair_test_ok(test, hair_set_scalp_weights(hair, rig->joints, rig->weights, VERTICES, JOINTS));
}

static struct hair_test_skinned make(struct hair_test* test)
{
    return hair_test_skinned_make(test, HAIR_SOLVER_DIRECT, HAIR_THREAD_MAPPING_AUTO);
}

// Skin the positions by the reference.
static void skin(const struct rig* rig, struct hair_test_skinned* s)
{
    for (int i = 0; i < VERTICES; ++i) {
        double at[3];
        hair_reference_skin(s->rest + 3 * i, rig->joints + 4 * i, rig->weights + 4 * i, rig->matrices, at);
        for (int k = 0; k < 3; ++k) s->positions[3 * i + k] = (float)at[k];
    }
}

// Return the maximum distance between the scalp on the GPU and the positions.
static double scalp_error(const struct hair_test_skinned* s)
{
    float got[3 * VERTICES];
    double max = 0;
    glGetNamedBufferSubData(s->hair->sim.scalp_motion.scalp[1], 0, sizeof got, got);
    for (int i = 0; i < 3 * VERTICES; ++i) max = fmax(max, fabs((double)got[i] - (double)s->positions[i]));
    return max;
}

static void scalp_of_joints_equals_scalp_skinned_by_the_reference(void** state)
{
    struct hair_test* test = *state;
    static struct hair_test_points a, b;
    struct hair_test_skinned gpu = make(test), cpu = make(test);
    struct rig rig = make_rig();
    float to_world[16] = {0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 0.5f, 0.25f, 0, 1};
    double error = 0, apart = 0, moved = 0;
    set_weights(test, gpu.hair, &rig);
    for (int frame = 1; frame <= 9; ++frame) {
        const float* space = frame > 5 ? to_world : NULL;
        pose_joints(&rig, STEP * (float)frame);
        skin(&rig, &cpu);
        memcpy(gpu.positions, cpu.positions, sizeof gpu.positions);
        hair_test_ok(test, hair_set_scalp_joints(gpu.hair, rig.matrices, JOINTS, space));
        hair_test_ok(test, hair_set_scalp(cpu.hair, cpu.positions, VERTICES, 12, space));
        error = fmax(error, scalp_error(&gpu));
        hair_test_ok(test, hair_step(gpu.hair, STEP));
        hair_test_ok(test, hair_step(cpu.hair, STEP));
        for (int source = 0; source < 2; ++source) {
            hair_read_source from = source ? HAIR_READ_FOLLOWERS : HAIR_READ_GUIDES;
            hair_test_read_points(test, gpu.hair, from, &a);
            hair_test_read_points(test, cpu.hair, from, &b);
            apart = fmax(apart, hair_test_points_distance(&a, &b));
        }
    }
    for (int i = 0; i < 3 * VERTICES; ++i)
        moved = fmax(moved, fabs((double)(cpu.positions[i] - cpu.rest[i])));
    print_message("    scalp within %.2g m and hair within %.2g m, in %.2g m of motion\n", error, apart,
                  moved);
    assert_true(moved > 0.03 && error < 1e-7 && apart < 1e-4);
    hair_destroy(gpu.hair), hair_destroy(cpu.hair);
}

static void joints_in_their_bind_pose_equal_the_scalp_at_rest(void** state)
{
    struct hair_test* test = *state;
    static struct hair_test_points a, b;
    struct hair_test_skinned joints = make(test), rest = make(test);
    struct rig rig = make_rig();
    memset(rig.matrices, 0, sizeof rig.matrices);
    for (int i = 0; i < 4 * JOINTS; ++i) rig.matrices[16 * (i / 4) + 5 * (i % 4)] = 1;
    set_weights(test, joints.hair, &rig);
    for (int frame = 0; frame < 4; ++frame) {
        hair_test_ok(test, hair_set_scalp_joints(joints.hair, rig.matrices, JOINTS, NULL));
        hair_test_ok(test, hair_set_scalp(rest.hair, rest.rest, VERTICES, 12, NULL));
        assert_true(scalp_error(&joints) == 0);
        hair_test_ok(test, hair_step(joints.hair, STEP));
        hair_test_ok(test, hair_step(rest.hair, STEP));
        hair_test_read_points(test, joints.hair, HAIR_READ_FOLLOWERS, &a);
        hair_test_read_points(test, rest.hair, HAIR_READ_FOLLOWERS, &b);
        assert_memory_equal(a.at, b.at, 12 * a.count);
    }
    hair_destroy(joints.hair), hair_destroy(rest.hair);
}

static void invalid_joints_are_refused_by_name_value_and_range(void** state)
{
    struct hair_test* test = *state;
    struct hair_test_skinned s = make(test);
    hair_instance* h = s.hair;
    hair_result bad = HAIR_ERROR_ARGUMENT;
    struct rig rig = make_rig();
    float *w = rig.weights, *m = rig.matrices, kept[4];
    uint16_t* j = rig.joints;
    pose_joints(&rig, 1);
    memcpy(kept, w + 8, sizeof kept);
    assert_int_equal(hair_set_scalp_weights(NULL, j, w, VERTICES, JOINTS), bad);
    assert_int_equal(hair_set_scalp_joints(NULL, m, JOINTS, NULL), bad);
    hair_test_refused(test, hair_set_scalp_joints(h, m, JOINTS, NULL), bad, "the scalp has no joints");
    hair_test_refused(test, hair_set_scalp_weights(h, NULL, w, 0, 0), bad, "joints is NULL, but");
    hair_test_refused(test, hair_set_scalp_weights(h, j, NULL, VERTICES, JOINTS), bad, "weights is NULL");
    hair_test_refused(test, hair_set_scalp_weights(h, j, w, 24, JOINTS), bad,
                      "vertex_count is 24, not the 25 of the groom's scalp");
    hair_test_refused(test, hair_set_scalp_weights(h, j, w, VERTICES, 0), bad,
                      "joint_count is 0, not in [1, 65536]");
    hair_test_refused(test, hair_set_scalp_weights(h, j, w, VERTICES, 65537), bad, "joint_count is 65537");
    j[5] = JOINTS;
    hair_test_refused(test, hair_set_scalp_weights(h, j, w, VERTICES, JOINTS), bad,
                      "joints[5] is 7, not less than joint_count, 7");
    j[5] = 0;
    w[9] = NAN;
    hair_test_refused(test, hair_set_scalp_weights(h, j, w, VERTICES, JOINTS), bad, "weights[9] is ");
    w[9] = -0.5f;
    hair_test_refused(test, hair_set_scalp_weights(h, j, w, VERTICES, JOINTS), bad,
                      "weights[9] is -0.5, not in [0, 1]");
    w[8] = w[9] = w[10] = 1, w[11] = 0;
    hair_test_refused(test, hair_set_scalp_weights(h, j, w, VERTICES, JOINTS), bad,
                      "the sum of the weights of vertex 2 is 3, not in [0.99, 1.01]");
    memset(w + 8, 0, sizeof kept);
    hair_test_refused(test, hair_set_scalp_weights(h, j, w, VERTICES, JOINTS), bad, "of vertex 2 is 0");
    memcpy(w + 8, kept, sizeof kept);
    set_weights(test, h, &rig);
    hair_test_refused(test, hair_set_scalp_joints(h, NULL, JOINTS, NULL), bad, "matrices is NULL");
    hair_test_refused(test, hair_set_scalp_joints(h, m, 6, NULL), bad,
                      "joint_count is 6, not the 7 of hair_set_scalp_weights()");
    hair_test_refused(test, hair_set_scalp_joints(h, m, JOINTS, m + 16 * (JOINTS - 1)), bad,
                      "to_world is not a rigid motion");
    m[16 + 5] = INFINITY;
    hair_test_refused(test, hair_set_scalp_joints(h, m, JOINTS, NULL), bad,
                      "matrices: joint 1 has inf at 5, not in [-1e+09, 1e+09]");
    m[16 + 5] = 1, m[32 + 7] = 0.5f;
    hair_test_refused(test, hair_set_scalp_joints(h, m, JOINTS, NULL), bad,
                      "joint 2 has 0.5 at 7, not 0 as an affine matrix has");
    m[32 + 7] = 0, m[48 + 15] = 0;
    hair_test_refused(test, hair_set_scalp_joints(h, m, JOINTS, NULL), bad, "joint 3 has 0 at 15, not 1");
    hair_destroy(s.hair);
}

// Check the largest matrices that are accepted, and some that make all triangles points.
static void joints_of_any_size_keep_hair_finite(void** state)
{
    struct hair_test* test = *state;
    static struct hair_test_points seen;
    struct hair_test_skinned s = make(test);
    struct rig rig = make_rig();
    set_weights(test, s.hair, &rig);
    for (int frame = 0; frame < 6; ++frame) {
        pose_joints(&rig, STEP);
        for (int i = 0; i < 16 * JOINTS; ++i)
            if (i % 4 != 3) rig.matrices[i] = frame % 3 == 2 ? 0 : i % 3 && frame % 2 ? -1e9f : 1e9f;
        hair_test_ok(test, hair_set_scalp_joints(s.hair, rig.matrices, JOINTS, NULL));
        if (frame > 3) hair_test_ok(test, hair_reset(s.hair));
        hair_test_ok(test, hair_step(s.hair, STEP));
        hair_test_read_points(test, s.hair, HAIR_READ_GUIDES, &seen);
        hair_test_read_points(test, s.hair, HAIR_READ_FOLLOWERS, &seen);
    }
    hair_destroy(s.hair);
}

static void groom_without_a_scalp_refuses_joints(void** state)
{
    struct hair_test* test = *state;
    struct hair_test_strands strands = hair_test_fur(20);
    hair_groom_desc groom = hair_test_groom_desc(&test->host, &strands);
    hair_desc desc = hair_desc_default();
    hair_groom* plain = NULL;
    hair_instance* hair = NULL;
    struct rig rig = make_rig();
    hair_test_ok(test, hair_groom_create(&groom, &plain));
    hair_test_ok(test, hair_create(test->context, plain, &desc, &hair));
    hair_test_refused(test, hair_set_scalp_weights(hair, rig.joints, rig.weights, 25, JOINTS),
                      HAIR_ERROR_ARGUMENT, "its groom has no scalp");
    hair_test_refused(test, hair_set_scalp_joints(hair, rig.matrices, JOINTS, NULL), HAIR_ERROR_ARGUMENT,
                      "its groom has no scalp");
    hair_destroy(hair);
    hair_groom_destroy(plain);
    hair_test_strands_free(&strands);
}

static void run(struct hair_test* test, hair_instance* hair, struct rig* rig, int from, int to)
{
    for (int frame = from; frame < to; ++frame) {
        pose_joints(rig, STEP * (float)frame);
        hair_test_ok(test, hair_set_scalp_joints(hair, rig->matrices, JOINTS, NULL));
        hair_test_ok(test, hair_step(hair, frame % 3 ? STEP : 0.002f));
    }
}

// Save between joints and their step. Load into hair that has the joints of vertices, but has never
// had a pose of them.
static void saved_run_with_joints_continues_bit_for_bit(void** state)
{
    struct hair_test* test = *state;
    static struct hair_test_points straight, again;
    static char bytes[1 << 20];
    struct hair_test_skinned s = make(test), other = make(test);
    struct rig rig = make_rig();
    size_t size = 0;
    set_weights(test, s.hair, &rig);
    set_weights(test, other.hair, &rig);
    run(test, s.hair, &rig, 1, 7);
    pose_joints(&rig, 7 * STEP);
    hair_test_ok(test, hair_set_scalp_joints(s.hair, rig.matrices, JOINTS, NULL));
    hair_test_ok(test, hair_save(s.hair, bytes, sizeof bytes, &size));
    hair_test_ok(test, hair_load(other.hair, bytes, size));
    for (int k = 0; k < 2; ++k) {
        hair_instance* hair = k ? other.hair : s.hair;
        hair_test_ok(test, hair_step(hair, STEP));
        run(test, hair, &rig, 8, 11);
        hair_test_read_points(test, hair, HAIR_READ_FOLLOWERS, k ? &again : &straight);
    }
    assert_memory_equal(again.at, straight.at, 12 * again.count);
    hair_destroy(s.hair), hair_destroy(other.hair);
}

static void restored_context_keeps_the_joints_of_vertices(void** state)
{
    struct hair_test* test = *state;
    hair_context* shared = test->context;
    hair_context_desc desc = hair_context_desc_default();
    hair_egl* egl = NULL;
    struct rig rig = make_rig();
    uint32_t blocks = hair_test_blocks(test);
    desc.host = &test->host.host;
    desc.get_proc = hair_egl_get_proc;
    desc.restorable = true;
    hair_test_ok(test, hair_egl_create(&test->host.host, -1, &egl));
    hair_test_ok(test, hair_context_create(&desc, &test->context));
    struct hair_test_skinned s = make(test);
    set_weights(test, s.hair, &rig);
    run(test, s.hair, &rig, 1, 4);
    hair_egl_destroy(egl);
    hair_test_ok(test, hair_egl_create(&test->host.host, -1, &egl));
    hair_test_ok(test, hair_context_restore(test->context));
    run(test, s.hair, &rig, 4, 5);
    skin(&rig, &s);
    pose_joints(&rig, 4 * STEP);
    hair_test_ok(test, hair_set_scalp_joints(s.hair, rig.matrices, JOINTS, NULL));
    assert_true(scalp_error(&s) < 1e-7);
    hair_destroy(s.hair);
    hair_context_destroy(test->context);
    hair_egl_destroy(egl);
    hair_egl_make_current(test->egl);
    test->context = shared;
    assert_int_equal(hair_test_blocks(test), blocks);
}

static void unused_and_removed_joints_cost_nothing(void** state)
{
    struct hair_test* test = *state;
    struct hair_test_skinned s = make(test);
    struct rig rig = make_rig();
    const struct hair_gl* gl = &test->context->gl;
    const uint64_t* bytes = &s.hair->memory.bytes[HAIR_GL_CATEGORY_SKIN_SCALP];
    uint32_t runs = hair_test_runs(gl, HAIR_GL_SKIN_SCALP);
    hair_test_skinned_set(test, &s);
    hair_test_ok(test, hair_step(s.hair, STEP));
    uint32_t blocks = hair_test_blocks(test);
    set_weights(test, s.hair, &rig);
    assert_int_equal(*bytes, 0);
    run(test, s.hair, &rig, 1, 3);
    assert_int_equal(*bytes, 32 * VERTICES + 2 * 48 * JOINTS);
    assert_int_equal(hair_test_runs(gl, HAIR_GL_SKIN_SCALP), runs + 2);
    hair_test_ok(test, hair_set_scalp_weights(s.hair, NULL, NULL, 0, 0));
    assert_int_equal(*bytes, 0);
    hair_test_skinned_set(test, &s);
    hair_test_ok(test, hair_step(s.hair, STEP));
    assert_int_equal(hair_test_runs(gl, HAIR_GL_SKIN_SCALP), runs + 2);
    assert_int_equal(hair_test_blocks(test), blocks);
    hair_destroy(s.hair);
}

static void joints_change_no_opengl_state(void** state)
{
    struct hair_test* test = *state;
    struct hair_test_skinned s = make(test);
    struct rig rig = make_rig();
    static struct hair_test_glstate before, after;
    pose_joints(&rig, STEP);
    hair_test_glstate_disturb();
    hair_test_glstate_read(&before);
    set_weights(test, s.hair, &rig);
    hair_test_ok(test, hair_set_scalp_joints(s.hair, rig.matrices, JOINTS, NULL));
    hair_test_glstate_read(&after);
    size_t other = hair_test_glstate_differ(&before, &after, 0);
    if (other < before.count) fail_msg("%s has changed", before.values[other].name);
    hair_destroy(s.hair);
}

int main(void)
{
    if (hair_test_skips()) return 0;
    const struct CMUnitTest tests[] = {
        HAIR_TEST(scalp_of_joints_equals_scalp_skinned_by_the_reference),
        HAIR_TEST(joints_in_their_bind_pose_equal_the_scalp_at_rest),
        HAIR_TEST(invalid_joints_are_refused_by_name_value_and_range),
        HAIR_TEST(joints_of_any_size_keep_hair_finite),
        HAIR_TEST(groom_without_a_scalp_refuses_joints),
        HAIR_TEST(saved_run_with_joints_continues_bit_for_bit),
        HAIR_TEST(restored_context_keeps_the_joints_of_vertices),
        HAIR_TEST(unused_and_removed_joints_cost_nothing),
        HAIR_TEST(joints_change_no_opengl_state),
    };
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
