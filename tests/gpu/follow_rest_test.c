// follow_rest_test.c - the solvers follow and redblack come to rest: built-in haircuts after a head
// shake, alone and among colliders that touch them.
#include "tests/support/haircut.h"
#include "tests/support/live_hair.h"

#include <math.h>
#include <stdlib.h>

#define FRAME (1.0 / 60)
#define GUIDES 16
#define RESTLESS 0.005 // m/s

// Add a head, a neck and shoulders that touch hair.
static void add_bust(struct hair_test* test, hair_instance* hair)
{
    hair_collider colliders[3] = {hair_collider_default(), hair_collider_default(), hair_collider_default()};
    colliders[0].position[1] = 1.63f, colliders[0].size[0] = 0.088f;
    colliders[1].shape = colliders[2].shape = HAIR_SHAPE_CAPSULE;
    colliders[1].position[1] = 1.48f, colliders[1].size[0] = 0.05f, colliders[1].size[1] = 0.08f;
    colliders[2].position[1] = 1.4f, colliders[2].size[0] = 0.05f, colliders[2].size[1] = 0.15f;
    colliders[2].rotation[2] = colliders[2].rotation[3] = sqrtf(0.5f);
    hair_test_ok(test, hair_set_colliders(hair, colliders, 3, sizeof *colliders));
}

static void turn_head(struct hair_test* test, hair_instance* hair, double yaw)
{
    float c = (float)cos(yaw), s = (float)sin(yaw);
    float transform[16] = {c, 0, -s, 0, 0, 1, 0, 0, s, 0, c, 0, 0, 0, 0, 1};
    hair_test_ok(test, hair_set_transform(hair, transform));
}

// Shake the head for a second, wait for ten. Return the speed of the fastest vertex in the last
// frame, m/s.
static double shake_and_wait(struct hair_test* test, hair_instance* hair, uint32_t vertices)
{
    float *before = malloc(3 * vertices * sizeof *before), *after = malloc(3 * vertices * sizeof *after);
    uint32_t count;
    double farthest = 0;
    for (int k = 0; k <= 660; ++k) {
        if (k <= 60) turn_head(test, hair, 0.6 * sin(6.283185307179586 * k / 60));
        hair_test_ok(test, hair_step(hair, (float)FRAME));
        if (k == 659)
            hair_test_ok(test, hair_read_positions(hair, HAIR_READ_GUIDES, before, vertices, &count));
    }
    hair_test_ok(test, hair_read_positions(hair, HAIR_READ_GUIDES, after, vertices, &count));
    for (uint32_t i = 0; i < vertices; ++i)
        farthest =
            fmax(farthest, (double)hair_distance(hair_load3(after + 3 * i), hair_load3(before + 3 * i)));
    free(before);
    free(after);
    return farthest / FRAME;
}

static double speed_at_rest(struct hair_test* test, hair_style style, hair_solver solver, int colliders)
{
    hair_style_desc cut = hair_style_desc_default();
    hair_physics physics = hair_physics_default();
    hair_desc desc = hair_desc_default();
    hair_instance* hair = NULL;
    hair_groom_info info = hair_groom_info_default();
    cut.style = style, cut.guide_count = GUIDES, cut.strand_vertices = 32;
    physics.sleep_threshold = 0, desc.physics = &physics, desc.solver = solver;
    hair_groom* groom = hair_test_haircut(test, &cut, 0);
    hair_test_ok(test, hair_groom_describe(groom, &info));
    hair_test_ok(test, hair_create(test->context, groom, &desc, &hair));
    if (colliders) add_bust(test, hair);
    double speed = shake_and_wait(test, hair, info.guide_vertex_count);
    hair_destroy(hair);
    hair_groom_destroy(groom);
    return speed;
}

static void check(struct hair_test* test, hair_style style, hair_solver solver, int colliders)
{
    double fastest = speed_at_rest(test, style, solver, colliders);
    print_message("    style %d, %d colliders: %.2g mm/s\n", (int)style, 3 * colliders, 1000 * fastest);
    assert_true(fastest < RESTLESS);
}

