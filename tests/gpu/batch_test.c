// batch_test.c - small heads of a list, which are drawn together. Their pixels must be those of
// single draws.
#include "tests/support/scene.h"

#include <math.h>
#include <string.h>

#define SIDE 128
#define HEADS 4
#define FRAMES 9
#define DT (1.0f / 60)

// Heads before each other. Twins of them are stepped and drawn by single calls.
struct batch_scene {
    struct hair_test* test;
    struct hair_test_frame frame;
    hair_groom* groom;
    hair_instance *listed[HEADS], *single[HEADS];
    hair_lod lod;
    hair_view view;
};

static void place(uint32_t head, uint32_t frame, float transform[16])
{
    float a = 0.5f * (float)head + 0.02f * (float)frame, c = cosf(a), s = sinf(a);
    const float m[16] = {c,
                         0,
                         -s,
                         0,
                         0,
                         1,
                         0,
                         0,
                         s,
                         0,
                         c,
                         0,
                         0.03f * (float)head - 0.05f + 0.002f * (float)frame,
                         0.01f * (float)(head % 2),
                         -0.04f * (float)head,
                         1};
    memcpy(transform, m, sizeof m);
}

static hair_instance* make_head(const struct batch_scene* scene, uint32_t head)
{
    hair_look look = hair_look_default();
    hair_desc desc = hair_desc_default();
    hair_instance* hair = NULL;
    look.strand.radius = 0.002f;
    look.strand.segments = 8 + 4 * head;
    desc.look = &look;
    place(head, 0, desc.transform);
    hair_test_ok(scene->test, hair_create(scene->test->context, scene->groom, &desc, &hair));
    return hair;
}

static void start_with(void** state, GLsizei samples, const struct hair_test_handmade* groom,
                       struct batch_scene* out)
{
    *out = (struct batch_scene){.test = *state, .lod = hair_lod_default(), .view = hair_view_default()};
    out->groom = hair_test_groom(&out->test->host.host, *groom);
    for (uint32_t i = 0; i < HEADS; ++i) {
        out->listed[i] = make_head(out, i);
        out->single[i] = make_head(out, i);
    }
    hair_test_frame_make(&out->frame, SIDE, SIDE, GL_RGBA32F, samples);
    out->view.render_path = HAIR_RENDER_PATH_COMPUTE;
    out->view.light_count = 1;
    hair_test_set_perspective(&out->view, 2, 1);
    out->view.view[14] = -0.6f;
}

static void start(void** state, GLsizei samples, struct batch_scene* out)
{
    const struct hair_test_handmade groom = hair_test_handmade_default();
    start_with(state, samples, &groom, out);
}

static void finish(struct batch_scene* scene)
{
    for (uint32_t i = 0; i < HEADS; ++i) {
        hair_destroy(scene->listed[i]);
        hair_destroy(scene->single[i]);
    }
    assert_int_equal(scene->test->context->batch.places, 0);
    assert_int_equal(scene->test->context->batch.blocks, 0);
    hair_groom_destroy(scene->groom);
    hair_test_frame_free(&scene->frame);
}

static void step(const struct batch_scene* scene, uint32_t frame)
{
    float transform[16];
    for (uint32_t i = 0; i < HEADS; ++i) {
        place(i, frame, transform);
        hair_test_ok(scene->test, hair_set_transform(scene->listed[i], transform));
        hair_test_ok(scene->test, hair_set_transform(scene->single[i], transform));
        hair_test_ok(scene->test, hair_step(scene->single[i], DT));
    }
    hair_test_ok(scene->test, hair_step_list(scene->listed, HEADS, DT));
}

// Draw the list and the twins, whose pixels must be equal. Return the fraction that hair covers.
static double compare(struct batch_scene* scene)
{
    static float listed[4 * SIDE * SIDE], single[4 * SIDE * SIDE];
    scene->view.lod = &scene->lod;
    hair_test_frame_clear(&scene->frame);
    hair_test_ok(scene->test, hair_draw_list(scene->listed, HEADS, &scene->view));
    hair_test_frame_read(&scene->frame, listed);
    hair_test_frame_clear(&scene->frame);
    for (uint32_t i = 0; i < HEADS; ++i) hair_test_ok(scene->test, hair_draw(scene->single[i], &scene->view));
    hair_test_frame_read(&scene->frame, single);
    assert_memory_equal(listed, single, sizeof single);
    return hair_test_mean_alpha(listed, sizeof listed / sizeof *listed);
}

