// follower_hit_test.c - the first vertex of a follower inside a collider is found as by the
// reference, by a thread, by a work group, and in a prepass.
#include "tests/support/collided.h"
#include "tests/support/passes.h"

#include <math.h>
#include <stdlib.h>

// Maximum error of the field near the surface, in metres.
#define FIELD 3e-4

// Return the index of the first vertex inside a collider. `nearest` is the minimum distance from
// the surface of the vertices up to the returned one. Near the surface, rounding decides.
static uint32_t find_hit(struct hair_test_collided* f, uint32_t number, double* nearest)
{
    *nearest = INFINITY;
    for (uint32_t k = 1; k <= f->look.strand.segments; ++k) {
        struct hair_reference_point point;
        hair_test_collided_point(f, number, (double)k / f->look.strand.segments, NULL, &point);
        double d = hair_test_collided_distance(f, point.position);
        *nearest = fmin(*nearest, fabs(d));
        if (d < 0) return k;
    }
    return UINT32_MAX;
}

static void hit_is_the_first_vertex_inside_a_collider(void** state)
{
    static const uint32_t segments[] = {1, 2, 31, 64, 256};
    struct hair_test_collided f = hair_test_collided_start(*state, 0);
    static float hits[400];
    for (size_t i = 0; i < sizeof segments / sizeof *segments; ++i) {
        uint32_t found = 0, doubtful = 0;
        f.look.strand.segments = segments[i];
        free(hair_test_collided_read(&f, HAIR_FOLLOWER_COLLISION_PUSH_OUT));
        hair_test_collided_read_buffer(&f, f.scene.hair->geometry.follower_collision.hit, sizeof *hits, hits);
        for (uint32_t n = 0; n < f.scene.groom->info.follower_count; ++n) {
            double nearest;
            uint32_t expected = find_hit(&f, n, &nearest);
            if (nearest < FIELD) {
                ++doubtful;
                continue;
            }
            if (expected == UINT32_MAX)
                assert_true((double)hits[n] == HAIR_NO_HIT);
            else
                hair_test_near("hit", n, (double)hits[n], expected, 0);
            found += expected != UINT32_MAX;
        }
        print_message("    %u segments: %u hits, %u in doubt\n", segments[i], found, doubtful);
        assert_in_range(found, 10, 370);
        assert_in_range(doubtful, 0, 60);
    }
    hair_test_collided_finish(&f);
}

// Check the program for a work group. On a GPU, the threads of a work group divide the vertices of
// a follower.
static void hit_by_work_group_equals_hit_by_thread(void** state)
{
    static const uint32_t segments[] = {1, 31, 32, 33, 100, 256};
    static float hits[400], others[400];
    struct hair_test_collided f = hair_test_collided_start(*state, 0);
    int software = f.scene.test->context->gl.software;
    uint32_t runs = hair_test_runs_of(&f.scene.test->context->gl, "strands/hit_group");
    for (size_t i = 0; i < 2 * sizeof segments / sizeof *segments; ++i) {
        uint32_t differ = 0;
        hair_follower_collision collision =
            i % 2 ? HAIR_FOLLOWER_COLLISION_SINGLE_GUIDE : HAIR_FOLLOWER_COLLISION_PUSH_OUT;
        f.look.strand.segments = segments[i / 2];
        float* before = hair_test_collided_read(&f, collision);
        hair_test_collided_read_buffer(&f, f.scene.hair->geometry.follower_collision.hit, sizeof *hits, hits);
        f.scene.test->context->gl.software = !software;
        f.scene.hair->geometry.follower_collision.valid = 0; // Forces another search.
        float* after = hair_test_collided_read(&f, collision);
        f.scene.test->context->gl.software = software;
        hair_test_collided_read_buffer(&f, f.scene.hair->geometry.follower_collision.hit, sizeof *others,
                                       others);
        for (uint32_t n = 0; n < f.scene.groom->info.follower_count; ++n) differ += hits[n] != others[n];
        assert_in_range(differ, 0, 1); // Rounding decides where a vertex is on the surface.
        if (!differ)
            assert_memory_equal(before, after,
                                3 * sizeof *after * f.scene.groom->info.follower_count *
                                    (f.look.strand.segments + 1));
        free(before);
        free(after);
    }
    assert_int_equal(hair_test_runs_of(&f.scene.test->context->gl, "strands/hit_group"),
                     runs + 2 * sizeof segments / sizeof *segments);
    hair_test_collided_finish(&f);
}

// Compare the prepass with compute. Both evaluate the same function in different shader stages, so
// rounding decides where a vertex is on the surface.
static void hit_by_prepass_equals_hit_by_compute(void** state)
{
    static const uint32_t segments[] = {1, 31, 64, 100};
    static float hits[400], others[400];
    struct hair_test_collided f = hair_test_collided_start(*state, 0);
    hair_instance* compute = f.scene.hair;
    hair_desc desc = hair_desc_default();
    hair_instance* prepass = NULL;
    desc.field_voxel = 0.001f;
    desc.hit_method = HAIR_HIT_METHOD_PREPASS;
    hair_test_ok(f.scene.test, hair_create(f.scene.test->context, f.scene.groom, &desc, &prepass));
    f.scene.hair = prepass;
    free(f.samples);
    f.samples = hair_test_scene_scatter(&f.scene);
    hair_test_ok(f.scene.test,
                 hair_set_colliders(prepass, f.colliders, HAIR_TEST_COLLIDED_COLLIDERS, sizeof *f.colliders));
    for (int i = 0; i < 8; ++i) {
        uint32_t differ = 0;
        hair_follower_collision collision =
            i % 2 ? HAIR_FOLLOWER_COLLISION_SINGLE_GUIDE : HAIR_FOLLOWER_COLLISION_PUSH_OUT;
        f.look.strand.segments = segments[i / 2];
        f.scene.hair = compute;
        free(hair_test_collided_read(&f, collision));
        hair_test_collided_read_buffer(&f, f.scene.hair->geometry.follower_collision.hit, sizeof *hits, hits);
        f.scene.hair = prepass;
        free(hair_test_collided_read(&f, collision));
        hair_test_collided_read_buffer(&f, f.scene.hair->geometry.follower_collision.hit, sizeof *others,
                                       others);
        for (uint32_t n = 0; n < f.scene.groom->info.follower_count; ++n) differ += hits[n] != others[n];
        print_message("    %u segments: %u of %u differ\n", f.look.strand.segments, differ,
                      f.scene.groom->info.follower_count);
        assert_in_range(differ, 0, 1);
    }
    hair_destroy(compute);
    hair_test_collided_finish(&f);
}

int main(void)
{
    if (hair_test_skips()) return 0;
    const struct CMUnitTest tests[] = {
        HAIR_TEST(hit_is_the_first_vertex_inside_a_collider),
        HAIR_TEST(hit_by_work_group_equals_hit_by_thread),
        HAIR_TEST(hit_by_prepass_equals_hit_by_compute),
    };
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
