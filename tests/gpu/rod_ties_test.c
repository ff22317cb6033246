// rod_ties_test.c - guides whose vertices are tied: to the head, to the world; as chains are known to hang between two
// ends; too far apart; let go.
#include "tests/support/living.h"
#include "tests/support/motion.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define FRAME (1.0 / 60)
#define LENGTH 0.3f // m
#define WAYS 6 // in which rods are solved
#define SOLVERS 3 // of them, in turn by a work group and by a thread: 0, 3, 4

static hair_desc way_of(int way, const hair_physics* physics)
{
    static const hair_solver solvers[] = {HAIR_SOLVER_DIRECT, HAIR_SOLVER_ACCURATE, HAIR_SOLVER_FOLLOW};
    return hair_test_rods(solvers[way / 2], way % 2 ? HAIR_MAPPING_THREAD : HAIR_MAPPING_GROUP, 0, physics);
}

static int each(int solver)
{
    return 2 * solver + solver % 2;
}

static hair_tie tie_of(uint32_t guide, uint32_t vertex, hair_tie_to to, hair_vec3 position)
{
    hair_tie tie = hair_tie_default();
    tie.guide = guide;
    tie.vertex = vertex;
    tie.to = to;
    hair_store3(tie.position, position);
    return tie;
}

static void set_tie(struct hair_test_living* living, hair_tie tie)
{
    hair_test_ok(living->test, hair_set_ties(living->hair, &tie, 1, sizeof tie));
}

static void tie_tip(struct hair_test_living* living, hair_tie_to to, hair_vec3 position)
{
    set_tie(living, tie_of(0, UINT32_MAX, to, position));
}

static double apart(hair_vec3 a, hair_vec3 b)
{
    return (double)hair_length(hair_sub(a, b));
}

static hair_vec3 in_world(const struct hair_reference_rod_pose* head, hair_vec3 at)
{
    const double *q = head->rotation, *p = head->position;
    hair_quat turn = {(float)q[0], (float)q[1], (float)q[2], (float)q[3]};
    return hair_add(hair_v3((float)p[0], (float)p[1], (float)p[2]), hair_rotate(turn, at));
}

static void live(struct hair_test* test, uint32_t count, uint32_t vertices, hair_vec3 along,
                 const hair_desc* desc, struct hair_test_living* out)
{
    struct hair_test_strands strands = hair_test_strands_make(count, vertices);
    for (uint32_t i = 0; i < count; ++i)
        hair_test_add_straight(&strands, vertices, hair_v3(0, 0, 0.01f * (float)i), along, LENGTH);
    hair_test_live(test, &strands, desc, out);
    hair_test_strands_free(&strands);
}

// A second on a head that is shaken: the tip held by the head, then by a hand that moves.
static void hold_tip(struct hair_test_living* living)
{
    hair_vec3 at = hair_v3(0.2f, -0.05f, 0.02f);
    double of_head = 0, of_world = 0, stretch = 0;
    for (int k = 0; k < 60; ++k) {
        struct hair_reference_rod_pose head = hair_test_shaken(k * FRAME);
        float time = (float)(k * FRAME);
        hair_vec3 hand = hair_v3(0.1f + 0.1f * sinf(6 * time), 0.1f * time, -0.1f), tip;
        head.position[1] = 0.05 * sin(5 * k * FRAME);
        if (k == 0) tie_tip(living, HAIR_TIE_HEAD, at);
        if (k >= 30) tie_tip(living, HAIR_TIE_WORLD, hand);
        hair_test_advance(living, &head, FRAME);
        hair_test_read_guides(living);
        tip = hair_test_tip(living, 0);
        stretch = fmax(stretch, hair_test_stretch(living));
        if (k < 30)
            of_head = fmax(of_head, apart(tip, in_world(&head, at)));
        else
            of_world = fmax(of_world, apart(tip, hand));
    }
    print_message("    off by %.2g m from the head's, %.2g m from the hand's; stretch %.2g\n", of_head,
                  of_world, stretch);
    assert_true(of_head < 1e-6 && of_world < 1e-6 && stretch < 0.01);
}

