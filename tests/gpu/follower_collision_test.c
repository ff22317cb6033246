// follower_collision_test.c - followers that hit colliders are found and pushed out as in the
// double-precision reference. Without colliders in reach, nothing runs.
#include "tests/support/passes.h"
#include "tests/support/scene.h"
#include "tests/support/support.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define STATES 1024
#define COLLIDERS 3

struct fixture {
    struct hair_test_scene scene;
    hair_look look;
    struct hair_reference_sample* samples;
    hair_collider colliders[COLLIDERS];
};

static hair_collider collider_of(hair_shape shape, const float position[3], const float rotation[4],
                                 float radius)
{
    hair_collider collider = hair_collider_default();
    collider.shape = shape;
    collider.size[0] = radius;
    collider.size[1] = 0.1f;
    memcpy(collider.position, position, sizeof collider.position);
    memcpy(collider.rotation, rotation, sizeof collider.rotation);
    return collider;
}

// Create hair with scattered guides, smoothed on the GPU and by the reference, and with colliders
// among them. With `alone`, each follower has one guide. Otherwise a follower's guides lie anywhere
// on the ball, and followers do not resemble hair.
static struct fixture start(void** state, int alone)
{
    struct fixture f = {.scene = hair_test_scene_make(*state, NULL), .look = hair_look_default()};
    hair_desc desc = hair_desc_default();
    struct hair_test_handmade wanted = hair_test_handmade_default();
    wanted.fewest = 5, wanted.max = 30, wanted.guides = 26, wanted.followers = 400;
    f.scene.groom = hair_test_groom(&f.scene.test->host.host, wanted);
    for (uint32_t n = 0; n < wanted.followers && alone; ++n)
        f.scene.groom->followers[n].guide1 = f.scene.groom->followers[n].guide2 =
            f.scene.groom->followers[n].guide0;
    desc.field_voxel = 0.001f; // The minimum.
    hair_test_ok(f.scene.test, hair_create(f.scene.test->context, f.scene.groom, &desc, &f.scene.hair));
    f.samples = hair_test_scene_scatter(&f.scene);
    f.colliders[0] = collider_of(HAIR_SHAPE_SPHERE, (float[3]){0.15f, 0, 0}, (float[4]){0, 0, 0, 1}, 0.05f);
    f.colliders[1] = collider_of(HAIR_SHAPE_CAPSULE, (float[3]){-0.05f, 0.12f, 0.05f},
                                 (float[4]){0.6f, 0, 0, 0.8f}, 0.03f);
    f.colliders[2] =
        collider_of(HAIR_SHAPE_SPHERE, (float[3]){0, -0.1f, 0.14f}, (float[4]){0, 0, 0, 1}, 0.06f);
    hair_test_ok(f.scene.test, hair_set_colliders(f.scene.hair, f.colliders, COLLIDERS, sizeof *f.colliders));
    return f;
}

static void finish(struct fixture* f)
{
    free(f->samples);
    hair_test_scene_free(&f->scene);
}

// Find the follower's point at t in [0, 1].
static void find_point(const struct fixture* f, uint32_t number, double t,
                       const struct hair_reference_repair* repair, struct hair_reference_point* out)
{
    hair_reference_follower(&f->scene.groom->followers[number], &f->look,
                            2 * f->scene.groom->max_vertices - 1, f->samples, t, repair, out);
}

static double distance_to(const hair_collider* collider, const double p[3])
{
    const float* q = collider->rotation;
    double x = (double)q[0], y = (double)q[1], z = (double)q[2], w = (double)q[3];
    // The second column of the rotation is the direction of the collider's y axis.
    double axis[3] = {2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w)}, arm[3], along = 0;
    double half = collider->shape == HAIR_SHAPE_CAPSULE ? (double)collider->size[1] : 0;
    for (int k = 0; k < 3; ++k) {
        arm[k] = p[k] - (double)collider->position[k];
        along += arm[k] * axis[k];
    }
    along = fmin(fmax(along, -half), half);
    for (int k = 0; k < 3; ++k) arm[k] -= along * axis[k];
    return sqrt(arm[0] * arm[0] + arm[1] * arm[1] + arm[2] * arm[2]) - (double)collider->size[0];
}

