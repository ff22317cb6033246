// budget_test.c - the frame budget: a clock of the test takes the place of the GPU's, and its time
// depends on the detail that is left.
#include "tests/support/scene.h"

#include <math.h>
#include <string.h>

#include "lib/api/api.h"
#include "tests/support/refusal.h"

#define SIDE 64
#define HEADS 3
#define DT (1.0f / 60)

// The clock of the test. Queries read the time at which they were written.
static struct {
    double now; // ms
    double fixed, variable; // ms that a draw takes in any case, and at an importance of 1
    const struct hair_budget* budget;
    uint32_t written; // timestamps
    double time[1 << 16]; // ms, by name of the query
} ticker;

// Write the time. A call to draw takes time between its timestamps, and the application takes 3 ms
// between calls.
static void APIENTRY write_time(GLuint query, GLenum target)
{
    assert_int_equal(target, GL_TIMESTAMP);
    assert_true(query < sizeof ticker.time / sizeof *ticker.time);
    double importance = (double)ticker.budget->importance;
    ticker.now += ticker.written++ % 2 ? ticker.fixed + ticker.variable * fmin(importance, 8) : 3;
    ticker.time[query] = ticker.now;
}

static void APIENTRY read_time(GLuint query, GLenum name, GLuint64* out)
{
    *out = name == GL_QUERY_RESULT_AVAILABLE ? 1 : (GLuint64)(1e6 * ticker.time[query]);
}

// Heads at distances that grow eightfold, in a view that shows all of them.
struct heads {
    struct hair_test_scene scene;
    hair_instance* hair[HEADS];
    struct hair_gl was;
};

static struct heads make_heads(struct hair_test* test, bool by_ticker)
{
    hair_look look = hair_look_default();
    look.strand.radius = 0.001f;
    struct heads heads = {.scene = hair_test_scene_of(test, NULL, &look)};
    hair_physics physics = hair_physics_default();
    hair_desc desc = hair_desc_default();
    struct hair_gl* gl = &test->context->gl;
    physics.sleep_threshold = 0;
    desc.physics = &physics;
    desc.look = &look;
    for (int i = 0; i < HEADS; ++i) {
        desc.transform[12] = 0.2f * (float)i;
        desc.transform[14] = -powf(8, (float)i);
        hair_test_ok(test, hair_create(test->context, heads.scene.groom, &desc, &heads.hair[i]));
    }
    hair_test_set_perspective(&heads.scene.view, 4, 1);
    hair_test_frame_make(&heads.scene.frame, SIDE, SIDE, GL_RGBA32F, 0);
    heads.was = *gl;
    memset(&ticker, 0, sizeof ticker);
    ticker.budget = &test->context->budget;
    if (!by_ticker) return heads;
    gl->QueryCounter = write_time;
    gl->GetQueryObjectui64v = read_time;
    return heads;
}

static void free_heads(struct heads* heads)
{
    struct hair_test* test = heads->scene.test;
    hair_test_ok(test, hair_set_budget(test->context, 0));
    test->context->gl.QueryCounter = heads->was.QueryCounter;
    test->context->gl.GetQueryObjectui64v = heads->was.GetQueryObjectui64v;
    for (int i = 0; i < HEADS; ++i) hair_destroy(heads->hair[i]);
    hair_test_scene_free(&heads->scene);
}

static void run_frame(struct heads* heads, float dt)
{
    struct hair_test* test = heads->scene.test;
    hair_test_ok(test, hair_step_list(heads->hair, HEADS, dt));
    hair_test_frame_clear(&heads->scene.frame);
    hair_test_ok(test, hair_draw_list(heads->hair, HEADS, &heads->scene.view));
}

static void run_frames(struct heads* heads, int count)
{
    for (int i = 0; i < count; ++i) run_frame(heads, DT);
}

static hair_report_info report(const struct heads* heads, int head)
{
    hair_report_info info = hair_report_info_default();
    uint32_t count = 0;
    hair_test_ok(heads->scene.test, hair_report(heads->hair[head], false, &info, NULL, 0, 0, &count));
    return info;
}

