// actions_test.c - every action of hair-view changes the scene that it must, by its key and by its
// label, undo takes the change back, and mouse controls and panels change the scene too.
#include "tests/support/shell.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <cmocka.h>

#define TOOL HAIR_BUILD_DIR "/hair-view"
#define expect hair_test_shell_expect
#define RUN "$T $D/small.json --size 900x1500 --scale 1 --script $D/s --frames "

// An action, and a word in the line of the saved scene that it changes.
struct action {
    const char *label, *key, *word;
};

static const struct action actions[] = {
    {"Hair", "1", "\"show\": \"head\""},
    {"Head", "2", "\"show\": \"hair\""},
    {"Guides", "3", "\"show\": \"hair,head,guides\""},
    {"Colliders", "4", "\"show\": \"hair,head,colliders\""},
    {"Air", "5", "\"show\": \"hair,head,wind\""},
    {"Next colour", "C", "\"color.root.r\""},
    {"Short", "S", "\"strand.length\""},
    {"Curly", "U", "\"curl.radius\""},
    {"Multi-strand", "M", "\"clump.interpolation\": \"multi\""},
    {"Single-strand", "N", "\"clump.interpolation\": \"single\""},
    {"Add a ball", "B", "\"shape\": \"sphere\""},
    {"Wind", "K", "\"wind.x\": \"4\""},
    {"Stronger", "]", "\"wind.x\": \"1\""},
    {"Level of detail", "D", "\"lod\": \"on\""},
    {"Dynamic", "A", "\"lod\": \"on\""},
    {"Tessellation", "T", "\"render_path\": \"tessellation\""},
    {"Multi-pass", "X", "\"solver\": \"redblack\""},
    {"Fewer steps", "V", "\"substep_rate\": \"0.25\""},
};
#define ACTIONS (sizeof actions / sizeof *actions)

static void write_file(const char* name, const char* text)
{
    FILE* file = hair_test_shell_create(name, "");
    fputs(text, file);
    fclose(file);
}

static void actions_change_the_scene_by_key_and_label(void** state)
{
    (void)state;
    static char script[16384];
    const char* folder = hair_test_folder();
    int used = snprintf(script, sizeof script, "key P\nsave %s/0.json\n", folder);
    for (size_t i = 0; i < ACTIONS; ++i)
        used += snprintf(script + used, sizeof script - (size_t)used,
                         "key %s\nwait 2\nsave %s/k%zu.json\nkey Ctrl+Z\nsave %s/u%zu.json\n"
                         "click %s\nsave %s/l%zu.json\nkey Ctrl+Z\n",
                         actions[i].key, folder, i, folder, i, actions[i].label, folder, i);
    write_file("s", script);
    expect(0, RUN "500", "");
    for (size_t i = 0; i < ACTIONS; ++i) {
        char command[512];
        snprintf(
            command, sizeof command,
            "diff $D/0.json $D/k%zu.json | grep '^>' | grep -qF '%s' && cmp $D/k%zu.json $D/l%zu.json && "
            "cmp $D/0.json $D/u%zu.json || { echo %s; false; }",
            i, actions[i].word, i, i, i, actions[i].label);
        expect(0, command, "");
    }
}

// Mouse controls over the picture, each with a word of the saved scene.
static void mouse_controls_change_the_scene(void** state)
{
    (void)state;
    static const char* const drags[][3] = {
        {"", "left", "\"camera\""},
        {"Left Alt", "left", "\"camera\""},
        {"Left Shift", "left", "\"light_direction.x\""},
        {"Left Shift", "right", "\"wind.z\""},
        {"", "right", "\"pose\""},
        {"", "middle", "\"pose\""},
    };
    char script[4096], command[256];
    const char* folder = hair_test_folder();
    int used = snprintf(script, sizeof script, "key P\nkey F\nwait 2\nsave %s/0.json\n", folder);
    for (size_t i = 0; i < 6; ++i) {
        const char *held = drags[i][0], *button = drags[i][1];
        used += snprintf(script + used, sizeof script - (size_t)used,
                         "move 420 400\n%s%s\ndown %s\nmove 470 430\n", *held ? "press " : "wait 1", held,
                         button);
        used += snprintf(script + used, sizeof script - (size_t)used,
                         "up %s\n%s%s\nsave %s/d%zu.json\nkey Ctrl+Z\n", button,
                         *held ? "release " : "wait 1", held, folder, i);
    }
    write_file("s", script);
    expect(0, RUN "200", "");
    for (size_t i = 0; i < 6; ++i) {
        snprintf(command, sizeof command, "! cmp -s $D/0.json $D/d%zu.json && grep -qF '%s' $D/d%zu.json", i,
                 drags[i][2], i);
        expect(0, command, "");
    }
}

