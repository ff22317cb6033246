// motion_output_test.c - motion vectors as a second output of the colour pass. They are those of
// HAIR_PASS_MOTION, by every render path, primitive and shader, and cost nothing in other views.
#include "tests/support/render_paths.h"
#include "tests/support/scene.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define SIDE 64
#define PIXELS (SIDE * SIDE)

struct target {
    GLuint framebuffer, color[2], depth;
};

struct pictures {
    float color[4 * PIXELS], motion[4 * PIXELS];
};

// Bind a framebuffer of two attachments of floats, cleared to 0 and to depth 1.
static struct target make_target(GLsizei samples)
{
    struct target t;
    GLenum kind = samples ? GL_TEXTURE_2D_MULTISAMPLE : GL_TEXTURE_2D;
    const GLenum formats[] = {GL_RGBA32F, GL_RGBA32F, GL_DEPTH_COMPONENT32F};
    const GLenum buffers[] = {GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1};
    const float none[4] = {0}, far_away = 1;
    GLuint textures[3];
    glCreateTextures(kind, 3, textures);
    glCreateFramebuffers(1, &t.framebuffer);
    for (int i = 0; i < 3; ++i) {
        if (samples)
            glTextureStorage2DMultisample(textures[i], samples, formats[i], SIDE, SIDE, GL_TRUE);
        else
            glTextureStorage2D(textures[i], 1, formats[i], SIDE, SIDE);
        glNamedFramebufferTexture(t.framebuffer, i < 2 ? buffers[i] : GL_DEPTH_ATTACHMENT, textures[i], 0);
    }
    t.color[0] = textures[0], t.color[1] = textures[1], t.depth = textures[2];
    glNamedFramebufferDrawBuffers(t.framebuffer, 2, buffers);
    for (int i = 0; i < 2; ++i) glClearNamedFramebufferfv(t.framebuffer, GL_COLOR, i, none);
    glClearNamedFramebufferfv(t.framebuffer, GL_DEPTH, 0, &far_away);
    glBindFramebuffer(GL_FRAMEBUFFER, t.framebuffer);
    glViewport(0, 0, SIDE, SIDE);
    glEnable(GL_DEPTH_TEST);
    return t;
}

static void free_target(struct target* t)
{
    glDeleteFramebuffers(1, &t->framebuffer);
    glDeleteTextures(2, t->color);
    glDeleteTextures(1, &t->depth);
}

// Read an attachment. Several samples of a pixel are averaged.
static void read_target(const struct target* t, int attachment, GLsizei samples, float* out)
{
    GLuint from = t->framebuffer, resolved = 0, texture = 0;
    glNamedFramebufferReadBuffer(from, GL_COLOR_ATTACHMENT0 + (GLenum)attachment);
    if (samples) {
        glCreateFramebuffers(1, &resolved);
        glCreateTextures(GL_TEXTURE_2D, 1, &texture);
        glTextureStorage2D(texture, 1, GL_RGBA32F, SIDE, SIDE);
        glNamedFramebufferTexture(resolved, GL_COLOR_ATTACHMENT0, texture, 0);
        glBlitNamedFramebuffer(from, resolved, 0, 0, SIDE, SIDE, 0, 0, SIDE, SIDE, GL_COLOR_BUFFER_BIT,
                               GL_NEAREST);
        from = resolved;
    }
    glBindFramebuffer(GL_READ_FRAMEBUFFER, from);
    glReadPixels(0, 0, SIDE, SIDE, GL_RGBA, GL_FLOAT, out);
    glBindFramebuffer(GL_FRAMEBUFFER, t->framebuffer);
    glDeleteFramebuffers(1, &resolved);
    glDeleteTextures(1, &texture);
}

static void draw(const struct hair_test_scene* scene, const hair_view* view, GLsizei samples,
                 struct pictures* out)
{
    struct target t = make_target(samples);
    hair_test_ok(scene->test, hair_draw(scene->hair, view));
    read_target(&t, 0, samples, out->color);
    read_target(&t, 1, samples, out->motion);
    free_target(&t);
}