static uint32_t count_places(const struct batch_scene* scene)
{
    return scene->test->context->batch.places;
}

// Return the runs of a stage of a listed head.
static uint32_t count_runs(const struct batch_scene* scene, uint32_t head, const char* stage)
{
    return hair_test_report_row(scene->test, scene->listed[head], stage).runs;
}

static void check_pixels(void** state, GLsizei samples)
{
    struct batch_scene scene;
    start(state, samples, &scene);
    for (uint32_t frame = 1; frame < 3; ++frame) {
        step(&scene, frame);
        double covered = compare(&scene);
        print_message("    hair covers %.3f of the picture\n", covered);
        assert_true(covered > 0.05);
        assert_int_equal(count_places(&scene), HEADS);
    }
    for (uint32_t i = 0; i < HEADS; ++i) assert_true(count_runs(&scene, i, "color") > 0);
    finish(&scene);
}

static void batches_have_the_pixels_of_single_draws(void** state)
{
    check_pixels(state, 0);
}

static void batches_have_the_samples_of_single_draws(void** state)
{
    check_pixels(state, 4);
}

// Heads whose samples do not fit into one buffer are drawn in parts.
static void parts_of_batches_have_the_same_pixels(void** state)
{
    struct batch_scene scene;
    start(state, 0, &scene);
    step(&scene, 1);
    scene.test->context->batch.samples.max = 1;
    assert_true(compare(&scene) > 0.05);
    scene.test->context->batch.samples.max = 2 * SIDE * SIDE;
    assert_true(compare(&scene) > 0.05);
    assert_int_equal(count_places(&scene), HEADS);
    finish(&scene);
}

// Heads that no batch may draw, because the application tests stencil, use the same samples: all at
// once, a few at once, and one after the other.
static void heads_use_the_same_samples_in_turns(void** state)
{
    static const size_t max[] = {1, 4 * SIDE * SIDE, 100 * SIDE * SIDE};
    size_t room[3];
    for (int i = 0; i < 3; ++i) {
        struct batch_scene scene;
        start(state, 0, &scene);
        struct hair_gl* gl = &scene.test->context->gl;
        struct hair_samples* samples = &scene.test->context->batch.samples;
        const bool records = gl->records;
        const size_t usual = samples->max;
        gl->records = true; // llvmpipe does not profit, but must give the same bits.
        samples->max = max[i];
        step(&scene, 1);
        glEnable(GL_STENCIL_TEST);
        assert_true(compare(&scene) > 0.05);
        glDisable(GL_STENCIL_TEST);
        assert_int_equal(count_places(&scene), 0);
        room[i] = samples->room;
        gl->records = records;
        samples->max = usual;
        finish(&scene);
        assert_int_equal(samples->nearest, 0);
    }
    print_message("    %zu, %zu and %zu numbers\n", room[0], room[1], room[2]);
    assert_true(room[0] <= 3 * SIDE * SIDE + 64 && room[2] > 2 * room[0]);
    assert_true(room[0] < room[1] && room[1] < room[2]);
}

// Far heads have their places from the first frame on, and no buffers of their own.
static void far_heads_need_no_buffers_of_their_own(void** state)
{
    struct batch_scene scene;
    struct hair_test_handmade many = hair_test_handmade_default();
    many.followers = 20000;
    many.each = 250;
    start_with(state, 0, &many, &scene);
    scene.view.view[14] = -80;
    compare(&scene);
    for (uint32_t i = 0; i < HEADS; ++i) {
        assert_int_equal(scene.listed[i]->renderer.view_cache.room, 0);
        assert_int_equal(scene.listed[i]->renderer.raster.params, 0);
    }
    finish(&scene);
}

