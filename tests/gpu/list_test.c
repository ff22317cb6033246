// list_test.c - many instances stepped and drawn by one call, which must give the bits of single
// calls.
#include "tests/support/scene.h"

#include <hair/hair_asset.h>
#include <math.h>
#include <string.h>

#include "lib/api/api.h"
#include "tests/support/refusal.h"

#define HEADS 9
#define SIZE 96
#define FRAMES 3

// Heads that all differ, and twins of them that are stepped and drawn by single calls.
struct crowd {
    struct hair_test* test;
    hair_groom* groom;
    hair_instance *listed[HEADS], *single[HEADS];
    struct hair_test_frame frame;
    hair_lod lod;
    hair_light light;
    hair_view view;
    bool recorded; // whether the context recorded before
};

static hair_groom* make_groom(struct hair_test* test)
{
    hair_style_desc style = hair_style_desc_default();
    hair_groom_desc desc = hair_groom_desc_default();
    hair_asset* asset = NULL;
    hair_groom* groom = NULL;
    style.host = desc.host = &test->host.host;
    style.guide_count = 24;
    hair_test_ok(test, hair_asset_generate(&style, &asset));
    hair_test_ok(test, hair_asset_to_groom_desc(asset, &desc));
    desc.follower_count = 300;
    hair_test_ok(test, hair_groom_create(&desc, &groom));
    hair_asset_destroy(asset);
    return groom;
}

static void place(uint32_t head, uint32_t frame, float transform[16])
{
    float angle = 0.3f * sinf(0.5f * (float)(frame + head)), c = cosf(angle), s = sinf(angle);
    const float m[16] = {c, 0, -s, 0, 0, 1, 0, 0, s, 0, c, 0, 0.3f * ((float)head - 4), 0, 0, 1};
    memcpy(transform, m, sizeof m);
}

static void put_skull(struct hair_test* test, hair_instance* hair, const float transform[16])
{
    hair_collider skull = hair_collider_default();
    skull.size[0] = 0.1f;
    for (int k = 0; k < 3; ++k) skull.position[k] = transform[12 + k] + (k == 1 ? 1.62f : 0.01f);
    hair_test_ok(test, hair_set_colliders(hair, &skull, 1, sizeof skull));
}

// Create a head with the features of its number.
static hair_instance* make_head(struct crowd* crowd, uint32_t head)
{
    static const hair_solver solvers[HEADS] = {
        [1] = HAIR_SOLVER_ACCURATE, [5] = HAIR_SOLVER_REDBLACK, [7] = HAIR_SOLVER_FOLLOW};
    hair_physics physics = hair_physics_default();
    hair_look look = hair_look_default();
    hair_wind wind = hair_wind_default();
    hair_desc desc = hair_desc_default();
    hair_instance* hair = NULL;
    physics.sleep_threshold = 0;
    if (head == 3) physics.hair_hair.cohesion = 20;
    if (head != 4) look.self_shadow.method = HAIR_SELF_SHADOW_STRANDS;
    look.self_shadow.cell = 0.02f; // Few nodes take little time.
    desc.solver = solvers[head];
    desc.physics = &physics;
    desc.look = &look;
    if (head == 5) desc.thread_mapping = HAIR_THREAD_MAPPING_FEEDBACK;
    if (head == 6) desc.hit_method = HAIR_HIT_METHOD_PREPASS;
    place(head, 0, desc.transform);
    hair_test_ok(crowd->test, hair_create(crowd->test->context, crowd->groom, &desc, &hair));
    wind.velocity[0] = 2;
    wind.model = HAIR_WIND_FLUID;
    if (head == 4) hair_test_ok(crowd->test, hair_set_wind(hair, &wind));
    if (head == 8) hair_test_ok(crowd->test, hair_record_contacts(hair, 300));
    return hair;
}

