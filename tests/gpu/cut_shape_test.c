// cut_shape_test.c - hair that is cut by a plane, a capsule or the stroke of a blade, where it is
// drawn.
#include "lib/collide/cutter.h"
#include "tests/support/cut_scene.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static hair_look curly(void)
{
    hair_look look = hair_look_default();
    look.strand.segments = 96;
    look.curl.radius = 0.006f, look.curl.wavelength = 0.04f;
    look.strays.fraction = 1;
    return look;
}

// Return the distance of a place from the shape, m. It is negative inside.
static double distance_from(const hair_cut_desc* cut, hair_vec3 p)
{
    hair_vec3 from = hair_load3(cut->start), axis = hair_sub(hair_load3(cut->end), from);
    hair_vec3 arm = hair_sub(p, from);
    if (cut->shape == HAIR_CUT_SHAPE_PLANE)
        return -(double)hair_dot(arm, hair_normalize(hair_load3(cut->normal), hair_v3(0, -1, 0)));
    float along = fminf(fmaxf(hair_dot(arm, axis) / hair_dot(axis, axis), 0), 1);
    return (double)hair_distance(arm, hair_scale(axis, along)) - (double)cut->radius;
}

static hair_cut_desc sloping_plane(void)
{
    hair_cut_desc cut = hair_cut_desc_default();
    cut.start[1] = HAIR_TEST_CUT_HEIGHT - 0.6f * HAIR_TEST_CUT_LENGTH;
    cut.normal[0] = 0.5f, cut.normal[1] = -1;
    return cut;
}

static hair_cut_desc razor(void)
{
    hair_cut_desc cut = hair_cut_desc_default();
    cut.shape = HAIR_CUT_SHAPE_CAPSULE;
    cut.start[0] = -0.1f, cut.end[0] = 0.03f;
    cut.start[1] = cut.end[1] = HAIR_TEST_CUT_HEIGHT - 0.5f * HAIR_TEST_CUT_LENGTH;
    cut.radius = 0.03f;
    return cut;
}

// Check that no drawn strand reaches beyond the tip of a guide with which it moves.
static void check_guides(const struct hair_test_scene* scene)
{
    const struct hair_lengths* lengths = &scene->hair->sim.lengths;
    for (uint32_t i = 0; i < scene->groom->info.follower_count; ++i) {
        const struct hair_follower* f = &scene->groom->followers[i];
        float ratio = f->multi < 0 ? 1 : f->length_ratio;
        float needed = fminf(lengths->follower_fraction[i] * ratio, 1) - 1e-6f;
        assert_true(lengths->guide_fraction[f->guide0] >= needed);
        if (f->multi == 0) continue;
        assert_true(lengths->guide_fraction[f->guide1] >= needed);
        assert_true(lengths->guide_fraction[f->guide2] >= needed);
    }
}

static void cut_strands_end_at_the_shape(void** state)
{
    hair_look looks[2] = {hair_look_default(), curly()};
    for (int i = 0; i < 8; ++i) {
        hair_cut_desc cut = i & 1 ? razor() : sloping_plane();
        hair_cut_info info = hair_cut_info_default();
        struct hair_test_scene scene = hair_test_cut_scene(
            *state, i & 2 ? HAIR_STRAND_SET_FULL : HAIR_STRAND_SET_GUIDES, NULL, &looks[i >> 2], NULL);
        hair_test_cut_swing(&scene, 30);
        struct hair_test_drawn before = hair_test_read_drawn(*state, scene.hair);
        hair_test_ok(*state, hair_cut(scene.hair, &cut, &info, NULL));
        struct hair_test_drawn after = hair_test_read_drawn(*state, scene.hair);
        uint32_t met = 0;
        double worst = 0, tip = 0;
        for (uint32_t s = 0; s < before.count; ++s) {
            bool meets = false;
            for (uint32_t k = 0; k < before.vertices; ++k) {
                meets |= distance_from(&cut, hair_test_drawn_at(&before, s, k)) <= 0;
                worst = fmax(worst, -distance_from(&cut, hair_test_drawn_at(&after, s, k)));
            }
            met += meets;
            if (meets)
                tip =
                    fmax(tip, fabs(distance_from(&cut, hair_test_drawn_at(&after, s, before.vertices - 1))));
            if (!meets && distance_from(&cut, hair_test_drawn_at(&before, s, 0)) > 0 && !(i & 1))
                assert_true(fabs(hair_test_drawn_length(&after, s) / hair_test_drawn_length(&before, s) - 1) <
                            1e-3);
        }
        check_guides(&scene);
        double lost = hair_test_drawn_length_of_all(&before) - hair_test_drawn_length_of_all(&after);
        print_message(
            "    %u of %u strands are cut, %.1f um inside, tips within %.1f um, %.3f m lost (%.3f)\n", met,
            before.count, worst * 1e6, tip * 1e6, info.length, lost);
        assert_true(met >= 4 && worst < 2e-4 && tip < 2e-4);
        assert_true(info.strands >= met && info.strands <= before.count && (info.guides > 0 || i & 2));
        // Curls that are cut have more segments to a turn, which are longer together.
        assert_true(fabs(info.length / lost - 1) < (i >> 2 ? 1e-2 : 2e-3));
        free(before.positions), free(after.positions);
        hair_test_scene_free(&scene);
    }
}

