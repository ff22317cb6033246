// isolines_test.c - every follower is drawn once and whole, with any number of vertices, by every
// render path.
//
// Mesa's llvmpipe numbers the vertices of a tessellated draw in 16 bits. It repeats earlier strands
// in place of later ones, without an error and with the right count of primitives. Therefore the
// tests capture the drawn vertices and examine them.
#include "tests/support/passes.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "lib/api/api.h"
#include "tests/support/frame.h"
#include "tests/support/handmade.h"
#include "tests/support/passes.h"
#include "tests/support/render_paths.h"

struct vertex {
    float x, y, z, radius; // The output strand_position of strand.tese.
};

// Functions and state that capture draws between the library and OpenGL.
static struct {
    void(APIENTRY* patches)(GLenum, GLint, GLsizei, GLsizei);
    void(APIENTRY* listed)(GLenum, GLenum, const void*, GLsizei, GLsizei);
    GLuint feedback, buffer, queries[2];
    GLintptr at; // Number of bytes captured so far.
    uint64_t generated, draws;
} capture;

// Start a capture. Each draw is its own transform feedback, because the library could not change
// its program during an active one.
static void begin_capture(void)
{
    GLint64 size;
    glCreateQueries(GL_PRIMITIVES_GENERATED, 1, &capture.queries[0]);
    glCreateQueries(GL_TRANSFORM_FEEDBACK_PRIMITIVES_WRITTEN, 1, &capture.queries[1]);
    glGetNamedBufferParameteri64v(capture.buffer, GL_BUFFER_SIZE, &size);
    glBindTransformFeedback(GL_TRANSFORM_FEEDBACK, capture.feedback);
    glTransformFeedbackBufferRange(capture.feedback, 0, capture.buffer, capture.at, size - capture.at);
    glBeginQuery(GL_PRIMITIVES_GENERATED, capture.queries[0]);
    glBeginQuery(GL_TRANSFORM_FEEDBACK_PRIMITIVES_WRITTEN, capture.queries[1]);
    glBeginTransformFeedback(GL_LINES);
}

static void end_capture(void)
{
    GLuint64 generated = 0, written = 0;
    glEndTransformFeedback();
    glEndQuery(GL_PRIMITIVES_GENERATED);
    glEndQuery(GL_TRANSFORM_FEEDBACK_PRIMITIVES_WRITTEN);
    glBindTransformFeedback(GL_TRANSFORM_FEEDBACK, 0);
    glGetQueryObjectui64v(capture.queries[0], GL_QUERY_RESULT, &generated);
    glGetQueryObjectui64v(capture.queries[1], GL_QUERY_RESULT, &written);
    glDeleteQueries(2, capture.queries);
    capture.generated += generated;
    capture.at += (GLintptr)(written * 2 * sizeof(struct vertex));
    ++capture.draws;
}

static void APIENTRY capture_patches(GLenum mode, GLint first, GLsizei count, GLsizei instances)
{
    begin_capture();
    capture.patches(mode, first, count, instances);
    end_capture();
}

static void APIENTRY capture_listed(GLenum mode, GLenum type, const void* commands, GLsizei count,
                                    GLsizei stride)
{
    begin_capture();
    capture.listed(mode, type, commands, count, stride);
    end_capture();
}

struct drawn {
    struct vertex* vertices; // Two per segment, in drawing order.
    size_t segments;
    uint64_t generated, draws;
};

#define FIBRES_LINES (HAIR_GL_WITH(FIBRES) | HAIR_GL_WITH(LINES))
#define SHADED_LINES (HAIR_GL_WITH(SHADED) | HAIR_GL_WITH(LINES))
#define HITS HAIR_GL_WITH(HITS)

// Passes that draw lines, and their stages without the fragment shader: without and with colliders
// in reach.
static const struct {
    hair_gl_pass pass[2];
    const char* stages[2];
} paths[] = {
    [HAIR_TEST_TESSELLATION] = {{HAIR_GL_TESSELLATED | FIBRES_LINES,
                                 HAIR_GL_TESSELLATED | HITS | FIBRES_LINES},
                                {"draw/patch.vert draw/patch.tesc draw/strand.tese",
                                 "HAIR_HITS=1 draw/patch.vert draw/patch.tesc draw/strand.tese"}},
    [HAIR_TEST_PROCEDURAL] = {{HAIR_GL_PROCEDURAL | FIBRES_LINES, HAIR_GL_PROCEDURAL | HITS | FIBRES_LINES},
                              {"draw/strand.vert", "HAIR_HITS=1 draw/strand.vert"}},
    [HAIR_TEST_CACHED] = {{HAIR_GL_CACHED | SHADED_LINES, HAIR_GL_CACHED | SHADED_LINES},
                          {"HAIR_VERTEX_CACHE=1 draw/strand.vert", "HAIR_VERTEX_CACHE=1 draw/strand.vert"}},
};