static void a_tied_tip_is_where_its_tie_has_it(void** state)
{
    for (int way = 0; way < WAYS; ++way) {
        struct hair_test_living living;
        hair_physics physics = hair_test_bare();
        hair_desc desc = way_of(way, &physics);
        live(*state, 1, 32, hair_v3(1, -1, 0), &desc, &living);
        hold_tip(&living);
        assert_int_equal(hair_test_health(&living).reset, 0);
        hair_test_die(&living);
    }
}

// Other programs.
static void so_is_that_of_flat_hair_that_is_pulled_to_its_rest_pose_in_a_crowd_among_solids(void** state)
{
    for (int way = 0; way < 2; ++way) {
        struct hair_test_living living;
        hair_physics physics = hair_physics_default();
        hair_desc desc = way_of(way, &physics);
        hair_solid sphere = hair_solid_default();
        physics.flatness = 0.5f;
        physics.cohesion = 5;
        sphere.size[0] = 0.03f;
        sphere.position[0] = 0.1f;
        live(*state, 1, 20, hair_v3(1, -1, 0), &desc, &living);
        hair_test_ok(*state, hair_set_solids(living.hair, &sphere, 1, sizeof sphere));
        hold_tip(&living);
        hair_test_die(&living);
    }
}

// Of an inextensible chain, span and sag by the length.
static void a_chain_hangs_between_two_ends_in_a_catenary(void** state)
{
    static const double rows[][2] = {{0.5, 0.3981941779}, {0.8, 0.2654375091}};
    hair_physics physics = hair_test_bare();
    physics.young = 0, physics.damping = 6, physics.root = HAIR_ROOT_HINGED;
    for (int i = 0; i < 2 * SOLVERS; ++i) {
        struct hair_test_living living;
        hair_desc desc = way_of(each(i / 2), &physics);
        double sag = 0, span = rows[i % 2][0], expected = rows[i % 2][1];
        live(*state, 1, 32, hair_v3(1, -1, 0), &desc, &living);
        tie_tip(&living, HAIR_TIE_HEAD, hair_v3((float)span * LENGTH, 0, 0));
        hair_test_wait(&living, 180);
        hair_test_read_guides(&living);
        for (uint32_t k = 0; k < 32; ++k)
            sag = fmax(sag, -(double)hair_test_at(&living, 0, k).y / (double)LENGTH);
        print_message("    span %.1f: sag %.5f, %.5f expected; stretch %.2g\n", span, sag, expected,
                      hair_test_stretch(&living));
        if (desc.solver != HAIR_SOLVER_FOLLOW) hair_test_near("sag", i, sag, expected, 0.005 * expected);
        assert_true(hair_test_stretch(&living) < (desc.solver == HAIR_SOLVER_FOLLOW ? 5e-3 : 5e-4));
        hair_test_die(&living);
    }
}

// A ponytail: what is above its tie is held at both ends, what is below hangs from it.
static void a_guide_can_be_tied_at_several_vertices(void** state)
{
    for (int solver = 0; solver < SOLVERS; ++solver) {
        struct hair_test_living living;
        hair_physics physics = hair_test_bare();
        hair_desc desc = way_of(each(solver), &physics);
        hair_tie ties[] = {tie_of(0, 20, HAIR_TIE_WORLD, hair_v3(0.15f, 0, 0)),
                           tie_of(0, 10, HAIR_TIE_HEAD, hair_v3(0.07f, 0.03f, 0))};
        physics.damping = 6;
        live(*state, 2, 32, hair_v3(1, -1, 0), &desc, &living);
        hair_test_ok(*state, hair_set_ties(living.hair, ties, 2, sizeof *ties));
        hair_test_wait(&living, 180);
        hair_test_read_guides(&living);
        for (int i = 0; i < 2; ++i)
            assert_true(apart(hair_test_at(&living, 0, ties[i].vertex), hair_load3(ties[i].position)) < 1e-6);
        hair_vec3 tip = hair_test_tip(&living, 0);
        print_message("    tip at %.3f %.3f %.3f, stretch %.2g\n", (double)tip.x, (double)tip.y,
                      (double)tip.z, hair_test_stretch(&living));
        hair_test_near("x of the tip", 0, (double)tip.x, 0.15, 0.06);
        assert_true(tip.y < -0.06f && hair_test_stretch(&living) < 1e-3);
        assert_true(hair_test_tip(&living, 1).y < -0.2f); // Which nothing ties.
        hair_test_die(&living);
    }
}

