// lengths_test.c - from strands to pixels with guides of any number of vertices, as an application asks for it.
#include "tests/support/support.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "lib/api/api.h"
#include "tests/support/frame.h"
#include "tests/support/grooms.h"

static const uint32_t lengths[] = {2, 3, 32, 33, 64, 65, 128, 129, 255, 256};
#define LENGTHS (sizeof lengths / sizeof *lengths)
#define STRANDS 60
#define SIDE 64

struct fixture {
    struct hair_test* test;
    hair_context*     context;
    hair_groom*       groom;
    hair_instance*    hair;
};

// Waves that hang from a disc of 10 cm, 30 cm long.
static hair_vec3 wave(float t, uint32_t strand, const void* user)
{
    (void)user;
    float angle = 2.4f * (float)strand, r = 0.1f * sqrtf((float)strand / STRANDS);
    return hair_v3(r * cosf(angle) + 0.03f * sinf(6 * t), -0.3f * t, r * sinf(angle) + 0.02f * sinf(4 * t));
}

// Full strands, half of them with more vertices than any guide may have, the others with 8 to 13.
static struct fixture start(void** state, uint32_t guide_vertices)
{
    struct fixture           f       = {.test = *state};
    struct hair_test_strands strands = hair_test_strands_make(STRANDS, 300);
    for (uint32_t i = 0; i < STRANDS; ++i)
        hair_test_strands_add(&strands, i % 2 ? 300 : 8 + i / 10, wave, NULL);
    hair_groom_desc desc = hair_test_groom_desc(&f.test->host, &strands);
    desc.guide_vertices  = guide_vertices;
    desc.guide_count     = 12;
    hair_test_ok(f.test, hair_groom_create(&desc, &f.groom));
    hair_test_strands_free(&strands);

    hair_context_desc of = hair_context_desc_default();
    of.host              = &f.test->host.host;
    of.get_proc          = hair_egl_get_proc;
    of.timings           = 1;
    hair_test_ok(f.test, hair_context_create(&of, &f.context));
    hair_desc instance = hair_desc_default();
    hair_look look     = hair_look_default();
    look.frizz         = 0;
    instance.look      = &look;
    hair_test_ok(f.test, hair_create(f.context, f.groom, &instance, &f.hair));
    return f;
}

static void finish(struct fixture* f)
{
    hair_destroy(f->hair);
    hair_context_destroy(f->context);
    hair_groom_destroy(f->groom);
}

static uint32_t read(struct fixture* f, hair_read_what what, float** out)
{
    uint32_t count;
    hair_test_ok(f->test, hair_read(f->hair, what, NULL, 0, &count));
    *out = calloc(count, 3 * sizeof **out);
    hair_test_ok(f->test, hair_read(f->hair, what, *out, count, &count));
    for (uint32_t i = 0; i < 3 * count; ++i) assert_true(isfinite((*out)[i]));
    return count;
}

// What a guide costs follows the longest: a sample at every vertex and between.
static void there_are_no_more_samples_than_the_longest_guide_needs(void** state)
{
    for (size_t i = 0; i < LENGTHS; ++i) {
        struct fixture f = start(state, lengths[i]);
        float*         p;
        assert_int_equal(f.groom->most_vertices, lengths[i]);
        assert_int_equal(read(&f, HAIR_READ_SMOOTH, &p), f.groom->info.guide_count * (2 * lengths[i] - 1));
        free(p);
        assert_int_equal(read(&f, HAIR_READ_GUIDES, &p), f.groom->info.guide_vertex_count);
        free(p);
        finish(&f);
    }
}

// Offsets are fitted to guides as the CPU smooths them, and drawn off guides as the GPU does. Both round positions of
// up to 0.3 m to 2e-8, and frames to that over the shortest segment, 1 mm; offsets are up to 2 cm.
static void followers_at_rest_are_where_they_were_fitted(void** state)
{
    for (size_t i = 0; i < LENGTHS; ++i) {
        struct fixture f = start(state, lengths[i]);
        float*         p;
        uint32_t       each  = read(&f, HAIR_READ_FOLLOWERS, &p) / STRANDS;
        double         worst = 0;
        for (uint32_t k = 0; k < STRANDS * each; ++k) {
            hair_vec3 fitted = hair_test_single(f.groom, &f.groom->followers[k / each],
                                                (float)(k % each) / (float)(each - 1));
            worst            = fmax(worst, (double)hair_distance(hair_load3(p + 3 * k), fitted));
        }
        print_message("    %u vertices: off by up to %.2g m\n", lengths[i], worst);
        assert_true(worst < 1e-5);
        free(p);
        finish(&f);
    }
}

