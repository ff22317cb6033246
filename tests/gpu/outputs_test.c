// outputs_test.c - colour attachments after hair_draw: those without a defined output keep every
// bit, by every render path and pass.
#include "tests/support/render_paths.h"
#include "tests/support/scene.h"

#include <string.h>

#define SIDE 96
#define TARGETS 4 // The third draw buffer has no attachment.
#define PASSES (HAIR_PASS_OPACITY + 1)

// Bits of each attachment before a draw: a signalling NaN, which no shader writes.
#define POISON 0x7FA5A5A5u

struct fixture {
    struct hair_test_scene scene;
    GLuint framebuffer, target[TARGETS], depth;
};

static const GLenum buffers[TARGETS + 1] = {GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1, GL_NONE,
                                            GL_COLOR_ATTACHMENT2, GL_COLOR_ATTACHMENT3};
static const GLuint buffer_of[TARGETS] = {0, 1, 3, 4};
// Masks of the application, which differ. That of the last attachment is closed anyway.
static const GLboolean masks[TARGETS][4] = {{1, 1, 1, 1}, {1, 1, 1, 1}, {1, 0, 1, 1}, {0, 0, 0, 0}};

static GLuint make_target(GLenum format)
{
    GLuint texture;
    glCreateTextures(GL_TEXTURE_2D, 1, &texture);
    glTextureStorage2D(texture, 1, format, SIDE, SIDE);
    return texture;
}

// Bind a framebuffer of four attachments, the first of the given format.
static void make_framebuffer(struct fixture* f, GLenum first)
{
    glCreateFramebuffers(1, &f->framebuffer);
    for (GLuint i = 0; i < TARGETS; ++i) {
        f->target[i] = make_target(i ? GL_RGBA32F : first);
        glNamedFramebufferTexture(f->framebuffer, GL_COLOR_ATTACHMENT0 + i, f->target[i], 0);
        glColorMaski(buffer_of[i], masks[i][0], masks[i][1], masks[i][2], masks[i][3]);
    }
    f->depth = make_target(GL_DEPTH_COMPONENT32F);
    glNamedFramebufferTexture(f->framebuffer, GL_DEPTH_ATTACHMENT, f->depth, 0);
    glNamedFramebufferDrawBuffers(f->framebuffer, TARGETS + 1, buffers);
    glBindFramebuffer(GL_FRAMEBUFFER, f->framebuffer);
    glViewport(0, 0, SIDE, SIDE);
    glEnable(GL_DEPTH_TEST);
}

static void free_framebuffer(struct fixture* f)
{
    glDeleteFramebuffers(1, &f->framebuffer);
    glDeleteTextures(TARGETS, f->target);
    glDeleteTextures(1, &f->depth);
    glColorMask(1, 1, 1, 1);
}

static void poison(const struct fixture* f, GLenum first)
{
    static GLuint bits[4 * SIDE * SIDE];
    static const float far_away = 1;
    for (int i = 0; i < 4 * SIDE * SIDE; ++i) bits[i] = POISON;
    for (GLuint i = 0; i < TARGETS; ++i) {
        bool is_integer = !i && first == GL_RGBA32UI;
        glTextureSubImage2D(f->target[i], 0, 0, 0, SIDE, SIDE, is_integer ? GL_RGBA_INTEGER : GL_RGBA,
                            is_integer ? GL_UNSIGNED_INT : GL_FLOAT, bits);
    }
    glClearTexImage(f->depth, 0, GL_DEPTH_COMPONENT, GL_FLOAT, &far_away);
}

// Count the values of an attachment that differ from the poison.
static uint32_t count_written(const struct fixture* f, GLuint i, GLenum first)
{
    static GLuint bits[4 * SIDE * SIDE];
    bool is_integer = !i && first == GL_RGBA32UI;
    uint32_t written = 0;
    glGetTextureImage(f->target[i], 0, is_integer ? GL_RGBA_INTEGER : GL_RGBA,
                      is_integer ? GL_UNSIGNED_INT : GL_FLOAT, sizeof bits, bits);
    for (int k = 0; k < 4 * SIDE * SIDE; ++k) written += bits[k] != POISON;
    return written;
}

static uint32_t count_depths(const struct fixture* f)
{
    static float depths[SIDE * SIDE];
    uint32_t covered = 0;
    glGetTextureImage(f->depth, 0, GL_DEPTH_COMPONENT, GL_FLOAT, sizeof depths, depths);
    for (int i = 0; i < SIDE * SIDE; ++i) covered += depths[i] < 1;
    return covered;
}

static void assert_masks_are_kept(void)
{
    for (int i = 0; i < TARGETS; ++i) {
        GLboolean mask[4];
        glGetBooleani_v(GL_COLOR_WRITEMASK, buffer_of[i], mask);
        assert_memory_equal(mask, masks[i], sizeof mask);
    }
}

