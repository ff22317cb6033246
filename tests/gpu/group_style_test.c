// group_style_test.c - curls, frizz, locks and highlights of groups of strands in one instance,
// measured in metres, turns per metre and radians.
#include "tests/support/arcs.h"
#include "tests/support/beams.h"
#include "tests/support/passes.h"
#include "tests/support/scene.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tests/support/grooms.h"
#include "tests/support/render_paths.h"

#define FOLLOWERS 600
#define SEGMENTS 40u
#define EACH (SEGMENTS + 1)
#define PI 3.14159265358979

// Create straight guides, of which every second is in group 1.
static struct hair_test_scene start(struct hair_test* test)
{
    struct hair_test_handmade wanted = hair_test_handmade_default();
    wanted.guides = 7, wanted.turn = 0, wanted.segment = 0.025f, wanted.followers = FOLLOWERS;
    struct hair_test_scene scene = hair_test_scene_of(test, &wanted, NULL);
    for (uint32_t g = 0; g < wanted.guides; ++g) scene.groom->guides[g].group = g % 2;
    return scene;
}

static hair_look plain_look(void)
{
    hair_look look = hair_look_default();
    look.strand.segments = SEGMENTS;
    look.strays.tip_fraction = look.strays.fraction = 0;
    look.clump.interpolation = HAIR_INTERPOLATION_SINGLE;
    return look;
}

static uint32_t group_of(const struct hair_test_scene* scene, size_t follower)
{
    return scene->groom->guides[scene->groom->followers[follower].guide0].group;
}

// Return the vertices of all followers with a look, and with the look of group 1.
static float* read_with(const struct hair_test_scene* scene, const hair_look* look,
                        const hair_group_look* group)
{
    uint32_t count = FOLLOWERS * EACH, there;
    float* positions = malloc(3 * sizeof *positions * count);
    hair_test_ok(scene->test, hair_set_look(scene->hair, look));
    hair_test_ok(scene->test, hair_set_group_look(scene->hair, 1, group));
    hair_test_ok(scene->test,
                 hair_read_positions(scene->hair, HAIR_READ_FOLLOWERS, positions, count, &there));
    assert_int_equal(there, count);
    return positions;
}

// Mean over the vertices of each group.
struct measured {
    double rms; // Distance from the plain strand, m.
    double turns; // Turns around the plain strand, 1/m.
};

static void measure(const struct hair_test_scene* scene, const float* plain, const float* moved,
                    struct measured out[2])
{
    double square[2] = {0}, angle[2] = {0}, along[2] = {0}, count[2] = {0};
    for (size_t n = 0; n < FOLLOWERS; ++n)
        for (size_t k = n * EACH; k < n * EACH + SEGMENTS; ++k) {
            uint32_t g = group_of(scene, n);
            hair_vec3 a = hair_sub(hair_load3(moved + 3 * k), hair_load3(plain + 3 * k));
            hair_vec3 b = hair_sub(hair_load3(moved + 3 * k + 3), hair_load3(plain + 3 * k + 3));
            hair_vec3 axis = hair_sub(hair_load3(plain + 3 * k + 3), hair_load3(plain + 3 * k));
            double step = (double)hair_length(axis);
            square[g] += (double)hair_dot(a, a);
            angle[g] += fabs(atan2((double)hair_dot(hair_cross(a, b), axis) / step, (double)hair_dot(a, b)));
            along[g] += step, ++count[g];
        }
    for (int g = 0; g < 2; ++g) {
        assert_true(count[g] > 1000);
        out[g] = (struct measured){sqrt(square[g] / count[g]), angle[g] / (2 * PI * along[g])};
    }
}

