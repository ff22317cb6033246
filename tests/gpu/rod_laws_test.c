// rod_laws_test.c - laws of strands as rods: they fall by the formula, keep momentum and energy,
// and rest. They do not depend on the mapping to threads or on the length of steps.
#include "tests/support/live_hair.h"

#include <math.h>

#define FRAME (1.0 / 60)

// Add guides of many lengths, numbers of vertices and spacings.
static void add_uneven(struct hair_test_strands* strands, uint32_t kind)
{
    static const uint32_t vertices[] = {5, 32, 12, 31, 4, 20};
    float fold = (float)kind, length = 0.1f + 0.05f * fold;
    hair_vec3 way = hair_normalize(hair_v3(1, -0.3f * fold, 0.2f), hair_v3(0, 1, 0));
    for (uint32_t i = 0; i < vertices[kind]; ++i) {
        float t = (float)i / (float)(vertices[kind] - 1);
        t += kind % 2 ? 0.1f * sinf(3.14159f * t) : 0; // Segments near the root are longer.
        hair_vec3 at = hair_add(hair_v3(0.02f * fold, 0, 0), hair_scale(way, length * t));
        hair_store3(strands->positions + 3 * (size_t)strands->vertex_count++, at);
    }
    strands->vertices[strands->count++] = vertices[kind];
}
#define KINDS 6

static struct hair_test_strands uneven(uint32_t first, uint32_t count)
{
    struct hair_test_strands strands = hair_test_strands_make(count, 64);
    for (uint32_t k = first; k < first + count; ++k) add_uneven(&strands, k);
    return strands;
}

// Create an instance, shake its head for a third of a second, read it, and free the strands.
static void shake(struct hair_test* test, struct hair_test_strands* strands, const hair_desc* desc,
                  struct hair_test_living* out)
{
    hair_test_live(test, strands, desc, out);
    for (int k = 1; k <= 20; ++k) {
        struct hair_reference_rod_pose head = hair_test_shaken(k * FRAME);
        hair_test_advance(out, &head, FRAME);
    }
    hair_test_read_guides(out);
    hair_test_strands_free(strands);
}

static double apart(const struct hair_test_living* a, uint32_t guide, const struct hair_test_living* b,
                    uint32_t other)
{
    double max = 0;
    for (uint32_t i = 0; i < a->groom->guides[guide].count; ++i)
        max = fmax(max, (double)hair_distance(hair_test_at(a, guide, i), hair_test_at(b, other, i)));
    return max;
}

// Check guides together and alone. They differ by rounding only, because root frames are chosen by
// the mean direction of all guides.
static void guides_of_one_instance_are_independent(void** state)
{
    hair_physics physics = hair_test_bare();
    for (int kind = 0; kind < 4; ++kind) {
        int solver = kind % 3, mapping = kind < 3 ? HAIR_THREAD_MAPPING_WORKGROUP_PER_GUIDE
                                                  : HAIR_THREAD_MAPPING_THREAD_PER_GUIDE;
        struct hair_test_living together, alone;
        struct hair_test_strands all = uneven(0, KINDS);
        hair_desc desc =
            hair_test_rods((hair_solver)solver, (hair_thread_mapping)mapping, 1.0 / 480, &physics);
        shake(*state, &all, &desc, &together);
        assert_true(hair_test_from_rest(&together) > 0.03);
        for (uint32_t g = 0; g < KINDS; ++g) {
            struct hair_test_strands one = uneven(g, 1);
            shake(*state, &one, &desc, &alone);
            assert_true(apart(&alone, 0, &together, g) < 2e-6);
            hair_test_die(&alone);
        }
        hair_test_die(&together);
    }
}

static void thread_and_work_group_per_guide_agree(void** state)
{
    hair_physics physics = hair_test_bare();
    for (int solver = 0; solver < HAIR_SOLVER_REDBLACK; ++solver) {
        struct hair_test_living living[2];
        for (int m = 0; m < 2; ++m) {
            struct hair_test_strands strands = uneven(0, KINDS);
            hair_thread_mapping mapping =
                m ? HAIR_THREAD_MAPPING_THREAD_PER_GUIDE : HAIR_THREAD_MAPPING_WORKGROUP_PER_GUIDE;
            hair_desc desc = hair_test_rods((hair_solver)solver, mapping, 1.0 / 480, &physics);
            shake(*state, &strands, &desc, &living[m]);
        }
        double max = 0;
        for (uint32_t g = 0; g < KINDS; ++g) max = fmax(max, apart(&living[0], g, &living[1], g));
        print_message("    solver %d: %.2g m apart\n", solver, max);
        assert_true(max < 1e-5);
        hair_test_die(&living[0]);
        hair_test_die(&living[1]);
    }
}

