// report_test.c - the report lists the work that was done, the work that was skipped and the
// reason, and memory. Disabled features have none.
#include "tests/support/scene.h"

#include <math.h>
#include <string.h>
#include <threads.h>

#include "tests/support/trace.h"

enum { MAX = 64 };

struct fixture {
    struct hair_test_scene scene;
    hair_report_info info;
    hair_report_row row[MAX];
    uint32_t rows;
};

static struct fixture start(void** state, const hair_physics* physics)
{
    struct fixture f = {hair_test_scene_make(*state, hair_test_trace_proc), .rows = 0};
    hair_desc desc = hair_desc_default();
    desc.physics = physics;
    hair_test_scene_add(&f.scene, NULL, &desc);
    hair_test_set_orthographic(&f.scene.view, 2, 2, 0);
    hair_test_frame_make(&f.scene.frame, 32, 32, GL_RGBA8, 0);
    return f;
}

// Make other hair in the context of a fixture.
static struct fixture start_beside(const struct fixture* f)
{
    struct fixture other = {.scene = {.test = f->scene.test, .context = f->scene.context}};
    hair_test_scene_add(&other.scene, NULL, NULL);
    return other;
}

static void finish_beside(struct fixture* other)
{
    other->scene.context = NULL;
    hair_test_scene_free(&other->scene);
}

static void report(struct fixture* f)
{
    f->info = hair_report_info_default();
    hair_test_ok(f->scene.test,
                 hair_report(f->scene.hair, true, &f->info, f->row, sizeof *f->row, MAX, &f->rows));
    assert_in_range(f->rows, 10, MAX);
    assert_int_equal(f->info.age, 0);
}

static void run_frame(struct fixture* f)
{
    hair_test_ok(f->scene.test, hair_step(f->scene.hair, 1.0f / 60));
    hair_test_ok(f->scene.test, hair_draw(f->scene.hair, &f->scene.view));
    report(f);
}

static const hair_report_row* row_of(const struct fixture* f, const char* work)
{
    for (uint32_t i = 0; i < f->rows; ++i)
        if (strcmp(f->row[i].stage, work) == 0) return &f->row[i];
    fail_msg("there is no row %s", work);
    return NULL;
}

// Check a row. `memory` is 1 if the row must have memory, 0 if it must not, and -1 if it may.
static void check(const struct fixture* f, const char* work, hair_skip_reason why, int memory)
{
    const hair_report_row* row = row_of(f, work);
    if (row->skip_reason != why)
        fail_msg("%s: %s, not %s", work, hair_skip_reason_string(row->skip_reason),
                 hair_skip_reason_string(why));
    assert_int_equal(row->runs > 0, why == HAIR_SKIP_REASON_NONE);
    assert_int_equal(row->pass != NULL, why == HAIR_SKIP_REASON_NONE);
    if (memory >= 0 && (row->bytes > 0) != memory)
        fail_msg("%s has %llu bytes", work, (unsigned long long)row->bytes);
}

// Check a scene without wind, colliders, hair-hair grid, skinned scalp, strand list or vertex
// cache. None of them has a pass or memory.
static void unused_features_run_no_stage_and_keep_no_memory(void** state)
{
    static const char* const none[] = {
        "unpack_positions", "skin_scalp", "targets",      "root_transforms", "wind",     "hair_grid",
        "bind_followers",   "expand",     "scan_strands", "compact_strands", "diagnose", "impulses"};
    struct fixture f = start(state, NULL);
    hair_test_trace_clear();
    run_frame(&f);
    for (size_t i = 0; i < sizeof none / sizeof *none; ++i)
        check(&f, none[i], HAIR_SKIP_REASON_NOT_WANTED, 0);
    check(&f, "field", HAIR_SKIP_REASON_NONE_NEAR, 0);
    check(&f, "hit", HAIR_SKIP_REASON_NONE_NEAR, 0);
    check(&f, "repair", HAIR_SKIP_REASON_NONE_NEAR, 0);
    check(&f, "activity", HAIR_SKIP_REASON_NOT_DUE, 0);
    check(&f, "depth", HAIR_SKIP_REASON_NOT_CALLED, 0);
    check(&f, "solve", HAIR_SKIP_REASON_NONE, 1);
    check(&f, "smooth", HAIR_SKIP_REASON_NONE, 1);
    check(&f, "color", HAIR_SKIP_REASON_NONE, 1);
    uint64_t runs = 0;
    for (uint32_t i = 0; i < f.rows; ++i) runs += f.row[i].runs;
    assert_int_equal(runs, 3); // Passes solve, smooth and color.
    hair_test_ok(f.scene.test, hair_draw(f.scene.hair, &f.scene.view));
    report(&f);
    assert_int_equal(row_of(&f, "color")->runs, 2);
    assert_int_equal(row_of(&f, "smooth")->runs, 1);
    hair_test_scene_free(&f.scene);
}

