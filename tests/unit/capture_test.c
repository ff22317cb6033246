// capture_test.c - the command line of hair-capture: options, scenes, layers, and exit codes of
// wrong use and of unusable input.
#define _XOPEN_SOURCE 700
#include "tests/support/shell.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <cmocka.h>

#include <hair/hair_members.h>

#define TOOL HAIR_BUILD_DIR "/hair-capture"

// The least hair and the fewest pixels that suffice. The head takes longest to make.
#define SMALL "$D/small.json --samples 1"
#define FEW "--size 64x36 --followers 300 --samples 1"
#define WITH_HEAD "--size 64x36 --followers 300 --guides 32 --samples 1 --set redblack.iterations=2"

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

static void help_and_version_are_printed_on_the_standard_output(void** state)
{
    (void)state;
    expect(0, "$T --help 2>/dev/null", "gravity.y                        -9.81");
    assert_non_null(strstr(hair_test_said, "Scenes: demo"));
    expect(0, "$T --version 2>/dev/null", "hair-capture 0.");
    hair_test_shell_expect_full("--help");
    hair_test_shell_expect_full("--version");
}

static void culling_behind_the_head_keeps_the_picture(void** state)
{
    (void)state;
    expect(0, "$T --scene demo " WITH_HEAD " --frames 0:1 --hash > $D/all.txt", "");
    expect(0, "$T --scene demo " WITH_HEAD " --frames 0:1 --set hide=on --hash | cmp - $D/all.txt", "");
    expect(0, "$T --scene demo " WITH_HEAD " --frames 0:1 --set hide=on --stats - | grep -A1 '\"occlusion\"'",
           "done");
}

static void every_number_of_the_physics_can_be_set(void** state)
{
    (void)state;
    hair_member members[64];
    uint32_t count = hair_describe(HAIR_STRUCT_PHYSICS, members, 64, sizeof *members);
    expect(0, "$T --help", "Settings for --set");
    for (uint32_t i = 0; i < count; ++i)
        for (uint32_t k = 0; k < members[i].count; ++k) {
            char line[64];
            snprintf(line, sizeof line, "\n  %s%s%s ", members[i].name, members[i].elements ? "." : "",
                     members[i].elements ? members[i].elements[k] : "");
            if (!strstr(hair_test_said, line)) fail_msg("--set has no%s", line + 2);
        }
    assert_true(count >= 24);
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
    expect(3, "LIBGL_ALWAYS_SOFTWARE=1 GALLIUM_DRIVER=softpipe $T " SMALL " --frames 0:1 -o $D/a.png",
           "no EGL device gives OpenGL 4.5 core");
    expect(1, "test -e $D/a.png", "");
}

static void shown_layers_are_those_of_the_show_option(void** state)
{
    (void)state;
    static const char* const what[] = {"hair",        "colliders",      "head",
                                       "hair,guides", "hair,colliders", "colliders --set slice=z"};
    expect(
        0,
        "sed 's/{/{\"colliders\": [{\"shape\": \"sphere\", \"position\": [0, 1.6, 0.1]}], /' $D/small.json "
        ">$D/ball.json",
        "");
    for (size_t i = 0; i < sizeof what / sizeof *what; ++i) {
        char command[256];
        snprintf(command, sizeof command,
                 "$T $D/ball.json --samples 1 --frames 0:1 --hash --show %s | grep pixels >>$D/shown",
                 what[i]);
        expect(0, command, "");
    }
    expect(0, "sort -u $D/shown | wc -l", "6");
    // The default equals "hair".
    expect(0, "$T $D/ball.json --samples 1 --frames 0:1 --hash | grep -c -f $D/shown", "1");
    expect(0, "rm $D/shown $D/ball.json", "");
}

// Check wind by the hash of pixels. It must change hair, also after a step, and the picture of the
// wind itself, with a velocity or a source.
static void wind_of_a_scene_moves_hair_and_can_be_shown(void** state)
{
    (void)state;
    static const char* const winds[] = {"\"velocity\": [4, 0, 0]",
                                        "\"velocity\": [4, 0, 0], \"turbulence.intensity\": 0.5",
                                        "\"sources\": [{\"position\": [0.3, 1.6, 0], \"speed\": 9}]"};
    for (int i = 0; i < 3; ++i) {
        char command[512];
        snprintf(
            command, sizeof command,
            "sed 's/{/{\"wind\": {%s}, /' $D/small.json >$D/blown.json && for show in hair wind; do "
            "$T $D/blown.json --samples 1 --frames 1:2 --hash --show $show | grep pixels >>$D/shown; done",
            winds[i]);
        expect(0, command, "");
    }
    expect(0, "$T $D/small.json --samples 1 --frames 1:2 --hash --show hair | grep pixels >>$D/shown", "");
    expect(0, "test $(sort -u $D/shown | wc -l) = 7 && rm $D/shown $D/blown.json", "");
}

