// determinism_test.c - ten heads of hair give equal bits in every run on one driver: whatever the
// number of threads of llvmpipe, the process, heads beside them, and saving on the way.
//
// Hashes after EARLY and after LATE steps belong to the renderer that made them:
// tests/golden/llvmpipe/determinism.txt. Other renderers check the equalities only. HAIR_BLESS=1
// writes the file again. HAIR_TEST_FULL=1 takes LATE steps, and more numbers of threads.
#define _POSIX_C_SOURCE 200809L
#include "tests/support/support.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tests/support/heads.h"

#define GOLDEN "tests/golden/llvmpipe/determinism.txt"
#define EARLY 40 // Number of steps without HAIR_TEST_FULL.
#define LATE 1000
#define MAX_RENDERERS 16

static struct hair_test_head_kind kinds[HAIR_TEST_HEADS];
// Hashes of each head alone after `steps` steps, and after EARLY of them.
static uint64_t alone[HAIR_TEST_HEADS], alone_early[HAIR_TEST_HEADS];
static uint32_t steps = EARLY;

static uint64_t hash_of(struct hair_test* test, const struct hair_test_head* head)
{
    uint64_t hash = 0;
    hair_test_ok(test, hair_test_head_hash(head, &hash));
    return hash;
}

static void check(const char* what, uint32_t number, uint64_t hash, uint64_t expected)
{
    if (hash != expected)
        fail_msg("%s, %s: %016" PRIx64 ", not %016" PRIx64, kinds[number].name, what, hash, expected);
}

static int start(void** state)
{
    if (hair_test_start(state)) return -1;
    struct hair_test* test = *state;
    return hair_test_head_kinds_make(&test->host.host, kinds) ? -1 : 0;
}

static int finish(void** state)
{
    hair_test_head_kinds_free(kinds);
    return hair_test_finish(state);
}

// Find the hash of each head after a number of steps. Reading hair changes later bits, so that
// other numbers take a run of their own.
static void run_heads_alone(struct hair_test* test, uint32_t count, uint64_t hashes[HAIR_TEST_HEADS])
{
    for (uint32_t i = 0; i < HAIR_TEST_HEADS; ++i) {
        struct hair_test_head head;
        hair_test_ok(test, hair_test_head_create(test->context, kinds, i, &head));
        hair_test_ok(test, hair_test_head_steps(&head, count));
        hashes[i] = hash_of(test, &head);
        hair_destroy(head.hair);
    }
}

// Write the hashes, and keep those of other renderers.
static void bless(const char* renderer)
{
    char kept[MAX_RENDERERS * HAIR_TEST_HEADS][256];
    uint32_t count = 0;
    FILE* file = fopen(GOLDEN, "r");
    while (file && count < MAX_RENDERERS * HAIR_TEST_HEADS && fgets(kept[count], sizeof *kept, file))
        count += strncmp(kept[count], renderer, strlen(renderer)) != 0;
    if (file) fclose(file);
    file = fopen(GOLDEN, "w");
    assert_non_null(file);
    for (uint32_t i = 0; i < count; ++i) fputs(kept[i], file);
    for (uint32_t i = 0; i < HAIR_TEST_HEADS; ++i)
        fprintf(file, "%s: %s: %016" PRIx64 " %016" PRIx64 "\n", renderer, kinds[i].name, alone_early[i],
                alone[i]);
    assert_int_equal(fclose(file), 0);
}

static void runs_give_the_committed_hashes(void** state)
{
    char renderer[160], line[256];
    run_heads_alone(*state, EARLY, alone_early);
    memcpy(alone, alone_early, sizeof alone);
    if (steps > EARLY) run_heads_alone(*state, steps, alone);
    snprintf(renderer, sizeof renderer, "%s, OpenGL %s", (const char*)glGetString(GL_RENDERER),
             (const char*)glGetString(GL_VERSION));
    if (getenv("HAIR_BLESS")) bless(renderer);
    FILE* file = fopen(GOLDEN, "r");
    uint32_t found = 0;
    assert_non_null(file);
    while (fgets(line, sizeof line, file))
        for (uint32_t i = 0; i < HAIR_TEST_HEADS; ++i) {
            char start_of_line[224];
            int size = snprintf(start_of_line, sizeof start_of_line, "%s: %s: ", renderer, kinds[i].name);
            if (strncmp(line, start_of_line, (size_t)size) != 0) continue;
            uint64_t early = 0, late = 0;
            assert_int_equal(sscanf(line + size, "%" SCNx64 " %" SCNx64, &early, &late), 2);
            check("of the committed early hash", i, alone_early[i], early);
            if (steps == LATE) check("of the committed late hash", i, alone[i], late);
            ++found;
        }
    fclose(file);
    if (!found) print_message("no hashes of %s, none compared\n", renderer);
    assert_true(found == 0 || found == HAIR_TEST_HEADS);
}

