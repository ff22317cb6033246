// random_lists_test.c - lists of heads in any order, good and bad, among changes and refusals. A
// bad list changes nothing. A list that fails steps each head as a whole or not at all.
//
// The environment variables HAIR_TEST_SEED and HAIR_TEST_LAST select a range of seeds.
#include "tests/support/motion.h"
#include "tests/support/refusal.h"
#include "tests/support/render_paths.h"
#include "tests/support/scene.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define HEADS 6
#define CALLS 120 // Number of lists by each seed.

struct run {
    struct hair_test* test;
    hair_context* context;
    hair_groom* groom;
    hair_instance* hair[HEADS]; // NULL is a head that does not exist.
    struct hair_test_blob before[HEADS];
    hair_instance* list[HEADS + 1];
    uint32_t count;
    bool is_bad; // The list has a head twice, or no head.
    uint32_t random, done, failures;
    char call[64]; // Name of the present call.
};

static uint32_t any(struct run* run, uint32_t count)
{
    run->random = run->random * 1664525u + 1013904223u;
    return (run->random >> 8) % count;
}

static void create(struct run* run, uint32_t head)
{
    hair_desc desc = hair_test_way((int)any(run, HAIR_TEST_WAYS));
    desc.hit_method = (hair_hit_method)any(run, 3);
    desc.transform[12] = 0.3f * (float)head;
    hair_test_ok(run->test, hair_create(run->context, run->groom, &desc, &run->hair[head]));
}

static void change(struct run* run, hair_instance* hair)
{
    hair_physics physics = hair_physics_default();
    hair_look look = hair_look_default();
    hair_collider ball = hair_collider_default();
    hair_wind wind = hair_wind_default();
    physics.sleep_threshold = any(run, 2) ? 0.01f : 0;
    physics.damping = (float)any(run, 20);
    if (any(run, 3) == 0) physics.hair_hair.cohesion = 10;
    look.strand.segments = 1 + any(run, 12);
    look.self_shadow.method = (hair_self_shadow)any(run, 2);
    ball.size[0] = 0.05f;
    ball.position[1] = 0.01f * (float)any(run, 20);
    wind.velocity[0] = 2;
    if (any(run, 2)) wind.model = HAIR_WIND_FLUID;
    wind.fluid.resolution = 16;
    if (any(run, 2)) hair_test_ok(run->test, hair_set_physics(hair, &physics));
    if (any(run, 2)) hair_test_ok(run->test, hair_set_look(hair, &look));
    if (any(run, 2)) hair_test_ok(run->test, hair_set_colliders(hair, &ball, any(run, 2), sizeof ball));
    if (any(run, 6) == 0) hair_test_ok(run->test, hair_set_wind(hair, any(run, 2) ? &wind : NULL));
    // Some solvers record no contacts.
    if (any(run, 6) == 0 && hair_record_contacts(hair, any(run, 2) ? 100 : 0)) hair_test_forgive(run->test);
}

static void choose_list(struct run* run)
{
    uint32_t first = any(run, HEADS), step = any(run, 2) ? 1 : HEADS - 1;
    run->count = 0;
    run->is_bad = false;
    for (uint32_t i = 0; i < HEADS; ++i) {
        uint32_t head = (first + i * step) % HEADS;
        if (run->hair[head] && any(run, 4)) run->list[run->count++] = run->hair[head];
    }
    if (any(run, 8)) return;
    run->is_bad = true;
    run->list[run->count] = run->count && any(run, 2) ? run->list[any(run, run->count)] : NULL;
    ++run->count;
}

static hair_result draw(struct run* run)
{
    hair_view view = hair_test_view_by(hair_test_paths[any(run, HAIR_TEST_PATHS)]);
    view.pass = (hair_pass)any(run, HAIR_PASS_WIND + 1);
    view.frame_index = any(run, 4);
    view.primitive = (hair_primitive)any(run, 2);
    view.coverage = (hair_coverage)any(run, 2);
    return hair_draw_list(run->list, run->count, &view);
}

static bool is_listed(const struct run* run, const hair_instance* hair)
{
    for (uint32_t i = 0; i < run->count; ++i)
        if (run->list[i] == hair) return true;
    return false;
}

// Compare the heads with their states before a call. Return how many have changed.
static uint32_t count_changed(struct run* run)
{
    uint32_t changed = 0;
    for (uint32_t i = 0; i < HEADS; ++i) {
        if (!run->hair[i]) continue;
        struct hair_test_blob now = hair_test_save(run->test, run->hair[i]);
        bool equals =
            now.size == run->before[i].size && memcmp(now.bytes, run->before[i].bytes, now.size) == 0;
        free(now.bytes);
        if (!equals && !is_listed(run, run->hair[i])) fail_msg("%s: head %u is not listed", run->call, i);
        changed += !equals;
    }
    return changed;
}