// Check that every kind of motion leads to the same place. The picture equals that of a collider at
// rest there.
static void colliders_follow_their_keyframes(void** state)
{
    (void)state;
    static const char* const ways[] = {
        "\"position\": [0.1, 1.6, 0.2], \"rotation\": [0, 0.70710678, 0, 0.70710678]",
        "\"position\": [0, 1.6, 0.2], \"velocity\": [1, 0, 0], \"spin\": [0, 900, 0]",
        ("\"position\": [0, 1.6, 0.2], \"motion\": [{\"time\": 0.1, \"rotation\": [90, 0, 0], "
         "\"position\": [0.1, 0, 0]}]")};
    for (int i = 0; i < 3; ++i) {
        char command[640];
        snprintf(command, sizeof command,
                 "sed 's/{/{\"colliders\": [{\"shape\": \"cone\", \"radius\": 0.05, \"half_length\": 0.1, "
                 "\"rounding\": 0.01, \"stays\": true, %s}], /' $D/small.json >$D/moved.json",
                 ways[i]);
        expect(0, command, "");
        expect(0, "$T $D/moved.json --samples 1 --frames 3:4 --show colliders -o $D/way.png", "");
        snprintf(command, sizeof command, "mv $D/way.png $D/way%d.png", i);
        expect(0, command, "");
    }
    expect(0, "cmp $D/way0.png $D/way1.png && cmp $D/way0.png $D/way2.png && rm $D/way?.png $D/moved.json",
           "");
}

static void each_solver_can_be_selected(void** state)
{
    (void)state;
    static const char* const solvers[] = {"direct", "accurate", "follow", "redblack"};
    static const char* const passes[] = {"mixed", "mixed", "follow", "redblack"};
    for (int i = 0; i < 4; ++i) {
        char command[256], method[64];
        snprintf(command, sizeof command, "$T " SMALL " --frames 0:2 --solver %s --stats -", solvers[i]);
        snprintf(method, sizeof method, "\"method\": \"sim/%s", passes[i]);
        expect(0, command, method);
    }
    expect(0, "$T " SMALL " --frames 0:2 --set thread_mapping=workgroup_per_guide --stats -",
           "\"method\": \"sim/mixed_32");
    expect(0, "$T " SMALL " --frames 0:2 --set thread_mapping=thread_per_guide --stats -",
           "\"method\": \"sim/mixed_thread_per_guide_32");
}

static void scene_files_and_options_are_equivalent(void** state)
{
    (void)state;
    expect(
        0,
        "echo '{\"style\": \"bob\", \"motion\": \"turn\", \"size\": [64, 36], \"fps\": 20, \"frames\": 2,"
        " \"camera\": {\"eye\": [0, 1.6, 1.2], \"target\": [0, 1.5, 0]}, \"light\": {\"color\": [2, 2, 2]},"
        " \"settings\": {\"followers\": 300, \"gravity.y\": -5, \"primitive\": \"lines\", \"solver\": "
        "\"follow\","
        " \"preset\": \"wet\", \"fiber.youngs_modulus\": 1e9, \"root\": \"hinged\", \"wind.z\": 2}}' "
        ">$D/s.json",
        "");
    expect(
        0,
        "$T $D/s.json --hash >$D/1 && echo '{\"style\": \"bob\", \"motion\": \"turn\", \"frames\": 2,"
        " \"camera\": {\"eye\": [0, 1.6, 1.2], \"target\": [0, 1.5, 0]}}' >$D/t.json && $T $D/t.json --hash"
        " --size 64x36 --fps 20 --followers 300 --set gravity.y=-5 --primitive lines --solver follow"
        " --set preset=wet --set fiber.youngs_modulus=1e9 --set root=hinged --set wind.z=2 --set light.r=2"
        " --set light.g=2 --set light.b=2 >$D/2 && cmp $D/1 $D/2",
        "");
}

static void settings_of_a_group_apply_to_its_strands(void** state)
{
    (void)state;
    static const char* const sets[] = {"", "--set tip_mass=2", "--set groups.0.tip_mass=2",
                                       "--set groups.0.radius=3",
                                       "--set groups.0.color.enabled=on --set groups.0.color.tip.b=1"};
    expect(0,
           "echo '{\"style\": \"bob\", \"settings\": {\"groups.0.tip_mass\": 2}}' >$D/s.json && "
           "echo '{\"style\": \"bob\"}' >$D/t.json",
           "");
    for (int i = 0; i < 5; ++i) {
        char command[256];
        snprintf(command, sizeof command, "$T $D/t.json " FEW " --frames 1:2 --hash %s >$D/h%d", sets[i], i);
        expect(0, command, "");
    }
    expect(0, "cmp $D/h1 $D/h2 && $T $D/s.json " FEW " --frames 1:2 --hash | cmp - $D/h1", "");
    expect(0, "cat $D/h0 $D/h1 $D/h3 $D/h4 | grep pixels | sort -u | wc -l", "4");
    expect(4, "$T " SMALL " --frames 0:1 --hash --solver redblack --set groups.0.tip_mass=2",
           "physics of groups cannot differ with the solver redblack");
}

