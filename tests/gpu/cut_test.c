// cut_test.c - hair that is cut and grows while it is simulated, by every solver and mapping.
#include "tests/support/cut_scene.h"
#include "tests/support/ways.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <hair/hair_cut.h>

#include "lib/api/api.h"

#define GUIDES HAIR_TEST_CUT_CURL

static struct hair_state* read_states(struct hair_test_living* living)
{
    struct hair_state* states = calloc(living->vertices, sizeof *states);
    glGetNamedBufferSubData(living->hair->sim.state, 0, (GLsizeiptr)(living->vertices * sizeof *states),
                            states);
    return states;
}

static hair_vec3 at(const struct hair_state* states, uint32_t i)
{
    return hair_test_xyz(states[i].position);
}

// Return the maximum displacement of a vertex over the last substep, m.
static double max_displacement(const struct hair_state* states, uint32_t count)
{
    double max = 0;
    for (uint32_t i = 0; i < count; ++i)
        max = fmax(max, (double)hair_length(hair_test_xyz(states[i].displacement)));
    return max;
}

static uint32_t tip_of(const struct hair_test_living* living, uint32_t g)
{
    const struct hair_guide* guides = living->hair->sim.lengths.guides;
    return (guides ? guides : living->groom->guides)[g].count - 1;
}

// Return the length of a guide up to its tip, m.
static double length_of(const struct hair_test_living* living, const struct hair_state* states, uint32_t g)
{
    uint32_t first = living->groom->guides[g].first;
    double length = 0;
    for (uint32_t i = first; i < first + tip_of(living, g); ++i)
        length += (double)hair_distance(at(states, i), at(states, i + 1));
    return length;
}

static void a_cut_keeps_what_stays_and_its_motion(void** state)
{
    for (int way = 0; way < HAIR_TEST_WAYS; way += 2) {
        struct hair_test_living living;
        hair_test_cut_live(*state, way, &living);
        hair_test_cut_shake(&living, 0, 20);
        struct hair_state* before = read_states(&living);
        const float fraction[GUIDES] = {0.4f, 0.62f};
        hair_test_cut_lengths(&living, fraction[0], fraction[1]);
        struct hair_state* after = read_states(&living);
        for (uint32_t g = 0; g < GUIDES; ++g) {
            const struct hair_guide* whole = &living.groom->guides[g];
            uint32_t first = whole->first, tip = first + tip_of(&living, g);
            assert_true(tip + 1 < first + whole->count);
            assert_memory_equal(before + first, after + first, (tip - first) * sizeof *before);
            // The tip is on the old segment, or on its line where the next segment begins.
            double kept = length_of(&living, after, g), wanted = (double)(fraction[g] * whole->arc_length);
            double segment = (double)hair_distance(at(before, tip), at(before, tip - 1));
            double last = (double)hair_distance(at(after, tip), at(after, tip - 1));
            hair_vec3 bent = hair_cross(hair_sub(at(after, tip), at(after, tip - 1)),
                                        hair_sub(at(before, tip), at(before, tip - 1)));
            assert_true((double)hair_length(bent) < 1e-4 * segment * last);
            assert_true(0.2 * segment < last && last < 1.3 * segment);
            print_message("    %s, guide %u: %.2f mm long, not %.2f\n", hair_test_way_name(way), g,
                          kept * 1e3, wanted * 1e3);
            // Redblack stretches guides.
            double tolerance = living.hair->sim.solver == HAIR_SOLVER_REDBLACK ? 0.2 : 1e-3;
            assert_true(fabs(kept / wanted - 1) < tolerance);
        }
        assert_true(max_displacement(after, living.vertices) <= max_displacement(before, living.vertices));
        hair_test_cut_shake(&living, 20, 60);
        hair_test_read_guides(&living); // All are finite.
        hair_solver_stats stats = hair_test_solver_stats(&living);
        assert_int_equal(stats.reset, 0);
        free(before), free(after);
        hair_test_die(&living);
    }
}

