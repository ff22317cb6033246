// lengths_test.c - guides of any number of vertices, from strands to pixels, as an application uses
// them.
#include "tests/support/passes.h"
#include "tests/support/support.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "lib/api/api.h"
#include "tests/support/frame.h"
#include "tests/support/grooms.h"
#include "tests/support/ways.h"
#include "tests/support/tessellated.h"

static const uint32_t lengths[] = {2, 3, 32, 33, 64, 65, 128, 129, 255, 256};
#define LENGTHS (sizeof lengths / sizeof *lengths)
#define STRANDS 60
#define SIDE 64

struct fixture {
    struct hair_test* test;
    hair_groom* groom;
    hair_instance* hair;
};

// Solvers and mappings, without those that differ from one of these in nothing tested here.
static const int ways[] = {0, 1, 2, 4, 6};
#define WAYS (sizeof ways / sizeof *ways)

// Return whether the test tries this length. The first way tries all lengths. The others use the
// same source for the lengths between, and take long to compile.
static int is_tried(int way, uint32_t vertices)
{
    return way == ways[0] || vertices == 2 || vertices == 65 || vertices == 256;
}

// Evaluate a wave of 30 cm that hangs from a disc of 10 cm.
static hair_vec3 wave(float t, uint32_t strand, const void* user)
{
    (void)user;
    float angle = 2.4f * (float)strand, r = 0.1f * sqrtf((float)strand / STRANDS);
    return hair_v3(r * cosf(angle) + 0.03f * sinf(6 * t), -0.3f * t, r * sinf(angle) + 0.02f * sinf(4 * t));
}

// Create full strands. Half of them have more vertices than a guide may have, and the others have 8
// to 13.
static struct fixture start_in(void** state, hair_context* context, uint32_t guide_vertices, int way)
{
    struct fixture f = {.test = *state};
    struct hair_test_strands strands = hair_test_strands_make(STRANDS, 300);
    for (uint32_t i = 0; i < STRANDS; ++i)
        hair_test_strands_add(&strands, i % 2 ? 300 : 8 + i / 10, wave, NULL);
    hair_groom_desc desc = hair_test_groom_desc(&f.test->host, &strands);
    desc.guide_vertices = guide_vertices;
    desc.guide_count = 12;
    hair_test_ok(f.test, hair_groom_create(&desc, &f.groom));
    hair_test_strands_free(&strands);

    hair_desc instance = hair_test_way(way);
    hair_look look = hair_look_default();
    look.strays.tip_fraction = look.strays.fraction = 0;
    instance.look = &look;
    hair_test_ok(f.test, hair_create(context, f.groom, &instance, &f.hair));
    return f;
}

static struct fixture start(void** state, uint32_t guide_vertices, int way)
{
    struct hair_test* test = *state;
    return start_in(state, test->context, guide_vertices, way);
}

static void finish(struct fixture* f)
{
    hair_destroy(f->hair);
    hair_groom_destroy(f->groom);
}

static uint32_t read(struct fixture* f, hair_read_source what, float** out)
{
    uint32_t count;
    hair_test_ok(f->test, hair_read_positions(f->hair, what, NULL, 0, &count));
    *out = calloc(count, 3 * sizeof **out);
    hair_test_ok(f->test, hair_read_positions(f->hair, what, *out, count, &count));
    for (uint32_t i = 0; i < 3 * count; ++i) assert_true(isfinite((*out)[i]));
    return count;
}

// Check the number of samples. The cost of a guide follows the longest guide: one sample at every
// vertex and between two vertices.
static void sample_count_is_that_of_the_longest_guide(void** state)
{
    for (size_t i = 0; i < LENGTHS; ++i) {
        struct fixture f = start(state, lengths[i], 0);
        float* p;
        assert_int_equal(f.groom->max_vertices, lengths[i]);
        assert_int_equal(read(&f, HAIR_READ_SMOOTH, &p), f.groom->info.guide_count * (2 * lengths[i] - 1));
        free(p);
        assert_int_equal(read(&f, HAIR_READ_GUIDES, &p), f.groom->info.guide_vertex_count);
        free(p);
        finish(&f);
    }
}

