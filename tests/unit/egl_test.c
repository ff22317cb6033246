// egl_test.c - an OpenGL context without a window: found, refused, shared, destroyed.
#define _POSIX_C_SOURCE 200809L
#include <hair/hair_egl.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>
#include <epoxy/egl.h>
#include <epoxy/gl.h>
#include <sys/wait.h>
#include <unistd.h>

struct ear {
    char last_error[512];
    char all[4096];
    uint32_t allocations, refuse_at;
};

static void listen(hair_log_level level, const char* sentence, void* user)
{
    struct ear* ear = user;
    if (level == HAIR_LOG_ERROR) strncpy(ear->last_error, sentence, sizeof ear->last_error - 1);
    strncat(ear->all, sentence, sizeof ear->all - strlen(ear->all) - 1);
}

static void* give(size_t size, size_t align, void* user)
{
    struct ear* ear = user;
    if (++ear->allocations == ear->refuse_at) return NULL;
    return aligned_alloc(align, (size + align - 1) / align * align);
}

static void take(void* memory, size_t size, void* user)
{
    (void)size;
    (void)user;
    free(memory);
}

static hair_host host_of(struct ear* ear)
{
    return (hair_host){.alloc = give, .free = take, .log = listen, .user = ear};
}

static hair_egl* made(void)
{
    hair_egl* egl = NULL;
    assert_int_equal(hair_egl_create(NULL, -1, &egl), HAIR_OK);
    assert_non_null(egl);
    return egl;
}

static void a_new_context_is_current_and_is_opengl_4_5_core(void** state)
{
    (void)state;
    hair_egl* egl = made();
    GLint major, minor, profile;
    glGetIntegerv(GL_MAJOR_VERSION, &major);
    glGetIntegerv(GL_MINOR_VERSION, &minor);
    glGetIntegerv(GL_CONTEXT_PROFILE_MASK, &profile);
    assert_true(10 * major + minor >= 45);
    assert_int_equal(profile, GL_CONTEXT_CORE_PROFILE_BIT);
    hair_egl_destroy(egl);
}

static void log_names_the_selected_device(void** state)
{
    (void)state;
    struct ear ear = {0};
    hair_host host = host_of(&ear);
    hair_egl* egl;
    assert_int_equal(hair_egl_create(&host, -1, &egl), HAIR_OK);
    assert_non_null(strstr(ear.all, "taken: "));
    assert_non_null(strstr(ear.all, (const char*)glGetString(GL_RENDERER)));
    assert_string_equal(ear.last_error, "");
    hair_egl_destroy(egl);
}

static void a_device_out_of_range_is_an_argument_error(void** state)
{
    (void)state;
    static const int wrong[] = {-2, 64, INT32_MAX, INT32_MIN};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; ++i) {
        struct ear ear = {0};
        hair_host host = host_of(&ear);
        hair_egl* egl = NULL;
        assert_int_equal(hair_egl_create(&host, wrong[i], &egl), HAIR_ERROR_ARGUMENT);
        assert_null(egl);
        assert_non_null(strstr(ear.last_error, "device"));
        assert_non_null(strstr(ear.last_error, "not in [-1, "));
    }
    assert_int_equal(hair_egl_create(NULL, -1, NULL), HAIR_ERROR_ARGUMENT);
}

static void a_destroyed_context_leaves_none_current(void** state)
{
    (void)state;
    hair_egl_destroy(made());
    assert_ptr_equal(eglGetCurrentContext(), EGL_NO_CONTEXT);
    hair_egl_destroy(NULL);
}

static void destroying_a_context_keeps_another_of_the_device(void** state)
{
    (void)state;
    hair_egl* first = made();
    hair_egl* second = made();
    hair_egl_destroy(first);
    assert_int_equal(hair_egl_make_current(second), HAIR_OK);
    assert_non_null(glGetString(GL_VERSION));
    GLuint buffer;
    glCreateBuffers(1, &buffer);
    glNamedBufferStorage(buffer, 4, "hair", 0);
    char bytes[4] = {0};
    glGetNamedBufferSubData(buffer, 0, 4, bytes);
    assert_memory_equal(bytes, "hair", 4);
    hair_egl_destroy(second);
}

