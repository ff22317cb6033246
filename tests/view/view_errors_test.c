// view_errors_test.c - hair-view measures errors of picture and motion, which are larger for
// pictures of low quality and for solvers that do not converge.
#include "tests/support/shell.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <cmocka.h>

#define TOOL HAIR_BUILD_DIR "/hair-view"

static double measure(const char* arguments, const char* script, const char* name)
{
    char path[256], command[512];
    snprintf(path, sizeof path, "%s/s", hair_test_folder());
    FILE* file = fopen(path, "w");
    assert_non_null(file);
    fprintf(file, "%s\nreport %s/r.json\n", script, hair_test_folder());
    fclose(file);
    snprintf(command, sizeof command,
             "$T $D/small.json --size 800x480 --scale 1 --script $D/s --frames 60 %s", arguments);
    hair_test_shell_expect(0, command, "");
    json_t* root = hair_test_shell_json("r.json");
    double value = hair_test_json_number(root, name);
    json_decref(root);
    return value;
}

static void image_error_is_larger_for_pictures_of_low_quality(void** state)
{
    (void)state;
    static const char script[] = "wait 5\nkey P\nkey E\nwait 24";
    double full = measure("", script, "flip"), low = measure("--quality 2", script, "flip");
    assert_true(measure("", script, "samples") >= 64);
    assert_true(full > 0.001 && full < 0.1);
    assert_true(low > 1.2 * full && low < 0.3);
}

static void motion_error_is_larger_for_solvers_that_do_not_converge(void** state)
{
    (void)state;
    static const char script[] = "key G\nwait 42";
    double direct = measure("", script, "motion_error");
    double follow = measure("--set solver=follow", script, "motion_error");
    assert_true(direct > 0 && direct < 0.02);
    assert_true(follow > 3 * direct && follow < 1);
}

// A click on a point takes its settings.
static void pareto_panel_measures_settings_and_takes_one(void** state)
{
    (void)state;
    char script[512];
    snprintf(script, sizeof script,
             "wait 5\nkey P\nsave %s/0.json\nkey Q\nclick Measure settings\nwait 38\nclick Point 6\nsave "
             "%s/1.json",
             hair_test_folder(), hair_test_folder());
    measure("--frames 70", script, "flip");
    json_t* root = hair_test_shell_json("r.json");
    const json_t* points = json_object_get(root, "pareto");
    assert_true(json_array_size(points) > 9);
    for (size_t i = 0; i < json_array_size(points); ++i) {
        const json_t* point = json_array_get(points, i);
        assert_true(hair_test_json_number(point, "ms") > 0);
        assert_true(hair_test_json_number(point, "flip") > 0.001 &&
                    hair_test_json_number(point, "flip") < 0.5);
    }
    const char* settings = json_string_value(json_object_get(json_array_get(points, 6), "settings"));
    assert_non_null(settings);
    assert_non_null(strstr(settings, "lod.strand_pixels=1"));
    hair_test_shell_expect(
        0, "! grep -q strand_pixels $D/0.json && grep 'lod.strand_pixels\": \"1\"' $D/1.json", "");
    json_decref(root);
}

static int start(void** state)
{
    (void)state;
    return hair_test_shell_start_capture(TOOL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(image_error_is_larger_for_pictures_of_low_quality),
        cmocka_unit_test(motion_error_is_larger_for_solvers_that_do_not_converge),
        cmocka_unit_test(pareto_panel_measures_settings_and_takes_one),
    };
    return cmocka_run_group_tests(tests, start, hair_test_shell_finish);
}
