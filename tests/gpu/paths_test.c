// paths_test.c - all render paths draw hair alike, and HAIR_RENDER_PATH_AUTO selects a path that is
// known to be fast.
#include "tests/support/scene.h"

#include <stdlib.h>
#include <string.h>

#include "tests/support/haircut.h"
#include "tests/support/render_paths.h"

// Tools are not linked into tests.
#include "tools/common/image_error.c"

enum { SIDE = 192, PIXELS = SIDE * SIDE, PATHS = HAIR_TEST_PATHS };

// Parts of the names of the passes that draw.
static const char* const names[PATHS] = {"tessellated", "procedural", "draw/cached", "resolve_tiles"};

// Make few strands, each as wide as several. `curly` adds curls, and a ball that many strands hit.
static struct hair_test_scene start(void** state, int curly)
{
    struct hair_test_scene f = hair_test_scene_make(*state, NULL);
    hair_style_desc of = hair_style_desc_default();
    hair_desc how = hair_desc_default();
    hair_look look = hair_look_default();
    hair_collider ball = hair_collider_default();
    of.style = HAIR_STYLE_CURLY;
    if (curly) hair_test_ok(f.test, hair_look_apply_preset(&look, HAIR_LOOK_CURLY));
    hair_test_ok(f.test, hair_look_color(&look, HAIR_COLOR_BLOND));
    look.strand.radius = 5e-4f;
    how.look = &look;
    f.groom = hair_test_haircut(f.test, &of, curly ? 1500 : 200);
    hair_test_ok(f.test, hair_create(f.test->context, f.groom, &how, &f.hair));
    ball.size[0] = 0.06f;
    ball.position[0] = 0.1f, ball.position[1] = 1.55f, ball.position[2] = 0.05f;
    if (curly) hair_test_ok(f.test, hair_set_colliders(f.hair, &ball, 1, sizeof ball));
    hair_test_ok(f.test, hair_step(f.hair, 1.0f / 60));
    return f;
}

// Make a view from the front of the head, 0.8 m away.
static hair_view front(hair_render_path path, hair_primitive primitive)
{
    hair_view view = hair_view_default();
    view.render_path = path, view.primitive = primitive;
    view.view[13] = -1.6f, view.view[14] = -0.8f;
    hair_test_set_perspective(&view, 3, 1);
    return view;
}

struct picture {
    float pixels[4 * PIXELS], shown[3 * PIXELS];
    unsigned char mask[PIXELS]; // Area of the hair, with a border of 8 pixels.
};

// Read ten times the difference of depth from the far plane.
static void read_depths(const struct hair_test_frame* frame, float* pixels)
{
    static float depths[PIXELS];
    hair_test_frame_read_depth(frame, depths);
    for (int i = 0; i < 4 * PIXELS; ++i) pixels[i] = 10 * (1 - depths[i / 4]);
}

static void draw(struct hair_test_scene* f, const hair_view* view, struct picture* out)
{
    int shows = view->pass == HAIR_PASS_COLOR;
    struct hair_test_frame frame;
    hair_test_frame_make(&frame, SIDE, SIDE, GL_RGBA32F, shows ? 4 : 0);
    hair_test_ok(f->test, hair_draw(f->hair, view));
    if (shows)
        hair_test_frame_read(&frame, out->pixels);
    else
        read_depths(&frame, out->pixels);
    hair_test_frame_free(&frame);
    for (int i = 0; i < PIXELS; ++i) {
        for (int k = 0; k < 3; ++k) {
            float x = fminf(fmaxf(out->pixels[4 * i + k], 0), 1);
            out->shown[3 * i + k] = x <= 0.0031308f ? 12.92f * x : 1.055f * powf(x, 1 / 2.4f) - 0.055f;
        }
        out->mask[i] = out->pixels[4 * i + 3] > 0;
    }
    assert_true(hair_mask_dilate(out->mask, SIDE, SIDE, 8));
}

// Return the name of the pass that drew colour in this frame.
static const char* drawn_by(const struct hair_test_scene* f)
{
    const char* pass = hair_test_report_row(f->test, f->hair, "color").pass;
    return pass ? pass : "";
}

