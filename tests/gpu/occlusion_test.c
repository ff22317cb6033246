// occlusion_test.c - occlusion culling. Strands behind the application's depth are not drawn, and
// the picture is the same with every render path and projection. Without a depth texture, culling
// neither runs nor uses memory.
#include "tests/support/passes.h"
#include "tests/support/scene.h"

#include <hair/hair_asset.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "tests/support/haircut.h"
#include "tests/support/render_paths.h"
#include "tests/support/trace.h"

#define SIZE 96
#define VALUES (4 * SIZE * SIZE)
#define AWAY 1.2f // Distance of the eye from the middle of the hair, in metres.

// Kind of projection. REVERSED has an infinite far plane. RANGED reverses depth by glDepthRange,
// and is upside down.
enum kind { PERSPECTIVE, ORTHOGRAPHIC, REVERSED, RANGED, KINDS };

struct fixture {
    struct hair_test_scene scene;
    GLuint depth; // The frame's depth, which the view passes to the library.
    enum kind kind;
};

static const float head[16] = {0, 0, -1, 0, 0, 1, 0, 0, 1, 0, 0, 0, 5, 6, -7, 1};

static void make_hair(struct fixture* f)
{
    hair_style_desc style = hair_style_desc_default();
    hair_desc desc = hair_desc_default();
    hair_look look = hair_look_default();
    style.guide_count = 200;
    look.strand.radius = 1e-3f;
    look.strand.segments = 8;
    look.shading.model = HAIR_SHADING_LINES;
    desc.look = &look;
    memcpy(desc.transform, head, sizeof head);
    f->scene.groom = hair_test_haircut(f->scene.test, &style, 3000);
    hair_test_ok(f->scene.test, hair_create(f->scene.context, f->scene.groom, &desc, &f->scene.hair));
}

static void make_depth(struct fixture* f, GLsizei width, GLsizei height)
{
    glDeleteTextures(1, &f->depth);
    glCreateTextures(GL_TEXTURE_2D, 1, &f->depth);
    glTextureStorage2D(f->depth, 1, GL_DEPTH_COMPONENT32F, width, height);
}

static void set_kind(struct fixture* f, enum kind kind)
{
    const float n = 0.05f, far = 5, g = 2.4f, s = 2.2f;
    const float kinds[KINDS][16] = {
        {g, 0, 0, 0, 0, g, 0, 0, 0, 0, (far + n) / (n - far), -1, 0, 0, 2 * far * n / (n - far), 0},
        {s, 0, 0, 0, 0, s, 0, 0, 0, 0, -2 / (far - n), 0, 0, 0, -(far + n) / (far - n), 1},
        {g, 0, 0, 0, 0, g, 0, 0, 0, 0, 0, -1, 0, 0, n, 0},
        {g, 0, 0, 0, 0, g, 0, 0, 0, 0, (far + n) / (n - far), -1, 0, 0, 2 * far * n / (n - far), 0}};
    f->kind = kind;
    memcpy(f->scene.view.projection, kinds[kind], sizeof kinds[kind]);
    glClipControl(kind == RANGED ? GL_UPPER_LEFT : GL_LOWER_LEFT,
                  kind == REVERSED ? GL_ZERO_TO_ONE : GL_NEGATIVE_ONE_TO_ONE);
    glDepthFunc(kind >= REVERSED ? GL_GREATER : GL_LESS);
    glDepthRangef(kind == RANGED ? 1 : 0, kind == RANGED ? 0 : 1);
}

static void look_from(struct fixture* f, float turn, float up)
{
    float s = sinf(turn), c = cosf(turn);
    const float target[3] = {5, 6 + 1.5f + up, -7}, rows[3][3] = {{c, 0, -s}, {0, 1, 0}, {s, 0, c}};
    memset(f->scene.view.view, 0, sizeof f->scene.view.view);
    f->scene.view.view[14] = -AWAY, f->scene.view.view[15] = 1;
    for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k) {
            f->scene.view.view[4 * k + i] = rows[i][k];
            f->scene.view.view[12 + i] -= rows[i][k] * target[k];
        }
}