static struct crowd make_crowd(struct hair_test* test)
{
    struct crowd crowd = {.test = test, .groom = make_groom(test), .lod = hair_lod_default()};
    crowd.recorded = test->context->gl.records;
    test->context->gl.records = true; // llvmpipe does not profit, but must give the same bits.
    for (uint32_t i = 0; i < HEADS; ++i) {
        crowd.listed[i] = make_head(&crowd, i);
        crowd.single[i] = make_head(&crowd, i);
    }
    hair_test_frame_make(&crowd.frame, 3 * SIZE, SIZE, GL_RGBA32F, 0);
    crowd.view = hair_view_default();
    hair_test_set_orthographic(&crowd.view, 2.2f, 0.1f, 0);
    crowd.view.projection[0] = 0.7f;
    crowd.view.view[13] = -1.6f;
    crowd.view.light_count = 1;
    return crowd;
}

static void free_crowd(struct crowd* crowd)
{
    for (uint32_t i = 0; i < HEADS; ++i) {
        hair_destroy(crowd->listed[i]);
        hair_destroy(crowd->single[i]);
    }
    hair_groom_destroy(crowd->groom);
    hair_test_frame_free(&crowd->frame);
    crowd->test->context->gl.records = crowd->recorded;
}

// Move all heads to a frame. Those with an odd number or a prepass, and the one with contacts, have
// a collider.
static void move(struct crowd* crowd, uint32_t frame)
{
    for (uint32_t i = 0; i < 2 * HEADS; ++i) {
        hair_instance* hair = i < HEADS ? crowd->listed[i] : crowd->single[i - HEADS];
        uint32_t head = i % HEADS;
        float transform[16];
        place(head, frame, transform);
        hair_test_ok(crowd->test, hair_set_transform(hair, transform));
        if (head % 2 || head == 6 || head == 8) put_skull(crowd->test, hair, transform);
    }
}

static void step(struct crowd* crowd)
{
    hair_test_ok(crowd->test, hair_step_list(crowd->listed, HEADS, 1.0f / 60));
    for (uint32_t i = 0; i < HEADS; ++i) hair_test_ok(crowd->test, hair_step(crowd->single[i], 1.0f / 60));
}

static void compare_guides(struct crowd* crowd, hair_read_source source)
{
    static struct hair_test_points listed, single;
    for (uint32_t i = 0; i < HEADS; ++i) {
        hair_test_read_points(crowd->test, crowd->listed[i], source, &listed);
        hair_test_read_points(crowd->test, crowd->single[i], source, &single);
        assert_int_equal(listed.count, single.count);
        if (memcmp(listed.at, single.at, 3 * listed.count * sizeof *listed.at))
            fail_msg("source %d of head %u differs by %g m", (int)source, i,
                     hair_test_points_distance(&listed, &single));
    }
}

static void compare_pictures(struct crowd* crowd)
{
    static float listed[4 * 3 * SIZE * SIZE], single[4 * 3 * SIZE * SIZE];
    double covered = 0;
    hair_test_frame_clear(&crowd->frame);
    hair_test_ok(crowd->test, hair_draw_list(crowd->listed, HEADS, &crowd->view));
    hair_test_frame_read(&crowd->frame, listed);
    hair_test_frame_clear(&crowd->frame);
    for (uint32_t i = 0; i < HEADS; ++i) hair_test_ok(crowd->test, hair_draw(crowd->single[i], &crowd->view));
    hair_test_frame_read(&crowd->frame, single);
    for (size_t i = 0; i < 3 * SIZE * SIZE; ++i) covered += single[4 * i + 1] > 0;
    assert_true(covered > 0.01 * 3 * SIZE * SIZE);
    assert_memory_equal(listed, single, sizeof single);
}

static void listed_steps_equal_single_steps(void** state)
{
    struct crowd crowd = make_crowd(*state);
    for (uint32_t frame = 1; frame <= FRAMES; ++frame) {
        move(&crowd, frame);
        step(&crowd);
        compare_guides(&crowd, HAIR_READ_GUIDES);
    }
    compare_guides(&crowd, HAIR_READ_SMOOTH);
    free_crowd(&crowd);
}

static void listed_draws_equal_single_draws(void** state)
{
    static const hair_render_path paths[] = {HAIR_RENDER_PATH_AUTO, HAIR_RENDER_PATH_TESSELLATION,
                                             HAIR_RENDER_PATH_COMPUTE, HAIR_RENDER_PATH_CACHED};
    struct crowd crowd = make_crowd(*state);
    for (uint32_t frame = 1; frame <= sizeof paths / sizeof *paths; ++frame) {
        move(&crowd, frame);
        step(&crowd);
        crowd.view.render_path = paths[frame - 1];
        crowd.view.lod = frame % 2 ? &crowd.lod : NULL;
        compare_pictures(&crowd);
    }
    compare_guides(&crowd, HAIR_READ_GUIDES);
    free_crowd(&crowd);
}

