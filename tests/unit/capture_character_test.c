// capture_character_test.c - hair-capture films a skinned character: the animation repeats, the
// camera follows, and what a scene cannot have is refused.
#include "tests/support/shell.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <cmocka.h>

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "tests/support/golden.h"

#define TOOL HAIR_BUILD_DIR "/hair-capture"
#define SIZE 64

// Write a scene of the walking character with some more members, which may be "".
static void write_scene(const char* name, const char* character, const char* more)
{
    char folder[512];
    FILE* file = hair_test_shell_create(name, ".json");
    assert_non_null(getcwd(folder, sizeof folder));
    fprintf(file, "{\"character\": {\"file\": \"%s/tools/scenes/walker.glb\"%s}%s, ", folder, character,
            more);
    fprintf(file, "\"size\": [%d, %d], \"settings\": {\"guides\": 16, \"followers\": 16}}", SIZE, SIZE);
    assert_int_equal(fclose(file), 0);
}

static void read_picture(const char* name, uint8_t pixels[3 * SIZE * SIZE])
{
    char path[512];
    snprintf(path, sizeof path, "%s/%s", hair_test_folder(), name);
    hair_test_read_png(path, pixels, SIZE, SIZE);
}

// Return the mean difference of two pictures, in levels of 255.
static double compare(const char* one, const char* other)
{
    static uint8_t a[3 * SIZE * SIZE], b[3 * SIZE * SIZE];
    long sum = 0;
    read_picture(one, a);
    read_picture(other, b);
    for (int i = 0; i < 3 * SIZE * SIZE; ++i) sum += abs(a[i] - b[i]);
    return (double)sum / (3 * SIZE * SIZE);
}

// Draw the body only at the start, in the middle and at the end of the animation, 2.2 s later. The
// body has walked 2.6 m by then.
static void animation_repeats_and_the_camera_follows(void** state)
{
    (void)state;
    write_scene("walk", "", ", \"show\": \"head\"");
    write_scene("stay", ", \"follow\": false", ", \"show\": \"head\"");
    hair_test_shell_expect(
        0, "$T $D/walk.json --samples 1 --fps 10 --frames 0:23 --quiet -o $D/walk_%02d.png", "");
    hair_test_shell_expect(0, "$T $D/stay.json --samples 1 --fps 10 --frames 22:23 --quiet -o $D/stay.png",
                           "");
    double again = compare("walk_00.png", "walk_22.png"), half = compare("walk_00.png", "walk_06.png");
    double away = compare("walk_00.png", "stay.png");
    printf(
        "    pictures differ by %.2f levels after one animation, %.2f within it, %.2f without the camera\n",
        again, half, away);
    assert_true(again < 0.3 && half > 3 && away > 3);
}

// Hair covers the head of the character.
static void hair_is_drawn_on_the_head(void** state)
{
    (void)state;
    write_scene("hair", "", ", \"picture\": 2");
    write_scene("bald", "", ", \"picture\": 2, \"show\": \"head\"");
    hair_test_shell_expect(
        0, "$T $D/hair.json --followers 2000 --set strand.radius=0.001 --samples 1 --quiet -o $D/hair.png",
        "");
    hair_test_shell_expect(0, "$T $D/bald.json --samples 1 --quiet -o $D/bald.png", "");
    double covered = compare("hair.png", "bald.png");
    printf("    pictures with and without hair differ by %.2f levels\n", covered);
    assert_true(covered > 3);
}

static void wrong_characters_are_refused_with_their_place(void** state)
{
    (void)state;
    static const struct {
        const char *character, *more, *words;
    } wrong[] = {
        {", \"head\": \"tail\"", "", "walker.glb: there is no node tail"},
        {", \"animation\": 1", "", "walker.glb: character.animation is 1, but the file has 1 animations"},
        {", \"animation\": \"run\"", "",
         "walker.glb: character.animation is run, but the file has 1 animations"},
        {", \"scale\": 0", "", "character.scale must be a number in [0.0001, 10000]"},
        {", \"speed\": 2", "", "there is no character.speed"},
        {"", ", \"motion\": \"shake\"", "motion must be left out beside a character"},
        {"", ", \"head\": true", "head must be false or left out beside a character"},
        {"", ", \"fur\": {}", "fur must be left out beside a character"},
    };
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; ++i) {
        write_scene("wrong", wrong[i].character, wrong[i].more);
        hair_test_shell_expect(4, "$T $D/wrong.json -o $D/wrong.png", wrong[i].words);
    }
    write_scene("wrong", "", "");
    hair_test_shell_expect(2, "$T $D/wrong.json --solver redblack -o $D/wrong.png",
                           "redblack knows no bodies");
}

static int start(void** state)
{
    (void)state;
    return hair_test_shell_start(TOOL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(animation_repeats_and_the_camera_follows),
        cmocka_unit_test(hair_is_drawn_on_the_head),
        cmocka_unit_test(wrong_characters_are_refused_with_their_place),
    };
    return cmocka_run_group_tests(tests, start, hair_test_shell_finish);
}