static void curls_of_a_group_have_its_radius_and_frequency(void** state)
{
    struct hair_test_scene scene = start(*state);
    hair_look look = plain_look();
    hair_group_look group = hair_group_look_default();
    struct measured found[2];
    float* plain = read_with(&scene, &look, NULL);
    look.curl.radius = 0.004f, look.curl.wavelength = 0.2f, look.curl.spread = 0;
    look.curl.profile = hair_curve_line(1, 1);
    group.curl.radius = 2.5f, group.curl.frequency = 3;
    float* curled = read_with(&scene, &look, &group);
    measure(&scene, plain, curled, found);
    printf("%.4f and %.4f m, %.3f and %.3f turns per metre\n", found[0].rms, found[1].rms, found[0].turns,
           found[1].turns);
    hair_test_near("radius", 0, found[0].rms, 0.004, 4e-6);
    hair_test_near("radius", 1, found[1].rms, 0.01, 1e-5);
    hair_test_near("turns", 0, found[0].turns, 5, 0.05);
    hair_test_near("turns", 1, found[1].turns, 15, 0.15);
    // A group without curls is as straight as before.
    group.curl.radius = 0;
    float* straight = read_with(&scene, &look, &group);
    for (size_t n = 0; n < FOLLOWERS; ++n) {
        const size_t first = 3 * n * EACH;
        float error = hair_test_max_difference(straight + first, plain + first, 3 * EACH);
        assert_true(group_of(&scene, n) == 1 ? error < 1e-6f : error > 1e-3f);
    }
    free(plain), free(curled), free(straight);
    hair_test_scene_free(&scene);
}

static void frizz_of_a_group_moves_strands_as_much_more(void** state)
{
    struct hair_test_scene scene = start(*state);
    hair_look look = plain_look();
    hair_group_look group = hair_group_look_default();
    struct measured once[2], thrice[2];
    float* plain = read_with(&scene, &look, NULL);
    look.strays.frizz = hair_curve_line(0.002f, 0.002f), look.strays.frizz_wavelength = 0.1f;
    float* same = read_with(&scene, &look, &group);
    group.frizz = 3;
    float* more = read_with(&scene, &look, &group);
    measure(&scene, plain, same, once);
    measure(&scene, plain, more, thrice);
    printf("%.3f and %.3f mm become %.3f and %.3f mm\n", 1e3 * once[0].rms, 1e3 * once[1].rms,
           1e3 * thrice[0].rms, 1e3 * thrice[1].rms);
    assert_true(once[1].rms > 5e-4 && thrice[0].rms == once[0].rms);
    hair_test_near("displacement", 1, thrice[1].rms, 3 * once[1].rms, 1e-6);
    free(plain), free(same), free(more);
    hair_test_scene_free(&scene);
}

// A group that clumps by a fraction has the shape of a look with that fraction of the weight.
static void clump_of_a_group_is_a_fraction_of_the_weight(void** state)
{
    struct hair_test_scene scene = start(*state);
    hair_look look = plain_look();
    hair_group_look group = hair_group_look_default();
    look.clump.interpolation = HAIR_INTERPOLATION_MIXED;
    for (int step = 0; step < 3; ++step) {
        group.clump = (float)step / 2;
        look.clump.weight = hair_curve_line(0, group.clump);
        float* wanted = read_with(&scene, &look, NULL);
        look.clump.weight = hair_curve_line(0, 1);
        float* found = read_with(&scene, &look, &group);
        uint32_t differ = 0;
        for (size_t n = 0; n < FOLLOWERS; ++n) {
            const size_t first = 3 * n * EACH;
            float error = hair_test_max_difference(found + first, wanted + first, 3 * EACH);
            if (group_of(&scene, n) == 1) assert_true(error < 1e-6f);
            differ += error > 1e-4f;
        }
        assert_true(step == 2 ? differ == 0 : differ > FOLLOWERS / 10);
        free(wanted), free(found);
    }
    hair_test_scene_free(&scene);
}