// An arrow moves the ball along one axis, and a ring turns a box. The handles follow the mouse.
static void handles_move_and_turn_colliders(void** state)
{
    (void)state;
    char script[1024];
    const char* folder = hair_test_folder();
    write_file(
        "box.json",
        "{\"style\": \"bob\", \"show\": \"guides,colliders\", \"camera\": {\"eye\": [0, 1.5, 2], "
        "\"target\": [0, 1.5, 0], \"fov\": 30}, \"colliders\": [{\"shape\": \"box\", \"position\": "
        "[0.1, 1.5, 0], \"size\": [0.05, 0.02, 0.03], \"stays\": true}], \"settings\": {\"guides\": 16, "
        "\"followers\": 100}}");
    snprintf(script, sizeof script,
             "key P\nwait 2\nsave %s/0.json\ndrag Arrow 0 x 50 0\nsave %s/1.json\nkey Ctrl+Z\n"
             "drag Ring 0 z -40 40\nsave %s/2.json\n",
             folder, folder, folder);
    write_file("s", script);
    expect(0, "$T $D/box.json --size 1280x720 --scale 1 --script $D/s --frames 60", "");
    json_t *moved = hair_test_shell_json("1.json"), *turned = hair_test_shell_json("2.json");
    const json_t* box = json_array_get(json_object_get(moved, "colliders"), 0);
    const json_t* position = json_object_get(box, "position");
    // The picture is 554 pixels high and shows 1.072 m.
    assert_true(fabs(json_number_value(json_array_get(position, 0)) - 0.1 - 50 * 1.072 / 554) < 0.002);
    assert_true(fabs(json_number_value(json_array_get(position, 1)) - 1.5) < 1e-6);
    assert_true(fabs(json_number_value(json_array_get(position, 2))) < 1e-6);
    box = json_array_get(json_object_get(turned, "colliders"), 0);
    const json_t* rotation = json_object_get(box, "rotation");
    double z = json_number_value(json_array_get(rotation, 2)),
           w = json_number_value(json_array_get(rotation, 3));
    assert_true(fabs(z * z + w * w - 1) < 1e-5);
    assert_true(fabs(z) > 0.1);
    json_decref(moved);
    json_decref(turned);
}

// The level of detail by the size on the screen falls as the camera moves away.
static void levels_of_detail_follow_the_camera(void** state)
{
    (void)state;
    char script[512];
    const char* folder = hair_test_folder();
    snprintf(script, sizeof script,
             "key P\nclick Dynamic\nwait 2\nreport %s/0.json\nmove 450 300\nwheel -20\nwait 2\nreport "
             "%s/1.json\n",
             folder, folder);
    write_file("s", script);
    expect(0, RUN "30", "");
    json_t *near = hair_test_shell_json("0.json"), *far = hair_test_shell_json("1.json");
    const json_t *a = json_object_get(near, "drawn_fractions"), *b = json_object_get(far, "drawn_fractions");
    assert_true(hair_test_json_number(b, "strands") < 0.7 * hair_test_json_number(a, "strands"));
    assert_true(hair_test_json_number(b, "segments") <= hair_test_json_number(a, "segments"));
    json_decref(near);
    json_decref(far);
}

static void panels_find_change_and_reset_settings(void** state)
{
    (void)state;
    char script[1024];
    const char* folder = hair_test_folder();
    snprintf(script, sizeof script,
             "key P\nsave %s/0.json\nclick Search\ntext damping\nwait 2\ndrag damping 30 0\nsave %s/1.json\n"
             "click Reset damping\nsave %s/2.json\nclick Haircut\nclick bob\nsave %s/3.json\n",
             folder, folder, folder, folder);
    write_file("s", script);
    expect(0, RUN "80", "");
    expect(0, "grep -q '\"damping\"' $D/1.json && cmp $D/0.json $D/2.json", "");
    expect(0, "grep -q '\"style\": \"bob\"' $D/3.json", "");
}

// The panel shows the groups of the haircut only. The button of an inherited value sets the value.
static void panels_show_settings_of_groups(void** state)
{
    (void)state;
    char script[1024];
    const char* folder = hair_test_folder();
    snprintf(script, sizeof script,
             "key P\nsave %s/0.json\nclick Search\ntext groups.0\nwait 2\nclick groups.0.tip_mass\n"
             "drag groups.0.radius 30 0\nsave %s/1.json\nclick Reset groups.0.tip_mass\n"
             "click Reset groups.0.radius\nsave %s/2.json\n",
             folder, folder, folder);
    write_file("s", script);
    expect(0, RUN "80", "");
    expect(0, "grep -q '\"groups.0.tip_mass\": \"0\"' $D/1.json && grep -q '\"groups.0.radius\"' $D/1.json",
           "");
    expect(0, "cmp $D/0.json $D/2.json", "");
    write_file("s", "key P\nclick Search\ntext groups.1\nwait 2\nclick groups.1.tip_mass\n");
    expect(4, RUN "80", "groups.1.tip_mass");
}