// Run frames, in which nothing that is given up may change, and the time is in the budget.
static void expect_steady(struct heads* heads, int frames, float ms)
{
    float importance = report(heads, 0).budget_importance;
    for (int i = 0; i < frames; ++i) {
        run_frame(heads, DT);
        hair_report_info info = report(heads, 0);
        assert_float_equal(info.budget_importance, importance, 0);
        assert_true(info.budget_used <= ms);
    }
}

static void budget_is_kept_and_detail_comes_back(void** state)
{
    struct heads heads = make_heads(*state, true);
    hair_test_ok(heads.scene.test, hair_set_budget(heads.scene.test->context, 5));
    // A step and a draw take the same time: 2 * (0.2 + 4) ms at an importance of 8 and more.
    ticker.fixed = 0.2, ticker.variable = 0.5;
    run_frames(&heads, 150);
    expect_steady(&heads, 100, 5);
    assert_true(report(&heads, 0).budget_used >= 0.75f * 5);
    assert_true(report(&heads, 0).budget_importance < 8);
    ticker.variable = 4; // A rise of the load to nearly its eightfold.
    run_frames(&heads, 150);
    expect_steady(&heads, 100, 5);
    ticker.variable = 0.01;
    run_frames(&heads, 1000);
    // The farthest head is smaller than a pixel, so all of its detail needs more than 100.
    assert_true(report(&heads, 0).budget_importance > 100);
    for (int i = 0; i < HEADS; ++i) assert_float_equal(report(&heads, i).budget_substep_rate, 1, 0);
    assert_float_equal(report(&heads, 0).budget_samples, 1, 0);
    free_heads(&heads);
}

static void small_and_unseen_heads_give_up_first(void** state)
{
    struct heads heads = make_heads(*state, true);
    hair_test_ok(heads.scene.test, hair_set_budget(heads.scene.test->context, 5));
    ticker.fixed = 0.2, ticker.variable = 1.2; // An importance of about 1.8 is left.
    run_frames(&heads, 200);
    float rate[HEADS];
    for (int i = 0; i < HEADS; ++i) rate[i] = report(&heads, i).budget_substep_rate;
    assert_float_equal(rate[0], 1, 0);
    assert_true(rate[1] < rate[0]);
    assert_true(rate[2] <= rate[1] && rate[2] <= 0.25f);
    assert_float_equal(report(&heads, 0).budget_samples, 1, 0);
    ticker.variable = 20; // An importance of about 0.1 is left.
    run_frames(&heads, 200);
    assert_float_equal(report(&heads, 0).budget_samples, 0.25f, 0);
    assert_true(heads.hair[2]->sim.substep > heads.hair[0]->sim.substep);
    free_heads(&heads);
}

static void small_heads_keep_their_light_for_some_frames(void** state)
{
    struct heads heads = make_heads(*state, true);
    struct hair_test* test = heads.scene.test;
    for (int i = 0; i < HEADS; ++i) {
        hair_look look = heads.hair[i]->look;
        look.self_shadow.method = HAIR_SELF_SHADOW_STRANDS;
        look.self_shadow.cell = 0.05f; // Few nodes take little time.
        hair_test_ok(test, hair_set_look(heads.hair[i], &look));
    }
    uint32_t lit[HEADS] = {0};
    run_frames(&heads, 4);
    for (int i = 0; i < HEADS; ++i)
        assert_true(hair_test_report_row(test, heads.hair[i], "self_shadow").runs > 0);
    hair_test_ok(test, hair_set_budget(test->context, 5));
    ticker.fixed = 0.2, ticker.variable = 1.2;
    run_frames(&heads, 200);
    for (int frame = 0; frame < 8; ++frame) {
        run_frame(&heads, DT);
        for (int i = 0; i < HEADS; ++i)
            lit[i] += hair_test_report_row(test, heads.hair[i], "self_shadow").runs > 0;
    }
    assert_int_equal(lit[0], 8); // All of its substeps are left to the near head.
    assert_int_equal(lit[1], 4);
    assert_int_equal(lit[2], 2);
    free_heads(&heads);
}

