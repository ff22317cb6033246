// creation_test.c - guides that a groom has prepared move as others do, and their instances compute
// nothing.
#include "tests/support/scene.h"

#include <math.h>
#include <string.h>

#include "tests/support/grooms.h"

enum { GUIDES = 96, VERTICES = 12 };

// Threads of an application that run tasks in reverse, and count them. Tasks may call no callback.
struct threads {
    hair_tasks tasks;
    uint32_t runs, count;
    const struct hair_test_host* host;
};

static void run_reversed(hair_task task, void* data, uint32_t count, void* user)
{
    struct threads* threads = user;
    ++threads->runs;
    threads->count += count;
    uint32_t allocations = threads->host->allocations;
    for (uint32_t i = count; i-- > 0;) task(i, data);
    assert_int_equal(threads->host->allocations, allocations);
}

// Return a point of a long curl that leans outwards. Some of these guides are stiffened, and some
// sag.
static hair_vec3 lean(float t, uint32_t strand, const void* user)
{
    (void)user;
    float angle = 0.7f * (float)strand, length = 0.05f + 0.002f * (float)strand, out = length * t;
    return hair_v3(0.1f * cosf(angle) + out * cosf(angle) + 0.004f * sinf(9 * t), 0.3f * out,
                   0.1f * sinf(angle) + out * sinf(angle) + 0.004f * cosf(9 * t));
}

static hair_groom* make_groom(const struct hair_test* test, const hair_physics* physics,
                              const hair_tasks* tasks, hair_solver solver)
{
    struct hair_test_strands strands = hair_test_strands_make(GUIDES, VERTICES);
    for (uint32_t i = 0; i < GUIDES; ++i) hair_test_strands_add(&strands, VERTICES, lean, NULL);
    hair_groom_desc desc = hair_test_groom_desc(&test->host, &strands);
    hair_groom* groom = NULL;
    desc.strand_set = HAIR_STRAND_SET_GUIDES;
    desc.follower_count = 0;
    desc.physics = physics;
    desc.tasks = tasks;
    desc.solver = solver;
    hair_test_ok(test, hair_groom_create(&desc, &groom));
    hair_test_strands_free(&strands);
    return groom;
}

// Create an instance, destroy the groom, and simulate some steps.
static void live(struct hair_test* test, hair_groom* groom, hair_desc desc, const hair_physics* later,
                 struct hair_test_points* out)
{
    hair_instance* hair = NULL;
    hair_test_ok(test, hair_create(test->context, groom, &desc, &hair));
    hair_groom_destroy(groom);
    for (int i = 0; i < 6; ++i) {
        if (i == 3 && later) hair_test_ok(test, hair_set_physics(hair, later));
        hair_test_ok(test, hair_step(hair, 1.0f / 60));
    }
    hair_test_read_points(test, hair, HAIR_READ_GUIDES, out);
    hair_destroy(hair);
}

static void prepared_guides_move_like_others(void** state)
{
    static struct hair_test_points plain, prepared;
    static const hair_solver solvers[] = {HAIR_SOLVER_DIRECT, HAIR_SOLVER_ACCURATE, HAIR_SOLVER_FOLLOW,
                                          HAIR_SOLVER_REDBLACK};
    struct hair_test* test = *state;
    hair_physics physics = hair_physics_default(), later = physics;
    later.fiber.radius = 3e-5f;
    for (size_t i = 0; i < sizeof solvers / sizeof *solvers; ++i)
        for (int groups = 0; groups < 2; ++groups) {
            struct threads threads = {.tasks = {run_reversed, &threads}, .host = &test->host};
            hair_desc desc = hair_desc_default();
            desc.solver = solvers[i];
            desc.physics = &physics;
            if (groups) desc.thread_mapping = HAIR_THREAD_MAPPING_WORKGROUP_PER_GUIDE;
            live(test, make_groom(test, NULL, NULL, solvers[i]), desc, &later, &plain);
            live(test, make_groom(test, &physics, &threads.tasks, solvers[i]), desc, &later, &prepared);
            assert_int_equal(plain.count, GUIDES * VERTICES);
            assert_memory_equal(plain.at, prepared.at, 12 * plain.count);
        }
}