// Check a head that moves evenly or stands, in steps of a frame and of a quarter of a frame.
static void motion_does_not_depend_on_the_step_length(void** state)
{
    hair_physics physics = hair_test_bare();
    for (int solver = 0; solver < HAIR_SOLVER_REDBLACK; ++solver)
        for (int moves = 0; moves < 2; ++moves) {
            struct hair_test_living living[2];
            struct hair_test_strands strands = hair_test_slanting(32);
            for (int cut = 0; cut < 2; ++cut) {
                hair_desc desc = hair_test_rods((hair_solver)solver, HAIR_THREAD_MAPPING_WORKGROUP_PER_GUIDE,
                                                1.0 / 960, &physics);
                int each = cut ? 4 : 1;
                hair_test_live(*state, &strands, &desc, &living[cut]);
                for (int k = 1; k <= 30 * each; ++k) {
                    hair_vec3 at = hair_v3(moves ? 0.01f * (float)k / (float)each : 0, 0, 0);
                    struct hair_reference_rod_pose head = hair_test_pose_of(at, hair_v3(0, 1, 0), 0);
                    hair_test_advance(&living[cut], &head, FRAME / each);
                }
                hair_test_read_guides(&living[cut]);
            }
            double max = apart(&living[0], 0, &living[1], 0);
            print_message("    solver %d, the head %s: %.2g m apart\n", solver, moves ? "moves" : "stands",
                          max);
            assert_true(max <= (moves ? 1e-5 : 0));
            hair_test_die(&living[0]);
            hair_test_die(&living[1]);
            hair_test_strands_free(&strands);
        }
}

static void equal_steps_give_equal_bits(void** state)
{
    hair_physics physics = hair_test_bare();
    physics.fiber.flatness = 0.5f;
    for (int solver = 0; solver < HAIR_SOLVER_REDBLACK; ++solver) {
        struct hair_test_living living[2];
        for (int m = 0; m < 2; ++m) {
            struct hair_test_strands strands = uneven(0, KINDS);
            hair_desc desc =
                hair_test_rods((hair_solver)solver, HAIR_THREAD_MAPPING_WORKGROUP_PER_GUIDE, 0, &physics);
            shake(*state, &strands, &desc, &living[m]);
        }
        assert_memory_equal(living[0].positions, living[1].positions, 12 * living[0].vertices);
        hair_test_die(&living[0]);
        hair_test_die(&living[1]);
    }
}

// Check dv/dt = g - c (v - u) for every vertex of a free strand, whose segments carry no force. v
// is the velocity, u the wind, g gravity, and c the damping. The solver accurate is exact except
// for rounding. The solver direct takes its first step by implicit Euler, which is too far by 3/4 g
// h^2.
static void free_strand_falls_and_drifts_by_the_formula(void** state)
{
    hair_physics physics = hair_test_bare();
    hair_wind wind = hair_wind_default();
    physics.drag = 0;
    physics.root = HAIR_ROOT_FREE;
    wind.velocity[0] = 3, wind.velocity[2] = -1;
    for (int kind = 0; kind < 4; ++kind) {
        int drag = kind / 2, solver = kind % 2;
        struct hair_test_strands strands = hair_test_slanting(16);
        struct hair_test_living living;
        double c = drag ? 5 : 0, worst = 0, t = 0;
        physics.damping = (float)c;
        hair_desc desc =
            hair_test_rods((hair_solver)solver, HAIR_THREAD_MAPPING_WORKGROUP_PER_GUIDE, 0, &physics);
        hair_test_live(*state, &strands, &desc, &living);
        hair_test_wind_coupling(&living, &wind);
        for (int k = 0; k < 60; ++k) {
            hair_test_advance(&living, NULL, FRAME);
            hair_test_read_guides(&living);
            t += (double)(float)FRAME;
            double lag = drag ? t - (1 - exp(-c * t)) / c : 0,
                   fall = drag ? 9.81 / c * lag : 9.81 / 2 * t * t;
            for (uint32_t i = 0; i < 16; ++i) {
                hair_vec3 moved =
                    hair_sub(hair_test_at(&living, 0, i), hair_load3(&living.groom->rest[i].position.x));
                double side = hypot((double)moved.x - 3 * lag, (double)moved.z + lag);
                worst = fmax(worst, hypot(side, (double)moved.y + fall));
            }
        }
        print_message("    damping %g, solver %d: off by up to %.2g m\n", c, solver, worst);
        assert_true(worst < (solver == HAIR_SOLVER_ACCURATE ? 1e-5 : 3e-4));
        hair_test_die(&living);
        hair_test_strands_free(&strands);
    }
}