// Compare followers at rest with their strands. Guides at rest are smoothed on the CPU, and drawn
// from guides smoothed on the GPU. Both round positions of up to 0.3 m to 2e-8 m. Both round frames
// to 2e-8 m over the shortest segment, 1 mm. These frames turn shapes of 0.3 m.
static void followers_at_rest_equal_their_strands(void** state)
{
    for (size_t i = 0; i < LENGTHS; ++i) {
        struct fixture f = start(state, lengths[i], 0);
        float* p;
        uint32_t each = read(&f, HAIR_READ_FOLLOWERS, &p) / STRANDS;
        double worst = 0;
        for (uint32_t k = 0; k < STRANDS * each; ++k) {
            hair_vec3 fitted = hair_test_single(f.groom, &f.groom->followers[k / each],
                                                (float)(k % each) / (float)(each - 1));
            worst = fmax(worst, (double)hair_distance(hair_load3(p + 3 * k), fitted));
        }
        print_message("    %u vertices: off by up to %.2g m\n", lengths[i], worst);
        assert_true(worst < 1e-5);
        free(p);
        finish(&f);
    }
}

#define THREAD HAIR_GL_WITH(THREAD_PER_GUIDE)

// Check that the solver and smoothing compile and run only the size for the longest guide. Guides
// that would be too much work for a thread use a work group.
static void check_sizes(void** state, hair_context* context, int way)
{
    static const hair_gl_pass solvers[HAIR_TEST_WAYS] = {HAIR_GL_MIXED_SOLVER, HAIR_GL_MIXED_SOLVER | THREAD,
                                                         HAIR_GL_MIXED_SOLVER, HAIR_GL_MIXED_SOLVER | THREAD,
                                                         HAIR_GL_FOLLOW,       HAIR_GL_FOLLOW | THREAD,
                                                         HAIR_GL_REDBLACK};
    const struct hair_gl* gl = &context->gl;
    uint32_t runs[2][4] = {{0}}, smoothed[4] = {0};
    for (size_t i = 0; i < LENGTHS; ++i) {
        if (!is_tried(way, lengths[i])) continue;
        struct fixture f = start_in(state, context, lengths[i], way);
        for (int k = 0; k < 5; ++k) hair_test_ok(f.test, hair_step(f.hair, (float)f.hair->sim.substep));
        float* smooth;
        read(&f, HAIR_READ_SMOOTH, &smooth);
        free(smooth);
        glFinish();
        uint32_t own = (lengths[i] > 32) + (lengths[i] > 64) + (lengths[i] > 128);
        runs[hair_sim_is_by_thread(&f.hair->sim)][own] += 5;
        smoothed[own] += 1;
        for (uint32_t size = 0; size < 4; ++size) {
            for (int by_thread = 0; by_thread < 2; ++by_thread) {
                hair_gl_pass pass = (solvers[way] & ~THREAD) | (by_thread ? THREAD : 0) | HAIR_GL_SIZE(size);
                assert_int_equal(hair_test_runs(gl, pass), runs[by_thread][size]);
                assert_int_equal(hair_test_program(gl, pass) != 0, runs[by_thread][size] > 0);
            }
            assert_int_equal(hair_test_runs(gl, HAIR_GL_SMOOTH | HAIR_GL_SIZE(size)), smoothed[size]);
            assert_int_equal(hair_test_program(gl, HAIR_GL_SMOOTH | HAIR_GL_SIZE(size)) != 0,
                             smoothed[size] > 0);
        }
        finish(&f);
    }
}

static void guides_over_128_vertices_use_work_groups_on_hardware(void** state)
{
    struct hair_test* test = *state;
    struct hair_gl* gl = &test->context->gl;
    int software = gl->software, thread_way = 5;
    for (int hardware = 0; hardware < 2; ++hardware)
        for (uint32_t vertices = 128; vertices <= 129; ++vertices) {
            gl->software = !hardware;
            struct fixture f = start(state, vertices, thread_way);
            assert_int_equal(f.hair->sim.by_thread, !hardware || vertices == 128);
            finish(&f);
        }
    gl->software = software;
}

static void only_one_work_group_size_runs(void** state)
{
    struct hair_test* test = *state;
    for (size_t n = 0; n < WAYS; ++n) {
        hair_context* context = hair_test_context(test, hair_egl_get_proc);
        check_sizes(state, context, ways[n]);
        hair_context_destroy(context);
    }
}

static double farthest(const float* a, const float* b, uint32_t count)
{
    double max = 0;
    for (uint32_t i = 0; i < count; ++i)
        max = fmax(max, (double)hair_distance(hair_load3(a + 3 * i), hair_load3(b + 3 * i)));
    return max;
}

