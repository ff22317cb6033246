// capture_refused_test.c - exit codes and messages of hair-capture: wrong use, unusable input, and
// a driver without OpenGL 4.5.
#define _XOPEN_SOURCE 700
#include "tests/support/shell.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <cmocka.h>

#define TOOL HAIR_BUILD_DIR "/hair-capture"

#define expect hair_test_shell_expect

static void wrong_use_exits_with_2(void** state)
{
    (void)state;
    static const char* const wrong[][2] = {
        {"", "nothing to do"},
        {"-o $D/a.png --frames 3", "--frames"},
        {"-o $D/a.png --frames 3:3", "A less than B"},
        {"-o $D/a.png --frames 4:3", "A less than B"},
        {"-o $D/a.png --frames -1:3", "--frames"},
        {"-o $D/a.png --frames 0:99999999999999999999", "--frames"},
        {"-o $D/a.png --frames 0:2", "several frames"},
        {"-o $D/a.exr --frames 0:2", "several frames"},
        {"-o $D/a.jpg", "none of .png"},
        {"-o $D", "none of .png"},
        {"-o $D/%s.png", "no other %"},
        {"-o $D/%n%d.png", "no other %"},
        {"-o $D/%04d%d.png", "no other %"},
        {"-o $D/a.mp4 --size 65x36", "even"},
        {"-o $D/a.png --size 0x36", "--size"},
        {"-o $D/a.png --size 64", "--size"},
        {"-o $D/a.png --size 64x99999", "--size"},
        {"-o $D/a.png --fps 0", "--fps"},
        {"-o $D/a.png --fps x", "--fps"},
        {"-o $D/a.png --samples 0", "--samples"},
        {"-o $D/a.png --supersample 9", "--supersample"},
        {"-o $D/a.png --device 99", "device is 99"},
        {"-o $D/a.png --device -2", "--device"},
        {"-o $D/a.png --scene dance", "no scene dance"},
        {"-o $D/a.png --style dance", "no style dance"},
        {"-o $D/a.png --motion dance", "no motion dance"},
        {"-o $D/a.png --solver dance", "not one of: direct, accurate, follow, redblack"},
        {"-o $D/a.png --set root=held", "not one of: clamped, hinged, free"},
        {"-o $D/a.png --set thread_mapping=",
         "thread_mapping is empty, not one of: auto, workgroup_per_guide, thread_per_guide"},
        {"-o $D/a.png --set groups.8.radius=1", "no setting groups.8.radius; groups are 0 to 7"},
        {"-o $D/a.png --set groups.1.drag=1", "no setting groups.1.drag"},
        {"-o $D/a.png --set groups.1.radius=5",
         "groups.1.radius: hair_group_look.radius is 5, not in [0, 4]"},
        {"-o $D/a.png --set groups.1.radius=2",
         "groups.1.radius is set, but the groups of the haircut are [0, 0]"},
        {"-o $D/a.png --set preset=dry", "not one of: natural, fine, thick, wet, frizzy"},
        {"-o $D/a.png --set look=dry", "not one of: natural, straight, wavy, curly, coily, frizzy, short"},
        {"-o $D/a.png --set color=plaid", "not one of: brown, dark_brown, black, blond,"},
        {"-o $D/a.png --set strand.taper=1,,2", "taper is 1,,2, not 1 to 8 numbers with commas between"},
        {"-o $D/a.png --set clump.weight=1,2,3,4,5,6,7,8,9", "not 1 to 8 numbers"},
        {"-o $D/a.png --set clump.weight=0,2", "hair_look.clump.weight.at[4] is 1.14"},
        {"-o $D/a.png --set fit_curl=$D/none.hair", "none.hair"},
        {"-o $D/a.png --set wind.x=1001", "hair_wind.velocity[0] is 1001"},
        {"-o $D/a.png --set substep=1e-6", "hair_desc.substep is 1e-06"},
        {"-o $D/a.png --primitive dance", "not one of: ribbons, lines"},
        {"-o $D/a.png --set damping", "KEY=VALUE"},
        {"-o $D/a.png --set dance=1", "no setting dance"},
        {"-o $D/a.png --set =1", "no setting"},
        {"-o $D/a.png --set damping=", "damping is empty"},
        {"-o $D/a.png --set damping=nan", "damping is nan, not in [0, 1000]"},
        {"-o $D/a.png --set damping=1e999", "damping is inf, not in [0, 1000]"},
        {"-o $D/a.png --set wind.still_air=2", "wind.still_air is 2, not one of: off, on"},
        {"-o $D/a.png --set lod.per_patch=", "lod.per_patch is empty, not one of: off, on"},
        {"-o $D/a.png --set redblack.iterations=1.5", "not a whole number"},
        {"-o $D/a.png --set redblack.iterations=-1", "iterations is -1, not in [1, 256]"},
        {"-o $D/a.png --set damping=-1", "hair_physics.damping is -1"},
        {"-o $D/a.png --set strand.segments=257", "hair_look.strand.segments"},
        {"-o $D/a.png --keep-fraction 2 --groom $D/x.hair", "hair_import.keep_fraction"},
        {"-o $D/a.png --guides 99999", "guide_count"},
        {"-o $D/a.png --groom a --style bob", "too many"},
        {"-o $D/a.png --scene demo a.json", "too many"},
        {"-o $D/a.png a.json b.json", "b.json"},
        {"-o - --hash", "standard output"},
        {"-o - --stats -", "standard output"},
        {"--stats $D/s.foo", "s.foo ends in .foo, but what is written is .json"},
        {"--dance", "--help"},
        {"--groom", "--help"},
        {"--show hair,hat --hash", "--show is hair,hat, not some of hair, head, guides, colliders and wind"},
        {"--show hair, --hash", "--show is hair,"},
    };
    assert_int_equal(hair_test_shell("printf 'HAIR' >$D/x.hair; head -c 124 /dev/zero >>$D/x.hair"), 0);
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; ++i) {
        char command[512];
        snprintf(command, sizeof command, "$T %s", wrong[i][0]);
        expect(2, command, wrong[i][1]);
    }
    expect(1, "test -e $D/a.png -o -e $D/a.mp4 -o -e $D/a.exr", "");
}

