// support.c - an OpenGL context and a hair_context for every test program that needs them.
#include "tests/support/support.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "lib/api/api.h"
#include "lib/gl/recorder.h"

int hair_test_skips(void)
{
    hair_egl* egl = NULL;
    if (hair_egl_create(NULL, -1, &egl) == HAIR_OK) {
        hair_egl_destroy(egl);
        return 0;
    }
    const char* wanted = getenv("HAIR_TEST");
    fprintf(stderr, "there is no OpenGL 4.5 here\n");
    if (wanted && strcmp(wanted, "required") == 0) exit(1);
    return 1;
}

static void APIENTRY listen(GLenum source, GLenum type, GLuint id, GLenum severity, GLsizei length,
                            const GLchar* message, const void* user)
{
    (void)source, (void)id, (void)severity, (void)length, (void)user;
    if (type == GL_DEBUG_TYPE_ERROR) fprintf(stderr, "%s\n", message);
}

int hair_test_start(void** state)
{
    struct hair_test* test = calloc(1, sizeof *test);
    if (!test) return -1;
    *state = test;
    hair_test_host_init(&test->host);
    if (hair_egl_create(&test->host.host, -1, &test->egl)) return -1;
    glEnable(GL_DEBUG_OUTPUT);
    glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
    glDebugMessageCallback(listen, NULL);
    hair_context_desc desc = hair_context_desc_default();
    desc.host = &test->host.host;
    desc.get_proc = hair_egl_get_proc;
    if (hair_context_create(&desc, &test->context)) {
        fprintf(stderr, "%s\n", test->host.sentence);
        return -1;
    }
    return 0;
}

int hair_test_finish(void** state)
{
    struct hair_test* test = *state;
    hair_context_destroy(test->context);
    hair_egl_destroy(test->egl);
    uint32_t blocks = test->host.blocks;
    if (blocks) fprintf(stderr, "%u blocks of memory were not freed\n", blocks);
    free(test);
    return blocks ? -1 : 0;
}

uint32_t hair_test_blocks(const struct hair_test* test)
{
    const struct hair_gl* gl = &test->context->gl;
    const struct hair_gl_recorder* recorder = gl->recorder;
    uint32_t kept = gl->programs + (gl->program != NULL) + (gl->inputs != NULL);
    if (recorder) kept += 1u + (recorder->stream != NULL) + (recorder->commands != NULL);
    return test->host.blocks - kept;
}

uint64_t hair_test_gpu_bytes(struct hair_test* test)
{
    hair_memory memory = hair_memory_default();
    hair_test_ok(test, hair_get_memory(test->context, &memory));
    return memory.bytes;
}

uint64_t hair_test_sample_bytes(const hair_context* context)
{
    return context->batch.samples.room * sizeof(uint32_t);
}

// Return 1 for a program or a shader that is not deleted. Mesa keeps the program of the last draw
// until the next draw, and a program keeps its shaders.
static uint32_t is_kept(GLuint name)
{
    GLint deleted = 1;
    if (glIsProgram(name)) glGetProgramiv(name, GL_DELETE_STATUS, &deleted);
    if (glIsShader(name)) glGetShaderiv(name, GL_DELETE_STATUS, &deleted);
    return !deleted;
}

uint32_t hair_test_count_objects(void)
{
    uint32_t count = 0;
    for (GLuint name = 1; name < 8192; ++name)
        count += is_kept(name) + (uint32_t)glIsBuffer(name) + glIsTexture(name) + glIsVertexArray(name) +
                 glIsSampler(name) + glIsFramebuffer(name) + glIsTransformFeedback(name) + glIsQuery(name);
    return count;
}

int hair_test_begin(void** state)
{
    struct hair_test* test = *state;
    hair_egl_make_current(test->egl);
    while (glGetError()) {}
    test->blocks = hair_test_blocks(test);
    test->host.errors = 0;
    test->host.refuse = 0;
    *test->host.sentence = 0;
    return 0;
}

int hair_test_end(void** state)
{
    struct hair_test* test = *state;
    GLenum error = glGetError();
    if (error) fprintf(stderr, "OpenGL error 0x%x\n", error);
    if (test->host.errors) fprintf(stderr, "the log has: %s\n", test->host.sentence);
    int left = (int)(hair_test_blocks(test) - test->blocks);
    if (left) fprintf(stderr, "%d blocks of memory were not freed\n", left);
    return error || test->host.errors || left ? -1 : 0;
}

hair_context* hair_test_context(struct hair_test* test, void* (*get_proc)(const char* name, void* user))
{
    hair_context* context = NULL;
    hair_context_desc desc = hair_context_desc_default();
    desc.host = &test->host.host;
    desc.get_proc = get_proc;
    desc.timings = true;
    hair_test_ok(test, hair_context_create(&desc, &context));
    return context;
}

uint32_t hair_test_forgive(struct hair_test* test)
{
    uint32_t errors = test->host.errors;
    test->host.errors = 0;
    return errors;
}

void hair_test_ok(const struct hair_test* test, hair_result result)
{
    if (result) fail_msg("%s: %s", hair_result_string(result), test->host.sentence);
}

void hair_test_refused(struct hair_test* test, hair_result result, hair_result expected, const char* words)
{
    uint32_t errors = hair_test_forgive(test);
    if (result != expected)
        fail_msg("\"%s\" instead of \"%s\" (%s): %s", hair_result_string(result),
                 hair_result_string(expected), words, test->host.sentence);
    if (errors != 1) fail_msg("%u sentences, not one (%s): %s", errors, words, test->host.sentence);
    if (!strstr(test->host.sentence, words)) fail_msg("no \"%s\" in: %s", words, test->host.sentence);
    *test->host.sentence = 0;
}

void hair_test_near(const char* what, size_t i, double a, double b, double tolerance)
{
    double difference = a > b ? a - b : b - a;
    if (!(difference <= tolerance))
        fail_msg("%s %zu: %.9g and %.9g differ by %.3g, more than %.3g", what, i, a, b, difference,
                 tolerance);
}
