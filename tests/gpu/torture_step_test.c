// torture_step_test.c - calls of simulation with memory, objects and a driver that are refused at
// one site after the other. Each failure changes nothing, leaks nothing, and a retry works.
#define _POSIX_C_SOURCE 200809L
#include "tests/support/torture.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "tests/support/grooms.h"
#include "tests/support/ways.h"

#define DT 0.0237f // Time of a step, s. Steps end within a substep.
#define BYTES (1 << 20) // Upper bound on the size of a state.

enum { FEEDBACK = HAIR_TEST_WAYS, WAYS }; // Ways with transform feedback.

static const char* way_name(int way)
{
    return way == FEEDBACK ? "redblack by transform feedback" : hair_test_way_name(way);
}

static hair_desc way_desc(int way)
{
    hair_desc desc = hair_test_way(way == FEEDBACK ? HAIR_TEST_WAYS - 1 : way);
    if (way == FEEDBACK) desc.thread_mapping = HAIR_THREAD_MAPPING_FEEDBACK;
    desc.diagnose = way % 2;
    return desc;
}

static bool has_rods(const struct hair_test_torture* t)
{
    return way_desc(t->variant).solver != HAIR_SOLVER_REDBLACK;
}

// Settings ----------------------------------------------------------------------------------------

static void set_physics(struct hair_test_torture* t, float rate)
{
    hair_physics physics = hair_physics_default();
    physics.substep_rate = rate;
    physics.hair_hair.cohesion = 5;
    hair_test_ok(t->test, hair_set_physics(t->hair, &physics));
}

static void set_wind(struct hair_test_torture* t)
{
    hair_wind wind = hair_wind_default();
    wind.model = HAIR_WIND_FLUID;
    wind.velocity[0] = 2;
    wind.turbulence.intensity = t->variant % 3 ? 0 : 0.3f; // Gusts take long.
    wind.fluid.resolution = 16;
    wind.fluid.drag_strand_count = 1000;
    hair_test_ok(t->test, hair_set_wind(t->hair, &wind));
}

static hair_result set_pins(struct hair_test_torture* t, uint32_t count)
{
    hair_pin pins[9];
    for (uint32_t i = 0; i < 9; ++i) {
        pins[i] = hair_pin_default();
        pins[i].guide = i;
        pins[i].position[1] = 0.05f;
    }
    return hair_set_pins(t->hair, pins, count, sizeof *pins);
}

static hair_result set_scalp(struct hair_test_torture* t)
{
    struct hair_test_scalp scalp = hair_test_scalp_make(4, 0.4f);
    for (uint32_t i = 0; i < scalp.vertex_count; ++i)
        scalp.positions[3 * i + 1] += 0.1f * scalp.positions[3 * i];
    hair_result result = hair_set_scalp(t->hair, scalp.positions, scalp.vertex_count, 12, NULL);
    hair_test_scalp_free(&scalp);
    return result;
}

// Skin the scalp by two joints.
static hair_result set_joints(struct hair_test_torture* t)
{
    float matrices[32] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0.1f, 0, 1,
                          1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0.2f, 0, 1};
    return hair_set_scalp_joints(t->hair, matrices, 2, NULL);
}

static hair_result set_weights(struct hair_test_torture* t)
{
    uint16_t joints[100];
    float weights[100];
    for (uint16_t i = 0; i < 100; ++i) joints[i] = i % 2, weights[i] = i % 4 < 2 ? 0.5f : 0;
    return hair_set_scalp_weights(t->hair, joints, weights, 25, 2);
}

static hair_result set_many(struct hair_test_torture* t, uint32_t count)
{
    hair_collider colliders[80];
    for (uint32_t i = 0; i < 80; ++i) {
        colliders[i] = hair_collider_default();
        colliders[i].size[0] = 0.02f;
        colliders[i].position[0] = 0.01f * (float)(i % 40);
        colliders[i].position[1] = 0.12f;
        colliders[i].position[2] = 0.1f + 0.2f * (float)(i / 40);
        if (i % 8 || !t->mesh) continue;
        colliders[i].shape = HAIR_SHAPE_MESH;
        colliders[i].mesh = t->mesh;
    }
    return hair_set_colliders(t->hair, colliders, count, sizeof *colliders);
}

// Set everything for which a step needs more.
static void set_everything(struct hair_test_torture* t)
{
    hair_test_torture_collide(t);
    set_wind(t);
    set_physics(t, 1);
    if (has_rods(t)) hair_test_ok(t->test, set_pins(t, 4));
}

