// view_character_test.c - hair-view shows the skinned character of a scene, its camera follows, and
// solvers without bodies that deform are refused.
#include "tests/support/shell.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <cmocka.h>

#include <unistd.h>

#include "tests/support/golden.h"

#define TOOL HAIR_BUILD_DIR "/hair-view"
#define WIDTH 900
#define HEIGHT 600
#define RUN "--size 900x600 --scale 1 --quality 4 --script $D/s --frames "

// Write a scene of the walking character with some more members of the character.
static void write_scene(const char* name, const char* character)
{
    char folder[512];
    FILE* file = hair_test_shell_create(name, ".json");
    assert_non_null(getcwd(folder, sizeof folder));
    fprintf(file, "{\"style\": \"long\", \"character\": {\"file\": \"%s/tools/scenes/walker.glb\"%s}, ",
            folder, character);
    fprintf(file, "\"settings\": {\"guides\": 16, \"followers\": 16}}");
    assert_int_equal(fclose(file), 0);
}

static void write_script(const char* text)
{
    FILE* file = hair_test_shell_create("s", "");
    fputs(text, file);
    assert_int_equal(fclose(file), 0);
}

// Return the fraction of the picture that the blue shirt of the character covers. The picture is
// between the panels.
static double find_shirt(const char* name)
{
    static uint8_t pixels[3 * WIDTH * HEIGHT];
    char path[512];
    int covered = 0, all = 0;
    snprintf(path, sizeof path, "%s/%s", hair_test_folder(), name);
    hair_test_read_png(path, pixels, WIDTH, HEIGHT);
    for (int y = 0; y < 420; ++y)
        for (int x = 280; x < 530; ++x) {
            const uint8_t* p = pixels + 3 * (y * WIDTH + x);
            covered += p[2] > p[0] + 30;
            ++all;
        }
    return (double)covered / all;
}

static void character_walks_and_the_camera_follows(void** state)
{
    (void)state;
    write_scene("walk", "");
    write_scene("stay", ", \"follow\": false");
    write_script("wait 1\n");
    hair_test_shell_expect(0, "$T $D/walk.json " RUN "2 --shot $D/first.png", "");
    hair_test_shell_expect(0, "$T $D/walk.json " RUN "45 --shot $D/later.png", "");
    hair_test_shell_expect(0, "$T $D/stay.json " RUN "45 --shot $D/stay.png", "");
    double first = find_shirt("first.png"), later = find_shirt("later.png"), stay = find_shirt("stay.png");
    printf("    the shirt covers %.2f of the picture, %.2f later, and %.2f when the camera stays\n", first,
           later, stay);
    assert_true(first > 0.2 && first < 0.6);
    assert_true(later > 0.8 * first && later < 1.25 * first);
    assert_true(stay < 0.5 * first);
}

// The hair is put at rest, and a solver without bodies is taken back, while the character walks.
static void hair_starts_again_on_a_walking_character(void** state)
{
    (void)state;
    write_scene("walk", "");
    write_script("wait 30\nkey R\nwait 5\nkey X\nwait 5\n");
    hair_test_shell_expect(0, "$T $D/walk.json " RUN "60 --shot $D/again.png", "");
    assert_true(find_shirt("again.png") > 0.2);
}

static void solvers_without_bodies_are_refused(void** state)
{
    (void)state;
    write_scene("walk", "");
    write_script("wait 1\n");
    hair_test_shell_expect(2, "$T $D/walk.json --set solver=redblack " RUN "2",
                           "the solver redblack knows no bodies that deform");
}

static int start(void** state)
{
    (void)state;
    return hair_test_shell_start_capture(TOOL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(character_walks_and_the_camera_follows),
        cmocka_unit_test(hair_starts_again_on_a_walking_character),
        cmocka_unit_test(solvers_without_bodies_are_refused),
    };
    return cmocka_run_group_tests(tests, start, hair_test_shell_finish);
}