static void heads_in_turn_give_the_bits_of_each_alone(void** state)
{
    struct hair_test* test = *state;
    struct hair_test_head heads[HAIR_TEST_HEADS];
    for (uint32_t i = 0; i < HAIR_TEST_HEADS; ++i)
        hair_test_ok(test, hair_test_head_create(test->context, kinds, i, &heads[i]));
    for (uint32_t step = 0; step < steps; ++step)
        for (uint32_t i = 0; i < HAIR_TEST_HEADS; ++i) hair_test_ok(test, hair_test_head_step(&heads[i]));
    for (uint32_t i = 0; i < HAIR_TEST_HEADS; ++i) {
        check("in turn with others", i, hash_of(test, &heads[i]), alone[i]);
        hair_destroy(heads[i].hair);
    }
}

static void saved_and_loaded_heads_give_the_bits_of_a_run(void** state)
{
    struct hair_test* test = *state;
    for (uint32_t i = 0; i < HAIR_TEST_HEADS; ++i) {
        struct hair_test_head head;
        hair_test_ok(test, hair_test_head_create(test->context, kinds, i, &head));
        hair_test_ok(test, hair_test_head_steps(&head, steps / 2));
        hair_test_ok(test, hair_test_head_renew(&head, test->context, kinds));
        hair_test_ok(test, hair_test_head_steps(&head, steps - steps / 2));
        check("saved and loaded", i, hash_of(test, &head), alone[i]);
        hair_destroy(head.hair);
    }
}

static const char* program;

// Compare the hashes that a process with that number of threads prints.
static void check_process(const char* threads)
{
    int ends[2];
    assert_int_equal(pipe(ends), 0);
    pid_t child = fork();
    assert_true(child >= 0);
    if (child == 0) {
        dup2(ends[1], STDOUT_FILENO);
        close(ends[0]);
        if (threads) setenv("LP_NUM_THREADS", threads, 1);
        execl(program, program, "hashes", (char*)NULL);
        _exit(127);
    }
    close(ends[1]);
    FILE* in = fdopen(ends[0], "r");
    assert_non_null(in);
    char line[64], what[64];
    snprintf(what, sizeof what, "in a process with %s threads", threads ? threads : "all");
    for (uint32_t i = 0; i < HAIR_TEST_HEADS; ++i) {
        if (!fgets(line, sizeof line, in)) fail_msg("no hash of %s, %s", kinds[i].name, what);
        check(what, i, strtoull(line, NULL, 16), alone[i]);
    }
    fclose(in);
    int status;
    assert_int_equal(waitpid(child, &status, 0), child);
    assert_int_equal(status, 0);
}

static void other_processes_and_threads_give_equal_bits(void** state)
{
    (void)state;
    check_process(NULL);
    for (int threads = 1; threads <= 8; threads *= getenv("HAIR_TEST_FULL") ? 2 : 8) {
        char number[12];
        snprintf(number, sizeof number, "%d", threads);
        check_process(number);
    }
}

static void print_hashes(void** state)
{
    run_heads_alone(*state, steps, alone);
    for (uint32_t i = 0; i < HAIR_TEST_HEADS; ++i) printf("%016" PRIx64 "\n", alone[i]);
}

// Print the hashes for check_process().
static int run_as_child(void)
{
    void* state = NULL;
    if (start(&state)) return 1;
    print_hashes(&state);
    return finish(&state) ? 1 : 0;
}

int main(int count, char** arguments)
{
    program = arguments[0];
    if (getenv("HAIR_TEST_FULL") || getenv("HAIR_BLESS")) steps = LATE;
    if (count > 1) return run_as_child();
    if (hair_test_skips()) return 0;
    const struct CMUnitTest tests[] = {
        HAIR_TEST(runs_give_the_committed_hashes),
        HAIR_TEST(heads_in_turn_give_the_bits_of_each_alone),
        HAIR_TEST(saved_and_loaded_heads_give_the_bits_of_a_run),
        HAIR_TEST(other_processes_and_threads_give_equal_bits),
    };
    return cmocka_run_group_tests(tests, start, finish);
}