static double distance_to_all(const struct fixture* f, const double p[3])
{
    double min = INFINITY;
    for (int i = 0; i < COLLIDERS; ++i) min = fmin(min, distance_to(&f->colliders[i], p));
    return min;
}

// SAMPLE is derived in expand_test.c. The factor 2 in TOLERANCE is for the error of repairs.
#define SAMPLE (6 * 4.5 / 16777216)
#define TOLERANCE (2 * (3 * SAMPLE + 0.015 * 8 * SAMPLE / 0.005))

// Maximum error of the field near the surface, in metres.
#define FIELD 3e-4

static float* read_followers(struct fixture* f, hair_follower_collision collision)
{
    uint32_t count = f->scene.groom->info.follower_count * (f->look.strand.segments + 1), there;
    float* vertices = malloc(3 * sizeof *vertices * count);
    f->look.followers.collision = collision;
    hair_test_ok(f->scene.test, hair_set_look(f->scene.hair, &f->look));
    hair_test_ok(f->scene.test,
                 hair_read_positions(f->scene.hair, HAIR_READ_FOLLOWERS, vertices, count, &there));
    assert_int_equal(there, count);
    return vertices;
}

static void read_buffer(struct fixture* f, GLuint buffer, size_t each, void* out)
{
    glGetNamedBufferSubData(buffer, 0, (GLsizeiptr)(f->scene.groom->info.follower_count * each), out);
}

// Return the index of the first vertex inside a collider. `nearest` is the minimum distance from
// the surface of the vertices up to the returned one. Near the surface, rounding decides.
static uint32_t find_hit(struct fixture* f, uint32_t number, double* nearest)
{
    *nearest = INFINITY;
    for (uint32_t k = 1; k <= f->look.strand.segments; ++k) {
        struct hair_reference_point point;
        find_point(f, number, (double)k / f->look.strand.segments, NULL, &point);
        double d = distance_to_all(f, point.position);
        *nearest = fmin(*nearest, fabs(d));
        if (d < 0) return k;
    }
    return UINT32_MAX;
}

