// math_test.c - vectors, quaternions and matrices obey their laws.
#include "tests/support/support.h"

#include <math.h>
#include <string.h>

#include "lib/base/math.h"

#define CASES 1000

static uint32_t seed = 1;

static float between(float min, float max)
{
    return min + (max - min) * hair_random(&seed);
}

static hair_vec3 any_vector(void)
{
    return hair_v3(between(-2, 2), between(-2, 2), between(-2, 2));
}

static hair_vec3 any_direction(void)
{
    return hair_normalize(any_vector(), hair_v3(0, 0, 1));
}

static hair_quat any_rotation(void)
{
    return hair_quat_normalize((hair_quat){between(-1, 1), between(-1, 1), between(-1, 1), between(-1, 1)});
}

static void near3(hair_vec3 a, hair_vec3 b, double tolerance)
{
    hair_test_near("x", 0, a.x, b.x, tolerance);
    hair_test_near("y", 0, a.y, b.y, tolerance);
    hair_test_near("z", 0, a.z, b.z, tolerance);
}

static void perpendicular_exists_for_every_direction(void** state)
{
    (void)state;
    static const float ends[][3] = {{0, 0, 1}, {0, 0, -1}, {1, 0, 0}, {0, -1, 0}, {0, 1e-4f, -1}};
    for (int i = 0; i < CASES; ++i) {
        hair_vec3 a = i < 5 ? hair_normalize(hair_load3(ends[i]), hair_v3(0, 0, 1)) : any_direction();
        hair_vec3 p = hair_perpendicular(a);
        hair_test_near("dot", i, hair_dot(a, p), 0, 1e-6);
        hair_test_near("length", i, hair_length(p), 1, 1e-6);
    }
}

static void a_vector_without_direction_gets_the_fallback(void** state)
{
    (void)state;
    near3(hair_normalize(hair_v3(0, 0, 0), hair_v3(0, 1, 0)), hair_v3(0, 1, 0), 0);
    near3(hair_normalize(hair_v3(3, 0, 4), hair_v3(0, 1, 0)), hair_v3(0.6f, 0, 0.8f), 1e-7);
}

static void rotations_keep_lengths_and_handedness(void** state)
{
    (void)state;
    for (int i = 0; i < CASES; ++i) {
        hair_quat q = any_rotation();
        hair_vec3 a = any_vector(), b = any_vector();
        hair_test_near("length", i, hair_length(hair_rotate(q, a)), hair_length(a), 2e-6);
        near3(hair_rotate(q, hair_cross(a, b)), hair_cross(hair_rotate(q, a), hair_rotate(q, b)), 1e-5);
    }
}

static void quaternion_product_rotates_one_after_the_other(void** state)
{
    (void)state;
    for (int i = 0; i < CASES; ++i) {
        hair_quat p = any_rotation(), q = any_rotation();
        hair_vec3 v = any_vector();
        near3(hair_rotate(hair_quat_multiply(p, q), v), hair_rotate(p, hair_rotate(q, v)), 1e-5);
        near3(hair_rotate(hair_quat_conjugate(q), hair_rotate(q, v)), v, 1e-5);
    }
}

static void rotation_between_directions_is_the_shortest(void** state)
{
    (void)state;
    for (int i = 0; i < CASES; ++i) {
        hair_vec3 a = any_direction(), b = any_direction();
        if (i == 0) b = hair_scale(a, -1);
        if (i == 1) b = a;
        hair_quat q = hair_quat_between(a, b);
        near3(hair_rotate(q, a), b, i == 0 ? 1e-3 : 1e-4);
        // The axis is unchanged.
        if (i > 1) near3(hair_rotate(q, hair_cross(a, b)), hair_cross(a, b), 1e-5);
    }
}

