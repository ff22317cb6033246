// drawn_fraction_test.c - densities and fractions of segments: every render path draws as many
// strands and segments as asked.
#include "tests/support/captured_lines.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "lib/api/api.h"
#include "tests/support/handmade.h"

// Absolute tolerance, in metres. Every path evaluates one GLSL function, compiled separately.
// Lengths under 0.5 m are rounded to a relative 2^-24 in another order. For strands of 0.07 m and
// more the tolerance is less than 1e-5 of the length.
#define TOLERANCE (10 * 0.5 / 16777216)

static size_t count_drawn(struct hair_test* test, size_t path, float density, uint32_t segments)
{
    struct hair_test_handmade wanted = hair_test_handmade_default();
    wanted.followers = 1000;
    wanted.each = 64;
    hair_groom* groom = hair_test_groom(&test->host.host, wanted);
    hair_look look = hair_test_even_look(segments);
    hair_desc desc = hair_desc_default();
    hair_instance* hair = NULL;
    look.followers.density = density;
    desc.look = &look;
    hair_test_ok(test, hair_create(test->context, groom, &desc, &hair));
    struct hair_test_lines drawn =
        hair_test_capture_lines(test, hair, path, (size_t)1000 * segments, 0, NULL);
    assert_int_equal(drawn.generated, drawn.segments);
    free(drawn.vertices);
    hair_destroy(hair);
    hair_groom_destroy(groom);
    assert_int_equal(drawn.segments % segments, 0);
    return drawn.segments / segments;
}

static void density_map_of_0_draws_nothing(void** state)
{
    for (size_t path = 0; path < HAIR_TEST_CAPTURED_PATHS; ++path)
        assert_int_equal(count_drawn(*state, path, 0, 8), 0);
}

// Check the density. The last isoline of each of the 16 patches is drawn if any part of it is
// included.
static void density_map_is_the_drawn_fraction_of_followers(void** state)
{
    for (size_t path = 0; path < HAIR_TEST_CAPTURED_PATHS; ++path) {
        for (int i = 1; i <= 16; ++i) {
            size_t drawn = count_drawn(*state, path, (float)i / 16, 8);
            assert_in_range(drawn, (size_t)(1000 * i / 16), (size_t)(1000 * i / 16) + 16);
        }
        assert_int_equal(count_drawn(*state, path, 1, 8), 1000);
        assert_int_equal(count_drawn(*state, path, 1e-6f, 8), 16);
    }
}

static void patch_without_density_draws_nothing(void** state)
{
    struct hair_test* test = *state;
    struct hair_test_handmade wanted = hair_test_handmade_default();
    wanted.density = 0;
    hair_groom* groom = hair_test_groom(&test->host.host, wanted);
    hair_desc desc = hair_desc_default();
    hair_instance* hair = NULL;
    groom->patches[1].density = 1;
    hair_test_ok(test, hair_create(test->context, groom, &desc, &hair));
    for (size_t path = 0; path < HAIR_TEST_CAPTURED_PATHS; ++path) {
        struct hair_test_lines drawn = hair_test_capture_lines(test, hair, path, 64 * 32, 0, NULL);
        assert_int_equal(drawn.segments, groom->patches[1].count * 32);
        free(drawn.vertices);
    }
    hair_destroy(hair);
    hair_groom_destroy(groom);
}

