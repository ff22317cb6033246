// report_test.c - the report lists the work that was done, the work that was skipped and the
// reason, and memory. Disabled features have none.
#include "tests/support/support.h"

#include <math.h>
#include <string.h>
#include <threads.h>

#include "lib/api/api.h"
#include "tests/support/frame.h"
#include "tests/support/handmade.h"
#include "tests/support/trace.h"

enum { MAX = 64 };

struct fixture {
    struct hair_test* test;
    hair_context* context;
    hair_instance* hair;
    struct hair_test_frame frame;
    hair_view view;
    hair_report_info info;
    hair_report_row row[MAX];
    uint32_t rows;
};

static struct fixture start(void** state, const hair_physics* physics)
{
    struct fixture f = {.test = *state, .view = hair_view_default()};
    hair_context_desc desc = hair_context_desc_default();
    hair_desc of = hair_desc_default();
    struct hair_test_handmade wanted = hair_test_handmade_default();
    desc.host = &f.test->host.host;
    desc.get_proc = hair_test_trace_proc;
    desc.timings = true;
    of.physics = physics;
    f.view.projection[0] = f.view.projection[5] = f.view.projection[10] = 2;
    hair_test_ok(f.test, hair_context_create(&desc, &f.context));
    hair_groom* groom = hair_test_groom(desc.host, wanted);
    hair_test_ok(f.test, hair_create(f.context, groom, &of, &f.hair));
    hair_groom_destroy(groom);
    hair_test_frame_make(&f.frame, 32, 32, GL_RGBA8, 0);
    return f;
}

static void finish(struct fixture* f)
{
    hair_test_frame_free(&f->frame);
    hair_destroy(f->hair);
    hair_context_destroy(f->context);
}

static void report(struct fixture* f)
{
    f->info = hair_report_info_default();
    hair_test_ok(f->test, hair_report(f->hair, true, &f->info, f->row, sizeof *f->row, MAX, &f->rows));
    assert_in_range(f->rows, 10, MAX);
    assert_int_equal(f->info.age, 0);
}

static void run_frame(struct fixture* f)
{
    hair_test_ok(f->test, hair_step(f->hair, 1.0f / 60));
    hair_test_ok(f->test, hair_draw(f->hair, &f->view));
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
    static const char* const none[] = {"unpack_scalp", "root_transforms", "wind",
                                       "hair_grid",    "bind_followers",  "expand",
                                       "scan_strands", "compact_strands", "diagnose"};
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
    // The dispatches are solve and smooth.
    assert_int_equal(hair_test_trace_count("glDispatch"), 2);
    hair_test_ok(f.test, hair_draw(f.hair, &f.view));
    report(&f);
    assert_int_equal(row_of(&f, "color")->runs, 2);
    assert_int_equal(row_of(&f, "smooth")->runs, 1);
    finish(&f);
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
    hair_test_ok(f.test, hair_set_colliders(f.hair, &collider, 1, sizeof collider));
    hair_test_ok(f.test, hair_set_physics(f.hair, &physics));
    run_frame(&f);
    check(&f, "field", HAIR_SKIP_REASON_NONE, 1);
    check(&f, "hit", HAIR_SKIP_REASON_NONE, 1);
    check(&f, "repair", HAIR_SKIP_REASON_NONE, 1);
    check(&f, "hair_grid", HAIR_SKIP_REASON_NONE, 1);
    print_message("    %llu bytes, with a collider and a crowd %llu\n", (unsigned long long)before,
                  (unsigned long long)f.info.bytes);
    physics.hair_hair.cohesion = 0;
    hair_test_ok(f.test, hair_set_colliders(f.hair, NULL, 0, sizeof collider));
    hair_test_ok(f.test, hair_set_physics(f.hair, &physics));
    run_frame(&f);
    check(&f, "field", HAIR_SKIP_REASON_NONE_NEAR, 0);
    check(&f, "hit", HAIR_SKIP_REASON_NONE_NEAR, 0);
    check(&f, "repair", HAIR_SKIP_REASON_NONE_NEAR, 0);
    check(&f, "hair_grid", HAIR_SKIP_REASON_NOT_WANTED, 0);
    assert_true(f.info.bytes == before);
    finish(&f);
}

