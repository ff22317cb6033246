// raster_test.c - pixels that compute makes of segments are those that OpenGL draws, with any state
// of the application.
#include "tests/support/render_paths.h"
#include "tests/support/scene.h"

#include <stdlib.h>
#include <string.h>

#include "tests/support/haircut.h"
#include "tests/support/tessellated.h"

enum { WIDTH = 203, HEIGHT = 157, PIXELS = WIDTH * HEIGHT, LONG_UNUSED = 242 };

// Make wavy hair of that radius, in metres.
static struct hair_test_scene start(void** state, uint32_t followers, float radius)
{
    struct hair_test_scene f = hair_test_scene_make(*state, NULL);
    f.hair = hair_test_wear(f.test, HAIR_STYLE_CURLY, followers, radius, &f.groom);
    hair_test_ok(f.test, hair_step(f.hair, 1.0f / 60));
    return f;
}

// Make a view from the front, at distance `away` from the middle of the head, in metres.
static hair_view front(hair_render_path path, float away)
{
    hair_view view = hair_test_tessellated();
    view.render_path = path;
    view.view[13] = -1.6f, view.view[14] = -away;
    hair_test_set_perspective(&view, 3, 1.25f);
    return view;
}

static hair_render_path path_of(const struct hair_test_scene* f, const hair_view* view)
{
    return hair_test_path_of(&f->hair->renderer, view);
}

// Settings that an application may have made. put_back() restores them.
static void set_nothing(hair_view* view)
{
    (void)view;
}

static void set_reversed(hair_view* view)
{
    view->projection[10] = 0, view->projection[14] = 0.01f;
    glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    glDepthFunc(GL_GREATER);
    glClearDepth(0);
    glClear(GL_DEPTH_BUFFER_BIT);
}