// Check the preload of all guides against one that is computed anew, except guide `kept`.
static void check_preload(const struct hair_test_living* living, uint32_t kept)
{
    const struct hair_sim* sim = &living->hair->sim;
    struct hair_rod_source source = hair_sim_rod_source(sim);
    struct hair_rod_borne* borne = calloc(source.vertices, sizeof *borne);
    float sags[GUIDES];
    hair_test_ok(living->test, hair_rods_preload_all(&source, &sim->physics, NULL, borne, sags));
    struct hair_rods_report wanted = hair_rods_report_of(source.guides, GUIDES, borne, sags);
    struct hair_rods_report report = hair_sim_preload_report(sim);
    for (uint32_t g = 0; g < GUIDES; ++g) {
        uint32_t first = source.guides[g].first;
        size_t size = source.guides[g].count * sizeof *borne;
        assert_int_equal(memcmp(sim->rods->borne + first, borne + first, size) == 0, g != kept);
    }
    assert_true(report.stiffened == wanted.stiffened && report.stiffest == wanted.stiffest);
    assert_true(report.sagging == wanted.sagging && report.farthest_sag == wanted.farthest_sag);
    free(borne);
}

// A mark in the preload of a guide shows that the guide is not computed again.
static void preload_is_computed_where_lengths_change(void** state)
{
    const uint32_t none = GUIDES;
    struct hair_test_living living;
    hair_test_cut_live(*state, 0, &living);
    struct hair_rods* rods = living.hair->sim.rods;
    hair_test_cut_lengths(&living, 0.7f, 0.8f);
    hair_test_cut_shake(&living, 0, 1);
    check_preload(&living, none);
    rods->own_borne[living.groom->guides[1].first].rest_real += 0.5;
    hair_test_cut_lengths(&living, 0.5f, 0.8f);
    hair_test_cut_shake(&living, 1, 2);
    check_preload(&living, 1);
    hair_test_cut_lengths(&living, 0.5f, 0.6f);
    hair_test_cut_shake(&living, 2, 3);
    check_preload(&living, none);
    hair_physics stiff = hair_physics_default();
    stiff.fiber.youngs_modulus *= 2;
    hair_test_ok(living.test, hair_set_physics(living.hair, &stiff));
    hair_test_cut_lengths(&living, 1, 0.6f);
    hair_test_cut_shake(&living, 3, 4);
    check_preload(&living, none);
    hair_test_cut_lengths(&living, 1, 1);
    hair_test_cut_shake(&living, 4, 5);
    check_preload(&living, none);
    assert_null(rods->borne_fractions);
    hair_test_die(&living);
}

static void a_cut_does_not_move_hair_at_rest(void** state)
{
    for (int way = 0; way < HAIR_TEST_WAYS; way += 2) {
        struct hair_test_living living;
        hair_test_cut_live(*state, way, &living);
        hair_test_wait(&living, 120);
        hair_test_cut_lengths(&living, 0.35f, 0.5f);
        hair_test_read_guides(&living);
        hair_test_wait(&living, 60);
        hair_test_read_guides(&living);
        print_message("    %s: hair at rest moves by %.3f mm\n", hair_test_way_name(way),
                      hair_test_moved(&living) * 1e3);
        if (living.hair->sim.rods && living.hair->sim.solver != HAIR_SOLVER_FOLLOW)
            assert_true(hair_test_moved(&living) < 1e-4);
        hair_test_die(&living);
    }
}

