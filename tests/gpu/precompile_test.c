// precompile_test.c - programs that a frame runs are compiled before it, in the driver's threads or
// one per call.
#define _POSIX_C_SOURCE 200809L
#include "tests/support/passes.h"
#include "tests/support/render_paths.h"
#include "tests/support/scene.h"

#include <time.h>

#define MAX_CALLS 800

struct fixture {
    struct hair_test_scene scene;
    GLuint depth; // A depth texture for views.
};

static struct fixture start(struct hair_test* test)
{
    static const float far_away = 1;
    struct fixture f = {hair_test_scene_make(test, hair_egl_get_proc), 0};
    hair_test_scene_add(&f.scene, NULL, NULL);
    hair_test_frame_make(&f.scene.frame, 32, 32, GL_RGBA8, 0);
    glCreateTextures(GL_TEXTURE_2D, 1, &f.depth);
    glTextureStorage2D(f.depth, 1, GL_DEPTH_COMPONENT32F, 32, 32);
    glClearTexImage(f.depth, 0, GL_DEPTH_COMPONENT, GL_FLOAT, &far_away);
    return f;
}

static void finish(struct fixture* f)
{
    glDepthFunc(GL_LESS);
    glDeleteTextures(1, &f->depth);
    hair_test_scene_free(&f->scene);
}

// Precompile everything. Return the number of calls.
static uint32_t prepare(struct fixture* f, const hair_view* view)
{
    bool ready = false;
    uint32_t calls = 0;
    const struct hair_gl* gl = &f->scene.context->gl;
    uint32_t max = gl->parallel && !gl->software ? HAIR_GL_PARALLEL_WORK : HAIR_GL_SERIAL_WORK;
    for (; !ready && calls < MAX_CALLS; ++calls) {
        hair_test_ok(f->scene.test, hair_precompile(f->scene.hair, view, &ready));
        assert_true(gl->work <= max);
        // Threads of the driver compile between frames. llvmpipe has none, but zink above it does,
        // and a call then finds no work.
        const struct timespec frame = {.tv_nsec = 50000000};
        bool is_waiting = !gl->software || gl->work == 0;
        if (!ready && gl->parallel && is_waiting) nanosleep(&frame, NULL);
    }
    assert_true(ready);
    return calls;
}

static void live(struct fixture* f, const hair_view* view)
{
    for (int i = 0; i < 3; ++i) {
        hair_test_ok(f->scene.test, hair_step(f->scene.hair, 1.0f / 60));
        hair_test_ok(f->scene.test, hair_draw(f->scene.hair, view));
    }
}

// Ways of living, in which frames run different programs ------------------------------------------

static void put_a_ball_into(struct fixture* f, hair_view* view)
{
    (void)view;
    hair_collider ball = {HAIR_SHAPE_SPHERE, {0, 0, 0}, {0, 0, 0, 1}, {0.05f, 0}, .scale = 1, .friction = 1};
    hair_test_ok(f->scene.test, hair_set_colliders(f->scene.hair, &ball, 1, sizeof ball));
}

static void put_boxes_into(struct fixture* f, hair_view* view)
{
    (void)view;
    hair_collider box[40];
    for (int i = 0; i < 40; ++i)
        box[i] = (hair_collider){HAIR_SHAPE_BOX,        {0.01 * i, 0, 0}, {0, 0, 0, 1},
                                 {0.05f, 0.02f, 0.03f}, .scale = 1,       .friction = 1};
    hair_test_ok(f->scene.test, hair_set_colliders(f->scene.hair, box, 40, sizeof *box));
}

static void wind_coupling_at(struct fixture* f, hair_view* view)
{
    (void)view;
    hair_wind wind = hair_wind_default();
    wind.model = HAIR_WIND_FLUID;
    wind.velocity[0] = 3;
    wind.fluid.drag_strand_count = 1;
    wind.fluid.resolution = 16;
    hair_test_ok(f->scene.test, hair_set_wind(f->scene.hair, &wind));
}