static void destroying_another_context_keeps_the_current_one(void** state)
{
    (void)state;
    hair_egl* first = made();
    hair_egl* second = made();
    EGLContext current = eglGetCurrentContext();
    hair_egl_destroy(first);
    assert_ptr_equal(eglGetCurrentContext(), current);
    hair_egl_destroy(second);
}

static void making_null_current_leaves_none_current(void** state)
{
    (void)state;
    hair_egl* egl = made();
    assert_int_equal(hair_egl_make_current(NULL), HAIR_OK);
    assert_ptr_equal(eglGetCurrentContext(), EGL_NO_CONTEXT);
    assert_int_equal(hair_egl_make_current(NULL), HAIR_OK);
    assert_int_equal(hair_egl_make_current(egl), HAIR_OK);
    assert_ptr_not_equal(eglGetCurrentContext(), EGL_NO_CONTEXT);
    hair_egl_destroy(egl);
}

static void functions_are_found_by_name(void** state)
{
    (void)state;
    hair_egl* egl = made();
    assert_non_null(hair_egl_get_proc("glDispatchCompute", NULL));
    assert_null(hair_egl_get_proc(NULL, NULL));
    hair_egl_destroy(egl);
}

static void refused_memory_is_a_memory_error(void** state)
{
    (void)state;
    struct ear ear = {.refuse_at = 1};
    hair_host host = host_of(&ear);
    hair_egl* egl = NULL;
    assert_int_equal(hair_egl_create(&host, -1, &egl), HAIR_ERROR_MEMORY);
    assert_null(egl);
    assert_non_null(strstr(ear.last_error, "out of memory"));
}

// Return the exit code of a child that asks for an old driver. It needs a child because Mesa
// chooses its driver once in a process.
static int exit_code_of_an_old_driver(void)
{
    struct ear ear = {0};
    hair_host host = host_of(&ear);
    hair_egl* egl = NULL;
    if (hair_egl_create(&host, -1, &egl) != HAIR_ERROR_OPENGL || egl) return 1;
    if (!strstr(ear.last_error, "no EGL device gives OpenGL 4.5 core: ")) return 2;
    if (!strstr(ear.last_error, "older than OpenGL 4.5 core")) return 3;
    return strstr(ear.all, "refused: ") ? 0 : 4;
}

static void old_driver_is_an_opengl_error_with_reasons(void** state)
{
    const char* program = *state;
    pid_t child = fork();
    if (child == 0) {
        setenv("GALLIUM_DRIVER", "softpipe", 1);
        setenv("LIBGL_ALWAYS_SOFTWARE", "1", 1);
        execl("/proc/self/exe", program, "old-driver", (char*)NULL);
        _exit(127);
    }
    int status;
    assert_int_equal(waitpid(child, &status, 0), child);
    assert_true(WIFEXITED(status));
    assert_int_equal(WEXITSTATUS(status), 0);
}

int main(int count, char** arguments)
{
    if (count == 2 && !strcmp(arguments[1], "old-driver")) return exit_code_of_an_old_driver();
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_new_context_is_current_and_is_opengl_4_5_core),
        cmocka_unit_test(log_names_the_selected_device),
        cmocka_unit_test(a_device_out_of_range_is_an_argument_error),
        cmocka_unit_test(a_destroyed_context_leaves_none_current),
        cmocka_unit_test(destroying_a_context_keeps_another_of_the_device),
        cmocka_unit_test(destroying_another_context_keeps_the_current_one),
        cmocka_unit_test(making_null_current_leaves_none_current),
        cmocka_unit_test(functions_are_found_by_name),
        cmocka_unit_test(refused_memory_is_a_memory_error),
        cmocka_unit_test_prestate(old_driver_is_an_opengl_error_with_reasons, arguments[0]),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
