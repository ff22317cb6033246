// state_test.c - the application's OpenGL state and error flag are restored, and the library causes
// no OpenGL errors.
#define _POSIX_C_SOURCE 200809L
#include "tests/support/support.h"

#include <epoxy/egl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "lib/groom/groom.h"
#include "tests/support/calls.h"
#include "tests/support/glstate.h"
#include "tests/support/handmade.h"
#include "tests/support/ways.h"

// An application with a debug context of its own, and odd values for all state.
struct fixture {
    struct hair_test_host host;
    hair_egl* egl;
    EGLDisplay display;
    EGLContext debug;
    int planting; // 1 while the application causes an error of its own.
    char message[512]; // The last error that the library caused.
    struct hair_test_calls calls;
};

static void APIENTRY listen(GLenum source, GLenum type, GLuint id, GLenum severity, GLsizei length,
                            const GLchar* message, const void* user)
{
    (void)source, (void)id, (void)severity, (void)length;
    struct fixture* f = (struct fixture*)(uintptr_t)user;
    if (type == GL_DEBUG_TYPE_PUSH_GROUP || type == GL_DEBUG_TYPE_POP_GROUP || type == GL_DEBUG_TYPE_OTHER ||
        f->planting)
        return;
    // A driver compiles a program again for the state in which a draw first finds it. The first
    // sentence is NVIDIA's, the second Mesa's.
    if (type == GL_DEBUG_TYPE_PERFORMANCE &&
        (strstr(message, "recompiled based on GL state") || strstr(message, " shader variant (")))
        return;
    snprintf(f->message, sizeof f->message, "%s", message);
}

// Create a debug context of a profile.
static EGLContext create_debug(EGLDisplay display, EGLint profile)
{
    const EGLint wanted[] = {EGL_CONTEXT_MAJOR_VERSION,
                             4,
                             EGL_CONTEXT_MINOR_VERSION,
                             5,
                             EGL_CONTEXT_OPENGL_PROFILE_MASK,
                             profile,
                             EGL_CONTEXT_OPENGL_DEBUG,
                             EGL_TRUE,
                             EGL_NONE};
    return eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, wanted);
}

static void create_textures(struct hair_test_calls* calls)
{
    glCreateTextures(GL_TEXTURE_2D, 1, &calls->shadow);
    glTextureStorage2D(calls->shadow, 1, GL_DEPTH_COMPONENT32F, 8, 8);
    glCreateTextures(GL_TEXTURE_3D, 1, &calls->wind);
    glTextureStorage3D(calls->wind, 1, GL_RGBA16F, 4, 4, 4);
    glClearTexImage(calls->wind, 0, GL_RGBA, GL_FLOAT, NULL);
}

static int start_profile(void** state, EGLint profile)
{
    struct fixture* f = calloc(1, sizeof *f);
    *state = f;
    hair_test_host_init(&f->host);
    if (hair_egl_create(&f->host.host, -1, &f->egl)) return -1;
    f->display = eglGetCurrentDisplay();
    f->debug = create_debug(f->display, profile);
    if (!eglMakeCurrent(f->display, EGL_NO_SURFACE, EGL_NO_SURFACE, f->debug)) return -1;
    glEnable(GL_DEBUG_OUTPUT);
    glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
    glDebugMessageCallback(listen, f);
    create_textures(&f->calls);
    hair_test_glstate_disturb();
    if (glGetError() || *f->message) {
        fprintf(stderr, "the test's own state is in error: %s\n", f->message);
        return -1;
    }
    f->calls.host = &f->host.host;
    f->calls.groom = hair_test_groom(&f->host.host, hair_test_handmade_default());
    f->calls.groom->colors =
        hair_alloc(&f->host.host, f->calls.groom->info.follower_count, 8 * 4 * sizeof(float));
    return 0;
}

static int start(void** state)
{
    return start_profile(state, EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT);
}

static int start_compatibility(void** state)
{
    return start_profile(state, EGL_CONTEXT_OPENGL_COMPATIBILITY_PROFILE_BIT);
}

static int finish(void** state)
{
    struct fixture* f = *state;
    hair_groom_destroy(f->calls.groom);
    glPopDebugGroup(); // Mesa loses groups that are still open.
    eglDestroyContext(f->display, f->debug);
    hair_egl_destroy(f->egl);
    int left = (int)f->host.blocks;
    free(f);
    return left;
}

static void plant_an_error(struct fixture* f)
{
    f->planting = 1;
    glEnable(0xbad);
    f->planting = 0;
}

// Return whether a context with HAIR_GL_STATE_CLOBBER may change the state, as listed in hair.h.
static int may_change(const char* name)
{
    static const char* const listed[] = {
        "GL_CURRENT_PROGRAM", "GL_VERTEX_ARRAY_BINDING",
        // State of the vertex array.
        "GL_ELEMENT_ARRAY_BUFFER_BINDING", "GL_PATCH_VERTICES", "GL_CULL_FACE", "GL_PRIMITIVE_RESTART",
        "GL_DRAW_INDIRECT_BUFFER_BINDING", "GL_DISPATCH_INDIRECT_BUFFER_BINDING"};
    for (size_t i = 0; i < sizeof listed / sizeof *listed; ++i)
        if (strcmp(name, listed[i]) == 0) return 1;
    const char* number = strrchr(name, ' ');
    if (!number) return 0;
    int i = atoi(number + 1);
    if (strncmp(name, "GL_SHADER_STORAGE_BUFFER_", 25) == 0) return i < 8;
    if (strncmp(name, "GL_UNIFORM_BUFFER_", 18) == 0) return i < 3;
    if (strncmp(name, "GL_TEXTURE_BINDING_", 19) == 0 || strncmp(name, "GL_SAMPLER_BINDING", 18) == 0)
        return i < 24;
    if (strncmp(name, "GL_IMAGE_BINDING_", 17) == 0) return i < 2;
    return 0;
}

