// other_context_test.c - calls while another OpenGL context than that of the hair_context is
// current. They are refused, and leave the objects of the other context alone.
#include "tests/support/refused_calls.h"
#include "tests/support/scene.h"

#include <epoxy/egl.h>
#include <string.h>

#define NAMES 200 // Buffers and textures of the other context, with the names that the library has.
#define BYTES 4096

static const char* const words = "not that of hair_context_create()";

// Hair in the context of the test, or in one of its own, and a host with another OpenGL context.
struct fixture {
    struct hair_test_scene scene;
    EGLDisplay display;
    EGLContext own, other;
    GLuint buffers[NAMES], textures[NAMES];
};

static void* find_opengl_only(const char* name, void* user)
{
    return strncmp(name, "egl", 3) == 0 ? NULL : hair_egl_get_proc(name, user);
}

static void make_current(const struct fixture* f, EGLContext context)
{
    assert_true(eglMakeCurrent(f->display, EGL_NO_SURFACE, EGL_NO_SURFACE, context));
}

static void start(struct fixture* f, struct hair_test* test, void* (*get_proc)(const char*, void*),
                  bool shares)
{
    // Contexts that share objects report resets in the same way.
    static const EGLint wanted[] = {EGL_CONTEXT_MAJOR_VERSION,
                                    4,
                                    EGL_CONTEXT_MINOR_VERSION,
                                    5,
                                    EGL_CONTEXT_OPENGL_RESET_NOTIFICATION_STRATEGY,
                                    EGL_LOSE_CONTEXT_ON_RESET,
                                    EGL_NONE};
    static const unsigned char filled[BYTES] = {1, 2, 3, 4, 5, 6, 7, 8};
    *f = (struct fixture){.scene = hair_test_scene_make(test, get_proc)};
    hair_test_scene_add(&f->scene, NULL, NULL);
    hair_test_ok(test, hair_step(f->scene.hair, 1.0f / 60));
    f->display = eglGetCurrentDisplay();
    f->own = eglGetCurrentContext();
    f->other = eglCreateContext(f->display, EGL_NO_CONFIG_KHR, shares ? f->own : EGL_NO_CONTEXT, wanted);
    assert_true(f->other != EGL_NO_CONTEXT);
    make_current(f, f->other);
    glCreateBuffers(NAMES, f->buffers);
    for (int i = 0; i < NAMES; ++i)
        glNamedBufferStorage(f->buffers[i], BYTES, filled, GL_DYNAMIC_STORAGE_BIT);
    glCreateTextures(GL_TEXTURE_2D, NAMES, f->textures);
}

// Check that the other context has its objects, as it made them.
static void check_other(const struct fixture* f)
{
    for (int i = 0; i < NAMES; ++i) {
        unsigned char bytes[BYTES] = {0};
        assert_true(glIsBuffer(f->buffers[i]) && glIsTexture(f->textures[i]));
        glGetNamedBufferSubData(f->buffers[i], 0, BYTES, bytes);
        assert_int_equal(bytes[0], 1);
        assert_int_equal(bytes[7], 8);
        for (int k = 8; k < BYTES; ++k) assert_int_equal(bytes[k], 0);
    }
    assert_int_equal(glGetError(), GL_NO_ERROR);
}

static void finish(struct fixture* f)
{
    make_current(f, f->own);
    eglDestroyContext(f->display, f->other);
    hair_test_scene_free(&f->scene);
}

static void calls_are_refused(struct hair_test* test, void* (*get_proc)(const char*, void*), bool shares)
{
    static struct hair_test_points before, after;
    struct fixture f;
    start(&f, test, get_proc, shares);
    hair_context* context = f.scene.hair->context;
    hair_timing timings[4];
    hair_test_refuse_calls(test, f.scene.hair, HAIR_ERROR_OPENGL, words);
    hair_test_refuse_context_calls(test, context, f.scene.groom, HAIR_ERROR_OPENGL, words);
    assert_int_equal(hair_get_timings(context, timings, 4), 0);
    hair_test_forgive(test);
    check_other(&f);
    make_current(&f, EGL_NO_CONTEXT);
    hair_test_refused(test, hair_step(f.scene.hair, 1.0f / 60), HAIR_ERROR_OPENGL, "no OpenGL context");
    make_current(&f, f.own);
    hair_test_read_points(test, f.scene.hair, HAIR_READ_GUIDES, &before);
    hair_test_ok(test, hair_step(f.scene.hair, 1.0f / 60));
    hair_test_read_points(test, f.scene.hair, HAIR_READ_GUIDES, &after);
    assert_true(hair_test_points_distance(&before, &after) > 0);
    finish(&f);
}

static void calls_in_another_context_are_refused(void** state)
{
    calls_are_refused(*state, NULL, false);
}

static void calls_in_a_context_that_shares_objects_are_refused(void** state)
{
    calls_are_refused(*state, NULL, true);
}

static void calls_are_refused_without_a_function_of_the_window_system(void** state)
{
    calls_are_refused(*state, find_opengl_only, false);
}

// Destroy in another context. The objects of neither context are deleted, and memory is freed.
static void destruction_in_another_context_deletes_nothing(void** state)
{
    struct hair_test* test = *state;
    struct fixture f;
    hair_shader* shader = NULL;
    hair_shader_desc shader_desc = hair_shader_desc_default();
    shader_desc.glsl = "vec4 hair_shade(hair_fragment f) { return vec4(f.t); }\n";
    start(&f, test, hair_egl_get_proc, false);
    make_current(&f, f.own);
    hair_test_ok(test, hair_shader_create(f.scene.context, &shader_desc, &shader));
    uint32_t objects = hair_test_count_objects();
    make_current(&f, f.other);
    hair_destroy(f.scene.hair);
    assert_int_equal(hair_test_forgive(test), 1);
    assert_non_null(strstr(test->host.sentence, words));
    hair_shader_destroy(shader);
    assert_int_equal(hair_test_forgive(test), 1);
    hair_context_destroy(f.scene.context);
    assert_int_equal(hair_test_forgive(test), 1);
    check_other(&f);
    make_current(&f, f.own);
    assert_int_equal(hair_test_count_objects(), objects);
    f.scene.hair = NULL;
    f.scene.context = NULL;
    finish(&f);
}

int main(void)
{
    if (hair_test_skips()) return 0;
    const struct CMUnitTest tests[] = {
        HAIR_TEST(calls_in_another_context_are_refused),
        HAIR_TEST(calls_in_a_context_that_shares_objects_are_refused),
        HAIR_TEST(calls_are_refused_without_a_function_of_the_window_system),
        HAIR_TEST(destruction_in_another_context_deletes_nothing),
    };
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