static struct fixture start(void** state)
{
    struct fixture f = {.scene = hair_test_scene_make(*state, hair_test_trace_proc)};
    make_hair(&f);
    hair_test_frame_make(&f.scene.frame, SIZE, SIZE, GL_RGBA32F, 0);
    make_depth(&f, SIZE, SIZE);
    glNamedFramebufferTexture(f.scene.frame.framebuffer, GL_DEPTH_ATTACHMENT, f.depth, 0);
    set_kind(&f, PERSPECTIVE);
    look_from(&f, 0, 0);
    return f;
}

static void finish(struct fixture* f)
{
    set_kind(f, PERSPECTIVE);
    glDeleteTextures(1, &f->depth);
    hair_test_scene_free(&f->scene);
}

// Return the depth of a point at distance `away`.
static float depth_at(const struct fixture* f, float away)
{
    const float* m = f->scene.view.projection;
    float z = (m[14] - m[10] * away) / (m[15] - m[11] * away);
    if (f->kind == REVERSED) return z;
    return f->kind == RANGED ? 0.5f - 0.5f * z : 0.5f + 0.5f * z;
}

static void clear(const struct fixture* f)
{
    static const float black[4] = {0, 0, 0, 0};
    float far_away = f->kind >= REVERSED ? 0 : 1;
    glClearNamedFramebufferfv(f->scene.frame.framebuffer, GL_COLOR, 0, black);
    glClearTexImage(f->depth, 0, GL_DEPTH_COMPONENT, GL_FLOAT, &far_away);
}

static void put_wall(const struct fixture* f, const int at[4], float away)
{
    float depth = depth_at(f, away);
    glClearTexSubImage(f->depth, 0, at[0], at[1], 0, at[2], at[3], 1, GL_DEPTH_COMPONENT, GL_FLOAT, &depth);
}

// Draw into a depth texture that contains the wall. Return the number of primitives.
static uint32_t draw(const struct fixture* f, int lends, const int at[4], float away, float* pixels)
{
    hair_view view = f->scene.view;
    clear(f);
    put_wall(f, at, away);
    view.occluder_depth = lends ? f->depth : 0;
    GLuint query = hair_test_count_begin();
    hair_test_ok(f->scene.test, hair_draw(f->scene.hair, &view));
    uint32_t count = hair_test_count_end(query);
    hair_test_frame_read(&f->scene.frame, pixels);
    return count;
}

static uint32_t read_hidden(const struct fixture* f, uint32_t hidden[])
{
    const struct hair_geometry* of = &f->scene.hair->geometry;
    struct hair_patch* patches = calloc(of->patches, sizeof *patches);
    uint32_t count = 0;
    glGetNamedBufferSubData(of->patch, 0, (GLsizeiptr)(of->patches * sizeof *patches), patches);
    for (uint32_t i = 0; i < of->patches; ++i) {
        count += patches[i].occluded;
        if (hidden) hidden[i] = patches[i].occluded;
    }
    free(patches);
    return count;
}

static float differ(const float* a, const float* b)
{
    return hair_test_max_difference(a, b, VALUES);
}

static float sum(const float* pixels)
{
    float all = 0;
    for (int i = 0; i < 4 * SIZE * SIZE; ++i) all += pixels[i];
    return all;
}