#define PATHS (sizeof paths / sizeof *paths)

// Draw lines by hair_draw, and return the captured vertices instead of pixels. `hits` is 1 if
// colliders are in reach. The caller frees the vertices.
static struct drawn draw_lod(struct hair_test* test, hair_instance* hair, size_t path, size_t max_segments,
                             int hits, const hair_lod* lod)
{
    struct hair_gl* gl = &test->context->gl;
    hair_gl_pass pass = paths[path].pass[hits] | (lod ? HAIR_GL_WITH(WIDENED) : 0);
    struct hair_gl_program* own = hair_gl_get_or_add(gl, pass);
    GLuint whole = own->program, program = 0;
    char stages[128];
    snprintf(stages, sizeof stages, "%s%s", lod ? "HAIR_WIDENED=1 " : "", paths[path].stages[hits]);
    hair_test_ok(test, hair_gl_link(gl, "capture", stages, "strand_position", &program));
    memset(&capture, 0, sizeof capture);
    capture.patches = gl->DrawArraysInstanced;
    capture.listed = gl->MultiDrawElementsIndirect;
    glCreateTransformFeedbacks(1, &capture.feedback);
    glCreateBuffers(1, &capture.buffer);
    // The buffer has room for more than the right number of vertices, to detect too many.
    glNamedBufferStorage(capture.buffer, (GLsizeiptr)((max_segments + 64) * 2 * sizeof(struct vertex)), NULL,
                         0);

    struct hair_test_frame frame; // Without a framebuffer every draw fails.
    hair_test_frame_make(&frame, 4, 4, GL_RGBA8, 0);
    own->program = program;
    gl->DrawArraysInstanced = capture_patches;
    gl->MultiDrawElementsIndirect = capture_listed;
    hair_view view = hair_view_default();
    view.render_path = hair_test_paths[path];
    view.lod = lod;
    view.primitive = HAIR_PRIMITIVE_LINES;
    hair_result result = hair_draw(hair, &view);
    own->program = whole;
    gl->DrawArraysInstanced = capture.patches;
    gl->MultiDrawElementsIndirect = capture.listed;
    hair_test_frame_free(&frame);
    hair_test_ok(test, result);

    struct drawn drawn = {.segments = (size_t)capture.at / (2 * sizeof(struct vertex)),
                          .generated = capture.generated,
                          .draws = capture.draws};
    drawn.vertices = malloc((size_t)capture.at + 1);
    glGetNamedBufferSubData(capture.buffer, 0, capture.at, drawn.vertices);
    glDeleteBuffers(1, &capture.buffer);
    glDeleteTransformFeedbacks(1, &capture.feedback);
    glDeleteProgram(program);
    return drawn;
}

static struct drawn draw(struct hair_test* test, hair_instance* hair, size_t path, size_t max_segments,
                         int hits)
{
    return draw_lod(test, hair, path, max_segments, hits, NULL);
}

// Return a look without taper. The radius of a follower then identifies it (grooms.c).
static hair_look look_of(uint32_t segments)
{
    hair_look look = hair_look_default();
    look.strand.segments = segments;
    look.strand.radius = 0.001f;
    look.strand.taper = hair_curve_line(1, 1);
    return look;
}

static long follower_of(const struct vertex* vertex)
{
    return lroundf((vertex->radius / 0.001f - 1) * 65536);
}

struct segment {
    struct vertex ends[2];
    size_t at;
};

static int by_follower(const void* a, const void* b)
{
    const struct segment *p = a, *q = b;
    if (p->ends[0].radius != q->ends[0].radius) return p->ends[0].radius < q->ends[0].radius ? -1 : 1;
    return p->at < q->at ? -1 : p->at > q->at;
}

// Sort strands by follower. Tessellators draw the isolines of a patch in any order, and orders
// differ between GPUs and llvmpipe.
static void sort_strands(struct drawn* drawn)
{
    struct segment* segments = malloc(drawn->segments * sizeof *segments + 1);
    for (size_t k = 0; k < drawn->segments; ++k)
        segments[k] = (struct segment){{drawn->vertices[2 * k], drawn->vertices[2 * k + 1]}, k};
    qsort(segments, drawn->segments, sizeof *segments, by_follower);
    for (size_t k = 0; k < drawn->segments; ++k)
        memcpy(&drawn->vertices[2 * k], segments[k].ends, sizeof segments[k].ends);
    free(segments);
}

