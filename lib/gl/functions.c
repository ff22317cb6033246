// functions.c - table of OpenGL functions, loaded once per context. It is private, so that it
// collides with no loader.
#include "lib/gl/commands.h"

#include <string.h>

#include "lib/base/math.h"
#include "lib/gl/capture.h"

#define MAX_OWN_SIZE 65521u // Bytes. See hair_gl.own_buffer.

// Load one function. ISO C has no cast from void* to a function pointer, but both have the same
// bytes wherever there is OpenGL.
static bool find_function(const hair_context_desc* desc, const char* name, void* function)
{
    void* address = desc->get_proc(name, desc->get_proc_user);
    memcpy(function, &address, sizeof address);
    return address != NULL;
}

// Older headers of OpenGL lack the constants of KHR_shader_subgroup.
#ifndef GL_SUBGROUP_SIZE_KHR
#define GL_SUBGROUP_SIZE_KHR 0x9532
#define GL_SUBGROUP_SUPPORTED_STAGES_KHR 0x9533
#define GL_SUBGROUP_SUPPORTED_FEATURES_KHR 0x9534
#define GL_SUBGROUP_FEATURE_BASIC_BIT_KHR 0x1
#define GL_SUBGROUP_FEATURE_VOTE_BIT_KHR 0x2
#define GL_SUBGROUP_FEATURE_ARITHMETIC_BIT_KHR 0x4
#define GL_SUBGROUP_FEATURE_BALLOT_BIT_KHR 0x8
#define GL_SUBGROUP_FEATURE_SHUFFLE_BIT_KHR 0x10
#endif

static void APIENTRY ignore_names(GLsizei count, const GLuint* names)
{
    (void)count, (void)names;
}

static void APIENTRY ignore_name(GLuint name)
{
    (void)name;
}

static void APIENTRY ignore_sync(GLsync sync)
{
    (void)sync;
}

// clang-format off
#define DELETIONS(DELETION)                                                                 \
    DELETION(DeleteBuffers, ignore_names) DELETION(DeleteFramebuffers, ignore_names)        \
    DELETION(DeleteQueries, ignore_names) DELETION(DeleteSamplers, ignore_names)            \
    DELETION(DeleteTextures, ignore_names) DELETION(DeleteTransformFeedbacks, ignore_names) \
    DELETION(DeleteVertexArrays, ignore_names) DELETION(DeleteProgram, ignore_name)         \
    DELETION(DeleteShader, ignore_name) DELETION(DeleteSync, ignore_sync)
// clang-format on

void hair_gl_ignore_deletions(struct hair_gl* gl)
{
#define DELETION(name, ignore) gl->name = ignore;
    DELETIONS(DELETION)
#undef DELETION
}

void hair_gl_copy_deletions(const struct hair_gl* from, struct hair_gl* to)
{
#define DELETION(name, ignore) to->name = from->name;
    DELETIONS(DELETION)
#undef DELETION
}

// Find how to tell later whether the context that is current now is current again.
static void find_own_context(struct hair_gl* gl, const hair_context_desc* desc)
{
    static const char* const names[] = {"eglGetCurrentContext", "wglGetCurrentContext",
                                        "glXGetCurrentContext"};
    // Some drivers have a function for every name that begins with "gl". It returns nonsense.
    int count = desc->get_proc("glXHairIsThere", desc->get_proc_user) ? 2 : 3;
    for (int i = 0; i < count; ++i) {
        if (find_function(desc, names[i], &gl->get_current)) gl->own_context = gl->get_current();
        if (gl->own_context) return;
    }
    gl->get_current = NULL;
    // A fence would not do: NVIDIA's driver knows the fence of one context in another.
    gl->own_size = 1 + (GLint)(hair_hash((uint32_t)(uintptr_t)gl) % MAX_OWN_SIZE);
    gl->CreateBuffers(1, &gl->own_buffer);
    if (gl->own_buffer) gl->NamedBufferStorage(gl->own_buffer, gl->own_size, NULL, 0);
}