static float* lengths_of(const struct hair_test_scene* scene)
{
    uint32_t guides = scene->groom->info.guide_count;
    float* fractions = calloc(guides, sizeof *fractions);
    hair_test_ok(scene->test, hair_get_lengths(scene->hair, 0, guides, fractions));
    return fractions;
}

// The edge moves through all of one half of the hair, on a plane that rises along x.
static void a_stroke_cuts_where_it_passes(void** state)
{
    hair_look look = hair_look_default();
    look.strays.fraction = look.strays.tip_fraction = 0;
    struct hair_test_scene scene = hair_test_cut_scene(*state, HAIR_STRAND_SET_GUIDES, NULL, &look, NULL);
    hair_cut_desc cut = hair_cut_desc_default();
    hair_cut_info info = hair_cut_info_default();
    cut.shape = HAIR_CUT_SHAPE_BLADE;
    // Hair meets both triangles of the stroke.
    cut.start[0] = cut.last_start[0] = -0.02f, cut.end[0] = cut.last_end[0] = 0.03f;
    cut.last_start[1] = cut.start[1] = HAIR_TEST_CUT_HEIGHT - 0.12f,
    cut.last_end[1] = cut.end[1] = HAIR_TEST_CUT_HEIGHT - 0.07f;
    cut.last_start[2] = cut.last_end[2] = cut.start[2] = cut.end[2] = -0.2f;
    hair_test_ok(*state, hair_cut(scene.hair, &cut, &info, NULL));
    assert_true(info.strands == 0 && info.guides == 0 && info.length == 0);
    assert_null(scene.hair->sim.lengths.guides);
    cut.start[2] = cut.end[2] = 0.2f;
    struct hair_test_drawn before = hair_test_read_drawn(*state, scene.hair);
    hair_test_ok(*state, hair_cut(scene.hair, &cut, &info, NULL));
    struct hair_test_drawn after = hair_test_read_drawn(*state, scene.hair);
    uint32_t met = 0;
    for (uint32_t s = 0; s < before.count; ++s) {
        hair_vec3 tip = hair_test_drawn_at(&after, s, after.vertices - 1),
                  was = hair_test_drawn_at(&before, s, after.vertices - 1);
        float height = HAIR_TEST_CUT_HEIGHT - 0.1f + tip.x;
        // Strands at the ends of the edge are left out.
        if (fabsf(was.x - 0.03f) < 1e-3f || was.x < -0.019f) continue;
        met += was.x < 0.03f;
        assert_true(was.x < 0.03f ? fabsf(tip.y - height) < 1e-4f : hair_distance(tip, was) < 1e-5f);
    }
    print_message("    %u of %u strands are cut by the stroke\n", met, before.count);
    assert_true(met > before.count / 4 && met < before.count);
    assert_true(info.strands >= met && info.strands <= met + before.count / 8);
    free(before.positions), free(after.positions);
    hair_test_scene_free(&scene);
}