// Return the expected name of the pass. The path by compute draws no lines. With levels of detail,
// the vertices belong to one view.
static const char* name_of(hair_render_path path, const hair_view* view)
{
    if (path == HAIR_RENDER_PATH_COMPUTE && view->primitive == HAIR_PRIMITIVE_LINES)
        path = HAIR_RENDER_PATH_CACHED;
    if (path == HAIR_RENDER_PATH_CACHED && view->lod) return "view_cached";
    for (int i = 0; i < PATHS; ++i)
        if (hair_test_paths[i] == path) return names[i];
    return "";
}

static uint32_t count_hits(struct hair_test_scene* f)
{
    uint32_t count = 0;
    float* hits = malloc(f->hair->geometry.followers * sizeof *hits);
    glGetNamedBufferSubData(f->hair->geometry.follower_collision.hit, 0,
                            (GLsizeiptr)(f->hair->geometry.followers * sizeof *hits), hits);
    for (uint32_t i = 0; i < f->hair->geometry.followers; ++i) count += hits[i] < (float)HAIR_NO_HIT;
    free(hits);
    return count;
}

static void curls_on_a_ball_are_drawn_equally_by_all_paths(void** state)
{
    static struct picture picture[PATHS];
    struct hair_test_scene f = start(state, 1);
    for (hair_primitive primitive = HAIR_PRIMITIVE_RIBBONS; primitive <= HAIR_PRIMITIVE_LINES; ++primitive) {
        for (int path = 0; path < PATHS; ++path) {
            struct hair_image_error error;
            hair_view view = front(hair_test_paths[path], primitive);
            draw(&f, &view, &picture[path]);
            assert_non_null(strstr(drawn_by(&f), name_of(view.render_path, &view)));
            assert_true(
                hair_image_error(picture[0].shown, picture[path].shown, picture[0].mask, SIDE, SIDE, &error));
            print_message("    %s, %s: FLIP %.5f, %u followers meet the ball\n", names[path],
                          primitive ? "lines" : "ribbons", error.flip, count_hits(&f));
            // ^Samples drawn by OpenGL have the colour at the middle of their pixel. Samples made
            // by compute have their own colour.
            assert_true(error.flip <= (path == HAIR_TEST_COMPUTE ? 0.03 : 0.01));
        }
        assert_true(count_hits(&f) > 100);
    }
    hair_test_scene_free(&f);
}

static bool has_depth(const struct picture* picture)
{
    int count = 0;
    for (int i = 0; i < PIXELS; ++i) count += picture->pixels[4 * i] > 0;
    return count > PIXELS / 20;
}

// Compare paths with levels of detail. Their vertices are written for each view, into the buffers
// that draws without levels use.
static void levels_of_detail_are_drawn_equally_by_all_paths(void** state)
{
    static struct picture picture[PATHS];
    struct hair_test_scene f = start(state, 1);
    hair_lod lods[3] = {hair_lod_default(), hair_lod_default(), hair_lod_default()};
    lods[0].strand_fraction = 0.37f, lods[0].segment_fraction = 0.3f, lods[0].per_patch = false;
    lods[1].strand_fraction = 0.1f, lods[1].per_patch = false;
    lods[2].strand_pixels = 3, lods[2].segment_pixels = 20;
    for (int i = 0; i < 12; ++i)
        for (int path = 0; path < PATHS; ++path) {
            struct hair_image_error error;
            hair_view view = front(hair_test_paths[path], (hair_primitive)(i / 3 % 2));
            int shown = i < 6;
            view.pass = shown ? HAIR_PASS_COLOR : HAIR_PASS_DEPTH;
            view.lod = &lods[i % 3];
            draw(&f, &view, &picture[path]);
            if (shown) assert_non_null(strstr(drawn_by(&f), name_of(view.render_path, &view)));
            assert_true(shown || has_depth(&picture[path]));
            assert_true(
                hair_image_error(picture[0].shown, picture[path].shown, picture[0].mask, SIDE, SIDE, &error));
            print_message("    %s, %s, level %d%s: FLIP %.5f\n", names[path],
                          view.primitive ? "lines" : "ribbons", i % 3, shown ? "" : ", depth", error.flip);
            assert_true(error.flip <= (path == HAIR_TEST_COMPUTE ? 0.03 : 0.01));
        }
    hair_test_scene_free(&f);
}

