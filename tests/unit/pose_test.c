// pose_test.c - poses from matrices and between each other.
#include "tests/support/support.h"

#include <math.h>
#include <string.h>

#include "lib/base/pose.h"

static const float identity[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};

static void a_rigid_matrix_becomes_its_pose(void** state)
{
    (void)state;
    struct hair_pose pose;
    // A rotation by 90 degrees about z, x to y, at (1, 2, 3).
    float m[16] = {0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 1, 2, 3, 1};
    assert_true(hair_pose_from_matrix(m, &pose));
    hair_vec3 x = hair_rotate(pose.rotation, hair_v3(1, 0, 0));
    hair_test_near("x", 0, x.y, 1, 1e-6);
    assert_true(pose.position[0] == 1 && pose.position[1] == 2 && pose.position[2] == 3);
}

static void matrix_that_is_not_rigid_is_refused(void** state)
{
    (void)state;
    struct hair_pose pose = {{7, 7, 7}, {0, 0, 0, 1}};
    for (int i = 0; i < 16; ++i) {
        float m[16];
        memcpy(m, identity, sizeof m);
        m[i] = NAN;
        assert_false(hair_pose_from_matrix(m, &pose));
        m[i] = INFINITY;
        assert_false(hair_pose_from_matrix(m, &pose));
        m[i] = identity[i] + 0.01f;
        assert_int_equal(hair_pose_from_matrix(m, &pose), i >= 12 && i < 15);
    }
    float mirror[16], scaled[16];
    memcpy(mirror, identity, sizeof mirror);
    memcpy(scaled, identity, sizeof scaled);
    mirror[5] = -1;
    for (int i = 0; i < 11; ++i) scaled[i] *= 1.1f;
    assert_false(hair_pose_from_matrix(mirror, &pose));
    assert_false(hair_pose_from_matrix(scaled, &pose));
}

static void rounding_errors_of_a_matrix_are_accepted(void** state)
{
    (void)state;
    struct hair_pose pose;
    float m[16];
    memcpy(m, identity, sizeof m);
    m[0] += 3e-4f, m[1] += 3e-4f;
    assert_true(hair_pose_from_matrix(m, &pose));
    hair_quat q = pose.rotation;
    hair_test_near("norm", 0, q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w, 1, 1e-6);
}

static void interpolated_pose_moves_straight_and_uniformly(void** state)
{
    (void)state;
    struct hair_pose a = {{0, 0, 0}, {0, 0, 0, 1}}, b = {{4, -8, 2}, {0, 0, sinf(0.5f), cosf(0.5f)}};
    for (int i = 0; i <= 4; ++i) {
        struct hair_pose pose = hair_pose_between(&a, &b, i / 4.0);
        assert_true(pose.position[0] == i && pose.position[1] == -2 * i && pose.position[2] == i / 2.0);
        hair_test_near("angle", (size_t)i, 2 * atan2f(pose.rotation.z, pose.rotation.w), i / 4.0, 1e-6);
    }
}

// Check the precision of offsets. Floats at 1e6 m are spaced by 6 cm, and doubles resolve
// micrometres.
static void offset_far_from_the_origin_keeps_its_precision(void** state)
{
    (void)state;
    struct hair_pose a = {{1e6 + 1e-6, 0, 0}, {0, 0, 0, 1}}, b = {{1e6, 0, 0}, {0, 0, 0, 1}};
    hair_test_near("offset", 0, hair_pose_offset(&a, &b).x, 1e-6, 1e-9);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_rigid_matrix_becomes_its_pose),
        cmocka_unit_test(matrix_that_is_not_rigid_is_refused),
        cmocka_unit_test(rounding_errors_of_a_matrix_are_accepted),
        cmocka_unit_test(interpolated_pose_moves_straight_and_uniformly),
        cmocka_unit_test(offset_far_from_the_origin_keeps_its_precision),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
