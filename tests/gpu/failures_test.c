// failures_test.c - OpenGL that is missing or too old and memory that is refused: the right code, one
// sentence, nothing leaked, and afterwards it works.
#define _POSIX_C_SOURCE 200809L
#include "tests/support/support.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "lib/api/api.h"
#include "tests/support/handmade.h"
#include "tests/support/shell.h"

#define refused hair_test_refused

static hair_instance* make(struct hair_test* test, hair_groom** groom)
{
    hair_instance* hair = NULL;
    hair_desc      desc = hair_desc_default();
    *groom              = hair_test_groom(&test->host.host, hair_test_handmade_default());
    hair_test_ok(test, hair_create(test->context, *groom, &desc, &hair));
    return hair;
}

static void drop(hair_instance* hair, hair_groom* groom)
{
    hair_destroy(hair);
    hair_groom_destroy(groom);
}

// OpenGL that is not there ---------------------------------------------------------------------------------

static void without_a_current_context_every_call_says_so(void** state)
{
    struct hair_test* test = *state;
    hair_groom*       groom;
    hair_instance*    hair = make(test, &groom);
    hair_instance*    other;
    hair_desc         desc = hair_desc_default();
    hair_view         view = hair_view_default();
    hair_context_desc of   = hair_context_desc_default();
    hair_context*     context;
    float             positions[3];
    uint32_t          count;
    size_t            size;
    const char*       words = "no OpenGL context is current";
    of.host                 = &test->host.host;
    of.get_proc             = hair_egl_get_proc;
    hair_egl_make_current(NULL);
    refused(test, hair_context_create(&of, &context), HAIR_ERROR_OPENGL, words);
    refused(test, hair_context_reload(test->context), HAIR_ERROR_OPENGL, words);
    refused(test, hair_create(test->context, groom, &desc, &other), HAIR_ERROR_OPENGL, words);
    refused(test, hair_step(hair, 0.1f), HAIR_ERROR_OPENGL, words);
    refused(test, hair_reset(hair), HAIR_ERROR_OPENGL, words);
    refused(test, hair_teleport(hair, desc.transform), HAIR_ERROR_OPENGL, words);
    refused(test, hair_save(hair, NULL, 0, &size), HAIR_ERROR_OPENGL, words);
    refused(test, hair_load(hair, positions, sizeof positions), HAIR_ERROR_OPENGL, words);
    refused(test, hair_draw(hair, &view), HAIR_ERROR_OPENGL, words);
    refused(test, hair_read(hair, HAIR_READ_GUIDES, positions, 1, &count), HAIR_ERROR_OPENGL, words);
    hair_egl_make_current(test->egl);
    hair_test_ok(test, hair_step(hair, 0.1f));
    drop(hair, groom);
}

static void* all_but_one(const char* name, void* user)
{
    return strcmp(name, user) == 0 ? NULL : hair_egl_get_proc(name, NULL);
}

static void each_missing_function_is_named(void** state)
{
    static const char* const names[] = {
#define FUNCTION(type, name, parameters) "gl" #name,
#include "lib/gl/functions.inl"
#undef FUNCTION
    };
    struct hair_test* test = *state;
    for (size_t i = 0; i < sizeof names / sizeof *names; ++i) {
        hair_context*     context = NULL;
        hair_context_desc desc    = hair_context_desc_default();
        desc.host                 = &test->host.host;
        desc.get_proc             = all_but_one;
        desc.get_proc_user        = (void*)(uintptr_t)names[i];
        // Without the first two the version cannot be asked.
        int         first = strcmp(names[i], "glGetIntegerv") == 0 || strcmp(names[i], "glGetString") == 0;
        const char* words = first ? "get_proc does not find glGet" : names[i];
        refused(test, hair_context_create(&desc, &context), HAIR_ERROR_OPENGL, words);
        assert_null(context);
    }
}

static void glsl_that_is_not_there_or_wrong_is_an_opengl_error(void** state)
{
    struct hair_test* test    = *state;
    hair_context*     context = NULL;
    hair_context_desc desc    = hair_context_desc_default();
    desc.host                 = &test->host.host;
    desc.get_proc             = hair_egl_get_proc;
    desc.glsl_dir             = "/nonexistent";
    assert_int_equal(hair_context_create(&desc, &context), HAIR_ERROR_OPENGL);
    assert_null(context);
    assert_non_null(strstr(test->host.sentence, "is not there"));
    hair_test_forgive(test);
    desc.glsl_dir = "glsl";
    hair_test_ok(test, hair_context_create(&desc, &context));
    hair_test_ok(test, hair_context_reload(context));
    hair_context_destroy(context);
}

static void expect(int code, const char* command)
{
    hair_test_shell_expect(code, command, "");
}

