// failures_test.c - OpenGL that is missing or too old, and shaders that are broken. The library
// returns the right code and logs one message. Afterwards it works.
#define _POSIX_C_SOURCE 200809L
#include "tests/support/scene.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tests/support/shell.h"
#include "tests/support/ways.h"
#include "tests/support/tessellated.h"

#define refused hair_test_refused

// Missing OpenGL ----------------------------------------------------------------------------------

static void calls_without_a_current_context_are_opengl_errors(void** state)
{
    struct hair_test_scene f = hair_test_scene_of(*state, NULL, NULL);
    hair_instance* other;
    hair_desc desc = hair_desc_default();
    hair_view view = hair_test_tessellated();
    hair_context_desc of = hair_context_desc_default();
    hair_context* context;
    float positions[3];
    uint32_t count;
    size_t size;
    hair_solver_stats solver_stats = hair_solver_stats_default();
    hair_field_info field = hair_field_info_default();
    const char* words = "no OpenGL context is current";
    of.host = &f.test->host.host;
    of.get_proc = hair_egl_get_proc;
    hair_egl_make_current(NULL);
    refused(f.test, hair_context_create(&of, &context), HAIR_ERROR_OPENGL, words);
    refused(f.test, hair_context_reload(f.test->context), HAIR_ERROR_OPENGL, words);
    refused(f.test, hair_create(f.test->context, f.groom, &desc, &other), HAIR_ERROR_OPENGL, words);
    refused(f.test, hair_step(f.hair, 0.1f), HAIR_ERROR_OPENGL, words);
    refused(f.test, hair_reset(f.hair), HAIR_ERROR_OPENGL, words);
    refused(f.test, hair_teleport(f.hair, desc.transform), HAIR_ERROR_OPENGL, words);
    refused(f.test, hair_save(f.hair, NULL, 0, &size), HAIR_ERROR_OPENGL, words);
    refused(f.test, hair_load(f.hair, positions, sizeof positions), HAIR_ERROR_OPENGL, words);
    refused(f.test, hair_draw(f.hair, &view), HAIR_ERROR_OPENGL, words);
    refused(f.test, hair_read_positions(f.hair, HAIR_READ_GUIDES, positions, 1, &count), HAIR_ERROR_OPENGL,
            words);
    refused(f.test, hair_get_solver_stats(f.hair, &solver_stats), HAIR_ERROR_OPENGL, words);
    refused(f.test, hair_get_field(f.hair, &field), HAIR_ERROR_OPENGL, words);
    hair_egl_make_current(f.test->egl);
    hair_test_ok(f.test, hair_step(f.hair, 0.1f));
    hair_test_scene_free(&f);
}

static void* all_but_one(const char* name, void* user)
{
    return strcmp(name, user) == 0 ? NULL : hair_egl_get_proc(name, NULL);
}

static void missing_opengl_functions_are_named(void** state)
{
    static const char* const names[] = {
#define FUNCTION(type, name, parameters) "gl" #name,
#include "lib/gl/functions.inl"
#undef FUNCTION
    };
    struct hair_test* test = *state;
    for (size_t i = 0; i < sizeof names / sizeof *names; ++i) {
        hair_context* context = NULL;
        hair_context_desc desc = hair_context_desc_default();
        desc.host = &test->host.host;
        desc.get_proc = all_but_one;
        desc.get_proc_user = (void*)(uintptr_t)names[i];
        // Without the first two functions the library cannot ask for the version.
        int first = strcmp(names[i], "glGetIntegerv") == 0 || strcmp(names[i], "glGetString") == 0;
        const char* words = first ? "get_proc does not find glGet" : names[i];
        refused(test, hair_context_create(&desc, &context), HAIR_ERROR_OPENGL, words);
        assert_null(context);
    }
}

