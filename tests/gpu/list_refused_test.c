// list_refused_test.c - lists that are drawn while memory or objects are refused. Each head is
// drawn as a whole or not at all, and the next draw is complete. Heads without fences do not sleep.
//
// HAIR_TEST_FULL=1 in the environment refuses every site, not every seventh.
#include "tests/support/refusal.h"
#include "tests/support/render_paths.h"
#include "tests/support/scene.h"

#include <stdlib.h>

#define HEADS 3
#define SIDE 32 // Width and height of a head's part of the frame.
#define NUMBERS (4 * HEADS * SIDE * SIDE) // of a picture
#define MAX_SITES 400

struct crowd {
    struct hair_test* test;
    hair_context* context;
    hair_groom* groom;
    hair_instance* hair[HEADS];
    struct hair_test_frame frame;
    hair_view view;
    float whole[NUMBERS], seen[NUMBERS];
    uint32_t failures; // Number of draws that have failed.
};

static void make(struct crowd* crowd, struct hair_test* test)
{
    struct hair_test_handmade groom = hair_test_handmade_default();
    hair_desc desc = hair_desc_default();
    groom.guides = 8, groom.followers = 200;
    *crowd = (struct crowd){.test = test, .groom = hair_test_groom(&test->host.host, groom)};
    crowd->context = hair_test_context(test, hair_test_refusing_proc);
    crowd->context->gl.records = true; // llvmpipe does not profit, but must give the same pixels.
    for (uint32_t i = 0; i < HEADS; ++i) {
        desc.transform[12] = (float)i - 1;
        hair_test_ok(test, hair_create(crowd->context, crowd->groom, &desc, &crowd->hair[i]));
    }
    hair_test_frame_make(&crowd->frame, HEADS * SIDE, SIDE, GL_RGBA32F, 0);
    crowd->view = hair_view_default();
    hair_test_set_orthographic(&crowd->view, 2, 1, 0);
    crowd->view.projection[0] = 2.0f / HEADS;
    crowd->view.light_count = 1;
}

static void free_all(struct crowd* crowd)
{
    for (uint32_t i = 0; i < HEADS; ++i) hair_destroy(crowd->hair[i]);
    hair_groom_destroy(crowd->groom);
    hair_test_frame_free(&crowd->frame);
    hair_context_destroy(crowd->context);
}

// Give all heads looks and colliders of which the next draw makes its buffers anew.
static void change(struct crowd* crowd, uint32_t site)
{
    for (uint32_t i = 0; i < HEADS; ++i) {
        hair_look look = hair_look_default();
        hair_collider ball = hair_collider_default();
        look.strand.radius = 2e-3f;
        look.strand.segments = 4 + (site + i) % 5;
        look.self_shadow.method = (site + i) % 2 ? HAIR_SELF_SHADOW_STRANDS : HAIR_SELF_SHADOW_DEPTH;
        hair_test_ok(crowd->test, hair_set_look(crowd->hair[i], &look));
        ball.position[0] = (float)i - 1 + 0.1f;
        ball.size[0] = 0.03f + 0.01f * (float)(site % 3);
        hair_test_ok(crowd->test, hair_set_colliders(crowd->hair[i], &ball, site % 4 > 0, sizeof ball));
        hair_test_ok(crowd->test, hair_step(crowd->hair[i], 1.0f / 60));
    }
}

static hair_result draw(struct crowd* crowd, float pixels[NUMBERS])
{
    hair_test_frame_clear(&crowd->frame);
    hair_result result = hair_draw_list(crowd->hair, HEADS, &crowd->view);
    hair_test_frame_read(&crowd->frame, pixels);
    assert_int_equal(glGetError(), GL_NO_ERROR);
    return result;
}

// Count the heads that are in the picture. Others must have left their part of the frame empty.
static uint32_t count_heads(const struct crowd* crowd)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < HEADS; ++i) {
        bool equals = true, is_empty = true;
        for (uint32_t row = 0; row < SIDE; ++row) {
            size_t at = 4 * ((size_t)row * HEADS + i) * SIDE;
            for (size_t k = at; k < at + 4 * SIDE; ++k) {
                equals &= crowd->seen[k] == crowd->whole[k];
                is_empty &= k % 4 == 3 || crowd->seen[k] == 0;
            }
        }
        if (!equals && !is_empty) fail_msg("head %u is drawn in part", i);
        count += equals;
    }
    return count;
}

