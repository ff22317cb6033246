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

// The reference moves free hair, and a second head all hair.
static void motion_error_is_larger_for_solvers_that_do_not_converge(void** state)
{
    (void)state;
    static const char* const solvers[] = {"accurate", "direct", "follow"};
    double reference[3], contact[3];
    for (int i = 0; i < 3; ++i) {
        char option[32];
        snprintf(option, sizeof option, "--set solver=%s", solvers[i]);
        contact[i] = measure(option, "key G\nwait 32", "motion_error");
        json_t* root = hair_test_shell_json("r.json");
        const json_t* free = json_object_get(root, "reference");
        assert_non_null(free);
        assert_true(hair_test_json_number(free, "free") > 3);
        assert_true(hair_test_json_number(free, "worst") >= hair_test_json_number(free, "rms"));
        assert_true(hair_test_json_number(free, "energy") > 1e-9 &&
                    hair_test_json_number(free, "energy") < 1e-4);
        reference[i] = hair_test_json_number(free, "rms");
        print_message("    %s: %g of the length, %g with contacts\n", solvers[i], reference[i], contact[i]);
        json_decref(root);
    }
    assert_true(reference[0] > 0 && reference[0] < 3e-4);
    assert_true(reference[1] > 2 * reference[0] && reference[1] < 3e-3);
    assert_true(reference[2] > 10 * reference[1] && reference[2] < 1);
    assert_true(contact[1] > 0 && contact[1] < 0.02);
    assert_true(contact[2] > 3 * contact[1] && contact[2] < 1);
}

// Hair that was in motion is put at rest. Colliders must not move through it from their last pose.
static void motion_error_does_not_depend_on_earlier_motion(void** state)
{
    (void)state;
    double error[2];
    for (int i = 0; i < 2; ++i) {
        measure("", i ? "wait 20\nkey G\nwait 22" : "key G\nwait 22", "motion_error");
        json_t* root = hair_test_shell_json("r.json");
        error[i] = hair_test_json_number(json_object_get(root, "reference"), "rms");
        json_decref(root);
    }
    print_message("    %g from the start, %g later\n", error[0], error[1]);
    assert_true(error[0] > 0 && error[1] > 0.99 * error[0] && error[1] < 1.01 * error[0]);
}

// A wind that varies from place to place, which the reference does not have.
static void hair_in_wind_has_no_reference(void** state)
{
    (void)state;
    measure("--set wind.x=4", "key G\nwait 12", "motion_error");
    json_t* root = hair_test_shell_json("r.json");
    assert_true(hair_test_json_number(root, "motion_error") > 0);
    assert_null(json_object_get(root, "reference"));
    json_decref(root);
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
        cmocka_unit_test(motion_error_does_not_depend_on_earlier_motion),
        cmocka_unit_test(hair_in_wind_has_no_reference),
        cmocka_unit_test(pareto_panel_measures_settings_and_takes_one),
    };
    return cmocka_run_group_tests(tests, start, hair_test_shell_finish);
}
