// context_loss_test.c - an OpenGL context that is lost or destroyed while the library uses it. The
// calls say so and stop calling OpenGL, and everything comes back in another one.
#include "tests/support/scene.h"

#include <stdlib.h>
#include <string.h>

#include "tests/support/trace.h"
#include "tests/support/ways.h"
#include "tests/support/tessellated.h"

#define SIDE 32
#define FRAMES 3
#define PIXELS (4 * SIDE * SIDE)

static const char frost[] = "vec4 hair_shade(hair_fragment f) { return vec4(f.t, 0.5, 0.5, 1.0); }\n";

// Hair with much to lose, drawn in each frame.
struct fixture {
    struct hair_test* test;
    hair_egl* egl; // the OpenGL context that is lost
    hair_context* context;
    hair_groom* groom;
    hair_instance* hair;
    hair_shader* shader;
    struct hair_test_frame frame;
    uint32_t blocks;
};

// A run that nothing disturbs.
struct run {
    struct hair_test_points guides[FRAMES + 1]; // after each step
    float pixels[PIXELS]; // of the last frame
    uint32_t calls; // of OpenGL in all frames
};

static hair_result create(struct fixture* f, int way, bool restorable)
{
    hair_context_desc context = hair_context_desc_default();
    hair_desc desc = hair_test_way(way);
    hair_look look = hair_look_default();
    hair_shader_desc shader = hair_shader_desc_default();
    context.host = &f->test->host.host;
    context.get_proc = hair_test_trace_proc;
    context.restorable = restorable;
    look.self_shadow.method = HAIR_SELF_SHADOW_STRANDS;
    desc.look = &look;
    desc.label = "fringe";
    shader.glsl = frost;
    HAIR_TRY(hair_context_create(&context, &f->context));
    HAIR_TRY(hair_create(f->context, f->groom, &desc, &f->hair));
    return hair_shader_create(f->context, &shader, &f->shader);
}

static void start(struct fixture* f, struct hair_test* test, int way)
{
    *f = (struct fixture){.test = test, .blocks = hair_test_blocks(test)};
    hair_test_trace_lose(0, 0);
    hair_test_ok(test, hair_egl_create(&test->host.host, -1, &f->egl));
    struct hair_test_handmade groom = hair_test_handmade_default();
    groom.followers = 150;
    f->groom = hair_test_groom(&test->host.host, groom);
    hair_test_frame_make(&f->frame, SIDE, SIDE, GL_RGBA32F, 0);
    hair_test_ok(test, create(f, way, true));
    hair_test_trace_clear();
}

static void destroy(struct fixture* f)
{
    hair_destroy(f->hair);
    hair_shader_destroy(f->shader);
    hair_context_destroy(f->context);
    f->hair = NULL;
    f->shader = NULL;
    f->context = NULL;
}

static void finish(struct fixture* f)
{
    hair_test_trace_lose(0, 0);
    destroy(f);
    hair_groom_destroy(f->groom);
    hair_egl_destroy(f->egl);
    hair_egl_make_current(f->test->egl);
    assert_int_equal(hair_test_blocks(f->test), f->blocks);
}

// Set what the application sets before step `i`, from 1.
static hair_result set(struct fixture* f, int i)
{
    hair_collider ball = hair_collider_default();
    hair_wind wind = hair_wind_default();
    hair_wind_source fan = {.direction = {1, 0, 0}, .speed = 2, .radius = 0.5f};
    hair_desc head = hair_desc_default();
    hair_pin pin = hair_pin_default();
    float away = 0.01f * (float)i;
    ball.shape = HAIR_SHAPE_SPHERE;
    ball.size[0] = 0.08f;
    ball.position[0] = away;
    wind.sources = &fan;
    wind.source_count = 1;
    head.transform[13] = away;
    pin.position[1] = 0.2f;
    pin.vertex = 2;
    HAIR_TRY(hair_set_colliders(f->hair, &ball, 1, sizeof ball));
    HAIR_TRY(hair_set_transform(f->hair, head.transform));
    HAIR_TRY(hair_set_wind(f->hair, &wind));
    // The solver redblack has no pins.
    return f->hair->sim.rods ? hair_set_pins(f->hair, &pin, 1, sizeof pin) : HAIR_OK;
}

