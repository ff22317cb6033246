// rod_whip_test.c - energy of undamped straight strands that are released from high up, so that
// their tips whip.
#include "tests/support/hair_grid.h"

#include <math.h>
#include <stdlib.h>

#define LENGTH 0.3f
#define GRAVITY 9.81

// Return the energy per mass of a metre, in the middle of the last substep. The kinetic energy is
// by the displacement, and the potential energy is the mean of both ends.
static double energy_of(const struct hair_test_living* living)
{
    const struct hair_sim* sim = &living->hair->sim;
    uint32_t n = living->vertices;
    struct hair_state* at = hair_test_buffer(sim->state, n * sizeof *at);
    // Packed rods begin with the strain and the segment of each vertex.
    struct {
        hair_vec4 strain, segment;
    }* rod = hair_test_buffer(sim->rod, n * sizeof *rod);
    double sum = 0, last[2][3] = {{0}};
    // Fraction of the substep that the last leap covers.
    double part = fmin((double)at[0].position.w, 1);
    for (uint32_t i = 0; i < n; ++i) {
        double mass = rod[i].segment.y > 0 ? 1 / (double)rod[i].segment.y : 0;
        for (int start = 0; start < 2; ++start) {
            const float *p = &at[i].position.x, *d = &at[i].displacement.x;
            double edge[3], l = 0, bend = 0;
            for (int a = 0; a < 3; ++a) {
                sum += mass * pow((double)d[a] / sim->substep, 2) / 4;
                if (a == 1) sum += mass * GRAVITY * ((double)p[a] - start * part * (double)d[a]) / 2;
                if (i + 1 == n) continue;
                const float *q = &at[i + 1].position.x, *f = &at[i + 1].displacement.x;
                edge[a] = (double)q[a] - (double)p[a] - start * part * ((double)f[a] - (double)d[a]);
                l += edge[a] * edge[a];
            }
            if (i + 1 == n) continue;
            for (int a = 0; a < 3; ++a) {
                edge[a] /= sqrt(l);
                if (i == 0)
                    last[start][a] = (double)(&living->groom->rest[1].position.x)[a] -
                                     (double)(&living->groom->rest[0].position.x)[a];
                if (i == 0) last[start][a] /= (double)living->groom->rest[0].position.w;
                bend += pow(edge[a] - last[start][a], 2), last[start][a] = edge[a];
            }
            sum += (double)rod[i].strain.w * bend / 4;
        }
    }
    free(at), free(rod);
    return sum;
}

struct whip {
    uint32_t vertices;
    double degrees; // Degrees from straight down.
    hair_root root;
    hair_thread_mapping mapping;
    double substep; // Seconds. 0 lets the solver choose.
    // 1 puts a ball beside the plane of the whip, nearer to the root than 2 cm.
    int beside;
    double seconds;
};

// Release a strand and check its energy until `seconds`. The energy is relative to the strand
// hanging straight down. Substeps sample short waves coarsely, which makes the energy vary in
// between.
static void keep_energy(struct hair_test* test, const struct whip* whip)
{
    hair_physics physics = hair_test_bare();
    struct hair_test_living living;
    double angle = whip->degrees * 3.14159265358979 / 180, first = 0, max = 0, now = 0;
    physics.damping = 0;
    physics.root = whip->root;
    hair_vec3 way = hair_v3((float)sin(angle), (float)-cos(angle), 0);
    struct hair_test_strands strands = hair_test_straight(whip->vertices, hair_v3(0, 0, 0), way, LENGTH);
    hair_desc desc = hair_test_rods(HAIR_SOLVER_ACCURATE, whip->mapping, whip->substep, &physics);
    hair_test_live(test, &strands, &desc, &living);
    hair_test_strands_free(&strands);
    hair_collider ball = hair_test_body(HAIR_SHAPE_SPHERE, 0, 0, 0.09f);
    ball.size[0] = 0.08f;
    if (whip->beside) hair_test_set_colliders(&living, &ball, 1);
    double h = living.hair->sim.substep, lowest = -GRAVITY * (double)LENGTH * (double)LENGTH / 2;
    for (int i = 0; i < (int)(whip->seconds / (10 * h)); ++i) {
        hair_test_advance(&living, NULL, 10 * h);
        now = energy_of(&living) - lowest;
        if (i == 0) first = now;
        max = fmax(max, now);
    }
    print_message(
        "    %u vertices from %g degrees, root %d, 1/%.0f s, %d colliders: %.4f of the energy left after "
        "%g s, at most %.4f\n",
        whip->vertices, whip->degrees, (int)whip->root, 1 / h, whip->beside, now / first, whip->seconds,
        max / first);
    hair_test_healthy(&living);
    assert_true(now > 0.97 * first);
    assert_true(max < 1.015 * first);
    hair_test_die(&living);
}