static void check_calls(struct fixture* f, const struct hair_test_glstate* before)
{
    static struct hair_test_glstate after;
    for (uint32_t i = 0; i < HAIR_TEST_CALLS; ++i) {
        const char* name = hair_test_call_name(i);
        plant_an_error(f);
        hair_result result = hair_test_call(&f->calls, i);
        GLenum planted = glGetError(), other = glGetError();
        if (result) fail_msg("%s: %s", name, f->host.sentence);
        if (*f->message) fail_msg("%s: %s", name, f->message);
        if (planted != GL_INVALID_ENUM) fail_msg("%s ate the host's error", name);
        if (other) fail_msg("%s left the error 0x%x", name, other);
        hair_test_glstate_read(&after);
        for (size_t k = 0; k < before->count; ++k) {
            k = hair_test_glstate_differ(before, &after, k);
            if (k == before->count ||
                (f->calls.promise == HAIR_GL_STATE_CLOBBER && may_change(before->values[k].name)))
                continue;
            fail_msg("%s changed %s from %lld to %lld", name, before->values[k].name,
                     (long long)before->values[k].value, (long long)after.values[k].value);
        }
    }
}

// Check calls by the ways from `first` on. Without HAIR_TEST_FULL=1 check the first of them only,
// because Mesa compiles the programs again for each context.
static void check_all_calls(struct fixture* f, hair_gl_state promise, int first)
{
    static struct hair_test_glstate before;
    hair_test_glstate_read(&before);
    print_message("    %zu values\n", before.count);
    assert_true(before.count > 500);
    assert_int_equal(glGetError(), GL_NO_ERROR);
    f->calls.promise = promise;
    // Work group per guide, thread per guide, and redblack.
    for (f->calls.way = first; f->calls.way < HAIR_TEST_WAYS; f->calls.way += 3) {
        check_calls(f, &before);
        if (!getenv("HAIR_TEST_FULL")) break;
    }
}

static void calls_restore_all_opengl_state_and_the_error_flag(void** state)
{
    check_all_calls(*state, HAIR_GL_STATE_RESTORE, 0);
}

static void clobbering_context_changes_only_the_listed_state(void** state)
{
    check_all_calls(*state, HAIR_GL_STATE_CLOBBER, 3);
}

// Check the state also if nothing is bound.
static void calls_leave_nothing_bound_in_a_fresh_context(void** state)
{
    struct fixture* f = *state;
    // A fresh debug context beside the disturbed one.
    EGLContext fresh = create_debug(f->display, EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT);
    assert_true(eglMakeCurrent(f->display, EGL_NO_SURFACE, EGL_NO_SURFACE, fresh));
    glEnable(GL_DEBUG_OUTPUT);
    glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
    glDebugMessageCallback(listen, f);
    GLuint target, frame; // Drawing needs a framebuffer.
    glCreateRenderbuffers(1, &target);
    glNamedRenderbufferStorage(target, GL_RGBA8, 8, 8);
    glCreateFramebuffers(1, &frame);
    glNamedFramebufferRenderbuffer(frame, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, target);
    glBindFramebuffer(GL_FRAMEBUFFER, frame);
    create_textures(&f->calls);
    check_all_calls(f, HAIR_GL_STATE_RESTORE, 0);
    eglMakeCurrent(f->display, EGL_NO_SURFACE, EGL_NO_SURFACE, f->debug);
    eglDestroyContext(f->display, fresh);
}

static void compatibility_context_keeps_fixed_function_state(void** state)
{
    struct fixture* f = *state;
    assert_true(hair_test_glstate_is_legacy());
    // Zink of Mesa 22.3 makes 1 of 64 isolines in this profile while a clip distance is enabled,
    // also in a program without this library. Without clip distances, zink makes no pipeline.
    if (strncmp((const char*)glGetString(GL_RENDERER), "zink", 4) == 0) skip();
    check_all_calls(f, HAIR_GL_STATE_RESTORE, 6);
}

int main(void)
{
    if (hair_test_skips()) return 0;
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(calls_restore_all_opengl_state_and_the_error_flag, start, finish),
        cmocka_unit_test_setup_teardown(clobbering_context_changes_only_the_listed_state, start, finish),
        cmocka_unit_test_setup_teardown(compatibility_context_keeps_fixed_function_state, start_compatibility,
                                        finish),
    };
    const struct CMUnitTest more[] = {
        cmocka_unit_test_setup_teardown(calls_leave_nothing_bound_in_a_fresh_context, start, finish),
    };
    int failed = cmocka_run_group_tests(tests, NULL, NULL);
    // Mesa compiles all programs again for the fresh context.
    return getenv("HAIR_TEST_FULL") ? failed + cmocka_run_group_tests(more, NULL, NULL) : failed;
}