// Of the solver and of smoothing only the size that the longest guide needs is compiled and run.
static void one_size_of_work_group_runs(void** state)
{
    for (size_t i = 0; i < LENGTHS; ++i) {
        struct fixture f = start(state, lengths[i]);
        for (int k = 0; k < 5; ++k) hair_test_ok(f.test, hair_step(f.hair, 1.0f / 120));
        glFinish();
        hair_timing timings[HAIR_GL_PASS_COUNT];
        hair_timings(f.context, timings, HAIR_GL_PASS_COUNT);
        uint32_t own = (lengths[i] > 32) + (lengths[i] > 64) + (lengths[i] > 128);
        for (uint32_t size = 0; size < 4; ++size) {
            assert_int_equal(timings[HAIR_GL_REDBLACK_32 + size].runs, size == own ? 5 : 0);
            assert_int_equal(timings[HAIR_GL_SMOOTH_32 + size].runs, size == own ? 6 : 0);
            assert_int_equal(f.context->gl.program[HAIR_GL_REDBLACK_32 + size] != 0, size == own);
            assert_int_equal(f.context->gl.program[HAIR_GL_SMOOTH_32 + size] != 0, size == own);
        }
        finish(&f);
    }
}

static double farthest(const float* a, const float* b, uint32_t count)
{
    double most = 0;
    for (uint32_t i = 0; i < count; ++i)
        most = fmax(most, (double)hair_distance(hair_load3(a + 3 * i), hair_load3(b + 3 * i)));
    return most;
}

// Pinned at two vertices, a guide of two goes with the head; all others hang behind, and no farther than they are long.
static void guides_move_and_stay_whole(void** state)
{
    for (size_t i = 0; i < LENGTHS; ++i) {
        struct fixture f = start(state, lengths[i]);
        float *        before, *after, transform[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
        uint32_t       count = read(&f, HAIR_READ_GUIDES, &before);
        for (int k = 0; k < 30; ++k) {
            transform[12] = 0.02f * (float)(k % 2);
            hair_test_ok(f.test, hair_set_transform(f.hair, transform));
            hair_test_ok(f.test, hair_step(f.hair, 1.0f / 60));
        }
        transform[12] = 0;
        hair_test_ok(f.test, hair_set_transform(f.hair, transform));
        hair_test_ok(f.test, hair_step(f.hair, 1.0f / 60));
        read(&f, HAIR_READ_GUIDES, &after);
        double moved = farthest(before, after, count);
        print_message("    %u vertices: moved by up to %.2g m\n", lengths[i], moved);
        if (lengths[i] == 2)
            assert_true(moved < 1e-6);
        else
            assert_true(moved > 1e-3 && moved < 0.3);
        hair_test_ok(f.test, hair_reset(f.hair));
        free(after);
        read(&f, HAIR_READ_GUIDES, &after);
        assert_true(farthest(before, after, count) < 1e-6);
        free(before);
        free(after);
        finish(&f);
    }
}

static uint32_t count_lit(const float* pixels)
{
    uint32_t lit = 0;
    for (int i = 0; i < SIDE * SIDE; ++i) lit += pixels[4 * i] + pixels[4 * i + 1] + pixels[4 * i + 2] > 0;
    return lit;
}

static void strands_and_guides_of_every_length_are_drawn(void** state)
{
    static float           pixels[4 * SIDE * SIDE];
    struct hair_test_frame frame;
    hair_test_frame_make(&frame, SIDE, SIDE, GL_RGBA32F, 0);
    for (size_t i = 0; i < LENGTHS; ++i) {
        struct fixture f    = start(state, lengths[i]);
        hair_view      view = hair_view_default();
        view.primitive      = HAIR_LINES;
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
        HAIR_TEST(there_are_no_more_samples_than_the_longest_guide_needs),
        HAIR_TEST(followers_at_rest_are_where_they_were_fitted),
        HAIR_TEST(one_size_of_work_group_runs),
        HAIR_TEST(guides_move_and_stay_whole),
        HAIR_TEST(strands_and_guides_of_every_length_are_drawn),
    };
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
