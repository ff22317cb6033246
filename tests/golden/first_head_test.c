// first_head_test.c - the example for newcomers fits into a page and draws the picture of the
// earlier run.
//
// The test contains the example, and takes the picture in place of showing it.
#include "tests/support/golden.h"
#include "tests/support/support.h"

#include <SDL.h>
#include <epoxy/gl.h>

#define WIDTH 640
#define HEIGHT 480
#define FRAMES 2
#define MAX_LINES 120

static uint8_t pixels[HEIGHT][WIDTH][3];
static int frames;

// Read the picture from top to bottom, and end the example after some frames.
static void take_picture(SDL_Window* window)
{
    static uint8_t upward[HEIGHT][WIDTH][3];
    SDL_Event quit = {.type = SDL_QUIT};
    int width, height;
    SDL_GL_GetDrawableSize(window, &width, &height);
    assert_true(width == WIDTH && height == HEIGHT);
    if (++frames != FRAMES) return;
    assert_int_equal(glGetError(), GL_NO_ERROR);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadPixels(0, 0, WIDTH, HEIGHT, GL_RGB, GL_UNSIGNED_BYTE, upward);
    for (int y = 0; y < HEIGHT; ++y) memcpy(pixels[y], upward[HEIGHT - 1 - y], sizeof pixels[y]);
    SDL_FlushEvents(SDL_FIRSTEVENT, SDL_LASTEVENT);
    SDL_PushEvent(&quit);
}

int run_first_head(void);
#define SDL_GL_SwapWindow take_picture
#undef main
#define main run_first_head
#include "tools/examples/first_head.c"
#undef main

static void first_head_has_at_most_120_lines(void** state)
{
    (void)state;
    FILE* file = fopen("tools/examples/first_head.c", "r");
    int lines = 0;
    assert_non_null(file);
    for (int c; (c = fgetc(file)) != EOF;) lines += c == '\n';
    fclose(file);
    assert_in_range(lines, 1, MAX_LINES);
}

// Reduce the picture to half its size.
static void reduce(uint8_t out[HEIGHT / 2][WIDTH / 2][3])
{
    for (int y = 0; y < HEIGHT / 2; ++y)
        for (int x = 0; x < WIDTH / 2; ++x)
            for (int c = 0; c < 3; ++c) {
                int sum = pixels[2 * y][2 * x][c] + pixels[2 * y][2 * x + 1][c];
                sum += pixels[2 * y + 1][2 * x][c] + pixels[2 * y + 1][2 * x + 1][c];
                out[y][x][c] = (uint8_t)((sum + 2) / 4);
            }
}

static void first_head_draws_its_golden_picture(void** state)
{
    (void)state;
    static uint8_t half[HEIGHT / 2][WIDTH / 2][3];
    SDL_SetHint(SDL_HINT_VIDEODRIVER, "offscreen");
    assert_int_equal(run_first_head(), 0);
    assert_true(frames >= FRAMES);
    reduce(half);
    assert_true(hair_test_distinct_colors(half[0][0], WIDTH / 2, HEIGHT / 2) >= 100);
    hair_test_golden("first_head", half[0][0], WIDTH / 2, HEIGHT / 2);
}

// Linear light l is stored as sRGB: the background of 0.16, 0.19, 0.24 as 111, 121, 134, and skin
// that faces the sun as half its reflectance times 3.35 / pi.
static void first_head_has_the_right_brightness(void** state)
{
    (void)state;
    const uint8_t* background = pixels[4][4];
    const int expected[3] = {111, 121, 134};
    int brightest = 0;
    for (int c = 0; c < 3; ++c) assert_in_range(background[c], expected[c] - 1, expected[c] + 1);
    for (int y = 100; y < 230; ++y)
        for (int x = 265; x < 375; ++x) brightest = pixels[y][x][0] > brightest ? pixels[y][x][0] : brightest;
    assert_in_range(brightest, 190, 196);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(first_head_has_at_most_120_lines),
        cmocka_unit_test(first_head_draws_its_golden_picture),
        cmocka_unit_test(first_head_has_the_right_brightness),
    };
    if (hair_test_skips()) return 0;
    return cmocka_run_group_tests(tests, NULL, NULL);
}
