// host_capture_test.c - calls between the host's glBeginTransformFeedback() and its end, and inside
// its conditional rendering.
#include "tests/support/scene.h"

#include "tests/support/ways.h"

#define BEFORE 3 // Points that the host captures before the calls.
#define AFTER 2 // Points that the host captures after the calls.

static const char text[] =
    "#version 450 core\n"
    "uniform float number;\n"
    "out float captured;\n"
    "out gl_PerVertex { vec4 gl_Position; };\n"
    "void main() { captured = number + float(gl_VertexID); gl_Position = vec4(0.0); }\n";

// A host that captures points, and its hair.
struct fixture {
    struct hair_test* test;
    hair_context* context;
    hair_groom* groom;
    hair_instance* hair;
    hair_desc desc;
    struct hair_test_frame frame;
    GLuint program, vertices, buffer, feedback;
};

static GLuint make_program(void)
{
    static const char* const names[] = {"captured"};
    const char* source = text;
    GLuint program = glCreateProgram(), shader = glCreateShader(GL_VERTEX_SHADER);
    GLint is_linked = 0;
    glShaderSource(shader, 1, &source, NULL);
    glCompileShader(shader);
    glAttachShader(program, shader);
    glTransformFeedbackVaryings(program, 1, names, GL_INTERLEAVED_ATTRIBS);
    glLinkProgram(program);
    glDeleteShader(shader);
    glGetProgramiv(program, GL_LINK_STATUS, &is_linked);
    assert_true(is_linked);
    return program;
}

static void start(struct fixture* f, struct hair_test* test, int way)
{
    *f = (struct fixture){.test = test, .desc = hair_test_way(way)};
    f->groom = hair_test_groom(&test->host.host, hair_test_handmade_default());
    hair_test_frame_make(&f->frame, 16, 16, GL_RGBA8, 0);
    f->program = make_program();
    glCreateVertexArrays(1, &f->vertices);
    glCreateBuffers(1, &f->buffer);
    glNamedBufferStorage(f->buffer, 256, NULL, 0);
    glCreateTransformFeedbacks(1, &f->feedback);
    glTransformFeedbackBufferBase(f->feedback, 0, f->buffer);
}

static void finish(struct fixture* f)
{
    glBindTransformFeedback(GL_TRANSFORM_FEEDBACK, 0);
    glUseProgram(0);
    glBindVertexArray(0);
    glDeleteTransformFeedbacks(1, &f->feedback);
    glDeleteBuffers(1, &f->buffer);
    glDeleteVertexArrays(1, &f->vertices);
    glDeleteProgram(f->program);
    hair_test_frame_free(&f->frame);
    hair_groom_destroy(f->groom);
}

static void make_context(struct fixture* f, hair_gl_state promise)
{
    hair_context_desc desc = hair_context_desc_default();
    desc.host = &f->test->host.host;
    desc.get_proc = hair_egl_get_proc;
    desc.gl_state = promise;
    hair_test_ok(f->test, hair_context_create(&desc, &f->context));
}

// Make the calls that a frame and its preparation have. Read where the guides are then.
static void live(struct fixture* f, struct hair_test_points* out)
{
    hair_view view = hair_view_default();
    hair_collider collider = {HAIR_SHAPE_SPHERE, {0.1f, 0.2f, 0}, {0, 0, 0, 1},
                              {0.05f, 0},        .scale = 1,      .friction = 1};
    bool is_ready = false;
    hair_test_ok(f->test, hair_create(f->context, f->groom, &f->desc, &f->hair));
    hair_test_ok(f->test, hair_set_colliders(f->hair, &collider, 1, sizeof collider));
    hair_test_ok(f->test, hair_precompile(f->hair, &view, &is_ready));
    for (int i = 0; i < 5; ++i) hair_test_ok(f->test, hair_step(f->hair, 1.0f / 60));
    hair_test_ok(f->test, hair_draw(f->hair, &view));
    hair_test_ok(f->test, hair_context_reload(f->context));
    hair_test_read_points(f->test, f->hair, HAIR_READ_GUIDES, out);
    hair_destroy(f->hair);
}

static void draw_points(struct fixture* f, float number, GLsizei count)
{
    glProgramUniform1f(f->program, glGetUniformLocation(f->program, "number"), number);
    glDrawArrays(GL_POINTS, 0, count);
}

// Bind what the host draws with.
static void bind(struct fixture* f)
{
    glUseProgram(f->program);
    glBindVertexArray(f->vertices);
}

static void check_captured(const struct fixture* f)
{
    static const float expected[BEFORE + AFTER] = {10, 11, 12, 20, 21};
    float captured[BEFORE + AFTER];
    glGetNamedBufferSubData(f->buffer, 0, sizeof captured, captured);
    for (size_t i = 0; i < BEFORE + AFTER; ++i) hair_test_near("point", i, captured[i], expected[i], 0);
}