// Check that memory of removed features is freed.
static void removed_features_free_their_memory(void** state)
{
    struct fixture f = start(state, NULL);
    hair_collider collider = hair_collider_default();
    hair_physics physics = hair_physics_default();
    run_frame(&f);
    uint64_t before = f.info.bytes;
    collider.size[0] = 0.12f, physics.hair_hair.cohesion = 3;
    hair_test_ok(f.scene.test, hair_set_colliders(f.scene.hair, &collider, 1, sizeof collider));
    hair_test_ok(f.scene.test, hair_set_physics(f.scene.hair, &physics));
    run_frame(&f);
    check(&f, "field", HAIR_SKIP_REASON_NONE, 1);
    check(&f, "hit", HAIR_SKIP_REASON_NONE, 1);
    check(&f, "repair", HAIR_SKIP_REASON_NONE, 1);
    check(&f, "hair_grid", HAIR_SKIP_REASON_NONE, 1);
    print_message("    %llu bytes, with a collider and a hair-hair grid %llu\n", (unsigned long long)before,
                  (unsigned long long)f.info.bytes);
    physics.hair_hair.cohesion = 0;
    hair_test_ok(f.scene.test, hair_set_colliders(f.scene.hair, NULL, 0, sizeof collider));
    hair_test_ok(f.scene.test, hair_set_physics(f.scene.hair, &physics));
    run_frame(&f);
    check(&f, "field", HAIR_SKIP_REASON_NONE_NEAR, 0);
    check(&f, "hit", HAIR_SKIP_REASON_NONE_NEAR, 0);
    check(&f, "repair", HAIR_SKIP_REASON_NONE_NEAR, 0);
    check(&f, "hair_grid", HAIR_SKIP_REASON_NOT_WANTED, 0);
    assert_true(f.info.bytes == before);
    hair_test_scene_free(&f.scene);
}

// Check that reports of two instances count all memory of the context, by whichever call it was
// created, and that destroying an instance leaves that of the other.
static void reports_count_all_memory_of_each_instance(void** state)
{
    static const hair_render_path paths[] = {HAIR_RENDER_PATH_TESSELLATION, HAIR_RENDER_PATH_CACHED,
                                             HAIR_RENDER_PATH_COMPUTE};
    struct fixture f = start(state, NULL), other = start_beside(&f);
    hair_memory memory = hair_memory_default();
    hair_collider collider = hair_collider_default();
    hair_physics physics = hair_physics_default();
    hair_wind wind = hair_wind_default();
    float positions[3];
    uint32_t count;
    collider.size[0] = 0.12f, physics.hair_hair.cohesion = 3, physics.sleep_threshold = 0.01f;
    wind.model = HAIR_WIND_FLUID, wind.fluid.resolution = 16, wind.velocity[0] = 2;
    hair_test_ok(f.scene.test, hair_set_colliders(f.scene.hair, &collider, 1, sizeof collider));
    hair_test_ok(f.scene.test, hair_set_physics(f.scene.hair, &physics));
    hair_test_ok(f.scene.test, hair_set_wind(f.scene.hair, &wind));
    hair_test_ok(f.scene.test, hair_set_colliders(other.scene.hair, &collider, 1, sizeof collider));
    hair_test_ok(f.scene.test,
                 hair_read_positions(other.scene.hair, HAIR_READ_FOLLOWERS, positions, 1, &count));
    for (size_t i = 0; i < sizeof paths / sizeof *paths; ++i) {
        f.scene.view.render_path = paths[i];
        run_frame(&f);
        hair_test_ok(f.scene.test, hair_step(other.scene.hair, 1.0f / 60));
        report(&other);
        hair_test_ok(f.scene.test, hair_get_memory(f.scene.context, &memory));
        assert_true(f.info.bytes > other.info.bytes && other.info.bytes > 0);
        uint64_t common = hair_groom_follower_bytes(f.scene.groom) +
                          hair_groom_follower_bytes(other.scene.groom) +
                          hair_test_sample_bytes(f.scene.context);
        assert_true(f.info.bytes + other.info.bytes + common == memory.bytes);
    }
    assert_true(row_of(&f, "wind")->bytes > 0);
    check(&other, "wind", HAIR_SKIP_REASON_NOT_WANTED, 0);
    check(&other, "hit", HAIR_SKIP_REASON_NOT_CALLED, 1);
    finish_beside(&other);
    report(&f);
    hair_test_ok(f.scene.test, hair_get_memory(f.scene.context, &memory));
    uint64_t common = hair_groom_follower_bytes(f.scene.groom) + hair_test_sample_bytes(f.scene.context);
    assert_true(f.info.bytes + common == memory.bytes);
    hair_test_scene_free(&f.scene);
}

