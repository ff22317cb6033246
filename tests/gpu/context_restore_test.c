// context_restore_test.c - everything comes back in another OpenGL context after the first is lost
// or destroyed.
#include "tests/support/context_loss.h"

#include <math.h>
#include <string.h>

#include "lib/asset/strands.h"
#include "tests/support/cut_scene.h"
#include "tests/support/tessellated.h"
#include "tests/support/trace.h"

#define PICTURE_SIDE 64
#define PICTURE_FRAMES 6

static void restored_hair_is_at_most_two_steps_old(void** state)
{
    static struct hair_test_loss_run run;
    struct hair_test_loss f;
    hair_test_loss_record(*state, 0, &run);
    hair_test_loss_start(&f, *state, 0);
    for (int i = 1; i <= HAIR_TEST_LOSS_FRAMES; ++i) {
        hair_test_ok(*state, hair_test_loss_frame(&f, i));
        glFinish();
    }
    hair_test_loss_replace_egl(&f);
    assert_true(hair_test_loss_check(&f, &run) >= HAIR_TEST_LOSS_FRAMES - 2);
    hair_test_loss_finish(&f);
}

static void destroyed_opengl_context_can_be_replaced(void** state)
{
    static struct hair_test_loss_run run;
    struct hair_test_loss f;
    hair_test_loss_record(*state, 0, &run);
    hair_test_loss_start(&f, *state, 0);
    hair_test_ok(f.test, hair_test_loss_frame(&f, 1));
    glFinish();
    hair_test_ok(f.test, hair_test_loss_frame(&f, 2));
    hair_egl_destroy(f.egl);
    f.egl = NULL;
    hair_test_refused(f.test, hair_step(f.hair, 1.0f / 60), HAIR_ERROR_OPENGL,
                      "no OpenGL context is current");
    hair_test_refused(f.test, hair_context_restore(f.context), HAIR_ERROR_OPENGL,
                      "no OpenGL context is current");
    hair_test_loss_replace_egl(&f);
    hair_test_loss_check(&f, &run);
    hair_test_loss_finish(&f);
}

static void second_loss_restores_the_same_state(void** state)
{
    static struct hair_test_loss_run run;
    struct hair_test_loss f;
    hair_test_loss_record(*state, 0, &run);
    hair_test_loss_start(&f, *state, 0);
    hair_test_ok(f.test, hair_test_loss_run(&f));
    hair_test_loss_replace_egl(&f);
    hair_test_ok(f.test, hair_context_restore(f.context));
    hair_test_loss_replace_egl(&f);
    assert_true(hair_test_loss_check(&f, &run) > 0);
    hair_test_loss_finish(&f);
}

static void hair_without_a_snapshot_is_at_rest(void** state)
{
    static struct hair_test_loss_run run;
    struct hair_test_loss f;
    hair_test_loss_record(*state, 0, &run);
    hair_test_loss_start(&f, *state, 0);
    hair_test_loss_replace_egl(&f);
    assert_int_equal(hair_test_loss_check(&f, &run), 0);
    hair_test_loss_finish(&f);
}

static void failed_restoration_changes_nothing(void** state)
{
    static struct hair_test_loss_run run;
    struct hair_test_loss f;
    hair_test_loss_record(*state, 0, &run);
    hair_test_loss_start(&f, *state, 0);
    hair_test_ok(f.test, hair_test_loss_run(&f));
    hair_test_loss_replace_egl(&f);
    hair_test_restore_against_refusals(f.test, f.hair);
    assert_true(hair_test_loss_check(&f, &run) > 0);
    hair_test_loss_finish(&f);
}

static void settings_made_after_a_loss_are_kept(void** state)
{
    struct hair_test* test = *state;
    struct hair_test_loss f;
    hair_physics physics = hair_physics_default(), got = hair_physics_default();
    hair_look look = hair_look_default(), got_look = hair_look_default();
    hair_test_loss_start(&f, test, 0);
    hair_group_look group = hair_group_look_default(), got_group = group;
    group.radius = 2, group.color.enabled = true;
    hair_test_ok(test, hair_set_group_look(f.hair, 1, &group));
    hair_test_ok(test, hair_record_contacts(f.hair, 2));
    hair_test_ok(test, hair_set_budget(f.context, 20));
    for (int i = 0; i < 3; ++i) hair_test_ok(test, hair_test_loss_frame(&f, 1));
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
    hair_test_loss_replace_egl(&f);
    hair_test_ok(test, hair_context_restore(f.context));
    assert_true(f.hair->sim.impulses.strands == 2);
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
    uint32_t number = f.context->budget.timer.number; // Times before the loss are not read.
    for (int i = 0; i < 5; ++i) hair_test_ok(test, hair_test_loss_frame(&f, 1));
    assert_true(f.context->budget.ms == 20 && f.context->budget.timer.number > number);
    assert_true(f.context->budget.timer.read >= number);
    assert_int_equal(glGetError(), GL_NO_ERROR); // Queries of the lost context mean nothing here.
    hair_test_loss_finish(&f);
}

