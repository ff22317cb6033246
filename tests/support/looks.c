// looks.c - straight hair whose followers are read with one look after the other.
#include "tests/support/looks.h"

#include <math.h>
#include <stdlib.h>

struct hair_test_scene hair_test_look_scene(struct hair_test* test, uint32_t guides)
{
    struct hair_test_handmade wanted = hair_test_handmade_default();
    wanted.guides = guides, wanted.turn = 0, wanted.segment = 0.025f;
    wanted.followers = HAIR_TEST_LOOK_FOLLOWERS, wanted.each = 64;
    return hair_test_scene_of(test, &wanted, NULL);
}

float* hair_test_read_look(const struct hair_test_scene* scene, const hair_look* look)
{
    hair_groom_info info = hair_groom_info_default();
    hair_test_ok(scene->test, hair_groom_describe(scene->groom, &info));
    uint32_t count = info.follower_count * (look->strand.segments + 1), there;
    float* positions = malloc(3 * sizeof *positions * count);
    hair_test_ok(scene->test, hair_set_look(scene->hair, look));
    hair_test_ok(scene->test,
                 hair_read_positions(scene->hair, HAIR_READ_FOLLOWERS, positions, count, &there));
    assert_int_equal(there, count);
    return positions;
}

double hair_test_distance_at(const float* a, const float* b, size_t i)
{
    double sum = 0;
    for (size_t k = 3 * i; k < 3 * i + 3; ++k) sum += pow((double)a[k] - (double)b[k], 2);
    return sqrt(sum);
}
