// capture_cut_test.c - cuts in scenes of hair-capture: hair is missing where it was cut, and falls
// below.
#include "tests/support/shell.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <cmocka.h>

#include <stdlib.h>
#include <string.h>

#include "tests/support/golden.h"

#define TOOL HAIR_BUILD_DIR "/hair-capture"
#define SIZE 64

// Write a scene with a ball of fur in black on white, without a shadow. `cuts` may be "".
static void write_scene(const char* name, const char* cuts)
{
    FILE* file = hair_test_shell_create(name, ".json");
    fprintf(file, "{\"fur\": {\"strands\": 400, \"length\": 0.1, \"ball\": 0.05}, %s ", cuts);
    fprintf(file, "\"fps\": 30, \"frames\": 9, \"picture\": 6, \"size\": [%d, %d], \"show\": \"hair\", ",
            SIZE, SIZE);
    fprintf(file, "\"light\": {\"color\": [0, 0, 0], \"ambient\": [0, 0, 0], \"shadow\": false}, ");
    fprintf(file, "\"background\": {\"centre\": [1, 1, 1], \"edge\": [1, 1, 1]}, ");
    fprintf(file, "\"camera\": {\"eye\": [0, 0, 1], \"target\": [0, 0, 0], \"fov\": 27}}");
    assert_int_equal(fclose(file), 0);
}

// Count the dark pixels of some rows of a picture.
static int count_dark(const char* name, int from, int to)
{
    static uint8_t pixels[3 * SIZE * SIZE];
    char path[512];
    snprintf(path, sizeof path, "%s/%s", hair_test_folder(), name);
    hair_test_read_png(path, pixels, SIZE, SIZE);
    int dark = 0;
    for (int i = from * SIZE; i < to * SIZE; ++i) dark += pixels[3 * i] < 128;
    return dark;
}

static void capture(const char* name, const char* cuts)
{
    char command[512];
    write_scene(name, cuts);
    snprintf(command, sizeof command,
             "$T $D/%s.json --samples 1 --quiet --set strand.radius=0.0015 -o $D/%s.png", name, name);
    hair_test_shell_expect(0, command, "");
}

// The picture is 48 cm high. The cut is at its middle. The pieces are 2 cm lower after 1/15 s.
static void cut_hair_is_missing_and_falls(void** state)
{
    (void)state;
    capture("whole", "");
    capture("cut", "\"cuts\": [{\"frame\": 4, \"start\": [0, -0.02, 0], \"pieces\": false}],");
    capture("falls", "\"cuts\": [{\"frame\": 4, \"start\": [0, -0.02, 0]}],");
    int whole = count_dark("whole.png", 40, SIZE), cut = count_dark("cut.png", 40, SIZE);
    int falls = count_dark("falls.png", 40, SIZE);
    printf("below the cut are %d dark pixels, %d without the pieces, and %d with them\n", whole, cut, falls);
    assert_true(whole > 50 && cut < whole / 20 && falls > whole / 2);
    assert_true(abs(count_dark("cut.png", 0, 30) - count_dark("whole.png", 0, 30)) < 8);
}

static void wrong_cuts_are_refused_with_their_place(void** state)
{
    (void)state;
    write_scene("wrong", "\"cuts\": [{}, {\"shape\": \"axe\"}],");
    hair_test_shell_expect(4, "$T $D/wrong.json -o $D/wrong.png", "cuts[1].shape must be \"plane\", ");
    write_scene("wrong", "\"cuts\": [{\"radius\": -1}],");
    hair_test_shell_expect(4, "$T $D/wrong.json -o $D/wrong.png", "cuts[0].radius must be");
}

static int start(void** state)
{
    (void)state;
    return hair_test_shell_start(TOOL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(cut_hair_is_missing_and_falls),
        cmocka_unit_test(wrong_cuts_are_refused_with_their_place),
    };
    return cmocka_run_group_tests(tests, start, hair_test_shell_finish);
}