// Check that reports of two instances count all memory of the context, by whichever call it was
// created, and that destroying an instance leaves that of the other.
static void reports_count_all_memory_of_each_instance(void** state)
{
    static const hair_render_path paths[] = {HAIR_RENDER_PATH_TESSELLATION, HAIR_RENDER_PATH_CACHED,
                                             HAIR_RENDER_PATH_COMPUTE};
    struct fixture f = start(state, NULL), other = {.test = f.test, .context = f.context};
    hair_memory memory = hair_memory_default();
    hair_desc of = hair_desc_default();
    hair_groom* groom = hair_test_groom(&f.test->host.host, hair_test_handmade_default());
    hair_test_ok(f.test, hair_create(f.context, groom, &of, &other.hair));
    hair_groom_destroy(groom);
    hair_collider collider = hair_collider_default();
    hair_physics physics = hair_physics_default();
    hair_wind wind = hair_wind_default();
    float positions[3];
    uint32_t count;
    collider.size[0] = 0.12f, physics.hair_hair.cohesion = 3, physics.sleep_threshold = 0.01f;
    wind.model = HAIR_WIND_FLUID, wind.fluid.resolution = 16, wind.velocity[0] = 2;
    hair_test_ok(f.test, hair_set_colliders(f.hair, &collider, 1, sizeof collider));
    hair_test_ok(f.test, hair_set_physics(f.hair, &physics));
    hair_test_ok(f.test, hair_set_wind(f.hair, &wind));
    hair_test_ok(f.test, hair_set_colliders(other.hair, &collider, 1, sizeof collider));
    hair_test_ok(f.test, hair_read_positions(other.hair, HAIR_READ_FOLLOWERS, positions, 1, &count));
    for (size_t i = 0; i < sizeof paths / sizeof *paths; ++i) {
        f.view.render_path = paths[i];
        run_frame(&f);
        hair_test_ok(f.test, hair_step(other.hair, 1.0f / 60));
        report(&other);
        hair_test_ok(f.test, hair_get_memory(f.context, &memory));
        assert_true(f.info.bytes > other.info.bytes && other.info.bytes > 0);
        assert_true(f.info.bytes + other.info.bytes == memory.bytes);
    }
    assert_true(row_of(&f, "wind")->bytes > 0);
    check(&other, "wind", HAIR_SKIP_REASON_NOT_WANTED, 0);
    check(&other, "hit", HAIR_SKIP_REASON_NOT_CALLED, 1);
    hair_destroy(other.hair);
    report(&f);
    hair_test_ok(f.test, hair_get_memory(f.context, &memory));
    assert_true(f.info.bytes == memory.bytes);
    finish(&f);
}

static void report_names_sleep_and_culling_as_reasons(void** state)
{
    hair_physics physics = hair_physics_default();
    physics.sleep_threshold = 0.01f;
    struct fixture f = start(state, &physics);
    f.view.render_path = HAIR_RENDER_PATH_CACHED;
    for (int i = 0; i < 600 && !f.hair->sim.sleep.asleep; ++i) run_frame(&f);
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
    f.view.view[12] = 20;
    run_frame(&f);
    check(&f, "color", HAIR_SKIP_REASON_OUT_OF_VIEW, 1);
    check(&f, "smooth", HAIR_SKIP_REASON_OUT_OF_VIEW, 1);
    assert_true(f.info.ms == 0);
    finish(&f);
}

// Check reports in every frame, of two instances in turn. Nothing waits, frames are in order, and
// each report belongs to its instance. A busy GPU may take longer than 20 frames to answer, so more
// frames follow with pauses until the first report.
static void report_does_not_wait_and_is_of_one_instance(void** state)
{
    struct fixture f = start(state, NULL), other = {0};
    uint32_t last = 0;
    f.info = hair_report_info_default();
    other.test = f.test, other.context = f.context;
    hair_desc of = hair_desc_default();
    hair_groom* groom = hair_test_groom(&f.test->host.host, hair_test_handmade_default());
    hair_test_ok(f.test, hair_create(f.context, groom, &of, &other.hair));
    hair_groom_destroy(groom);
    hair_test_trace_clear();
    static const struct timespec pause = {.tv_nsec = 10000000};
    for (int i = 0; i < 20 || (last == 0 && i < 1000); ++i) {
        if (i >= 20) thrd_sleep(&pause, NULL);
        hair_test_ok(f.test, hair_step(f.hair, 1.0f / 60));
        hair_test_ok(f.test, hair_step(other.hair, 1.0f / 60));
        hair_test_ok(f.test, hair_draw(f.hair, &f.view));
        hair_test_ok(f.test, hair_report(f.hair, false, &f.info, f.row, sizeof *f.row, MAX, &f.rows));
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
    hair_destroy(other.hair);
    finish(&f);
}

static void report_refuses_invalid_arguments(void** state)
{
    struct fixture f = start(state, NULL);
    hair_report_info info = hair_report_info_default();
    uint32_t count;
    size_t stride = sizeof *f.row;
    assert_int_equal(hair_report(NULL, false, &info, f.row, stride, MAX, &count), HAIR_ERROR_ARGUMENT);
    hair_test_refused(f.test, hair_report(f.hair, 0, NULL, f.row, stride, MAX, &count), HAIR_ERROR_ARGUMENT,
                      "hair_report_info is NULL");
    hair_test_refused(f.test, hair_report(f.hair, false, &info, f.row, stride, MAX, NULL),
                      HAIR_ERROR_ARGUMENT, "count is NULL");
    hair_test_refused(f.test, hair_report(f.hair, false, &info, NULL, stride, 1, &count), HAIR_ERROR_ARGUMENT,
                      "rows is NULL but capacity is 1");
    hair_test_refused(f.test, hair_report(f.hair, false, &info, f.row, 1, MAX, &count), HAIR_ERROR_ARGUMENT,
                      "stride is 1, not in");
    hair_test_ok(f.test, hair_report(f.hair, false, &info, NULL, 0, 0, &count));
    assert_int_equal(info.frame, 0);
    assert_int_equal(count, 0);
    assert_null(hair_skip_reason_string((hair_skip_reason)(HAIR_SKIP_REASON_NOT_CALLED + 1)));
    finish(&f);
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
        HAIR_TEST(report_refuses_invalid_arguments),
    };
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
