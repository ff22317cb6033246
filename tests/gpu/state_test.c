// state_test.c - the application's OpenGL state and error flag are restored, and the library causes
// no OpenGL errors.
#define _POSIX_C_SOURCE 200809L
#include "tests/support/support.h"

#include <epoxy/egl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "lib/groom/groom.h"
#include "tests/support/glstate.h"
#include "tests/support/handmade.h"
#include "tests/support/render_paths.h"
#include "tests/support/ways.h"
#include "tests/support/tessellated.h"

// An application with a debug context of its own, and odd values for all state.
struct fixture {
    struct hair_test_host host;
    hair_egl* egl;
    EGLDisplay display;
    EGLContext debug;
    int planting; // 1 while the application causes an error of its own.
    char message[512]; // The last error that the library caused.
    hair_groom* groom;
    hair_context* context;
    hair_instance* hair;
    GLuint shadow, wind; // Textures of the application.
    hair_gl_state promise;
    int way; // Index of solver and mapping.
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

static void create_textures(struct fixture* f)
{
    glCreateTextures(GL_TEXTURE_2D, 1, &f->shadow);
    glTextureStorage2D(f->shadow, 1, GL_DEPTH_COMPONENT32F, 8, 8);
    glCreateTextures(GL_TEXTURE_3D, 1, &f->wind);
    glTextureStorage3D(f->wind, 1, GL_RGBA16F, 4, 4, 4);
    glClearTexImage(f->wind, 0, GL_RGBA, GL_FLOAT, NULL);
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
    create_textures(f);
    hair_test_glstate_disturb();
    if (glGetError() || *f->message) {
        fprintf(stderr, "the test's own state is in error: %s\n", f->message);
        return -1;
    }
    f->groom = hair_test_groom(&f->host.host, hair_test_handmade_default());
    f->groom->colors =
        hair_alloc(&f->host.host, f->groom->info.follower_count, 8 * 4 * sizeof *f->groom->colors);
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
    hair_groom_destroy(f->groom);
    glPopDebugGroup(); // Mesa loses groups that are still open.
    eglDestroyContext(f->display, f->debug);
    hair_egl_destroy(f->egl);
    int left = (int)f->host.blocks;
    free(f);
    return left;
}

// Make every call that uses OpenGL, in a valid order.
static hair_result create_context(struct fixture* f)
{
    hair_context_desc desc = hair_context_desc_default();
    desc.host = &f->host.host;
    desc.get_proc = hair_egl_get_proc;
    desc.timings = true;
    desc.gl_state = f->promise;
    return hair_context_create(&desc, &f->context);
}
static hair_result reload(struct fixture* f)
{
    return hair_context_reload(f->context);
}
static hair_result create(struct fixture* f)
{
    hair_desc desc = hair_test_way(f->way);
    if (desc.solver == HAIR_SOLVER_REDBLACK)
        // This mapping changes more state than compute.
        desc.thread_mapping = HAIR_THREAD_MAPPING_FEEDBACK;
    desc.hit_method = f->way % 2 ? HAIR_HIT_METHOD_PREPASS : HAIR_HIT_METHOD_COMPUTE;
    return hair_create(f->context, f->groom, &desc, &f->hair);
}
static hair_result step(struct fixture* f)
{
    return hair_step(f->hair, 1.0f / 30);
}
static hair_result step_without_substep(struct fixture* f)
{
    return hair_step(f->hair, 1e-4f);
}
static hair_result reset(struct fixture* f)
{
    return hair_reset(f->hair);
}
static hair_result set_all(struct fixture* f)
{
    hair_physics physics = hair_physics_default();
    hair_look look = hair_look_default();
    hair_desc desc = hair_desc_default();
    hair_wind wind = hair_wind_default();
    hair_collider collider = {HAIR_SHAPE_SPHERE, {0}, {0, 0, 0, 1}, {0.1f, 0}, .scale = 1, .friction = 1};
    wind.model = HAIR_WIND_FLUID;
    wind.fluid.resolution = 16;
    wind.velocity[0] = 1;
    wind.texture = f->wind;
    look.strand.segments = 100; // Draws in two parts.
    physics.damping = 5; // Makes the rods again.
    hair_result result = hair_set_physics(f->hair, &physics);
    if (!result) result = hair_set_look(f->hair, &look);
    if (!result) result = hair_set_wind(f->hair, &wind);
    if (!result) result = hair_set_transform(f->hair, desc.transform);
    return result ? result : hair_set_colliders(f->hair, &collider, 1, sizeof collider);
}
static hair_result teleport(struct fixture* f)
{
    hair_desc desc = hair_desc_default();
    desc.transform[12] = 3;
    return hair_teleport(f->hair, desc.transform);
}
// Number of ways to draw, 5 for each render path. Every pair of path, pass and primitive occurs.
#define DRAWS (5 * HAIR_TEST_PATHS)
static hair_result draw_as(struct fixture* f, int i)
{
    hair_view view = hair_test_tessellated();
    hair_light lights[4];
    hair_lod lod = hair_lod_default();
    int path = i / 5, lit = i % 5 == 4;
    view.render_path = hair_test_paths[path];
    view.pass = (hair_pass)(i % 5 % 4);
    view.primitive =
        path == HAIR_TEST_COMPUTE ? HAIR_PRIMITIVE_RIBBONS : (hair_primitive)((i % 5 + path) % 2);
    view.slice = (hair_slice)(i % 2);
    view.lod = path >= HAIR_TEST_CACHED && i % 5 == 0 ? &lod : NULL;
    for (int k = 0; k < 4; ++k) {
        lights[k] = hair_light_default();
        lights[k].hair_shadow_map = f->shadow;
        lights[k].opaque_shadow_map = f->shadow;
    }
    view.lights = lit ? lights : NULL;
    view.light_count = lit ? 4 : 1;
    // Each path has the occluder depth once without lights and once with lights.
    view.occluder_depth = view.pass == HAIR_PASS_COLOR ? f->shadow : 0;
    return hair_draw(f->hair, &view);
}
static hair_result draw_again(struct fixture* f)
{
    static const int some[] = {0, 1, 2, 3, 4, 5, 10};
    hair_result result = HAIR_OK;
    for (size_t i = 0; i < sizeof some / sizeof *some && !result; ++i) result = draw_as(f, some[i]);
    return result;
}
// Draw in several ways. Only one way of simulation tests all of them, because drawing does not
// depend on it and compilation takes long.
static hair_result draw(struct fixture* f)
{
    int all = !f->way && f->promise == HAIR_GL_STATE_RESTORE;
    hair_result result = all ? HAIR_OK : draw_again(f);
    for (int i = 0; i < DRAWS && !result && all; ++i) result = draw_as(f, i);
    hair_view other = hair_test_tessellated();
    other.pass = HAIR_PASS_WIND;
    if (!result) result = hair_draw(f->hair, &other);
    other.pass = HAIR_PASS_OPACITY;
    return result ? result : hair_draw(f->hair, &other);
}
static hair_result read_all(struct fixture* f)
{
    float positions[300];
    uint32_t count;
    hair_result result = HAIR_OK;
    for (int what = 0; what < 3 && !result; ++what)
        result = hair_read_positions(f->hair, (hair_read_source)what, positions, 100, &count);
    return result;
}
static hair_result prepare(struct fixture* f)
{
    hair_view view = hair_test_tessellated();
    bool ready = false;
    view.render_path = HAIR_RENDER_PATH_CACHED;
    return hair_precompile(f->hair, &view, &ready);
}
static hair_result ask_field(struct fixture* f)
{
    hair_field_info info = hair_field_info_default();
    hair_result result = hair_get_field(f->hair, &info);
    return result || info.distance_texture ? result : HAIR_ERROR_ARGUMENT;
}
static hair_result save_and_load(struct fixture* f)
{
    static unsigned char bytes[65536];
    size_t size = 0;
    hair_result result = hair_save(f->hair, bytes, sizeof bytes, &size);
    return result ? result : hair_load(f->hair, bytes, size);
}
static hair_result time_all(struct fixture* f)
{
    hair_timing timings[32];
    return hair_get_timings(f->context, timings, 32) > 0 ? HAIR_OK : HAIR_ERROR_OPENGL;
}
static hair_result ask_solver_stats(struct fixture* f)
{
    hair_solver_stats solver_stats = hair_solver_stats_default();
    return hair_get_solver_stats(f->hair, &solver_stats);
}
static hair_result destroy(struct fixture* f)
{
    hair_destroy(f->hair);
    return HAIR_OK;
}
static hair_result destroy_context(struct fixture* f)
{
    hair_context_destroy(f->context);
    return HAIR_OK;
}

static const struct {
    const char* name;
    hair_result (*call)(struct fixture*);
} calls[] = {
    {"hair_context_create", create_context},
    {"hair_create", create},
    {"hair_step", step},
    {"hair_step without a substep", step_without_substep},
    {"setters", set_all},
    {"hair_precompile", prepare},
    {"hair_step with a collider", step},
    {"hair_get_field", ask_field},
    {"hair_draw", draw},
    {"hair_read_positions", read_all},
    {"hair_teleport", teleport},
    {"hair_reset", reset},
    {"hair_save and hair_load", save_and_load},
    {"hair_get_timings", time_all},
    {"hair_get_solver_stats", ask_solver_stats},
    {"hair_context_reload", reload},
    {"hair_draw after a reload", draw_again},
    {"hair_destroy", destroy},
    {"hair_context_destroy", destroy_context},
};

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
    for (size_t i = 0; i < sizeof calls / sizeof *calls; ++i) {
        plant_an_error(f);
        hair_result result = calls[i].call(f);
        GLenum planted = glGetError(), other = glGetError();
        if (result) fail_msg("%s: %s", calls[i].name, f->host.sentence);
        if (*f->message) fail_msg("%s: %s", calls[i].name, f->message);
        if (planted != GL_INVALID_ENUM) fail_msg("%s ate the host's error", calls[i].name);
        if (other) fail_msg("%s left the error 0x%x", calls[i].name, other);
        hair_test_glstate_read(&after);
        for (size_t k = 0; k < before->count; ++k) {
            k = hair_test_glstate_differ(before, &after, k);
            if (k == before->count ||
                (f->promise == HAIR_GL_STATE_CLOBBER && may_change(before->values[k].name)))
                continue;
            fail_msg("%s changed %s from %lld to %lld", calls[i].name, before->values[k].name,
                     (long long)before->values[k].value, (long long)after.values[k].value);
        }
    }
}

