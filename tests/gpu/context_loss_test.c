// context_loss_test.c - an OpenGL context that is lost while the library uses it. The calls say so
// and stop calling OpenGL.
#include "tests/support/context_loss.h"

#include <stdlib.h>

#include "tests/support/refused_calls.h"
#include "tests/support/tessellated.h"
#include "tests/support/trace.h"
#include "tests/support/ways.h"

static const char* const words = "the OpenGL context is lost";

// Check that every call that needs OpenGL says that the context is lost, and calls none.
static void check_lost(struct hair_test_loss* f)
{
    hair_test_trace_clear();
    hair_test_refuse_calls(f->test, f->hair, HAIR_ERROR_CONTEXT_LOST, words);
    hair_test_refuse_context_calls(f->test, f->context, f->groom, HAIR_ERROR_CONTEXT_LOST, words);
    if (hair_test_trace_count("")) fail_msg("a lost context was used:%s", hair_test_trace_list());
}

static void lose_at(struct hair_test* test, int way, uint32_t call, const struct hair_test_loss_run* run)
{
    static const GLenum statuses[] = {GL_GUILTY_CONTEXT_RESET, GL_INNOCENT_CONTEXT_RESET,
                                      GL_UNKNOWN_CONTEXT_RESET};
    struct hair_test_loss f;
    hair_test_loss_start(&f, test, way);
    hair_test_trace_lose(call, statuses[call % 3]);
    hair_result result = hair_test_loss_run(&f);
    // A loss at the last call is told by the next frame. Software drivers decide by time how many
    // calls a frame has, so that the loss may also not have come yet.
    if (!result) {
        hair_test_trace_lose(1, statuses[call % 3]);
        result = hair_step(f.hair, 1.0f / 60);
    }
    hair_test_forgive(test); // The driver may have refused memory before.
    if (result != HAIR_ERROR_CONTEXT_LOST)
        fail_msg("loss at call %u of %u: %s", call, run->calls, hair_result_string(result));
    check_lost(&f);
    if (call % 2) { // Half of all applications give up.
        hair_test_loss_replace_egl(&f);
        hair_test_loss_check(&f, run);
    } else {
        hair_test_trace_clear();
        hair_test_trace_lose(1, GL_GUILTY_CONTEXT_RESET);
        hair_test_loss_destroy(&f);
        if (hair_test_trace_count("")) fail_msg("a lost context was used:%s", hair_test_trace_list());
    }
    hair_test_loss_finish(&f);
}

static void loss_at_any_call_is_told_and_restored(void** state)
{
    static struct hair_test_loss_run run;
    bool all = getenv("HAIR_TEST_FULL") != NULL;
    for (int way = 0; way < HAIR_TEST_WAYS; ++way) {
        hair_test_loss_record(*state, way, &run);
        uint32_t stride = all ? 23 : run.calls / 2, first = 1 + (uint32_t)way * 13;
        for (uint32_t call = first; call < run.calls; call += stride) lose_at(*state, way, call, &run);
        lose_at(*state, way, run.calls, &run);
    }
}

// Check that a loss is told which happens while a call asks OpenGL about its arguments. The answers
// of a lost context look like those about wrong arguments. A loss after the checks is not tried.
static void loss_while_arguments_are_checked_is_told(void** state)
{
    struct hair_test_loss f;
    hair_view view = hair_test_tessellated();
    hair_light light = hair_light_default();
    hair_wind wind = hair_wind_default();
    GLuint map, volume;
    uint32_t call = 1;
    hair_test_loss_start(&f, *state, 0);
    hair_test_ok(f.test, hair_test_loss_frame(&f, 1));
    glCreateTextures(GL_TEXTURE_2D, 1, &map);
    glTextureStorage2D(map, 1, GL_DEPTH_COMPONENT32F, 4, 4);
    glCreateTextures(GL_TEXTURE_3D, 1, &volume);
    glTextureStorage3D(volume, 1, GL_RGBA16F, 4, 4, 4);
    wind.texture = volume;
    for (;; ++call) {
        hair_test_trace_clear();
        hair_test_trace_lose(call, GL_GUILTY_CONTEXT_RESET);
        hair_result result = hair_set_wind(f.hair, &wind);
        if (!result) break;
        assert_int_equal(result, HAIR_ERROR_CONTEXT_LOST);
        hair_test_forgive(f.test);
        f.context->gl.is_lost = false; // The driver has lost nothing.
    }
    assert_true(call > 1);
    light.opaque_shadow_map = view.occluder_depth = map;
    view.occluder_matrix[0] = 1;
    view.lights = &light;
    view.light_count = 1;
    for (call = 1;; ++call) {
        hair_test_trace_clear();
        hair_test_trace_lose(call, GL_GUILTY_CONTEXT_RESET);
        assert_int_equal(hair_draw(f.hair, &view), HAIR_ERROR_CONTEXT_LOST);
        hair_test_forgive(f.test);
        if (hair_test_trace_count("glPushDebugGroup")) break;
        f.context->gl.is_lost = false;
    }
    assert_true(call > 8);
    hair_test_loss_replace_egl(&f);
    hair_test_loss_finish(&f);
}

// A context that is lost passes the fence of a copy that was never made.
static void snapshot_that_a_loss_cuts_off_is_not_used(void** state)
{
    static const float garbage = 1;
    static struct hair_test_loss_run run;
    struct hair_test_loss f;
    hair_test_loss_record(*state, 0, &run);
    hair_test_loss_start(&f, *state, 0);
    hair_test_ok(f.test, hair_test_loss_frame(&f, 1));
    glClearNamedBufferData(f.hair->sim.snapshots.buffer, GL_R32F, GL_RED, GL_FLOAT, &garbage);
    glFinish();
    hair_test_ok(f.test, hair_test_loss_set(&f, 2));
    hair_test_trace_clear();
    // After the check at the start of the call, and before the copy is read.
    hair_test_trace_lose(8, GL_INNOCENT_CONTEXT_RESET);
    assert_int_equal(hair_step(f.hair, 1.0f / 60), HAIR_ERROR_CONTEXT_LOST);
    hair_test_forgive(f.test); // Creations may have failed before.
    hair_test_loss_replace_egl(&f);
    assert_int_equal(hair_test_loss_check(&f, &run), -1);
    hair_test_loss_finish(&f);
}

static void context_of_egl_reports_its_loss(void** state)
{
    (void)state;
    GLint strategy = 0;
    glGetIntegerv(GL_RESET_NOTIFICATION_STRATEGY, &strategy);
    assert_int_equal(strategy, GL_LOSE_CONTEXT_ON_RESET);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        HAIR_TEST(loss_at_any_call_is_told_and_restored),
        HAIR_TEST(loss_while_arguments_are_checked_is_told),
        HAIR_TEST(snapshot_that_a_loss_cuts_off_is_not_used),
        HAIR_TEST(context_of_egl_reports_its_loss),
    };
    return hair_test_skips() ? 0 : cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