static void hair_that_grows_gains_no_speed(void** state)
{
    for (int way = 0; way < HAIR_TEST_WAYS; way += 2) {
        struct hair_test_living living;
        hair_test_cut_live(*state, way, &living);
        hair_test_cut_lengths(&living, 0.2f, 0.2f);
        for (int i = 0; i <= 40; ++i) {
            float fraction = fminf(0.2f + 0.02f * (float)i, 1);
            hair_test_cut_shake(&living, i, i + 1);
            struct hair_state* before = read_states(&living);
            hair_test_cut_lengths(&living, fraction, i == 20 ? 1 : fraction);
            struct hair_state* after = read_states(&living);
            assert_true(max_displacement(after, living.vertices) <=
                        1.0001 * max_displacement(before, living.vertices));
            for (uint32_t g = 0; g < GUIDES; ++g) {
                double wanted = (double)living.hair->sim.lengths.guide_fraction[g];
                double kept = length_of(&living, after, g) / (double)living.groom->guides[g].arc_length;
                if (living.hair->sim.solver != HAIR_SOLVER_REDBLACK) assert_true(fabs(kept - wanted) < 2e-3);
            }
            free(before), free(after);
        }
        hair_test_cut_lengths(&living, 1, 1);
        assert_null(living.hair->sim.lengths.guides);
        assert_int_equal(living.hair->sim.lengths.follower, 0);
        hair_test_die(&living);
    }
}

static float* read_followers(struct hair_test_living* living, uint32_t* count)
{
    hair_test_ok(living->test, hair_read_positions(living->hair, HAIR_READ_FOLLOWERS, NULL, 0, count));
    float* positions = calloc(*count, 3 * sizeof *positions);
    hair_test_ok(living->test,
                 hair_read_positions(living->hair, HAIR_READ_FOLLOWERS, positions, *count, count));
    return positions;
}

// Followers of half the length have their vertices at every other place of whole followers, with
// all that the look does to them.
static void followers_keep_their_places(void** state)
{
    struct hair_test_living living;
    hair_look look = hair_look_default();
    hair_test_cut_live(*state, 0, &living);
    look.strand.segments = 32;
    look.curl.radius = 0.004f, look.curl.wavelength = 0.03f;
    look.strays.fraction = 1, look.strays.frizz_fraction = 1;
    hair_test_ok(*state, hair_set_look(living.hair, &look));
    hair_test_cut_shake(&living, 0, 20);
    uint32_t count, each = look.strand.segments + 1;
    float* whole = read_followers(&living, &count);
    hair_test_cut_lengths(&living, 0.5f, 0.5f);
    float* half = read_followers(&living, &count);
    double off = 0;
    for (uint32_t f = 0; f < count / each; ++f)
        for (uint32_t k = 0; k < each - 2; k += 2)
            off = fmax(off, (double)hair_distance(hair_load3(half + 3 * (f * each + k)),
                                                  hair_load3(whole + 3 * (f * each + k / 2))));
    print_message("    %u followers are within %.4f mm of their places\n", count / each, off * 1e3);
    assert_true(count >= 2 * each && off < 4e-4);
    free(whole), free(half);
    hair_test_cut_lengths(&living, 0, 0);
    half = read_followers(&living, &count);
    for (uint32_t f = 0; f < count / each; ++f)
        assert_true(hair_distance(hair_load3(half + 3 * f * each),
                                  hair_load3(half + 3 * (f * each + each - 1))) < 1e-4f);
    free(half);
    hair_test_die(&living);
}

// Return the rods of all guides after a step, and their size in bytes.
static hair_vec4* read_rods(struct hair_test_living* living, GLint* size)
{
    glGetNamedBufferParameteriv(living->hair->sim.rod, GL_BUFFER_SIZE, size);
    assert_true(*size >= (GLint)(32 * living->vertices));
    hair_vec4* rods = malloc((size_t)*size);
    glGetNamedBufferSubData(living->hair->sim.rod, 0, *size, rods);
    return rods;
}

static void hair_that_has_grown_again_is_as_it_was(void** state)
{
    for (int way = 0; way < HAIR_TEST_WAYS; way += 2) {
        struct hair_test_living never, cut;
        hair_test_cut_live(*state, way, &never), hair_test_cut_live(*state, way, &cut);
        hair_test_cut_lengths(&cut, 0.3f, 0.7f);
        hair_test_cut_shake(&cut, 0, 10), hair_test_cut_shake(&never, 0, 10);
        hair_test_ok(*state, hair_set_lengths(cut.hair, 0, GUIDES, NULL));
        hair_test_ok(*state, hair_reset(cut.hair));
        hair_test_ok(*state, hair_reset(never.hair));
        hair_test_cut_shake(&cut, 0, 30), hair_test_cut_shake(&never, 0, 30);
        hair_test_read_guides(&cut), hair_test_read_guides(&never);
        assert_memory_equal(cut.positions, never.positions, never.vertices * 3 * sizeof(float));
        if (cut.hair->sim.rods) {
            GLint size, other;
            hair_vec4 *a = read_rods(&cut, &size), *b = read_rods(&never, &other);
            assert_int_equal(size, other);
            assert_memory_equal(a, b, (size_t)size);
            free(a), free(b);
        }
        hair_test_die(&never), hair_test_die(&cut);
    }
}