static struct hair_test_scene start(void** state)
{
    hair_look look = hair_look_default();
    look.strand.radius = 0.003f;
    look.strand.segments = 16;
    look.curl.radius = 0.003f;
    struct hair_test_scene scene = hair_test_scene_of(*state, NULL, &look);
    hair_test_set_perspective(&scene.view, 2, 1);
    scene.view.view[14] = -0.8f;
    memcpy(scene.view.prev_view, scene.view.view, sizeof scene.view.view);
    memcpy(scene.view.prev_projection, scene.view.projection, sizeof scene.view.projection);
    return scene;
}

// Move the head, the hair and the eye between two frames, and draw the first.
static void move(struct hair_test_scene* scene)
{
    hair_desc head = hair_desc_default();
    hair_view first = scene->view;
    struct target t = make_target(0);
    first.pass = HAIR_PASS_MOTION;
    first.frame_index = 1;
    hair_test_ok(scene->test, hair_draw(scene->hair, &first));
    free_target(&t);
    head.transform[12] = 0.02f;
    hair_test_ok(scene->test, hair_set_transform(scene->hair, head.transform));
    for (int i = 0; i < 3; ++i) hair_test_ok(scene->test, hair_step(scene->hair, 1.0f / 60));
    scene->view.frame_index = 2;
    scene->view.prev_view[13] = 0.03f;
}

// Count the pixels in which both pictures have hair, those in which one alone has it, and those
// whose motion differs by more than `tolerance` pixels. Return the maximum motion in pixels.
static double compare(const float* a, const float* b, double tolerance, uint32_t count[3])
{
    double max = 0;
    memset(count, 0, 3 * sizeof *count);
    for (int i = 0; i < 4 * PIXELS; i += 4) {
        count[0] += a[i + 3] == 1 && b[i + 3] == 1;
        count[1] += a[i + 3] != b[i + 3];
        if (a[i + 3] != 1 || b[i + 3] != 1) continue;
        double off = SIDE * hypot((double)a[i] - (double)b[i], (double)a[i + 1] - (double)b[i + 1]);
        count[2] += !(off <= tolerance);
        max = fmax(max, SIDE * hypot((double)a[i], (double)a[i + 1]));
        assert_true(b[i + 2] == 0);
    }
    return max;
}

static hair_shader* make_shader(const struct hair_test_scene* scene, hair_shade_at at)
{
    hair_shader* shader = NULL;
    hair_shader_desc desc = hair_shader_desc_default();
    desc.at = at;
    desc.glsl = "vec4 hair_shade(hair_fragment f) { return vec4(f.color + 0.1 * f.t, 1.0); }\n";
    hair_test_ok(scene->test, hair_shader_create(scene->test->context, &desc, &shader));
    return shader;
}

// Rasterisation by compute has other pixels at edges, and rounds positions along a strand.
static void motion_beside_colour_is_that_of_the_motion_pass(void** state)
{
    static struct pictures alone, beside;
    struct hair_test_scene scene = start(state);
    hair_lod lod = hair_lod_default();
    lod.per_patch = false, lod.strand_fraction = 0.6f, lod.segment_fraction = 0.5f;
    hair_shader* shaders[] = {make_shader(&scene, HAIR_SHADE_VERTICES),
                              make_shader(&scene, HAIR_SHADE_PIXELS)};
    move(&scene);
    for (int i = 0; i < 6 * HAIR_TEST_PATHS; ++i) {
        hair_view view = scene.view;
        int kind = i % 6; // Lines, less detail and both, and then ribbons with each shader.
        view.render_path = hair_test_paths[i / 6];
        view.primitive = (hair_primitive)(kind < 4 && kind % 2);
        view.lod = kind == 2 || kind == 3 ? &lod : NULL;
        view.shader = kind < 4 ? NULL : shaders[kind - 4];
        view.motion_output = true;
        bool is_computed = i / 6 == HAIR_TEST_COMPUTE && (kind == 0 || kind == 4);
        if (!view.shader)
            assert_int_equal(hair_test_path_of(&scene.hair->renderer, &view),
                             is_computed ? HAIR_RENDER_PATH_COMPUTE : HAIR_RENDER_PATH_CACHED);
        draw(&scene, &view, 0, &beside);
        view.pass = HAIR_PASS_MOTION;
        draw(&scene, &view, 0, &alone);
        uint32_t count[3];
        double max = compare(alone.color, beside.motion, is_computed ? 0.02 : 1e-4, count);
        if (i / 6 >= HAIR_TEST_CACHED)
            print_message("    %d: %u pixels, %u in one alone, %u differ, up to %.2f pixels a frame\n", i,
                          count[0], count[1], count[2], max);
        uint32_t few = is_computed ? count[0] / 20 : 0;
        assert_true(count[0] > 50 && max > 1 && count[1] <= few && count[2] <= few);
        for (int k = 3; k < 4 * PIXELS; k += 4) assert_true(beside.color[k] == beside.motion[k]);
    }
    for (int i = 0; i < 2; ++i) hair_shader_destroy(shaders[i]);
    hair_test_scene_free(&scene);
}

