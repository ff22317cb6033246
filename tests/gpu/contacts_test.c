// contacts_test.c - impulses of hair on colliders: weight that rests, momentum that is exchanged,
// and no cost unless they are recorded.
#include "tests/support/live_hair.h"
#include "tests/support/ways.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "lib/api/api.h"

#define STRANDS 50.0f // Strands whose mass a guide has.
#define PI 3.14159265358979
#define VERTICES 24
#define LENGTH 0.3f

// A way to simulate a strand. HAIR_TEST_FULL=1 in the environment tries them all, because each has
// programs of its own that must be compiled.
struct way {
    const char* name;
    hair_solver solver;
    hair_thread_mapping mapping;
    bool is_curled; // The mixed scheme then solves the strand.
    bool is_quick; // Tried without HAIR_TEST_FULL.
    uint32_t colliders; // Further colliders far away. More than a few are found by a grid.
};

static const struct way ways[] = {
    {"direct, by thread", HAIR_SOLVER_DIRECT, HAIR_THREAD_MAPPING_THREAD_PER_GUIDE, false, false, 0},
    {"direct, by group", HAIR_SOLVER_DIRECT, HAIR_THREAD_MAPPING_WORKGROUP_PER_GUIDE, false, true, 0},
    {"direct, grid", HAIR_SOLVER_DIRECT, HAIR_THREAD_MAPPING_WORKGROUP_PER_GUIDE, false, false, 40},
    {"curled, by thread", HAIR_SOLVER_DIRECT, HAIR_THREAD_MAPPING_THREAD_PER_GUIDE, true, false, 0},
    {"curled, grid", HAIR_SOLVER_DIRECT, HAIR_THREAD_MAPPING_WORKGROUP_PER_GUIDE, true, true, 40},
    {"accurate", HAIR_SOLVER_ACCURATE, HAIR_THREAD_MAPPING_AUTO, false, false, 0},
};
enum { WAYS = sizeof ways / sizeof *ways };

static bool is_tried(int way)
{
    return ways[way].is_quick || getenv("HAIR_TEST_FULL");
}

struct fixture {
    struct hair_test* test;
    struct hair_test_strands strands;
    struct hair_test_living living;
    const struct way* way;
    double density; // kg per metre of a guide
};

static struct fixture start(struct hair_test* test, const struct way* way, const hair_physics* physics)
{
    struct fixture f = {.test = test, .way = way};
    hair_desc desc = hair_test_rods(way->solver, way->mapping, 0, physics);
    f.strands = hair_test_strands_make(1, VERTICES);
    for (int i = 0; i < VERTICES; ++i) {
        float t = (float)i / (VERTICES - 1), side = way->is_curled ? 0.01f * sinf(25 * t) : 0;
        hair_store3(f.strands.positions + 3 * f.strands.vertex_count++,
                    hair_v3(LENGTH * (t - 0.5f), 0, side));
    }
    f.strands.vertices[f.strands.count++] = VERTICES;
    hair_test_live(test, &f.strands, &desc, &f.living);
    f.density = PI * (double)physics->fiber.radius * (double)physics->fiber.radius *
                (double)physics->fiber.density * (double)STRANDS;
    hair_test_ok(test, hair_record_contacts(f.living.hair, STRANDS));
    return f;
}

static void finish(struct fixture* f)
{
    hair_test_die(&f->living);
    hair_test_strands_free(&f->strands);
}

// Set a collider, and those far away.
static void set_collider(struct fixture* f, const hair_collider* collider)
{
    hair_collider all[64];
    all[0] = *collider;
    for (uint32_t i = 1; i <= f->way->colliders; ++i) {
        all[i] = hair_test_body(HAIR_SHAPE_SPHERE, 0.2f * (float)i, -3, 0);
        all[i].size[0] = 0.01f;
    }
    hair_test_set_colliders(&f->living, all, 1 + f->way->colliders);
}

// Read the centre of mass of the guide, m, and its mass, kg.
static double find_center(struct fixture* f, double center[3])
{
    double sum = 0;
    hair_test_read_guides(&f->living);
    memset(center, 0, 3 * sizeof *center);
    for (uint32_t i = 0; i < VERTICES; ++i) {
        hair_vec3 at = hair_test_at(&f->living, 0, i);
        double mass = 0;
        if (i > 0) mass += 0.5 * (double)hair_distance(at, hair_test_at(&f->living, 0, i - 1));
        if (i + 1 < VERTICES) mass += 0.5 * (double)hair_distance(at, hair_test_at(&f->living, 0, i + 1));
        sum += mass;
        center[0] += mass * (double)at.x, center[1] += mass * (double)at.y, center[2] += mass * (double)at.z;
    }
    for (int k = 0; k < 3; ++k) center[k] /= sum;
    return f->density * sum;
}

