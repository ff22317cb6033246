// light_interval_test.c - small hair keeps its light for some frames, and instances take turns.
#include "tests/support/scene.h"

#define SIDE 64
#define FRAMES 12
#define HEADS 4
#define DT (1.0f / 60)

static const hair_look* lit_look(void)
{
    static hair_look look;
    look = hair_look_default();
    look.strand.radius = 0.001f;
    look.self_shadow.method = HAIR_SELF_SHADOW_STRANDS;
    return &look;
}

static struct hair_test_scene start(void** state)
{
    struct hair_test_scene scene = hair_test_scene_of(*state, NULL, lit_look());
    hair_test_frame_make(&scene.frame, SIDE, SIDE, GL_RGBA32F, 0);
    hair_test_set_perspective(&scene.view, 4, 1);
    scene.view.view[14] = -4;
    scene.view.light_count = 1;
    return scene;
}

// Draw an instance. Return whether its light was computed.
static bool draws_with_new_light(struct hair_test* test, hair_instance* hair, const hair_view* view)
{
    uint32_t before = hair_test_report_row(test, hair, "self_shadow").runs;
    hair_test_ok(test, hair_draw(hair, view));
    return hair_test_report_row(test, hair, "self_shadow").runs > before;
}

static uint32_t count_lit_frames(struct hair_test_scene* scene, float light_pixels)
{
    hair_lod lod = hair_lod_default();
    uint32_t lit = 0;
    lod.light_pixels = light_pixels;
    scene->view.lod = &lod;
    for (uint32_t i = 0; i < FRAMES; ++i) {
        hair_test_ok(scene->test, hair_step(scene->hair, DT));
        lit += draws_with_new_light(scene->test, scene->hair, &scene->view);
    }
    scene->view.lod = NULL;
    return lit;
}

static void small_hair_gets_light_in_some_frames(void** state)
{
    struct hair_test_scene scene = start(state);
    assert_int_equal(count_lit_frames(&scene, 0), FRAMES);
    assert_int_equal(count_lit_frames(&scene, 1e4f), FRAMES / 4);
    uint32_t by_default = count_lit_frames(&scene, hair_lod_default().light_pixels);
    assert_true(by_default < FRAMES); // Hair is at most as large as the picture.
    hair_test_ok(scene.test, hair_step(scene.hair, DT));
    assert_true(draws_with_new_light(scene.test, scene.hair, &scene.view));
    hair_test_scene_free(&scene);
}

// Lights may move while an application pauses. Views of one frame_index have one light.
static void hair_that_is_not_stepped_gets_new_light(void** state)
{
    struct hair_test_scene scene = start(state);
    hair_lod lod = hair_lod_default();
    lod.light_pixels = 1e4f;
    scene.view.lod = &lod;
    hair_test_ok(scene.test, hair_step(scene.hair, DT));
    for (int i = 0; i < 3; ++i) assert_true(draws_with_new_light(scene.test, scene.hair, &scene.view));
    scene.view.frame_index = 7;
    assert_true(draws_with_new_light(scene.test, scene.hair, &scene.view));
    assert_false(draws_with_new_light(scene.test, scene.hair, &scene.view));
    scene.view.frame_index = 8;
    assert_true(draws_with_new_light(scene.test, scene.hair, &scene.view));
    hair_test_scene_free(&scene);
}

static void heads_take_turns(void** state)
{
    struct hair_test_scene scene = start(state);
    hair_instance* heads[HEADS];
    hair_desc desc = hair_desc_default();
    hair_lod lod = hair_lod_default();
    uint32_t all = 0, most = 0;
    desc.look = lit_look();
    lod.light_pixels = 1e4f;
    scene.view.lod = &lod;
    for (int i = 0; i < HEADS; ++i) {
        desc.transform[12] = 0.1f * (float)i;
        hair_test_ok(scene.test, hair_create(scene.test->context, scene.groom, &desc, &heads[i]));
    }
    for (uint32_t frame = 0; frame < FRAMES; ++frame) {
        uint32_t lit = 0;
        hair_test_ok(scene.test, hair_step_list(heads, HEADS, DT));
        for (int i = 0; i < HEADS; ++i) lit += draws_with_new_light(scene.test, heads[i], &scene.view);
        if (frame < 4) continue; // All need light in the first frame.
        all += lit;
        if (lit > most) most = lit;
    }
    assert_int_equal(all, HEADS * (FRAMES - 4) / 4);
    assert_true(most < HEADS);
    for (int i = 0; i < HEADS; ++i) hair_destroy(heads[i]);
    hair_test_scene_free(&scene);
}

int main(void)
{
    if (hair_test_skips()) return 0;
    const struct CMUnitTest tests[] = {
        HAIR_TEST(small_hair_gets_light_in_some_frames),
        HAIR_TEST(hair_that_is_not_stepped_gets_new_light),
        HAIR_TEST(heads_take_turns),
    };
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
