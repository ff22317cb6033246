// lives_test.c - objects that contexts and instances create, count and leave behind.
#include "tests/support/passes.h"
#include "tests/support/support.h"

#include <stdio.h>
#include <string.h>

#include "lib/api/api.h"
#include "tests/support/frame.h"
#include "tests/support/handmade.h"
#include "tests/support/ways.h"
#include "tests/support/tessellated.h"

#define MAX 4096

static void live_once(struct hair_test* test, const hair_groom* groom, int way, int reads)
{
    static float positions[3 * MAX];
    hair_instance* hair = NULL;
    hair_desc desc = hair_test_way(way);
    hair_collider collider = {HAIR_SHAPE_SPHERE, {0.1f, 0.2f, 0}, {0, 0, 0, 1},
                              {0.05f, 0},        .scale = 1,      .friction = 1};
    hair_view view = hair_test_tessellated();
    hair_look look = hair_look_default();
    hair_physics other = hair_physics_default();
    uint32_t count;
    look.strand.segments = 4;
    other.damping = 5;
    hair_test_ok(test, hair_create(test->context, groom, &desc, &hair));
    hair_test_ok(test, hair_set_look(hair, &look));
    hair_test_ok(test, hair_step(hair, 1.0f / 60));
    hair_test_ok(test, hair_set_physics(hair, &other)); // Makes the rods again.
    hair_test_ok(test, hair_set_colliders(hair, &collider, 1, sizeof collider));
    hair_test_ok(test, hair_step(hair, 1.0f / 60));
    hair_test_ok(test, hair_draw(hair, &view));
    if (reads) hair_test_ok(test, hair_read_positions(hair, HAIR_READ_FOLLOWERS, positions, MAX, &count));
    hair_destroy(hair);
}

static void two_hundred_instances_leave_no_memory(void** state)
{
    struct hair_test* test = *state;
    hair_groom* groom = hair_test_groom(&test->host.host, hair_test_handmade_default());
    struct hair_test_frame frame;
    hair_test_frame_make(&frame, 16, 16, GL_RGBA8, 0);
    for (int way = 0; way < HAIR_TEST_WAYS; ++way) {
        // Programs are compiled when they are first needed, and stay.
        live_once(test, groom, way, 1);
        uint32_t objects = hair_test_count_objects(), blocks = hair_test_blocks(test);
        for (int life = 0; life < 200 / HAIR_TEST_WAYS + 1; ++life)
            live_once(test, groom, way, life % 10 == 0);
        assert_int_equal(hair_test_count_objects(), objects);
        assert_int_equal(hair_test_blocks(test), blocks);
    }
    hair_test_frame_free(&frame);
    hair_groom_destroy(groom);
}

static void destroyed_context_leaves_no_memory(void** state)
{
    struct hair_test* test = *state;
    uint32_t objects = hair_test_count_objects(), blocks = hair_test_blocks(test);
    for (int life = 0; life < 5; ++life) {
        hair_context* context = hair_test_context(test, hair_egl_get_proc);
        hair_groom* groom = hair_test_groom(&test->host.host, hair_test_handmade_default());
        hair_instance* hair = NULL;
        hair_desc of = hair_desc_default();
        hair_test_ok(test, hair_create(context, groom, &of, &hair));
        hair_test_ok(test, hair_step(hair, 1.0f / 60));
        hair_test_ok(test, hair_context_reload(context));
        hair_destroy(hair);
        hair_context_destroy(context);
        hair_groom_destroy(groom);
    }
    assert_int_equal(hair_test_count_objects(), objects);
    assert_int_equal(hair_test_blocks(test), blocks);
}