static void hair_grid(struct fixture* f, hair_view* view)
{
    (void)view;
    hair_physics physics = f->scene.hair->sim.physics;
    physics.hair_hair.cohesion = 5;
    hair_test_ok(f->scene.test, hair_set_physics(f->scene.hair, &physics));
}

static void shade_strands(struct fixture* f, hair_view* view)
{
    hair_look look = f->scene.hair->geometry.look;
    look.self_shadow.method = HAIR_SELF_SHADOW_STRANDS;
    look.shading.model = HAIR_SHADING_FIBRES;
    hair_test_ok(f->scene.test, hair_set_look(f->scene.hair, &look));
    put_a_ball_into(f, view);
}

static void fraction_pixels(struct fixture* f, hair_view* view)
{
    (void)f;
    view->coverage = HAIR_COVERAGE_ALPHA;
}

static void curl(struct fixture* f, hair_view* view)
{
    hair_look look = f->scene.hair->geometry.look;
    look.curl.radius = 0.01f;
    hair_test_ok(f->scene.test, hair_set_look(f->scene.hair, &look));
    put_a_ball_into(f, view);
}

static void lend_depth(struct fixture* f, hair_view* view)
{
    view->occluder_depth = f->depth;
}

// The depth function neither less nor greater disables culling, also after precompilation.
static void lend_depth_without_order(struct fixture* f, hair_view* view)
{
    lend_depth(f, view);
    put_a_ball_into(f, view);
    glDepthFunc(GL_ALWAYS);
}

// Show no displacement of followers, because the hair is small. A ball blocks its light.
static void shade_small_hair(struct fixture* f, hair_view* view)
{
    static hair_lod lod;
    lod = hair_lod_default();
    lod.per_patch = true;
    lod.importance = 1e-6f;
    view->lod = &lod;
    shade_strands(f, view);
    hair_look look = f->scene.hair->geometry.look;
    look.followers.collision = HAIR_FOLLOWER_COLLISION_NONE;
    hair_test_ok(f->scene.test, hair_set_look(f->scene.hair, &look));
}

static void show_motion(struct fixture* f, hair_view* view)
{
    (void)f;
    view->pass = HAIR_PASS_MOTION;
}

static void show_motion_beside_colour(struct fixture* f, hair_view* view)
{
    (void)f;
    view->motion_output = true;
}

static void leave_out(struct fixture* f, hair_view* view)
{
    static hair_lod lod;
    lod = hair_lod_default();
    lod.strand_fraction = 0.5f;
    lod.guide_pixels = 1e4f;
    view->lod = &lod;
    put_a_ball_into(f, view);
}

static void cut_hair(struct fixture* f, hair_view* view)
{
    const float half = 0.5f;
    (void)view;
    hair_test_ok(f->scene.test, hair_set_lengths(f->scene.hair, 0, 1, &half));
}

static void show_colliders(struct fixture* f, hair_view* view)
{
    put_a_ball_into(f, view);
    view->pass = HAIR_PASS_COLLIDERS;
    view->slice = HAIR_SLICE_X;
}