// Add the impulses on collider 0 since the last call. Return whether there were any.
static bool add_impulse(struct fixture* f, double sum[3], hair_collider_contact* out)
{
    hair_collider_contact contacts[64];
    uint32_t count = 0;
    hair_test_ok(f->test, hair_get_contacts(f->living.hair, true, contacts, sizeof *contacts, 64, &count));
    assert_in_range(count, 0, 1);
    if (!count) return false;
    assert_int_equal(contacts[0].collider, 0);
    for (int k = 0; k < 3; ++k) sum[k] += (double)contacts[0].impulse[k];
    if (out) *out = contacts[0];
    return true;
}

// Let a strand without roots fall on a plane, and weigh it there. The plane has its position beside
// the strand, so that the weight has a moment.
static void resting_strand_presses_with_its_weight(void** state)
{
    for (int w = 0; w < WAYS; ++w) {
        if (!is_tried(w)) continue;
        hair_physics physics = hair_test_loose(0.3f);
        physics.root = HAIR_ROOT_FREE;
        struct fixture f = start(*state, &ways[w], &physics);
        hair_collider plane = hair_test_body(HAIR_SHAPE_PLANE, 0.1f, -0.02f, 0);
        double before[3] = {0}, sum[3] = {0}, center[3];
        hair_collider_contact last;
        set_collider(&f, &plane);
        hair_test_wait(&f.living, 120);
        assert_true(add_impulse(&f, before, NULL));
        for (int i = 0; i < 60; ++i) {
            hair_test_wait(&f.living, 1);
            assert_true(add_impulse(&f, sum, &last));
        }
        double weight = find_center(&f, center) * 9.81, force = -sum[1];
        print_message("    %s: weight %.4g N, force %.4g N, %.2f %% off\n", ways[w].name, weight, force,
                      100 * (force / weight - 1));
        assert_true(fabs(force / weight - 1) < 0.01);
        assert_true(hypot(sum[0], sum[2]) < 0.01 * weight);
        assert_true(last.vertices >= VERTICES / 2 && last.normal[1] > 0.999f);
        assert_true(fabs((double)last.position[0] - center[0]) < 0.01);
        assert_true(fabs((double)last.position[1] + 0.02) < 0.002);
        double moment = ((double)last.position[0] - 0.1) * (double)last.impulse[1];
        assert_true(moment > 0 && fabs((double)last.angular_impulse[2] / moment - 1) < 0.01);
        finish(&f);
    }
}

// Strike a strand that floats with a ball, and compare the momentum that the strand has then.
static void struck_strand_gains_the_momentum_that_the_ball_loses(void** state)
{
    for (int w = 0; w < WAYS; ++w) {
        if (!is_tried(w)) continue;
        hair_physics physics = hair_test_loose(0.3f);
        physics.root = HAIR_ROOT_FREE;
        memset(physics.gravity, 0, sizeof physics.gravity);
        physics.damping = 0;
        struct fixture f = start(*state, &ways[w], &physics);
        hair_collider ball = hair_test_body(HAIR_SHAPE_SPHERE, 0.02f, -0.1f, 0.003f);
        ball.size[0] = 0.03f;
        double sum[3] = {0}, from[3], to[3], momentum[3], off = 0, size = 0, mass = 0;
        for (int i = 0; i < 30; ++i) {
            ball.position[1] = -0.1f + 0.006f * (float)(i < 20 ? i : 20);
            set_collider(&f, &ball);
            hair_test_wait(&f.living, 1);
            add_impulse(&f, sum, NULL);
        }
        hair_test_wait(&f.living, 10);
        add_impulse(&f, sum, NULL);
        mass = find_center(&f, from);
        hair_test_wait(&f.living, 30);
        find_center(&f, to);
        for (int k = 0; k < 3; ++k) {
            momentum[k] = mass * (to[k] - from[k]) / 0.5;
            off += (momentum[k] + sum[k]) * (momentum[k] + sum[k]);
            size += momentum[k] * momentum[k];
        }
        print_message("    %s: momentum (%.4g, %.4g, %.4g), impulse (%.4g, %.4g, %.4g) N s, %.2f %% off\n",
                      ways[w].name, momentum[0], momentum[1], momentum[2], sum[0], sum[1], sum[2],
                      100 * sqrt(off / size));
        assert_true(momentum[1] > 1e-5 && sqrt(off / size) < 0.01);
        finish(&f);
    }
}

// Without a record nothing is there. A record without colliders takes nothing either.
static void contacts_cost_nothing_unless_recorded(void** state)
{
    hair_physics physics = hair_test_loose(0.3f);
    struct fixture f = start(*state, &ways[1], &physics);
    hair_instance* hair = f.living.hair;
    hair_collider plane = hair_test_body(HAIR_SHAPE_PLANE, 0, -0.02f, 0);
    hair_test_wait(&f.living, 1);
    assert_int_equal(hair->sim.impulses.record, 0);
    hair_test_ok(f.test, hair_record_contacts(hair, 0));
    set_collider(&f, &plane);
    hair_test_wait(&f.living, 2);
    uint64_t before = hair_test_gpu_bytes(f.test);
    assert_int_equal(hair->memory.bytes[HAIR_GL_CATEGORY_IMPULSES], 0);
    hair_test_ok(f.test, hair_record_contacts(hair, 1));
    hair_test_wait(&f.living, 2);
    assert_true(hair->memory.bytes[HAIR_GL_CATEGORY_IMPULSES] > 0);
    hair_test_ok(f.test, hair_record_contacts(hair, 0));
    assert_int_equal(hair_test_gpu_bytes(f.test), before);
    hair_test_wait(&f.living, 1);
    assert_int_equal(hair_test_gpu_bytes(f.test), before);
    finish(&f);
}