// Compare colours of the groom, red on one side of the head and green on the other, by all paths. A
// look without groom colours draws as if there were none.
static void groom_colors_are_drawn_by_all_paths(void** state)
{
    static struct picture picture[PATHS + 2];
    struct hair_test_scene f = start(state, 0);
    hair_look look = f.hair->geometry.look;
    uint32_t count = f.groom->info.follower_count;
    hair_view view = front(HAIR_RENDER_PATH_TESSELLATION, HAIR_PRIMITIVE_RIBBONS);
    draw(&f, &view, &picture[PATHS]);
    f.groom->colors = hair_alloc(&f.test->host.host, count, 8 * 4 * sizeof *f.groom->colors);
    for (uint32_t i = 0; i < count; ++i)
        for (int k = 0; k < 8; ++k) {
            hair_vec4 root = f.groom->rest[f.groom->guides[f.groom->followers[i].guide0].first].position;
            f.groom->colors[32 * i + 4 * (uint32_t)k + (root.x > 0)] = 40000;
        }
    hair_destroy(f.hair);
    hair_desc how = hair_desc_default();
    how.look = &look;
    hair_test_ok(f.test, hair_create(f.test->context, f.groom, &how, &f.hair));
    hair_test_ok(f.test, hair_step(f.hair, 1.0f / 60));
    for (int path = 0; path < PATHS; ++path) {
        double sum[2][2] = {{0}};
        view.render_path = hair_test_paths[path];
        draw(&f, &view, &picture[path]);
        for (int i = 0; i < PIXELS; ++i)
            for (int c = 0; c < 2; ++c)
                sum[i % SIDE > SIDE / 2][c] += (double)picture[path].pixels[4 * i + c];
        print_message("    %s: %.1f red and %.1f green to the left, %.1f and %.1f to the right\n",
                      names[path], sum[0][0], sum[0][1], sum[1][0], sum[1][1]);
        assert_true(sum[0][0] > 2 * sum[0][1] && sum[1][1] > 2 * sum[1][0]);
    }
    look.color.groom_colors = 0;
    view.render_path = HAIR_RENDER_PATH_TESSELLATION;
    hair_test_ok(f.test, hair_set_look(f.hair, &look));
    draw(&f, &view, &picture[PATHS + 1]);
    assert_memory_equal(picture[PATHS].pixels, picture[PATHS + 1].pixels, sizeof picture[0].pixels);
    hair_test_scene_free(&f);
}

static void auto_uses_the_path_of_the_table_and_reports_it(void** state)
{
    static struct picture own, same;
    struct hair_test_scene f = start(state, 0);
    hair_lod lod = hair_lod_default();
    assert_int_equal(hair_view_default().render_path, HAIR_RENDER_PATH_AUTO);
    for (int i = 0; i < 4; ++i) {
        hair_view view = front(HAIR_RENDER_PATH_AUTO, (hair_primitive)(i % 2));
        view.lod = i / 2 ? &lod : NULL;
        hair_render_path taken = hair_test_path_of(&f.hair->renderer, &view);
        draw(&f, &view, &own);
        assert_non_null(strstr(drawn_by(&f), name_of(taken, &view)));
        view.render_path = taken;
        draw(&f, &view, &same);
        assert_memory_equal(own.pixels, same.pixels, sizeof own.pixels);
    }
    hair_test_scene_free(&f);
}

// Check that a path needs no memory for vertices.
static void check_uncached(hair_render_path path)
{
    assert_true(path == HAIR_RENDER_PATH_TESSELLATION || path == HAIR_RENDER_PATH_PROCEDURAL);
}

// Check that a fast path is not selected if it needs more than the driver allows.
static void auto_does_not_cache_more_than_fits(void** state)
{
    struct hair_test_scene f = start(state, 0);
    hair_view view = front(HAIR_RENDER_PATH_AUTO, HAIR_PRIMITIVE_RIBBONS);
    struct hair_geometry geometry = f.hair->geometry;
    struct hair_renderer many = f.hair->renderer;
    geometry.followers = 100000000; // No driver has buffers of 40 GB.
    many.geometry = &geometry;
    check_uncached(hair_test_path_of(&many, &view));
    view.render_path = HAIR_RENDER_PATH_CACHED;
    assert_int_equal(hair_test_path_of(&many, &view), HAIR_RENDER_PATH_CACHED);
    hair_test_scene_free(&f);
}