// Evaluate a kinked strand with segments from a third of a millimetre to eight.
static hair_vec3 kinked(float t, uint32_t strand, const void* user)
{
    static const float at[][3] = {{0, 0, 0},
                                  {0.0001f, -0.0003f, -0.0001f},
                                  {0.001f, -0.0012f, -0.0002f},
                                  {0.0085f, -0.0053f, 0.001f},
                                  {0.0091f, -0.0055f, 0.0012f},
                                  {0.0094f, -0.0055f, 0.0013f},
                                  {0.0106f, -0.0061f, 0.0015f},
                                  {0.0163f, -0.0111f, 0.0013f}};
    (void)strand, (void)user;
    return hair_load3(at[(int)lroundf(7 * t)]);
}

// Check a very stiff strand. The effect of a force on the whole strand must not be lost in rounding
// beside its bending.
static void free_stiff_strand_falls_and_drifts_by_the_formula(void** state)
{
    static const hair_thread_mapping mappings[] = {HAIR_THREAD_MAPPING_WORKGROUP_PER_GUIDE,
                                                   HAIR_THREAD_MAPPING_THREAD_PER_GUIDE};
    for (int kind = 0; kind < 4; ++kind) {
        struct hair_test_living living;
        hair_physics physics = hair_test_bare();
        struct hair_test_strands strands = hair_test_strands_make(1, 8);
        double worst = 0;
        physics.fiber.youngs_modulus = 1e12f;
        physics.fiber.radius = 1e-3f;
        physics.damping = 0;
        physics.root = HAIR_ROOT_FREE;
        hair_test_strands_add(&strands, 8, kinked, NULL);
        hair_desc desc = hair_test_rods((hair_solver)(kind % 2), mappings[kind / 2], 1.0 / 240, &physics);
        hair_test_live(*state, &strands, &desc, &living);
        hair_test_wait(&living, 60);
        hair_test_read_guides(&living);
        for (uint32_t i = 0; i < 8; ++i) {
            hair_vec3 rest = hair_load3(&living.groom->rest[i].position.x);
            hair_vec3 moved = hair_sub(hair_test_at(&living, 0, i), rest);
            worst = fmax(worst, hypot((double)moved.y + 9.81 / 2, hypot((double)moved.x, (double)moved.z)));
        }
        print_message("    mapping %d, solver %d: off by up to %.2g m\n", kind / 2, kind % 2, worst);
        assert_true(worst < 1e-3);
        hair_test_die(&living);
        hair_test_strands_free(&strands);
    }
}

struct motion {
    // Per mass of one metre. Angular momentum is about the centre. Energy excludes elastic energy.
    double momentum[3], angular[3], energy;
};

// Return the motion in the substep between the last two reads.
static struct motion motion_of(const struct hair_test_living* living, double h, double gravity)
{
    struct motion m = {{0}, {0}, 0};
    double total = 0, centre[3] = {0}, x[3], v[3];
    // The first pass finds the centre. The second pass measures about the centre.
    for (uint32_t k = 0; k < 2 * living->vertices; ++k) {
        uint32_t i = k % living->vertices, again = k / living->vertices;
        double after = (double)living->groom->rest[i].position.w;
        double mass = (after + (i > 0 ? (double)living->groom->rest[i - 1].position.w : 0)) / 2;
        for (int d = 0; d < 3; ++d) {
            double a = (double)living->before[3 * i + d], b = (double)living->positions[3 * i + d];
            x[d] = (a + b) / 2 - (again ? centre[d] / total : 0), v[d] = (b - a) / h;
            m.momentum[d] += again ? mass * v[d] : 0;
            if (!again) centre[d] += mass * x[d];
        }
        if (!again) total += mass;
        if (!again) continue;
        for (int d = 0; d < 3; ++d)
            m.angular[d] += mass * (x[(d + 1) % 3] * v[(d + 2) % 3] - x[(d + 2) % 3] * v[(d + 1) % 3]);
        m.energy +=
            mass * ((v[0] * v[0] + v[1] * v[1] + v[2] * v[2]) / 2 + gravity * (x[1] + centre[1] / total));
    }
    return m;
}

static double change(const double a[3], const double b[3])
{
    double sum = 0, size = 0;
    for (int d = 0; d < 3; ++d) sum += (a[d] - b[d]) * (a[d] - b[d]), size += a[d] * a[d];
    return sqrt(sum / size);
}

