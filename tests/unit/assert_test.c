// assert_test.c - a failed assertion stops a debug build and names itself. A release does not
// evaluate it.
#include "tests/support/support.h"

#include <signal.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "lib/base/assert.h"

static int evaluations;

static int is_evaluated(int result)
{
    ++evaluations;
    return result;
}

static void a_true_condition_does_nothing(void** state)
{
    (void)state;
    evaluations = 0;
    HAIR_ASSERT(is_evaluated(1));
#ifdef NDEBUG
    assert_int_equal(evaluations, 0);
#else
    assert_int_equal(evaluations, 1);
#endif
}

static void a_false_condition_stops_a_debug_build(void** state)
{
    (void)state;
    int ends[2], status = 0;
    char said[512] = "";
    assert_int_equal(pipe(ends), 0);
    pid_t child = fork();
    assert_true(child >= 0);
    if (child == 0) {
        dup2(ends[1], STDERR_FILENO);
        signal(SIGABRT, SIG_DFL);
        HAIR_ASSERT(is_evaluated(0));
        _exit(0);
    }
    close(ends[1]);
    for (ssize_t at = 0, size; (size = read(ends[0], said + at, sizeof said - 1 - (size_t)at)) > 0;)
        at += size;
    close(ends[0]);
    assert_int_equal(waitpid(child, &status, 0), child);
#ifdef NDEBUG
    assert_true(WIFEXITED(status) && WEXITSTATUS(status) == 0);
    assert_string_equal(said, "");
#else
    assert_true(WIFSIGNALED(status));
    assert_non_null(strstr(said, "assert_test.c:"));
    assert_non_null(strstr(said, "is_evaluated(0)"));
#endif
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_true_condition_does_nothing),
        cmocka_unit_test(a_false_condition_stops_a_debug_build),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