static void ties_that_are_too_far_apart_pull_a_guide_straight(void** state)
{
    for (int solver = 0; solver < SOLVERS; ++solver) {
        struct hair_test_living living;
        hair_physics physics = hair_test_bare();
        hair_desc desc = way_of(each(solver), &physics);
        hair_vec3 far = hair_v3(0.45f, 0, 0);
        double astray = 0;
        live(*state, 1, 32, hair_v3(1, -1, 0), &desc, &living);
        tie_tip(&living, HAIR_TIE_HEAD, far);
        hair_test_wait(&living, 30);
        hair_test_read_guides(&living);
        for (uint32_t k = 0; k < 32; ++k)
            astray = fmax(astray, apart(hair_test_at(&living, 0, k), hair_scale(far, (float)k / 31)));
        hair_health pulled = hair_test_health(&living);
        print_message("    %.2g m off the straight line, stretch %.4f, %u times taut, %u by Euler, %u led\n",
                      astray, hair_test_stretch(&living), pulled.taut, pulled.euler, pulled.follow);
        assert_true(astray < 0.03 && pulled.taut > 0);
        float lower[3], upper[3];
        hair_test_ok(*state, hair_get_reach(living.hair, lower, upper));
        assert_true(upper[0] >= far.x && lower[0] < 0);
        hair_test_near("stretch", 0, hair_test_stretch(&living), 0.5, 0.02);
        tie_tip(&living, HAIR_TIE_HEAD, hair_v3(0.2f, 0, 0));
        hair_test_wait(&living, 60);
        hair_test_read_guides(&living);
        hair_health after = hair_test_health(&living);
        assert_true(hair_test_stretch(&living) < 1e-3 && after.taut < pulled.taut + 60);
        hair_test_wait(&living, 10);
        assert_int_equal(hair_test_health(&living).taut, after.taut);
        hair_test_die(&living);
    }
}

static void a_guide_that_is_let_go_falls_and_rests_as_if_it_had_never_been_tied(void** state)
{
    for (int solver = 0; solver < 2; ++solver) {
        struct hair_test_living living;
        hair_physics physics = hair_test_bare();
        hair_desc desc = way_of(each(solver), &physics);
        physics.damping = 6;
        live(*state, 1, 24, hair_v3(1, -1, 0), &desc, &living);
        tie_tip(&living, HAIR_TIE_WORLD, hair_v3(0.1f, 0.2f, 0));
        hair_test_wait(&living, 60);
        hair_test_read_guides(&living);
        assert_true(hair_test_tip(&living, 0).y > 0.19f);
        hair_test_ok(*state, hair_set_ties(living.hair, NULL, 0, 0));
        hair_test_wait(&living, 6);
        hair_test_read_guides(&living);
        double fallen = 0.2 - (double)hair_test_tip(&living, 0).y;
        print_message("    %.3f m in a tenth of a second\n", fallen);
        assert_true(fallen > 0.03 && fallen < 0.3);
        hair_test_wait(&living, 240);
        hair_test_read_guides(&living);
        struct hair_reference_rod* rod = hair_test_reference(&living, 0, NULL);
        assert_true(hair_reference_rod_rest(rod).converged);
        assert_true(hair_test_off(&living, 0, rod) < 0.01 * (double)LENGTH);
        hair_reference_rod_destroy(rod);
        hair_test_die(&living);
    }
}