bool hair_gl_is_current(const struct hair_gl* gl)
{
    if (gl->get_current) return gl->get_current() == gl->own_context;
    GLint size = 0;
    if (!gl->GetString(GL_VERSION) || !gl->IsBuffer(gl->own_buffer)) return false;
    gl->GetNamedBufferParameteriv(gl->own_buffer, GL_BUFFER_SIZE, &size);
    return size == gl->own_size;
}

bool hair_gl_find_loss(struct hair_gl* gl)
{
    gl->is_lost = gl->is_lost || gl->GetGraphicsResetStatus() != GL_NO_ERROR;
    return gl->is_lost;
}

static bool has_extension(const struct hair_gl* gl, const char* name)
{
    GLint count = 0;
    gl->GetIntegerv(GL_NUM_EXTENSIONS, &count);
    for (GLint i = 0; i < count; ++i) {
        const char* other = (const char*)gl->GetStringi(GL_EXTENSIONS, (GLuint)i);
        if (other && strcmp(other, name) == 0) return true;
    }
    return false;
}

// Return whether a work group of 32 threads is one subgroup with the operations of
// glsl/sim/thread_mapping.glsl. Mesa also reports 32, but may run the group as two or four.
static bool find_subgroup(const struct hair_gl* gl)
{
    const char* vendor = (const char*)gl->GetString(GL_VENDOR);
    const GLint features = GL_SUBGROUP_FEATURE_BASIC_BIT_KHR | GL_SUBGROUP_FEATURE_VOTE_BIT_KHR |
                           GL_SUBGROUP_FEATURE_ARITHMETIC_BIT_KHR | GL_SUBGROUP_FEATURE_BALLOT_BIT_KHR |
                           GL_SUBGROUP_FEATURE_SHUFFLE_BIT_KHR;
    GLint size = 0, stages = 0, there = 0;
    if (!vendor || !strstr(vendor, "NVIDIA") || !has_extension(gl, "GL_KHR_shader_subgroup")) return false;
    gl->GetIntegerv(GL_SUBGROUP_SIZE_KHR, &size);
    gl->GetIntegerv(GL_SUBGROUP_SUPPORTED_STAGES_KHR, &stages);
    gl->GetIntegerv(GL_SUBGROUP_SUPPORTED_FEATURES_KHR, &there);
    return size == 32 && (stages & GL_COMPUTE_SHADER_BIT) && (there & features) == features;
}