// Check the work of hair_create() by the tasks it hands out.
static void instance_of_prepared_groom_computes_no_guide(void** state)
{
    static struct hair_test_points points;
    struct hair_test* test = *state;
    struct threads threads = {.tasks = {run_reversed, &threads}, .host = &test->host};
    hair_physics physics = hair_physics_default(), other = physics;
    other.fiber.radius = 3e-5f;
    hair_desc desc = hair_desc_default();
    desc.physics = &physics;
    desc.thread_mapping = HAIR_THREAD_MAPPING_WORKGROUP_PER_GUIDE;
    hair_groom* groom = make_groom(test, &physics, &threads.tasks, HAIR_SOLVER_DIRECT);
    uint32_t runs = threads.runs;
    // The preload, the scheme, the substep and the rods have six tasks each.
    assert_true(runs >= 4 && threads.count >= 4 * 6);
    live(test, groom, desc, NULL, &points);
    assert_int_equal(threads.runs, runs);
    groom = make_groom(test, &physics, &threads.tasks, HAIR_SOLVER_DIRECT);
    runs = threads.runs;
    desc.physics = &other;
    live(test, groom, desc, NULL, &points);
    assert_true(threads.runs > runs);
}

// Check that hair_create() allocates nothing for guides for a while, such as zeros to upload. The
// first instance compiles programs.
static void instance_of_prepared_groom_needs_no_temporary_memory(void** state)
{
    struct hair_test* test = *state;
    hair_physics physics = hair_physics_default();
    hair_desc desc = hair_desc_default();
    desc.physics = &physics;
    hair_groom* groom = make_groom(test, &physics, NULL, HAIR_SOLVER_DIRECT);
    hair_instance* hair[2] = {NULL};
    hair_test_ok(test, hair_create(test->context, groom, &desc, &hair[0]));
    test->host.peak = test->host.live;
    hair_test_ok(test, hair_create(test->context, groom, &desc, &hair[1]));
    size_t temporary = test->host.peak - test->host.live;
    print_message("    %zu bytes\n", temporary);
    assert_true(temporary < GUIDES * VERTICES * sizeof(hair_vec4));
    hair_destroy(hair[0]), hair_destroy(hair[1]);
    hair_groom_destroy(groom);
}

static void groom_refuses_wrong_physics_and_empty_tasks(void** state)
{
    struct hair_test* test = *state;
    struct hair_test_strands strands = hair_test_strands_make(1, VERTICES);
    hair_test_strands_add(&strands, VERTICES, lean, NULL);
    hair_groom_desc desc = hair_test_groom_desc(&test->host, &strands);
    hair_physics physics = hair_physics_default();
    hair_tasks none = {NULL, NULL};
    hair_groom* groom = NULL;
    desc.tasks = &none;
    hair_test_refused(test, hair_groom_create(&desc, &groom), HAIR_ERROR_ARGUMENT, "hair_groom_desc.tasks");
    desc.tasks = NULL;
    desc.physics = &physics;
    physics.damping = -1;
    hair_test_refused(test, hair_groom_create(&desc, &groom), HAIR_ERROR_ARGUMENT, "hair_physics.damping");
    physics.damping = 4;
    desc.solver = (hair_solver)17;
    hair_test_refused(test, hair_groom_create(&desc, &groom), HAIR_ERROR_ARGUMENT, "hair_groom_desc.solver");
    assert_null(groom);
    hair_test_strands_free(&strands);
}

int main(void)
{
    if (hair_test_skips()) return 0;
    const struct CMUnitTest tests[] = {
        HAIR_TEST(prepared_guides_move_like_others),
        HAIR_TEST(instance_of_prepared_groom_computes_no_guide),
        HAIR_TEST(instance_of_prepared_groom_needs_no_temporary_memory),
        HAIR_TEST(groom_refuses_wrong_physics_and_empty_tasks),
    };
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