static void free_bytes(struct hair_test_torture* t)
{
    free(t->bytes);
    t->bytes = NULL;
}

// Preparations ------------------------------------------------------------------------------------

static void start_nothing(struct hair_test_torture* t)
{
    (void)t;
}

static void start_at_rest(struct hair_test_torture* t)
{
    hair_desc desc = way_desc(t->variant);
    hair_test_torture_add(t, &desc);
}

static void start_moving(struct hair_test_torture* t)
{
    start_at_rest(t);
    for (int i = 0; i < 3; ++i) hair_test_ok(t->test, hair_step(t->hair, DT));
}

// The next step needs everything for the first time.
static void start_changed(struct hair_test_torture* t)
{
    start_moving(t);
    set_everything(t);
}

// The next step needs more of everything than the last.
static void start_grown(struct hair_test_torture* t)
{
    start_changed(t);
    hair_test_ok(t->test, set_scalp(t));
    hair_test_ok(t->test, hair_step(t->hair, DT));
    if (has_rods(t)) hair_test_ok(t->test, set_pins(t, 9));
    set_physics(t, 0.5f);
    hair_test_ok(t->test, set_many(t, 80));
}

// The scalp's vertices have joints, which are not set yet.
static void start_weighted(struct hair_test_torture* t)
{
    start_moving(t);
    hair_test_ok(t->test, set_weights(t));
}

// A state that has everything is to be loaded into hair that has nothing.
static void start_saved(struct hair_test_torture* t)
{
    start_changed(t);
    hair_test_ok(t->test, set_scalp(t));
    hair_test_ok(t->test, hair_step(t->hair, DT));
    t->bytes = malloc(BYTES);
    hair_test_ok(t->test, hair_save(t->hair, t->bytes, BYTES, &t->size));
    hair_destroy(t->hair);
    start_moving(t);
    set_everything(t);
}

// Calls -------------------------------------------------------------------------------------------

static hair_result create_context(struct hair_test_torture* t)
{
    return hair_test_torture_context(t, &t->context);
}

static hair_result create(struct hair_test_torture* t)
{
    hair_desc desc = way_desc(t->variant);
    return hair_create(t->context, t->groom, &desc, &t->hair);
}

static hair_result create_shader(struct hair_test_torture* t)
{
    hair_shader_desc desc = hair_shader_desc_default();
    desc.glsl = "vec4 hair_shade(hair_fragment f) { return vec4(f.color, 1); }";
    desc.at = t->variant ? HAIR_SHADE_PIXELS : HAIR_SHADE_VERTICES;
    return hair_shader_create(t->context, &desc, &t->shader);
}

static hair_result step(struct hair_test_torture* t)
{
    return hair_step(t->hair, DT);
}

static hair_result load(struct hair_test_torture* t)
{
    return hair_load(t->hair, t->bytes, t->size);
}

static hair_result teleport(struct hair_test_torture* t)
{
    static const float to[16] = {0, 0, -1, 0, 0, 1, 0, 0, 1, 0, 0, 0, 3, 2, 1, 1};
    return hair_teleport(t->hair, to);
}

static hair_result get_field(struct hair_test_torture* t)
{
    hair_field_info field = hair_field_info_default();
    hair_result result = hair_get_field(t->hair, &field);
    assert_int_equal(result == HAIR_OK, field.size[0] > 0);
    return result;
}

static hair_result get_stats(struct hair_test_torture* t)
{
    hair_solver_stats stats = hair_solver_stats_default();
    hair_result result = hair_get_solver_stats(t->hair, &stats);
    assert_int_equal(result == HAIR_OK, stats.substep > 0);
    return result;
}

static hair_result read_followers(struct hair_test_torture* t)
{
    float positions[300];
    uint32_t count;
    return hair_read_positions(t->hair, HAIR_READ_FOLLOWERS, positions, 100, &count);
}

static hair_result read_report(struct hair_test_torture* t)
{
    hair_report_info info = hair_report_info_default();
    hair_report_row rows[64];
    uint32_t count;
    return hair_report(t->hair, true, &info, rows, sizeof *rows, 64, &count);
}