// Check three walls: a far wall culls nothing, a near wall culls everything, and a near wall over
// half of the picture culls a part.
static void occluded_patches_are_culled_without_changing_the_picture(void** state)
{
    static float kept[VALUES], some[VALUES];
    static const int places[3][4] = {{0, 0, SIZE, SIZE}, {0, 0, SIZE, SIZE}, {0, 0, SIZE / 2, SIZE}};
    static const float away[3] = {4, 0.3f, 0.3f};
    struct fixture f = start(state);
    uint32_t patches = f.scene.hair->geometry.patches;
    for (int i = 0; i < KINDS * 3 * 3; ++i) {
        int where = i % 3;
        set_kind(&f, (enum kind)(i / 9));
        f.scene.view.render_path = hair_test_paths[i / 3 % 3];
        uint32_t all = draw(&f, 0, places[where], away[where], kept);
        uint32_t primitive = draw(&f, 1, places[where], away[where], some), hidden = read_hidden(&f, NULL);
        if (differ(kept, some) > 0) fail_msg("case %d: pictures differ by %g", i, (double)differ(kept, some));
        assert_true((sum(kept) > 0) == (where != 1));
        assert_true(all > 0);
        if (where == 0) assert_int_equal(primitive, all);
        if (where == 0) assert_int_equal(hidden, 0);
        if (where == 1) assert_int_equal(primitive, 0);
        if (where == 1) assert_int_equal(hidden, patches);
        if (where == 2) assert_true(primitive < all && primitive > 0);
        if (where == 2) assert_in_range(hidden, 1, patches - 1);
        if (where == 2 && i / 3 % 3 == 0) print_message("    %u of %u patches are hidden\n", hidden, patches);
    }
    finish(&f);
}

static void move(struct fixture* f, float turn, int collider)
{
    float c = cosf(turn), s = sinf(turn), at[16];
    hair_collider ball = hair_collider_default();
    memcpy(at, head, sizeof at);
    at[0] = at[10] = c, at[2] = -s, at[8] = s;
    ball.size[0] = 0.08f, ball.position[0] = 5.12f, ball.position[1] = 7.5f, ball.position[2] = -7;
    hair_test_ok(f->scene.test, hair_set_colliders(f->scene.hair, &ball, (uint32_t)collider, sizeof ball));
    hair_test_ok(f->scene.test, hair_set_transform(f->scene.hair, at));
    hair_test_ok(f->scene.test, hair_step(f->scene.hair, 1.0f / 30));
}

// Check that culling removes no visible strand, with all settings that affect the position and
// width of strands.
static void visible_strands_are_not_occlusion_culled(void** state)
{
    static float kept[VALUES], some[VALUES];
    struct fixture f = start(state);
    hair_lod lod = hair_lod_default();
    hair_look look = f.scene.hair->geometry.look, curls = look;
    uint32_t random = 5, hidden = 0, drawn = 0;
    lod.strand_pixels = 6;
    hair_test_ok(f.scene.test, hair_look_apply_preset(&curls, HAIR_LOOK_WAVY));
    curls.strand.segments = 12;
    for (int i = 0; i < 96; ++i) {
        float number[6];
        for (int k = 0; k < 6; ++k) number[k] = hair_random(&random);
        int x = (int)(0.5f * SIZE * number[0]), y = (int)(0.5f * SIZE * number[1]);
        const int at[4] = {x, y, (int)((float)(SIZE - x) * (0.5f + 0.5f * number[2])), SIZE - y};
        set_kind(&f, (enum kind)(i % KINDS));
        look_from(&f, 6.28f * number[3], 0.4f * number[4] - 0.2f);
        f.scene.view.render_path = hair_test_paths[i % 3];
        f.scene.view.primitive = i % 5 ? HAIR_PRIMITIVE_RIBBONS : HAIR_PRIMITIVE_LINES;
        f.scene.view.coverage = i % 7 ? HAIR_COVERAGE_MSAA : HAIR_COVERAGE_ALPHA;
        f.scene.view.lod = i % 2 ? &lod : NULL;
        f.scene.view.jitter[0] = i % 11 ? 0 : 0.4f;
        if (i % 8 == 0) hair_test_ok(f.scene.test, hair_set_look(f.scene.hair, i % 16 ? &curls : &look));
        move(&f, 0.3f * sinf((float)i), i % 24 > 12);
        draw(&f, 0, at, 0.5f + 0.5f * number[5], kept);
        draw(&f, 1, at, 0.5f + 0.5f * number[5], some);
        uint32_t now = read_hidden(&f, NULL);
        // Equally distant fragments may be blended in either order, and the order differs between
        // pictures. Differences of 0.09 have been observed.
        float max = hair_draw_uses_analytic_coverage(&f.scene.view) ? 0.12f : 0;
        if (differ(kept, some) > max)
            fail_msg("case %d: pictures differ by %g", i, (double)differ(kept, some));
        hidden += now;
        drawn += f.scene.hair->geometry.patches - now;
    }
    print_message("    %u patches are hidden and %u are not\n", hidden, drawn);
    assert_true(hidden > drawn / 10);
    finish(&f);
}