static const struct {
    const char* name;
    hair_render_path path;
    void (*set)(struct fixture* f, hair_view* view);
} ways[] = {
    {"a ball", HAIR_RENDER_PATH_TESSELLATION, put_a_ball_into},
    {"a ball, procedural", HAIR_RENDER_PATH_PROCEDURAL, put_a_ball_into},
    {"a ball, expanded", HAIR_RENDER_PATH_CACHED, put_a_ball_into},
    {"a ball, computed", HAIR_RENDER_PATH_COMPUTE, put_a_ball_into},
    {"boxes", HAIR_RENDER_PATH_TESSELLATION, put_boxes_into},
    {"a fluid", HAIR_RENDER_PATH_TESSELLATION, wind_coupling_at},
    {"a crowd", HAIR_RENDER_PATH_TESSELLATION, hair_grid},
    {"shadows by strands", HAIR_RENDER_PATH_TESSELLATION, shade_strands},
    {"fractions of pixels", HAIR_RENDER_PATH_CACHED, fraction_pixels},
    {"curls", HAIR_RENDER_PATH_TESSELLATION, curl},
    {"depth", HAIR_RENDER_PATH_TESSELLATION, lend_depth},
    {"depth, expanded", HAIR_RENDER_PATH_CACHED, lend_depth},
    {"depth, computed", HAIR_RENDER_PATH_COMPUTE, lend_depth},
    {"depth without order", HAIR_RENDER_PATH_TESSELLATION, lend_depth_without_order},
    {"depth without order, procedural", HAIR_RENDER_PATH_PROCEDURAL, lend_depth_without_order},
    {"depth without order, expanded", HAIR_RENDER_PATH_CACHED, lend_depth_without_order},
    {"shadows on small hair", HAIR_RENDER_PATH_TESSELLATION, shade_small_hair},
    {"levels of detail, computed", HAIR_RENDER_PATH_COMPUTE, leave_out},
    {"levels of detail, expanded", HAIR_RENDER_PATH_CACHED, leave_out},
    {"velocities", HAIR_RENDER_PATH_TESSELLATION, show_motion},
    {"velocities beside colour, computed", HAIR_RENDER_PATH_COMPUTE, show_motion_beside_colour},
    {"colliders", HAIR_RENDER_PATH_TESSELLATION, show_colliders},
    {"cut hair", HAIR_RENDER_PATH_TESSELLATION, cut_hair},
    {"cut hair, computed", HAIR_RENDER_PATH_COMPUTE, cut_hair},
};

static uint32_t count_compiled(const struct fixture* f)
{
    hair_report_info info = hair_report_info_default();
    uint32_t count;
    hair_test_ok(f->scene.test, hair_report(f->scene.hair, false, &info, NULL, 0, 0, &count));
    assert_true(info.compiled_programs > 0);
    return info.compiled_programs;
}

#define MAX_COLD 64

// Compute programs that have not run. Software rasterizers compile machine code when they run.
struct cold {
    hair_gl_pass pass[MAX_COLD];
    uint32_t count;
};

static struct cold find_cold(const struct hair_gl* gl)
{
    struct cold cold = {.count = 0};
    for (uint32_t i = 0; i < gl->programs && gl->compiles_late; ++i) {
        const struct hair_gl_program* own = gl->program[i];
        if (!own->program || own->is_warm || !strstr(hair_gl_row_stages(own->pass), ".comp")) continue;
        assert_true(cold.count < MAX_COLD);
        cold.pass[cold.count++] = own->pass;
    }
    return cold;
}

static void frames_compile_nothing_after_precompile(void** state)
{
    for (size_t i = 0; i < sizeof ways / sizeof *ways; ++i) {
        struct fixture f = start(*state);
        hair_view view = hair_test_view_by(ways[i].path);
        ways[i].set(&f, &view);
        // A first run of every program takes seconds, so that one way has to do.
        f.scene.context->gl.compiles_late &= ways[i].set == hair_grid;
        uint32_t calls = prepare(&f, &view);
        print_message("    %s: %u calls\n", ways[i].name, calls);
        uint32_t before = hair_test_count_programs(&f.scene.context->gl), compiled = count_compiled(&f);
        struct cold cold = find_cold(&f.scene.context->gl);
        live(&f, &view);
        for (uint32_t k = 0; k < cold.count; ++k)
            if (hair_test_runs(&f.scene.context->gl, cold.pass[k]) > 0)
                fail_msg("%s: %s ran first in a frame", ways[i].name,
                         hair_gl_find(&f.scene.context->gl, cold.pass[k])->label);
        assert_int_equal(count_compiled(&f), compiled);
        if (hair_test_count_programs(&f.scene.context->gl) != before)
            fail_msg("%s: of %u programs %u were prepared", ways[i].name,
                     hair_test_count_programs(&f.scene.context->gl), before);
        finish(&f);
    }
}