static int is_at(const struct vertex* vertex, const float* position, double tolerance)
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
static uint32_t find_segment(const struct vertex* drawn, const float* follower, uint32_t segments,
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

static void check_every_segment(const struct drawn* drawn, const float* expected, uint32_t followers,
                                uint32_t segments)
{
    uint8_t* seen = calloc((size_t)followers * segments, 1);
    uint32_t guess = 0;
    for (size_t i = 0; i < drawn->segments; ++i) {
        const struct vertex* vertices = drawn->vertices + 2 * i;
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
    hair_look look = look_of(segments);
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

    for (size_t path = 0; path < PATHS; ++path) {
        struct drawn drawn =
            draw(test, hair, path, (size_t)followers * segments, collision != HAIR_FOLLOWER_COLLISION_NONE);
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

static size_t count_drawn(struct hair_test* test, size_t path, float density, uint32_t segments)
{
    struct hair_test_handmade wanted = hair_test_handmade_default();
    wanted.followers = 1000;
    wanted.each = 64;
    hair_groom* groom = hair_test_groom(&test->host.host, wanted);
    hair_look look = look_of(segments);
    hair_desc desc = hair_desc_default();
    hair_instance* hair = NULL;
    look.followers.density = density;
    desc.look = &look;
    hair_test_ok(test, hair_create(test->context, groom, &desc, &hair));
    struct drawn drawn = draw(test, hair, path, (size_t)1000 * segments, 0);
    assert_int_equal(drawn.generated, drawn.segments);
    free(drawn.vertices);
    hair_destroy(hair);
    hair_groom_destroy(groom);
    assert_int_equal(drawn.segments % segments, 0);
    return drawn.segments / segments;
}

static void density_map_of_0_draws_nothing(void** state)
{
    for (size_t path = 0; path < PATHS; ++path) assert_int_equal(count_drawn(*state, path, 0, 8), 0);
}

// Check the density. The last isoline of each of the 16 patches is drawn if any part of it is
// included.
static void density_map_is_the_drawn_fraction_of_followers(void** state)
{
    for (size_t path = 0; path < PATHS; ++path) {
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
    for (size_t path = 0; path < PATHS; ++path) {
        struct drawn drawn = draw(test, hair, path, 64 * 32, 0);
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
    hair_look look = look_of(4);
    hair_desc desc = hair_desc_default();
    hair_instance* hair = NULL;
    groom->map_sets = 2;
    groom->patches[0].map_density = (hair_vec4){1, 0, 0, 0};
    groom->patches[1].map_density = (hair_vec4){0, 1, 1, 1};
    groom->patches[1].map_thickness = (hair_vec4){1, 2, 2, 2};
    desc.look = &look;
    hair_test_ok(test, hair_create(test->context, groom, &desc, &hair));
    for (size_t i = 0; i < 7 * PATHS; ++i) {
        // There is no set beyond the last one.
        float set = 0.25f * (float)(i % 7), blend = fminf(set, 1);
        look.followers.map_set = set;
        hair_test_ok(test, hair_set_look(hair, &look));
        struct drawn drawn = draw(test, hair, i / 7, (size_t)64 * 4, 0);
        size_t first = (size_t)(32 * (1 - blend)), second = (size_t)(32 * blend);
        assert_int_equal(drawn.segments, 4 * (first + second));
        sort_strands(&drawn);
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
    hair_look look = look_of(32);
    hair_desc desc = hair_desc_default();
    hair_lod lod = hair_lod_default();
    hair_instance* hair = NULL;
    desc.look = &look;
    lod.per_patch = false;
    hair_test_ok(test, hair_create(test->context, groom, &desc, &hair));
    for (size_t i = 0; i < sizeof fractions / sizeof *fractions; ++i) {
        lod.segment_fraction = fractions[i];
        struct drawn tessellated = draw_lod(test, hair, HAIR_TEST_TESSELLATION, 200 * 32, 0, &lod);
        assert_int_equal(tessellated.segments, 200 * (size_t)ceilf(32 * fractions[i]));
        sort_strands(&tessellated);
        struct drawn drawn = draw_lod(test, hair, HAIR_TEST_PROCEDURAL, 200 * 64, 0, &lod);
        double worst = 0;
        size_t at = 0;
        sort_strands(&drawn);
        for (size_t k = 0; k < 2 * drawn.segments; k += 2) {
            const struct vertex *a = &drawn.vertices[k], *b = &tessellated.vertices[at];
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
        HAIR_TEST(every_count_of_isolines_and_segments_is_drawn),
        HAIR_TEST(maximum_number_of_segments_is_drawn),
        HAIR_TEST(pushed_out_followers_are_drawn_where_they_are_read),
        HAIR_TEST(strands_beyond_65536_vertices_are_drawn),
        HAIR_TEST(driver_that_loses_isolines_is_detected),
        HAIR_TEST(density_map_of_0_draws_nothing),
        HAIR_TEST(density_map_is_the_drawn_fraction_of_followers),
        HAIR_TEST(patch_without_density_draws_nothing),
        HAIR_TEST(segment_fraction_is_drawn_equally_by_every_path),
        HAIR_TEST(map_sets_blend_density_and_thickness),
    };
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