static void timings_count_runs_of_every_pass(void** state)
{
    struct hair_test* test = *state;
    hair_context* context = hair_test_context(test, hair_egl_get_proc);
    hair_groom* groom = hair_test_groom(&test->host.host, hair_test_handmade_default());
    hair_instance* hair = NULL;
    hair_desc of = hair_test_way(0);
    hair_test_ok(test, hair_create(context, groom, &of, &hair));
    for (int i = 0; i < 9; ++i) hair_test_ok(test, hair_step(hair, 1.0f / 120));
    glFinish();
    hair_timing timings[16];
    uint32_t count = hair_get_timings(context, timings, 16), found = 0;
    assert_int_equal(hair_get_timings(context, NULL, 0), count);
    assert_in_range(count, 3, 16);
    for (uint32_t i = 0; i < count; ++i) {
        int solves = !strcmp(timings[i].pass, "sim/mixed_32");
        // Nothing has read the guides.
        int smooth = !strcmp(timings[i].pass, "strands/smooth_32");
        if (solves || smooth) assert_int_equal(timings[i].runs, solves ? 9 : 0);
        assert_null(strstr(timings[i].pass, "draw/"));
        assert_true(timings[i].ms >= 0 && timings[i].ms < 1000);
        found += solves + smooth;
    }
    assert_int_equal(found, 2);
    hair_destroy(hair);
    hair_context_destroy(context);
    hair_groom_destroy(groom);
}

static uint32_t read_smooth(struct hair_test* test, hair_instance* hair, float* out)
{
    uint32_t count = 0;
    hair_test_ok(test, hair_read_positions(hair, HAIR_READ_SMOOTH, out, MAX, &count));
    assert_true(count <= MAX);
    return count;
}

