// context_loss.c - hair with much to lose, in an OpenGL context that is lost while frames run.
#include "tests/support/context_loss.h"

#include <string.h>

#include "tests/support/tessellated.h"
#include "tests/support/trace.h"
#include "tests/support/ways.h"

const char hair_test_loss_glsl[] = "vec4 hair_shade(hair_fragment f) { return vec4(f.t, 0.5, 0.5, 1.0); }\n";

hair_result hair_test_loss_create(struct hair_test_loss* f, int way, bool restorable)
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
    shader.glsl = hair_test_loss_glsl;
    HAIR_TRY(hair_context_create(&context, &f->context));
    f->context->gl.records = true; // llvmpipe does not profit from recording.
    HAIR_TRY(hair_create(f->context, f->groom, &desc, &f->hair));
    HAIR_TRY(hair_create(f->context, f->groom, &desc, &f->twin));
    return hair_shader_create(f->context, &shader, &f->shader);
}

void hair_test_loss_start(struct hair_test_loss* f, struct hair_test* test, int way)
{
    *f = (struct hair_test_loss){.test = test, .blocks = hair_test_blocks(test)};
    hair_test_trace_lose(0, 0);
    hair_test_ok(test, hair_egl_create(&test->host.host, -1, &f->egl));
    struct hair_test_handmade groom = hair_test_handmade_default();
    groom.followers = 150;
    f->groom = hair_test_groom(&test->host.host, groom);
    hair_test_frame_make(&f->frame, HAIR_TEST_LOSS_SIDE, HAIR_TEST_LOSS_SIDE, GL_RGBA32F, 0);
    hair_test_ok(test, hair_test_loss_create(f, way, true));
    hair_test_trace_clear();
}

void hair_test_loss_destroy(struct hair_test_loss* f)
{
    hair_destroy(f->hair);
    hair_destroy(f->twin);
    hair_shader_destroy(f->shader);
    hair_context_destroy(f->context);
    f->hair = f->twin = NULL;
    f->shader = NULL;
    f->context = NULL;
}

void hair_test_loss_finish(struct hair_test_loss* f)
{
    hair_test_trace_lose(0, 0);
    hair_test_loss_destroy(f);
    hair_groom_destroy(f->groom);
    hair_egl_destroy(f->egl);
    hair_egl_make_current(f->test->egl);
    assert_int_equal(hair_test_blocks(f->test), f->blocks);
}

hair_result hair_test_loss_set(struct hair_test_loss* f, int i)
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

hair_result hair_test_loss_draw(struct hair_test_loss* f)
{
    hair_view view = hair_test_tessellated();
    hair_test_set_orthographic(&view, 4, 0.5f, 0);
    hair_test_frame_clear(&f->frame);
    HAIR_TRY(hair_draw_list((hair_instance*[]){f->hair, f->twin}, 2, &view));
    view.shader = f->shader;
    view.render_path = HAIR_RENDER_PATH_CACHED;
    return hair_draw(f->hair, &view);
}

hair_result hair_test_loss_frame(struct hair_test_loss* f, int i)
{
    HAIR_TRY(hair_test_loss_set(f, i));
    if (i % 2) {
        HAIR_TRY(hair_step_list((hair_instance*[]){f->hair, f->twin}, 2, 1.0f / 60));
    } else {
        HAIR_TRY(hair_step(f->hair, 1.0f / 60));
        HAIR_TRY(hair_step(f->twin, 1.0f / 60));
    }
    return hair_test_loss_draw(f);
}

void hair_test_loss_record(struct hair_test* test, int way, struct hair_test_loss_run* out)
{
    struct hair_test_loss f;
    hair_test_loss_start(&f, test, way);
    hair_test_read_points(test, f.hair, HAIR_READ_GUIDES, &out->guides[0]);
    hair_test_trace_clear();
    for (int i = 1; i <= HAIR_TEST_LOSS_FRAMES; ++i) {
        hair_test_ok(test, hair_test_loss_frame(&f, i));
        glFinish(); // Snapshots arrive in time.
    }
    out->calls = hair_test_trace_count("");
    hair_test_frame_read(&f.frame, out->pixels);
    double seen = hair_test_mean_alpha(out->pixels, HAIR_TEST_LOSS_PIXELS);
    if (!(seen > 0.003)) fail_msg("%s: mean alpha is %g", hair_test_way_name(way), seen);
    hair_test_loss_finish(&f);
    // Reading guides counts as seeing them, so that another run reads them.
    hair_test_loss_start(&f, test, way);
    for (int i = 1; i <= HAIR_TEST_LOSS_FRAMES; ++i) {
        hair_test_ok(test, hair_test_loss_frame(&f, i));
        hair_test_read_points(test, f.hair, HAIR_READ_GUIDES, &out->guides[i]);
    }
    hair_test_loss_finish(&f);
}