static void lists_are_checked_before_anything_changes(void** state)
{
    struct crowd crowd = make_crowd(*state);
    hair_instance* twice[] = {crowd.listed[0], crowd.listed[1], crowd.listed[0]};
    hair_instance* missing[] = {crowd.listed[0], NULL};
    hair_context* context = hair_test_context(crowd.test, hair_egl_get_proc);
    hair_instance* other[] = {crowd.listed[0], NULL};
    hair_desc desc = hair_desc_default();
    hair_test_ok(crowd.test, hair_create(context, crowd.groom, &desc, &other[1]));
    for (int draws = 0; draws < 2; ++draws) {
#define CALL(list, count)                                                                                    \
    (draws ? hair_draw_list(list, count, &crowd.view) : hair_step_list(list, count, 0.1f))
        hair_test_refused(crowd.test, CALL(twice, 3), HAIR_ERROR_ARGUMENT, "list[2] is in the list before");
        hair_test_refused(crowd.test, CALL(other, 2), HAIR_ERROR_ARGUMENT, "list[1] is of another context");
        assert_int_equal(CALL(missing, 2), HAIR_ERROR_ARGUMENT);
        assert_int_equal(CALL(NULL, 2), HAIR_ERROR_ARGUMENT);
        hair_test_ok(crowd.test, CALL(NULL, 0));
#undef CALL
    }
    hair_test_refused(crowd.test, hair_step_list(crowd.listed, HEADS, -1), HAIR_ERROR_ARGUMENT, "dt is -1");
    compare_guides(&crowd, HAIR_READ_GUIDES);
    hair_destroy(other[1]);
    hair_context_destroy(context);
    free_crowd(&crowd);
}

static void long_lists_are_refused_without_their_context(void** state)
{
    static hair_instance* list[2 * HAIR_GL_STREAMS + 1];
    const uint32_t count = sizeof list / sizeof *list;
    struct hair_test* test = *state;
    hair_groom* groom = hair_test_groom(&test->host.host, hair_test_handmade_default());
    hair_desc desc = hair_desc_default();
    struct hair_gl* gl = &test->context->gl;
    void* own = gl->own_context;
    for (uint32_t i = 0; i < count; ++i)
        hair_test_ok(test, hair_create(test->context, groom, &desc, &list[i]));
    gl->own_context = list; // Another context appears to be current.
    assert_int_equal(hair_step_list(list, count, 1.0f / 60), HAIR_ERROR_OPENGL);
    assert_true(hair_test_forgive(test) > 0);
    gl->own_context = own;
    hair_test_ok(test, hair_step_list(list, count, 1.0f / 60));
    for (uint32_t i = 0; i < count; ++i) hair_destroy(list[i]);
    hair_groom_destroy(groom);
}

// Refusals ----------------------------------------------------------------------------------------

#define REFUSED_HEADS 3
#define MAX_SITES 200

// Twins whose rods are made again in each step, in a context that refuses objects.
struct twins {
    struct hair_test* test;
    hair_context* context;
    hair_groom* groom;
    hair_instance *listed[REFUSED_HEADS], *single[REFUSED_HEADS];
};

static struct twins make_twins(struct hair_test* test)
{
    struct twins twins = {.test = test, .groom = make_groom(test)};
    hair_desc desc = hair_desc_default();
    twins.context = hair_test_context(test, hair_test_refusing_proc);
    twins.context->gl.records = true;
    for (uint32_t i = 0; i < 2 * REFUSED_HEADS; ++i) {
        hair_instance** out = i < REFUSED_HEADS ? &twins.listed[i] : &twins.single[i - REFUSED_HEADS];
        hair_test_ok(test, hair_create(twins.context, twins.groom, &desc, out));
    }
    return twins;
}

