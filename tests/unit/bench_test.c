// bench_test.c - the command line of hair-bench, and its arithmetic: the Pareto front, and the
// frequency of a swing.
#define _XOPEN_SOURCE 700
#include "tests/support/shell.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

// Tools are not linked into tests.
#include "tools/bench/frequency.c"
#include "tools/bench/rows.c"

#define TOOL HAIR_BUILD_DIR "/hair-bench"
#define SMALL "accuracy --quick --method redblack --case shake --strands 4"

#define expect hair_test_shell_expect

static int make_folder(void** state)
{
    (void)state;
    return hair_test_shell_start(TOOL);
}

// The command line --------------------------------------------------------------------------------

static void wrong_use_exits_with_2(void** state)
{
    (void)state;
    static const char* const wrong[][2] = {
        {"", "no suite"},
        {"dance", "no suite dance"},
        {"accuracy physics", "physics is one argument too many"},
        {"accuracy --case dance",
         "its cases are shake, swing, contact, whip, taut, wave, curl, curl contact, coil, static"},
        {"accuracy --case sha", "its cases are"},
        {"accuracy --method dance", "--method is dance"},
        {"accuracy --thread-mapping dance", "--thread-mapping is dance"},
        {"accuracy --strands 0", "--strands is 0"},
        {"accuracy --strands 262145", "--strands is 262145"},
        {"accuracy --strands x", "--strands is x"},
        {"accuracy --device -1", "--device is -1"},
        {"render --size 8", "--size is 8, not a whole number in [16, 4096]"},
        {"render --case dance", "its cases are long"},
        {"stability --scene x", "--scene is x"},
        {"stability --scene 7-6", "--scene is 6, not a whole number in [7,"},
        {"stability --scene 7-", "--scene is ,"},
        {"accuracy --device 99", "device is 99"},
        {"accuracy --json - --csv -", "standard output"},
        {"accuracy --json", "--help"},
        {"accuracy --json $D/x.csv", "x.csv ends in .csv, but what is written is .json"},
        {"accuracy --csv $D/x.foo", "x.foo ends in .foo, but what is written is .csv"},
        {"--dance", "--help"},
        {"physics --quick --case energy", "under --quick are cantilever, cantilever_arc, catenary, pendulum"},
    };
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; ++i) {
        char command[256];
        snprintf(command, sizeof command, "$T %s", wrong[i][0]);
        expect(2, command, wrong[i][1]);
    }
}

static void help_and_version_are_printed(void** state)
{
    (void)state;
    expect(0, "$T --help", "stability");
    expect(0, "$T -h", "Exit status");
    expect(0, "$T physics --version", "hair-bench 0.");
    hair_test_shell_expect_full("--help");
    hair_test_shell_expect_full("--version");
}

static void unwritable_output_exits_with_1_and_leaves_no_file(void** state)
{
    (void)state;
    expect(1, "$T " SMALL " --json $D/no/a.json", "No such file");
    expect(1, "$T " SMALL " --csv $D/b.csv --json $D", "Is a directory");
    expect(1, "$T " SMALL " --json $D/c.json --csv $D/no/c.csv", "No such file");
    expect(1, "$T " SMALL " --csv /dev/full", "No space left");
    expect(1, "$T " SMALL " > /dev/full", "cannot write to the standard output");
    expect(0, "ls $D | wc -l", "0");
}

static void interrupted_run_exits_with_1_and_leaves_no_file(void** state)
{
    (void)state;
    expect(1, "timeout --preserve-status -s INT 2 $T accuracy --strands 2000 --json $D/i.json",
           "interrupted");
    expect(0, "timeout -s INT 3 $T stability --case fuzz 2>&1 | grep -c 'no row'; true", "0");
    expect(0, "ls $D | wc -l", "0");
}

// Rows --------------------------------------------------------------------------------------------

// Read the next CSV field, unquoted, into `field`. Return 0 after the last field of a line.
static int next_field(FILE* file, char* field)
{
    int quoted = 0, c;
    for (; (c = fgetc(file)) != EOF; quoted ^= c == '"')
        if (!quoted && (c == ',' || c == '\r' || c == '\n'))
            break;
        else if (c != '"')
            *field++ = (char)c;
    *field = 0;
    if (c == '\r') c = fgetc(file);
    return c == ',';
}

static void json_and_csv_have_the_same_rows_and_keys(void** state)
{
    (void)state;
    expect(0, "$T " SMALL " --json $D/a.json --csv $D/a.csv", "redblack");
    char path[256], field[256], text[MAX_TEXT], keys[64][256];
    snprintf(path, sizeof path, "%s/a.csv", hair_test_folder());
    json_t* root = hair_test_shell_json("a.json");
    json_t* rows = json_object_get(root, "rows");
    FILE* csv = fopen(path, "r");
    assert_non_null(csv);
    assert_string_equal(json_string_value(json_object_get(root, "suite")), "accuracy");
    assert_non_null(json_string_value(json_object_get(root, "version")));
    assert_non_null(json_string_value(json_object_get(root, "renderer")));
    size_t count = 0;
    for (int more = 1; more; ++count) {
        more = next_field(csv, field);
        snprintf(keys[count], sizeof keys[count], "%s", field);
    }
    assert_true(count > 20);
    size_t i;
    json_t* row;
    json_array_foreach(rows, i, row)
    {
        assert_int_equal(json_object_size(row), count);
        for (size_t k = 0; k < count; ++k) {
            assert_int_equal(next_field(csv, field), k + 1 < count);
            assert_non_null(json_object_get(row, keys[k]));
            assert_string_equal(field, print(json_object_get(row, keys[k]), text));
        }
    }
    assert_int_equal(i, 2);
    assert_int_equal(fgetc(csv), EOF);
    fclose(csv);
    json_decref(root);
    expect(0, "rm $D/a.json $D/a.csv", "");
}