// Heads of different sizes come and go, and need larger places.
static void places_follow_the_size_of_heads(void** state)
{
    struct batch_scene scene;
    start(state, 0, &scene);
    scene.view.view[14] = -8;
    step(&scene, 1);
    compare(&scene);
    uint32_t blocks = scene.listed[0]->renderer.view_cache.place.blocks;
    assert_true(blocks > 0);
    hair_look look = hair_look_default();
    look.strand.radius = 0.002f;
    look.strand.segments = 256;
    hair_test_ok(scene.test, hair_set_look(scene.listed[0], &look));
    hair_test_ok(scene.test, hair_set_look(scene.single[0], &look));
    scene.view.view[14] = -0.6f;
    assert_true(compare(&scene) > 0.05);
    assert_true(scene.listed[0]->renderer.view_cache.place.blocks > blocks);
    hair_destroy(scene.listed[1]);
    assert_int_equal(count_places(&scene), HEADS - 1);
    scene.listed[1] = make_head(&scene, 1);
    hair_destroy(scene.single[1]);
    scene.single[1] = make_head(&scene, 1);
    compare(&scene);
    assert_int_equal(count_places(&scene), HEADS);
    finish(&scene);
}

// Vertices of waiting heads stay in their places.
static void waiting_heads_keep_their_places(void** state)
{
    struct batch_scene scene;
    uint32_t kept = 0;
    start(state, 0, &scene);
    scene.lod.motion_pixels = 1e4f;
    scene.view.view[14] = -1.2f; // All hair is in view.
    for (uint32_t frame = 1; frame < FRAMES; ++frame) {
        step(&scene, frame);
        assert_true(compare(&scene) > 0.01);
        for (uint32_t i = 0; i < HEADS && frame > 2; ++i) kept += !count_runs(&scene, i, "compact_strands");
    }
    print_message("    vertices were kept %u times\n", kept);
    assert_true(kept > HEADS * (FRAMES - 3) / 2);
    assert_int_equal(count_places(&scene), HEADS);
    // A head that is drawn by itself cannot draw from its place, and is stepped.
    uint32_t pending = 0;
    step(&scene, FRAMES);
    for (uint32_t i = 0; i < HEADS; ++i) {
        pending += scene.listed[i]->pace.pending > 0;
        hair_test_ok(scene.test, hair_draw(scene.listed[i], &scene.view));
        assert_true(scene.listed[i]->pace.pending == 0);
    }
    assert_true(pending > 0);
    finish(&scene);
}

// Each head is drawn by itself if their order matters.
static void ordered_heads_are_drawn_one_by_one(void** state)
{
    struct batch_scene scene;
    start(state, 0, &scene);
    step(&scene, 1);
    const GLenum states[] = {GL_BLEND, GL_STENCIL_TEST, GL_COLOR_LOGIC_OP};
    for (int i = 0; i < 3; ++i) {
        glEnable(states[i]);
        compare(&scene);
        glDisable(states[i]);
    }
    glDepthFunc(GL_ALWAYS);
    compare(&scene);
    glDepthFunc(GL_LESS);
    glDepthMask(GL_FALSE);
    compare(&scene);
    glDepthMask(GL_TRUE);
    glDisable(GL_DEPTH_TEST);
    compare(&scene);
    glEnable(GL_DEPTH_TEST);
    assert_int_equal(count_places(&scene), 0);
    compare(&scene);
    assert_int_equal(count_places(&scene), HEADS);
    finish(&scene);
}

int main(void)
{
    if (hair_test_skips()) return 0;
    const struct CMUnitTest tests[] = {
        HAIR_TEST(batches_have_the_pixels_of_single_draws),
        HAIR_TEST(batches_have_the_samples_of_single_draws),
        HAIR_TEST(parts_of_batches_have_the_same_pixels),
        HAIR_TEST(heads_use_the_same_samples_in_turns),
        HAIR_TEST(far_heads_need_no_buffers_of_their_own),
        HAIR_TEST(places_follow_the_size_of_heads),
        HAIR_TEST(waiting_heads_keep_their_places),
        HAIR_TEST(ordered_heads_are_drawn_one_by_one),
    };
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
