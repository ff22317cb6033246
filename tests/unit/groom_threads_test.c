// groom_threads_test.c - grooms have the same bits by any number of the application's threads.
// `make test config=tsan filter=threads` looks for races between tasks.
#include "lib/rod/prepared.h"
#include "tests/support/grooms.h"

#include <math.h>
#include <pthread.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stddef.h>
#include <string.h>
#include <cmocka.h>

enum { STRANDS = 1500, VERTICES = 20, MAX_THREADS = 7 };

static struct hair_test_host test;

// Threads that take the tasks of a run.
struct pool {
    hair_tasks tasks;
    uint32_t threads, runs;
    hair_task task;
    void* data;
    uint32_t count;
    atomic_uint next;
};

static void* work(void* user)
{
    struct pool* pool = user;
    for (uint32_t i; (i = atomic_fetch_add(&pool->next, 1)) < pool->count;) pool->task(i, pool->data);
    return NULL;
}

static void run(hair_task task, void* data, uint32_t count, void* user)
{
    struct pool* pool = user;
    pthread_t threads[MAX_THREADS];
    uint32_t allocations = test.allocations;
    pool->task = task, pool->data = data, pool->count = count;
    atomic_store(&pool->next, 0);
    ++pool->runs;
    for (uint32_t i = 1; i < pool->threads; ++i)
        assert_int_equal(pthread_create(&threads[i], NULL, work, pool), 0);
    work(pool);
    for (uint32_t i = 1; i < pool->threads; ++i) pthread_join(threads[i], NULL);
    assert_int_equal(test.allocations, allocations);
}

// Shape of the strands of a groom.
struct shape {
    float curl; // Radius of curls, m.
    float bend; // Fall over the length of a strand, m.
};

static hair_vec3 grow(float t, uint32_t strand, const void* user)
{
    const struct shape* shape = user;
    float angle = 2.4f * (float)strand, up = 1 - 1.2f * ((float)strand + 0.5f) / STRANDS;
    float beside = sqrtf(1 - up * up), away = 0.1f + (0.1f + 1e-4f * (float)(strand % 997)) * t;
    float size = shape->curl * fminf(1, 4 * t);
    return hair_v3(away * beside * cosf(angle) + size * cosf(20 * t),
                   away * up - shape->bend * t * t + size * sinf(20 * t), away * beside * sinf(angle));
}

static void assert_equal(const void* a, const void* b, size_t size)
{
    assert_true((a != NULL) == (b != NULL));
    if (a) assert_memory_equal(a, b, size);
}

static void assert_equal_rods(const hair_groom* a, const hair_groom* b)
{
    const struct hair_prepared_rods *p = a->prepared, *q = b->prepared;
    size_t vertices = a->info.guide_vertex_count, guides = a->info.guide_count;
    assert_true(p->mixed == q->mixed && p->substep == q->substep && p->rounds == q->rounds);
    assert_memory_equal(&p->report, &q->report, sizeof p->report);
    assert_memory_equal(p->sags, q->sags, guides * sizeof *p->sags);
    assert_memory_equal(p->borne, q->borne, vertices * sizeof *p->borne);
    const struct hair_rod_parts parts = {.has_factor_euler = !p->mixed, .has_factor = !p->mixed};
    size_t packed = hair_rods_packed_count((uint32_t)guides, (uint32_t)vertices, parts);
    assert_memory_equal(p->rod, q->rod, packed * sizeof *p->rod);
    assert_equal(p->reduction, q->reduction, ((p->rounds + 1) * vertices + 1) * sizeof *p->reduction);
}

static void assert_equal_grooms(const hair_groom* a, const hair_groom* b)
{
    const hair_groom_info* info = &a->info;
    const size_t guides = info->guide_count, followers = info->follower_count;
    assert_memory_equal(info, &b->info, sizeof *info);
    assert_memory_equal(a->guides, b->guides, guides * sizeof *a->guides);
    assert_memory_equal(a->rest, b->rest, info->guide_vertex_count * sizeof *a->rest);
    assert_memory_equal(a->followers, b->followers, hair_groom_follower_bytes(a));
    assert_memory_equal(a->patches, b->patches, info->patch_count * sizeof *a->patches);
    assert_memory_equal(&a->head_sphere, &b->head_sphere, sizeof a->head_sphere);
    assert_equal(a->guide_factors, b->guide_factors, guides * sizeof *a->guide_factors);
    assert_memory_equal(&a->min_factors, &b->min_factors, sizeof a->min_factors);
    assert_memory_equal(&a->max_factors, &b->max_factors, sizeof a->max_factors);
    assert_memory_equal(a->max_follower_factors, b->max_follower_factors, sizeof a->max_follower_factors);
    assert_equal(a->factors, b->factors, followers * a->factor_count * sizeof *a->factors);
    assert_equal(a->guide_shapes, b->guide_shapes,
                 guides * (2 * ((size_t)a->max_vertices - 1) + 1) * sizeof *a->guide_shapes);
    assert_true((a->root_bindings != NULL) == (b->root_bindings != NULL));
    if (a->root_bindings)
        assert_memory_equal(a->root_bindings->binding, b->root_bindings->binding,
                            (guides + followers) * sizeof *a->root_bindings->binding);
    assert_equal_rods(a, b);
}