static void standard_output_has_the_table_or_the_requested_file(void** state)
{
    (void)state;
    // Columns that are equal in all rows are printed once.
    expect(0, "$T " SMALL " | grep -c redblack", "1");
    expect(0, "$T " SMALL " --json - 2>$D/e | head -1 && test ! -s $D/e", "{");
    expect(0, "$T " SMALL " --csv - --json /dev/null | head -1; rm $D/e", "case,method,vertices");
}

static void rows_name_what_was_measured_and_how(void** state)
{
    (void)state;
    expect(0,
           "$T accuracy --quick --method accurate --case shake --strands 4 --json $D/r.json --csv /dev/null",
           "");
    json_t* root = hair_test_shell_json("r.json");
    const json_t* row = json_array_get(json_object_get(root, "rows"), 0);
    assert_string_equal(json_string_value(json_object_get(row, "solver")), "accurate");
    assert_true(json_number_value(json_object_get(row, "youngs_modulus")) == 3e9);
    assert_true(json_number_value(json_object_get(row, "substeps")) == 16);
    assert_true(json_number_value(json_object_get(row, "strands")) == 4);
    assert_true(json_is_true(json_object_get(row, "alike")));
    assert_true(json_is_true(json_object_get(row, "front")));
    assert_true(number(row, "ms_min") > 0 && number(row, "ms_min") <= number(row, "ms"));
    assert_true(number(row, "ms") <= number(row, "ms_max"));
    assert_true(number(row, "rms_error") > 1e-7 && number(row, "rms_error") < 1e-3);
    json_decref(root);
    expect(0, "rm $D/r.json", "");
}

static void every_other_suite_runs(void** state)
{
    (void)state;
    expect(0, "$T physics --quick --case pendulum --method accurate --csv -", "pendulum,accurate,2,");
    expect(0, "$T field --quick --case 'none of them' --csv -", "none of them,voxelise,,128,20,");
    expect(0, "$T shadow --quick --strands 300 --size 64 --method mean --csv -", "long,mean");
    expect(0, "$T stability --quick --case ordinary --method redblack --csv -", "ordinary,redblack,32,true");
    expect(0, "$T scale --quick --case followers --size 64 --csv - | sed -n 2p",
           "followers,direct,166,32,1024,24,64,");
    expect(0, "$T bounds --quick --case machine --csv - | sed -n 2p", "machine,a pass that does nothing,");
    expect(0, "$T lod --quick --case coverage --strands 400 --size 64 --csv - | sed -n 2p",
           "coverage,50 %,still,400,64,64,");
    expect(0, "$T table --quick --case drawn --strands 200 --size 64 --csv - | sed -n 2p",
           "drawn,\"tessellation, compute\",redblack,tessellation,200,166,64,4,");
    expect(0, "$T skip --quick --case 'idle head' --strands 100 --csv - | grep -cE ',0,[0-9]+,[0-9]+,3'",
           "1");
    expect(0, "$T startup --quick --case memory --csv - | grep -c 'solve\\|smooth\\|,all,'", "6");
    // Two frames have 4,000 followers. No follower that was inside remains inside.
    expect(0, "$T collision --quick --case shoulders --method push_out --csv -", ",0,1,");
}

static json_t* find_row(json_t* rows, const char* primitive, int segments, int samples)
{
    size_t i;
    json_t* row;
    json_array_foreach(rows, i,
                       row) if (!strcmp(json_string_value(json_object_get(row, "primitive")), primitive) &&
                                !strcmp(json_string_value(json_object_get(row, "lod")), "100 %") &&
                                number(row, "segments") == segments &&
                                number(row, "samples") == samples) return row;
    fail_msg("no row of %s, %d segments, %d samples", primitive, segments, samples);
    return NULL;
}

