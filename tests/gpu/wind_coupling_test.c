// wind_coupling_test.c - hair in a fluid that flows round colliders. Hair behind a ball is
// sheltered at any frame rate. Without the fluid, no program runs and no memory is kept.
#include "tests/support/live_hair.h"
#include "tests/support/motion.h"
#include "tests/support/passes.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "lib/api/api.h"

#define VERTICES 8
#define BEHIND 0 // Index of a guide.
#define BESIDE 1

static hair_wind blowing(float x, hair_wind_model model)
{
    hair_wind wind = hair_wind_default();
    wind.velocity[0] = x;
    wind.model = model;
    return wind;
}

// Make strands that hang behind and beside a ball, and others around it, so that the ball is in the
// field.
static void begin(struct hair_test* test, hair_solver solver, struct hair_test_living* living)
{
    static const hair_vec3 roots[] = {
        {0.18f, 0.05f, 0}, {0, 0.05f, 0.22f}, {-0.22f, 0.05f, 0}, {0, 0.05f, -0.22f}, {0, 0.22f, 0}};
    hair_physics physics = hair_test_loose(0);
    physics.drag = 0.3f;
    struct hair_test_strands strands = hair_test_strands_make(5, VERTICES);
    for (int i = 0; i < 5; ++i)
        hair_test_add_straight(&strands, VERTICES, roots[i], hair_v3(0, i < 4 ? -1 : 1, 0), 0.1f);
    hair_desc desc = hair_test_rods(solver, HAIR_THREAD_MAPPING_AUTO, 0, &physics);
    hair_test_live(test, &strands, &desc, living);
    hair_test_strands_free(&strands);
    hair_collider ball = hair_test_body(HAIR_SHAPE_SPHERE, 0, 0, 0);
    ball.size[0] = 0.1f;
    hair_test_set_colliders(living, &ball, 1);
}

static uint32_t runs(const struct hair_test_living* living)
{
    const struct hair_gl* gl = &living->test->context->gl;
    uint32_t sum = 0;
    for (hair_gl_pass pass = HAIR_GL_FLUID_FACE_FRACTIONS; pass <= HAIR_GL_FLUID_EXPORT_VELOCITY; ++pass)
        sum += hair_test_runs(gl, pass);
    return sum;
}

// Compute the mean displacement of both tips along the wind, in metres.
static void wind_coupling(struct hair_test* test, hair_wind_model model, double way[2])
{
    struct hair_test_living living;
    begin(test, HAIR_SOLVER_DIRECT, &living);
    hair_wind wind = blowing(4, model);
    wind.shelter = 0; // The wind outside the fluid ignores the ball.
    hair_test_wind_coupling(&living, &wind);
    hair_test_wait(&living, 30);
    way[0] = way[1] = 0;
    for (int i = 0; i < 10; ++i) {
        hair_test_wait(&living, 2);
        hair_test_read_guides(&living);
        way[BEHIND] += (double)(hair_test_tip(&living, BEHIND).x - 0.18f) / 10;
        way[BESIDE] += (double)hair_test_tip(&living, BESIDE).x / 10;
    }
    hair_test_healthy(&living);
    hair_test_die(&living);
}

static void ball_shelters_hair_behind_but_not_beside_it(void** state)
{
    double ambient[2], fluid[2];
    wind_coupling(*state, HAIR_WIND_AMBIENT, ambient);
    wind_coupling(*state, HAIR_WIND_FLUID, fluid);
    print_message(
        "    tips blown by %.4f m behind and %.4f m beside; without the ball in the way %.4f and %.4f\n",
        fluid[BEHIND], fluid[BESIDE], ambient[BEHIND], ambient[BESIDE]);
    assert_true(ambient[BEHIND] > 0.03);
    assert_true(fabs(fluid[BEHIND]) < 0.4 * ambient[BEHIND]);
    hair_test_near("beside", 0, fluid[BESIDE] / ambient[BESIDE], 1, 0.25);
}

static void motion_in_fluid_wind_is_equal_at_any_frame_rate(void** state)
{
    static const int rates[] = {30, 60, 120};
    float seen[3][3 * 5 * VERTICES];
    for (int k = 0; k < 3; ++k) {
        struct hair_test_living living;
        begin(*state, HAIR_SOLVER_DIRECT, &living);
        hair_wind wind = blowing(4, HAIR_WIND_FLUID);
        wind.fluid.resolution = 16;
        hair_test_wind_coupling(&living, &wind);
        for (int i = 0; i < rates[k] / 5; ++i) hair_test_advance(&living, NULL, 1.0 / rates[k]);
        hair_test_read_guides(&living);
        memcpy(seen[k], living.positions, sizeof seen[k]);
        hair_test_die(&living);
    }
    for (size_t i = 0; i < 3 * 5 * VERTICES; ++i)
        for (int k = 0; k < 2; ++k) hair_test_near("place", i, (double)seen[k][i], (double)seen[2][i], 1e-6);
}