static void free_twins(struct twins* twins)
{
    for (uint32_t i = 0; i < REFUSED_HEADS; ++i) {
        hair_destroy(twins->listed[i]);
        hair_destroy(twins->single[i]);
    }
    hair_groom_destroy(twins->groom);
    hair_context_destroy(twins->context);
}

static void change_twins(struct twins* twins, uint32_t site)
{
    hair_physics physics = hair_physics_default();
    physics.damping = 1 + 0.01f * (float)site;
    for (uint32_t i = 0; i < 2 * REFUSED_HEADS; ++i) {
        hair_instance* hair = i < REFUSED_HEADS ? twins->listed[i] : twins->single[i - REFUSED_HEADS];
        float transform[16];
        place(i % REFUSED_HEADS, site, transform);
        hair_test_ok(twins->test, hair_set_physics(hair, &physics));
        hair_test_ok(twins->test, hair_set_transform(hair, transform));
        if (site % 2)
            put_skull(twins->test, hair, transform);
        else
            hair_test_ok(twins->test, hair_set_colliders(hair, NULL, 0, 0));
    }
}

// Step the list while a site is refused. Heads that were left as they were are then stepped alone.
// Return whether the site exists.
static bool refuse_site(struct twins* twins, uint32_t site, bool is_of_host)
{
    static struct hair_test_points before[REFUSED_HEADS], listed, single;
    struct hair_test_host* host = &twins->test->host;
    uint32_t allocations = host->allocations, creations = hair_test_refusal.creations, stayed = 0;
    change_twins(twins, site);
    for (uint32_t i = 0; i < REFUSED_HEADS; ++i)
        hair_test_read_points(twins->test, twins->listed[i], HAIR_READ_GUIDES, &before[i]);
    allocations = host->allocations;
    creations = hair_test_refusal.creations;
    if (is_of_host)
        host->refuse = allocations + site;
    else
        hair_test_refusal.refuse = creations + site;
    hair_result result = hair_step_list(twins->listed, REFUSED_HEADS, 1.0f / 60);
    bool was_there = is_of_host ? host->allocations >= allocations + site
                                : hair_test_refusal.creations >= creations + site;
    host->refuse = hair_test_refusal.refuse = 0;
    if (result) assert_true(hair_test_forgive(twins->test) > 0);
    for (uint32_t i = 0; i < REFUSED_HEADS; ++i) {
        hair_test_ok(twins->test, hair_step(twins->single[i], 1.0f / 60));
        hair_test_read_points(twins->test, twins->listed[i], HAIR_READ_GUIDES, &listed);
        hair_test_read_points(twins->test, twins->single[i], HAIR_READ_GUIDES, &single);
        if (memcmp(listed.at, single.at, 3 * single.count * sizeof *single.at) == 0) continue;
        assert_memory_equal(listed.at, before[i].at, 3 * single.count * sizeof *single.at);
        assert_true(result);
        ++stayed;
        hair_test_ok(twins->test, hair_step(twins->listed[i], 1.0f / 60));
        hair_test_read_points(twins->test, twins->listed[i], HAIR_READ_GUIDES, &listed);
        assert_memory_equal(listed.at, single.at, 3 * single.count * sizeof *single.at);
    }
    assert_int_equal(stayed, result != HAIR_OK);
    return was_there;
}

static void a_refused_step_leaves_one_head_as_it_was(void** state)
{
    struct twins twins = make_twins(*state);
    uint32_t site;
    for (int is_of_host = 0; is_of_host < 2; ++is_of_host) {
        for (site = 1; site < MAX_SITES && refuse_site(&twins, site, is_of_host); ++site) {}
        print_message("    %u sites of %s\n", site - 1, is_of_host ? "the host" : "OpenGL");
        assert_in_range(site, REFUSED_HEADS + 1, MAX_SITES - 1);
    }
    free_twins(&twins);
}

int main(void)
{
    if (hair_test_skips()) return 0;
    const struct CMUnitTest tests[] = {
        HAIR_TEST(listed_steps_equal_single_steps),
        HAIR_TEST(listed_draws_equal_single_draws),
        HAIR_TEST(lists_are_checked_before_anything_changes),
        HAIR_TEST(long_lists_are_refused_without_their_context),
        HAIR_TEST(a_refused_step_leaves_one_head_as_it_was),
    };
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
