// instances.c - instances that a program tests by every solver and mapping.
#include "tests/support/instances.h"

#include <math.h>

#include "tests/support/ways.h"

int hair_test_instance_way;

int hair_test_run_every_way(const struct CMUnitTest* tests, size_t count)
{
    int failed = 0;
    for (hair_test_instance_way = 0; hair_test_instance_way < HAIR_TEST_WAYS; ++hair_test_instance_way)
        failed += _cmocka_run_group_tests(hair_test_way_name(hair_test_instance_way), tests, count,
                                          hair_test_start, hair_test_finish);
    return failed;
}

void hair_test_set_identity(float out[16])
{
    for (int i = 0; i < 16; ++i) out[i] = i % 5 == 0;
}

void hair_test_set_pose(float angle, float x, float y, float z, float out[16])
{
    hair_test_set_identity(out);
    out[0] = out[10] = cosf(angle);
    out[2] = -sinf(angle), out[8] = sinf(angle);
    out[12] = x, out[13] = y, out[14] = z;
}

hair_instance* hair_test_instance_make(struct hair_test* test, const hair_groom* groom)
{
    hair_instance* hair = NULL;
    hair_desc desc = hair_test_way(hair_test_instance_way);
    hair_test_ok(test, hair_create(test->context, groom, &desc, &hair));
    return hair;
}

void hair_test_instance_swing(struct hair_test* test, hair_instance* hair, float x, int steps)
{
    float transform[16];
    for (int i = 0; i < steps; ++i) {
        hair_test_set_pose(0.5f * sinf(0.3f * (float)i), x + 0.05f * sinf(0.4f * (float)i), 0, 0, transform);
        hair_test_ok(test, hair_set_transform(hair, transform));
        hair_test_ok(test, hair_step(hair, 1.0f / 60));
    }
}