// Draw by two paths. The second shades by the application.
static hair_result draw(struct fixture* f)
{
    hair_view view = hair_test_tessellated();
    hair_test_set_orthographic(&view, 4, 0.5f, 0);
    hair_test_frame_clear(&f->frame);
    HAIR_TRY(hair_draw(f->hair, &view));
    view.shader = f->shader;
    view.render_path = HAIR_RENDER_PATH_CACHED;
    return hair_draw(f->hair, &view);
}

static hair_result run_frame(struct fixture* f, int i)
{
    HAIR_TRY(set(f, i));
    HAIR_TRY(hair_step(f->hair, 1.0f / 60));
    return draw(f);
}

static void run_all(struct hair_test* test, int way, struct run* out)
{
    struct fixture f;
    start(&f, test, way);
    hair_test_read_points(test, f.hair, HAIR_READ_GUIDES, &out->guides[0]);
    hair_test_trace_clear();
    for (int i = 1; i <= FRAMES; ++i) {
        hair_test_ok(test, run_frame(&f, i));
        glFinish(); // Snapshots arrive in time.
    }
    out->calls = hair_test_trace_count("");
    hair_test_frame_read(&f.frame, out->pixels);
    double seen = hair_test_mean_alpha(out->pixels, PIXELS);
    if (!(seen > 0.003)) fail_msg("%s: mean alpha is %g", hair_test_way_name(way), seen);
    finish(&f);
    start(&f, test, way); // Reading guides counts as seeing them, so that another run reads them.
    for (int i = 1; i <= FRAMES; ++i) {
        hair_test_ok(test, run_frame(&f, i));
        hair_test_read_points(test, f.hair, HAIR_READ_GUIDES, &out->guides[i]);
    }
    finish(&f);
}

// Replace the OpenGL context that is lost.
static void replace_egl(struct fixture* f)
{
    hair_test_trace_lose(0, 0);
    hair_egl_destroy(f->egl);
    f->egl = NULL;
    hair_test_ok(f->test, hair_egl_create(&f->test->host.host, -1, &f->egl));
    hair_test_frame_make(&f->frame, SIDE, SIDE, GL_RGBA32F, 0);
}

// Return the step after which the guides stood as they do now. -1 means at rest under the last
// transform, without any snapshot.
static int find_step(struct fixture* f, const struct run* run)
{
    struct hair_test_points now;
    hair_test_read_points(f->test, f->hair, HAIR_READ_GUIDES, &now);
    for (int i = FRAMES; i >= 0; --i)
        if (memcmp(now.at, run->guides[i].at, 3 * now.count * sizeof *now.at) == 0) return i;
    if (f->hair->sim.snapshots.last.size) fail_msg("the guides are as after no step");
    float away = (float)f->hair->sim.head.position[1];
    for (uint32_t i = 0; i < now.count; ++i) now.at[3 * i + 1] -= away;
    assert_true(hair_test_points_distance(&now, &run->guides[0]) < 1e-6);
    return -1;
}

// Restore, do what has been lost once more, and compare the picture. Return the step restored, or
// -1.
static int check_restored(struct fixture* f, const struct run* run)
{
    static float pixels[PIXELS];
    hair_test_ok(f->test, hair_context_restore(f->context));
    int step = find_step(f, run);
    for (int i = step < 0 ? 1 : step + 1; i <= FRAMES; ++i) hair_test_ok(f->test, run_frame(f, i));
    if (step == FRAMES) hair_test_ok(f->test, draw(f));
    hair_test_frame_read(&f->frame, pixels);
    if (step >= 0) assert_memory_equal(pixels, run->pixels, sizeof pixels);
    return step;
}

#define lost(call) hair_test_refused(f->test, call, HAIR_ERROR_CONTEXT_LOST, "the OpenGL context is lost")