static void report_names_sleep_and_culling_as_reasons(void** state)
{
    hair_physics physics = hair_physics_default();
    physics.sleep_threshold = 0.01f;
    struct fixture f = start(state, &physics);
    f.scene.view.render_path = HAIR_RENDER_PATH_CACHED;
    for (int i = 0; i < 600 && !f.scene.hair->sim.sleep.asleep; ++i) run_frame(&f);
    run_frame(&f);
    run_frame(&f);
    check(&f, "solve", HAIR_SKIP_REASON_ASLEEP, 1);
    check(&f, "activity", HAIR_SKIP_REASON_ASLEEP, 1);
    check(&f, "smooth", HAIR_SKIP_REASON_UNCHANGED, 1);
    check(&f, "expand", HAIR_SKIP_REASON_UNCHANGED, 1);
    check(&f, "compact_strands", HAIR_SKIP_REASON_UNCHANGED, 1);
    check(&f, "color", HAIR_SKIP_REASON_NONE, 1);
    // Vertices that a pass of their own shades count as colour.
    check(&f, "colliders", HAIR_SKIP_REASON_NOT_CALLED, 0);
    f.scene.view.view[12] = 20;
    run_frame(&f);
    check(&f, "color", HAIR_SKIP_REASON_OUT_OF_VIEW, 1);
    check(&f, "smooth", HAIR_SKIP_REASON_OUT_OF_VIEW, 1);
    assert_true(f.info.ms == 0);
    hair_test_scene_free(&f.scene);
}

// Check reports in every frame, of two instances in turn. Nothing waits, frames are in order, and
// each report belongs to its instance. A busy GPU may take longer than 20 frames to answer, so more
// frames follow with pauses until the first report.
static void report_does_not_wait_and_is_of_one_instance(void** state)
{
    struct fixture f = start(state, NULL), other = start_beside(&f);
    uint32_t last = 0;
    f.info = hair_report_info_default();
    hair_test_trace_clear();
    static const struct timespec pause = {.tv_nsec = 10000000};
    for (int i = 0; i < 20 || (last == 0 && i < 1000); ++i) {
        if (i >= 20) thrd_sleep(&pause, NULL);
        hair_test_ok(f.scene.test, hair_step(f.scene.hair, 1.0f / 60));
        hair_test_ok(f.scene.test, hair_step(other.scene.hair, 1.0f / 60));
        hair_test_ok(f.scene.test, hair_draw(f.scene.hair, &f.scene.view));
        hair_test_ok(f.scene.test,
                     hair_report(f.scene.hair, false, &f.info, f.row, sizeof *f.row, MAX, &f.rows));
        if (!f.rows) continue;
        assert_in_range(f.info.frame, last, i + 1);
        assert_int_equal(f.info.frame + f.info.age, i + 1);
        assert_true(f.info.ms >= 0 && isfinite(f.info.ms));
        assert_int_equal(row_of(&f, "solve")->runs, 1);
        last = f.info.frame;
    }
    assert_int_equal(hair_test_trace_waits(), 0);
    assert_true(last > 0);
    report(&other);
    check(&other, "color", HAIR_SKIP_REASON_NOT_CALLED, 1);
    check(&other, "smooth", HAIR_SKIP_REASON_NOT_CALLED, 1);
    finish_beside(&other);
    hair_test_scene_free(&f.scene);
}

