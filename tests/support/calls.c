// calls.c - every call that uses OpenGL, in a valid order.
#include "tests/support/support.h" // before what includes OpenGL's own header

#include "lib/api/api.h"
#include "tests/support/calls.h"
#include "tests/support/render_paths.h"
#include "tests/support/tessellated.h"
#include "tests/support/ways.h"

static hair_result create_context(struct hair_test_calls* f)
{
    hair_context_desc desc = hair_context_desc_default();
    desc.host = f->host;
    desc.get_proc = hair_egl_get_proc;
    desc.timings = true;
    desc.gl_state = f->promise;
    HAIR_TRY(hair_context_create(&desc, &f->context));
    f->context->gl.records = true; // llvmpipe does not profit from recording.
    return HAIR_OK;
}
static hair_result reload(struct hair_test_calls* f)
{
    return hair_context_reload(f->context);
}
static hair_result create(struct hair_test_calls* f)
{
    hair_desc desc = hair_test_way(f->way);
    if (desc.solver == HAIR_SOLVER_REDBLACK)
        // This mapping changes more state than compute.
        desc.thread_mapping = HAIR_THREAD_MAPPING_FEEDBACK;
    desc.hit_method = f->way % 2 ? HAIR_HIT_METHOD_PREPASS : HAIR_HIT_METHOD_COMPUTE;
    HAIR_TRY(hair_create(f->context, f->groom, &desc, &f->hair));
    return hair_create(f->context, f->groom, &desc, &f->twin);
}
static hair_result step(struct hair_test_calls* f)
{
    return hair_step(f->hair, 1.0f / 30);
}
static hair_result step_list(struct hair_test_calls* f)
{
    return hair_step_list((hair_instance*[]){f->hair, f->twin}, 2, 1.0f / 30);
}
static hair_result step_without_substep(struct hair_test_calls* f)
{
    return hair_step(f->hair, 1e-4f);
}
static hair_result reset(struct hair_test_calls* f)
{
    return hair_reset(f->hair);
}
static hair_result set_all(struct hair_test_calls* f)
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
static hair_result teleport(struct hair_test_calls* f)
{
    hair_desc desc = hair_desc_default();
    desc.transform[12] = 3;
    return hair_teleport(f->hair, desc.transform);
}
// Number of ways to draw, 5 for each render path. Every pair of path, pass and primitive occurs.
#define DRAWS (5 * HAIR_TEST_PATHS)
static hair_result draw_as(struct hair_test_calls* f, int i)
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
static hair_result draw_list(struct hair_test_calls* f)
{
    hair_view view = hair_test_tessellated();
    hair_result result = HAIR_OK;
    for (int i = 0; i < HAIR_TEST_PATHS && !result; ++i) {
        view.render_path = hair_test_paths[i];
        result = hair_draw_list((hair_instance*[]){f->hair, f->twin}, 2, &view);
    }
    return result;
}
static hair_result draw_again(struct hair_test_calls* f)
{
    static const int some[] = {0, 1, 2, 3, 4, 5, 10};
    hair_result result = HAIR_OK;
    for (size_t i = 0; i < sizeof some / sizeof *some && !result; ++i) result = draw_as(f, some[i]);
    return result;
}
// Draw in several ways. Only one way of simulation tests all of them, because drawing does not
// depend on it and compilation takes long.
static hair_result draw(struct hair_test_calls* f)
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
static hair_result read_all(struct hair_test_calls* f)
{
    float positions[300];
    uint32_t count;
    hair_result result = HAIR_OK;
    for (int what = 0; what < 3 && !result; ++what)
        result = hair_read_positions(f->hair, (hair_read_source)what, positions, 100, &count);
    return result;
}
static hair_result prepare(struct hair_test_calls* f)
{
    hair_view view = hair_test_tessellated();
    bool ready = false;
    view.render_path = HAIR_RENDER_PATH_CACHED;
    return hair_precompile(f->hair, &view, &ready);
}
static hair_result ask_field(struct hair_test_calls* f)
{
    hair_field_info info = hair_field_info_default();
    hair_result result = hair_get_field(f->hair, &info);
    return result || info.distance_texture ? result : HAIR_ERROR_ARGUMENT;
}
static hair_result save_and_load(struct hair_test_calls* f)
{
    static unsigned char bytes[65536];
    size_t size = 0;
    hair_result result = hair_save(f->hair, bytes, sizeof bytes, &size);
    return result ? result : hair_load(f->hair, bytes, size);
}
static hair_result time_all(struct hair_test_calls* f)
{
    hair_timing timings[32];
    return hair_get_timings(f->context, timings, 32) > 0 ? HAIR_OK : HAIR_ERROR_OPENGL;
}
static hair_result ask_solver_stats(struct hair_test_calls* f)
{
    hair_solver_stats solver_stats = hair_solver_stats_default();
    return hair_get_solver_stats(f->hair, &solver_stats);
}
static hair_result destroy(struct hair_test_calls* f)
{
    hair_destroy(f->hair);
    hair_destroy(f->twin);
    return HAIR_OK;
}
static hair_result destroy_context(struct hair_test_calls* f)
{
    hair_context_destroy(f->context);
    return HAIR_OK;
}

static const struct {
    const char* name;
    hair_result (*call)(struct hair_test_calls*);
} calls[HAIR_TEST_CALLS] = {
    {"hair_context_create", create_context},
    {"hair_create", create},
    {"hair_step", step},
    {"hair_step without a substep", step_without_substep},
    {"setters", set_all},
    {"hair_precompile", prepare},
    {"hair_step with a collider", step},
    {"hair_get_field", ask_field},
    {"hair_draw", draw},
    {"hair_step_list", step_list},
    {"hair_draw_list", draw_list},
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

const char* hair_test_call_name(uint32_t number)
{
    return calls[number].name;
}

hair_result hair_test_call(struct hair_test_calls* f, uint32_t number)
{
    return calls[number].call(f);
}
