// contained_test.c - a guide that is not finite: only this guide returns to its rest pose, and is
// counted.
#include "tests/support/motion.h"

#include <math.h>
#include <string.h>

#define MAX 256 // Maximum number of guide vertices.

// A number in the state to overwrite with an invalid value.
struct wound {
    const char* name;
    GLuint (*buffer)(const struct hair_sim* sim);
    uint32_t stride, at; // Bytes.
    uint32_t vertex; // Index within the guide.
    int rests; // 1 if the value is part of a position, which only the rest pose can repair.
};

static GLuint state_of(const struct hair_sim* sim)
{
    return sim->state;
}
static GLuint history_of(const struct hair_sim* sim)
{
    return sim->solver == HAIR_SOLVER_ACCURATE || sim->solver == HAIR_SOLVER_FOLLOW
               ? 0
               : sim->history; // These solvers have no history.
}
static GLuint material_of(const struct hair_sim* sim)
{
    return sim->material;
}

static const struct wound wounds[] = {
    {"the place of a vertex", state_of, sizeof(struct hair_state), 8, 9, 1},
    {"the place of the root", state_of, sizeof(struct hair_state), 0, 0, 0},
    {"a displacement", state_of, sizeof(struct hair_state), offsetof(struct hair_state, displacement) + 4, 15,
     0},
    {"how much is known", state_of, sizeof(struct hair_state), 12, 0, 0},
    {"a rate", history_of, sizeof(struct hair_history), 0, 3, 0},
    {"the rate before", history_of, sizeof(struct hair_history),
     offsetof(struct hair_history, rate_before) + 8, 3, 0},
    {"a frame", material_of, sizeof(hair_vec4), 12, 7, 0},
};
#define WOUNDS (sizeof wounds / sizeof *wounds)
#define HURT 3 // Index of the guide.

static hair_instance* make(struct hair_test* test, const hair_groom* groom, int way, uint32_t colliders)
{
    hair_instance* hair = NULL;
    hair_desc desc = hair_test_way(way);
    hair_collider collider = {HAIR_SHAPE_SPHERE, {0.02f, 0, 0}, {0, 0, 0, 1},
                              {0.1f, 0},         .scale = 1,    .friction = 1};
    hair_test_ok(test, hair_create(test->context, groom, &desc, &hair));
    hair_test_ok(test, hair_set_colliders(hair, &collider, colliders, sizeof collider));
    return hair;
}

static void step(struct hair_test* test, hair_instance* hair, int number)
{
    float transform[16];
    hair_test_pose(0.1f * (float)number, transform);
    hair_test_ok(test, hair_set_transform(hair, transform));
    hair_test_ok(test, hair_step(hair, 1.0f / 60));
}

static void read(hair_instance* hair, struct hair_state state[MAX])
{
    glGetNamedBufferSubData(hair->sim.state, 0, (GLsizeiptr)(hair->sim.guide_vertices * sizeof *state),
                            state);
}

static hair_solver_stats solver_stats_of(struct hair_test* test, hair_instance* hair)
{
    hair_solver_stats solver_stats = hair_solver_stats_default();
    hair_test_ok(test, hair_get_solver_stats(hair, &solver_stats));
    return solver_stats;
}

static void check_finite(GLuint buffer, const struct wound* wound)
{
    static float number[8 * MAX];
    GLint64 size = 0;
    if (!buffer) return;
    glGetNamedBufferParameteri64v(buffer, GL_BUFFER_SIZE, &size);
    assert_in_range(size, 0, sizeof number);
    glGetNamedBufferSubData(buffer, 0, (GLsizeiptr)size, number);
    for (GLint64 i = 0; i < size / 4; ++i)
        if (!isfinite(number[i])) fail_msg("%s: number %d is %g", wound->name, (int)i, (double)number[i]);
}

// Write `value` into the guide. Check that the others move as in an instance that was left alone,
// and that the guide is finite after a step.
static void hurt_one(struct hair_test* test, const hair_groom* groom, int way, uint32_t colliders,
                     const struct wound* wound, float value)
{
    static struct hair_state sound[MAX], hurt[MAX];
    const struct hair_guide* guide = &groom->guides[HURT];
    hair_instance* hair[2];
    for (int i = 0; i < 2; ++i) {
        hair[i] = make(test, groom, way, colliders);
        for (int k = 0; k < 2; ++k) step(test, hair[i], k);
    }
    GLuint buffer = wound->buffer(&hair[1]->sim);
    // One driver loses data that is written to a buffer while a dispatch writes the buffer.
    glFinish();
    if (buffer)
        glNamedBufferSubData(buffer, (GLintptr)(guide->first + wound->vertex) * wound->stride + wound->at,
                             sizeof value, &value);
    for (int k = 2; k < 5; ++k) {
        for (int i = 0; i < 2; ++i) {
            step(test, hair[i], k);
            read(hair[i], i ? hurt : sound);
        }
        check_finite(history_of(&hair[1]->sim), wound);
        check_finite(hair[1]->sim.material, wound);
        for (uint32_t v = 0; v < hair[1]->sim.guide_vertices; ++v) {
            const float* number = &hurt[v].position.x;
            for (int n = 0; n < 8; ++n)
                if (!isfinite(number[n])) fail_msg("%s: vertex %u is %g", wound->name, v, (double)number[n]);
            if (v < guide->first || v >= guide->first + guide->count)
                assert_memory_equal(&hurt[v], &sound[v], sizeof *hurt);
        }
    }
    hair_solver_stats before = solver_stats_of(test, hair[0]), after = solver_stats_of(test, hair[1]);
    uint32_t resets = after.reset - before.reset;
    if (wound->rests && resets != 1) fail_msg("%s: %u resets", wound->name, resets);
    if (resets > 1 || after.follow_fallbacks > before.follow_fallbacks + 2)
        fail_msg("%s of %g: reset %u times, redone %u times", wound->name, (double)value, resets,
                 after.follow_fallbacks - before.follow_fallbacks);
    for (int i = 0; i < 2; ++i) hair_destroy(hair[i]);
}

static void only_nonfinite_strands_are_reset_and_counted(void** state)
{
    static const float bad[] = {NAN, NAN, INFINITY, -3e38f};
    struct hair_test* test = *state;
    struct hair_test_handmade wanted = hair_test_handmade_default();
    hair_groom* groom = hair_test_groom(&test->host.host, wanted);
    for (int way = 0; way < HAIR_TEST_WAYS; ++way) {
        print_message("    %s\n", hair_test_way_name(way));
        for (uint32_t colliders = 0; colliders < 2; ++colliders)
            for (size_t w = 0; w < WOUNDS; ++w)
                for (size_t n = w % 2; n < sizeof bad / sizeof *bad; n += 2)
                    hurt_one(test, groom, way, colliders, &wounds[w], bad[n]);
    }
    hair_groom_destroy(groom);
}

int main(void)
{
    if (hair_test_skips()) return 0;
    const struct CMUnitTest tests[] = {
        HAIR_TEST(only_nonfinite_strands_are_reset_and_counted),
    };
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