// Check a strand set in motion by a shaken head and then freed, without gravity and air. Elastic
// forces and length constraints must not change its momentum.
static void free_strand_keeps_both_momenta(void** state)
{
    for (int solver = 0; solver < 2; ++solver) {
        hair_physics physics = hair_test_bare();
        struct hair_test_strands strands = hair_test_slanting(16);
        struct hair_test_living living;
        struct motion first = {{0}, {0}, 0}, now = first;
        const double h = 1.0 / 960;
        hair_desc desc =
            hair_test_rods((hair_solver)solver, HAIR_THREAD_MAPPING_WORKGROUP_PER_GUIDE, h, &physics);
        shake(*state, &strands, &desc, &living);
        physics.root = HAIR_ROOT_FREE;
        physics.damping = 0;
        physics.gravity[1] = 0;
        hair_test_ok(*state, hair_set_physics(living.hair, &physics));
        for (int k = 0; k < 960; ++k) {
            hair_test_advance(&living, NULL, h);
            if (k < 10 || k > 950) hair_test_read_guides(&living);
            if (k == 9) first = motion_of(&living, h, 0);
        }
        now = motion_of(&living, h, 0);
        print_message("    solver %d: momentum changes by %.2g, angular momentum by %.2g\n", solver,
                      change(first.momentum, now.momentum), change(first.angular, now.angular));
        assert_true(change(first.momentum, now.momentum) < 5e-4);
        assert_true(change(first.angular, now.angular) < 5e-4);
        hair_test_die(&living);
    }
}

// Check the energy, in units of m g L / 2, over ten seconds of a chaotic chain. A solver with
// damping loses all of it.
static void accurate_solver_keeps_the_energy_of_a_swing(void** state)
{
    hair_physics physics = hair_test_bare();
    physics.damping = 0;
    physics.fiber.youngs_modulus = 0;
    struct hair_test_strands strands = hair_test_straight(8, hair_v3(0, 0, 0), hair_v3(1, 0, 0), 0.3f);
    struct hair_test_living living;
    const double h = 1.0 / 960, scale = 9.81 * 0.3 * 0.15;
    hair_desc desc =
        hair_test_rods(HAIR_SOLVER_ACCURATE, HAIR_THREAD_MAPPING_WORKGROUP_PER_GUIDE, h, &physics);
    hair_test_live(*state, &strands, &desc, &living);
    for (int k = 0; k < 9600; ++k) {
        hair_test_advance(&living, NULL, h);
        if (k % 960 > 957) hair_test_read_guides(&living);
        if (k % 960 == 959) assert_true(fabs(motion_of(&living, h, 9.81).energy) < 1e-2 * scale);
    }
    print_message("    %.2g of it after 10 s\n", motion_of(&living, h, 9.81).energy / scale);
    hair_test_die(&living);
    hair_test_strands_free(&strands);
}

static void strand_hanging_straight_down_stays_still(void** state)
{
    static const uint32_t vertices[] = {2, 3, 8, 32, 100};
    hair_physics physics = hair_test_bare();
    for (int solver = 0; solver < HAIR_SOLVER_REDBLACK; ++solver)
        for (int k = 0; k < 5; ++k) {
            struct hair_test_strands strands =
                hair_test_straight(vertices[k], hair_v3(0, 0, 0), hair_v3(0, -1, 0), 0.3f);
            struct hair_test_living living;
            hair_desc desc =
                hair_test_rods((hair_solver)solver, HAIR_THREAD_MAPPING_WORKGROUP_PER_GUIDE, 0, &physics);
            hair_test_live(*state, &strands, &desc, &living);
            hair_test_wait(&living, 120);
            hair_test_read_guides(&living);
            assert_true(hair_test_from_rest(&living) < 1e-6);
            hair_test_advance(&living, NULL, 1.0 / 240);
            hair_test_read_guides(&living);
            assert_true(hair_test_moved(&living) < 1e-7);
            hair_test_healthy(&living);
            hair_test_die(&living);
            hair_test_strands_free(&strands);
        }
}

int main(void)
{
    if (hair_test_skips()) return 0;
    const struct CMUnitTest tests[] = {
        HAIR_TEST(guides_of_one_instance_are_independent),
        HAIR_TEST(thread_and_work_group_per_guide_agree),
        HAIR_TEST(motion_does_not_depend_on_the_step_length),
        HAIR_TEST(equal_steps_give_equal_bits),
        HAIR_TEST(free_strand_falls_and_drifts_by_the_formula),
        HAIR_TEST(free_stiff_strand_falls_and_drifts_by_the_formula),
        HAIR_TEST(free_strand_keeps_both_momenta),
        HAIR_TEST(accurate_solver_keeps_the_energy_of_a_swing),
        HAIR_TEST(strand_hanging_straight_down_stays_still),
    };
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