static void follow_hair_comes_to_rest(void** state)
{
    for (int style = HAIR_STYLE_LONG; style < HAIR_STYLE_COUNT; ++style)
        check(*state, (hair_style)style, HAIR_SOLVER_FOLLOW, 1);
    check(*state, HAIR_STYLE_CURLY, HAIR_SOLVER_FOLLOW, 0);
}

static void redblack_hair_comes_to_rest(void** state)
{
    check(*state, HAIR_STYLE_PONYTAIL, HAIR_SOLVER_REDBLACK, 1);
    check(*state, HAIR_STYLE_CURLY, HAIR_SOLVER_REDBLACK, 0);
}

// Check a clamped strand of 5 cm with and without gravity preload. The strand is stiff enough for
// its rest strain to bear its weight.
static void preloaded_strand_keeps_its_groom_and_another_sags(void** state)
{
    for (int held = 0; held < 2; ++held) {
        hair_physics physics = hair_physics_default();
        physics.shape.frequency_root = physics.shape.frequency_tip = 0;
        physics.shape.gravity_preload = (float)held;
        struct hair_test_strands strands =
            hair_test_straight(16, hair_v3(0, 0, 0), hair_v3(1, 0.3f, 0.1f), 0.05f);
        hair_desc desc = hair_test_rods(HAIR_SOLVER_FOLLOW, HAIR_THREAD_MAPPING_AUTO, 0, &physics);
        struct hair_test_living living;
        hair_test_live(*state, &strands, &desc, &living);
        hair_test_wait(&living, 240);
        hair_test_read_guides(&living);
        print_message("    hold %d: %.2g m from the groom\n", held, hair_test_from_rest(&living));
        assert_true(held ? hair_test_from_rest(&living) < 1e-6 : hair_test_from_rest(&living) > 1e-3);
        hair_test_die(&living);
        hair_test_strands_free(&strands);
    }
}

// Check strands that their weight bends a lot. A strand that is rigid beyond each segment would
// bend at the clamp only.
static void limp_strands_hang_like_the_reference(void** state)
{
    static const float ways[] = {-0.577f, 0, -2}; // Slope y / x of each strand.
    for (int k = 0; k < 3; ++k)
        for (uint32_t vertices = 16; vertices <= 64; vertices *= 2) {
            hair_physics physics = hair_test_bare();
            physics.damping = 4;
            struct hair_test_strands strands =
                hair_test_straight(vertices, hair_v3(0, 0, 0), hair_v3(1, ways[k], 0), 0.3f);
            hair_desc desc = hair_test_rods(HAIR_SOLVER_FOLLOW, HAIR_THREAD_MAPPING_AUTO, 0, &physics);
            struct hair_test_living living;
            hair_test_live(*state, &strands, &desc, &living);
            hair_test_wait(&living, 180);
            hair_test_read_guides(&living);
            struct hair_reference_rod* rod = hair_test_reference(&living, 0, NULL);
            assert_true(hair_reference_rod_rest(rod).converged);
            double off = hair_test_off(&living, 0, rod) / 0.3;
            print_message("    %u vertices, slope %g: off by %.2g of the length after 3 s\n", vertices,
                          (double)ways[k], off);
            assert_true(off < 0.02);
            hair_reference_rod_destroy(rod);
            hair_test_die(&living);
            hair_test_strands_free(&strands);
        }
}

int main(void)
{
    if (hair_test_skips()) return 0;
    const struct CMUnitTest tests[] = {
        HAIR_TEST(follow_hair_comes_to_rest),
        HAIR_TEST(redblack_hair_comes_to_rest),
        HAIR_TEST(preloaded_strand_keeps_its_groom_and_another_sags),
        HAIR_TEST(limp_strands_hang_like_the_reference),
    };
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