// Ask in time, late, with too little room, and not at all for longer than the steps on their way.
static void contacts_are_reported_once(void** state)
{
    hair_physics physics = hair_test_loose(0.3f);
    physics.root = HAIR_ROOT_FREE;
    struct fixture f = start(*state, &ways[1], &physics);
    hair_instance* hair = f.living.hair;
    hair_collider plane = hair_test_body(HAIR_SHAPE_PLANE, 0, -0.02f, 0);
    hair_collider_contact contact;
    uint32_t count = 7;
    plane.key = 99;
    set_collider(&f, &plane);
    hair_test_wait(&f.living, 120);
    hair_test_ok(f.test, hair_get_contacts(hair, true, &contact, sizeof contact, 1, &count));
    assert_int_equal(count, 1);
    assert_int_equal(contact.key, 99);
    hair_test_ok(f.test, hair_get_contacts(hair, true, &contact, sizeof contact, 1, &count));
    assert_int_equal(count, 0);
    hair_test_wait(&f.living, 3 * HAIR_IMPULSE_SLOTS);
    hair_test_ok(f.test, hair_get_contacts(hair, true, NULL, sizeof contact, 0, &count));
    assert_int_equal(count, 1); // The contact is kept, because there was no room.
    hair_test_ok(f.test, hair_get_contacts(hair, false, &contact, sizeof contact, 1, &count));
    double center[3], weight = find_center(&f, center) * 9.81;
    hair_test_near("impulse", 1, (double)contact.impulse[1], -weight * 3 * HAIR_IMPULSE_SLOTS / 60,
                   0.01 * weight * HAIR_IMPULSE_SLOTS / 20);
    finish(&f);
}

static void wrong_requests_for_contacts_are_refused(void** state)
{
    struct hair_test* test = *state;
    hair_physics physics = hair_test_loose(0.3f);
    struct fixture f = start(test, &ways[1], &physics);
    hair_instance* hair = f.living.hair;
    hair_collider_contact contact;
    uint32_t count;
    const size_t size = sizeof contact;
    const float bad[] = {-1, 2e6f, NAN, INFINITY};
    for (size_t i = 0; i < sizeof bad / sizeof *bad; ++i)
        hair_test_refused(test, hair_record_contacts(hair, bad[i]), HAIR_ERROR_ARGUMENT, "not in [0, 1e6]");
    hair_test_refused(test, hair_get_contacts(hair, false, &contact, size, 1, NULL), HAIR_ERROR_ARGUMENT,
                      "count is NULL");
    hair_test_refused(test, hair_get_contacts(hair, false, NULL, size, 1, &count), HAIR_ERROR_ARGUMENT,
                      "contacts is NULL but capacity is 1");
    hair_test_refused(test, hair_get_contacts(hair, false, &contact, 3, 1, &count), HAIR_ERROR_ARGUMENT,
                      "stride is 3, not sizeof(hair_collider_contact)");
    hair_test_ok(test, hair_record_contacts(hair, 0));
    hair_test_refused(test, hair_get_contacts(hair, false, &contact, size, 1, &count), HAIR_ERROR_ARGUMENT,
                      "hair_record_contacts() records no contacts");
    assert_int_equal(hair_record_contacts(NULL, 1), HAIR_ERROR_ARGUMENT);
    assert_int_equal(hair_get_contacts(NULL, false, &contact, size, 1, &count), HAIR_ERROR_ARGUMENT);
    // A failed step leaves no memory and can be repeated.
    hair_collider plane = hair_test_body(HAIR_SHAPE_PLANE, 0, -0.02f, 0);
    set_collider(&f, &plane);
    hair_test_ok(test, hair_record_contacts(hair, 1));
    hair_test_ok(test, hair_set_memory_limit(test->context, hair_test_gpu_bytes(test) + 100));
    hair_test_refused(test, hair_step(hair, 1.0f / 60), HAIR_ERROR_MEMORY, "hair impulse");
    hair_test_ok(test, hair_set_memory_limit(test->context, 0));
    hair_test_wait(&f.living, 1);
    finish(&f);
}

int main(void)
{
    if (hair_test_skips()) return 0;
    const struct CMUnitTest tests[] = {
        HAIR_TEST(resting_strand_presses_with_its_weight),
        HAIR_TEST(struck_strand_gains_the_momentum_that_the_ball_loses),
        HAIR_TEST(contacts_cost_nothing_unless_recorded),
        HAIR_TEST(contacts_are_reported_once),
        HAIR_TEST(wrong_requests_for_contacts_are_refused),
    };
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
