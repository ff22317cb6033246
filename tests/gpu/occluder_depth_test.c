// occluder_depth_test.c - wrong and hostile textures and matrices of the application. Each gives an
// error that names the field, or a picture. None gives an OpenGL error or a number that is not
// finite.
#include "tests/support/scene.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define SIZE 32

struct fixture {
    struct hair_test_scene scene;
    GLuint depth;
};

static GLuint make_texture(GLenum target, GLenum format, GLsizei size)
{
    GLuint texture;
    glCreateTextures(target, 1, &texture);
    if (target == GL_TEXTURE_2D_MULTISAMPLE)
        glTextureStorage2DMultisample(texture, 4, format, size, size, GL_TRUE);
    else if (target == GL_TEXTURE_2D_ARRAY)
        glTextureStorage3D(texture, 1, format, size, size, 2);
    else
        glTextureStorage2D(texture, 1, format, size, size);
    return texture;
}

static struct fixture start(void** state)
{
    static const float near_by = 0.01f;
    struct fixture f = {.scene = hair_test_scene_of(*state, NULL, NULL)};
    hair_test_frame_make(&f.scene.frame, SIZE, SIZE, GL_RGBA32F, 0);
    hair_test_set_orthographic(&f.scene.view, 2, -2, 0);
    f.depth = make_texture(GL_TEXTURE_2D, GL_DEPTH_COMPONENT32F, SIZE);
    glClearTexImage(f.depth, 0, GL_DEPTH_COMPONENT, GL_FLOAT, &near_by);
    return f;
}

static void finish(struct fixture* f)
{
    glDeleteTextures(1, &f->depth);
    hair_test_scene_free(&f->scene);
}

static uint32_t draw(struct fixture* f)
{
    static float pixels[4 * SIZE * SIZE];
    uint32_t drawn = 0;
    hair_test_draw_in(&f->scene.frame, f->scene.test, f->scene.hair, &f->scene.view, pixels);
    for (int i = 0; i < 4 * SIZE * SIZE; ++i) {
        assert_true(pixels[i] >= 0 && pixels[i] <= 65504);
        drawn += pixels[i] > 0;
    }
    return drawn;
}

static void refuse(struct fixture* f, GLuint texture)
{
    static const hair_pass passes[] = {HAIR_PASS_COLOR, HAIR_PASS_DEPTH, HAIR_PASS_ID, HAIR_PASS_OPACITY};
    char words[128];
    snprintf(words, sizeof words, "hair_view.occluder_depth is %u, not a 2D texture of depth", texture);
    f->scene.view.occluder_depth = texture;
    for (int i = 0; i < 4; ++i) {
        f->scene.view.pass = passes[i];
        hair_test_refused(f->scene.test, hair_draw(f->scene.hair, &f->scene.view), HAIR_ERROR_ARGUMENT,
                          words);
    }
    f->scene.view.pass = HAIR_PASS_GUIDES; // Occlusion culling does not apply to guides.
    hair_test_ok(f->scene.test, hair_draw(f->scene.hair, &f->scene.view));
    f->scene.view.pass = HAIR_PASS_COLOR;
    assert_int_equal(glGetError(), GL_NO_ERROR);
}

static void occluder_that_is_no_depth_texture_is_refused(void** state)
{
    static const struct {
        GLenum target, format;
    } kinds[] = {
        {GL_TEXTURE_2D, GL_RGBA8},
        {GL_TEXTURE_2D, GL_R32F},
        {GL_TEXTURE_2D, GL_STENCIL_INDEX8},
        {GL_TEXTURE_RECTANGLE, GL_DEPTH_COMPONENT24},
        {GL_TEXTURE_CUBE_MAP, GL_DEPTH_COMPONENT24},
        {GL_TEXTURE_2D_ARRAY, GL_DEPTH_COMPONENT24},
        {GL_TEXTURE_2D_MULTISAMPLE, GL_DEPTH_COMPONENT24},
    };
    struct fixture f = start(state);
    GLuint texture;
    assert_true(draw(&f) > 0);
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; ++i) {
        texture = make_texture(kinds[i].target, kinds[i].format, 8);
        refuse(&f, texture);
        glDeleteTextures(1, &texture);
        refuse(&f, texture); // The texture has been deleted.
    }
    glGenTextures(1, &texture); // The name has no texture object at first, and then no image.
    refuse(&f, texture);
    glBindTexture(GL_TEXTURE_2D, texture);
    glBindTexture(GL_TEXTURE_2D, 0);
    refuse(&f, texture);
    glDeleteTextures(1, &texture);
    refuse(&f, 4711);
    refuse(&f, UINT32_MAX);
    refuse(&f, f.scene.hair->geometry.patch_texture); // A buffer texture of the library.
    f.scene.view.occluder_depth = 0;
    assert_true(draw(&f) > 0);
    finish(&f);
}

