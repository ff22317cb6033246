// view_debug_test.c - the debug views of hair-view show numbers of the hair, and its window shows
// the messages of OpenGL.
#include "tests/support/shell.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <cmocka.h>

#define TOOL HAIR_BUILD_DIR "/hair-view"
#define RUN "$T $D/small.json --size 800x900 --scale 1 --script $D/s"

static void write_script(const char* text)
{
    char path[256];
    snprintf(path, sizeof path, "%s/s", hair_test_folder());
    FILE* file = fopen(path, "w");
    assert_non_null(file);
    fputs(text, file);
    fclose(file);
}

// Show a view by its name in the list, and return its numbers.
static json_t* show(const char* mode, const char* options)
{
    char script[512], command[256];
    snprintf(script, sizeof script, "click Debug\nclick %s\nwait 6\nreport %s/r.json\n", mode,
             hair_test_folder());
    write_script(script);
    snprintf(command, sizeof command, RUN " --frames 26 --shot $D/%s.png %s",
             strchr(mode, ' ') ? "field" : mode, options);
    hair_test_shell_expect(0, command, "");
    json_t* root = hair_test_shell_json("r.json");
    json_t* debug = json_incref(json_object_get(root, "debug"));
    json_decref(root);
    assert_non_null(debug);
    assert_string_equal(json_string_value(json_object_get(debug, "mode")), mode);
    return debug;
}

static double number_of(const char* mode, const char* options, const char* key)
{
    json_t* debug = show(mode, options);
    double value = hair_test_json_number(debug, key);
    print_message("    %s: %s %g\n", mode, key, value);
    json_decref(debug);
    return value;
}

static void numbers_of_guides_are_those_of_physics(void** state)
{
    (void)state;
    // Hair at rest bears its weight. A strand of 0.3 m weighs 19 uN.
    const char* still = "--motion still";
    double tension = number_of("tension", still, "high");
    assert_true(tension > 3e-6 && tension < 60e-6);
    double velocity = number_of("velocity", "", "high");
    assert_true(velocity > 0.05 && velocity < 20);
    assert_true(number_of("stretch", "", "high") < 0.01);
    assert_true(number_of("stretch", "--set solver=redblack", "high") > 0.01);
    assert_true(number_of("contact", "", "high") > 0);
}

// The neck and the garment of the built-in head are a body, whose distances only the GPU knows.
static void contacts_of_the_built_in_head_are_shown(void** state)
{
    (void)state;
    char script[512];
    snprintf(script, sizeof script, "click Debug\nclick contact\nwait 6\nreport %s/r.json\n",
             hair_test_folder());
    write_script(script);
    hair_test_shell_expect(0,
                           "$T --set guides=60 --set followers=500 --size 800x1100 --scale 1 --script $D/s "
                           "--frames 30 --shot $D/head.png",
                           "");
    json_t* root = hair_test_shell_json("r.json");
    assert_string_equal(json_string_value(json_object_get(json_object_get(root, "debug"), "mode")),
                        "contact");
    json_decref(root);
}

static void strands_drawn_follow_the_level_of_detail(void** state)
{
    (void)state;
    double all = number_of("strands", "", "drawn");
    double few =
        number_of("strands", "--set lod=on --set lod.per_patch=off --set lod.strand_fraction=0.25", "drawn");
    // The scalp is thinner at the hairline.
    assert_true(all > 240 && all < 285);
    assert_true(few > 0.2 * all && few < 0.3 * all);
}

static void overdraw_grows_with_the_strands(void** state)
{
    (void)state;
    double few = number_of("overdraw", "", "fragments");
    double many = number_of("overdraw", "--set followers=3000", "fragments");
    assert_true(few >= 1 && few < 4);
    assert_true(many > 1.2 * few);
}

// The key shows the next view. Each view has a picture of its own.
static void each_view_has_a_picture_of_its_own(void** state)
{
    (void)state;
    char script[128];
    snprintf(script, sizeof script, "key J\nkey J\nwait 2\nreport %s/r.json\n", hair_test_folder());
    write_script(script);
    hair_test_shell_expect(0, RUN " --frames 10", "");
    hair_test_shell_expect(0, "grep '\"mode\": \"tension\"' $D/r.json", "");
    json_decref(show("patches", ""));
    json_decref(show("field x", ""));
    hair_test_shell_expect(0,
                           "cd $D; md5sum tension.png velocity.png stretch.png contact.png strands.png "
                           "overdraw.png patches.png field.png | cut -d' ' -f1 | sort -u | wc -l | grep -x 8",
                           "");
}

static void messages_of_opengl_are_listed(void** state)
{
    (void)state;
    hair_test_shell_expect(0, "grep 'marker of hair-view: Messages of OpenGL appear here' $D/r.json", "");
    hair_test_shell_expect(0, "! grep 'error of OpenGL' $D/r.json", "");
}

static int start(void** state)
{
    (void)state;
    return hair_test_shell_start_capture(TOOL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(numbers_of_guides_are_those_of_physics),
        cmocka_unit_test(contacts_of_the_built_in_head_are_shown),
        cmocka_unit_test(strands_drawn_follow_the_level_of_detail),
        cmocka_unit_test(overdraw_grows_with_the_strands),
        cmocka_unit_test(each_view_has_a_picture_of_its_own),
        cmocka_unit_test(messages_of_opengl_are_listed),
    };
    return cmocka_run_group_tests(tests, start, hair_test_shell_finish);
}