static void work_of_the_application_does_not_count(void** state)
{
    struct heads heads = make_heads(*state, true);
    struct hair_test* test = heads.scene.test;
    hair_test_ok(test, hair_set_budget(test->context, 100));
    ticker.fixed = 2;
    for (int i = 0; i < 20; ++i) {
        for (int k = 0; k < HEADS; ++k) hair_test_ok(test, hair_step(heads.hair[k], DT));
        for (int k = 0; k < HEADS; ++k) hair_test_ok(test, hair_draw(heads.hair[k], &heads.scene.view));
    }
    // The 3 ms between calls do not count.
    assert_float_equal(report(&heads, 0).budget_used, 2 * HEADS * 2, 1e-4);
    // A step of 0 s ends a frame, and takes no time of the GPU.
    for (int i = 0; i < 20; ++i) {
        for (int k = 0; k < HEADS; ++k) hair_test_ok(test, hair_step(heads.hair[k], 0));
        for (int k = 0; k < HEADS; ++k) hair_test_ok(test, hair_draw(heads.hair[k], &heads.scene.view));
    }
    assert_float_equal(report(&heads, 0).budget_used, HEADS * 2, 1e-4);
    // Several steps and views are of one frame.
    for (int i = 0; i < 20; ++i) {
        for (int k = 0; k < 4; ++k) hair_test_ok(test, hair_step(heads.hair[0], DT));
        for (int k = 0; k < 3; ++k) hair_test_ok(test, hair_draw(heads.hair[0], &heads.scene.view));
    }
    assert_float_equal(report(&heads, 0).budget_used, 14, 1e-4);
    free_heads(&heads);
}

static void read_heads(struct heads* heads, float* pixels)
{
    hair_test_frame_clear(&heads->scene.frame);
    hair_test_ok(heads->scene.test, hair_draw_list(heads->hair, HEADS, &heads->scene.view));
    hair_test_frame_read(&heads->scene.frame, pixels);
}

static void budget_that_suffices_changes_no_picture(void** state)
{
    static float before[4 * SIDE * SIDE], within[4 * SIDE * SIDE], after[4 * SIDE * SIDE];
    struct heads heads = make_heads(*state, true);
    struct hair_test* test = heads.scene.test;
    run_frame(&heads, DT);
    read_heads(&heads, before);
    hair_test_ok(test, hair_set_budget(test->context, 1000));
    run_frame(&heads, 0);
    run_frame(&heads, 0);
    read_heads(&heads, within);
    assert_true(hair_test_mean_alpha(before, 4 * SIDE * SIDE) > 0.01);
    assert_true(hair_test_max_difference(before, within, 4 * SIDE * SIDE) < 0.02f);
    ticker.fixed = 5000;
    run_frames(&heads, 100);
    assert_true(report(&heads, 0).budget_importance < 1);
    hair_test_ok(test, hair_set_budget(test->context, 0));
    run_frame(&heads, 0);
    assert_float_equal(report(&heads, 0).budget_importance, 0, 0);
    assert_float_equal(report(&heads, 0).budget_substep_rate, 1, 0);
    for (int i = 0; i < HEADS; ++i) hair_test_ok(test, hair_reset(heads.hair[i]));
    run_frames(&heads, 8); // Substeps become shorter by one half at a time.
    for (int i = 0; i < HEADS; ++i) hair_test_ok(test, hair_reset(heads.hair[i]));
    run_frame(&heads, DT);
    read_heads(&heads, after);
    assert_float_equal(hair_test_max_difference(before, after, 4 * SIDE * SIDE), 0, 0);
    free_heads(&heads);
}

static void levels_of_the_application_are_multiplied(void** state)
{
    struct heads heads = make_heads(*state, true);
    struct hair_test* test = heads.scene.test;
    hair_lod lod = hair_lod_default();
    lod.importance = 3;
    heads.scene.view.lod = &lod;
    hair_test_ok(test, hair_set_budget(test->context, 5));
    run_frames(&heads, 20);
    struct hair_view_copy copy;
    hair_test_ok(test, hair_copy_view(heads.hair[0], &heads.scene.view, &copy));
    hair_reduce_view(heads.hair[0], &copy);
    assert_float_equal(copy.view.lod->importance, 3, 0);
    ticker.fixed = 0.2, ticker.variable = 20;
    run_frames(&heads, 150);
    hair_test_ok(test, hair_copy_view(heads.hair[0], &heads.scene.view, &copy));
    hair_reduce_view(heads.hair[0], &copy);
    assert_float_equal(copy.view.lod->importance, 3 * report(&heads, 0).budget_importance, 1e-6);
    assert_true(copy.view.lod->importance < 0.6f);
    assert_float_equal(lod.importance, 3, 0); // The struct of the application is not changed.
    lod.per_patch = false;
    lod.strand_fraction = 0.5f;
    hair_test_ok(test, hair_copy_view(heads.hair[0], &heads.scene.view, &copy));
    hair_reduce_view(heads.hair[0], &copy);
    assert_true(copy.view.lod->strand_fraction < 0.1f);
    free_heads(&heads);
}

