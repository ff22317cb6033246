// capture_test.c - the command line of hair-capture: options, scenes, layers and settings.
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

static void every_strand_is_a_guide_on_demand(void** state)
{
    (void)state;
    expect(0, "$T --style bob " FEW " --guides 32 --frames 0:2 --set every_strand=on --stats -",
           "\"guides\": 300");
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

static void fur_is_combed(void** state)
{
    (void)state;
    for (int comb = 0; comb < 3; ++comb) {
        static const char* const combs[] = {"", ", \"comb\": [0, -0.5, 0]", ", \"comb\": [2, 0, 0]"};
        char command[256];
        snprintf(command, sizeof command,
                 "echo '{\"fur\": {\"strands\": 500%s}, \"motion\": \"still\"}' >$D/s.json; "
                 "$T $D/s.json --frames 0:1 --size 64x36 --hash >$D/%d",
                 combs[comb], comb);
        expect(0, command, "");
    }
    expect(0, "cmp $D/0 $D/1", "");
    expect(1, "cmp $D/0 $D/2", "differ");
    expect(4, "echo '{\"fur\": {\"comb\": [0, 20, 0]}}' >$D/s.json; $T $D/s.json --hash",
           "fur.comb[1] must be a number in [-10, 10]");
}

static int start(void** state)
{
    (void)state;
    return hair_test_shell_start_capture(TOOL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(help_and_version_are_printed_on_the_standard_output),
        cmocka_unit_test(culling_behind_the_head_keeps_the_picture),
        cmocka_unit_test(every_strand_is_a_guide_on_demand),
        cmocka_unit_test(every_number_of_the_physics_can_be_set),
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
        cmocka_unit_test(fur_is_combed),
    };
    return cmocka_run_group_tests(tests, start, hair_test_shell_finish);
}
