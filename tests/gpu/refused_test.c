// refused_test.c - memory and OpenGL objects that are refused, one after the other. Each gives an
// error and a message, leaks nothing, and a retry works.
#include "tests/support/support.h"

#include <string.h>

#include "lib/api/api.h"
#include "tests/support/handmade.h"
#include "tests/support/refusal.h"
#include "tests/support/ways.h"

// Calls -------------------------------------------------------------------------------------------

struct user {
    struct hair_test* test;
    hair_context* context;
    hair_groom* groom;
    hair_instance* hair;
    hair_desc desc;
    float damping;
};

static hair_result make_context(struct user* user, hair_context** out)
{
    hair_context_desc desc = hair_context_desc_default();
    desc.host = &user->test->host.host;
    desc.get_proc = hair_test_refusing_proc;
    desc.glsl_dir = "glsl";
    return hair_context_create(&desc, out);
}

static hair_result create_context(struct user* user)
{
    hair_context* context = NULL;
    hair_instance* hair = NULL;
    hair_result result = make_context(user, &context);
    assert_true((result == HAIR_OK) == (context != NULL));
    if (!result) // Compiles the programs that it is the first to need.
        result = hair_create(context, user->groom, &user->desc, &hair);
    assert_true((result == HAIR_OK) == (hair != NULL));
    hair_destroy(hair);
    hair_context_destroy(context);
    return result;
}

static hair_result create_instance(struct user* user)
{
    hair_instance* hair = NULL;
    hair_result result = hair_create(user->context, user->groom, &user->desc, &hair);
    assert_true((result == HAIR_OK) == (hair != NULL));
    hair_destroy(hair);
    return result;
}

// Step with changed physics, for which the rods are made again.
static hair_result step_with_other_physics(struct user* user)
{
    hair_physics physics = hair_physics_default();
    physics.damping = user->damping = user->damping < 9 ? user->damping + 0.5f : 1;
    hair_test_ok(user->test, hair_set_physics(user->hair, &physics));
    hair_instance as_it_was = *user->hair;
    hair_result result = hair_step(user->hair, 1.0f / 60);
    if (result) assert_memory_equal(user->hair, &as_it_was, sizeof as_it_was);
    return result;
}

static hair_result read_all(struct user* user)
{
    hair_result result = HAIR_OK;
    for (int what = 0; what < 3 && !result; ++what) {
        float positions[30];
        uint32_t count;
        result = hair_read_positions(user->hair, (hair_read_source)what, positions, 10, &count);
    }
    return result;
}

static hair_result save_and_load(struct user* user)
{
    static unsigned char bytes[65536];
    size_t size = 0;
    hair_result result = hair_save(user->hair, bytes, sizeof bytes, &size);
    return result ? result : hair_load(user->hair, bytes, size);
}

// Refusals ----------------------------------------------------------------------------------------

struct refusal {
    uint32_t* done; // Number of allocations or creations so far.
    uint32_t* refuse; // Number of the one to refuse, from 1.
    const char* what;
    uint32_t min; // Minimum number. With fewer, the test would test nothing.
};

// Refuse the first allocation or creation, then the second, and so on until there are no more. Each
// time the call must fail, leak nothing, and work when repeated. After the first 32, only every
// `stride`-th is refused, because shaders are many and read alike.
static void torture(struct user* user, hair_result (*call)(struct user*), struct refusal of, uint32_t stride)
{
    struct hair_test* test = user->test;
    uint32_t objects = hair_test_count_objects(), blocks = hair_test_blocks(test);
    for (uint32_t n = 1; n < 2000; n += n < 32 ? 1 : stride) {
        *of.done = 0;
        *of.refuse = n;
        hair_result result = call(user);
        *of.refuse = 0;
        assert_int_equal(hair_test_blocks(test), blocks);
        assert_int_equal(hair_test_count_objects(), objects);
        if (*of.done < n) {
            hair_test_ok(test, result);
            print_message("    %u %s\n", *of.done, of.what);
            assert_true(*of.done >= of.min);
            return;
        }
        // Without memory for a copy, a save reads the buffer itself.
        if (!result && call == save_and_load && of.done == &hair_test_refusal.creations) continue;
        if (result != HAIR_ERROR_MEMORY &&
            (result != HAIR_ERROR_OPENGL || of.done != &hair_test_refusal.creations))
            fail_msg("%u of %s: %s", n, of.what, hair_result_string(result));
        assert_true(hair_test_forgive(test) >= 1);
        if (of.done != &hair_test_refusal.creations)
            assert_non_null(strstr(test->host.sentence, "out of memory for "));
        if (n % 32 == 1) hair_test_ok(test, call(user));
        assert_int_equal(hair_test_blocks(test), blocks);
    }
    fail_msg("there is no end of %s", of.what);
}

static struct refusal of_memory(struct user* user, uint32_t min)
{
    struct hair_test_host* host = &user->test->host;
    return (struct refusal){&host->allocations, &host->refuse, "allocations", min};
}

static struct refusal of_objects(uint32_t min)
{
    return (struct refusal){&hair_test_refusal.creations, &hair_test_refusal.refuse, "objects of OpenGL",
                            min};
}

static struct user start(void** state, int way)
{
    struct user user = {.test = *state, .desc = hair_test_way(way)};
    user.groom = hair_test_groom(&user.test->host.host, hair_test_handmade_default());
    print_message("    %s\n", hair_test_way_name(way));
    return user;
}

static void refused_memory_leaks_nothing_and_a_retry_works(void** state)
{
    for (int way = 0; way < HAIR_TEST_WAYS; ++way) {
        struct user user = start(state, way);
        uint32_t rods = user.desc.solver != HAIR_SOLVER_REDBLACK;
        hair_test_ok(user.test, make_context(&user, &user.context));
        hair_test_ok(user.test, hair_create(user.context, user.groom, &user.desc, &user.hair));
        hair_test_ok(user.test, read_all(&user)); // Has compiled all programs afterwards.
        torture(&user, create_instance, of_memory(&user, 1 + 3 * rods), 1);
        torture(&user, create_instance, of_objects(20 + 8 * rods), 1);
        torture(&user, step_with_other_physics, of_memory(&user, rods), 1);
        torture(&user, step_with_other_physics, of_objects(2 * rods), 1);
        torture(&user, read_all, of_memory(&user, 2), 1);
        torture(&user, save_and_load, of_memory(&user, 1), 1);
        torture(&user, save_and_load, of_objects(2), 1);
        hair_destroy(user.hair);
        hair_context_destroy(user.context);
        hair_groom_destroy(user.groom);
    }
}

static void refused_context_leaks_nothing_and_a_retry_works(void** state)
{
    for (int way = 0; way < HAIR_TEST_WAYS; way += 6) {
        struct user user = start(state, way);
        torture(&user, create_context, of_memory(&user, 50), 19);
        torture(&user, create_context, of_objects(30), 7);
        hair_groom_destroy(user.groom);
    }
}

int main(void)
{
    if (hair_test_skips()) return 0;
    const struct CMUnitTest tests[] = {
        HAIR_TEST(refused_memory_leaks_nothing_and_a_retry_works),
        HAIR_TEST(refused_context_leaks_nothing_and_a_retry_works),
    };
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