static void missing_or_invalid_glsl_is_an_opengl_error(void** state)
{
    struct hair_test* test = *state;
    hair_context* context = NULL;
    hair_context_desc desc = hair_context_desc_default();
    desc.host = &test->host.host;
    desc.get_proc = hair_egl_get_proc;
    desc.glsl_dir = "/nonexistent";
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

// A context with a shader that is broken later. Programs of solvers are compiled for the first hair
// that needs them.
struct broken {
    hair_context* context;
    hair_desc desc;
    const char* file;
    hair_groom* groom;
    hair_instance* hair;
};

static void break_shader(const struct broken* b)
{
    char command[128];
    snprintf(command, sizeof command, "sed -i '/^void main/i broken' $D/sim/%s", b->file);
    expect(0, command);
}
static void mend_shader(const struct broken* b)
{
    char command[128];
    snprintf(command, sizeof command, "cp glsl/sim/%s $D/sim", b->file);
    expect(0, command);
}

static void hair_create_finds_it(struct hair_test* test, struct broken* b)
{
    char sentence[128];
    snprintf(sentence, sizeof sentence, "shader glsl/sim/%s does not compile", b->file);
    break_shader(b);
    assert_int_equal(hair_create(b->context, b->groom, &b->desc, &b->hair), HAIR_ERROR_OPENGL);
    assert_null(b->hair);
    assert_string_equal(test->host.sentence, sentence);
    hair_test_forgive(test);
    mend_shader(b);
    hair_test_ok(test, hair_create(b->context, b->groom, &b->desc, &b->hair));
}

// Check that the last good program stays in use, and that hair that needs another program fails.
static void a_reload_finds_it(struct hair_test* test, struct broken* b)
{
    struct hair_test_handmade wanted = hair_test_handmade_default();
    hair_instance* other = NULL;
    break_shader(b);
    assert_int_equal(hair_context_reload(b->context), HAIR_ERROR_OPENGL);
    hair_test_forgive(test);
    hair_test_ok(test, hair_step(b->hair, 1.0f / 60));
    wanted.fewest = wanted.max = 33;
    hair_groom* longer = hair_test_groom(&test->host.host, wanted);
    assert_int_equal(hair_create(b->context, longer, &b->desc, &other), HAIR_ERROR_OPENGL);
    assert_null(other);
    hair_test_forgive(test);
    hair_groom_destroy(longer);
}

// Check a step with the first collider, which needs a program with contact.
static void hair_step_finds_it(struct hair_test* test, struct broken* b)
{
    static float before[300], after[300];
    uint32_t count;
    hair_collider collider = {HAIR_SHAPE_SPHERE, {0.1f, 0.2f, 0}, {0, 0, 0, 1},
                              {0.05f, 0},        .scale = 1,      .friction = 1};
    hair_test_ok(test, hair_read_positions(b->hair, HAIR_READ_SMOOTH, before, 100, &count));
    hair_test_ok(test, hair_set_colliders(b->hair, &collider, 1, sizeof collider));
    assert_int_equal(hair_step(b->hair, 1.0f / 60), HAIR_ERROR_OPENGL);
    hair_test_forgive(test);
    hair_test_ok(test, hair_read_positions(b->hair, HAIR_READ_SMOOTH, after, 100, &count));
    assert_memory_equal(before, after, sizeof before);
    mend_shader(b);
    hair_test_ok(test, hair_step(b->hair, 1.0f / 60));
}

static void solver_with_a_broken_shader_is_an_opengl_error(void** state)
{
    struct hair_test* test = *state;
    expect(0, "cp -r glsl/* $D");
    // Workgroup per guide, thread per guide, and redblack.
    for (int way = 0; way < HAIR_TEST_WAYS; way += 3) {
        hair_context_desc of = hair_context_desc_default();
        struct broken b = {.desc = hair_test_way(way)};
        of.host = &test->host.host;
        of.get_proc = hair_egl_get_proc;
        of.glsl_dir = hair_test_folder();
        b.file = b.desc.solver == HAIR_SOLVER_REDBLACK ? "redblack.comp"
                 : b.desc.solver == HAIR_SOLVER_FOLLOW ? "rod.comp"
                                                       : "mixed.comp";
        b.groom = hair_test_groom(&test->host.host, hair_test_handmade_default());
        hair_test_ok(test, hair_context_create(&of, &b.context));
        hair_create_finds_it(test, &b);
        a_reload_finds_it(test, &b);
        if (b.desc.solver != HAIR_SOLVER_REDBLACK) hair_step_finds_it(test, &b);
        mend_shader(&b);
        hair_destroy(b.hair);
        hair_groom_destroy(b.groom);
        hair_context_destroy(b.context);
    }
}

// Return the exit code of a child that asks for softpipe, which is OpenGL 3.3. It needs a child
// because Mesa chooses its driver once in a process.
static int exit_code_of_an_old_driver(void)
{
    struct hair_test_host host;
    hair_egl* egl = NULL;
    hair_context* context = NULL;
    hair_test_host_init(&host);
    if (hair_egl_create(&host.host, -1, &egl) != HAIR_ERROR_OPENGL || egl) return 1;
    hair_context_desc desc = hair_context_desc_default();
    desc.host = &host.host;
    desc.get_proc = hair_egl_get_proc;
    if (hair_context_create(&desc, &context) != HAIR_ERROR_OPENGL || context) return 2;
    return host.blocks ? 3 : 0;
}

static void driver_older_than_4_5_is_an_opengl_error(void** state)
{
    (void)state;
    if (!strstr((const char*)glGetString(GL_RENDERER), "llvmpipe"))
        skip(); // No other driver has an old one beside it.
    pid_t child = fork();
    if (child == 0) {
        unsetenv("MESA_LOADER_DRIVER_OVERRIDE"); // zink runs above llvmpipe too.
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

// Return an older version than the driver's own.
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

static void error_of_an_old_context_has_its_version(void** state)
{
    struct hair_test* test = *state;
    hair_context* context = NULL;
    hair_context_desc desc = hair_context_desc_default();
    desc.host = &test->host.host;
    desc.get_proc = with_old_version;
    refused(test, hair_context_create(&desc, &context), HAIR_ERROR_OPENGL, "version 4.3, not 4.5 or newer");
}

int main(int count, char** arguments)
{
    if (count == 2 && !strcmp(arguments[1], "old-driver")) return exit_code_of_an_old_driver();
    if (hair_test_skips()) return 0;
    const struct CMUnitTest tests[] = {
        HAIR_TEST(calls_without_a_current_context_are_opengl_errors),
        HAIR_TEST(missing_opengl_functions_are_named),
        HAIR_TEST(missing_or_invalid_glsl_is_an_opengl_error),
        HAIR_TEST(solver_with_a_broken_shader_is_an_opengl_error),
        HAIR_TEST(driver_older_than_4_5_is_an_opengl_error),
        HAIR_TEST(error_of_an_old_context_has_its_version),
    };
    if (hair_test_shell_start("/bin/sh")) return 1;
    int failed = cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
    return hair_test_shell_finish(NULL) ? 1 : failed;
}