// Check that the table of fibres is there before the program of shades first runs. A software
// rasterizer would compile the program again for its format.
static void precompile_makes_textures_before_programs(void** state)
{
    struct fixture f = start(*state);
    hair_view view = hair_test_view_by(HAIR_RENDER_PATH_COMPUTE);
    bool ready = false;
    shade_strands(&f, &view);
    assert_int_equal(f.scene.hair->lighting.fibres.texture, 0);
    hair_test_ok(f.scene.test, hair_precompile(f.scene.hair, &view, &ready));
    assert_int_not_equal(f.scene.hair->lighting.fibres.texture, 0);
    finish(&f);
}

static void precompile_without_threads_compiles_one_program_a_call(void** state)
{
    struct fixture f = start(*state);
    hair_view view = hair_test_view_by(HAIR_RENDER_PATH_PROCEDURAL);
    f.scene.context->gl.parallel = 0;
    uint32_t before = hair_test_count_programs(&f.scene.context->gl);
    bool ready = false;
    put_a_ball_into(&f, &view);
    hair_test_ok(f.scene.test, hair_precompile(f.scene.hair, &view, &ready));
    assert_false(ready);
    assert_true(hair_test_count_programs(&f.scene.context->gl) <= before + 1);
    assert_true(f.scene.hair->told_pending > 2);
    uint32_t calls = 1 + prepare(&f, &view);
    // A call compiles a program or runs one on nothing. The last call finds nothing left.
    uint32_t made = hair_test_count_programs(&f.scene.context->gl) - before;
    assert_true(made < calls && calls <= 2 * made + 2);
    live(&f, &view);
    finish(&f);
}

// Check a frame before all programs are ready. A program under compilation is waited for if it is
// run, and freed if it is not.
static void frame_before_precompile_is_ready_draws(void** state)
{
    for (int lives = 0; lives < 2; ++lives) {
        struct fixture f = start(*state);
        hair_view view = hair_test_view_by(HAIR_RENDER_PATH_TESSELLATION);
        bool ready = false;
        f.scene.context->gl.parallel = 1;
        put_a_ball_into(&f, &view);
        hair_test_ok(f.scene.test, hair_precompile(f.scene.hair, &view, &ready));
        if (lives) live(&f, &view);
        finish(&f);
    }
}

static void precompile_refuses_null_and_invalid_views(void** state)
{
    struct fixture f = start(*state);
    hair_view view = hair_test_view_by(HAIR_RENDER_PATH_TESSELLATION);
    bool ready = true;
    assert_int_equal(hair_precompile(NULL, &view, &ready), HAIR_ERROR_ARGUMENT);
    assert_int_equal(hair_precompile(f.scene.hair, &view, NULL), HAIR_ERROR_ARGUMENT);
    view.opacity = 2;
    hair_test_refused(f.scene.test, hair_precompile(f.scene.hair, &view, &ready), HAIR_ERROR_ARGUMENT,
                      "hair_view.opacity");
    assert_true(ready);
    assert_int_equal(prepare(&f, NULL) <= MAX_CALLS, 1);
    finish(&f);
}

int main(void)
{
    if (hair_test_skips()) return 0;
    const struct CMUnitTest tests[] = {
        HAIR_TEST(frames_compile_nothing_after_precompile),
        HAIR_TEST(precompile_makes_textures_before_programs),
        HAIR_TEST(precompile_without_threads_compiles_one_program_a_call),
        HAIR_TEST(frame_before_precompile_is_ready_draws),
        HAIR_TEST(precompile_refuses_null_and_invalid_views),
    };
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