static void other_groups_are_not_cut(void** state)
{
    struct hair_test_scene scene = hair_test_cut_scene(*state, HAIR_STRAND_SET_GUIDES, NULL, NULL, NULL);
    hair_cut_desc cut = sloping_plane();
    hair_cut_info info = hair_cut_info_default();
    cut.groups = 2;
    struct hair_test_drawn before = hair_test_read_drawn(*state, scene.hair);
    hair_test_ok(*state, hair_cut(scene.hair, &cut, &info, NULL));
    struct hair_test_drawn after = hair_test_read_drawn(*state, scene.hair);
    float* fractions = lengths_of(&scene);
    for (uint32_t g = 0; g < HAIR_TEST_CUT_GUIDES; ++g)
        assert_true(g % 2 ? fractions[g] < 0.9f : fractions[g] == 1);
    assert_int_equal(info.guides, HAIR_TEST_CUT_GUIDES / 2);
    for (uint32_t s = 0; s < before.count; ++s) {
        uint32_t group = scene.groom->guides[scene.groom->followers[s].guide0].group;
        assert_true(group || memcmp(before.positions + 3 * (size_t)s * before.vertices,
                                    after.positions + 3 * (size_t)s * before.vertices,
                                    3 * before.vertices * sizeof(float)) == 0);
    }
    // A cut of groups without strands reads nothing, and needs no memory.
    cut.groups = 4;
    scene.test->host.refuse = scene.test->host.allocations + 1;
    hair_instance* pieces = scene.hair;
    hair_test_ok(*state, hair_cut(scene.hair, &cut, &info, &pieces));
    scene.test->host.refuse = 0;
    assert_true(!pieces && info.strands == 0 && info.guides == 0 && info.length == 0);
    free(before.positions), free(after.positions), free(fractions);
    hair_test_scene_free(&scene);
}

// Positions far from the origin are exact to a quarter of a metre, as 4e6 m is a multiple of it.
static void a_cut_is_the_same_far_from_the_origin(void** state)
{
    const float far = 4e6f;
    float transform[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, far, 0, -far, 1};
    struct hair_test_scene near = hair_test_cut_scene(*state, HAIR_STRAND_SET_GUIDES, NULL, NULL, NULL);
    struct hair_test_scene away = hair_test_cut_scene(*state, HAIR_STRAND_SET_GUIDES, NULL, NULL, transform);
    hair_cut_desc cut = hair_cut_desc_default();
    cut.start[1] = 1.5f;
    hair_test_ok(*state, hair_cut(near.hair, &cut, NULL, NULL));
    cut.start[0] = far, cut.start[2] = -far;
    hair_test_ok(*state, hair_cut(away.hair, &cut, NULL, NULL));
    float *a = lengths_of(&near), *b = lengths_of(&away);
    for (uint32_t g = 0; g < HAIR_TEST_CUT_GUIDES; ++g)
        assert_true(a[g] < 0.8f && fabsf(a[g] - b[g]) < 1e-5f);
    free(a), free(b);
    hair_test_scene_free(&near), hair_test_scene_free(&away);
}

// A second cut at the same place finds nothing, and a cut above all roots leaves stubs.
static void cuts_follow_each_other(void** state)
{
    struct hair_test_scene scene = hair_test_cut_scene(*state, HAIR_STRAND_SET_GUIDES, NULL, NULL, NULL);
    hair_cut_desc cut = sloping_plane();
    hair_cut_info first = hair_cut_info_default(), second = first;
    hair_test_ok(*state, hair_cut(scene.hair, &cut, &first, NULL));
    hair_test_ok(*state, hair_cut(scene.hair, &cut, &second, NULL));
    print_message("    %.3f m are lost, then %.6f m\n", first.length, second.length);
    assert_true(first.length > 1 && second.length < 1e-4 * first.length);
    cut.start[1] = HAIR_TEST_CUT_HEIGHT + 1;
    cut.normal[0] = 0;
    hair_test_ok(*state, hair_cut(scene.hair, &cut, &second, NULL));
    struct hair_test_drawn after = hair_test_read_drawn(*state, scene.hair);
    float* fractions = lengths_of(&scene);
    print_message("    %.6f of %.3f m are left\n", hair_test_drawn_length_of_all(&after), second.length);
    assert_true(hair_test_drawn_length_of_all(&after) < 1e-3 * second.length);
    for (uint32_t g = 0; g < HAIR_TEST_CUT_GUIDES; ++g) assert_true(fractions[g] == 0);
    hair_test_ok(*state, hair_set_lengths(scene.hair, 0, HAIR_TEST_CUT_GUIDES, NULL));
    assert_null(scene.hair->sim.lengths.guides);
    free(after.positions), free(fractions);
    hair_test_scene_free(&scene);
}

// Return a shape of about 1 cm at the vertex `k` of a drawn strand.
static hair_cut_desc small_cut(hair_cut_shape shape, const struct hair_test_drawn* drawn, uint32_t strand,
                               uint32_t k)
{
    hair_cut_desc cut = hair_cut_desc_default();
    hair_vec3 at = hair_test_drawn_at(drawn, strand, k), right = {0.007f, 0.002f, 0},
              down = {0, 0.001f, 0.005f};
    cut.shape = shape;
    cut.radius = 0.004f;
    hair_store3(cut.start, hair_add(hair_add(at, right), down));
    hair_store3(cut.end, hair_sub(hair_add(at, right), down));
    hair_store3(cut.last_start, hair_add(hair_sub(at, right), down));
    hair_store3(cut.last_end, hair_sub(hair_sub(at, right), down));
    return cut;
}

