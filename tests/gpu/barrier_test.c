// barrier_test.c - every dispatch is followed by a memory barrier before anything reads what it has
// written. Most drivers give the right result without one, so the calls themselves are checked.
// Parts of one pass need no barriers between them on a GPU, because no part reads another.
#include "tests/support/torture.h"

#include "lib/api/api.h"

#include <string.h>

#define NEEDED                                                                                               \
    (GL_SHADER_STORAGE_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT |           \
     GL_COMMAND_BARRIER_BIT | GL_ELEMENT_ARRAY_BARRIER_BIT)

// Barriers before other writes to an image, and before the application reads its texture.
#define NEEDED_BY_IMAGES (GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_TEXTURE_UPDATE_BARRIER_BIT)

static GLbitfield missing; // Barriers that the last dispatch still needs.
static GLbitfield missing_of_images; // Barriers that dispatches which wrote images still need.
static uint32_t dispatches, parts, barriers, too_early, image_dispatches;

static bool is_next_part; // The next dispatch is a later part of a pass.

static void note_use(void)
{
    too_early += missing != 0;
}

static void APIENTRY set_groups(GLuint program, GLint location, GLuint first, GLuint all)
{
    if (location == HAIR_LOCATION_GROUPS) is_next_part = first > 0;
    glProgramUniform2ui(program, location, first, all);
}

// Return whether the current program writes images.
static bool writes_images(void)
{
    GLint program = 0, count = 0;
    glGetIntegerv(GL_CURRENT_PROGRAM, &program);
    glGetProgramiv((GLuint)program, GL_ACTIVE_UNIFORMS, &count);
    for (GLuint i = 0; i < (GLuint)count; ++i) {
        GLint type = 0;
        glGetActiveUniformsiv((GLuint)program, 1, &i, GL_UNIFORM_TYPE, &type);
        if (type == GL_IMAGE_3D || type == GL_UNSIGNED_INT_IMAGE_3D) return true;
    }
    return false;
}

static void note_dispatch(void)
{
    if (!is_next_part) note_use();
    parts += is_next_part;
    is_next_part = false;
    ++dispatches;
    missing = NEEDED;
    if (!writes_images()) return;
    ++image_dispatches;
    missing_of_images = NEEDED_BY_IMAGES;
}

static void APIENTRY dispatch(GLuint x, GLuint y, GLuint z)
{
    note_dispatch();
    glDispatchCompute(x, y, z);
}
static void APIENTRY dispatch_indirect(GLintptr at)
{
    note_dispatch();
    glDispatchComputeIndirect(at);
}
static void APIENTRY barrier(GLbitfield bits)
{
    ++barriers;
    missing &= ~bits;
    missing_of_images &= ~bits;
    glMemoryBarrier(bits);
}
static void APIENTRY draw_arrays(GLenum mode, GLint first, GLsizei count)
{
    note_use();
    glDrawArrays(mode, first, count);
}
static void APIENTRY draw_instances(GLenum mode, GLint first, GLsizei count, GLsizei instances)
{
    note_use();
    glDrawArraysInstanced(mode, first, count, instances);
}
static void APIENTRY draw_indirect(GLenum mode, GLenum type, const void* at, GLsizei count, GLsizei stride)
{
    note_use();
    glMultiDrawElementsIndirect(mode, type, at, count, stride);
}
static void APIENTRY copy(GLuint from, GLuint to, GLintptr from_at, GLintptr to_at, GLsizeiptr size)
{
    note_use();
    glCopyNamedBufferSubData(from, to, from_at, to_at, size);
}
static void APIENTRY read_buffer(GLuint buffer, GLintptr at, GLsizeiptr size, void* out)
{
    note_use();
    glGetNamedBufferSubData(buffer, at, size, out);
}

static void* proc(const char* name, void* user)
{
    static const struct {
        const char* name;
        void (*function)(void);
    } own[] = {
        {"glDispatchCompute", (void (*)(void))dispatch},
        {"glDispatchComputeIndirect", (void (*)(void))dispatch_indirect},
        {"glMemoryBarrier", (void (*)(void))barrier},
        {"glProgramUniform2ui", (void (*)(void))set_groups},
        {"glDrawArrays", (void (*)(void))draw_arrays},
        {"glDrawArraysInstanced", (void (*)(void))draw_instances},
        {"glMultiDrawElementsIndirect", (void (*)(void))draw_indirect},
        {"glCopyNamedBufferSubData", (void (*)(void))copy},
        {"glGetNamedBufferSubData", (void (*)(void))read_buffer},
    };
    for (size_t i = 0; i < sizeof own / sizeof *own; ++i) {
        if (strcmp(own[i].name, name) != 0) continue;
        void* address;
        memcpy(&address, &own[i].function, sizeof address);
        return address;
    }
    return hair_egl_get_proc(name, user);
}