// Check depth textures of other sizes. A texel then holds the depth of its whole area.
static void occluder_depth_may_have_any_size(void** state)
{
    static const GLsizei sizes[][2] = {{1, 1}, {7, 3}, {8, 8}, {33, 300}, {1000, 700}};
    struct fixture f = start(state);
    static float pixels[VALUES];
    GLuint kept = f.depth;
    f.depth = 0;
    for (int i = 0; i < 5; ++i) {
        GLsizei w = sizes[i][0], h = sizes[i][1];
        const int all[4] = {0, 0, w, h}, left[4] = {0, 0, w / 2, h};
        make_depth(&f, w, h);
        draw(&f, 1, all, 0.3f, pixels);
        assert_int_equal(read_hidden(&f, NULL), f.scene.hair->geometry.patches);
        draw(&f, 1, all, 4, pixels);
        assert_int_equal(read_hidden(&f, NULL), 0);
        // These texels are 24 mm or larger, and the Hi-Z test reads eight of them as one.
        if (w < SIZE) continue;
        draw(&f, 1, left, 0.3f, pixels);
        assert_in_range(read_hidden(&f, NULL), 1, f.scene.hair->geometry.patches - 1);
    }
    glDeleteTextures(1, &f.depth);
    f.depth = kept;
    finish(&f);
}

// Check the depth of another view. It culls the same patches as in its own view, from any eye.
static void occluder_depth_may_be_of_another_view(void** state)
{
    static float pixels[VALUES];
    static uint32_t before[1024], now[1024];
    const int left[4] = {0, 0, SIZE / 2, SIZE};
    struct fixture f = start(state);
    float given[16];
    assert_in_range(f.scene.hair->geometry.patches, 2, 1024);
    for (int i = 0; i < 2 * KINDS; ++i) {
        set_kind(&f, (enum kind)(i % KINDS));
        look_from(&f, 0, 0);
        memset(f.scene.view.occluder_matrix, 0, sizeof f.scene.view.occluder_matrix);
        draw(&f, 1, left, 0.3f, pixels);
        uint32_t count = read_hidden(&f, before);
        assert_in_range(count, 1, f.scene.hair->geometry.patches - 1);
        hair_mat4_multiply(f.scene.view.projection, f.scene.view.view, given);
        memcpy(f.scene.view.occluder_matrix, given, sizeof given);
        look_from(&f, i < KINDS ? 0.4f : 0.9f, 0.05f);
        draw(&f, 1, left, 0.3f, pixels);
        assert_int_equal(read_hidden(&f, now), count);
        assert_memory_equal(before, now, f.scene.hair->geometry.patches * sizeof *now);
    }
    finish(&f);
}

static hair_report_row report(const struct fixture* f)
{
    return hair_test_report_row(f->scene.test, f->scene.hair, "occlusion");
}