// Return the number of drawn strands that meet a shape before their tips.
static uint32_t count_met(const hair_cut_desc* cut, const struct hair_test_drawn* drawn)
{
    const double origin[3] = {0};
    struct hair_cutter cutter = hair_cutter_from(cut, origin);
    uint32_t met = 0;
    for (uint32_t s = 0; s < drawn->count; ++s) {
        float t;
        for (uint32_t k = 0; k + 1 < drawn->vertices; ++k) {
            if (!hair_cutter_meets(&cutter, hair_test_drawn_at(drawn, s, k),
                                   hair_test_drawn_at(drawn, s, k + 1), &t))
                continue;
            ++met;
            break;
        }
    }
    return met;
}

// hair_cut() reads the patches that the shape reaches, and no others.
static void a_small_cut_meets_all_strands_that_it_reaches(void** state)
{
    struct hair_test_handmade groom = hair_test_handmade_default();
    groom.guides = 40, groom.followers = 800, groom.each = 10;
    hair_look look = curly();
    look.strand.segments = 24;
    struct hair_test_scene scene = hair_test_scene_of(*state, &groom, &look);
    uint32_t all = 0, most = 0;
    for (uint32_t i = 0; i < 30; ++i) {
        struct hair_test_drawn drawn = hair_test_read_drawn(*state, scene.hair);
        hair_cut_shape shape = i % 2 ? HAIR_CUT_SHAPE_CAPSULE : HAIR_CUT_SHAPE_BLADE;
        hair_cut_desc cut = small_cut(shape, &drawn, i * 37 % drawn.count, 2 + i * 11 % (drawn.vertices - 3));
        hair_cut_info info = hair_cut_info_default();
        uint32_t met = count_met(&cut, &drawn);
        hair_test_ok(*state, hair_cut(scene.hair, &cut, &info, NULL));
        assert_int_equal(info.strands, met);
        all += met, most = met > most ? met : most;
        hair_test_ok(*state, hair_set_lengths(scene.hair, 0, groom.guides, NULL));
        free(drawn.positions);
    }
    print_message("    30 small shapes cut %u strands of %u, at most %u each\n", all, groom.followers, most);
    assert_true(all >= 30 && most < groom.followers / 4);
    hair_test_scene_free(&scene);
}

static void wrong_cuts_are_refused_with_the_member(void** state)
{
    struct hair_test_scene scene = hair_test_cut_scene(*state, HAIR_STRAND_SET_GUIDES, NULL, NULL, NULL);
    hair_cut_desc cut = hair_cut_desc_default();
    hair_cut_info info = hair_cut_info_default();
    cut.normal[1] = 0;
    hair_test_refused(*state, hair_cut(scene.hair, &cut, &info, NULL), HAIR_ERROR_ARGUMENT,
                      "hair_cut_desc.normal is (0, 0, 0)");
    cut = sloping_plane();
    cut.start[2] = NAN;
    hair_test_refused(*state, hair_cut(scene.hair, &cut, &info, NULL), HAIR_ERROR_ARGUMENT,
                      "hair_cut_desc.start[2] is nan");
    cut.start[2] = 0, cut.shape = (hair_cut_shape)3;
    hair_test_refused(*state, hair_cut(scene.hair, &cut, &info, NULL), HAIR_ERROR_ARGUMENT,
                      "hair_cut_desc.shape is 3");
    cut = sloping_plane();
    info.header.version = 0;
    hair_test_refused(*state, hair_cut(scene.hair, &cut, &info, NULL), HAIR_ERROR_VERSION, "hair_cut_info");
    assert_int_equal(hair_cut(NULL, &cut, NULL, NULL), HAIR_ERROR_ARGUMENT);
    assert_null(scene.hair->sim.lengths.guides);
    hair_test_scene_free(&scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        HAIR_TEST(cut_strands_end_at_the_shape),
        HAIR_TEST(a_stroke_cuts_where_it_passes),
        HAIR_TEST(other_groups_are_not_cut),
        HAIR_TEST(a_cut_is_the_same_far_from_the_origin),
        HAIR_TEST(cuts_follow_each_other),
        HAIR_TEST(a_small_cut_meets_all_strands_that_it_reaches),
        HAIR_TEST(wrong_cuts_are_refused_with_the_member),
    };
    if (hair_test_skips()) return 0;
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