static void lost_vertices_are_read_at_the_tip(void** state)
{
    struct hair_test_living living;
    hair_test_cut_live(*state, 0, &living);
    hair_test_cut_shake(&living, 0, 10);
    hair_test_cut_lengths(&living, 0.5f, 1);
    hair_test_read_guides(&living);
    uint32_t tip = tip_of(&living, 0), count = living.groom->guides[0].count;
    assert_true(tip + 1 < count);
    for (uint32_t i = tip; i < count; ++i)
        assert_memory_equal(living.positions + 3 * i, living.positions + 3 * tip, 12);
    hair_test_die(&living);
}

// Guides at targets of the full weight have their tips on the segments of their targets.
static void guides_at_targets_are_cut_and_grow(void** state)
{
    struct hair_test_living living;
    hair_target_blend blend = hair_target_blend_default();
    blend.blend_time = 0;
    hair_test_cut_live(*state, 0, &living);
    uint32_t count = living.vertices;
    float* targets = calloc(count, 3 * sizeof *targets);
    for (uint32_t i = 0; i < count; ++i) {
        hair_vec4 place = living.groom->rest[i].position;
        hair_store3(targets + 3 * i, hair_v3(place.x, place.y, 1.5f * place.z + 0.01f));
    }
    hair_test_ok(*state, hair_set_target_blend(living.hair, &blend));
    hair_test_ok(*state, hair_set_targets(living.hair, targets, count, 12, NULL));
    hair_test_wait(&living, 5);
    for (int grows = 0; grows < 2; ++grows) {
        hair_test_cut_lengths(&living, grows ? 1 : 0.5f, grows ? 0.9f : 0.55f);
        hair_test_wait(&living, 1);
        struct hair_state* states = read_states(&living);
        for (uint32_t g = 0; g < GUIDES; ++g) {
            uint32_t first = living.groom->guides[g].first, tip = first + tip_of(&living, g);
            for (uint32_t i = first; i < tip; ++i)
                assert_true(hair_distance(at(states, i), hair_load3(targets + 3 * i)) < 1e-5f || grows);
            hair_vec3 segment = hair_sub(hair_load3(targets + 3 * tip), hair_load3(targets + 3 * tip - 3));
            hair_vec3 own = hair_sub(at(states, tip), at(states, tip - 1));
            hair_vec3 bent = hair_cross(own, segment);
            assert_true(hair_length(bent) < 1e-3f * hair_length(own) * hair_length(segment) || grows);
        }
        // Nothing moves when hair is cut. What grows moves to its target over the step.
        double fastest = max_displacement(states, count);
        print_message("    %s at targets moves %.4f mm\n", grows ? "grown hair" : "cut hair", fastest * 1e3);
        assert_true(fastest < (grows ? 0.02 : 1e-5));
        free(states);
    }
    hair_test_wait(&living, 5);
    hair_test_read_guides(&living);
    for (uint32_t i = 0; i < living.groom->guides[0].count; ++i)
        assert_true(hair_distance(hair_load3(living.positions + 3 * i), hair_load3(targets + 3 * i)) < 1e-5f);
    free(targets);
    hair_test_die(&living);
}