static void unusable_input_exits_with_4_and_its_position(void** state)
{
    (void)state;
    static const char* const wrong[][2] = {
        {"", "line 2"},
        {"[]", "must be an object"},
        {"{\"frames\": 1, \"frames\": 2}", "duplicate"},
        {"{\"dance\": 1}", "there is no dance"},
        {"{\"camera\": {\"eye\": [0, 0, 1], \"up\": 1}}", "there is no camera.up"},
        {"{\"camera\": {\"eye\": [0, 0]}}", "camera.eye must be 3 numbers"},
        {"{\"camera\": {\"eye\": [0, 0, \"1\"]}}", "camera.eye[2] must be a number"},
        {"{\"camera\": {\"eye\": [0, 0, 1e9]}}", "in [-1000000, 1000000]"},
        {"{\"camera\": {\"eye\": [0, 0, 0]}}", "both eye and target"},
        {"{\"camera\": {\"eye\": [1, 1, 1], \"target\": [1, 1, 1]}}", "not its target"},
        {"{\"frames\": 1.5}", "a whole number in [1, 1000000]"},
        {"{\"head\": 1}", "true or false"},
        {"{\"style\": \"dance\"}", "no style dance"},
        {"{\"motion\": \"dance\"}", "no motion dance"},
        {"{\"motion\": [{\"time\": 1}, {\"time\": 1}]}", "in order of time"},
        {"{\"motion\": [{\"time\": 1, \"dance\": 1}]}", "motion[0].dance"},
        {"{\"colliders\": [{\"shape\": \"cube\"}]}", "colliders[0].shape"},
        {"{\"colliders\": [{\"motion\": [{\"time\": 1}, {\"time\": 0}]}]}",
         "colliders[0].motion must be in order"},
        {"{\"wind\": {\"velocity\": [1, 2]}}", "wind.velocity must be three numbers"},
        {"{\"wind\": {\"gust\": 1}}", "no setting wind.gust"},
        {"{\"wind\": {\"sources\": [{\"speed\": 2000}]}}", "wind.sources[0].speed must be"},
        {"{\"colliders\": [{\"stays\": 1}]}", "colliders[0].stays must be true or false"},
        {"{\"colliders\": [{\"spin\": 1}]}", "colliders[0].spin must be 3 numbers"},
        {"{\"settings\": {\"dance\": 1}}", "no setting dance"},
        {"{\"maps\": [{\"density\": [\"01\", \"0\"]}]}", "maps[0].density must be rows of digits"},
        {"{\"maps\": [{\"thickness\": 3}]}", "maps[0].thickness must be rows of digits"},
        {"{\"maps\": [{}, {}, {}, {}, {}]}", "maps must be"},
        {"{\"attributes\": [{\"kind\": \"shine\"}]}",
         "attributes[0].kind must be one of stiffness, damping,"},
        {"{\"attributes\": [{\"map\": [\"x\"]}]}", "attributes[0].map must be rows of digits"},
        {"{\"attributes\": [{\"range\": [0, 101]}]}", "attributes[0].range[1] must be a number in [0, 100]"},
        {"{\"settings\": {\"damping\": null}}", "damping must be a number"},
        {"{\"groom\": \"\"}", "the name of a file"},
        {"{\"groom\": \"no/such.hair\"}", "no/such.hair"},
        {"{\"lights\": [{\"direction\": [0, 0, 0]}]}", "has no direction"},
        {"{\"settings\": {\"substep\": 1e-6}}", "hair_desc.substep is 1e-06"},
        {"{\"\\u001b]0;owned\": 1}", "there is no \\x1b]0;owned"},
    };
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; ++i) {
        char command[512];
        snprintf(command, sizeof command, "echo '%s' >$D/s.json; $T $D/s.json -o $D/a.png", wrong[i][0]);
        expect(4, command, wrong[i][1]);
    }
    expect(4, "$T $D/none.json -o $D/a.png", "none.json");
    expect(4, "$T --groom $D/none.hair -o $D/a.png", "none.hair");
    expect(4, "$T --groom $D/s.json -o $D/a.png", "hair-capture:");
    expect(4, "$T --shader $D/none.glsl -o $D/a.png", "none.glsl");
    expect(4, "$T --shader $D/s.json -o $D/a.png", "s.json:1: ");
    expect(1, "test -e $D/a.png", "");
    expect(4, "$T --groom /dev/null -o $D/a.png", "/dev/null: the file ends at byte 0");
    expect(2, "echo '{}' >$D/s.json; $T $D/s.json --frames 0:1 -o $D/a.jpg", "a.jpg");
}