static void finer_drawing_has_less_image_error(void** state)
{
    (void)state;
    expect(0,
           "$T render --quick --case long --method tessellation --size 64 --strands 400 --json $D/r.json "
           "--csv /dev/null",
           "");
    json_t* root = hair_test_shell_json("r.json");
    json_t* rows = json_object_get(root, "rows");
    json_t *one = find_row(rows, "ribbons", 32, 1), *many = find_row(rows, "ribbons", 32, 4);
    json_t *lines = find_row(rows, "lines", 32, 4), *row;
    double halves = number(one, "halves_differ");
    assert_true(halves > 0 && halves < 0.01);
    assert_true(number(many, "psnr") > number(one, "psnr") + 3);
    assert_true(number(many, "flip") < number(one, "flip"));
    assert_true(number(lines, "psnr") < number(many, "psnr") - 5);
    assert_true(fabs(number(many, "coverage_error")) < 0.1);
    assert_true(number(one, "ms_min") > 0 && number(one, "ms_min") <= number(one, "ms"));
    size_t i;
    json_array_foreach(rows, i, row) // Errors must be well above the reference's own error.
        if (!json_is_null(json_object_get(row, "flip"))) assert_true(number(row, "flip") >= 5 * halves);
    json_decref(root);
    expect(0, "rm $D/r.json", "");
}

// Arithmetic --------------------------------------------------------------------------------------

static const char* const columns[] = {"case", "vertices", "ms", "rms_error", "front", "measured_by", NULL};

static void add(struct bench_rows* rows, const char* name, uint64_t vertices, double ms, double error,
                const char* by)
{
    json_t* row = bench_rows_add(rows);
    bench_set_text(row, "case", name);
    bench_set_count(row, "vertices", vertices);
    bench_set_number(row, "ms", ms);
    bench_set_number(row, "rms_error", error);
    bench_set_text(row, "measured_by", by);
}

static void front_has_only_rows_that_no_other_beats(void** state)
{
    (void)state;
    struct bench_rows rows;
    bench_rows_create(&rows, columns);
    // 't' is on the front, 'f' is dominated, and '-' takes no part.
    const char marks[] = "tfttft-t--t";
    add(&rows, "a", 16, 1, 0.5, "here");
    add(&rows, "a", 16, 2, 0.5, "here"); // This row is slower and equally accurate.
    add(&rows, "a", 16, 3, 0.1, "here");
    add(&rows, "a", 16, 3, 0.1, "here"); // Two equal rows do not dominate each other.
    add(&rows, "a", 16, 3, 0.2, "here"); // This row is less accurate in the same time.
    add(&rows, "a", 16, 9, 0.0, "here");
    add(&rows, "a", 16, 0.1, 0.0, "elsewhere"); // This row is from another machine.
    add(&rows, "a", 32, 9, 0.9, "here"); // This row has other strands.
    add(&rows, "a", 32, 1, NAN, "here");
    add(&rows, "a", 32, INFINITY, 0, "here");
    add(&rows, "b", 32, 9, 0.9, "here"); // This row is of another case.
    bench_mark_front(rows.rows, "ms", "rms_error");
    for (size_t i = 0; marks[i]; ++i) {
        const json_t* front = json_object_get(json_array_get(rows.rows, i), "front");
        char mark = json_is_null(front) ? '-' : json_is_true(front) ? 't' : 'f';
        if (mark != marks[i]) fail_msg("row %zu is %c, not %c", i, mark, marks[i]);
    }
    bench_rows_free(&rows);
}

static void csv_quotes_commas_and_quotes(void** state)
{
    (void)state;
    static const char* const two[] = {"a", "b", NULL};
    struct bench_rows rows;
    char text[64] = {0};
    bench_rows_create(&rows, two);
    bench_set_text(bench_rows_add(&rows), "a", "x, \"y\"");
    bench_set_number(bench_rows_add(&rows), "b", 0.1);
    FILE* file = fmemopen(text, sizeof text, "w");
    assert_non_null(file);
    bench_write_csv(&rows, file);
    fclose(file);
    assert_string_equal(text, "a,b\r\n\"x, \"\"y\"\"\",\r\n,0.1\r\n");
    bench_rows_free(&rows);
}

// Find the frequency in a signal that has other frequencies and decays.
static void frequency_of_a_swing_is_found(void** state)
{
    (void)state;
    double samples[360];
    for (int k = 0; k < 360; ++k) {
        double t = k / 60.0;
        samples[k] = exp(-0.1 * t) * cos(13.7 * t) + 0.5 * cos(41 * t + 1) + 0.1;
    }
    double found = bench_frequency(samples, 360, 1.0 / 60, 10, 20);
    if (!(fabs(found / 13.7 - 1) < 1e-4)) fail_msg("%.9g, not 13.7", found);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(wrong_use_exits_with_2),
        cmocka_unit_test(help_and_version_are_printed),
        cmocka_unit_test(unwritable_output_exits_with_1_and_leaves_no_file),
        cmocka_unit_test(interrupted_run_exits_with_1_and_leaves_no_file),
        cmocka_unit_test(json_and_csv_have_the_same_rows_and_keys),
        cmocka_unit_test(standard_output_has_the_table_or_the_requested_file),
        cmocka_unit_test(rows_name_what_was_measured_and_how),
        cmocka_unit_test(every_other_suite_runs),
        cmocka_unit_test(finer_drawing_has_less_image_error),
        cmocka_unit_test(front_has_only_rows_that_no_other_beats),
        cmocka_unit_test(csv_quotes_commas_and_quotes),
        cmocka_unit_test(frequency_of_a_swing_is_found),
    };
    return cmocka_run_group_tests(tests, make_folder, hair_test_shell_finish);
}