// Programs that depend on how long guides are wait for the first that long.
static void a_shader_that_hair_create_finds_broken_is_an_opengl_error(void** state)
{
    struct hair_test* test    = *state;
    hair_context*     context = NULL;
    hair_context_desc of      = hair_context_desc_default();
    of.host                   = &test->host.host;
    of.get_proc               = hair_egl_get_proc;
    of.glsl_dir               = hair_test_folder();
    expect(0, "cp -r glsl/* $D && sed -i '/^void main/i broken' $D/sim/redblack.comp");
    hair_test_ok(test, hair_context_create(&of, &context));

    struct hair_test_handmade wanted = hair_test_handmade_default();
    hair_groom*               groom  = hair_test_groom(&test->host.host, wanted);
    hair_instance*            hair   = NULL;
    hair_desc                 desc   = hair_desc_default();
    assert_int_equal(hair_create(context, groom, &desc, &hair), HAIR_ERROR_OPENGL);
    assert_null(hair);
    assert_string_equal(test->host.sentence, "shader glsl/sim/redblack.comp does not compile");
    hair_test_forgive(test);

    expect(0, "cp glsl/sim/redblack.comp $D/sim");
    hair_test_ok(test, hair_create(context, groom, &desc, &hair));
    // Broken again: the last good program goes on, and what needs another size of it is told.
    expect(0, "sed -i '/^void main/i broken' $D/sim/redblack.comp");
    assert_int_equal(hair_context_reload(context), HAIR_ERROR_OPENGL);
    hair_test_forgive(test);
    hair_test_ok(test, hair_step(hair, 1.0f / 60));
    wanted.fewest = wanted.most = 33;
    hair_groom*    longer       = hair_test_groom(&test->host.host, wanted);
    hair_instance* other        = NULL;
    assert_int_equal(hair_create(context, longer, &desc, &other), HAIR_ERROR_OPENGL);
    assert_null(other);
    hair_test_forgive(test);
    drop(hair, groom);
    hair_groom_destroy(longer);
    hair_context_destroy(context);
}

// Mesa chooses its driver once in a process, so this one is asked for in a child. softpipe is OpenGL 3.3.
static int exit_code_of_an_old_driver(void)
{
    struct hair_test_host host;
    hair_egl*             egl     = NULL;
    hair_context*         context = NULL;
    hair_test_host_init(&host);
    if (hair_egl_create(&host.host, -1, &egl) != HAIR_ERROR_OPENGL || egl) return 1;
    hair_context_desc desc = hair_context_desc_default();
    desc.host              = &host.host;
    desc.get_proc          = hair_egl_get_proc;
    if (hair_context_create(&desc, &context) != HAIR_ERROR_OPENGL || context) return 2;
    return host.blocks ? 3 : 0;
}

static void a_driver_that_is_too_old_is_an_opengl_error(void** state)
{
    (void)state;
    if (!strstr((const char*)glGetString(GL_RENDERER), "llvmpipe"))
        skip(); // No other has an old one beside it.
    pid_t child = fork();
    if (child == 0) {
        setenv("GALLIUM_DRIVER", "softpipe", 1);
        setenv("LIBGL_ALWAYS_SOFTWARE", "1", 1);
        execl("/proc/self/exe", "failures_test", "old-driver", (char*)NULL);
        _exit(127);
    }
    int status;
    assert_int_equal(waitpid(child, &status, 0), child);
    assert_true(WIFEXITED(status));
    assert_int_equal(WEXITSTATUS(status), 0);
}

// An older version than the driver's own, by a host that says so.
static void APIENTRY old_version(GLenum name, GLint* out)
{
    glGetIntegerv(name, out);
    if (name == GL_MINOR_VERSION) *out = 3;
}

static void* with_old_version(const char* name, void* user)
{
    (void)user;
    if (strcmp(name, "glGetIntegerv")) return hair_egl_get_proc(name, NULL);
    void (*function)(GLenum, GLint*) = old_version;
    void* address;
    memcpy(&address, &function, sizeof address);
    return address;
}

static void an_old_context_is_told_its_version(void** state)
{
    struct hair_test* test    = *state;
    hair_context*     context = NULL;
    hair_context_desc desc    = hair_context_desc_default();
    desc.host                 = &test->host.host;
    desc.get_proc             = with_old_version;
    refused(test, hair_context_create(&desc, &context), HAIR_ERROR_OPENGL, "version 4.3, not 4.5 or newer");
}

// Memory that is refused -----------------------------------------------------------------------------------

// Objects of OpenGL that are alive, by trying names.
static uint32_t count_objects(void)
{
    uint32_t count = 0;
    for (GLuint name = 1; name < 512; ++name)
        count += (uint32_t)glIsBuffer(name) + glIsTexture(name) + glIsProgram(name) + glIsShader(name) +
                 glIsVertexArray(name) + glIsSampler(name) + glIsFramebuffer(name) +
                 glIsTransformFeedback(name) + glIsQuery(name);
    return count;
}