static void colour_is_the_same_with_and_without_motion(void** state)
{
    static struct pictures with, without;
    struct hair_test_scene scene = start(state);
    hair_view* view = &scene.view;
    move(&scene);
    for (int i = 0; i < 4; ++i) {
        view->render_path = i % 2 ? HAIR_RENDER_PATH_COMPUTE : HAIR_RENDER_PATH_CACHED;
        view->encode = (hair_encoding)(i / 2);
        view->motion_output = false;
        draw(&scene, view, 0, &without);
        for (int k = 0; k < 4 * PIXELS; ++k) assert_true(without.motion[k] == 0);
        view->motion_output = true;
        draw(&scene, view, 0, &with);
        // Two programs round differently.
        assert_true(hair_test_max_difference(with.color, without.color, 4 * PIXELS) < 1e-5f);
    }
    hair_test_scene_free(&scene);
}

// With several samples a pixel has as much of the motion as of the colour.
static void each_sample_with_a_colour_has_a_motion_vector(void** state)
{
    static struct pictures p;
    struct hair_test_scene scene = start(state);
    scene.view.motion_output = true;
    move(&scene);
    for (int path = 0; path < HAIR_TEST_PATHS; ++path) {
        uint32_t parts = 0;
        scene.view.render_path = hair_test_paths[path];
        draw(&scene, &scene.view, 4, &p);
        for (int k = 3; k < 4 * PIXELS; k += 4) {
            assert_true(p.color[k] == p.motion[k]);
            parts += p.color[k] > 0 && p.color[k] < 1;
        }
        assert_true(parts > 50);
    }
    hair_test_scene_free(&scene);
}

// Blend hair that moves as a whole, over a background that does not. The state of the
// application's blending is kept.
static void blended_motion_is_premultiplied_by_alpha(void** state)
{
    static struct pictures p;
    struct hair_test_scene scene = start(state);
    hair_view* view = &scene.view;
    uint32_t covered = 0;
    hair_test_set_orthographic(view, 3, -0.5f, 0);
    memcpy(view->prev_projection, view->projection, sizeof view->projection);
    memcpy(view->prev_view, view->view, sizeof view->view);
    view->prev_view[12] -= 0.125f;
    view->coverage = HAIR_COVERAGE_ALPHA;
    view->opacity = 0.75f;
    view->motion_output = true;
    glBlendFuncSeparatei(1, GL_DST_COLOR, GL_ZERO, GL_ONE, GL_DST_ALPHA);
    draw(&scene, view, 0, &p);
    for (int i = 0; i < 4 * PIXELS; i += 4) {
        double alpha = (double)p.color[i + 3];
        hair_test_near("alpha", (size_t)i, (double)p.motion[i + 3], alpha, 0);
        hair_test_near("x", (size_t)i, (double)p.motion[i], 0.5 * 3 * 0.125 * alpha, 1e-5);
        hair_test_near("y", (size_t)i, (double)p.motion[i + 1], 0, 1e-6);
        covered += alpha > 0.3;
    }
    print_message("    %u pixels\n", covered);
    assert_true(covered > 100);
    GLint source = 0;
    glGetIntegeri_v(GL_BLEND_SRC_RGB, 1, &source);
    assert_int_equal(source, GL_DST_COLOR);
    assert_false(glIsEnabledi(GL_BLEND, 1));
    glBlendFunc(GL_ONE, GL_ZERO);
    hair_test_scene_free(&scene);
}