// Check also that the memory is freed when the depth texture is gone.
static void occlusion_culling_costs_nothing_without_depth(void** state)
{
    static float pixels[VALUES];
    const int all[4] = {0, 0, SIZE, SIZE};
    struct fixture f = start(state);
    struct hair_gl* gl = f.scene.hair->sim.gl;
    hair_test_ok(f.scene.test, hair_step(f.scene.hair, 1.0f / 60));
    draw(&f, 0, all, 0.3f, pixels);
    assert_int_equal(report(&f).skip_reason, HAIR_SKIP_REASON_NOT_WANTED);
    assert_int_equal(report(&f).bytes, 0);
    hair_test_trace_clear();
    draw(&f, 0, all, 0.3f, pixels);
    uint32_t binds = hair_test_trace_count("glBindTextureUnit");
    assert_int_equal(hair_test_trace_count("glDispatch"), 0);
    hair_test_trace_clear();
    uint32_t runs = hair_test_runs_of(gl, "");
    draw(&f, 1, all, 0.3f, pixels);
    assert_int_equal(hair_test_trace_count("glBindTextureUnit"), binds + 1);
    assert_in_range(hair_test_runs_of(gl, "") - runs, 4, 6);
    assert_int_equal(hair_test_trace_waits(), 0);
    assert_int_equal(report(&f).skip_reason, HAIR_SKIP_REASON_NONE);
    assert_true(report(&f).bytes > 0);
    for (int i = 0; i < 250; ++i) {
        hair_test_ok(f.scene.test, hair_step(f.scene.hair, 1e-4f));
        if (i % 50 == 49) draw(&f, 0, all, 0.3f, pixels);
    }
    draw(&f, 0, all, 0.3f, pixels);
    assert_int_equal(report(&f).skip_reason, HAIR_SKIP_REASON_NOT_WANTED);
    assert_int_equal(report(&f).bytes, 0);
    finish(&f);
}

// Check a depth texture whose picture does not show the hair. It culls nothing.
static void depth_that_cannot_hide_hair_runs_no_culling_pass(void** state)
{
    static float pixels[VALUES];
    const int all[4] = {0, 0, SIZE, SIZE};
    struct fixture f = start(state);
    hair_test_ok(f.scene.test, hair_step(f.scene.hair, 1.0f / 60));
    draw(&f, 0, all, 4, pixels); // Guides are smoothed by this draw.
    // The first picture is beside the hair. In the second, the depth function tells no near from
    // far.
    for (int i = 0; i < 2; ++i) {
        hair_mat4_multiply(f.scene.view.projection, f.scene.view.view, f.scene.view.occluder_matrix);
        f.scene.view.occluder_matrix[12] += i == 0 ? 20 : 0;
        glDepthFunc(i == 0 ? GL_LESS : GL_ALWAYS);
        hair_test_trace_clear();
        assert_true(draw(&f, 1, all, 0.3f, pixels) > 0);
        assert_int_equal(hair_test_trace_count("glDispatch"), 0);
    }
    assert_int_equal(report(&f).skip_reason, HAIR_SKIP_REASON_OUT_OF_VIEW);
    finish(&f);
}

// Check that strand lists made behind a wall are not used for a view past the wall.
static void occluded_patches_reappear_when_uncovered(void** state)
{
    static float kept[VALUES], now[VALUES];
    const int all[4] = {0, 0, SIZE, SIZE};
    struct fixture f = start(state);
    f.scene.view.render_path = HAIR_RENDER_PATH_PROCEDURAL;
    draw(&f, 0, all, 4, kept);
    for (int i = 0; i < 6; ++i) {
        draw(&f, i % 3 < 2, all, i % 3 ? 4 : 0.3f, now);
        if (i % 3)
            assert_true(differ(kept, now) == 0);
        else
            assert_true(sum(now) == 0);
    }
    finish(&f);
}

int main(void)
{
    if (hair_test_skips()) return 0;
    const struct CMUnitTest tests[] = {
        HAIR_TEST(occluded_patches_are_culled_without_changing_the_picture),
        HAIR_TEST(visible_strands_are_not_occlusion_culled),
        HAIR_TEST(occluder_depth_may_have_any_size),
        HAIR_TEST(occluder_depth_may_be_of_another_view),
        HAIR_TEST(occlusion_culling_costs_nothing_without_depth),
        HAIR_TEST(depth_that_cannot_hide_hair_runs_no_culling_pass),
        HAIR_TEST(occluded_patches_reappear_when_uncovered),
    };
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