static void axes_convert_to_a_quaternion_and_back(void** state)
{
    (void)state;
    for (int i = 0; i < CASES; ++i) {
        hair_quat q = any_rotation();
        if (i < 4) q = (hair_quat){i == 0, i == 1, i == 2, i == 3}; // Half turns, and the identity.
        hair_vec3 x = hair_rotate(q, hair_v3(1, 0, 0)), y = hair_rotate(q, hair_v3(0, 1, 0)),
                  z = hair_rotate(q, hair_v3(0, 0, 1));
        hair_quat p = hair_quat_from_axes(x, y, z);
        hair_test_near("same rotation", i, fabsf(p.x * q.x + p.y * q.y + p.z * q.z + p.w * q.w), 1, 1e-6);
    }
}

static void slerp_is_uniform_and_takes_the_shortest_way(void** state)
{
    (void)state;
    for (int i = 0; i < CASES; ++i) {
        float angle = between(-3, 3), t = between(0, 1);
        hair_quat a = {0, 0, 0, 1};
        hair_quat b = {0, sinf(angle / 2), 0, cosf(angle / 2)};
        if (i % 2) b = (hair_quat){-b.x, -b.y, -b.z, -b.w}; // This is the same rotation.
        if (i % 5 == 0) angle *= 0.01f, b = (hair_quat){0, sinf(angle / 2), 0, cosf(angle / 2)};
        hair_quat q = hair_slerp(a, b, t);
        near3(hair_rotate(q, hair_v3(1, 0, 0)), hair_v3(cosf(t * angle), 0, -sinf(t * angle)), 1e-5);
    }
}

static void matrices_multiply_column_by_column(void** state)
{
    (void)state;
    float a[16], b[16], c[16];
    for (int i = 0; i < 16; ++i) a[i] = between(-1, 1), b[i] = between(-1, 1);
    hair_mat4_multiply(a, b, c);
    for (int row = 0; row < 4; ++row)
        for (int column = 0; column < 4; ++column) {
            double sum = 0;
            for (int k = 0; k < 4; ++k) sum += (double)a[4 * k + row] * (double)b[4 * column + k];
            hair_test_near("cell", (size_t)(4 * column + row), c[4 * column + row], sum, 1e-6);
        }
}

// Check bins of n uniform numbers. Each of b bins has n/b numbers with a standard deviation of
// sqrt(n/b). Five standard deviations occur in one of a million cases.
static void random_numbers_are_uniform(void** state)
{
    (void)state;
    int bins[16] = {0};
    uint32_t own = 5;
    for (int i = 0; i < 160000; ++i) {
        float r = hair_random(&own);
        assert_true(r >= 0 && r < 1);
        ++bins[(int)(r * 16)];
    }
    for (int i = 0; i < 16; ++i) assert_in_range(bins[i], 9500, 10500);
}

// Check the PCG hash of Jarzynski and Olano 2020 with values computed in integers: state =
// 2891336453, word = ((state >> (10 + 4)) ^ state) * 277803737, (word >> 22) ^ word.
static void the_hash_is_pcg(void** state)
{
    (void)state;
    uint64_t s = 2891336453u;
    uint64_t word = (((s >> ((s >> 28) + 4)) ^ s) * 277803737u) & 0xffffffffu;
    assert_int_equal(hair_hash(0), (uint32_t)((word >> 22) ^ word));
    assert_int_equal(hair_hash(0), 129708002u);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(perpendicular_exists_for_every_direction),
        cmocka_unit_test(a_vector_without_direction_gets_the_fallback),
        cmocka_unit_test(rotations_keep_lengths_and_handedness),
        cmocka_unit_test(quaternion_product_rotates_one_after_the_other),
        cmocka_unit_test(rotation_between_directions_is_the_shortest),
        cmocka_unit_test(axes_convert_to_a_quaternion_and_back),
        cmocka_unit_test(slerp_is_uniform_and_takes_the_shortest_way),
        cmocka_unit_test(matrices_multiply_column_by_column),
        cmocka_unit_test(random_numbers_are_uniform),
        cmocka_unit_test(the_hash_is_pcg),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