static void set_upside_down(hair_view* view)
{
    (void)view;
    glClipControl(GL_UPPER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
    glDepthRange(0.3, 0.6);
}

static void set_range_reversed(hair_view* view)
{
    (void)view;
    glDepthRange(1, 0.25);
    glDepthFunc(GL_GEQUAL);
    glClearDepth(0);
    glClear(GL_DEPTH_BUFFER_BIT);
}

static void set_part(hair_view* view)
{
    (void)view;
    glViewport(31, -20, 140, 150);
    glEnable(GL_SCISSOR_TEST);
    glScissor(50, 20, 90, 80);
}

static void set_wall(hair_view* view)
{
    (void)view;
    glEnable(GL_SCISSOR_TEST);
    glScissor(0, 0, WIDTH, HEIGHT / 2);
    glClearDepth(0.5);
    glClear(GL_DEPTH_BUFFER_BIT);
    glDisable(GL_SCISSOR_TEST);
}

static void set_orthographic(hair_view* view)
{
    memset(view->projection, 0, sizeof view->projection);
    view->projection[0] = 2.5f, view->projection[5] = 3, view->projection[10] = -1, view->projection[15] = 1;
    view->jitter[0] = 0.3f, view->jitter[1] = -0.2f;
}

static void set_culled(hair_view* view)
{
    (void)view;
    glEnable(GL_CULL_FACE);
    glCullFace(GL_FRONT);
}

static void put_back(void)
{
    glClipControl(GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
    glDepthFunc(GL_LESS);
    glDepthRange(0, 1);
    glClearDepth(1);
    glDisable(GL_SCISSOR_TEST);
    glDisable(GL_CULL_FACE);
    glCullFace(GL_BACK);
}

struct picture {
    float pixels[4 * PIXELS], depth[PIXELS];
};

static void draw_lod(struct hair_test_scene* f, hair_render_path path, hair_pass pass, float away,
                     void (*set)(hair_view*), const hair_lod* lod, struct picture* out)
{
    struct hair_test_frame frame;
    hair_view view = front(path, away);
    view.pass = pass;
    view.lod = lod;
    hair_test_frame_make(&frame, WIDTH, HEIGHT, GL_RGBA32F, 0);
    set(&view);
    hair_test_ok(f->test, hair_draw(f->hair, &view));
    put_back();
    hair_test_frame_read(&frame, out->pixels);
    hair_test_frame_read_depth(&frame, out->depth);
    hair_test_frame_free(&frame);
}

static void draw(struct hair_test_scene* f, hair_render_path path, hair_pass pass, float away,
                 void (*set)(hair_view*), struct picture* out)
{
    draw_lod(f, path, pass, away, set, NULL, out);
}

// Numbers of pixels: covered in both pictures, covered in only one, and covered in both with
// different contents.
struct difference {
    uint32_t covered, alone, apart;
};

static struct difference compare(const struct picture* a, const struct picture* b)
{
    struct difference d = {0};
    for (int i = 0; i < PIXELS; ++i) {
        int by_a = a->pixels[4 * i + 3] > 0, by_b = b->pixels[4 * i + 3] > 0;
        float max = 0;
        d.covered += (uint32_t)(by_a && by_b);
        d.alone += (uint32_t)(by_a != by_b);
        for (int k = 0; k < 3; ++k) max = fmaxf(max, fabsf(a->pixels[4 * i + k] - b->pixels[4 * i + k]));
        d.apart += by_a && by_b && (max > 0.005f || fabsf(a->depth[i] - b->depth[i]) > 1e-4f);
    }
    return d;
}

// Compare compute with drawing. Drawing rounds vertices to fractions of a pixel, so that edges may
// be on either side of a pixel's middle.
static void compute_pixels_equal_drawn_pixels_under_any_state(void** state)
{
    static const struct {
        const char* name;
        void (*set)(hair_view*);
        float away, radius;
    } hosts[] = {
        {"as usual", set_nothing, 0.8f, 3e-4f},          {"depth reversed", set_reversed, 0.8f, 3e-4f},
        {"upside down", set_upside_down, 0.8f, 3e-4f},   {"range reversed", set_range_reversed, 0.8f, 3e-4f},
        {"a part of it", set_part, 0.8f, 3e-4f},         {"behind a wall", set_wall, 0.8f, 3e-4f},
        {"orthographic", set_orthographic, 0.8f, 3e-4f}, {"culled", set_culled, 0.8f, 3e-4f},
        {"from among it", set_nothing, 0.12f, 3e-4f},    {"thick and close", set_nothing, 0.2f, 6e-3f}};
    static struct picture drawn, made;
    for (size_t i = 0; i < sizeof hosts / sizeof *hosts; ++i) {
        struct hair_test_scene f = start(state, 400, hosts[i].radius);
        draw(&f, HAIR_RENDER_PATH_CACHED, HAIR_PASS_COLOR, hosts[i].away, hosts[i].set, &drawn);
        draw(&f, HAIR_RENDER_PATH_COMPUTE, HAIR_PASS_COLOR, hosts[i].away, hosts[i].set, &made);
        struct difference d = compare(&drawn, &made);
        print_message("    %s: %u pixels, %u of one alone, %u not alike\n", hosts[i].name, d.covered, d.alone,
                      d.apart);
        assert_true(d.covered > 500);
        assert_true(d.alone <= d.covered / 50 && d.apart <= d.covered / 50);
        hair_test_scene_free(&f);
    }
}

static void compute_depth_equals_drawn_depth(void** state)
{
    static struct picture drawn, made;
    struct hair_test_scene f = start(state, 400, 3e-4f);
    uint32_t there = 0, apart = 0;
    draw(&f, HAIR_RENDER_PATH_CACHED, HAIR_PASS_DEPTH, 0.8f, set_nothing, &drawn);
    draw(&f, HAIR_RENDER_PATH_COMPUTE, HAIR_PASS_DEPTH, 0.8f, set_nothing, &made);
    for (int i = 0; i < PIXELS; ++i) {
        there += drawn.depth[i] < 1;
        apart += fabsf(drawn.depth[i] - made.depth[i]) > 2e-5f;
    }
    print_message("    %u pixels, %u are farther apart\n", there, apart);
    assert_true(there > 1000 && apart <= there / 50);
    assert_int_equal(f.hair->geometry.vertex_cache.shaded, 0);
    hair_test_scene_free(&f);
}

static void compute_levels_of_detail_equal_drawn_ones(void** state)
{
    static struct picture drawn, made;
    struct hair_test_scene f = start(state, 600, 3e-4f);
    for (int i = 0; i < 4; ++i) {
        hair_lod lod = hair_lod_default();
        float away = i == 3 ? 3 : 0.8f;
        lod.per_patch = i >= 2;
        if (i == 0) lod.strand_fraction = 0.37f;
        if (i == 1) lod.segment_fraction = 0.4f;
        if (i >= 2) lod.strand_pixels = 2, lod.segment_pixels = 6;
        draw_lod(&f, HAIR_RENDER_PATH_PROCEDURAL, HAIR_PASS_COLOR, away, set_nothing, &lod, &drawn);
        draw_lod(&f, HAIR_RENDER_PATH_COMPUTE, HAIR_PASS_COLOR, away, set_nothing, &lod, &made);
        struct difference d = compare(&drawn, &made);
        print_message("    %d: %u pixels, %u of one alone, %u not alike\n", i, d.covered, d.alone, d.apart);
        assert_true(d.covered > 100);
        assert_true(d.alone <= 2 + d.covered / 40 && d.apart <= 2 + d.covered / 40);
        draw_lod(&f, HAIR_RENDER_PATH_COMPUTE, HAIR_PASS_DEPTH, away, set_nothing, &lod, &drawn);
        uint32_t apart = 0;
        for (int k = 0; k < PIXELS; ++k) apart += drawn.depth[k] != made.depth[k];
        assert_int_equal(apart, 0);
    }
    assert_int_equal(f.hair->geometry.vertex_cache.vertices, 0);
    hair_test_scene_free(&f);
}

// Check that the order of threads does not matter.
static void compute_pixels_of_equal_hair_are_equal_bits(void** state)
{
    static struct picture first, second;
    struct hair_test_scene f = start(state, 1500, 3e-4f);
    draw(&f, HAIR_RENDER_PATH_COMPUTE, HAIR_PASS_COLOR, 0.8f, set_nothing, &first);
    for (int i = 0; i < 5; ++i) {
        draw(&f, HAIR_RENDER_PATH_COMPUTE, HAIR_PASS_COLOR, 0.8f, set_nothing, &second);
        assert_memory_equal(&first, &second, sizeof first);
    }
    hair_test_scene_free(&f);
}

// Check multisampling. Each sample sees what a pixel in its place would, also in front of geometry
// that the application has drawn into some samples.
static void compute_coverage_equals_drawn_coverage(void** state)
{
    static float pixels[2][4 * PIXELS];
    struct hair_test_scene f = start(state, 400, 3e-4f);
    for (int made = 0; made < 2; ++made) {
        hair_view view = front(made ? HAIR_RENDER_PATH_COMPUTE : HAIR_RENDER_PATH_CACHED, 0.8f);
        hair_test_draw(&f, &view, WIDTH, HEIGHT, 4, pixels[made], NULL);
    }
    uint32_t some = 0, apart = 0;
    double sum[2] = {0}, color[2] = {0};
    for (int i = 0; i < PIXELS; ++i) {
        some += pixels[0][4 * i + 3] > 0 && pixels[0][4 * i + 3] < 1;
        apart += fabsf(pixels[0][4 * i + 3] - pixels[1][4 * i + 3]) > 0.01f;
        for (int made = 0; made < 2; ++made) {
            sum[made] += (double)pixels[made][4 * i + 3];
            for (int k = 0; k < 3; ++k) color[made] += (double)pixels[made][4 * i + k];
        }
    }
    print_message(
        "    %u pixels are covered in part, %u not alike; in all %.1f and %.1f, of colour %.2f and %.2f\n",
        some, apart, sum[0], sum[1], color[0], color[1]);
    assert_true(some > 1000 && apart <= some / 20);
    assert_true(fabs(sum[1] / sum[0] - 1) < 0.002 && fabs(color[1] / color[0] - 1) < 0.01);
    hair_test_scene_free(&f);
}

static void passes_without_compute_rasterization_are_drawn(void** state)
{
    struct hair_test_scene f = start(state, 50, 3e-4f);
    hair_lod lod = hair_lod_default();
    hair_view view = front(HAIR_RENDER_PATH_COMPUTE, 0.8f);
    assert_int_equal(path_of(&f, &view), HAIR_RENDER_PATH_COMPUTE);
    view.lod = &lod;
    view.primitive = HAIR_PRIMITIVE_LINES;
    assert_int_equal(path_of(&f, &view), HAIR_RENDER_PATH_CACHED);
    view.pass = HAIR_PASS_ID; // This pass needs more than levels of detail write for a vertex.
    assert_int_equal(path_of(&f, &view), HAIR_RENDER_PATH_PROCEDURAL);
    view.pass = HAIR_PASS_COLOR;
    view.lod = NULL;
    assert_int_equal(path_of(&f, &view), HAIR_RENDER_PATH_CACHED);
    view.primitive = HAIR_PRIMITIVE_RIBBONS;
    view.coverage = HAIR_COVERAGE_ALPHA;
    assert_int_equal(path_of(&f, &view), HAIR_RENDER_PATH_CACHED);
    view.coverage = HAIR_COVERAGE_MSAA;
    for (hair_pass pass = HAIR_PASS_COLOR; pass <= HAIR_PASS_OPACITY; ++pass) {
        view.pass = pass;
        int is = pass == HAIR_PASS_COLOR || pass == HAIR_PASS_DEPTH;
        assert_int_equal(path_of(&f, &view), is ? HAIR_RENDER_PATH_COMPUTE : HAIR_RENDER_PATH_CACHED);
    }
    hair_test_scene_free(&f);
}

// Check shading by the application. Its shader runs where the pixels are drawn.
static void compute_path_draws_pixels_of_user_shaders(void** state)
{
    struct hair_test_scene f = start(state, 50, 3e-4f);
    hair_view view = front(HAIR_RENDER_PATH_COMPUTE, 0.8f);
    hair_shader_desc desc = hair_shader_desc_default();
    struct hair_test_frame frame;
    desc.glsl = "vec4 hair_shade(hair_fragment f) { return vec4(f.t, 0.5, 0.0, 1.0); }";
    for (int pixels = 0; pixels < 2; ++pixels) {
        desc.at = pixels ? HAIR_SHADE_PIXELS : HAIR_SHADE_VERTICES;
        hair_test_ok(f.test, hair_shader_create(f.test->context, &desc, &view.shader));
        hair_test_frame_make(&frame, WIDTH, HEIGHT, GL_RGBA32F, 0);
        hair_draw_free_raster(&f.hair->renderer);
        hair_test_ok(f.test, hair_draw(f.hair, &view));
        assert_int_equal(f.test->context->batch.samples.nearest != 0, !pixels);
        static float shown[4 * PIXELS];
        hair_test_frame_read(&frame, shown);
        uint32_t own = 0;
        for (int i = 0; i < PIXELS; ++i) own += fabsf(shown[4 * i + 1] - 0.5f) < 0.001f;
        assert_true(own > 100);
        hair_test_frame_free(&frame);
        hair_shader_destroy(view.shader);
    }
    hair_test_scene_free(&f);
}

static void compute_memory_fits_the_pixels_and_is_freed_unused(void** state)
{
    struct hair_test_scene f = start(state, 50, 3e-4f);
    struct hair_samples* own = &f.test->context->batch.samples;
    struct hair_test_frame frame;
    hair_view view = front(HAIR_RENDER_PATH_CACHED, 0.8f);
    hair_test_frame_make(&frame, WIDTH, HEIGHT, GL_RGBA32F, 0);
    hair_test_ok(f.test, hair_draw(f.hair, &view));
    assert_int_equal(own->nearest, 0);
    view.render_path = HAIR_RENDER_PATH_COMPUTE;
    view.view[14] = -40; // The hair is a few pixels there.
    hair_test_ok(f.test, hair_draw(f.hair, &view));
    print_message("    %zu numbers of %d pixels\n", own->room, PIXELS);
    assert_in_range(own->room, 1, PIXELS / 10);
    view.view[14] = -0.8f;
    hair_test_ok(f.test, hair_draw(f.hair, &view));
    assert_in_range(own->room, 1000, 3 * PIXELS + 4);
    view.render_path = HAIR_RENDER_PATH_CACHED;
    for (int i = 0; i < LONG_UNUSED; ++i) {
        hair_test_ok(f.test, hair_step(f.hair, 1.0f / 60));
        hair_test_ok(f.test, hair_draw(f.hair, &view));
    }
    assert_int_equal(own->nearest + f.hair->renderer.raster.tile + f.hair->renderer.raster.params, 0);
    hair_test_frame_free(&frame);
    hair_test_scene_free(&f);
}

int main(void)
{
    if (hair_test_skips()) return 0;
    const struct CMUnitTest tests[] = {
        HAIR_TEST(compute_pixels_equal_drawn_pixels_under_any_state),
        HAIR_TEST(compute_depth_equals_drawn_depth),
        HAIR_TEST(compute_levels_of_detail_equal_drawn_ones),
        HAIR_TEST(compute_pixels_of_equal_hair_are_equal_bits),
        HAIR_TEST(compute_coverage_equals_drawn_coverage),
        HAIR_TEST(passes_without_compute_rasterization_are_drawn),
        HAIR_TEST(compute_path_draws_pixels_of_user_shaders),
        HAIR_TEST(compute_memory_fits_the_pixels_and_is_freed_unused),
    };
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