static void highlight_is_as_wide_as_the_roughness_of_its_group(void** state)
{
    for (int model = 0; model < 2; ++model) {
        struct hair_test_arcs arcs;
        hair_test_arcs_start(*state, model == 1, NULL, &arcs);
        struct hair_test* test = *state;
        hair_group_look group = hair_group_look_default();
        const uint32_t culled = hair_test_runs_of(&test->context->gl, "cull_patches");
        for (int path = 0; path < HAIR_TEST_PATHS; ++path) {
            double usual[2], rough[2];
            group.roughness = 1;
            hair_test_ok(test, hair_set_group_look(arcs.scene.hair, 1, &group));
            hair_test_arcs_measure(&arcs, hair_test_paths[path], usual);
            hair_test_near("width", 0, usual[0], usual[1], 0.02 * usual[1]);
            group.roughness = 2;
            hair_test_ok(test, hair_set_group_look(arcs.scene.hair, 1, &group));
            hair_test_arcs_measure(&arcs, hair_test_paths[path], rough);
            printf("model %d, path %d: %.4f rad, rough %.4f rad\n", model, path, usual[1], rough[1]);
            hair_test_near("width", 1, rough[0], usual[1], 0.02 * usual[1]);
            hair_test_near("width", 2, rough[1], 2 * usual[1], 0.1 * usual[1]);
        }
        assert_true(hair_test_runs_of(&test->context->gl, "cull_patches") > culled);
        hair_test_arcs_free(&arcs);
    }
}

static void factors_of_one_cost_no_memory_and_no_program(void** state)
{
    struct hair_test_scene scene = start(*state);
    struct hair_test* test = scene.test;
    hair_look look = plain_look();
    hair_group_look group = hair_group_look_default();
    look.curl.radius = 0.004f;
    const uint32_t runs = hair_test_runs_of(&test->context->gl, "_group_looks");
    float* plain = read_with(&scene, &look, NULL);
    const uint64_t bytes = hair_test_gpu_bytes(test);
    float* same = read_with(&scene, &look, &group);
    assert_memory_equal(same, plain, 3 * sizeof *plain * FOLLOWERS * EACH);
    assert_int_equal(hair_test_gpu_bytes(test), bytes);
    assert_int_equal(hair_test_runs_of(&test->context->gl, "_group_looks"), runs);
    group.curl.radius = 2;
    free(read_with(&scene, &look, &group));
    assert_int_equal(hair_test_gpu_bytes(test),
                     bytes + HAIR_STRAND_GROUPS * sizeof(struct hair_group_factors));
    assert_true(hair_test_runs_of(&test->context->gl, "_group_looks") > runs);
    free(same);
    same = read_with(&scene, &look, NULL);
    assert_memory_equal(same, plain, 3 * sizeof *plain * FOLLOWERS * EACH);
    assert_int_equal(hair_test_gpu_bytes(test), bytes);
    free(plain), free(same);
    hair_test_scene_free(&scene);
}

static void wrong_factors_are_refused_by_name(void** state)
{
    struct hair_test_scene scene = start(*state);
    hair_group_look group = hair_group_look_default();
    group.curl.frequency = -1;
    hair_test_refused(scene.test, hair_set_group_look(scene.hair, 1, &group), HAIR_ERROR_ARGUMENT,
                      "hair_group_look.curl.frequency is -1, not in [0, 4]");
    group.curl.frequency = 1, group.roughness = 0;
    hair_test_refused(scene.test, hair_set_group_look(scene.hair, 1, &group), HAIR_ERROR_ARGUMENT,
                      "hair_group_look.roughness is 0, not in [0.2, 4]");
    hair_test_scene_free(&scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        HAIR_TEST(curls_of_a_group_have_its_radius_and_frequency),
        HAIR_TEST(frizz_of_a_group_moves_strands_as_much_more),
        HAIR_TEST(clump_of_a_group_is_a_fraction_of_the_weight),
        HAIR_TEST(highlight_is_as_wide_as_the_roughness_of_its_group),
        HAIR_TEST(factors_of_one_cost_no_memory_and_no_program),
        HAIR_TEST(wrong_factors_are_refused_by_name),
    };
    if (hair_test_skips()) return 0;
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