static void occluder_depth_may_have_any_depth_format(void** state)
{
    static const GLenum formats[] = {GL_DEPTH_COMPONENT16,  GL_DEPTH_COMPONENT24, GL_DEPTH_COMPONENT32,
                                     GL_DEPTH_COMPONENT32F, GL_DEPTH24_STENCIL8,  GL_DEPTH32F_STENCIL8};
    struct fixture f = start(state);
    for (int i = 0; i < 6; ++i) {
        GLuint frame;
        f.scene.view.occluder_depth = make_texture(GL_TEXTURE_2D, formats[i], SIZE);
        glTextureParameteri(f.scene.view.occluder_depth, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
        glCreateFramebuffers(1, &frame);
        glNamedFramebufferTexture(frame, i < 4 ? GL_DEPTH_ATTACHMENT : GL_DEPTH_STENCIL_ATTACHMENT,
                                  f.scene.view.occluder_depth, 0);
        for (int hides = 0; hides < 2; ++hides) {
            float depth = hides ? 0.01f : 0.99f;
            glClearNamedFramebufferfv(frame, GL_DEPTH, 0, &depth);
            assert_int_equal(draw(&f) == 0, hides);
        }
        if (i >= 4) {
            glTextureParameteri(f.scene.view.occluder_depth, GL_DEPTH_STENCIL_TEXTURE_MODE, GL_STENCIL_INDEX);
            refuse(&f, f.scene.view.occluder_depth);
        }
        glDeleteFramebuffers(1, &frame);
        glDeleteTextures(1, &f.scene.view.occluder_depth);
    }
    finish(&f);
}

// Check that any matrix gives a picture. The first two have everything far outside the picture or
// behind the eye. The others map everything to one point, to a line, or to a plane.
static void occluder_matrix_may_have_any_finite_values(void** state)
{
    static const float odd[][16] = {
        {FLT_MAX, 0, 0, 0, 0, FLT_MAX, 0, 0, 0, 0, FLT_MAX, 0, 0, 0, 0, 1},
        {-1, 0, 0, 0, 0, -1, 0, 0, 0, 0, -1, 0, 0, 0, 0, -1},
        {[15] = 1},
        {[3] = 1},
        {1, 0, 0, 1, 0, 1, 0, 1, 0, 0, 1, 1, 0, 0, 0, 0},
        {[0] = FLT_MIN, [3] = -FLT_MAX, [5] = FLT_MAX, [10] = FLT_MIN, [15] = FLT_MAX},
    };
    struct fixture f = start(state);
    f.scene.view.occluder_depth = f.depth;
    assert_int_equal(draw(&f), 0);
    for (size_t i = 0; i < sizeof odd / sizeof *odd; ++i) {
        memcpy(f.scene.view.occluder_matrix, odd[i], sizeof odd[i]);
        assert_true(draw(&f) > 0 || i >= 2);
    }
    finish(&f);
}

static void occluder_matrix_that_is_not_finite_is_refused(void** state)
{
    struct fixture f = start(state);
    for (int i = 0; i < 16; ++i) {
        char words[64];
        snprintf(words, sizeof words, "hair_view.occluder_matrix[%d] is", i);
        f.scene.view.occluder_matrix[i] = i % 2 ? NAN : -INFINITY;
        hair_test_refused(f.scene.test, hair_draw(f.scene.hair, &f.scene.view), HAIR_ERROR_ARGUMENT, words);
        f.scene.view.occluder_matrix[i] = 0;
    }
    hair_test_ok(f.scene.test, hair_draw(f.scene.hair, &f.scene.view));
    finish(&f);
}

static void buffer_textures_are_refused_for_lights_and_colors(void** state)
{
    struct fixture f = start(state);
    hair_light light = hair_light_default();
    hair_test_ok(f.scene.test, hair_draw(f.scene.hair, &f.scene.view));
    GLuint buffer = f.scene.hair->geometry.patch_texture;
    f.scene.view.lights = &light;
    light.opaque_shadow_map = buffer;
    hair_test_refused(f.scene.test, hair_draw(f.scene.hair, &f.scene.view), HAIR_ERROR_ARGUMENT,
                      "lights[0].opaque_shadow_map is");
    light.opaque_shadow_map = 0, light.hair_shadow_map = buffer;
    hair_test_refused(f.scene.test, hair_draw(f.scene.hair, &f.scene.view), HAIR_ERROR_ARGUMENT,
                      "lights[0].hair_shadow_map is");
    light.hair_shadow_map = 0, f.scene.view.color_texture = buffer;
    hair_test_refused(f.scene.test, hair_draw(f.scene.hair, &f.scene.view), HAIR_ERROR_ARGUMENT,
                      "hair_view.color_texture is");
    assert_int_equal(glGetError(), GL_NO_ERROR);
    finish(&f);
}

int main(void)
{
    if (hair_test_skips()) return 0;
    const struct CMUnitTest tests[] = {
        HAIR_TEST(occluder_that_is_no_depth_texture_is_refused),
        HAIR_TEST(occluder_depth_may_have_any_depth_format),
        HAIR_TEST(occluder_matrix_may_have_any_finite_values),
        HAIR_TEST(occluder_matrix_that_is_not_finite_is_refused),
        HAIR_TEST(buffer_textures_are_refused_for_lights_and_colors),
    };
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