static void check_all_calls(struct fixture* f, hair_gl_state promise)
{
    static struct hair_test_glstate before;
    hair_test_glstate_read(&before);
    print_message("    %zu values\n", before.count);
    assert_true(before.count > 500);
    assert_int_equal(glGetError(), GL_NO_ERROR);
    f->promise = promise;
    // Work group per guide, thread per guide, and redblack.
    for (f->way = 0; f->way < HAIR_TEST_WAYS; f->way += 3) check_calls(f, &before);
}

static void calls_restore_all_opengl_state_and_the_error_flag(void** state)
{
    check_all_calls(*state, HAIR_GL_STATE_RESTORE);
}

static void clobbering_context_changes_only_the_listed_state(void** state)
{
    check_all_calls(*state, HAIR_GL_STATE_CLOBBER);
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
    create_textures(f);
    check_all_calls(f, HAIR_GL_STATE_RESTORE);
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
    check_all_calls(f, HAIR_GL_STATE_RESTORE);
}

int main(void)
{
    // Draws here are tiny, and most time goes into Mesa's optimisation of the programs. Only Mesa's
    // software rasteriser reads this variable.
    setenv("GALLIVM_PERF", "nopt", 0);
    if (hair_test_skips()) return 0;
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(calls_restore_all_opengl_state_and_the_error_flag, start, finish),
        cmocka_unit_test_setup_teardown(clobbering_context_changes_only_the_listed_state, start, finish),
        cmocka_unit_test_setup_teardown(compatibility_context_keeps_fixed_function_state, start_compatibility,
                                        finish),
        cmocka_unit_test_setup_teardown(calls_leave_nothing_bound_in_a_fresh_context, start, finish),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
