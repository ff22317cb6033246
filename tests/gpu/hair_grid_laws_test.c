// hair_grid_laws_test.c - free strands among each other: cohesion and volume keep momentum and
// angular momentum, and add no energy.
#include "tests/support/hair_grid.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define STRANDS 16
#define VERTICES 16
#define LENGTH 0.2f

enum scene { SPINNING, CROSSING, MEETING, SCENES };

static const char* const scene_name[] = {"spinning", "crossing", "meeting"};

// Make a bundle, strands through a ball in all directions, or strands in a ring.
static struct hair_test_strands strands_of(enum scene scene, uint32_t* random)
{
    struct hair_test_strands strands = hair_test_strands_make(STRANDS, VERTICES);
    for (uint32_t i = 0; i < STRANDS; ++i) {
        float x = (float)(i % 4) - 1.5f, z = (float)(i / 4) - 1.5f;
        float spacing = scene == MEETING ? 0.02f : 0.008f;
        hair_vec3 root = hair_v3(spacing * x, 0, spacing * z), way = hair_v3(0, -1, 0);
        if (scene == CROSSING) {
            way = hair_v3(hair_random(random) - 0.5f, hair_random(random) - 0.5f, hair_random(random) - 0.5f);
            way = hair_normalize(way, hair_v3(0, 1, 0));
            root = hair_add(root, hair_scale(way, -0.5f * LENGTH));
        }
        hair_test_add_straight(&strands, VERTICES, root, way, LENGTH);
    }
    return strands;
}

// Give each strand a rigid motion: the common motion plus a motion of its own.
static void set_in_motion(struct hair_test_living* living, enum scene scene, uint32_t* random)
{
    struct hair_sim* sim = &living->hair->sim;
    struct hair_state* at = hair_test_buffer(sim->state, living->vertices * sizeof *at);
    hair_vec3 turn = scene == MEETING ? hair_v3(0, 2, 0) : hair_v3(0.5f, 3, 0.3f), own[2] = {{0}};
    for (uint32_t i = 0; i < living->vertices; ++i) {
        hair_vec3 x = hair_v3(at[i].position.x, at[i].position.y, at[i].position.z), v = hair_cross(turn, x);
        hair_vec3 root = hair_v3(at[i - i % VERTICES].position.x, 0, at[i - i % VERTICES].position.z);
        if (i % VERTICES == 0)
            for (int k = 0; k < 2; ++k)
                own[k] = hair_v3(hair_random(random) - 0.5f, hair_random(random) - 0.5f,
                                 hair_random(random) - 0.5f);
        v = hair_add(v, hair_v3(0.3f, 0.1f, 0));
        v = hair_add(v, hair_add(hair_scale(own[0], 0.3f), hair_cross(hair_scale(own[1], 2), x)));
        if (scene == MEETING) v = hair_sub(v, hair_scale(root, 4));
        v = hair_scale(v, (float)sim->substep);
        at[i].displacement = (hair_vec4){v.x, v.y, v.z, 0};
        at[i].position.w = 1;
    }
    hair_test_set_state(living, at);
    free(at);
}

struct motion {
    // Momentum, angular momentum about the centre, and kinetic energy. Each is for a mass of 1 kg
    // for every metre of hair.
    double momentum[3], angular[3], energy;
};

// Measure the motion in the middle of the last substep.
static struct motion motion_of(const struct hair_test_living* living)
{
    const struct hair_sim* sim = &living->hair->sim;
    struct hair_state* at = hair_test_buffer(sim->state, living->vertices * sizeof *at);
    struct motion m = {0};
    double total = 0, centre[3] = {0};
    // The first pass finds the centre. The second pass measures about the centre.
    for (uint32_t k = 0; k < 2 * living->vertices; ++k) {
        uint32_t i = k % living->vertices, again = k / living->vertices;
        double after = (double)living->groom->rest[i].position.w;
        double mass = (after + (i > 0 ? (double)living->groom->rest[i - 1].position.w : 0)) / 2;
        const float *p = &at[i].position.x, *d = &at[i].displacement.x;
        double x[3], v[3];
        for (int a = 0; a < 3; ++a) {
            v[a] = (double)d[a] / sim->substep;
            x[a] = (double)p[a] - (double)d[a] / 2 - (again ? centre[a] / total : 0);
            if (again) m.momentum[a] += mass * v[a], m.energy += mass * v[a] * v[a] / 2;
            if (!again) centre[a] += mass * x[a];
        }
        if (!again) total += mass;
        for (int a = 0; a < 3 && again; ++a)
            m.angular[a] += mass * (x[(a + 1) % 3] * v[(a + 2) % 3] - x[(a + 2) % 3] * v[(a + 1) % 3]);
    }
    free(at);
    return m;
}

static double change(const double a[3], const double b[3])
{
    double sum = 0, size = 0;
    for (int k = 0; k < 3; ++k) sum += (a[k] - b[k]) * (a[k] - b[k]), size += a[k] * a[k];
    return sqrt(sum / size);
}

struct change {
    // Changes of momentum and angular momentum, relative to the initial values, and the fraction of
    // kinetic energy that remains.
    double momentum, angular, energy;
};

// Simulate for a second.
static struct change run(struct hair_test* test, hair_solver solver, enum scene scene, float cohesion,
                         float volume)
{
    struct hair_test_living living;
    hair_physics physics = hair_test_only_hair_grid(cohesion, volume);
    uint32_t random = 7;
    physics.root = HAIR_ROOT_FREE;
    physics.fiber.youngs_modulus = hair_test_bare().fiber.youngs_modulus;
    hair_desc desc = hair_test_rods(solver, HAIR_THREAD_MAPPING_AUTO, 0, &physics);
    struct hair_test_strands strands = strands_of(scene, &random);
    hair_test_live(test, &strands, &desc, &living);
    hair_test_strands_free(&strands);
    hair_test_wait(&living, 1);
    set_in_motion(&living, scene, &random);
    hair_test_advance(&living, NULL, 1.0 / 120);
    struct motion first = motion_of(&living);
    for (int i = 0; i < 120; ++i) hair_test_advance(&living, NULL, 1.0 / 120);
    struct motion now = motion_of(&living);
    hair_test_healthy(&living);
    hair_test_die(&living);
    struct change c = {change(first.momentum, now.momentum), change(first.angular, now.angular),
                       now.energy / first.energy};
    print_message("    %s, solver %d, cohesion %g, volume %g: momentum changes by %.1e, angular momentum by "
                  "%.1e; %.3f of the energy\n",
                  scene_name[scene], solver, (double)cohesion, (double)volume, c.momentum, c.angular,
                  c.energy);
    return c;
}

static void hair_grid_conserves_both_momenta(void** state)
{
    static const float how[][2] = {{5, 0}, {20, 0}, {0, 0.1f}, {0, 1}, {10, 0.3f}};
    for (int solver = 0; solver < HAIR_SOLVER_FOLLOW; ++solver)
        for (int scene = 0; scene < SCENES; ++scene)
            for (size_t k = 0; k < sizeof how / sizeof *how; ++k) {
                struct change c = run(*state, (hair_solver)solver, (enum scene)scene, how[k][0], how[k][1]);
                assert_true(c.momentum < 1e-4);
                assert_true(c.angular < 1e-2);
                assert_true(c.energy < (how[k][0] > 0 ? 0.97 : 1.15));
            }
}

int main(void)
{
    if (hair_test_skips()) return 0;
    const struct CMUnitTest tests[] = {
        HAIR_TEST(hair_grid_conserves_both_momenta),
    };
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