static void hit_is_the_first_vertex_inside_a_collider(void** state)
{
    static const uint32_t segments[] = {1, 2, 31, 64, 256};
    struct fixture f = start(state, 0);
    static float hits[400];
    for (size_t i = 0; i < sizeof segments / sizeof *segments; ++i) {
        uint32_t found = 0, doubtful = 0;
        f.look.strand.segments = segments[i];
        free(read_followers(&f, HAIR_FOLLOWER_COLLISION_PUSH_OUT));
        read_buffer(&f, f.scene.hair->geometry.follower_collision.hit, sizeof *hits, hits);
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
    finish(&f);
}

// Check the program for a work group. On a GPU, the threads of a work group divide the vertices of
// a follower.
static void hit_by_work_group_equals_hit_by_thread(void** state)
{
    static const uint32_t segments[] = {1, 31, 32, 33, 100, 256};
    static float hits[400], others[400];
    struct fixture f = start(state, 0);
    int software = f.scene.test->context->gl.software;
    uint32_t runs = hair_test_runs_of(&f.scene.test->context->gl, "strands/hit_group");
    for (size_t i = 0; i < 2 * sizeof segments / sizeof *segments; ++i) {
        uint32_t differ = 0;
        hair_follower_collision collision =
            i % 2 ? HAIR_FOLLOWER_COLLISION_SINGLE_GUIDE : HAIR_FOLLOWER_COLLISION_PUSH_OUT;
        f.look.strand.segments = segments[i / 2];
        float* before = read_followers(&f, collision);
        read_buffer(&f, f.scene.hair->geometry.follower_collision.hit, sizeof *hits, hits);
        f.scene.test->context->gl.software = !software;
        f.scene.hair->geometry.follower_collision.valid = 0; // Forces another search.
        float* after = read_followers(&f, collision);
        f.scene.test->context->gl.software = software;
        read_buffer(&f, f.scene.hair->geometry.follower_collision.hit, sizeof *others, others);
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
    finish(&f);
}

// Compare the prepass with compute. Both evaluate the same function in different shader stages, so
// rounding decides where a vertex is on the surface.
static void hit_by_prepass_equals_hit_by_compute(void** state)
{
    static const uint32_t segments[] = {1, 31, 64, 100};
    static float hits[400], others[400];
    struct fixture f = start(state, 0);
    hair_instance* compute = f.scene.hair;
    hair_desc desc = hair_desc_default();
    hair_instance* prepass = NULL;
    desc.field_voxel = 0.001f;
    desc.hit_method = HAIR_HIT_METHOD_PREPASS;
    hair_test_ok(f.scene.test, hair_create(f.scene.test->context, f.scene.groom, &desc, &prepass));
    f.scene.hair = prepass;
    free(f.samples);
    f.samples = hair_test_scene_scatter(&f.scene);
    hair_test_ok(f.scene.test, hair_set_colliders(prepass, f.colliders, COLLIDERS, sizeof *f.colliders));
    for (int i = 0; i < 8; ++i) {
        uint32_t differ = 0;
        hair_follower_collision collision =
            i % 2 ? HAIR_FOLLOWER_COLLISION_SINGLE_GUIDE : HAIR_FOLLOWER_COLLISION_PUSH_OUT;
        f.look.strand.segments = segments[i / 2];
        f.scene.hair = compute;
        free(read_followers(&f, collision));
        read_buffer(&f, f.scene.hair->geometry.follower_collision.hit, sizeof *hits, hits);
        f.scene.hair = prepass;
        free(read_followers(&f, collision));
        read_buffer(&f, f.scene.hair->geometry.follower_collision.hit, sizeof *others, others);
        for (uint32_t n = 0; n < f.scene.groom->info.follower_count; ++n) differ += hits[n] != others[n];
        print_message("    %u segments: %u of %u differ\n", f.look.strand.segments, differ,
                      f.scene.groom->info.follower_count);
        assert_in_range(differ, 0, 1);
    }
    hair_destroy(compute);
    finish(&f);
}

static void compare(struct fixture* f, uint32_t number, uint32_t k, double t,
                    const struct hair_reference_repair* repair, const float* vertices)
{
    struct hair_reference_point expected;
    size_t at = (size_t)number * (f->look.strand.segments + 1) + k;
    find_point(f, number, t, repair, &expected);
    for (int i = 0; i < 3; ++i)
        hair_test_near("coordinate", at, (double)vertices[3 * at + (size_t)i], expected.position[i],
                       TOLERANCE);
}

static void follower_beyond_its_hit_follows_a_single_guide(void** state)
{
    struct fixture f = start(state, 0);
    float* vertices = read_followers(&f, HAIR_FOLLOWER_COLLISION_SINGLE_GUIDE);
    static float hits[400];
    uint32_t switched = 0;
    read_buffer(&f, f.scene.hair->geometry.follower_collision.hit, sizeof *hits, hits);
    for (uint32_t n = 0; n < f.scene.groom->info.follower_count; ++n) {
        int hit = (double)hits[n] < HAIR_NO_HIT;
        // The other followers have nothing to switch.
        assert_true(!hit || f.scene.groom->followers[n].multi > 0);
        switched += hit;
        for (uint32_t k = 0; k <= f.look.strand.segments; ++k) {
            struct hair_reference_repair repair;
            double t = (double)k / f.look.strand.segments;
            hair_reference_switch(t, (double)hits[n] / f.look.strand.segments, &repair);
            compare(&f, n, k, t, hit ? &repair : NULL, vertices);
        }
    }
    assert_in_range(switched, 30, 370);
    free(vertices);
    finish(&f);
}

static double from_half(uint16_t half)
{
    double mantissa = half & 1023, sign = half >> 15 ? -1 : 1;
    int exponent = half >> 10 & 31;
    return sign * (exponent ? ldexp(1024 + mantissa, exponent - 25) : ldexp(mantissa, -24));
}

static void push_out_curve_is_a_spline(void** state)
{
    static const uint32_t segments[] = {7, 32, 100};
    static float hits[400];
    static uint16_t halves[400][HAIR_REPAIR_CONTROLS][4];
    struct fixture f = start(state, 0);
    for (size_t i = 0; i < sizeof segments / sizeof *segments; ++i) {
        f.look.strand.segments = segments[i];
        float* vertices = read_followers(&f, HAIR_FOLLOWER_COLLISION_PUSH_OUT);
        read_buffer(&f, f.scene.hair->geometry.follower_collision.hit, sizeof *hits, hits);
        read_buffer(&f, f.scene.hair->geometry.follower_collision.repair, sizeof *halves, halves);
        for (uint32_t n = 0; n < f.scene.groom->info.follower_count; ++n) {
            int hit = (double)hits[n] < HAIR_NO_HIT;
            double controls[HAIR_REPAIR_CONTROLS][4];
            for (int c = 0; c < HAIR_REPAIR_CONTROLS; ++c)
                for (int axis = 0; axis < 4; ++axis) controls[c][axis] = from_half(halves[n][c][axis]);
            for (uint32_t k = 0; k <= f.look.strand.segments; ++k) {
                struct hair_reference_repair repair;
                double t = (double)k / f.look.strand.segments;
                if (hit) t *= 1 + controls[0][0];
                hair_reference_spline(controls, t, &repair);
                compare(&f, n, k, t, hit ? &repair : NULL, vertices);
            }
        }
        free(vertices);
    }
    finish(&f);
}

struct strand {
    double deepest, length;
};

static struct strand measure(const struct fixture* f, const float* vertices, uint32_t number)
{
    struct strand strand = {0};
    const float* p = vertices + (size_t)number * (f->look.strand.segments + 1) * 3;
    for (uint32_t k = 1; k <= f->look.strand.segments; ++k) {
        double at[3] = {(double)p[3 * k], (double)p[3 * k + 1], (double)p[3 * k + 2]}, square = 0;
        for (uint32_t i = 0; i < 3; ++i) square += pow(at[i] - (double)p[3 * (k - 1) + i], 2);
        strand.length += sqrt(square);
        strand.deepest = fmax(strand.deepest, -distance_to_all(f, at));
    }
    return strand;
}

// Check followers that are pushed out of colliders. Strands whose roots are inside, or nearly
// inside, have no direct way out, and are left out.
static void pushed_out_followers_are_outside_and_keep_their_length(void** state)
{
    struct fixture f = start(state, 1);
    float* before = read_followers(&f, HAIR_FOLLOWER_COLLISION_NONE);
    float* after = read_followers(&f, HAIR_FOLLOWER_COLLISION_PUSH_OUT);
    uint32_t inside = 0, left = 0;
    double deepest = 0, longest = 0;
    for (uint32_t n = 0; n < f.scene.groom->info.follower_count; ++n) {
        const float* p = before + (size_t)n * (f.look.strand.segments + 1) * 3;
        double root[3] = {(double)p[0], (double)p[1], (double)p[2]};
        struct strand a = measure(&f, before, n), b = measure(&f, after, n);
        if (distance_to_all(&f, root) < 0.01) continue;
        if (a.deepest == 0)
            assert_memory_equal(p, after + (p - before), 3 * (f.look.strand.segments + 1) * sizeof *p);
        inside += a.deepest > 1e-3;
        left += b.deepest > 1e-4;
        deepest = fmax(deepest, a.deepest);
        longest = fmax(longest, fabs(b.length / a.length - 1));
    }
    print_message("    %u inside, up to %.3f m; %u are left; lengths off by up to %.4f\n", inside, deepest,
                  left, longest);
    assert_true(inside > 10);
    assert_int_equal(left, 0);
    assert_true(longest < 0.01);
    free(before);
    free(after);
    finish(&f);
}

// Check that followers move continuously with a collider. Strands that the collider covers beyond
// its middle are left out, because they leave on the other side. Simulated guides do not occur
// there.
static void small_collider_motion_moves_followers_little(void** state)
{
    struct fixture f = start(state, 1);
    float* before = NULL;
    double worst = 0;
    size_t each = f.look.strand.segments + 1;
    float* freely = read_followers(&f, HAIR_FOLLOWER_COLLISION_NONE);
    for (int frame = 0; frame < 60; ++frame) {
        f.colliders[0].position[0] = 0.25f - 0.002f * (float)frame;
        hair_test_ok(f.scene.test,
                     hair_set_colliders(f.scene.hair, f.colliders, COLLIDERS, sizeof *f.colliders));
        float* now = read_followers(&f, HAIR_FOLLOWER_COLLISION_PUSH_OUT);
        for (size_t i = 0; before && i < each * f.scene.groom->info.follower_count; ++i) {
            double square = 0;
            if (measure(&f, freely, (uint32_t)(i / each)).deepest > 0.01) continue;
            for (size_t k = 3 * i; k < 3 * i + 3; ++k) square += pow((double)now[k] - (double)before[k], 2);
            worst = fmax(worst, sqrt(square));
        }
        free(before);
        before = now;
    }
    print_message("    steps of 2 mm move followers by up to %.1f mm\n", 1000 * worst);
    assert_true(worst < 0.01);
    free(freely);
    free(before);
    finish(&f);
}

static void follower_collision_costs_nothing_out_of_reach(void** state)
{
    struct fixture f = start(state, 0);
    uint32_t hits = hair_test_runs_of(&f.scene.test->context->gl, "strands/hit"),
             repairs = hair_test_runs_of(&f.scene.test->context->gl, "repair");
    float* without = read_followers(&f, HAIR_FOLLOWER_COLLISION_NONE);
    hair_test_ok(f.scene.test, hair_set_colliders(f.scene.hair, NULL, 0, 0));
    float* none = read_followers(&f, HAIR_FOLLOWER_COLLISION_PUSH_OUT);
    for (int i = 0; i < COLLIDERS; ++i) f.colliders[i].position[1] += 3;
    hair_test_ok(f.scene.test, hair_set_colliders(f.scene.hair, f.colliders, COLLIDERS, sizeof *f.colliders));
    float* far = read_followers(&f, HAIR_FOLLOWER_COLLISION_PUSH_OUT);
    size_t size = 3 * sizeof *far * f.scene.groom->info.follower_count * (f.look.strand.segments + 1);
    assert_memory_equal(none, without, size);
    assert_memory_equal(far, without, size);
    assert_int_equal(hair_test_runs_of(&f.scene.test->context->gl, "strands/hit"), hits);
    assert_int_equal(hair_test_runs_of(&f.scene.test->context->gl, "repair"), repairs);
    assert_int_equal(f.scene.hair->geometry.follower_collision.hit +
                         f.scene.hair->geometry.follower_collision.repair +
                         f.scene.hair->geometry.follower_collision.list,
                     0);
    free(far);
    free(none);
    free(without);
    finish(&f);
}

// Check that hits are found once for all views and reads of a step.
static void follower_collision_runs_once_per_pose(void** state)
{
    struct fixture f = start(state, 0);
    free(read_followers(&f, HAIR_FOLLOWER_COLLISION_PUSH_OUT));
    uint32_t count, hits = hair_test_runs_of(&f.scene.test->context->gl, "strands/hit");
    float some[3];
    for (int i = 0; i < 3; ++i)
        hair_test_ok(f.scene.test, hair_read_positions(f.scene.hair, HAIR_READ_FOLLOWERS, some, 1, &count));
    assert_int_equal(hair_test_runs_of(&f.scene.test->context->gl, "strands/hit"), hits);
    hair_test_ok(f.scene.test, hair_step(f.scene.hair, 0.01f));
    for (int i = 0; i < 3; ++i)
        hair_test_ok(f.scene.test, hair_read_positions(f.scene.hair, HAIR_READ_FOLLOWERS, some, 1, &count));
    assert_int_equal(hair_test_runs_of(&f.scene.test->context->gl, "strands/hit"), hits + 1);
    finish(&f);
}

int main(void)
{
    if (hair_test_skips()) return 0;
    const struct CMUnitTest tests[] = {
        HAIR_TEST(hit_is_the_first_vertex_inside_a_collider),
        HAIR_TEST(hit_by_work_group_equals_hit_by_thread),
        HAIR_TEST(hit_by_prepass_equals_hit_by_compute),
        HAIR_TEST(follower_beyond_its_hit_follows_a_single_guide),
        HAIR_TEST(push_out_curve_is_a_spline),
        HAIR_TEST(pushed_out_followers_are_outside_and_keep_their_length),
        HAIR_TEST(small_collider_motion_moves_followers_little),
        HAIR_TEST(follower_collision_costs_nothing_out_of_reach),
        HAIR_TEST(follower_collision_runs_once_per_pose),
    };
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