void hair_test_loss_replace_egl(struct hair_test_loss* f)
{
    hair_test_trace_lose(0, 0);
    hair_egl_destroy(f->egl);
    f->egl = NULL;
    hair_test_ok(f->test, hair_egl_create(&f->test->host.host, -1, &f->egl));
    hair_test_frame_make(&f->frame, HAIR_TEST_LOSS_SIDE, HAIR_TEST_LOSS_SIDE, GL_RGBA32F, 0);
}

// Return the step after which the guides stood as they do now. -1 means at rest under the last
// transform, without any snapshot.
static int find_step(struct hair_test_loss* f, const struct hair_test_loss_run* run)
{
    struct hair_test_points now;
    hair_test_read_points(f->test, f->hair, HAIR_READ_GUIDES, &now);
    for (int i = HAIR_TEST_LOSS_FRAMES; i >= 0; --i)
        if (memcmp(now.at, run->guides[i].at, 3 * now.count * sizeof *now.at) == 0) return i;
    if (f->hair->sim.snapshots.last.size) fail_msg("the guides are as after no step");
    float away = (float)f->hair->sim.head.position[1];
    for (uint32_t i = 0; i < now.count; ++i) now.at[3 * i + 1] -= away;
    assert_true(hair_test_points_distance(&now, &run->guides[0]) < 1e-6);
    return -1;
}

int hair_test_loss_check(struct hair_test_loss* f, const struct hair_test_loss_run* run)
{
    static float pixels[HAIR_TEST_LOSS_PIXELS];
    hair_test_ok(f->test, hair_context_restore(f->context));
    int step = find_step(f, run);
    for (int i = step < 0 ? 1 : step + 1; i <= HAIR_TEST_LOSS_FRAMES; ++i)
        hair_test_ok(f->test, hair_test_loss_frame(f, i));
    if (step == HAIR_TEST_LOSS_FRAMES) hair_test_ok(f->test, hair_test_loss_draw(f));
    hair_test_frame_read(&f->frame, pixels);
    if (step >= 0) assert_memory_equal(pixels, run->pixels, sizeof pixels);
    return step;
}

hair_result hair_test_loss_run(struct hair_test_loss* f)
{
    hair_result result = HAIR_OK;
    for (int i = 1; i <= HAIR_TEST_LOSS_FRAMES && !result; ++i) {
        result = hair_test_loss_frame(f, i);
        if (!result) glFinish();
    }
    return result;
}

void hair_test_restorable_begin(struct hair_test* test, struct hair_test_restorable* f)
{
    hair_context_desc desc = hair_context_desc_default();
    desc.host = &test->host.host;
    desc.get_proc = hair_egl_get_proc;
    desc.restorable = true;
    *f = (struct hair_test_restorable){.own = test->context};
    hair_test_ok(test, hair_egl_create(&test->host.host, -1, &f->egl));
    hair_context* made = NULL;
    hair_test_ok(test, hair_context_create(&desc, &made));
    test->context = made;
}

void hair_test_restorable_lose(struct hair_test* test, struct hair_test_restorable* f)
{
    hair_egl_destroy(f->egl);
    hair_test_ok(test, hair_egl_create(&test->host.host, -1, &f->egl));
}

void hair_test_restorable_end(struct hair_test* test, struct hair_test_restorable* f)
{
    hair_context_destroy(test->context);
    hair_egl_destroy(f->egl);
    hair_egl_make_current(test->egl);
    test->context = f->own;
}

void hair_test_restore_against_refusals(struct hair_test* test, hair_instance* hair)
{
    hair_result result = HAIR_ERROR_MEMORY;
    uint32_t refused = 0;
    for (; result; ++refused) {
        uint32_t blocks = test->host.blocks;
        hair_instance was = *hair;
        hair_memory before = hair_memory_default(), after = hair_memory_default();
        hair_test_ok(test, hair_get_memory(hair->context, &before));
        test->host.refuse = test->host.allocations + 1 + refused;
        result = hair_context_restore(hair->context);
        test->host.refuse = 0;
        if (!result) break;
        hair_test_refused(test, result, HAIR_ERROR_MEMORY, "out of memory for");
        assert_int_equal(test->host.blocks, blocks);
        assert_memory_equal(hair, &was, sizeof was);
        hair_test_ok(test, hair_get_memory(hair->context, &after));
        assert_int_equal(after.bytes, before.bytes);
    }
    assert_true(refused > 20);
}
