// bench_cases_test.c - cases of hair-bench for curved, taut and resting hair.
#define _XOPEN_SOURCE 700
#include "tests/support/shell.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

#define TOOL HAIR_BUILD_DIR "/hair-bench"
#define expect hair_test_shell_expect
#define number hair_test_json_number

static int make_folder(void** state)
{
    (void)state;
    return hair_test_shell_start(TOOL);
}

// Check a wave that is curved at rest. The solver of higher cost is nearer to the reference, and
// one row has its own setting.
static void accuracy_compares_curved_hair_with_the_reference(void** state)
{
    (void)state;
    expect(0, "$T accuracy --quick --case wave --strands 4 --json $D/w.json --csv /dev/null", "");
    json_t* root = hair_test_shell_json("w.json");
    json_t* rows = json_object_get(root, "rows");
    json_t* row;
    size_t i, defaults = 0;
    json_array_foreach(rows, i, row)
    {
        const char* method = json_string_value(json_object_get(row, "method"));
        if (json_is_true(json_object_get(row, "default"))) ++defaults;
        if (strcmp(method, "direct") && strcmp(method, "accurate")) continue;
        double rms = number(row, "rms_error"), max = number(row, "max_error");
        assert_true(rms > 1e-6 && rms < 0.02 && max > rms && max < 0.1);
    }
    assert_int_equal(defaults, 1);
    json_decref(root);
    expect(0, "rm $D/w.json", "");
}

static void rest_cases_distinguish_resting_from_moving_hair(void** state)
{
    (void)state;
    // The solver accurate solves a coil of 6 mm. An idle haircut sleeps, and then its fastest
    // vertex is still.
    expect(0, "$T stability --quick --case 'rest *' --method accurate --json $D/s.json --csv /dev/null", "");
    json_t* root = hair_test_shell_json("s.json");
    json_t* rows = json_object_get(root, "rows");
    json_t* row;
    size_t i;
    json_array_foreach(rows, i, row)
    {
        if (!json_is_true(json_object_get(row, "pass")))
            fail_msg("%s", json_string_value(json_object_get(row, "case")));
        if (json_is_null(json_object_get(row, "radius"))) {
            assert_true(number(row, "max_speed") == 0);
            assert_true(number(row, "seconds_to_sleep") > 0.2 && number(row, "seconds_to_sleep") < 15);
        } else
            assert_true(number(row, "max_energy") > 0.5 && number(row, "max_energy") < 1.01);
    }
    assert_int_equal(i, 4);
    json_decref(root);
    expect(0, "rm $D/s.json", "");
}

// Check rows that the solvers pass. A wrong measure would be far off for them.
static void physics_cases_are_within_their_limits(void** state)
{
    (void)state;
    static const char* const names[] = {"fine_segments", "helix_spin", "head_spin", "cantilever_arc",
                                        "still_air"};
    for (size_t i = 0; i < sizeof names / sizeof *names; ++i) {
        char command[256];
        snprintf(command, sizeof command,
                 "$T physics --quick --case %s --method accurate --json $D/p.json --csv /dev/null", names[i]);
        expect(0, command, "");
        json_t* root = hair_test_shell_json("p.json");
        const json_t* row = json_array_get(json_object_get(root, "rows"), 0);
        if (!json_is_true(json_object_get(row, "pass"))) fail_msg("%s", names[i]);
        assert_true(number(row, "relative_error") > 0);
        json_decref(root);
    }
    expect(0, "rm $D/p.json", "");
}

// Check that more guides leave a smaller error, and that every strand simulated leaves that of the
// solver, which is that of hair at rest at the start.
static void followers_are_nearer_to_the_truth_with_more_guides(void** state)
{
    (void)state;
    expect(0, "$T followers --quick --strands 100 --case 'shake straight' --json $D/f.json --csv /dev/null",
           "");
    json_t* root = hair_test_shell_json("f.json");
    json_t* rows = json_object_get(root, "rows");
    json_t* row;
    size_t i;
    double last = 1, motion = 0;
    json_array_foreach(rows, i, row)
    {
        bool is_every = !strcmp(json_string_value(json_object_get(row, "method")), "direct");
        double rms = number(row, "rms_error"), rest = number(row, "rest_error");
        motion = number(row, "motion");
        assert_true(motion > 0.01 && motion < 0.2);
        assert_true(number(row, "length") > 0.1 && number(row, "length") < 0.3);
        assert_true(number(row, "max_error") > rms && rms <= last);
        assert_true(is_every ? rest == 0 && rms < 0.1 * motion : rms > 0.1 * motion);
        last = rms;
    }
    assert_int_equal(i, 5);
    json_decref(root);
    expect(0, "rm $D/f.json", "");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(accuracy_compares_curved_hair_with_the_reference),
        cmocka_unit_test(followers_are_nearer_to_the_truth_with_more_guides),
        cmocka_unit_test(physics_cases_are_within_their_limits),
        cmocka_unit_test(rest_cases_distinguish_resting_from_moving_hair),
    };
    return cmocka_run_group_tests(tests, make_folder, hair_test_shell_finish);
}