hair_result hair_gl_load(struct hair_gl* gl, const hair_context_desc* desc)
{
    const hair_host* host = &gl->host;
    if (!find_function(desc, "glGetIntegerv", &gl->GetIntegerv) ||
        !find_function(desc, "glGetString", &gl->GetString))
        return hair_fail(host, HAIR_ERROR_OPENGL, "hair_context_desc.get_proc does not find glGetIntegerv");
    if (!gl->GetString(GL_VERSION))
        return hair_fail(host, HAIR_ERROR_OPENGL, "no OpenGL context is current on this thread");
    GLint major = 0, minor = 0;
    gl->GetIntegerv(GL_MAJOR_VERSION, &major);
    gl->GetIntegerv(GL_MINOR_VERSION, &minor);
    if (major * 10 + minor < 45)
        return hair_fail(host, HAIR_ERROR_OPENGL, "the OpenGL context is version %d.%d, not 4.5 or newer",
                         major, minor);
#define FUNCTION(type, name, parameters)                                                                     \
    if (!find_function(desc, "gl" #name, &gl->name))                                                         \
        return hair_fail(host, HAIR_ERROR_OPENGL, "hair_context_desc.get_proc does not find gl" #name);
#include "lib/gl/functions.inl"
#undef FUNCTION
    find_own_context(gl, desc);
    const char* renderer = (const char*)gl->GetString(GL_RENDERER);
    gl->software = renderer && (strstr(renderer, "llvmpipe") || strstr(renderer, "softpipe") ||
                                strstr(renderer, "SwiftShader"));
    gl->records = !gl->software;
    gl->dispatch_ms = HAIR_GL_DISPATCH_MS;
    gl->draw_vertices = HAIR_GL_DRAW_VERTICES;
    gl->GetIntegerv(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &gl->max_storage_bytes);
    gl->GetIntegerv(GL_MAX_TEXTURE_BUFFER_SIZE, &gl->max_buffer_texels);
    gl->compiles_late = gl->software != 0;
    gl->subgroup = find_subgroup(gl);
    if (gl->subgroup && has_extension(gl, "GL_NV_shader_thread_group"))
        gl->GetIntegerv(GL_SM_COUNT_NV, &gl->units);
    gl->long_atomics =
        has_extension(gl, "GL_ARB_gpu_shader_int64") && has_extension(gl, "GL_NV_shader_atomic_int64");
    gl->parallel = has_extension(gl, "GL_KHR_parallel_shader_compile") ||
                   has_extension(gl, "GL_ARB_parallel_shader_compile");
    if (!find_function(desc, "glMaxShaderCompilerThreadsKHR", &gl->max_compiler_threads))
        find_function(desc, "glMaxShaderCompilerThreadsARB", &gl->max_compiler_threads);
    return HAIR_OK;
}

static hair_result make_objects(struct hair_gl* gl)
{
    static const float far_away[2][4] = {{1, 1, 1, 1}, {0, 0, 0, 0}};
    gl->CreateVertexArrays(1, &gl->vertex_array);
    gl->CreateSamplers(2, gl->shadow_sampler);
    if (!gl->vertex_array || !gl->shadow_sampler[0] || !gl->shadow_sampler[1])
        return hair_fail(&gl->host, HAIR_ERROR_OPENGL, "the driver makes no vertex array or sampler");
    for (int i = 0; i < 2; ++i) {
        GLuint sampler = gl->shadow_sampler[i];
        gl->SamplerParameteri(sampler, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
        gl->SamplerParameteri(sampler, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
        gl->SamplerParameteri(sampler, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_BORDER);
        gl->SamplerParameteri(sampler, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_BORDER);
        gl->SamplerParameteri(sampler, GL_TEXTURE_COMPARE_MODE, GL_NONE);
        gl->SamplerParameterfv(sampler, GL_TEXTURE_BORDER_COLOR, far_away[i]);
    }
    return HAIR_OK;
}

hair_result hair_gl_create(struct hair_gl* gl, const hair_host* host, const hair_context_desc* desc)
{
    memset(gl, 0, sizeof *gl);
    gl->host = *host;
    gl->state_policy = desc->gl_state;
    gl->timings = (int)desc->timings;
    gl->program_generation = 1;
    if (desc->cache) gl->cache = *desc->cache;
    if (desc->glsl_dir) {
        size_t size = strlen(desc->glsl_dir) + 1;
        gl->glsl_dir = hair_alloc(host, size, 1);
        if (!gl->glsl_dir) return hair_fail_memory(host, "hair_context_desc.glsl_dir");
        memcpy(gl->glsl_dir, desc->glsl_dir, size);
    }
    hair_result result = hair_gl_load(gl, desc);
    if (!result && hair_gl_find_loss(gl))
        result = hair_fail(host, HAIR_ERROR_CONTEXT_LOST, "the OpenGL context is lost");
    if (!result) result = hair_gl_check_capture(gl, "a new context");
    if (!result) {
        hair_gl_enter(gl);
        result = make_objects(gl);
        if (!result) result = hair_gl_find_driver_quirks(gl);
        hair_gl_leave(gl);
    }
    if (result) hair_gl_destroy(gl);
    return result;
}

void hair_gl_destroy(struct hair_gl* gl)
{
    hair_gl_free_programs(gl);
    hair_gl_free_recorder(gl);
    if (gl->vertex_array) gl->DeleteVertexArrays(1, &gl->vertex_array);
    if (gl->own_buffer) gl->DeleteBuffers(1, &gl->own_buffer);
    if (gl->idle_feedback) gl->DeleteTransformFeedbacks(1, &gl->idle_feedback);
    if (gl->shadow_sampler[0] || gl->shadow_sampler[1]) gl->DeleteSamplers(2, gl->shadow_sampler);
    hair_free(&gl->host, gl->memory.allocations);
    hair_free(&gl->host, gl->glsl_dir);
    memset(gl, 0, sizeof *gl);
}