// Call with a list, sometimes while memory or objects are refused.
static void call(struct run* run, bool draws)
{
    struct hair_test_host* host = &run->test->host;
    for (uint32_t i = 0; i < HEADS; ++i)
        if (run->hair[i]) run->before[i] = hair_test_save(run->test, run->hair[i]);
    uint32_t refused = any(run, 4), site = 1 + any(run, 20);
    float dt = any(run, 2) ? 0.02f : 0.1f;
    if (refused == 0) host->refuse = host->allocations + site;
    if (refused == 1) hair_test_refusal.refuse = hair_test_refusal.creations + site;
    host->is_lasting = hair_test_refusal.is_lasting = any(run, 2);
    hair_result result = draws ? draw(run) : hair_step_list(run->list, run->count, dt);
    host->refuse = hair_test_refusal.refuse = 0;
    host->is_lasting = hair_test_refusal.is_lasting = false;
    uint32_t logged = hair_test_forgive(run->test), changed = count_changed(run);
    assert_int_equal(glGetError(), GL_NO_ERROR);
    if (run->is_bad && (result != HAIR_ERROR_ARGUMENT || changed))
        fail_msg("%s: result %d of a bad list, %u heads changed", run->call, result, changed);
    if (result && !logged && !run->is_bad) fail_msg("%s failed silently", run->call);
    if (result && !draws && run->count && changed == run->count)
        fail_msg("%s: result %d, but all heads are stepped", run->call, result);
    run->failures += result != HAIR_OK, run->done += result == HAIR_OK;
    for (uint32_t i = 0; i < HEADS; ++i) {
        static struct hair_test_points points;
        free(run->before[i].bytes);
        run->before[i].bytes = NULL;
        if (!run->hair[i]) continue;
        hair_test_read_points(run->test, run->hair[i], HAIR_READ_GUIDES, &points);
        const struct hair_sleep* sleep = &run->hair[i]->sim.sleep;
        if (sleep->fence && !sleep->waits) fail_msg("%s left a fence behind", run->call);
    }
}

static void live(struct hair_test* test, uint32_t seed)
{
    static struct run run;
    struct hair_test_handmade groom = hair_test_handmade_default();
    struct hair_test_frame frame;
    groom.guides = 8, groom.followers = 60, groom.seed = seed;
    run = (struct run){.test = test, .random = seed * 2654435761u};
    run.groom = hair_test_groom(&test->host.host, groom);
    int32_t objects = hair_test_refusal.live;
    run.context = hair_test_context(test, hair_test_refusing_proc);
    run.context->gl.records = seed % 4 > 0; // llvmpipe does not profit from recording.
    hair_test_frame_make(&frame, 24, 24, GL_RGBA32F, 0);
    hair_test_refusal.refusable = HAIR_TEST_REFUSE_ALL & ~HAIR_TEST_REFUSE_PROGRAMS;
    for (uint32_t i = 0; i < CALLS; ++i) {
        uint32_t head = any(&run, HEADS);
        if (!run.hair[head])
            create(&run, head);
        else if (any(&run, 8) == 0)
            hair_destroy(run.hair[head]), run.hair[head] = NULL;
        else
            change(&run, run.hair[head]);
        choose_list(&run);
        bool draws = any(&run, 2);
        snprintf(run.call, sizeof run.call, "seed %u, call %u, %s", seed, i, draws ? "draw" : "step");
        call(&run, draws);
    }
    hair_test_refusal.refusable = HAIR_TEST_REFUSE_OBJECTS;
    for (uint32_t i = 0; i < HEADS; ++i) hair_destroy(run.hair[i]);
    hair_groom_destroy(run.groom);
    hair_test_frame_free(&frame);
    hair_context_destroy(run.context);
    assert_int_equal(hair_test_refusal.live, objects);
    print_message("    seed %u: %u lists done, %u refused\n", seed, run.done, run.failures);
}

static void random_lists_keep_heads_whole(void** state)
{
    const char *first = getenv("HAIR_TEST_SEED"), *last = getenv("HAIR_TEST_LAST");
    uint32_t from = first ? (uint32_t)atoi(first) : 1;
    uint32_t to = last ? (uint32_t)atoi(last) : from + (getenv("HAIR_TEST_FULL") ? 29 : 1);
    for (uint32_t seed = from; seed <= to; ++seed) live(*state, seed);
}

int main(void)
{
    if (hair_test_skips()) return 0;
    const struct CMUnitTest tests[] = {HAIR_TEST(random_lists_keep_heads_whole)};
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