static void restoration_needs_a_restorable_context(void** state)
{
    struct hair_test* test = *state;
    struct hair_test_loss f = {.test = test, .blocks = hair_test_blocks(test)};
    assert_int_equal(hair_context_restore(NULL), HAIR_ERROR_ARGUMENT);
    f.groom = hair_test_groom(&test->host.host, hair_test_handmade_default());
    hair_test_frame_make(&f.frame, HAIR_TEST_LOSS_SIDE, HAIR_TEST_LOSS_SIDE, GL_RGBA32F, 0);
    hair_test_ok(test, hair_test_loss_create(&f, 0, false));
    f.context->gl.records = false; // Lists make fences of their own.
    hair_test_trace_clear();
    hair_test_ok(test, hair_test_loss_run(&f));
    // The copies cost nothing unless they are wanted.
    assert_int_equal(hair_test_trace_count("glFenceSync"), 0);
    hair_test_refused(test, hair_context_restore(f.context), HAIR_ERROR_ARGUMENT, "restorable was false");
    hair_context_abandon(f.context);
    hair_test_refused(test, hair_context_restore(f.context), HAIR_ERROR_ARGUMENT, "abandoned");
    hair_test_frame_free(&f.frame);
    hair_test_loss_finish(&f);
}

static void groom_may_be_destroyed_before_a_restoration(void** state)
{
    struct hair_test_loss f;
    hair_test_loss_start(&f, *state, 0);
    hair_groom_destroy(f.groom);
    f.groom = NULL;
    hair_test_loss_replace_egl(&f);
    hair_test_ok(f.test, hair_context_restore(f.context));
    hair_test_ok(f.test, hair_test_loss_frame(&f, 1));
    hair_test_loss_finish(&f);
}

// Values of each strand for all kinds of attributes, between a half and the whole of 1.
static void fill_attributes(hair_strand_attribute* attributes,
                            float values[HAIR_ATTRIBUTE_KINDS][HAIR_TEST_CUT_GUIDES])
{
    for (uint32_t k = 0; k < HAIR_ATTRIBUTE_KINDS; ++k) {
        for (uint32_t i = 0; i < HAIR_TEST_CUT_GUIDES; ++i) {
            uint32_t random = hair_hash(100 * k + i);
            values[k][i] = 0.5f + 0.5f * hair_random(&random);
        }
        attributes[k] = hair_strand_attribute_default();
        attributes[k].kind = (hair_strand_attribute_kind)k;
        attributes[k].strand_values = values[k];
    }
}

// Shake the head in a frame, and draw.
static void draw_frame(const struct hair_test_scene* scene, int frame, float* pixels)
{
    float transform[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0.02f * sinf((float)frame), 0, 0, 1};
    hair_view view = hair_test_tessellated();
    hair_test_set_orthographic(&view, 5, 3, -7.6f);
    if (frame) {
        hair_test_ok(scene->test, hair_set_transform(scene->hair, transform));
        hair_test_ok(scene->test, hair_step(scene->hair, 1.0f / 60));
    }
    hair_test_draw(scene, &view, PICTURE_SIDE, PICTURE_SIDE, 0, pixels, NULL);
    glFinish();
}

// Restored hair of all attributes looks as after one of its last steps, and moves on as before.
static void restored_hair_has_its_attributes(void** state)
{
    static float pixels[PICTURE_FRAMES + 1][4 * PICTURE_SIDE * PICTURE_SIDE], now[sizeof *pixels / 4];
    hair_strand_attribute attributes[HAIR_ATTRIBUTE_KINDS];
    float values[HAIR_ATTRIBUTE_KINDS][HAIR_TEST_CUT_GUIDES];
    struct hair_test* test = *state;
    struct hair_test_restorable restorable;
    hair_groom_desc desc = hair_groom_desc_default();
    hair_look look = hair_look_default();
    fill_attributes(attributes, values);
    look.curl.radius = 0.004f, look.strays.frizz = hair_curve_line(0, 0.002f);
    desc.strand_attributes = attributes, desc.strand_attribute_count = HAIR_ATTRIBUTE_KINDS;
    hair_test_restorable_begin(test, &restorable);
    struct hair_test_scene scene =
        hair_test_cut_scene_with(test, HAIR_STRAND_SET_GUIDES, NULL, &look, NULL, &desc);
    for (int i = 1; i <= PICTURE_FRAMES; ++i) draw_frame(&scene, i, pixels[i]);
    hair_test_restorable_lose(test, &restorable);
    hair_test_ok(test, hair_context_restore(test->context));
    draw_frame(&scene, 0, now);
    int frame = PICTURE_FRAMES;
    while (frame && memcmp(pixels[frame], now, sizeof now) != 0) --frame;
    print_message("    hair is restored as after step %d of %d\n", frame, PICTURE_FRAMES);
    assert_true(frame >= PICTURE_FRAMES - 2);
    for (int i = frame + 1; i <= PICTURE_FRAMES; ++i) draw_frame(&scene, i, now);
    assert_memory_equal(now, pixels[PICTURE_FRAMES], sizeof now);
    assert_true(memcmp(pixels[frame - 1], pixels[frame], sizeof now) != 0);
    hair_test_scene_free(&scene);
    hair_test_restorable_end(test, &restorable);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        HAIR_TEST(restored_hair_is_at_most_two_steps_old),
        HAIR_TEST(destroyed_opengl_context_can_be_replaced),
        HAIR_TEST(second_loss_restores_the_same_state),
        HAIR_TEST(hair_without_a_snapshot_is_at_rest),
        HAIR_TEST(failed_restoration_changes_nothing),
        HAIR_TEST(settings_made_after_a_loss_are_kept),
        HAIR_TEST(restoration_needs_a_restorable_context),
        HAIR_TEST(groom_may_be_destroyed_before_a_restoration),
        HAIR_TEST(restored_hair_has_its_attributes),
    };
    return hair_test_skips() ? 0 : cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