static void fluid_wind_costs_nothing_when_off(void** state)
{
    struct hair_test_living living;
    begin(*state, HAIR_SOLVER_DIRECT, &living);
    hair_wind wind = blowing(3, HAIR_WIND_FLUID), none = blowing(0, HAIR_WIND_FLUID);
    none.fluid.resolution = wind.fluid.resolution = 16;
    hair_test_wait(&living, 1);
    size_t bytes = living.test->host.live;
    uint32_t before = runs(&living);
    hair_test_wind_coupling(&living, &none);
    hair_test_wait(&living, 2);
    assert_int_equal(runs(&living), before);
    assert_null(living.hair->sim.wind_coupling.fluid.gl);
    hair_test_wind_coupling(&living, &wind);
    hair_test_wait(&living, 2);
    assert_true(runs(&living) > before);
    GLuint air = living.hair->sim.wind_coupling.fluid.air,
           faces = living.hair->sim.wind_coupling.fluid.velocity[0].buffer;
    assert_true(glIsTexture(air) && glIsBuffer(faces));
    before = runs(&living);
    hair_test_wind_coupling(&living, NULL);
    hair_test_wait(&living, 2);
    assert_int_equal(runs(&living), before);
    assert_false(glIsTexture(air) || glIsBuffer(faces));
    hair_test_near("memory", 0, (double)living.test->host.live, (double)bytes,
                   65536); // The memory of the field, which stays.
    hair_test_die(&living);
    begin(*state, HAIR_SOLVER_REDBLACK, &living); // This solver has no wind.
    hair_test_wind_coupling(&living, &wind);
    hair_test_wait(&living, 2);
    assert_int_equal(runs(&living), before);
    hair_test_die(&living);
}

static void hair_stays_finite_in_any_wind(void** state)
{
    struct hair_test_living living;
    begin(*state, HAIR_SOLVER_DIRECT, &living);
    for (int i = 0; i < 24; ++i) {
        hair_wind wind = blowing(i % 4 == 1 ? 1000 : -5, i % 3 ? HAIR_WIND_FLUID : HAIR_WIND_AMBIENT);
        wind.velocity[1] = i % 5 == 2 ? -1000 : 0;
        wind.fluid.resolution = i % 7 ? 16 : 32;
        wind.fluid.projection = i % 6 ? HAIR_PROJECTION_MULTIGRID : HAIR_PROJECTION_JACOBI;
        wind.fluid.projection_iterations = i % 6 ? 0 : 1;
        hair_test_wind_coupling(&living, i % 2 ? &wind : NULL);
        hair_test_advance(&living, NULL, i % 3 == 0 ? 0.1 : i % 3 == 1 ? 1e-4 : 1.0 / 60);
        hair_test_read_guides(&living);
        assert_true(hair_test_stretch(&living) < 0.02);
    }
    hair_wind wind = blowing(NAN, HAIR_WIND_FLUID);
    hair_test_refused(living.test, hair_set_wind(living.hair, &wind), HAIR_ERROR_ARGUMENT, "velocity[0]");
    wind = blowing(2, HAIR_WIND_FLUID);
    wind.fluid.resolution = 16;
    hair_test_wind_coupling(&living, &wind);
    hair_test_wait(&living, 60);
    hair_test_read_guides(&living);
    hair_test_wait(&living, 5);
    hair_test_read_guides(&living);
    assert_true(hair_test_moved(&living) < 0.03);
    assert_int_equal(hair_test_solver_stats(&living).reset, 0);
    hair_test_die(&living);
}

static void saved_fluid_wind_continues_bit_for_bit(void** state)
{
    struct hair_test_living living, other;
    float straight[3 * 5 * VERTICES];
    begin(*state, HAIR_SOLVER_DIRECT, &living);
    begin(*state, HAIR_SOLVER_DIRECT, &other);
    hair_wind wind = blowing(4, HAIR_WIND_FLUID);
    wind.fluid.resolution = 16;
    hair_test_wind_coupling(&living, &wind);
    hair_test_wind_coupling(&other, &wind);
    for (int i = 0; i < 7; ++i) hair_test_advance(&living, NULL, 0.011);
    size_t size = 0;
    hair_test_ok(living.test, hair_save(living.hair, NULL, 0, &size));
    void* bytes = malloc(size);
    hair_test_ok(living.test, hair_save(living.hair, bytes, size, &size));
    hair_test_ok(living.test, hair_load(other.hair, bytes, size));
    for (int i = 0; i < 9; ++i) hair_test_advance(&living, NULL, 0.013);
    hair_test_read_guides(&living);
    memcpy(straight, living.positions, sizeof straight);
    hair_test_ok(living.test, hair_load(living.hair, bytes, size));
    for (int i = 0; i < 9; ++i) {
        hair_test_advance(&living, NULL, 0.013);
        hair_test_advance(&other, NULL, 0.013);
    }
    hair_test_read_guides(&living), hair_test_read_guides(&other);
    assert_memory_equal(living.positions, straight, sizeof straight);
    assert_memory_equal(other.positions, straight, sizeof straight);
    // With another resolution, or without wind, the fluid starts with the ambient wind.
    wind.fluid.resolution = 32;
    for (int i = 0; i < 2; ++i) {
        hair_test_wind_coupling(&other, i ? NULL : &wind);
        hair_test_ok(other.test, hair_load(other.hair, bytes, size));
        hair_test_wait(&other, 2);
        hair_test_read_guides(&other);
    }
    free(bytes);
    hair_test_die(&living), hair_test_die(&other);
}

