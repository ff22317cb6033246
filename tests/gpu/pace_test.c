// pace_test.c - small hair is stepped in some frames, by turns, and follows its head in the others.
#include "tests/support/scene.h"

#include <math.h>
#include <string.h>

#define SIDE 128
#define FRAMES 16
#define HEADS 4
#define DT (1.0f / 60)
#define ALL 1e4f // motion_pixels for which all hair is stepped in every fourth frame.

struct pace_scene {
    struct hair_test_scene base;
    hair_lod lod;
};

static void start(void** state, struct pace_scene* out)
{
    hair_look look = hair_look_default();
    look.strand.radius = 0.002f;
    out->base = hair_test_scene_of(*state, NULL, &look);
    hair_test_frame_make(&out->base.frame, SIDE, SIDE, GL_RGBA32F, 0);
    out->lod = hair_lod_default();
    out->lod.motion_pixels = ALL;
    out->base.view.render_path = HAIR_RENDER_PATH_COMPUTE;
    out->base.view.lod = &out->lod;
    out->base.view.light_count = 1;
    hair_test_set_perspective(&out->base.view, 2, 1);
    out->base.view.view[14] = -1;
}

static void step(const struct pace_scene* scene)
{
    hair_test_ok(scene->base.test, hair_step(scene->base.hair, DT));
}

static void draw(const struct pace_scene* scene, float* pixels)
{
    hair_test_draw_in(&scene->base.frame, scene->base.test, scene->base.hair, &scene->base.view, pixels);
}

static bool is_pending(const struct pace_scene* scene)
{
    return scene->base.hair->pace.pending > 0;
}

// Set the head in frame i, which moves and turns.
static void move_head(const struct pace_scene* scene, uint32_t i)
{
    float a = 0.02f * (float)i;
    const float at[16] = {
        cosf(a),           0, -sinf(a), 0, 0, 1, 0, 0, sinf(a), 0, cosf(a), 0, 0.003f * (float)i,
        0.001f * (float)i, 0, 1};
    hair_test_ok(scene->base.test, hair_set_transform(scene->base.hair, at));
}

// Step and draw frames in which the head moves. Return the number of frames with a step.
static uint32_t count_steps(const struct pace_scene* scene, uint32_t frames)
{
    static float pixels[4 * SIDE * SIDE];
    uint32_t steps = 0;
    for (uint32_t i = 0; i < frames; ++i) {
        move_head(scene, i);
        step(scene);
        draw(scene, pixels);
        steps += hair_test_report_row(scene->base.test, scene->base.hair, "solve").runs > 0;
    }
    return steps;
}

static void small_hair_is_stepped_in_some_frames(void** state)
{
    struct pace_scene scene;
    start(state, &scene);
    // The first frame has no view before it.
    assert_in_range(count_steps(&scene, FRAMES), FRAMES / 4, FRAMES / 4 + 1);
    assert_in_range(count_steps(&scene, FRAMES), FRAMES / 4, FRAMES / 4 + 1);
    scene.lod.motion_pixels = 0;
    count_steps(&scene, 1);
    assert_int_equal(count_steps(&scene, FRAMES), FRAMES);
    hair_test_scene_free(&scene.base);
}

// Step until a step waits, drawing all frames. `pixels` receives the frame before that step.
static void step_until_pending(const struct pace_scene* scene, float* pixels)
{
    for (uint32_t i = 0; i < 2 * FRAMES && !is_pending(scene); ++i) {
        draw(scene, pixels);
        step(scene);
    }
    assert_true(is_pending(scene));
}

// A camera that moves with the head must see the same picture, without a pass over vertices.
static void waiting_hair_follows_the_head(void** state)
{
    static float before[4 * SIDE * SIDE], after[4 * SIDE * SIDE];
    struct pace_scene scene;
    start(state, &scene);
    step_until_pending(&scene, before);
    const float a = 0.1f, move[3] = {0.02f, -0.01f, 0.03f};
    const float head[16] = {cosf(a), 0, -sinf(a), 0, 0,       1,       0,       0,
                            sinf(a), 0, cosf(a),  0, move[0], move[1], move[2], 1};
    const float back[16] = {cosf(a),
                            0,
                            sinf(a),
                            0,
                            0,
                            1,
                            0,
                            0,
                            -sinf(a),
                            0,
                            cosf(a),
                            0,
                            -move[0] * cosf(a) + move[2] * sinf(a),
                            -move[1],
                            -move[0] * sinf(a) - move[2] * cosf(a),
                            1};
    hair_test_ok(scene.base.test, hair_set_transform(scene.base.hair, head));
    step(&scene);
    assert_true(is_pending(&scene));
    const hair_view was = scene.base.view;
    hair_mat4_multiply(was.view, back, scene.base.view.view);
    draw(&scene, after);
    assert_true(is_pending(&scene));
    assert_int_equal(hair_test_report_row(scene.base.test, scene.base.hair, "compact_strands").runs, 0);
    double coverage = hair_test_mean_alpha(before, sizeof before / sizeof *before);
    print_message("    hair covers %.4f of the picture\n", coverage);
    assert_true(coverage > 0.01);
    // Rounding moves some edges across samples.
    uint32_t different = 0;
    for (size_t i = 0; i < SIDE * SIDE; ++i) different += fabsf(after[4 * i + 1] - before[4 * i + 1]) > 0.02f;
    print_message("    %u of %u pixels differ\n", different, SIDE * SIDE);
    assert_true(different < SIDE * SIDE / 200);
    hair_test_scene_free(&scene.base);
}