static void check_feedback(struct hair_test* test, int way, hair_gl_state promise)
{
    static struct hair_test_points free_points, points;
    struct fixture f;
    GLint is_active = 0, is_paused = 1, bound = 0;
    start(&f, test, way);
    make_context(&f, promise);
    live(&f, &free_points);

    bind(&f);
    glBindTransformFeedback(GL_TRANSFORM_FEEDBACK, f.feedback);
    glBeginTransformFeedback(GL_POINTS);
    draw_points(&f, 10, BEFORE);
    live(&f, &points);
    glGetIntegerv(GL_TRANSFORM_FEEDBACK_ACTIVE, &is_active);
    glGetIntegerv(GL_TRANSFORM_FEEDBACK_PAUSED, &is_paused);
    glGetIntegerv(GL_TRANSFORM_FEEDBACK_BINDING, &bound);
    assert_true(is_active && !is_paused);
    assert_int_equal(bound, (GLint)f.feedback);
    glBindVertexArray(f.vertices);
    draw_points(&f, 20, AFTER);
    glEndTransformFeedback();
    assert_int_equal(glGetError(), GL_NO_ERROR);
    check_captured(&f);
    hair_context_destroy(f.context);
    assert_int_equal(points.count, free_points.count);
    assert_memory_equal(points.at, free_points.at, 3 * points.count * sizeof *points.at);
    finish(&f);
}

static void feedback_of_the_host_goes_on_after_calls(void** state)
{
    for (int way = 0; way < HAIR_TEST_WAYS; way += 3) check_feedback(*state, way, HAIR_GL_STATE_RESTORE);
}

static void feedback_of_the_host_goes_on_with_clobbered_state(void** state)
{
    for (int way = 0; way < HAIR_TEST_WAYS; way += 3) check_feedback(*state, way, HAIR_GL_STATE_CLOBBER);
}

static void paused_feedback_of_the_host_stays_paused(void** state)
{
    static struct hair_test_points points;
    struct fixture f;
    GLint is_active = 0, is_paused = 0;
    start(&f, *state, 0);
    make_context(&f, HAIR_GL_STATE_RESTORE);
    bind(&f);
    glBindTransformFeedback(GL_TRANSFORM_FEEDBACK, f.feedback);
    glBeginTransformFeedback(GL_POINTS);
    draw_points(&f, 10, BEFORE);
    glPauseTransformFeedback();
    live(&f, &points);
    glGetIntegerv(GL_TRANSFORM_FEEDBACK_ACTIVE, &is_active);
    glGetIntegerv(GL_TRANSFORM_FEEDBACK_PAUSED, &is_paused);
    assert_true(is_active && is_paused);
    glResumeTransformFeedback();
    draw_points(&f, 20, AFTER);
    glEndTransformFeedback();
    check_captured(&f);
    hair_context_destroy(f.context);
    finish(&f);
}

// A call that captures by itself is refused, and takes nothing from the host's transform feedback.
static void calls_that_capture_are_refused(void** state)
{
    static struct hair_test_points before, after;
    const char* words = "that of the application is active";
    struct fixture f;
    hair_context* other = NULL;
    hair_instance* created = NULL;
    hair_context_desc of = hair_context_desc_default();
    start(&f, *state, 0);
    of.host = &f.test->host.host;
    of.get_proc = hair_egl_get_proc;
    f.desc = hair_desc_default();
    f.desc.solver = HAIR_SOLVER_REDBLACK;
    f.desc.thread_mapping = HAIR_THREAD_MAPPING_FEEDBACK;
    make_context(&f, HAIR_GL_STATE_RESTORE);
    hair_test_ok(f.test, hair_create(f.context, f.groom, &f.desc, &f.hair));
    hair_test_ok(f.test, hair_step(f.hair, 1.0f / 60));
    hair_test_read_points(f.test, f.hair, HAIR_READ_GUIDES, &before);
    bind(&f);
    glBindTransformFeedback(GL_TRANSFORM_FEEDBACK, f.feedback);
    glBeginTransformFeedback(GL_POINTS);
    draw_points(&f, 10, BEFORE);
    for (int i = 0; i < 2; ++i) {
        hair_test_refused(f.test, hair_context_create(&of, &other), HAIR_ERROR_OPENGL, words);
        hair_test_refused(f.test, hair_create(f.context, f.groom, &f.desc, &created), HAIR_ERROR_OPENGL,
                          words);
        hair_test_refused(f.test, hair_step(f.hair, 1.0f / 60), HAIR_ERROR_OPENGL, words);
        (i ? glResumeTransformFeedback : glPauseTransformFeedback)();
    }
    draw_points(&f, 20, AFTER);
    glEndTransformFeedback();
    check_captured(&f);
    hair_test_read_points(f.test, f.hair, HAIR_READ_GUIDES, &after);
    assert_memory_equal(after.at, before.at, 3 * before.count * sizeof *before.at);
    hair_test_ok(f.test, hair_step(f.hair, 1.0f / 60));
    hair_destroy(f.hair);
    hair_context_destroy(f.context);
    finish(&f);
}