static hair_result precompile(struct hair_test_torture* t)
{
    hair_result result = HAIR_OK;
    t->view = hair_test_torture_view();
    t->view.render_path = HAIR_RENDER_PATH_COMPUTE;
    bool is_ready = false;
    const struct timespec pause = {.tv_nsec = 10000000}; // for the threads of the driver
    for (int i = 0; i < 6000 && !result && !is_ready; ++i) {
        result = hair_precompile(t->hair, &t->view, &is_ready);
        if (!is_ready && !result && t->hair->sim.gl->parallel) nanosleep(&pause, NULL);
    }
    assert_int_equal(result == HAIR_OK, is_ready);
    return result;
}

static hair_result reload(struct hair_test_torture* t)
{
    return hair_context_reload(t->context);
}

static hair_result reset(struct hair_test_torture* t)
{
    return hair_reset(t->hair);
}

static hair_result collide(struct hair_test_torture* t)
{
    return set_many(t, 80);
}

static hair_result pin(struct hair_test_torture* t)
{
    return set_pins(t, 9);
}

// Tests -------------------------------------------------------------------------------------------

static bool is_left_out(const char* name)
{
    const char* only = getenv("HAIR_TEST_ONLY");
    return only && strcmp(only, name) != 0;
}

static void refused_steps_change_and_leak_nothing(void** state)
{
    static const struct {
        const char* name;
        void (*start)(struct hair_test_torture* t);
        hair_result (*call)(struct hair_test_torture* t);
    } calls[] = {
        {"create", start_nothing, create},
        {"step that needs everything", start_changed, step},
        {"step that needs more", start_grown, step},
        {"load", start_saved, load},
    };
    for (int way = 0; way < WAYS; ++way)
        for (size_t i = 0; i < sizeof calls / sizeof *calls; ++i) {
            char name[96];
            snprintf(name, sizeof name, "%s, %s", calls[i].name, way_name(way));
            struct hair_test_torture t = {.test = *state,
                                          .name = name,
                                          .variant = way,
                                          .is_cached = (way + (int)i) % 2,
                                          .has_varying_memory = calls[i].start == start_grown,
                                          .has_clobbered_state = way % 3 == 1,
                                          .start = calls[i].start,
                                          .call = calls[i].call,
                                          .finish = free_bytes};
            if (!is_left_out(name)) hair_test_torture_run(&t);
        }
}

static void other_refused_calls_change_and_leak_nothing(void** state)
{
    static const struct {
        const char* name;
        int way;
        bool is_cached;
        void (*start)(struct hair_test_torture* t);
        hair_result (*call)(struct hair_test_torture* t);
    } calls[] = {
        {"context", 0, false, NULL, create_context},
        {"context with cache", 0, true, NULL, create_context},
        {"vertex shader", 0, false, start_at_rest, create_shader},
        {"pixel shader", 1, true, start_at_rest, create_shader},
        {"scalp", 0, false, start_changed, set_scalp},
        {"scalp of redblack", 6, false, start_changed, set_scalp},
        {"joints of vertices", 0, false, start_moving, set_weights},
        {"joints", 0, false, start_weighted, set_joints},
        {"teleport", 0, false, start_changed, teleport},
        {"teleport of redblack", 6, true, start_moving, teleport},
        {"field", 0, false, start_changed, get_field},
        {"statistics", 1, false, start_moving, get_stats},
        {"followers", 0, false, start_changed, read_followers},
        {"report", 0, false, start_grown, read_report},
        {"precompile", 0, false, start_changed, precompile},
        {"precompile with cache", 0, true, start_grown, precompile},
        {"reload", 0, false, start_grown, reload},
        {"reset", 0, false, start_grown, reset},
        {"colliders", 0, false, start_grown, collide},
        {"pins", 0, false, start_moving, pin},
    };
    for (size_t i = 0; i < sizeof calls / sizeof *calls; ++i) {
        struct hair_test_torture t = {.test = *state,
                                      .name = calls[i].name,
                                      .variant = calls[i].way,
                                      .is_cached = calls[i].is_cached,
                                      .start = calls[i].start,
                                      .call = calls[i].call,
                                      .finish = free_bytes};
        if (!is_left_out(t.name)) hair_test_torture_run(&t);
    }
    hair_test_torture_tell(getenv("HAIR_TEST_ONLY") ? 0 : 300);
}

int main(void)
{
    if (hair_test_skips()) return 0;
    const struct CMUnitTest tests[] = {
        HAIR_TEST(refused_steps_change_and_leak_nothing),
        HAIR_TEST(other_refused_calls_change_and_leak_nothing),
    };
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