// Views and calls that need the hair of the frame step it.
static void hair_is_stepped_for_who_needs_it(void** state)
{
    static float pixels[4 * SIDE * SIDE];
    struct pace_scene scene;
    start(state, &scene);
    struct hair_test_scene* base = &scene.base;
    enum { DEPTH, ELSEWHERE, LOOK, LIGHT, WHOLE, READ, SAVE, TELEPORT, RESET, NEEDS };
    for (int need = 0; need < NEEDS; ++need) {
        const hair_view was = base->view;
        hair_look look = hair_look_default();
        hair_light light = hair_light_default();
        const float here[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
        float at[3 * 64];
        static unsigned char bytes[1 << 20];
        uint32_t count;
        size_t size;
        step_until_pending(&scene, pixels);
        if (need == DEPTH) base->view.pass = HAIR_PASS_DEPTH;
        if (need == ELSEWHERE) base->view.view[14] = -0.8f;
        if (need == WHOLE) base->view.lod = NULL;
        light.color[1] = 0.5f;
        if (need == LIGHT) base->view.lights = &light;
        look.strand.radius = 0.0015f;
        if (need == LOOK) hair_test_ok(base->test, hair_set_look(base->hair, &look));
        if (need < READ) draw(&scene, pixels);
        if (need == READ)
            hair_test_ok(base->test, hair_read_positions(base->hair, HAIR_READ_GUIDES, at, 64, &count));
        if (need == SAVE) hair_test_ok(base->test, hair_save(base->hair, bytes, sizeof bytes, &size));
        if (need == TELEPORT) hair_test_ok(base->test, hair_teleport(base->hair, here));
        if (need == RESET) hair_test_ok(base->test, hair_reset(base->hair));
        if (is_pending(&scene)) fail_msg("need %d leaves pending time", need);
        base->view = was;
        count_steps(&scene, 4);
    }
    hair_test_scene_free(base);
}

// No time is lost, in whatever frames steps run. Drawn hair is one substep behind, and substeps are
// longer.
static void time_passes_alike(void** state)
{
    struct pace_scene scene;
    start(state, &scene);
    static struct hair_test_points at[2], still[2];
    for (int k = 0; k < 2; ++k) {
        scene.lod.motion_pixels = k ? ALL : 0;
        const float here[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
        hair_test_ok(scene.base.test, hair_set_transform(scene.base.hair, here));
        hair_test_ok(scene.base.test, hair_reset(scene.base.hair));
        count_steps(&scene, 2 * FRAMES + 1);
        hair_test_read_points(scene.base.test, scene.base.hair, HAIR_READ_SMOOTH, &at[k]);
        for (uint32_t i = 0; i < 300; ++i) step(&scene);
        hair_test_read_points(scene.base.test, scene.base.hair, HAIR_READ_SMOOTH, &still[k]);
    }
    double moving = hair_test_points_distance(&at[0], &at[1]);
    double after = hair_test_points_distance(&still[0], &still[1]);
    print_message("    vertices at most %.2f mm apart, %.3f mm after five seconds\n", 1e3 * moving,
                  1e3 * after);
    assert_true(moving > 0 && moving < 0.008);
    assert_true(after < 0.0005);
    hair_test_scene_free(&scene.base);
}

// A step never advances by more than max_dt, and pinned hair is stepped in every frame.
static void some_hair_does_not_wait(void** state)
{
    struct pace_scene scene;
    start(state, &scene);
    count_steps(&scene, FRAMES);
    scene.base.hair->max_dt = 2.5 / 60;
    assert_int_equal(count_steps(&scene, 12), 6);
    scene.base.hair->max_dt = 0.1;
    hair_pin pin = hair_pin_default();
    hair_test_ok(scene.base.test, hair_set_pins(scene.base.hair, &pin, 1, sizeof pin));
    count_steps(&scene, 1);
    assert_int_equal(count_steps(&scene, 8), 8);
    hair_test_scene_free(&scene.base);
}

static void heads_take_turns(void** state)
{
    struct pace_scene scene;
    start(state, &scene);
    struct hair_test* test = scene.base.test;
    hair_instance* heads[HEADS];
    hair_desc desc = hair_desc_default();
    uint32_t all = 0, most = 0;
    for (int i = 0; i < HEADS; ++i) {
        desc.transform[12] = 0.01f * (float)i;
        hair_test_ok(test, hair_create(scene.base.context ? scene.base.context : test->context,
                                       scene.base.groom, &desc, &heads[i]));
    }
    for (uint32_t frame = 0; frame < 8 + FRAMES; ++frame) {
        uint32_t steps = 0;
        hair_test_ok(test, hair_step_list(heads, HEADS, DT));
        hair_test_ok(test, hair_draw_list(heads, HEADS, &scene.base.view));
        for (int i = 0; i < HEADS; ++i) steps += hair_test_report_row(test, heads[i], "solve").runs > 0;
        if (frame < 8) continue;
        all += steps;
        most = steps > most ? steps : most;
    }
    assert_int_equal(all, HEADS * FRAMES / 4);
    assert_true(most < HEADS);
    for (int i = 0; i < HEADS; ++i) hair_destroy(heads[i]);
    hair_test_scene_free(&scene.base);
}

int main(void)
{
    if (hair_test_skips()) return 0;
    const struct CMUnitTest tests[] = {
        HAIR_TEST(small_hair_is_stepped_in_some_frames),
        HAIR_TEST(waiting_hair_follows_the_head),
        HAIR_TEST(hair_is_stepped_for_who_needs_it),
        HAIR_TEST(time_passes_alike),
        HAIR_TEST(some_hair_does_not_wait),
        HAIR_TEST(heads_take_turns),
    };
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