// Check that every call that needs OpenGL says that the context is lost, and calls none.
static void check_lost(struct fixture* f)
{
    hair_desc desc = hair_desc_default();
    hair_solver_stats stats = hair_solver_stats_default();
    hair_field_info field = hair_field_info_default();
    hair_report_info report = hair_report_info_default();
    hair_view view = hair_test_tessellated();
    hair_shader_desc shader = hair_shader_desc_default();
    hair_instance* other = NULL;
    hair_shader* other_shader = NULL;
    float positions[30] = {0};
    uint32_t count = 0;
    size_t size = 0;
    bool ready = false;
    shader.glsl = frost;
    hair_test_trace_clear();
    lost(hair_step(f->hair, 1.0f / 60));
    lost(hair_draw(f->hair, &view));
    lost(hair_reset(f->hair));
    lost(hair_teleport(f->hair, desc.transform));
    lost(hair_precompile(f->hair, &view, &ready));
    lost(hair_read_positions(f->hair, HAIR_READ_GUIDES, positions, 10, &count));
    lost(hair_get_solver_stats(f->hair, &stats));
    lost(hair_get_field(f->hair, &field));
    lost(hair_report(f->hair, true, &report, NULL, 0, 0, &count));
    lost(hair_save(f->hair, NULL, 0, &size));
    lost(hair_load(f->hair, positions, sizeof positions));
    lost(hair_context_reload(f->context));
    lost(hair_create(f->context, f->groom, &desc, &other));
    lost(hair_shader_create(f->context, &shader, &other_shader));
    if (hair_test_trace_count("")) fail_msg("a lost context was used:%s", hair_test_trace_list());
}

// Run frames until the context is lost.
static hair_result run_until_loss(struct fixture* f)
{
    hair_result result = HAIR_OK;
    for (int i = 1; i <= FRAMES && !result; ++i) {
        result = run_frame(f, i);
        if (!result) glFinish();
    }
    return result;
}

static void lose_at(struct hair_test* test, int way, uint32_t call, const struct run* run)
{
    static const GLenum statuses[] = {GL_GUILTY_CONTEXT_RESET, GL_INNOCENT_CONTEXT_RESET,
                                      GL_UNKNOWN_CONTEXT_RESET};
    struct fixture f;
    start(&f, test, way);
    hair_test_trace_lose(call, statuses[call % 3]);
    hair_result result = run_until_loss(&f);
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
        replace_egl(&f);
        check_restored(&f, run);
    } else {
        hair_test_trace_clear();
        hair_test_trace_lose(1, GL_GUILTY_CONTEXT_RESET);
        destroy(&f);
        if (hair_test_trace_count("")) fail_msg("a lost context was used:%s", hair_test_trace_list());
    }
    finish(&f);
}

static void loss_at_any_call_is_told_and_restored(void** state)
{
    static struct run run;
    bool all = getenv("HAIR_TEST_FULL") != NULL;
    for (int way = 0; way < HAIR_TEST_WAYS; ++way) {
        run_all(*state, way, &run);
        uint32_t stride = all ? 23 : run.calls / 2, first = 1 + (uint32_t)way * 13;
        for (uint32_t call = first; call < run.calls; call += stride) lose_at(*state, way, call, &run);
        lose_at(*state, way, run.calls, &run);
    }
}

// Check that a loss is told which happens while a call asks OpenGL about its arguments. The answers
// of a lost context look like those about wrong arguments. A loss after the checks is not tried.
static void loss_while_arguments_are_checked_is_told(void** state)
{
    struct fixture f;
    hair_view view = hair_test_tessellated();
    hair_light light = hair_light_default();
    hair_wind wind = hair_wind_default();
    GLuint map, volume;
    uint32_t call = 1;
    start(&f, *state, 0);
    hair_test_ok(f.test, run_frame(&f, 1));
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
    replace_egl(&f);
    finish(&f);
}

static void restored_hair_is_at_most_two_steps_old(void** state)
{
    static struct run run;
    struct fixture f;
    run_all(*state, 0, &run);
    start(&f, *state, 0);
    for (int i = 1; i <= FRAMES; ++i) {
        hair_test_ok(*state, run_frame(&f, i));
        glFinish();
    }
    replace_egl(&f);
    assert_true(check_restored(&f, &run) >= FRAMES - 2);
    finish(&f);
}