// The held vertex must start near the cursor and follow it.
static void grabbed_hair_follows_the_cursor(void** state)
{
    (void)state;
    char script[1024];
    const char* folder = hair_test_folder();
    snprintf(script, sizeof script,
             "key Space\nwait 30\nmove 765 300\npress Left Ctrl\ndown left\nreport %s/0.json\n"
             "move 765 280\nwait 10\nmove 785 280\nwait 20\nreport %s/1.json\nup left\nreport %s/2.json\n",
             folder, folder, folder);
    write_file("s", script);
    expect(0,
           "$T $D/small.json --set guides=150 --set followers=2000 --size 1600x900 --scale 1 --script $D/s "
           "--frames 90",
           "");
    json_t *before = hair_test_shell_json("0.json"), *after = hair_test_shell_json("1.json"),
           *last = hair_test_shell_json("2.json");
    const json_t *from = json_object_get(before, "held"), *to = json_object_get(after, "held");
    assert_non_null(from);
    assert_non_null(to);
    assert_null(json_object_get(last, "held"));
    assert_true(json_is_true(json_object_get(after, "is_finite")));
    assert_true(fabs(hair_test_json_number(from, "x") - 765) < 40);
    assert_true(fabs(hair_test_json_number(from, "y") - 300) < 40);
    assert_true(fabs(hair_test_json_number(to, "x") - hair_test_json_number(from, "x") - 20) < 3);
    assert_true(fabs(hair_test_json_number(to, "y") - hair_test_json_number(from, "y") + 20) < 3);
    json_decref(before);
    json_decref(after);
    json_decref(last);
}

// Return a number of a report of the window.
static double number_of(const char* report, const char* name)
{
    json_t* json = hair_test_shell_json(report);
    double number = hair_test_json_number(json, name);
    assert_true(json_is_true(json_object_get(json, "is_finite")));
    json_decref(json);
    return number;
}

static void a_blade_cuts_the_hair_behind_its_line(void** state)
{
    (void)state;
    char script[1024];
    const char* folder = hair_test_folder();
    snprintf(script, sizeof script,
             "key Space\nwait 10\npress Left Ctrl\nmove 400 20\ndown right\nmove 1100 20\nup right\n"
             "report %s/0.json\nmove 400 470\ndown right\nglide 1100 470 5\nup right\nrelease Left Ctrl\n"
             "report %s/1.json\nwait 60\nreport %s/2.json\nwait 130\nreport %s/3.json\n"
             "press Left Ctrl\nmove 400 400\ndown right\nmove 1100 400\nup right\nrelease Left Ctrl\n"
             "report %s/4.json\nkey R\nreport %s/5.json\n",
             folder, folder, folder, folder, folder, folder);
    write_file("s", script);
    expect(0,
           "$T $D/small.json --set guides=150 --set followers=2000 --size 1600x900 --scale 1 --script $D/s "
           "--frames 240",
           "");
    assert_true(number_of("0.json", "cut_strands") == 0); // The line is above the head.
    assert_true(number_of("1.json", "cut_strands") > 50);
    assert_true(number_of("1.json", "cut_strands") < 2000);
    assert_true(number_of("2.json", "pieces") == 1);
    assert_true(number_of("3.json", "pieces") == 0);
    assert_true(number_of("4.json", "cut_strands") > number_of("3.json", "cut_strands"));
    assert_true(number_of("4.json", "pieces") == 1);
    assert_true(number_of("5.json", "cut_strands") == 0 && number_of("5.json", "pieces") == 0);
}

// A haircut is a change of the scene, which undo takes back.
static void files_open_by_their_name(void** state)
{
    (void)state;
    char script[1024];
    const char* folder = hair_test_folder();
    expect(0, HAIR_BUILD_DIR "/hair-groom generate bob $D/bob.tfx --guides 40", "");
    snprintf(script, sizeof script,
             "key P\nsave %s/0.json\nclick File\nkey Ctrl+A\ntext %s/bob.tfx\nclick Open\nsave %s/1.json\n"
             "key Escape\nmove 450 900\nkey Ctrl+Z\nsave %s/2.json\ndrop %s/none.tfx\nreport %s/r.json\n",
             folder, folder, folder, folder, folder, folder);
    write_file("s", script);
    expect(0, RUN "60", "");
    expect(0, "grep -q '\"groom\": .*bob.tfx' $D/1.json && cmp $D/0.json $D/2.json", "");
    expect(0, "grep 'none.tfx cannot be read' $D/r.json", "");
}

