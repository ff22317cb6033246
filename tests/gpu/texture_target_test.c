// texture_target_test.c - the targets of the application's textures are found without an OpenGL
// error, in the core profile and in the compatibility profile.
#include "tests/support/scene.h"

#include "lib/api/api.h"
#include "tests/support/glstate.h"

static const GLenum targets[] = {GL_TEXTURE_1D,
                                 GL_TEXTURE_2D,
                                 GL_TEXTURE_3D,
                                 GL_TEXTURE_1D_ARRAY,
                                 GL_TEXTURE_2D_ARRAY,
                                 GL_TEXTURE_RECTANGLE,
                                 GL_TEXTURE_CUBE_MAP,
                                 GL_TEXTURE_CUBE_MAP_ARRAY,
                                 GL_TEXTURE_BUFFER,
                                 GL_TEXTURE_2D_MULTISAMPLE,
                                 GL_TEXTURE_2D_MULTISAMPLE_ARRAY};
#define TARGETS (sizeof targets / sizeof *targets)

static void check_state(const struct hair_test_glstate* before)
{
    static struct hair_test_glstate after;
    assert_int_equal(glGetError(), GL_NO_ERROR);
    hair_test_glstate_read(&after);
    size_t i = hair_test_glstate_differ(before, &after, 0);
    if (i < before->count) fail_msg("%s has changed", before->values[i].name);
}

// Find the target of a texture with and without storage, bound and not.
static void every_target_is_found(void** state)
{
    static struct hair_test_glstate before;
    struct hair_test* test = *state;
    const struct hair_gl* gl = &test->context->gl;
    GLuint others[TARGETS], textures[TARGETS], buffer;
    glCreateBuffers(1, &buffer);
    glNamedBufferStorage(buffer, 64, NULL, 0);
    for (size_t i = 0; i < TARGETS; ++i) {
        glCreateTextures(targets[i], 1, &others[i]);
        glCreateTextures(targets[i], 1, &textures[i]);
        glBindTextureUnit(0, others[i]);
    }
    glActiveTexture(GL_TEXTURE5);
    hair_test_glstate_read(&before);
    for (size_t i = 0; i < TARGETS; ++i) {
        assert_int_equal(hair_gl_find_texture_target(gl, textures[i]), targets[i]);
        assert_int_equal(hair_gl_find_texture_target(gl, others[i]), targets[i]);
        check_state(&before);
    }
    glTextureStorage2D(textures[1], 1, GL_R32F, 4, 4);
    glTextureStorage3D(textures[2], 1, GL_R32F, 4, 4, 4);
    glTextureBuffer(textures[8], GL_R32F, buffer);
    for (size_t i = 0; i < TARGETS; ++i)
        assert_int_equal(hair_gl_find_texture_target(gl, textures[i]), targets[i]);
    check_state(&before);
    glDeleteTextures(TARGETS, textures);
    glDeleteTextures(TARGETS, others);
    glDeleteBuffers(1, &buffer);
    glActiveTexture(GL_TEXTURE0);
}

static void names_without_a_texture_have_no_target(void** state)
{
    struct hair_test* test = *state;
    const struct hair_gl* gl = &test->context->gl;
    GLuint name;
    glGenTextures(1, &name);
    assert_int_equal(hair_gl_find_texture_target(gl, 0), 0);
    assert_int_equal(hair_gl_find_texture_target(gl, name), 0);
    assert_int_equal(hair_gl_find_texture_target(gl, 0xdeadu), 0);
    assert_int_equal(glGetError(), GL_NO_ERROR);
    glDeleteTextures(1, &name);
}

// Set every texture of the application that the library reads.
static void textures_of_all_kinds_are_accepted(void** state)
{
    struct hair_test* test = *state;
    struct hair_test_scene scene = hair_test_scene_make(test, NULL);
    hair_light light = hair_light_default();
    hair_wind wind = hair_wind_default();
    GLuint depth, color, volume;
    hair_test_scene_add(&scene, NULL, NULL);
    hair_test_frame_make(&scene.frame, 16, 16, GL_RGBA8, 0);
    glCreateTextures(GL_TEXTURE_2D, 1, &depth);
    glTextureStorage2D(depth, 1, GL_DEPTH_COMPONENT32F, 4, 4);
    glCreateTextures(GL_TEXTURE_2D, 1, &color);
    glTextureStorage2D(color, 1, GL_RGBA8, 4, 4);
    glCreateTextures(GL_TEXTURE_3D, 1, &volume);
    glTextureStorage3D(volume, 1, GL_RGBA16F, 4, 4, 4);
    glClearTexImage(volume, 0, GL_RGBA, GL_FLOAT, NULL);
    light.hair_shadow_map = light.opaque_shadow_map = depth;
    scene.view.lights = &light;
    scene.view.light_count = 1;
    scene.view.occluder_depth = depth;
    scene.view.color_texture = color;
    wind.texture = volume;
    hair_test_ok(test, hair_set_wind(scene.hair, &wind));
    hair_test_ok(test, hair_step(scene.hair, 1.0f / 60));
    hair_test_ok(test, hair_draw(scene.hair, &scene.view));
    wind.texture = color;
    hair_test_refused(test, hair_set_wind(scene.hair, &wind), HAIR_ERROR_ARGUMENT, "not a 3D texture");
    scene.view.color_texture = volume;
    hair_test_refused(test, hair_draw(scene.hair, &scene.view), HAIR_ERROR_ARGUMENT, "not a 2D texture");
    assert_int_equal(glGetError(), GL_NO_ERROR);
    glDeleteTextures(3, (GLuint[]){depth, color, volume});
    hair_test_scene_free(&scene);
}

int main(void)
{
    if (hair_test_skips()) return 0;
    const struct CMUnitTest tests[] = {
        HAIR_TEST(every_target_is_found),
        HAIR_TEST(names_without_a_texture_have_no_target),
        HAIR_TEST(textures_of_all_kinds_are_accepted),
    };
    int failed = cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
    return failed + cmocka_run_group_tests(tests, hair_test_start_compatibility, hair_test_finish);
}