static void destroyed_opengl_context_can_be_replaced(void** state)
{
    static struct run run;
    struct fixture f;
    run_all(*state, 0, &run);
    start(&f, *state, 0);
    hair_test_ok(f.test, run_frame(&f, 1));
    glFinish();
    hair_test_ok(f.test, run_frame(&f, 2));
    hair_egl_destroy(f.egl);
    f.egl = NULL;
    hair_test_refused(f.test, hair_step(f.hair, 1.0f / 60), HAIR_ERROR_OPENGL,
                      "no OpenGL context is current");
    hair_test_refused(f.test, hair_context_restore(f.context), HAIR_ERROR_OPENGL,
                      "no OpenGL context is current");
    replace_egl(&f);
    check_restored(&f, &run);
    finish(&f);
}

// A context that is lost passes the fence of a copy that was never made.
static void snapshot_that_a_loss_cuts_off_is_not_used(void** state)
{
    static const float garbage = 1;
    static struct run run;
    struct fixture f;
    run_all(*state, 0, &run);
    start(&f, *state, 0);
    hair_test_ok(f.test, run_frame(&f, 1));
    glClearNamedBufferData(f.hair->sim.snapshots.buffer, GL_R32F, GL_RED, GL_FLOAT, &garbage);
    glFinish();
    hair_test_ok(f.test, set(&f, 2));
    hair_test_trace_clear();
    // After the check at the start of the call.
    hair_test_trace_lose(20, GL_INNOCENT_CONTEXT_RESET);
    assert_int_equal(hair_step(f.hair, 1.0f / 60), HAIR_ERROR_CONTEXT_LOST);
    hair_test_forgive(f.test); // Creations may have failed before.
    replace_egl(&f);
    assert_int_equal(check_restored(&f, &run), -1);
    finish(&f);
}

static void second_loss_restores_the_same_state(void** state)
{
    static struct run run;
    struct fixture f;
    run_all(*state, 0, &run);
    start(&f, *state, 0);
    hair_test_ok(f.test, run_until_loss(&f));
    replace_egl(&f);
    hair_test_ok(f.test, hair_context_restore(f.context));
    replace_egl(&f);
    assert_true(check_restored(&f, &run) > 0);
    finish(&f);
}

static void hair_without_a_snapshot_is_at_rest(void** state)
{
    static struct run run;
    struct fixture f;
    run_all(*state, 0, &run);
    start(&f, *state, 0);
    replace_egl(&f);
    assert_int_equal(check_restored(&f, &run), 0);
    finish(&f);
}

// Refuse every allocation of a restoration, one after the other.
static void failed_restoration_changes_nothing(void** state)
{
    static struct run run;
    struct hair_test* test = *state;
    struct fixture f;
    uint32_t failures = 0;
    run_all(test, 0, &run);
    start(&f, test, 0);
    hair_test_ok(test, run_until_loss(&f));
    replace_egl(&f);
    hair_result result = HAIR_ERROR_MEMORY;
    for (uint32_t i = 1; result; ++i) {
        uint32_t blocks = test->host.blocks;
        hair_instance was = *f.hair;
        hair_memory before = hair_memory_default(), after = hair_memory_default();
        hair_test_ok(test, hair_get_memory(f.context, &before));
        test->host.refuse = test->host.allocations + i;
        result = hair_context_restore(f.context);
        test->host.refuse = 0;
        if (!result) break;
        assert_int_equal(result, HAIR_ERROR_MEMORY);
        ++failures;
        hair_test_forgive(test);
        assert_int_equal(test->host.blocks, blocks);
        assert_memory_equal(f.hair, &was, sizeof was);
        hair_test_ok(test, hair_get_memory(f.context, &after));
        assert_int_equal(after.bytes, before.bytes);
    }
    assert_true(failures > 20);
    assert_true(check_restored(&f, &run) > 0);
    finish(&f);
}