// The strands of the file are in the groups 0, 7, 3 and 0.
static void groups_of_a_groom_file_have_settings_of_their_own(void** state)
{
    (void)state;
    static const char* const sets[] = {"", "--set groups.7.radius=4", "--set groups.5.radius=4",
                                       "--set groups.3.tip_mass=4"};
    expect(0, "cp tests/fuzz/corpus/groomfile/whole $D/whole.groom", "");
    for (int i = 0; i < 4; ++i) {
        char command[256];
        snprintf(command, sizeof command,
                 "$T --groom $D/whole.groom " FEW " --motion turn --frames 3:4 --hash %s >$D/g%d", sets[i],
                 i);
        expect(0, command, "");
    }
    expect(0, "cmp $D/g0 $D/g2 && ! cmp -s $D/g0 $D/g1", "");
    expect(0, "grep -h strands $D/g0 $D/g1 | sort -u | wc -l", "1");
    expect(0, "grep -h strands $D/g0 $D/g3 | sort -u | wc -l", "2");
}

static void haircut_files_are_found_beside_their_scene_and_framed(void** state)
{
    (void)state;
    expect(0, "TOOL=$(dirname $T)/hair-groom; $TOOL generate bob $D/bob.tfx --vertices 16 --guides 64", "");
    expect(0, "$T --groom $D/bob.tfx " FEW " --frames 0:2 --hash >$D/1", "");
    expect(
        0,
        "echo '{\"groom\": \"bob.tfx\", \"motion\": \"turn\", \"frames\": 2, \"size\": [64, 36]}' >$D/s.json",
        "");
    expect(0, "cd / && $T $D/s.json --followers 300 --samples 1 --hash >$D/2 && cmp $D/1 $D/2", "");
    expect(0, "$T --groom $D/bob.tfx --head " FEW " --frames 0:2 --hash >$D/2 && ! cmp -s $D/1 $D/2", "");
}

static void the_unit_of_a_file_is_guessed_from_its_longest_strand(void** state)
{
    (void)state;
    expect(0,
           "TOOL=$(dirname $T)/hair-groom; $TOOL generate bob $D/m.tfx --vertices 16 --guides 64 && "
           "$TOOL convert $D/m.tfx $D/cm.tfx --scale 100",
           "");
    expect(0, "$T --groom $D/cm.tfx " FEW " --frames 0:2 --hash", "taken to be 0.01 m each");
    expect(0, "$T --groom $D/cm.tfx --scale 0.01 " FEW " --frames 0:2 --hash >$D/1 2>&1", "");
    expect(0, "$T --groom $D/cm.tfx " FEW " --frames 0:2 --hash >$D/2 2>/dev/null && cmp $D/1 $D/2", "");
}

static void fur_stands_on_a_ball(void** state)
{
    (void)state;
    expect(0,
           "echo '{\"fur\": {\"strands\": 2000, \"length\": 0.03}, \"motion\": \"shake\"}' >$D/s.json; "
           "$T $D/s.json --frames 1:2 --size 64x36 --stats - --quiet",
           "\"strands\": 2000");
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
        cmocka_unit_test(help_and_version_are_printed_on_the_standard_output),
        cmocka_unit_test(culling_behind_the_head_keeps_the_picture),
        cmocka_unit_test(every_number_of_the_physics_can_be_set),
        cmocka_unit_test(unusable_input_exits_with_4_and_its_position),
        cmocka_unit_test(bad_scene_beside_settings_of_the_command_line_exits_with_4),
        cmocka_unit_test(driver_older_than_4_5_exits_with_3),
        cmocka_unit_test(shown_layers_are_those_of_the_show_option),
        cmocka_unit_test(wind_of_a_scene_moves_hair_and_can_be_shown),
        cmocka_unit_test(colliders_follow_their_keyframes),
        cmocka_unit_test(each_solver_can_be_selected),
        cmocka_unit_test(scene_files_and_options_are_equivalent),
        cmocka_unit_test(settings_of_a_group_apply_to_its_strands),
        cmocka_unit_test(groups_of_a_groom_file_have_settings_of_their_own),
        cmocka_unit_test(haircut_files_are_found_beside_their_scene_and_framed),
        cmocka_unit_test(the_unit_of_a_file_is_guessed_from_its_longest_strand),
        cmocka_unit_test(fur_stands_on_a_ball),
    };
    return cmocka_run_group_tests(tests, start, hair_test_shell_finish);
}