static uint32_t count_programs_with_motion(const struct hair_gl* gl)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < gl->programs; ++i)
        count += (gl->program[i]->pass & (HAIR_GL_WITH(MOTION) | HAIR_GL_WITH(MOTION_OUTPUT))) != 0;
    return count;
}

// Use a context of its own, because others of this program have compiled motion vectors.
static void views_without_motion_output_compile_and_keep_nothing(void** state)
{
    static struct pictures p;
    struct hair_test_scene scene = hair_test_scene_make(*state, hair_egl_get_proc);
    hair_test_scene_add(&scene, NULL, NULL);
    scene.view.view[14] = -0.8f;
    for (int path = 0; path < HAIR_TEST_PATHS; ++path)
        for (int coverage = 0; coverage < 2; ++coverage) {
            scene.view.render_path = hair_test_paths[path];
            scene.view.coverage = (hair_coverage)coverage;
            draw(&scene, &scene.view, 0, &p);
        }
    assert_int_equal(count_programs_with_motion(&scene.context->gl), 0);
    assert_int_equal(scene.hair->geometry.history.buffer, 0);
    scene.view.motion_output = true;
    draw(&scene, &scene.view, 0, &p);
    assert_int_equal(count_programs_with_motion(&scene.context->gl), 1);
    assert_int_not_equal(scene.hair->geometry.history.buffer, 0);
    hair_test_scene_free(&scene);
}

// Ask for buffers and motion vectors in every frame, each of a frame_index of its own or of none.
static void buffers_and_motion_vectors_have_frames_of_their_own(void** state)
{
    static struct pictures p;
    static struct hair_test_points before, now;
    struct hair_test_scene scene = start(state);
    hair_desc head = hair_desc_default();
    scene.view.motion_output = true;
    for (uint32_t frame = 0; frame < 6; ++frame) {
        hair_buffers got = hair_buffers_default();
        got.attributes = HAIR_ATTRIBUTE_PREV_POSITION;
        got.frame_index = frame < 3 ? 0 : frame;
        scene.view.frame_index = frame < 3 ? 0 : 100 + frame;
        head.transform[12] = 0.02f * (float)frame;
        hair_test_ok(scene.test, hair_set_transform(scene.hair, head.transform));
        hair_test_ok(scene.test, hair_step(scene.hair, 1.0f / 60));
        hair_test_read_points(scene.test, scene.hair, HAIR_READ_FOLLOWERS, &now);
        if (frame == 0) before = now;
        if (frame % 2) draw(&scene, &scene.view, 0, &p);
        hair_test_ok(scene.test, hair_get_buffers(scene.hair, HAIR_READ_FOLLOWERS, &got));
        float* at = malloc(16 * (size_t)now.count);
        glGetNamedBufferSubData(got.prev_position.buffer, 0, 16 * now.count, at);
        for (uint32_t i = 0; i < now.count; ++i)
            hair_test_near("previous position", i, got.prev_origin[0] + (double)at[4 * i],
                           (double)before.at[3 * i], 1e-5);
        free(at);
        if (frame % 2 == 0) draw(&scene, &scene.view, 0, &p);
        double max = 0;
        for (int i = 0; i < 4 * PIXELS; i += 4) max = fmax(max, SIDE * (double)p.motion[i]);
        if (frame > 0 && !(max > 0.5 && max < 5)) fail_msg("frame %u: up to %f pixels", frame, max);
        before = now;
    }
    hair_test_scene_free(&scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        HAIR_TEST(motion_beside_colour_is_that_of_the_motion_pass),
        HAIR_TEST(colour_is_the_same_with_and_without_motion),
        HAIR_TEST(each_sample_with_a_colour_has_a_motion_vector),
        HAIR_TEST(blended_motion_is_premultiplied_by_alpha),
        HAIR_TEST(views_without_motion_output_compile_and_keep_nothing),
        HAIR_TEST(buffers_and_motion_vectors_have_frames_of_their_own),
    };
    if (hair_test_skips()) return 0;
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