static double now_ms(void)
{
    struct timespec now;
    timespec_get(&now, TIME_UTC);
    return 1e3 * (double)now.tv_sec + 1e-6 * (double)now.tv_nsec;
}

// Draws without steps are of one frame. The last of them must not count as parts of a timed one.
// On a busy machine the draws may take longer than the pause, so their time is measured.
static void pause_after_many_draws_is_no_time_of_a_stage(void** state)
{
    struct fixture f = start(state, NULL);
    double began = now_ms(), pause = 0;
    run_frame(&f);
    hair_test_ok(f.scene.test, hair_step(f.scene.hair, 1.0f / 60));
    for (int i = 0; i < 80; ++i) {
        if (i == 60) {
            glFinish();
            pause = now_ms();
            thrd_sleep(&(struct timespec){.tv_nsec = 800 * 1000 * 1000}, NULL);
            pause = now_ms() - pause;
        }
        f.scene.view.pass = i % 2 ? HAIR_PASS_DEPTH : HAIR_PASS_COLOR;
        hair_test_ok(f.scene.test, hair_draw(f.scene.hair, &f.scene.view));
    }
    report(&f);
    assert_true(row_of(&f, "color")->runs >= 40);
    double busy = now_ms() - began - pause;
    for (uint32_t i = 0; i < f.rows; ++i) assert_true((double)f.row[i].ms < busy);
    hair_test_scene_free(&f.scene);
}

static void report_refuses_invalid_arguments(void** state)
{
    struct fixture f = start(state, NULL);
    hair_report_info info = hair_report_info_default();
    uint32_t count;
    size_t stride = sizeof *f.row;
    assert_int_equal(hair_report(NULL, false, &info, f.row, stride, MAX, &count), HAIR_ERROR_ARGUMENT);
    hair_test_refused(f.scene.test, hair_report(f.scene.hair, 0, NULL, f.row, stride, MAX, &count),
                      HAIR_ERROR_ARGUMENT, "hair_report_info is NULL");
    hair_test_refused(f.scene.test, hair_report(f.scene.hair, false, &info, f.row, stride, MAX, NULL),
                      HAIR_ERROR_ARGUMENT, "count is NULL");
    hair_test_refused(f.scene.test, hair_report(f.scene.hair, false, &info, NULL, stride, 1, &count),
                      HAIR_ERROR_ARGUMENT, "rows is NULL but capacity is 1");
    hair_test_refused(f.scene.test, hair_report(f.scene.hair, false, &info, f.row, 1, MAX, &count),
                      HAIR_ERROR_ARGUMENT, "stride is 1, not in");
    hair_test_ok(f.scene.test, hair_report(f.scene.hair, false, &info, NULL, 0, 0, &count));
    assert_int_equal(info.frame, 0);
    assert_int_equal(count, 0);
    assert_null(hair_skip_reason_string((hair_skip_reason)(HAIR_SKIP_REASON_NOT_CALLED + 1)));
    hair_test_scene_free(&f.scene);
}

int main(void)
{
    if (hair_test_skips()) return 0;
    const struct CMUnitTest tests[] = {
        HAIR_TEST(unused_features_run_no_stage_and_keep_no_memory),
        HAIR_TEST(removed_features_free_their_memory),
        HAIR_TEST(reports_count_all_memory_of_each_instance),
        HAIR_TEST(report_names_sleep_and_culling_as_reasons),
        HAIR_TEST(report_does_not_wait_and_is_of_one_instance),
        HAIR_TEST(pause_after_many_draws_is_no_time_of_a_stage),
        HAIR_TEST(report_refuses_invalid_arguments),
    };
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