// Step and draw, with everything on that a step may run.
static void step_and_draw(struct fixture* f, hair_instance* hair, int step_count)
{
    hair_view view = hair_view_default();
    for (int i = 0; i < step_count; ++i) {
        hair_test_ok(f->test, hair_step(hair, 1.0f / 60));
        hair_test_ok(f->test, hair_draw(hair, &view));
    }
}

static hair_instance* make_busy_hair(struct fixture* f)
{
    hair_instance* hair = NULL;
    hair_physics physics = hair_physics_default();
    hair_wind wind = hair_wind_default();
    hair_look look = hair_look_default();
    hair_collider collider = {HAIR_SHAPE_SPHERE, {0.1f, 0.2f, 0}, {0, 0, 0, 1},
                              {0.05f, 0},        .scale = 1,      .friction = 1};
    physics.hair_hair.cohesion = 0.5f;
    physics.hair_hair.pressure_stiffness = 1;
    physics.sleep_threshold = 1e-3f;
    wind.model = HAIR_WIND_FLUID;
    wind.fluid.resolution = 16;
    wind.velocity[0] = 1;
    look.self_shadow.method = HAIR_SELF_SHADOW_STRANDS;
    hair_test_ok(f->test, hair_create(f->context, f->groom, &f->desc, &hair));
    hair_test_ok(f->test, hair_set_physics(hair, &physics));
    hair_test_ok(f->test, hair_set_wind(hair, &wind));
    hair_test_ok(f->test, hair_set_look(hair, &look));
    hair_test_ok(f->test, hair_set_colliders(hair, &collider, 1, sizeof collider));
    return hair;
}

// OpenGL discards what is asked for in conditional rendering, and hides it from the library. There
// is no error, and the hair is whole after a reset.
static void discarded_steps_are_mended_by_a_reset(void** state)
{
    static struct hair_test_points free_points, points;
    for (int way = 0; way < HAIR_TEST_WAYS; way += 3) {
        struct fixture f;
        GLuint none;
        start(&f, *state, way);
        make_context(&f, HAIR_GL_STATE_RESTORE);
        hair_instance *hair = make_busy_hair(&f), *other = make_busy_hair(&f);
        glCreateQueries(GL_ANY_SAMPLES_PASSED, 1, &none);
        glBeginQuery(GL_ANY_SAMPLES_PASSED, none);
        glEndQuery(GL_ANY_SAMPLES_PASSED);
        step_and_draw(&f, hair, 6);
        step_and_draw(&f, other, 2);
        glBeginConditionalRender(none, GL_QUERY_WAIT);
        step_and_draw(&f, other, 4);
        glEndConditionalRender();
        assert_int_equal(glGetError(), GL_NO_ERROR);
        hair_test_read_points(f.test, other, HAIR_READ_FOLLOWERS, &points); // They are finite.
        hair_test_read_points(f.test, hair, HAIR_READ_FOLLOWERS, &free_points);
        // Steps were discarded.
        assert_true(hair_test_points_distance(&points, &free_points) > 1e-4);
        step_and_draw(&f, other, 2);
        step_and_draw(&f, hair, 2);
        hair_test_ok(f.test, hair_reset(hair));
        hair_test_ok(f.test, hair_reset(other));
        step_and_draw(&f, hair, 4);
        step_and_draw(&f, other, 4);
        hair_test_read_points(f.test, hair, HAIR_READ_FOLLOWERS, &free_points);
        hair_test_read_points(f.test, other, HAIR_READ_FOLLOWERS, &points);
        assert_int_equal(points.count, free_points.count);
        assert_memory_equal(points.at, free_points.at, 3 * points.count * sizeof *points.at);
        hair_destroy(hair);
        hair_destroy(other);
        glDeleteQueries(1, &none);
        hair_context_destroy(f.context);
        finish(&f);
    }
}

int main(void)
{
    if (hair_test_skips()) return 0;
    const struct CMUnitTest tests[] = {
        HAIR_TEST(feedback_of_the_host_goes_on_after_calls),
        HAIR_TEST(feedback_of_the_host_goes_on_with_clobbered_state),
        HAIR_TEST(calls_that_capture_are_refused),
        HAIR_TEST(discarded_steps_are_mended_by_a_reset),
        HAIR_TEST(paused_feedback_of_the_host_stays_paused),
    };
    int failed = cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
    return failed + cmocka_run_group_tests(tests, hair_test_start_compatibility, hair_test_finish);
}