static void budget_by_the_clock_of_the_driver(void** state)
{
    struct heads heads = make_heads(*state, false);
    struct hair_test* test = heads.scene.test;
    GLuint buffer = 0;
    glCreateBuffers(1, &buffer);
    glNamedBufferStorage(buffer, 64, NULL, 0);
    glBindBuffer(GL_QUERY_BUFFER, buffer); // Results must not go there.
    hair_test_ok(test, hair_set_budget(test->context, 0.001f)); // No driver can keep that.
    for (int i = 0; i < 200 && !(report(&heads, 0).budget_importance <= 0.05f); ++i) {
        run_frame(&heads, DT);
        glFinish();
    }
    GLint bound = 0;
    glGetIntegerv(GL_QUERY_BUFFER_BINDING, &bound);
    assert_int_equal(bound, (GLint)buffer);
    assert_true(report(&heads, 0).budget_used > 0.001f);
    assert_float_equal(report(&heads, 0).budget_importance, 0.05f, 1e-6);
    glDeleteBuffers(1, &buffer);
    free_heads(&heads);
}

static void refused_steps_leave_the_budget(void** state)
{
    struct heads heads = make_heads(*state, true);
    struct hair_test* test = heads.scene.test;
    const char* words = "no OpenGL context is current";
    hair_test_ok(test, hair_set_budget(test->context, 5));
    ticker.variable = 4;
    for (int i = 0; i < 20; ++i) run_frame(&heads, DT);
    const struct hair_budget was = test->context->budget;
    const struct hair_budget_part part = heads.hair[0]->budget;
    hair_egl_make_current(NULL);
    hair_test_refused(test, hair_step(heads.hair[0], DT), HAIR_ERROR_OPENGL, words);
    hair_test_refused(test, hair_step_list(heads.hair, HEADS, DT), HAIR_ERROR_OPENGL, words);
    assert_memory_equal(&test->context->budget, &was, sizeof was);
    assert_memory_equal(&heads.hair[0]->budget, &part, sizeof part);
    hair_egl_make_current(test->egl);
    free_heads(&heads);
}

static void budget_out_of_range_is_refused(void** state)
{
    struct hair_test* test = *state;
    const float bad[] = {-1, 1001, NAN, INFINITY};
    hair_test_ok(test, hair_set_budget(test->context, 4));
    for (size_t i = 0; i < sizeof bad / sizeof *bad; ++i)
        hair_test_refused(test, hair_set_budget(test->context, bad[i]), HAIR_ERROR_ARGUMENT, "ms is ");
    assert_float_equal(test->context->budget.ms, 4, 0);
    hair_test_ok(test, hair_set_budget(test->context, 0));
    assert_int_equal(hair_set_budget(NULL, 1), HAIR_ERROR_ARGUMENT);
}

int main(void)
{
    if (hair_test_skips()) return 0;
    const struct CMUnitTest tests[] = {HAIR_TEST(budget_is_kept_and_detail_comes_back),
                                       HAIR_TEST(small_and_unseen_heads_give_up_first),
                                       HAIR_TEST(small_heads_keep_their_light_for_some_frames),
                                       HAIR_TEST(work_of_the_application_does_not_count),
                                       HAIR_TEST(budget_that_suffices_changes_no_picture),
                                       HAIR_TEST(levels_of_the_application_are_multiplied),
                                       HAIR_TEST(budget_by_the_clock_of_the_driver),
                                       HAIR_TEST(refused_steps_leave_the_budget),
                                       HAIR_TEST(budget_out_of_range_is_refused)};
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