static void pins_of_lost_vertices_end(void** state)
{
    struct hair_test_living living;
    hair_test_cut_live(*state, 0, &living);
    hair_pin pins[2] = {hair_pin_default(), hair_pin_default()};
    for (uint32_t i = 0; i < 2; ++i) {
        hair_vec4 place = living.groom->rest[4 + 10 * i].position;
        pins[i].vertex = 4 + 10 * i;
        pins[i].position[0] = place.x, pins[i].position[1] = place.y, pins[i].position[2] = place.z;
    }
    hair_test_ok(*state, hair_set_pins(living.hair, pins, 2, sizeof *pins));
    hair_test_wait(&living, 2);
    hair_test_cut_lengths(&living, 0.5f, 1);
    assert_int_equal(living.hair->sim.pins.count, 1);
    hair_test_wait(&living, 10);
    hair_test_read_guides(&living);
    hair_test_cut_lengths(&living, 0, 0);
    hair_test_wait(&living, 10);
    hair_test_read_guides(&living);
    assert_int_equal(living.hair->sim.pins.count, 0);
    hair_test_die(&living);
}

static void wrong_lengths_are_refused_with_their_range(void** state)
{
    struct hair_test* test = *state;
    struct hair_test_living living;
    float f[GUIDES] = {0.5f, NAN};
    hair_test_cut_live(test, 0, &living);
    hair_instance* hair = living.hair;
    hair_test_refused(test, hair_set_lengths(hair, 0, 2, f), HAIR_ERROR_ARGUMENT, "fractions[1] is nan");
    f[1] = -0.1f;
    hair_test_refused(test, hair_set_lengths(hair, 0, 2, f), HAIR_ERROR_ARGUMENT, "is -0.1, not in [0, 1]");
    f[1] = 1.5f;
    hair_test_refused(test, hair_set_lengths(hair, 0, 2, f), HAIR_ERROR_ARGUMENT, "is 1.5, not in [0, 1]");
    hair_test_refused(test, hair_set_lengths(hair, 0, 3, f), HAIR_ERROR_ARGUMENT, "there are 2 guides");
    hair_test_refused(test, hair_set_lengths(hair, 2, UINT32_MAX, NULL), HAIR_ERROR_ARGUMENT, "2 guides");
    hair_test_refused(test, hair_set_lengths(hair, UINT32_MAX, 2, f), HAIR_ERROR_ARGUMENT, "2 guides");
    hair_test_refused(test, hair_get_lengths(hair, 0, 1, NULL), HAIR_ERROR_ARGUMENT, "fractions is NULL");
    hair_test_refused(test, hair_get_lengths(hair, 1, 2, f), HAIR_ERROR_ARGUMENT, "there are 2 guides");
    hair_test_ok(test, hair_set_lengths(hair, 2, 0, NULL));
    assert_null(hair->sim.lengths.guides);
    hair_test_ok(test, hair_get_lengths(hair, 0, 2, f));
    assert_true(f[0] == 1 && f[1] == 1);
    hair_test_die(&living);

    struct hair_test_strands strands = hair_test_straight_and_curl();
    hair_desc desc = hair_desc_default();
    desc.solver = HAIR_SOLVER_REDBLACK;
    desc.thread_mapping = HAIR_THREAD_MAPPING_FEEDBACK;
    hair_test_live(test, &strands, &desc, &living);
    hair_test_refused(test, hair_set_lengths(living.hair, 0, 2, f), HAIR_ERROR_ARGUMENT, "FEEDBACK");
    hair_test_strands_free(&strands);
    hair_test_die(&living);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        HAIR_TEST(a_cut_keeps_what_stays_and_its_motion),
        HAIR_TEST(preload_is_computed_where_lengths_change),
        HAIR_TEST(a_cut_does_not_move_hair_at_rest),
        HAIR_TEST(hair_that_grows_gains_no_speed),
        HAIR_TEST(hair_that_has_grown_again_is_as_it_was),
        HAIR_TEST(followers_keep_their_places),
        HAIR_TEST(lost_vertices_are_read_at_the_tip),
        HAIR_TEST(guides_at_targets_are_cut_and_grow),
        HAIR_TEST(pins_of_lost_vertices_end),
        HAIR_TEST(wrong_lengths_are_refused_with_their_range),
    };
    if (hair_test_skips()) return 0;
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