// Return the maximum relative stretch or compression of a segment.
static double greatest_stretch(const struct fixture* f, const float* p)
{
    double worst = 0;
    for (uint32_t g = 0; g < f->groom->info.guide_count; ++g)
        for (uint32_t i = 0; i + 1 < f->groom->guides[g].count; ++i) {
            uint32_t at = f->groom->guides[g].first + i;
            double length = (double)hair_distance(hair_load3(p + 3 * at), hair_load3(p + 3 * at + 3));
            worst = fmax(worst, fabs(length / (double)f->groom->rest[at].position.w - 1));
        }
    return worst;
}

// Check guides after a swaying head has returned to its position. A guide of two vertices has both
// pinned, and moves with the head. All others lag behind by at most their length. Following the
// leader may turn a guide of 40 cm right over. No segment of a rod stretches by more than a
// hundredth of its length.
static void check_motion(struct fixture* f, uint32_t vertices)
{
    float *before, *after, transform[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    uint32_t count = read(f, HAIR_READ_GUIDES, &before);
    for (int k = 30; k >= 0; --k) {
        transform[12] = 0.03f * sinf(0.2f * (float)k);
        hair_test_ok(f->test, hair_set_transform(f->hair, transform));
        hair_test_ok(f->test, hair_step(f->hair, 1.0f / 60));
    }
    read(f, HAIR_READ_GUIDES, &after);
    double moved = farthest(before, after, count), stretch = greatest_stretch(f, after);
    print_message("    %u vertices: moved by up to %.2g m, stretched by %.2g\n", vertices, moved, stretch);
    int redblack = f->hair->sim.solver == HAIR_SOLVER_REDBLACK;
    double max = f->hair->sim.solver == HAIR_SOLVER_FOLLOW ? 0.8 : 0.3;
    if (vertices == 2 && redblack)
        assert_true(moved < 1e-6);
    else
        assert_true(moved > 1e-3 && moved < max);
    if (!redblack) assert_true(stretch < 0.01);
    hair_test_ok(f->test, hair_reset(f->hair));
    free(after);
    read(f, HAIR_READ_GUIDES, &after);
    assert_true(farthest(before, after, count) < 1e-6);
    free(before);
    free(after);
}

static void guides_of_any_length_move_without_stretching(void** state)
{
    for (size_t n = 0; n < WAYS; ++n) {
        print_message("    %s\n", hair_test_way_name(ways[n]));
        for (size_t i = 0; i < LENGTHS; ++i) {
            if (!is_tried(ways[n], lengths[i])) continue;
            struct fixture f = start(state, lengths[i], ways[n]);
            check_motion(&f, lengths[i]);
            finish(&f);
        }
    }
}

static uint32_t count_lit(const float* pixels)
{
    uint32_t lit = 0;
    for (int i = 0; i < SIDE * SIDE; ++i) lit += pixels[4 * i] + pixels[4 * i + 1] + pixels[4 * i + 2] > 0;
    return lit;
}

static void strands_of_every_length_are_drawn(void** state)
{
    static float pixels[4 * SIDE * SIDE];
    struct hair_test_frame frame;
    hair_test_frame_make(&frame, SIDE, SIDE, GL_RGBA32F, 0);
    for (size_t i = 0; i < LENGTHS; ++i) {
        struct fixture f = start(state, lengths[i], 0);
        hair_view view = hair_test_tessellated();
        view.primitive = HAIR_PRIMITIVE_LINES;
        // Orthographic, 0.6 m wide, around the middle of the hair.
        float to_clip[16] = {3.3f, 0, 0, 0, 0, 3.3f, 0, 0, 0, 0, -1, 0, 0, 0.5f, 0, 1};
        memcpy(view.projection, to_clip, sizeof to_clip);
        for (int guides = 0; guides < 2; ++guides) {
            view.pass = guides ? HAIR_PASS_GUIDES : HAIR_PASS_COLOR;
            glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
            hair_test_ok(f.test, hair_draw(f.hair, &view));
            hair_test_frame_read(&frame, pixels);
            assert_in_range(count_lit(pixels), 100, SIDE * SIDE / 2);
        }
        finish(&f);
    }
    hair_test_frame_free(&frame);
}

int main(void)
{
    if (hair_test_skips()) return 0;
    const struct CMUnitTest tests[] = {
        HAIR_TEST(sample_count_is_that_of_the_longest_guide),
        HAIR_TEST(followers_at_rest_equal_their_strands),
        HAIR_TEST(guides_over_128_vertices_use_work_groups_on_hardware),
        HAIR_TEST(only_one_work_group_size_runs),
        HAIR_TEST(guides_of_any_length_move_without_stretching),
        HAIR_TEST(strands_of_every_length_are_drawn),
    };
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