struct user {
    struct hair_test* test;
    hair_groom*       groom;
    hair_instance*    hair;
};

// Refuse the first allocation, then the second, … until there are no more: each time the call fails, leaks
// nothing, and works when it is made again. After the first 32 only every `stride`-th: shaders are many and
// read alike.
static void torture(struct hair_test* test, hair_result (*call)(struct user*), struct user* user,
                    uint32_t stride)
{
    uint32_t objects = count_objects(), blocks = test->host.blocks;
    for (uint32_t n = 1; n < 2000; n += n < 32 ? 1 : stride) {
        test->host.allocations = 0;
        test->host.refuse      = n;
        hair_result result     = call(user);
        test->host.refuse      = 0;
        assert_int_equal(test->host.blocks, blocks);
        assert_int_equal(count_objects(), objects);
        if (test->host.allocations < n) {
            hair_test_ok(test, result);
            print_message("    %u allocations\n", test->host.allocations);
            assert_true(n > 1);
            return;
        }
        if (result != HAIR_ERROR_MEMORY) fail_msg("allocation %u: %s", n, hair_result_string(result));
        assert_true(hair_test_forgive(test) >= 1);
        assert_non_null(strstr(test->host.sentence, "out of memory for "));
        if (n % 32 == 1) hair_test_ok(test, call(user));
        assert_int_equal(test->host.blocks, blocks);
    }
    fail_msg("there is no end of allocations");
}

static hair_result create_context(struct user* user)
{
    hair_context*     context = NULL;
    hair_context_desc desc    = hair_context_desc_default();
    desc.host                 = &user->test->host.host;
    desc.get_proc             = hair_egl_get_proc;
    desc.glsl_dir             = "glsl";
    hair_result    result     = hair_context_create(&desc, &context);
    hair_instance* hair       = NULL;
    hair_desc      of         = hair_desc_default();
    assert_true((result == HAIR_OK) == (context != NULL));
    if (!result)
        result = hair_create(context, user->groom, &of, &hair); // Compiles what it is the first to need.
    assert_true((result == HAIR_OK) == (hair != NULL));
    hair_destroy(hair);
    hair_context_destroy(context);
    return result;
}

static hair_result create_instance(struct user* user)
{
    hair_instance* hair   = NULL;
    hair_desc      desc   = hair_desc_default();
    hair_result    result = hair_create(user->test->context, user->groom, &desc, &hair);
    assert_true((result == HAIR_OK) == (hair != NULL));
    hair_destroy(hair);
    return result;
}

static hair_result read_all(struct user* user)
{
    hair_result result = HAIR_OK;
    for (int what = 0; what < 3 && !result; ++what) {
        float    positions[30];
        uint32_t count;
        result = hair_read(user->hair, (hair_read_what)what, positions, 10, &count);
    }
    return result;
}

static hair_result save_and_load(struct user* user)
{
    static unsigned char bytes[65536];
    size_t               size   = 0;
    hair_result          result = hair_save(user->hair, bytes, sizeof bytes, &size);
    return result ? result : hair_load(user->hair, bytes, size);
}

static void refused_memory_leaks_nothing_and_a_retry_works(void** state)
{
    struct user user = {.test = *state};
    user.hair        = make(user.test, &user.groom);
    torture(user.test, create_instance, &user, 1);
    torture(user.test, read_all, &user, 1);
    torture(user.test, save_and_load, &user, 1);
    drop(user.hair, user.groom);
}

static void a_context_without_memory_leaks_nothing_and_a_retry_works(void** state)
{
    struct user user = {.test = *state};
    user.groom       = hair_test_groom(&user.test->host.host, hair_test_handmade_default());
    torture(user.test, create_context, &user, 19);
    hair_groom_destroy(user.groom);
}

int main(int count, char** arguments)
{
    if (count == 2 && !strcmp(arguments[1], "old-driver")) return exit_code_of_an_old_driver();
    if (hair_test_skips()) return 0;
    const struct CMUnitTest tests[] = {
        HAIR_TEST(without_a_current_context_every_call_says_so),
        HAIR_TEST(each_missing_function_is_named),
        HAIR_TEST(glsl_that_is_not_there_or_wrong_is_an_opengl_error),
        HAIR_TEST(a_shader_that_hair_create_finds_broken_is_an_opengl_error),
        HAIR_TEST(a_driver_that_is_too_old_is_an_opengl_error),
        HAIR_TEST(an_old_context_is_told_its_version),
        HAIR_TEST(refused_memory_leaks_nothing_and_a_retry_works),
        HAIR_TEST(a_context_without_memory_leaks_nothing_and_a_retry_works),
    };
    if (hair_test_shell_start("/bin/sh")) return 1;
    int failed = cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
    return hair_test_shell_finish() ? 1 : failed;
}