static void a_teleport_takes_ties_along(void** state)
{
    struct hair_test_living living;
    hair_physics physics = hair_test_bare();
    hair_desc desc = way_of(0, &physics);
    struct hair_reference_rod_pose far =
        hair_test_pose_of(hair_v3(100, 0, 0), hair_v3(0, 1, 0), 1.5707963267948966);
    const float turned[16] = {0, 0, -1, 0, 0, 1, 0, 0, 1, 0, 0, 0, 100, 0, 0, 1};
    live(*state, 1, 16, hair_v3(1, -1, 0), &desc, &living);
    tie_tip(&living, HAIR_TIE_WORLD, hair_v3(0.2f, 0, 0));
    hair_test_wait(&living, 30);
    hair_test_ok(*state, hair_teleport(living.hair, turned));
    hair_test_wait(&living, 30);
    hair_test_read_guides(&living);
    assert_true(apart(hair_test_tip(&living, 0), in_world(&far, hair_v3(0.2f, 0, 0))) < 1e-4);
    assert_true(hair_test_stretch(&living) < 2e-3);
    assert_int_equal(hair_test_health(&living).taut, 0);
    hair_test_die(&living);
}

static void a_state_with_ties_goes_on_as_if_it_had_not_been_saved(void** state)
{
    static struct hair_test_seen seen[2];
    hair_physics physics = hair_physics_default();
    hair_desc desc = way_of(0, &physics);
    struct hair_test_living living[2];
    hair_tie ties[] = {tie_of(1, UINT32_MAX, HAIR_TIE_WORLD, hair_v3(0.1f, 0.1f, 0)),
                       tie_of(0, 7, HAIR_TIE_HEAD, hair_v3(0.1f, 0, 0))};
    for (int i = 0; i < 2; ++i) live(*state, 3, 16, hair_v3(1, -1, 0), &desc, &living[i]);
    hair_test_ok(*state, hair_set_ties(living[0].hair, ties, 2, sizeof *ties));
    for (int k = 0; k < 20; ++k) hair_test_advance(&living[0], NULL, 0.011);
    struct hair_test_blob blob = hair_test_save(*state, living[0].hair);
    hair_test_ok(*state, hair_load(living[1].hair, blob.bytes, blob.size));
    struct hair_test_blob again = hair_test_save(*state, living[1].hair);
    assert_int_equal(again.size, blob.size);
    assert_memory_equal(again.bytes, blob.bytes, blob.size);
    for (int i = 0; i < 2; ++i) {
        for (int k = 0; k < 20; ++k) {
            ties[0].position[1] = 0.1f + 0.005f * (float)k;
            if (k > 5) hair_test_ok(*state, hair_set_ties(living[i].hair, ties, 2, sizeof *ties));
            hair_test_advance(&living[i], NULL, 0.011);
        }
        hair_test_look(*state, living[i].hair, &seen[i]);
    }
    hair_test_same(&seen[0], &seen[1]);
    for (int i = 0; i < 2; ++i) hair_test_die(&living[i]);
    free(blob.bytes), free(again.bytes);
}

