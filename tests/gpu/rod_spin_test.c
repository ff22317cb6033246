// rod_spin_test.c - a straight strand on a spinning head trails like the converged reference.
#include "tests/support/live_hair.h"

#include <math.h>

#define FRAME (1.0 / 240)
#define LENGTH 0.3f // Metres.
#define ROOT 0.1f // Metres from the axis.
#define RISE 2.0 // Seconds until the head rotates evenly.
#define FRAMES 960

// Return the head's pose at a time, rotated about the vertical axis.
static struct hair_reference_rod_pose turned(double rate, double time)
{
    double turns = rate * (time < RISE ? time * time / (2 * RISE) : time - RISE / 2);
    return hair_test_pose_of(hair_v3(0, 0, 0), hair_v3(0, 1, 0), 2 * 3.14159265358979 * turns);
}

// Spin the head and compare the strand with the reference. The root is bent where the strand leaves
// the scalp's direction, and the bend rotates with the head. If `held`, a collider out of reach
// appears meanwhile.
static void spin(struct hair_test* test, uint32_t vertices, double rate, bool held)
{
    hair_collider far = hair_collider_default();
    far.size[0] = 0.1f;
    far.position[1] = -10;
    hair_physics physics = hair_test_bare();
    physics.damping = 4;
    struct hair_test_strands strands =
        hair_test_straight(vertices, hair_v3(ROOT, 0, 0), hair_v3(1, 0, 0), LENGTH);
    hair_desc desc = hair_test_rods(HAIR_SOLVER_DIRECT, HAIR_THREAD_MAPPING_WORKGROUP_PER_GUIDE, 0, &physics);
    struct hair_reference_rod_pose head = turned(rate, 0);
    struct hair_test_living living;
    double x[3 * HAIR_REFERENCE_ROD_MAX_VERTICES], max = 0;
    hair_test_live(test, &strands, &desc, &living);
    struct hair_reference_rod* rod = hair_test_reference(&living, 0, &head);
    double needs = 2 * FRAME / hair_reference_rod_longest_substep(rod);
    for (int k = 1; k <= FRAMES; ++k) {
        head = turned(rate, k * FRAME);
        if (held && k == FRAMES / 2)
            assert_int_equal(hair_set_colliders(living.hair, &far, 1, sizeof far), HAIR_OK);
        hair_test_advance(&living, &head, FRAME);
        assert_true(hair_reference_rod_advance(rod, &head, FRAME, (uint32_t)fmax(8, needs)));
    }
    hair_test_read_guides(&living);
    hair_reference_rod_positions(rod, x);
    for (uint32_t i = 0; i < vertices; ++i) {
        hair_vec3 p = hair_test_at(&living, 0, i);
        max = fmax(max, hypot(hypot((double)p.x - x[3 * i], (double)p.y - x[3 * i + 1]),
                              (double)p.z - x[3 * i + 2]));
    }
    print_message("    %u vertices, %g Hz: %.4f of the length\n", vertices, rate, max / (double)LENGTH);
    assert_true(max < 0.005 * (double)LENGTH);
    hair_test_healthy(&living);
    hair_reference_rod_destroy(rod);
    hair_test_die(&living);
    hair_test_strands_free(&strands);
}

static void spinning_strand_trails_like_the_reference(void** state)
{
    spin(*state, 32, 2, false);
    spin(*state, 32, 6, false);
}

// Check a guide of many vertices, which takes shorter substeps. Once there is a collider, the mixed
// scheme solves the guide.
static void spinning_strand_of_many_vertices_trails_like_the_reference(void** state)
{
    spin(*state, 64, 6, false);
    spin(*state, 64, 5, true);
}

int main(void)
{
    if (hair_test_skips()) return 0;
    const struct CMUnitTest tests[] = {
        HAIR_TEST(spinning_strand_trails_like_the_reference),
        HAIR_TEST(spinning_strand_of_many_vertices_trails_like_the_reference),
    };
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