// Create the groom without threads, and by 1, 2 and 7 threads.
static void check(hair_groom_desc desc, const hair_physics* physics)
{
    static const uint32_t threads[] = {1, 2, MAX_THREADS};
    desc.physics = physics;
    hair_groom* plain = hair_test_groom_of(&desc);
    for (size_t i = 0; i < sizeof threads / sizeof *threads; ++i) {
        struct pool pool = {.tasks = {run, &pool}, .threads = threads[i]};
        desc.tasks = &pool.tasks;
        hair_groom* groom = hair_test_groom_of(&desc);
        assert_true(pool.runs > 8);
        assert_equal_grooms(plain, groom);
        hair_groom_destroy(groom);
    }
    hair_groom_destroy(plain);
}

static void check_shape(const struct shape* shape, const hair_physics* physics, hair_solver solver)
{
    struct hair_test_strands strands = hair_test_strands_make(STRANDS, VERTICES);
    for (uint32_t i = 0; i < STRANDS; ++i) hair_test_strands_add(&strands, VERTICES, grow, shape);
    hair_groom_desc desc = hair_test_groom_desc(&test, &strands);
    desc.strand_set = HAIR_STRAND_SET_GUIDES;
    desc.follower_count = 0;
    desc.solver = solver;
    check(desc, physics);
    hair_test_strands_free(&strands);
}

static void straight_guides_have_equal_bits(void** state)
{
    (void)state;
    const struct shape straight = {0};
    hair_physics physics = hair_physics_default();
    physics.shape.gravity_preload = 0;
    check_shape(&straight, &physics, HAIR_SOLVER_DIRECT);
    check_shape(&straight, &physics, HAIR_SOLVER_ACCURATE);
    check_shape(&straight, &physics, HAIR_SOLVER_FOLLOW);
}

static void curled_guides_have_equal_bits(void** state)
{
    (void)state;
    const struct shape curled = {.curl = 0.008f, .bend = 0.1f};
    hair_physics physics = hair_physics_default();
    check_shape(&curled, &physics, HAIR_SOLVER_DIRECT);
    check_shape(&curled, &physics, HAIR_SOLVER_FOLLOW);
}

// Check guides of three groups with factors, some of which repairs change or drop, with grown
// followers.
static void damaged_guides_with_factors_have_equal_bits(void** state)
{
    (void)state;
    const struct shape bent = {.bend = 0.1f};
    struct hair_test_strands strands = hair_test_strands_make(STRANDS, VERTICES);
    static uint8_t groups[STRANDS];
    static float values[STRANDS], radii[STRANDS];
    for (uint32_t i = 0; i < STRANDS; ++i) {
        hair_test_strands_add(&strands, 4 + i % (VERTICES - 3), grow, &bent);
        groups[i] = (uint8_t)(7 * i % 3);
        values[i] = 0.4f + 0.01f * (float)(i % 60);
        radii[i] = 1 + (float)(i % 5);
    }
    for (uint32_t i = 100; i < strands.vertex_count; i += 171) strands.positions[3 * (size_t)i] = NAN;
    for (uint32_t i = 500, end = 900; i < end; ++i) // Some strands have a single point.
        memcpy(strands.positions + 3 * (size_t)i, strands.positions, 12);
    static const hair_strand_attribute_kind kinds[] = {
        HAIR_STRAND_ATTRIBUTE_STIFFNESS, HAIR_STRAND_ATTRIBUTE_LENGTH, HAIR_STRAND_ATTRIBUTE_RADIUS,
        HAIR_STRAND_ATTRIBUTE_FRIZZ, HAIR_STRAND_ATTRIBUTE_DENSITY};
    hair_strand_attribute attributes[5];
    for (int i = 0; i < 5; ++i) {
        attributes[i] = hair_strand_attribute_default();
        attributes[i].kind = kinds[i];
        attributes[i].strand_values = values;
    }
    hair_groom_desc desc = hair_test_groom_desc(&test, &strands);
    hair_import import = hair_import_default();
    hair_physics physics = hair_physics_default();
    import.tip_first = true;
    import.keep_fraction = 0.9f;
    desc.import = &import;
    desc.strand_set = HAIR_STRAND_SET_GUIDES;
    desc.follower_count = 2 * STRANDS;
    desc.strand_groups = groups;
    desc.strand_radii = radii;
    desc.strand_attributes = attributes;
    desc.strand_attribute_count = 5;
    hair_groom* groom = hair_test_groom_of(&desc);
    assert_true(groom->info.import_stats.dropped_short > 10);
    assert_true(groom->info.import_stats.removed_nonfinite > 10);
    hair_groom_destroy(groom);
    check(desc, &physics);
    hair_test_strands_free(&strands);
}

// Check followers of full strands, and followers grown all over a scalp.
static void followers_have_equal_bits(void** state)
{
    (void)state;
    struct hair_test_strands strands = hair_test_fur(STRANDS);
    struct hair_test_scalp scalp = hair_test_scalp_make(12, 1.2f);
    hair_physics physics = hair_physics_default();
    for (int set = 0; set < 2; ++set) {
        hair_groom_desc desc = hair_test_groom_desc(&test, &strands);
        hair_test_set_scalp(&desc, &scalp);
        desc.strand_set = set ? HAIR_STRAND_SET_FULL : HAIR_STRAND_SET_GUIDES;
        desc.follower_count = set ? 0 : 3 * STRANDS;
        check(desc, &physics);
    }
    hair_test_scalp_free(&scalp);
    hair_test_strands_free(&strands);
}

#define TEST(name) HAIR_TEST_WITH_HOST(name, &test)

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(straight_guides_have_equal_bits),
        TEST(curled_guides_have_equal_bits),
        TEST(damaged_guides_with_factors_have_equal_bits),
        TEST(followers_have_equal_bits),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