// Draw while a site is refused. Return whether the site exists.
static bool refuse_site(struct crowd* crowd, uint32_t site, bool is_of_host)
{
    struct hair_test_host* host = &crowd->test->host;
    change(crowd, site);
    uint32_t allocations = host->allocations, creations = hair_test_refusal.creations;
    if (is_of_host)
        host->refuse = allocations + site;
    else
        hair_test_refusal.refuse = creations + site;
    hair_result result = draw(crowd, crowd->seen);
    bool was_there = is_of_host ? host->allocations >= allocations + site
                                : hair_test_refusal.creations >= creations + site;
    host->refuse = hair_test_refusal.refuse = 0;
    if (result) assert_true(hair_test_forgive(crowd->test) > 0);
    crowd->failures += result != HAIR_OK;
    hair_test_ok(crowd->test, draw(crowd, crowd->whole));
    uint32_t heads = count_heads(crowd);
    if (result ? heads == HEADS : heads < HEADS)
        fail_msg("site %u: result %d, but %u heads are drawn", site, result, heads);
    return was_there;
}

static void refused_lists_draw_heads_whole_or_not_at_all(void** state)
{
    static struct crowd crowd;
    make(&crowd, *state);
    hair_test_refusal.refusable = HAIR_TEST_REFUSE_OBJECTS | HAIR_TEST_REFUSE_MEMORY;
    uint32_t step = getenv("HAIR_TEST_FULL") ? 1 : 7; // Looks repeat after 5 and 2.
    for (int path = 0; path < HAIR_TEST_PATHS; ++path) {
        crowd.view.render_path = hair_test_paths[path];
        uint32_t failures = crowd.failures;
        for (int is_of_host = 0; is_of_host < 2; ++is_of_host) {
            uint32_t site = 1;
            while (site < MAX_SITES && refuse_site(&crowd, site, is_of_host)) site += step;
            print_message("    path %d: %u sites of %s\n", path, (site - 1) / step,
                          is_of_host ? "the host" : "OpenGL");
            assert_in_range(site, 1 + step, MAX_SITES - 1);
        }
        print_message("    %u draws failed\n", crowd.failures - failures);
        assert_true(crowd.failures > failures);
    }
    hair_test_refusal.refusable = HAIR_TEST_REFUSE_OBJECTS;
    free_all(&crowd);
}

// Step both of two heads alone or by a list. Check that no fence is left without a measurement that
// waits for it. Return whether both are asleep.
static bool step_both(struct crowd* crowd, bool by_list)
{
    bool sleep = true;
    if (by_list) hair_test_ok(crowd->test, hair_step_list(crowd->hair, 2, 1.0f / 30));
    for (int i = 0; i < 2; ++i) {
        const struct hair_sleep* state = &crowd->hair[i]->sim.sleep;
        if (!by_list) hair_test_ok(crowd->test, hair_step(crowd->hair[i], 1.0f / 30));
        assert_true(!state->fence || state->waits);
        sleep &= state->asleep;
    }
    glFinish(); // Steps do not wait for a GPU, which would lag behind all steps of the test.
    assert_int_equal(glGetError(), GL_NO_ERROR);
    return sleep;
}

static void heads_without_fences_stay_awake_until_there_are_some(void** state)
{
    static struct crowd crowd;
    hair_physics physics = hair_physics_default();
    physics.sleep_threshold = 0.01f;
    physics.damping = 20;
    for (int by_list = 0; by_list < 2; ++by_list) {
        uint32_t steps = 0;
        make(&crowd, *state);
        hair_test_refusal.refusable = HAIR_TEST_REFUSE_QUERIES;
        for (int i = 0; i < 2; ++i) hair_test_ok(crowd.test, hair_set_physics(crowd.hair[i], &physics));
        // The first measurement needs no fence.
        for (; steps < 9; ++steps) step_both(&crowd, by_list);
        hair_test_refusal.refuse = hair_test_refusal.creations + 1;
        hair_test_refusal.is_lasting = true;
        for (; steps < 60; ++steps) assert_false(step_both(&crowd, by_list));
        assert_true(hair_test_refusal.creations > hair_test_refusal.refuse);
        hair_test_refusal.refuse = 0;
        hair_test_refusal.is_lasting = false;
        while (steps < MAX_SITES && !step_both(&crowd, by_list)) ++steps;
        assert_in_range(steps, 60, MAX_SITES - 1);
        hair_test_refusal.refusable = HAIR_TEST_REFUSE_OBJECTS;
        free_all(&crowd);
    }
}

int main(void)
{
    if (hair_test_skips()) return 0;
    const struct CMUnitTest tests[] = {
        HAIR_TEST(refused_lists_draw_heads_whole_or_not_at_all),
        HAIR_TEST(heads_without_fences_stay_awake_until_there_are_some),
    };
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
