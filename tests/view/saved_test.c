// saved_test.c - scenes that hair-view saves are equal to those that it has opened.
#include "tests/support/shell.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <cmocka.h>

#define TOOL HAIR_BUILD_DIR "/hair-view"
#define expect hair_test_shell_expect

static void write_file(const char* name, const char* text)
{
    FILE* file = hair_test_shell_create(name, "");
    fputs(text, file);
    fclose(file);
}

// A scene with every key but those of haircut files.
static const char whole[] =
    "{\"style\": \"bob\", \"head\": true, \"maps\": [{\"density\": [\"09\", \"91\"], \"thickness\": "
    "[\"36\"]}],"
    " \"attributes\": [{\"kind\": \"length\", \"map\": [\"09\", \"91\"], \"range\": [0.3, 0.9]}],"
    " \"motion\": [{\"time\": 0}, {\"time\": 0.5, \"rotation\": [30, 0.1, 4], \"position\": [0, 0.01, 0]}],"
    " \"pivot\": [0, 1.4, 0.02], \"pose\": {\"rotation\": [3, 2, 1], \"position\": [0.01, 0, 0]},"
    " \"camera\": {\"eye\": [0.3, 1.7, 1.1], \"target\": [0, 1.5, 0.013], \"fov\": 31},"
    " \"light\": {\"direction\": [1, 2, 3], \"color\": [1, 2, 4], \"ambient\": [0.1, 0.2, 0.3], \"shadow\": "
    "false},"
    " \"lights\": [{\"kind\": \"spot\", \"position\": [0, 2, 1], \"direction\": [0, 1, 1], \"range\": 9, "
    "\"color\":"
    " [5, 5, 5], \"source_radius\": 0.1, \"inner_angle\": 0.2, \"outer_angle\": 0.4, \"shadow\": true}],"
    " \"wind\": {\"velocity\": [2, 0, 0.1], \"turbulence.intensity\": 0.3, \"sources\": [{\"position\": [1, "
    "1, 1],"
    " \"direction\": [-1, 0, 0], \"speed\": 5, \"radius\": 0.2}]},"
    " \"colliders\": [{\"shape\": \"box\", \"position\": [0.1, 1.5, 0], \"rotation\": [0, 0, 0.6, 0.8], "
    "\"size\":"
    " [0.05, 0.02, 0.03], \"rounding\": 0.01, \"friction\": 0.5, \"velocity\": [0.1, 0, 0], \"spin\": [0, "
    "90, 0],"
    " \"stays\": true, \"motion\": [{\"time\": 0}, {\"time\": 1, \"position\": [0, 0.1, 0]}]}],"
    " \"background\": {\"centre\": [0.2, 0.1, 0.1], \"edge\": [0, 0.1, 0]}, \"exposure\": 1.25, \"settle\": "
    "0.1,"
    " \"fps\": 24, \"frames\": 12, \"picture\": 3, \"size\": [64, 36], \"show\": \"guides\","
    " \"settings\": {\"guides\": 16, \"followers\": 100, \"seed\": 3, \"lod\": \"on\", \"hide\": \"on\", "
    "\"every_strand\": \"on\","
    " \"strand.taper\": \"1,0.98765432,0.9,0.8,0.71234567,0.61234567,0.51234567,0.41234567\", \"gravity.y\": "
    "-1.6, \"groups.0.tip_mass\": 0.5, \"groups.0.color.enabled\": \"on\"}}";

// Objects of Bullet, with a mesh whose path is relative to the scene.
static const char objects[] =
    "{\"style\": \"bob\", \"show\": \"guides\", \"bullet\": [{\"shape\": \"sphere\", \"radius\": 0.05, "
    "\"position\": [0.1, 1.5, 0]},"
    " {\"shape\": \"mesh\", \"mesh\": \"cube.obj\", \"position\": [0, 1.3, 0.2]}], "
    "\"settings\": {\"guides\": 16,"
    " \"followers\": 100}}";
static const char cube[] = "v 0 0 0\nv 0.1 0 0\nv 0 0.1 0\nv 0 0 0.1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

// Words that the saved file of `whole` must contain, because drawing guides does not show all.
static const char* const kept[] = {
    "maps",         "thickness",    "attributes", "range",       "motion",   "pivot",     "pose",
    "fov",          "lights",       "spot",       "inner_angle", "sources",  "colliders", "rounding",
    "friction",     "spin",         "stays",      "centre",      "exposure", "settle",    "fps",
    "frames",       "picture",      "size",       "show",        "seed",     "lod",       "hide",
    "every_strand", "strand.taper", "gravity.y",  "ambient.g",   "tip_mass", "0.color"};

// Scenes are saved, dropped on the window, and saved again. Captures of both files must be equal.
static void saved_scenes_load_into_equal_scenes(void** state)
{
    (void)state;
    char script[1024];
    const char* folder = hair_test_folder();
    expect(0, "mkdir $D/saved", "");
    write_file("whole.json", whole);
    write_file("objects.json", objects);
    write_file("cube.obj", cube);
    snprintf(script, sizeof script,
             "key P\nsave %s/saved/1.json\ndrop %s/saved/1.json\nwait 2\nsave %s/saved/2.json\n", folder,
             folder, folder);
    write_file("s", script);
    for (int i = 0; i < 1 + HAIR_BULLET; ++i) {
        char command[512];
        snprintf(
            command, sizeof command,
            "$T $D/%s.json --size 300x300 --script $D/s --frames 8 && cmp $D/saved/1.json $D/saved/2.json && "
            "for scene in %s saved/1; do " HAIR_BUILD_DIR
            "/hair-capture $D/$scene.json --frames 0:2 --size 64x36 --samples 1 --hash >>$D/hashes%d; done; "
            "sort -u $D/hashes%d | wc -l | grep -x 2",
            i ? "objects" : "whole", i ? "objects" : "whole", i, i);
        expect(0, command, "");
        for (size_t k = 0; !i && k < sizeof kept / sizeof *kept; ++k) {
            snprintf(command, sizeof command, "grep -qF '%s' $D/saved/1.json || { echo %s; false; }", kept[k],
                     kept[k]);
            expect(0, command, "");
        }
    }
}

static int start(void** state)
{
    (void)state;
    return hair_test_shell_start(TOOL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(saved_scenes_load_into_equal_scenes),
    };
    return cmocka_run_group_tests(tests, start, hair_test_shell_finish);
}