static void ties_that_cannot_be_are_refused_and_leave_those_there_are(void** state)
{
    const float inf = INFINITY;
    struct hair_test* test = *state;
    hair_physics physics = hair_test_bare();
    hair_desc desc = way_of(0, &physics);
    struct hair_test_living living;
    hair_vec3 at = hair_v3(0.1f, 0.1f, 0.1f);
    const struct {
        hair_tie tie;
        const char* words;
    } wrong[] = {
        {tie_of(2, 3, HAIR_TIE_HEAD, at), "ties[1].guide is 2, not in [0, 1]"},
        {tie_of(1, 0, HAIR_TIE_HEAD, at), "ties[1].vertex is 0"},
        {tie_of(1, 3, (hair_tie_to)2, at), "ties[1].to is 2"},
        {tie_of(1, 3, HAIR_TIE_WORLD, hair_v3(0, NAN, 0)), "ties[1].position[1] is"},
        {tie_of(1, 3, HAIR_TIE_WORLD, hair_v3(0, 0, -inf)), "ties[1].position[2] is -inf"},
        {tie_of(0, 15, HAIR_TIE_WORLD, at), "ties[0] and ties[1] both hold vertex 15 of guide 0"},
        {tie_of(0, 99, HAIR_TIE_WORLD, at), "both hold vertex 15 of guide 0"},
    };
    live(test, 2, 16, hair_v3(1, -1, 0), &desc, &living);
    hair_instance* hair = living.hair;
    tie_tip(&living, HAIR_TIE_HEAD, hair_v3(0.2f, 0, 0));
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; ++i) {
        hair_tie ties[] = {tie_of(0, 15, HAIR_TIE_HEAD, at), wrong[i].tie};
        hair_test_refused(test, hair_set_ties(hair, ties, 2, sizeof *ties), HAIR_ERROR_ARGUMENT,
                          wrong[i].words);
    }
    hair_tie one = tie_of(0, 15, HAIR_TIE_HEAD, at);
    hair_test_refused(test, hair_set_ties(hair, &one, 1, 8), HAIR_ERROR_ARGUMENT, "stride is 8");
    hair_test_refused(test, hair_set_ties(hair, NULL, 1, sizeof one), HAIR_ERROR_ARGUMENT, "ties is NULL");
    hair_test_refused(test, hair_set_ties(hair, &one, 1048577, sizeof one), HAIR_ERROR_ARGUMENT, "tie count");
    assert_int_equal(hair_set_ties(NULL, &one, 1, sizeof one), HAIR_ERROR_ARGUMENT);
    hair_test_wait(&living, 2);
    hair_test_read_guides(&living);
    assert_true(apart(hair_test_tip(&living, 0), hair_v3(0.2f, 0, 0)) < 1e-6);

    // What may be asked for, and cannot be: a place that no hair reaches, and back from it.
    tie_tip(&living, HAIR_TIE_WORLD, hair_v3(1e9f, -1e9f, 0));
    hair_test_wait(&living, 10);
    hair_test_read_guides(&living);
    tie_tip(&living, HAIR_TIE_WORLD, hair_v3(0.1f, 0, 0));
    hair_test_wait(&living, 60);
    hair_test_read_guides(&living);
    assert_true(hair_test_stretch(&living) < 0.01);
    hair_test_die(&living);

    desc = hair_test_rods(HAIR_SOLVER_REDBLACK, HAIR_MAPPING_AUTO, 0, &physics);
    live(test, 2, 16, hair_v3(1, -1, 0), &desc, &living);
    hair_test_refused(test, hair_set_ties(living.hair, &one, 1, sizeof one), HAIR_ERROR_ARGUMENT, "redblack");
    hair_test_die(&living);
}

int main(void)
{
    if (hair_test_skips()) return 0;
    const struct CMUnitTest tests[] = {
        HAIR_TEST(a_tied_tip_is_where_its_tie_has_it),
        HAIR_TEST(so_is_that_of_flat_hair_that_is_pulled_to_its_rest_pose_in_a_crowd_among_solids),
        HAIR_TEST(a_chain_hangs_between_two_ends_in_a_catenary),
        HAIR_TEST(a_guide_can_be_tied_at_several_vertices),
        HAIR_TEST(ties_that_are_too_far_apart_pull_a_guide_straight),
        HAIR_TEST(a_guide_that_is_let_go_falls_and_rests_as_if_it_had_never_been_tied),
        HAIR_TEST(a_teleport_takes_ties_along),
        HAIR_TEST(a_state_with_ties_goes_on_as_if_it_had_not_been_saved),
        HAIR_TEST(ties_that_cannot_be_are_refused_and_leave_those_there_are),
    };
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
