// isolines_test.c - every follower is drawn once and whole, with any number of vertices, by every
// render path.
//
// Mesa's llvmpipe numbers the vertices of a tessellated draw in 16 bits. It repeats earlier strands
// in place of later ones, without an error and with the right count of primitives. Therefore the
// tests capture the drawn vertices and examine them.
#include "tests/support/captured_lines.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "lib/api/api.h"
#include "tests/support/handmade.h"

static long follower_of(const struct hair_test_vertex* vertex)
{
    return lroundf((vertex->radius / 0.001f - 1) * 65536);
}

static int is_at(const struct hair_test_vertex* vertex, const float* position, double tolerance)
{
    return fabs(vertex->x - position[0]) <= tolerance && fabs(vertex->y - position[1]) <= tolerance &&
           fabs(vertex->z - position[2]) <= tolerance;
}

// Absolute tolerance, in metres. Every path evaluates one GLSL function, compiled separately.
// Lengths under 0.5 m are rounded to a relative 2^-24 in another order. For strands of 0.07 m and
// more the tolerance is less than 1e-5 of the length.
#define TOLERANCE (10 * 0.5 / 16777216)

// Return the follower's segment that a drawn segment starts at. The search starts at the previous
// result.
static uint32_t find_segment(const struct hair_test_vertex* drawn, const float* follower, uint32_t segments,
                             uint32_t guess)
{
    for (uint32_t i = 0; i < segments; ++i) {
        uint32_t s = (guess + i) % segments;
        if (is_at(&drawn[0], follower + 3 * s, TOLERANCE) &&
            is_at(&drawn[1], follower + 3 * (s + 1), TOLERANCE))
            return s;
    }
    return UINT32_MAX;
}

static void check_every_segment(const struct hair_test_lines* drawn, const float* expected,
                                uint32_t followers, uint32_t segments)
{
    uint8_t* seen = calloc((size_t)followers * segments, 1);
    uint32_t guess = 0;
    for (size_t i = 0; i < drawn->segments; ++i) {
        const struct hair_test_vertex* vertices = drawn->vertices + 2 * i;
        long follower = follower_of(&vertices[0]);
        assert_in_range(follower, 0, followers - 1);
        assert_int_equal(follower_of(&vertices[1]), follower); // No segment connects two strands.
        uint32_t s =
            find_segment(vertices, expected + (size_t)follower * (segments + 1) * 3, segments, guess);
        if (s == UINT32_MAX)
            fail_msg("segment %zu is of follower %ld, but nowhere on it: (%g, %g, %g)", i, follower,
                     (double)vertices->x, (double)vertices->y, (double)vertices->z);
        if (seen[(size_t)follower * segments + s]++)
            fail_msg("segment %u of follower %ld is drawn twice", s, follower);
        guess = s + 1;
    }
    for (size_t i = 0; i < (size_t)followers * segments; ++i)
        if (!seen[i]) fail_msg("segment %zu of follower %zu is missing", i % segments, i / segments);
    free(seen);
}

// Check that a groom with these numbers of followers and isolines per patch is drawn whole, and as
// it is read. Check the part that meets a collider too.
static void check_meeting(struct hair_test* test, uint32_t followers, uint32_t isolines, uint32_t segments,
                          hair_follower_collision collision)
{
    struct hair_test_handmade wanted = hair_test_handmade_default();
    wanted.followers = followers;
    wanted.each = isolines;
    hair_groom* groom = hair_test_groom(&test->host.host, wanted);
    hair_look look = hair_test_even_look(segments);
    hair_desc desc = hair_desc_default();
    hair_instance* hair = NULL;
    desc.look = &look;
    look.followers.collision = collision;
    hair_collider collider = hair_collider_default();
    collider.position[0] = 0.15f;
    collider.size[0] = 0.06f;
    hair_test_ok(test, hair_create(test->context, groom, &desc, &hair));
    hair_test_ok(test, hair_set_colliders(hair, &collider, 1, sizeof collider));

    uint32_t count = followers * (segments + 1);
    float* expected = malloc(3 * sizeof *expected * count);
    hair_test_ok(test, hair_read_positions(hair, HAIR_READ_FOLLOWERS, expected, count, &count));
    assert_int_equal(count, followers * (segments + 1));

    for (size_t path = 0; path < HAIR_TEST_CAPTURED_PATHS; ++path) {
        struct hair_test_lines drawn = hair_test_capture_lines(
            test, hair, path, (size_t)followers * segments, collision != HAIR_FOLLOWER_COLLISION_NONE, NULL);
        if (path == HAIR_TEST_TESSELLATION)
            print_message("    %5u followers, %3u a patch, %3u segments: %3llu draws\n", followers, isolines,
                          segments, (unsigned long long)drawn.draws);
        assert_int_equal(drawn.generated, (uint64_t)followers * segments);
        assert_int_equal(drawn.segments, (size_t)followers * segments);
        check_every_segment(&drawn, expected, followers, segments);
        free(drawn.vertices);
    }
    free(expected);
    hair_destroy(hair);
    hair_groom_destroy(groom);
}