static const float straight[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
static const float turned[16] = {0.8f, 0.6f, 0, 0, -0.6f, 0.8f, 0, 0, 0, 0, 1, 0, 0.1f, 0.2f, 0.3f, 1};

// Move the guides without a step. The last way restores their positions.
static void move(struct hair_test* test, hair_instance* hair, int how)
{
    static unsigned char bytes[1 << 20];
    size_t size = 0;
    if (how == 0) hair_test_ok(test, hair_reset(hair));
    if (how == 1) hair_test_ok(test, hair_teleport(hair, straight));
    if (how < 2) return;
    hair_test_ok(test, hair_save(hair, bytes, sizeof bytes, &size));
    hair_test_ok(test, hair_step(hair, 0.5f));
    hair_test_ok(test, hair_load(hair, bytes, size));
}

// Check smoothing on demand. One instance is read after every step. The other is drawn once and
// read after the draw.
static void guides_are_smoothed_on_first_use_after_a_step(void** state)
{
    static float often[3 * MAX], once[3 * MAX];
    struct hair_test* test = *state;
    hair_context* context = hair_test_context(test, hair_egl_get_proc);
    hair_groom* groom = hair_test_groom(&test->host.host, hair_test_handmade_default());
    hair_desc of = hair_test_way(1);
    hair_instance *a = NULL, *b = NULL;
    hair_test_ok(test, hair_create(context, groom, &of, &a));
    hair_test_ok(test, hair_create(context, groom, &of, &b));
    const hair_view view = hair_test_tessellated();
    struct hair_test_frame frame;
    hair_test_frame_make(&frame, 16, 16, GL_RGBA8, 0);
    for (int how = 0; how < 3; ++how) {
        uint32_t before = hair_test_runs(&context->gl, HAIR_GL_SMOOTH), count = 0;
        for (int i = 0; i < 4; ++i) {
            hair_test_ok(test, hair_step(a, 0.007f));
            hair_test_ok(test, hair_step(b, 0.007f));
            read_smooth(test, a, often);
            assert_int_equal(hair_test_runs(&context->gl, HAIR_GL_SMOOTH), before + (uint32_t)i + 1);
        }
        hair_test_ok(test, hair_set_transform(b, turned)); // The next step uses this.
        hair_test_ok(test, hair_draw(b, &view));
        assert_int_equal(hair_test_runs(&context->gl, HAIR_GL_SMOOTH), before + 5);
        count = read_smooth(test, b, once);
        assert_int_equal(hair_test_runs(&context->gl, HAIR_GL_SMOOTH), before + 5);
        assert_memory_equal(often, once, 3 * count * sizeof *once);
        hair_test_ok(test, hair_set_transform(a, turned));
        move(test, a, how);
        move(test, b, how);
        read_smooth(test, a, often);
        assert_int_equal(hair_test_runs(&context->gl, HAIR_GL_SMOOTH), before + 6);
        assert_int_equal(memcmp(often, once, 3 * count * sizeof *once) == 0, how == 2);
        read_smooth(test, b, once);
        assert_memory_equal(often, once, 3 * count * sizeof *once);
    }
    hair_test_frame_free(&frame);
    hair_destroy(a);
    hair_destroy(b);
    hair_context_destroy(context);
    hair_groom_destroy(groom);
}

#define THREAD HAIR_GL_WITH(THREAD_PER_GUIDE)

static uint32_t count_solvers(const hair_context* context)
{
    uint32_t count = 0;
    static const char* const solvers[] = {"sim/direct", "sim/accurate", "sim/mixed", "sim/follow",
                                          "sim/redblack"};
    for (uint32_t i = 0; i < context->gl.programs; ++i)
        for (int k = 0; k < 5; ++k)
            count += !strncmp(context->gl.program[i]->label, solvers[k], strlen(solvers[k]));
    return count;
}

// Check which programs of the solvers are compiled. Straight hair needs no program for curls, and
// hair without colliders needs no program with contact.
static void check_compiled(struct hair_test* test, int way)
{
    static const hair_gl_pass rows[HAIR_TEST_WAYS] = {
        HAIR_GL_DIRECT, HAIR_GL_DIRECT | THREAD, HAIR_GL_ACCURATE, HAIR_GL_ACCURATE | THREAD,
        HAIR_GL_FOLLOW, HAIR_GL_FOLLOW | THREAD, HAIR_GL_REDBLACK};
    hair_context* context = hair_test_context(test, hair_egl_get_proc);
    hair_collider collider = {HAIR_SHAPE_SPHERE, {0, 0, 0},  {0, 0, 0, 1},
                              {0.05f, 0},        .scale = 1, .friction = 1};
    hair_physics limp = hair_physics_default();
    hair_gl_pass passes[4];
    uint32_t compiled = 0;
    // With gravity preload, straight hair is curved in the absence of forces.
    limp.shape.gravity_preload = 0;
    for (int kind = 0; kind < 4; ++kind) {
        struct hair_test_handmade wanted = hair_test_handmade_default();
        hair_instance* hair = NULL;
        hair_desc desc = hair_test_way(way);
        int curved = kind & 1, colliders = kind / 2;
        if (!curved) wanted.turn = 0;
        desc.physics = &limp;
        hair_groom* groom = hair_test_groom(&test->host.host, wanted);
        hair_test_ok(test, hair_create(context, groom, &desc, &hair));
        hair_test_ok(test, hair_set_colliders(hair, &collider, (uint32_t)colliders, sizeof collider));
        hair_test_ok(test, hair_step(hair, 1e-6f)); // Runs no substep.
        hair_gl_pass pass = rows[way];
        if (hair_sim_is_mixed(&hair->sim))
            pass = HAIR_GL_MIXED_SOLVER | (hair->sim.by_thread ? THREAD : 0);
        else if (hair_sim_is_stiff(&hair->sim))
            pass += HAIR_GL_ACCURATE_STIFF - HAIR_GL_ACCURATE;
        pass = hair_gl_add_features(pass, colliders ? HAIR_GL_WITH(COLLIDERS) : 0);
        // The accurate solver has two programs, unless it solves curls.
        bool two = desc.solver == HAIR_SOLVER_ACCURATE && !hair_sim_is_mixed(&hair->sim);
        if (two) pass |= HAIR_GL_WITH(PASS1);
        int anew = 1;
        for (int k = 0; k < kind; ++k) anew = anew && passes[k] != pass;
        passes[kind] = pass;
        compiled += (uint32_t)(anew * (1 + two));
        assert_int_equal(count_solvers(context), compiled);
        if (!hair_test_program(&context->gl, pass))
            fail_msg("%s curved %d, colliders %d is not compiled", hair_gl_row_label(pass), curved,
                     colliders);
        hair_destroy(hair);
        hair_groom_destroy(groom);
    }
    hair_context_destroy(context);
}

static void only_the_used_solver_is_compiled(void** state)
{
    for (int way = 0; way < HAIR_TEST_WAYS; ++way) check_compiled(*state, way);
}

int main(void)
{
    if (hair_test_skips()) return 0;
    const struct CMUnitTest tests[] = {
        HAIR_TEST(two_hundred_instances_leave_no_memory),
        HAIR_TEST(destroyed_context_leaves_no_memory),
        HAIR_TEST(timings_count_runs_of_every_pass),
        HAIR_TEST(guides_are_smoothed_on_first_use_after_a_step),
        HAIR_TEST(only_the_used_solver_is_compiled),
    };
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