static struct fixture start(void** state)
{
    hair_look look = hair_look_default();
    hair_wind wind = hair_wind_default();
    look.strand.radius = 0.003f;
    struct fixture f = {.scene = hair_test_scene_of(*state, NULL, &look)};
    wind.velocity[0] = 3;
    hair_test_ok(f.scene.test, hair_set_wind(f.scene.hair, &wind));
    hair_test_ok(f.scene.test, hair_step(f.scene.hair, 1.0f / 60));
    hair_test_set_orthographic(&f.scene.view, 2, -0.5f, -0.2f);
    return f;
}

// Draw one view, and check that it writes the first attachment alone, or none in a depth pass.
static void check_view(const struct fixture* f, GLenum first, const char* name)
{
    const hair_view* view = &f->scene.view;
    poison(f, first);
    hair_test_ok(f->scene.test, hair_draw(f->scene.hair, view));
    for (GLuint i = 0; i < TARGETS; ++i) {
        uint32_t written = count_written(f, i, first);
        bool is_output = !i && view->pass != HAIR_PASS_DEPTH;
        if ((written > 0) != is_output)
            fail_msg("%s, pass %d, path %d, primitive %d: attachment %u has %u written values", name,
                     view->pass, view->render_path, view->primitive, i, written);
    }
    if (view->pass == HAIR_PASS_DEPTH) assert_true(count_depths(f) > 100);
    assert_masks_are_kept();
}

// Add a collider. Hair without colliders is drawn by the programs of other tests, which take long
// to compile.
static void add_ball(const struct fixture* f)
{
    hair_collider ball = hair_collider_default();
    ball.size[0] = 0.1f;
    hair_test_ok(f->scene.test, hair_set_colliders(f->scene.hair, &ball, 1, sizeof ball));
}

static GLenum format_of(hair_pass pass)
{
    return pass == HAIR_PASS_ID ? GL_RGBA32UI : GL_RGBA32F;
}

static void attachments_without_output_keep_every_bit(void** state)
{
    struct fixture f = start(state);
    hair_view* view = &f.scene.view;
    hair_lod part = hair_lod_default();
    part.strand_fraction = 0.5f, part.per_patch = false;
    for (int pass = 0; pass < PASSES; ++pass) {
        GLenum first = format_of((hair_pass)pass);
        make_framebuffer(&f, first);
        if (pass == HAIR_PASS_COLLIDERS) add_ball(&f);
        for (int k = 0; k < 4 * HAIR_TEST_PATHS; ++k) {
            view->pass = (hair_pass)pass;
            view->render_path = hair_test_paths[k / 4];
            view->primitive = (hair_primitive)(k % 2);
            view->lod = k % 4 > 1 ? &part : NULL;
            view->slice = k % 2 ? HAIR_SLICE_Z : HAIR_SLICE_NONE;
            check_view(&f, first, view->lod ? "less detail" : "all detail");
        }
        free_framebuffer(&f);
        hair_test_ok(f.scene.test, hair_set_colliders(f.scene.hair, NULL, 0, 0));
    }
    view->pass = HAIR_PASS_COLOR, view->coverage = HAIR_COVERAGE_ALPHA, view->lod = NULL;
    make_framebuffer(&f, GL_RGBA32F);
    check_view(&f, GL_RGBA32F, "coverage by alpha");
    free_framebuffer(&f);
    hair_test_scene_free(&f.scene);
}

// Check a pixel shader of the application that declares the outputs 3 and 4. The application's
// own masks leave the second channel of output 3 and all of output 4.
static void outputs_of_a_pixel_shader_are_written(void** state)
{
    struct fixture f = start(state);
    hair_shader_desc desc = hair_shader_desc_default();
    uint32_t written[TARGETS];
    desc.at = HAIR_SHADE_PIXELS;
    desc.glsl = "layout(location = 3) out vec4 mine[2];\n"
                "vec4 hair_shade(hair_fragment f)\n{\n    mine[0] = vec4(f.t + 1.0);\n"
                "    mine[1] = vec4(2.0);\n    return vec4(f.color, 1.0);\n}\n";
    hair_test_ok(f.scene.test, hair_shader_create(f.scene.test->context, &desc, &f.scene.view.shader));
    make_framebuffer(&f, GL_RGBA32F);
    for (int path = 0; path < HAIR_TEST_PATHS; ++path) {
        f.scene.view.render_path = hair_test_paths[path];
        poison(&f, GL_RGBA32F);
        hair_test_ok(f.scene.test, hair_draw(f.scene.hair, &f.scene.view));
        for (GLuint i = 0; i < TARGETS; ++i) written[i] = count_written(&f, i, GL_RGBA32F);
        assert_true(written[0] > 400);
        assert_int_equal(written[1], 0);
        assert_int_equal(4 * written[2], 3 * written[0]);
        assert_int_equal(written[3], 0);
        assert_masks_are_kept();
    }
    free_framebuffer(&f);
    hair_shader_destroy(f.scene.view.shader);
    hair_test_scene_free(&f.scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        HAIR_TEST(attachments_without_output_keep_every_bit),
        HAIR_TEST(outputs_of_a_pixel_shader_are_written),
    };
    if (hair_test_skips()) return 0;
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