// Check two sets of maps. The first patch grows hair with the first set. The second patch grows
// hair with the second set, twice as thick.
static void map_sets_blend_density_and_thickness(void** state)
{
    struct hair_test* test = *state;
    struct hair_test_handmade wanted = hair_test_handmade_default();
    wanted.followers = 64;
    wanted.each = 32;
    hair_groom* groom = hair_test_groom(&test->host.host, wanted);
    hair_look look = hair_test_even_look(4);
    hair_desc desc = hair_desc_default();
    hair_instance* hair = NULL;
    groom->map_sets = 2;
    groom->patches[0].map_density = (hair_vec4){1, 0, 0, 0};
    groom->patches[1].map_density = (hair_vec4){0, 1, 1, 1};
    groom->patches[1].map_thickness = (hair_vec4){1, 2, 2, 2};
    desc.look = &look;
    hair_test_ok(test, hair_create(test->context, groom, &desc, &hair));
    for (size_t i = 0; i < 7 * HAIR_TEST_CAPTURED_PATHS; ++i) {
        // There is no set beyond the last one.
        float set = 0.25f * (float)(i % 7), blend = fminf(set, 1);
        look.followers.map_set = set;
        hair_test_ok(test, hair_set_look(hair, &look));
        struct hair_test_lines drawn = hair_test_capture_lines(test, hair, i / 7, (size_t)64 * 4, 0, NULL);
        size_t first = (size_t)(32 * (1 - blend)), second = (size_t)(32 * blend);
        assert_int_equal(drawn.segments, 4 * (first + second));
        hair_test_sort_lines(&drawn);
        for (size_t k = 0; k < drawn.segments; ++k) {
            double radius = (double)drawn.vertices[2 * k].radius / 0.001;
            double own = 1 + (double)(k / 4 < first ? k / 4 : 32 + k / 4 - first) / 65536;
            hair_test_near("radius", k, radius, (k / 4 < first ? 1 : 1 + (double)blend) * own, 1e-5);
        }
        free(drawn.vertices);
    }
    hair_destroy(hair);
    hair_groom_destroy(groom);
}

// Check numbers of segments that are not whole. Without a tessellator, some of the segments have no
// length.
static void segment_fraction_is_drawn_equally_by_every_path(void** state)
{
    static const float fractions[] = {1, 0.9f, 0.5f, 0.33f, 0.1f};
    struct hair_test* test = *state;
    struct hair_test_handmade wanted = hair_test_handmade_default();
    wanted.followers = 200;
    hair_groom* groom = hair_test_groom(&test->host.host, wanted);
    hair_look look = hair_test_even_look(32);
    hair_desc desc = hair_desc_default();
    hair_lod lod = hair_lod_default();
    hair_instance* hair = NULL;
    desc.look = &look;
    lod.per_patch = false;
    hair_test_ok(test, hair_create(test->context, groom, &desc, &hair));
    for (size_t i = 0; i < sizeof fractions / sizeof *fractions; ++i) {
        lod.segment_fraction = fractions[i];
        struct hair_test_lines tessellated =
            hair_test_capture_lines(test, hair, HAIR_TEST_TESSELLATION, 200 * 32, 0, &lod);
        assert_int_equal(tessellated.segments, 200 * (size_t)ceilf(32 * fractions[i]));
        hair_test_sort_lines(&tessellated);
        struct hair_test_lines drawn =
            hair_test_capture_lines(test, hair, HAIR_TEST_PROCEDURAL, 200 * 64, 0, &lod);
        double worst = 0;
        size_t at = 0;
        hair_test_sort_lines(&drawn);
        for (size_t k = 0; k < 2 * drawn.segments; k += 2) {
            const struct hair_test_vertex *a = &drawn.vertices[k], *b = &tessellated.vertices[at];
            if (!memcmp(a, a + 1, sizeof *a)) continue;
            assert_true(at < 2 * tessellated.segments);
            at += 2;
            for (int end = 0; end < 2; ++end) {
                worst = fmax(worst, fabs((double)a[end].x - (double)b[end].x));
                worst = fmax(worst, fabs((double)a[end].y - (double)b[end].y));
                worst = fmax(worst, fabs((double)a[end].z - (double)b[end].z));
                hair_test_near("radius", k, a[end].radius, b[end].radius, 1e-8);
            }
        }
        print_message("    %.2f of the segments: off by %.2g m\n", (double)fractions[i], worst);
        assert_int_equal(at, 2 * tessellated.segments);
        assert_true(worst <= TOLERANCE);
        free(drawn.vertices);
        free(tessellated.vertices);
    }
    hair_destroy(hair);
    hair_groom_destroy(groom);
}

int main(void)
{
    if (hair_test_skips()) return 0;
    const struct CMUnitTest tests[] = {
        HAIR_TEST(density_map_of_0_draws_nothing),
        HAIR_TEST(density_map_is_the_drawn_fraction_of_followers),
        HAIR_TEST(patch_without_density_draws_nothing),
        HAIR_TEST(segment_fraction_is_drawn_equally_by_every_path),
        HAIR_TEST(map_sets_blend_density_and_thickness),
    };
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