// Move a ball by less than the field resolves. Read followers, which are pushed out of the ball,
// while the ball is farther away between steps. Both runs read, because reads count as views.
static void reading_followers_between_steps_keeps_the_motion(void** state)
{
    struct hair_test_living living, other;
    struct hair_test_living* const both[] = {&living, &other};
    float position[3];
    hair_wind wind = blowing(4, HAIR_WIND_FLUID);
    wind.fluid.resolution = 16;
    hair_collider ball = hair_test_body(HAIR_SHAPE_SPHERE, 0, 0, 0);
    ball.size[0] = 0.1f;
    for (int k = 0; k < 2; ++k) {
        begin(*state, HAIR_SOLVER_DIRECT, both[k]);
        hair_test_wind_coupling(both[k], &wind);
        hair_test_wait(both[k], 1);
        float voxel = both[k]->hair->field.box.voxel;
        for (int i = 0; i < 8; ++i) {
            uint32_t count, before = both[k]->hair->field.writes;
            hair_read_source source = k ? HAIR_READ_FOLLOWERS : HAIR_READ_GUIDES;
            ball.position[1] = 0.015f * voxel;
            hair_test_set_colliders(both[k], &ball, 1);
            hair_test_ok(*state, hair_read_positions(both[k]->hair, source, position, 1, &count));
            assert_int_equal(both[k]->hair->field.writes - before, k);
            ball.position[1] = 0.008f * voxel;
            hair_test_set_colliders(both[k], &ball, 1);
            hair_test_wait(both[k], 1);
        }
    }
    struct hair_test_blob without = hair_test_save(*state, living.hair),
                          with = hair_test_save(*state, other.hair);
    assert_int_equal(with.size, without.size);
    assert_memory_equal(with.bytes, without.bytes, with.size);
    free(with.bytes), free(without.bytes);
    hair_test_die(&living), hair_test_die(&other);
}

// Load the state of another haircut after the wind has been set. Check that the fluid is as it was.
static void check_refused_load(struct hair_test_living* living, const hair_wind* wind)
{
    struct hair_test_strands strands = hair_test_straight(VERTICES, hair_v3(0, 0, 0), hair_v3(0, 1, 0), 0.1f);
    hair_desc desc = hair_test_rods(HAIR_SOLVER_DIRECT, HAIR_THREAD_MAPPING_AUTO, 0, &living->physics);
    struct hair_test_living other;
    hair_test_live(living->test, &strands, &desc, &other);
    hair_test_strands_free(&strands);
    struct hair_test_blob wrong = hair_test_save(living->test, other.hair);
    struct hair_test_blob before = hair_test_save(living->test, living->hair);
    hair_test_wind_coupling(living, wind);
    hair_test_refused(living->test, hair_load(living->hair, wrong.bytes, wrong.size), HAIR_ERROR_ARGUMENT,
                      "its number of guides is 1, the instance's 5");
    struct hair_test_blob after = hair_test_save(living->test, living->hair);
    assert_int_equal(after.size, before.size);
    assert_memory_equal(after.bytes, before.bytes, before.size);
    free(wrong.bytes), free(before.bytes), free(after.bytes);
    hair_test_die(&other);
}

static void refused_load_keeps_the_air(void** state)
{
    struct hair_test_living living;
    begin(*state, HAIR_SOLVER_DIRECT, &living);
    hair_wind wind = blowing(4, HAIR_WIND_FLUID);
    for (int i = 0; i < 3; ++i) {
        wind.fluid.resolution = i == 1 ? 32 : 16;
        hair_test_wind_coupling(&living, &wind);
        hair_test_wait(&living, 2);
        wind.fluid.resolution = i == 1 ? 16 : 32;
        check_refused_load(&living, i == 2 ? NULL : &wind);
    }
    hair_test_die(&living);
}

int main(void)
{
    if (hair_test_skips()) return 0;
    const struct CMUnitTest tests[] = {
        HAIR_TEST(ball_shelters_hair_behind_but_not_beside_it),
        HAIR_TEST(motion_in_fluid_wind_is_equal_at_any_frame_rate),
        HAIR_TEST(fluid_wind_costs_nothing_when_off),
        HAIR_TEST(hair_stays_finite_in_any_wind),
        HAIR_TEST(saved_fluid_wind_continues_bit_for_bit),
        HAIR_TEST(reading_followers_between_steps_keeps_the_motion),
        HAIR_TEST(refused_load_keeps_the_air),
    };
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