// Check whose fault a refused setting is, beside options that are in order or out of range.
static void bad_scene_beside_settings_of_the_command_line_exits_with_4(void** state)
{
    (void)state;
    expect(0, "echo '{\"settings\": {\"damping\": -1}}' >$D/s.json", "");
    expect(4, "$T $D/s.json --set strand.segments=4 --seed 3 -o $D/a.png", "hair_physics.damping is -1");
    expect(4, "$T $D/s.json --set look=wavy --set strand.taper=0,1 -o $D/a.png",
           "hair_physics.damping is -1");
    expect(4, "$T $D/s.json --set damping=2 -o $D/a.png", "hair_physics.damping is -1");
    expect(0, "echo '{}' >$D/s.json", "");
    expect(2, "$T $D/s.json --set damping=-2 -o $D/a.png", "hair_physics.damping is -2");
    expect(2, "$T $D/s.json --set clump.weight=0,2 -o $D/a.png", "hair_look.clump.weight.at[4] is 1.14");
    expect(2, "$T $D/s.json --guides 99999 -o $D/a.png", "guide_count");
}

static void driver_older_than_4_5_exits_with_3(void** state)
{
    (void)state;
    expect(3,
           "LIBGL_ALWAYS_SOFTWARE=1 GALLIUM_DRIVER=softpipe $T $D/small.json --samples 1 --frames 0:1 -o "
           "$D/a.png",
           "no EGL device gives OpenGL 4.5 core");
    expect(1, "test -e $D/a.png", "");
}

static int start(void** state)
{
    (void)state;
    return hair_test_shell_start_capture(TOOL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(wrong_use_exits_with_2),
        cmocka_unit_test(unusable_input_exits_with_4_and_its_position),
        cmocka_unit_test(bad_scene_beside_settings_of_the_command_line_exits_with_4),
        cmocka_unit_test(driver_older_than_4_5_exits_with_3),
    };
    return cmocka_run_group_tests(tests, start, hair_test_shell_finish);
}