// Check the calls since the last check.
static void check(const char* what)
{
    print_message("    %s: %u dispatches, %u barriers\n", what, dispatches, barriers);
    assert_true(dispatches > 0);
    assert_int_equal(too_early, 0);
    assert_int_equal(missing, 0);
    assert_int_equal(missing_of_images, 0);
    dispatches = barriers = 0;
}

// Begin with the dispatches of a software rasterizer, or with the divided ones of a GPU.
static void start(struct hair_test_torture* t, hair_solver solver, bool as_gpu)
{
    hair_desc desc = hair_desc_default();
    hair_look look = hair_look_default();
    desc.solver = solver;
    look.strand.segments = 6;
    look.self_shadow.method = HAIR_SELF_SHADOW_STRANDS;
    desc.look = &look;
    t->context = hair_test_context(t->test, proc);
    if (as_gpu) t->context->gl.software = 0, t->context->gl.dispatch_ms = 1e-9;
    t->groom = hair_test_torture_groom(t->test);
    dispatches = parts = barriers = too_early = image_dispatches = 0;
    hair_test_torture_add(t, &desc);
    hair_test_torture_collide(t);
}

static void finish(struct hair_test_torture* t)
{
    hair_destroy(t->hair);
    hair_collision_mesh_destroy(t->mesh);
    hair_groom_destroy(t->groom);
    hair_context_destroy(t->context);
}

static void check_steps(struct hair_test* test, bool as_gpu)
{
    for (int solver = 0; solver <= HAIR_SOLVER_REDBLACK; ++solver) {
        struct hair_test_torture t = {.test = test};
        hair_physics physics = hair_physics_default();
        hair_wind wind = hair_wind_default();
        start(&t, (hair_solver)solver, as_gpu);
        physics.hair_hair.cohesion = physics.hair_hair.pressure_stiffness = 1;
        wind.model = HAIR_WIND_FLUID, wind.velocity[0] = 1, wind.fluid.resolution = 16;
        hair_test_ok(t.test, hair_set_physics(t.hair, &physics));
        hair_test_ok(t.test, hair_set_wind(t.hair, &wind));
        for (int i = 0; i < 2; ++i) hair_test_ok(t.test, hair_step(t.hair, 1.0f / 60));
        // Redblack feels no wind.
        assert_true(image_dispatches > 0 || solver == HAIR_SOLVER_REDBLACK);
        assert_true(parts > 0 || !as_gpu);
        check("steps");
        finish(&t);
    }
}

static void dispatches_of_steps_are_followed_by_barriers(void** state)
{
    check_steps(*state, false);
    check_steps(*state, true);
}

static void check_draws(struct hair_test* test, bool as_gpu)
{
    static const hair_render_path paths[] = {HAIR_RENDER_PATH_TESSELLATION, HAIR_RENDER_PATH_CACHED,
                                             HAIR_RENDER_PATH_COMPUTE};
    struct hair_test_torture t = {.test = test, .lod = hair_lod_default()};
    struct hair_test_frame frame;
    hair_test_frame_make(&frame, HAIR_TEST_TORTURE_SIZE, HAIR_TEST_TORTURE_SIZE, GL_RGBA32F, 0);
    start(&t, HAIR_SOLVER_DIRECT, as_gpu);
    for (int i = 0; i < 12; ++i) {
        hair_view view = hair_test_torture_view();
        view.render_path = paths[i % 3];
        view.pass = i / 3 == 2 ? HAIR_PASS_MOTION : HAIR_PASS_COLOR;
        view.coverage = i / 3 == 3 ? HAIR_COVERAGE_ALPHA : HAIR_COVERAGE_MSAA;
        if (i / 3 == 1) view.lod = &t.lod;
        hair_test_ok(t.test, hair_step(t.hair, 1.0f / 60));
        hair_test_ok(t.test, hair_draw(t.hair, &view));
        check("draw");
    }
    assert_true(image_dispatches > 0); // The distance field.
    finish(&t);
    hair_test_frame_free(&frame);
}

static void dispatches_of_draws_are_followed_by_barriers(void** state)
{
    check_draws(*state, false);
    check_draws(*state, true);
}

int main(void)
{
    if (hair_test_skips()) return 0;
    const struct CMUnitTest tests[] = {
        HAIR_TEST(dispatches_of_steps_are_followed_by_barriers),
        HAIR_TEST(dispatches_of_draws_are_followed_by_barriers),
    };
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