static void settings_made_after_a_loss_are_kept(void** state)
{
    struct hair_test* test = *state;
    struct fixture f;
    hair_physics physics = hair_physics_default(), got = hair_physics_default();
    hair_look look = hair_look_default(), got_look = hair_look_default();
    start(&f, test, 0);
    hair_group_look group = hair_group_look_default(), got_group = group;
    group.radius = 2, group.color.enabled = true;
    hair_test_ok(test, hair_set_group_look(f.hair, 1, &group));
    hair_test_trace_lose(1, GL_GUILTY_CONTEXT_RESET);
    hair_test_refused(test, hair_step(f.hair, 1.0f / 60), HAIR_ERROR_CONTEXT_LOST, "lost");
    physics.damping = 5;
    look.strand.segments = 7;
    hair_physics stiff = physics, got_stiff = physics;
    stiff.shape.stiffness_tip = 3;
    hair_test_ok(test, hair_set_physics(f.hair, &physics));
    hair_test_ok(test, hair_set_group_physics(f.hair, 2, &stiff));
    hair_test_ok(test, hair_set_look(f.hair, &look));
    hair_test_ok(test, hair_set_memory_limit(f.context, 123456789));
    replace_egl(&f);
    hair_test_ok(test, hair_context_restore(f.context));
    hair_test_ok(test, hair_get_group_look(f.hair, 1, &got_group));
    assert_memory_equal(&got_group, &group, sizeof group);
    hair_test_ok(test, hair_get_physics(f.hair, &got));
    hair_test_ok(test, hair_get_look(f.hair, &got_look));
    assert_memory_equal(&got, &physics, sizeof got);
    hair_test_ok(test, hair_get_group_physics(f.hair, 2, &got_stiff));
    assert_memory_equal(&got_stiff, &stiff, sizeof stiff);
    assert_memory_equal(&got_look, &look, sizeof look);
    hair_memory memory = hair_memory_default();
    hair_test_ok(test, hair_get_memory(f.context, &memory));
    assert_int_equal(memory.limit, 123456789);
    hair_test_ok(test, run_frame(&f, 1));
    finish(&f);
}

static void restoration_needs_a_restorable_context(void** state)
{
    struct hair_test* test = *state;
    struct fixture f = {.test = test, .blocks = hair_test_blocks(test)};
    assert_int_equal(hair_context_restore(NULL), HAIR_ERROR_ARGUMENT);
    f.groom = hair_test_groom(&test->host.host, hair_test_handmade_default());
    hair_test_frame_make(&f.frame, SIDE, SIDE, GL_RGBA32F, 0);
    hair_test_ok(test, create(&f, 0, false));
    hair_test_trace_clear();
    hair_test_ok(test, run_until_loss(&f));
    // The copies cost nothing unless they are wanted.
    assert_int_equal(hair_test_trace_count("glFenceSync"), 0);
    hair_test_refused(test, hair_context_restore(f.context), HAIR_ERROR_ARGUMENT, "restorable was false");
    hair_context_abandon(f.context);
    hair_test_refused(test, hair_context_restore(f.context), HAIR_ERROR_ARGUMENT, "abandoned");
    hair_test_frame_free(&f.frame);
    finish(&f);
}

static void groom_may_be_destroyed_before_a_restoration(void** state)
{
    struct fixture f;
    start(&f, *state, 0);
    hair_groom_destroy(f.groom);
    f.groom = NULL;
    replace_egl(&f);
    hair_test_ok(f.test, hair_context_restore(f.context));
    hair_test_ok(f.test, run_frame(&f, 1));
    finish(&f);
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
        HAIR_TEST(restored_hair_is_at_most_two_steps_old),
        HAIR_TEST(destroyed_opengl_context_can_be_replaced),
        HAIR_TEST(snapshot_that_a_loss_cuts_off_is_not_used),
        HAIR_TEST(second_loss_restores_the_same_state),
        HAIR_TEST(hair_without_a_snapshot_is_at_rest),
        HAIR_TEST(failed_restoration_changes_nothing),
        HAIR_TEST(settings_made_after_a_loss_are_kept),
        HAIR_TEST(restoration_needs_a_restorable_context),
        HAIR_TEST(groom_may_be_destroyed_before_a_restoration),
        HAIR_TEST(context_of_egl_reports_its_loss),
    };
    return hair_test_skips() ? 0 : cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