// A mesh in centimetres that is dropped moves with the head, as a collider in metres.
static void dropped_mesh_becomes_a_collider(void** state)
{
    (void)state;
    char script[1024];
    const char* folder = hair_test_folder();
    expect(0,
           "printf 'v 0 0 0\nv 900 0 0\nv 0 900 0\nv 0 0 900\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n' "
           ">$D/cube.obj; echo f 1 2 3 >$D/broken.obj",
           "");
    snprintf(script, sizeof script,
             "key P\nsave %s/0.json\ndrop %s/cube.obj\nwait 3\nsave %s/1.json\nreport %s/r.json\nkey "
             "Ctrl+Z\nsave %s/2.json\ndrop %s/broken.obj\nsave %s/3.json\n",
             folder, folder, folder, folder, folder, folder, folder);
    write_file("s", script);
    expect(0, RUN "40", "");
    expect(0, "grep 'which is 9 m large in units of 0.01 m' $D/r.json", "");
    expect(0, "grep -q '/cube.obj' $D/1.json && grep -q colliders $D/1.json", "");
    expect(0, "cmp $D/0.json $D/2.json && cmp $D/0.json $D/3.json", "");
    expect(0, HAIR_BUILD_DIR "/hair-capture $D/1.json --frames 0:1 --size 64x36 --samples 1 --hash", "");
}

// Switches that are no part of a scene.
static void switches_change_the_window_by_key_and_label(void** state)
{
    (void)state;
    static const char* const switches[][3] = {
        {"Play", "Space", "plays"},    {"Loop", "L", "loops"},
        {"Pause", "P", "pauses"},      {"Slow motion", "O", "is_slow"},
        {"Strip", "I", "shows_strip"}, {"Panels", "Tab", "shows_panels"},
        {"Help", "?", "shows_help"},   {"OpenGL", "Y", "shows_gl_messages"},
    };
    enum { SWITCHES = sizeof switches / sizeof *switches };
    char script[2048];
    const char* folder = hair_test_folder();
    int used = snprintf(script, sizeof script, "report %s/0.json\n", folder);
    for (size_t i = 0; i < SWITCHES; ++i)
        used +=
            snprintf(script + used, sizeof script - (size_t)used,
                     "key %s\nreport %s/k%zu.json\nkey %s\nclick %s\nreport %s/l%zu.json\nkey %s\n",
                     switches[i][1], folder, i, switches[i][1], switches[i][0], folder, i, switches[i][1]);
    used += snprintf(script + used, sizeof script - (size_t)used, "key ?\nkey Escape\nreport %s/e.json\n",
                     folder);
    write_file("s", script);
    expect(0, RUN "160", "");
    expect(0, "grep 'shows_help\": false' $D/e.json", "");
    json_t* before = hair_test_shell_json("0.json");
    for (size_t i = 0; i < SWITCHES; ++i) {
        char key[16], label[16];
        snprintf(key, sizeof key, "k%zu.json", i);
        snprintf(label, sizeof label, "l%zu.json", i);
        json_t *by_key = hair_test_shell_json(key), *by_label = hair_test_shell_json(label);
        const char* name = switches[i][2];
        bool was = json_is_true(json_object_get(before, name));
        if (json_is_true(json_object_get(by_key, name)) == was) fail_msg("the key of %s", name);
        if (json_is_true(json_object_get(by_label, name)) == was) fail_msg("the label of %s", name);
        json_decref(by_key);
        json_decref(by_label);
    }
    json_decref(before);
}

static int start(void** state)
{
    (void)state;
    return hair_test_shell_start_capture(TOOL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(actions_change_the_scene_by_key_and_label),
        cmocka_unit_test(mouse_controls_change_the_scene),
        cmocka_unit_test(grabbed_hair_follows_the_cursor),
        cmocka_unit_test(a_blade_cuts_the_hair_behind_its_line),
        cmocka_unit_test(handles_move_and_turn_colliders),
        cmocka_unit_test(levels_of_detail_follow_the_camera),
        cmocka_unit_test(switches_change_the_window_by_key_and_label),
        cmocka_unit_test(files_open_by_their_name),
#if HAIR_BULLET
        cmocka_unit_test(dropped_mesh_becomes_a_collider),
#endif
        cmocka_unit_test(panels_find_change_and_reset_settings),
        cmocka_unit_test(panels_show_settings_of_groups),
    };
    return cmocka_run_group_tests(tests, start, hair_test_shell_finish);
}
