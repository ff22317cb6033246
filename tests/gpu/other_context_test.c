// other_context_test.c - calls while another OpenGL context than that of the hair_context is
// current. They are refused, and leave the objects of the other context alone.
#include "tests/support/scene.h"
#include "tests/support/tessellated.h"

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

// Refuse the calls that need OpenGL.
static void check_refused(struct fixture* f)
{
    struct hair_test* test = f->scene.test;
    hair_context* context = f->scene.hair->context;
    hair_instance *hair = f->scene.hair, *created = NULL;
    hair_shader* shader = NULL;
    hair_desc desc = hair_desc_default();
    hair_shader_desc shader_desc = hair_shader_desc_default();
    hair_view view = hair_test_tessellated();
    hair_solver_stats stats = hair_solver_stats_default();
    hair_field_info field = hair_field_info_default();
    hair_report_info report = hair_report_info_default();
    hair_timing timings[4];
    float positions[30];
    uint32_t count = 0;
    size_t size = 0;
    bool is_ready = false;
    shader_desc.glsl = "vec4 hair_shade(hair_fragment f) { return vec4(f.t); }\n";
    hair_test_refused(test, hair_create(context, f->scene.groom, &desc, &created), HAIR_ERROR_OPENGL, words);
    hair_test_refused(test, hair_shader_create(context, &shader_desc, &shader), HAIR_ERROR_OPENGL, words);
    hair_test_refused(test, hair_context_reload(context), HAIR_ERROR_OPENGL, words);
    hair_test_refused(test, hair_step(hair, 1.0f / 60), HAIR_ERROR_OPENGL, words);
    hair_test_refused(test, hair_reset(hair), HAIR_ERROR_OPENGL, words);
    hair_test_refused(test, hair_teleport(hair, desc.transform), HAIR_ERROR_OPENGL, words);
    hair_test_refused(test, hair_draw(hair, &view), HAIR_ERROR_OPENGL, words);
    hair_test_refused(test, hair_precompile(hair, &view, &is_ready), HAIR_ERROR_OPENGL, words);
    hair_test_refused(test, hair_read_positions(hair, HAIR_READ_GUIDES, positions, 10, &count),
                      HAIR_ERROR_OPENGL, words);
    hair_test_refused(test, hair_get_solver_stats(hair, &stats), HAIR_ERROR_OPENGL, words);
    hair_test_refused(test, hair_get_field(hair, &field), HAIR_ERROR_OPENGL, words);
    hair_test_refused(test, hair_report(hair, true, &report, NULL, 0, 0, &count), HAIR_ERROR_OPENGL, words);
    hair_test_refused(test, hair_save(hair, NULL, 0, &size), HAIR_ERROR_OPENGL, words);
    hair_test_refused(test, hair_load(hair, positions, sizeof positions), HAIR_ERROR_OPENGL, words);
    assert_int_equal(hair_get_timings(context, timings, 4), 0);
    hair_test_forgive(test);
}

// Refuse the calls of lists, of cuts, of buffers and of contacts.
static void check_others_refused(struct fixture* f)
{
    struct hair_test* test = f->scene.test;
    hair_context* context = f->scene.hair->context;
    hair_instance* hair = f->scene.hair;
    hair_view view = hair_test_tessellated();
    hair_cut_desc cut = hair_cut_desc_default();
    hair_buffers buffers = hair_buffers_default();
    hair_body_desc desc = hair_body_desc_default();
    const float positions[9] = {0, 0, 0, 0.1f, 0, 0, 0, 0.1f, 0}, half = 0.5f;
    const uint32_t triangle[3] = {0, 1, 2};
    hair_body* body = NULL;
    char tuning[1000];
    desc.positions = positions, desc.triangles = triangle;
    desc.vertex_count = 3, desc.triangle_count = 1;
    desc.upper[0] = desc.upper[1] = desc.upper[2] = 1;
    hair_test_refused(test, hair_step_list(&hair, 1, 1.0f / 60), HAIR_ERROR_OPENGL, words);
    hair_test_refused(test, hair_draw_list(&hair, 1, &view), HAIR_ERROR_OPENGL, words);
    hair_test_refused(test, hair_set_lengths(hair, 0, 1, &half), HAIR_ERROR_OPENGL, words);
    hair_test_refused(test, hair_cut(hair, &cut, NULL, NULL), HAIR_ERROR_OPENGL, words);
    hair_test_refused(test, hair_get_buffers(hair, HAIR_READ_FOLLOWERS, &buffers), HAIR_ERROR_OPENGL, words);
    hair_test_refused(test, hair_body_create(context, &desc, &body), HAIR_ERROR_OPENGL, words);
    hair_test_refused(test, hair_record_contacts(hair, 100), HAIR_ERROR_OPENGL, words);
    hair_test_refused(test, hair_context_tune(context, tuning, sizeof tuning), HAIR_ERROR_OPENGL, words);
    hair_test_refused(test, hair_set_targets_buffer(hair, 1, 0, 12, NULL), HAIR_ERROR_OPENGL, words);
    assert_null(body);
}

static void calls_are_refused(struct hair_test* test, void* (*get_proc)(const char*, void*), bool shares)
{
    static struct hair_test_points before, after;
    struct fixture f;
    start(&f, test, get_proc, shares);
    check_refused(&f);
    check_others_refused(&f);
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