static void check(struct hair_test* test, uint32_t followers, uint32_t isolines, uint32_t segments)
{
    check_meeting(test, followers, isolines, segments, HAIR_FOLLOWER_COLLISION_NONE);
}

static void pushed_out_followers_are_drawn_where_they_are_read(void** state)
{
    static const uint32_t counts[] = {1, 2, 33, 65, 256};
    for (size_t i = 0; i < sizeof counts / sizeof *counts; ++i) {
        check_meeting(*state, 500, 64, counts[i], HAIR_FOLLOWER_COLLISION_PUSH_OUT);
        check_meeting(*state, 500, 64, counts[i], HAIR_FOLLOWER_COLLISION_SINGLE_GUIDE);
    }
}

static void every_count_of_isolines_and_segments_is_drawn(void** state)
{
    static const uint32_t counts[] = {1, 2, 16, 31, 32, 33, 63, 64, 65, 200};
    for (size_t i = 0; i < sizeof counts / sizeof *counts; ++i)
        for (size_t k = 0; k < sizeof counts / sizeof *counts; ++k)
            check(*state, 2 * counts[i] + counts[i] / 2 + 1, counts[i],
                  counts[k]); // The last patch is not full.
}

static void maximum_number_of_segments_is_drawn(void** state)
{
    static const uint32_t counts[] = {127, 128, 129, 255, 256};
    for (size_t i = 0; i < sizeof counts / sizeof *counts; ++i) check(*state, 150, 64, counts[i]);
}

// Check sizes that, as one draw, would have just under, just over and twice 65,536 vertices.
static void strands_beyond_65536_vertices_are_drawn(void** state)
{
    check(*state, 1985, 64, 32); // 65,505 vertices.
    check(*state, 1986, 64, 32); // 65,538 vertices.
    check(*state, 1008, 64, 64); // 65,520 vertices.
    check(*state, 1009, 64, 64); // 65,585 vertices.
    check(*state, 2048, 1, 31); // 65,536 vertices.
    check(*state, 32768, 64, 1); // 65,536 vertices.
    check(*state, 4100, 64, 32); // 135,300 vertices.
    check(*state, 1025, 64, 128); // More vertices, in each of two parts.
}

// Check that the self-test of context creation detects the fault. If its result is ignored, strands
// are missing.
static void driver_that_loses_isolines_is_detected(void** state)
{
    struct hair_test* test = *state;
    const char* renderer = (const char*)glGetString(GL_RENDERER);
    const char* version = (const char*)glGetString(GL_VERSION);
    if (!strstr(renderer, "llvmpipe") || !strstr(version, "Mesa 22.3")) skip();
    assert_in_range(test->context->gl.max_draw_vertices, 1, 65535);
    assert_int_equal(test->context->gl.lines_level, 0);
}

int main(void)
{
    if (hair_test_skips()) return 0;
    const struct CMUnitTest tests[] = {
        HAIR_TEST(every_count_of_isolines_and_segments_is_drawn),
        HAIR_TEST(maximum_number_of_segments_is_drawn),
        HAIR_TEST(pushed_out_followers_are_drawn_where_they_are_read),
        HAIR_TEST(strands_beyond_65536_vertices_are_drawn),
        HAIR_TEST(driver_that_loses_isolines_is_detected),
    };
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