// Check that a fast path is not selected beyond the memory limit, but kept where it has memory.
static void auto_stays_within_the_memory_limit(void** state)
{
    struct hair_test_scene f = start(state, 0);
    hair_view view = front(HAIR_RENDER_PATH_AUTO, HAIR_PRIMITIVE_RIBBONS);
    hair_memory memory = hair_memory_default();
    hair_render_path usual = hair_test_path_of(&f.hair->renderer, &view);
    assert_int_not_equal(usual, HAIR_RENDER_PATH_TESSELLATION);
    hair_test_ok(f.test, hair_get_memory(f.test->context, &memory));
    hair_test_ok(f.test, hair_set_memory_limit(f.test->context, memory.bytes + 1024));
    check_uncached(hair_test_path_of(&f.hair->renderer, &view));
    hair_test_ok(f.test, hair_set_memory_limit(f.test->context, 0));
    static struct picture picture;
    draw(&f, &view, &picture);
    hair_test_ok(f.test, hair_get_memory(f.test->context, &memory));
    hair_test_ok(f.test, hair_set_memory_limit(f.test->context, memory.bytes));
    assert_int_equal(hair_test_path_of(&f.hair->renderer, &view), usual);
    hair_test_ok(f.test, hair_set_memory_limit(f.test->context, 0));
    hair_test_scene_free(&f);
}

static PFNGLNAMEDBUFFERSTORAGEPROC make_storage;
static GLsizeiptr refused; // Size of the buffers that refuse_storage() does not make.

static void APIENTRY refuse_storage(GLuint buffer, GLsizeiptr size, const void* data, GLbitfield flags)
{
    if (size != refused) make_storage(buffer, size, data, flags);
}

// Check that drawing goes on if the driver has no memory for vertices, and asks again later.
static void auto_draws_without_memory_for_vertices(void** state)
{
    static struct picture scarce, usual;
    struct hair_image_error error;
    struct hair_test_scene f = start(state, 0);
    struct hair_gl* gl = &f.test->context->gl;
    hair_view view = front(HAIR_RENDER_PATH_AUTO, HAIR_PRIMITIVE_RIBBONS);
    hair_render_path fast = hair_test_path_of(&f.hair->renderer, &view);
    assert_int_not_equal(fast, HAIR_RENDER_PATH_TESSELLATION);
    make_storage = gl->NamedBufferStorage;
    gl->NamedBufferStorage = refuse_storage;
    refused = (GLsizeiptr)(16 * hair_geometry_count_vertices(&f.hair->geometry));
    draw(&f, &view, &scarce);
    assert_int_equal(hair_test_forgive(f.test), 1); // The log tells that memory ran out.
    check_uncached(hair_test_path_of(&f.hair->renderer, &view));
    assert_non_null(strstr(drawn_by(&f), name_of(hair_test_path_of(&f.hair->renderer, &view), &view)));
    gl->NamedBufferStorage = make_storage;
    view.render_path = HAIR_RENDER_PATH_TESSELLATION;
    draw(&f, &view, &usual);
    assert_true(hair_image_error(usual.shown, scarce.shown, usual.mask, SIDE, SIDE, &error));
    print_message("    without memory: FLIP %.5f\n", error.flip);
    assert_true(error.flip <= 0.01);
    view.render_path = HAIR_RENDER_PATH_AUTO;
    for (int i = 0; i < 300; ++i) hair_test_ok(f.test, hair_step(f.hair, 1.0f / 60));
    draw(&f, &view, &usual);
    assert_int_equal(hair_test_path_of(&f.hair->renderer, &view), fast);
    hair_test_scene_free(&f);
}

int main(void)
{
    if (hair_test_skips()) return 0;
    const struct CMUnitTest tests[] = {
        HAIR_TEST(curls_on_a_ball_are_drawn_equally_by_all_paths),
        HAIR_TEST(levels_of_detail_are_drawn_equally_by_all_paths),
        HAIR_TEST(groom_colors_are_drawn_by_all_paths),
        HAIR_TEST(auto_uses_the_path_of_the_table_and_reports_it),
        HAIR_TEST(auto_does_not_cache_more_than_fits),
        HAIR_TEST(auto_stays_within_the_memory_limit),
        HAIR_TEST(auto_draws_without_memory_for_vertices),
    };
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