static void cracking_whip_keeps_its_energy(void** state)
{
    static const struct whip whips[] = {
        {16, 90, HAIR_ROOT_CLAMPED, HAIR_THREAD_MAPPING_WORKGROUP_PER_GUIDE, 0, 0, 5},
        {16, 120, HAIR_ROOT_HINGED, HAIR_THREAD_MAPPING_THREAD_PER_GUIDE, 0, 0, 5},
        {32, 90, HAIR_ROOT_CLAMPED, HAIR_THREAD_MAPPING_THREAD_PER_GUIDE, 0, 0, 5},
        {32, 90, HAIR_ROOT_HINGED, HAIR_THREAD_MAPPING_WORKGROUP_PER_GUIDE, 0, 0, 5},
        {32, 120, HAIR_ROOT_CLAMPED, HAIR_THREAD_MAPPING_WORKGROUP_PER_GUIDE, 0, 0, 5},
        {32, 90, HAIR_ROOT_CLAMPED, HAIR_THREAD_MAPPING_WORKGROUP_PER_GUIDE, 1.0 / 1024, 0, 5},
        {32, 170, HAIR_ROOT_CLAMPED, HAIR_THREAD_MAPPING_THREAD_PER_GUIDE, 1.0 / 1024, 0, 5},
        {32, 90, HAIR_ROOT_CLAMPED, HAIR_THREAD_MAPPING_WORKGROUP_PER_GUIDE, 1.0 / 2048, 0, 5},
        {32, 90, HAIR_ROOT_CLAMPED, HAIR_THREAD_MAPPING_WORKGROUP_PER_GUIDE, 1.0 / 1024, 1, 5},
        {32, 90, HAIR_ROOT_CLAMPED, HAIR_THREAD_MAPPING_THREAD_PER_GUIDE, 1.0 / 1024, 1, 5},
        {64, 90, HAIR_ROOT_CLAMPED, HAIR_THREAD_MAPPING_THREAD_PER_GUIDE, 0, 0, 2.2},
        {64, 90, HAIR_ROOT_CLAMPED, HAIR_THREAD_MAPPING_WORKGROUP_PER_GUIDE, 1.0 / 1024, 0, 1.5},
        {64, 90, HAIR_ROOT_CLAMPED, HAIR_THREAD_MAPPING_THREAD_PER_GUIDE, 1.0 / 1024, 1, 1.2},
        {128, 90, HAIR_ROOT_CLAMPED, HAIR_THREAD_MAPPING_WORKGROUP_PER_GUIDE, 0, 0, 1.5},
        {128, 90, HAIR_ROOT_HINGED, HAIR_THREAD_MAPPING_THREAD_PER_GUIDE, 1.0 / 1024, 0, 1.2},
    };
    for (size_t k = 0; k < sizeof whips / sizeof *whips; ++k) keep_energy(*state, &whips[k]);
}

// Simulate equal strands, with `at_once` substeps per step, and return their state.
static struct hair_state* whip_in_steps(struct hair_test* test, hair_thread_mapping mapping,
                                        uint32_t vertices, uint32_t guides, int substeps, int at_once)
{
    hair_physics physics = hair_test_bare();
    struct hair_test_living living;
    physics.damping = 0;
    struct hair_test_strands strands = hair_test_strands_make(guides, vertices);
    for (uint32_t i = 0; i < guides; ++i)
        hair_test_add_straight(&strands, vertices, hair_v3(0, 0, 0), hair_v3(1, 0, 0), LENGTH);
    hair_desc desc = hair_test_rods(HAIR_SOLVER_ACCURATE, mapping, 1.0 / 1024, &physics);
    hair_test_live(test, &strands, &desc, &living);
    hair_test_strands_free(&strands);
    for (int i = 0; i < substeps; i += at_once) hair_test_advance(&living, NULL, at_once / 1024.0);
    assert_int_equal(living.vertices, guides * vertices);
    struct hair_state* at = hair_test_buffer(living.hair->sim.state, living.vertices * sizeof *at);
    hair_test_die(&living);
    return at;
}

static const hair_thread_mapping mappings[] = {HAIR_THREAD_MAPPING_WORKGROUP_PER_GUIDE,
                                               HAIR_THREAD_MAPPING_THREAD_PER_GUIDE};

// Check longer steps. The second program starts anew with all substeps of a dispatch, and may take
// them in several dispatches.
static void cracking_whip_is_equal_in_longer_steps(void** state)
{
    // The two programs round differently on GPUs, and where only the first runs a thread per guide.
    if (!((struct hair_test*)*state)->context->gl.software) return;
    for (int k = 0; k < 3; ++k) {
        uint32_t vertices = k < 2 ? 32 : 64;
        int substeps = k < 2 ? 2048 : 960;
        struct hair_state* one = whip_in_steps(*state, mappings[k % 2], vertices, 1, substeps, 1);
        struct hair_state* many = whip_in_steps(*state, mappings[k % 2], vertices, 1, substeps, 16);
        assert_true(one[0].position.w < 1); // The last substep was taken in parts.
        assert_memory_equal(one, many, vertices * sizeof *one);
        free(one), free(many);
    }
}

// Check that the second program does every guide of its list. A work group of the first program has
// more than one of them if a thread does each.
static void whips_of_many_guides_are_equal(void** state)
{
    enum { VERTICES = 64, GUIDES = 9 };
    for (int k = 0; k < 2; ++k) {
        struct hair_state* at = whip_in_steps(*state, mappings[k], VERTICES, GUIDES, 960, 16);
        assert_true(at[0].position.w < 1);
        for (int i = 1; i < GUIDES; ++i) assert_memory_equal(at, at + i * VERTICES, VERTICES * sizeof *at);
        free(at);
    }
}

int main(void)
{
    if (hair_test_skips()) return 0;
    const struct CMUnitTest tests[] = {
        HAIR_TEST(cracking_whip_keeps_its_energy),
        HAIR_TEST(cracking_whip_is_equal_in_longer_steps),
        HAIR_TEST(whips_of_many_guides_are_equal),
    };
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
