// examples_test.c - Every program of tools/examples/ runs and draws the picture of the earlier run.
//
// HAIR_BLESS=1 writes the goldens anew. Look at them before committing.
#include "tests/support/golden.h"
#include "tests/support/support.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>

#define WIDTH 256
#define HEIGHT 192

// Leaks of the driver are not the example's, so a sanitizer must not report them.
#define ENVIRONMENT "ASAN_OPTIONS=detect_leaks=0 SDL_VIDEODRIVER=offscreen "

static const char* const names[] = {
    "offscreen",    "shadows",          "level_of_detail", "own_shader", "many_heads",   "beads",
    "hello_window", "clustered_lights", "bearded_head",    "sword_cut",  "painted_hair",
#if HAIR_BULLET
    "bullet_world",
#endif
};

static void read_ppm(const char* path, uint8_t* pixels)
{
    int width = 0, height = 0, max = 0;
    FILE* file = fopen(path, "rb");
    assert_non_null(file);
    assert_int_equal(fscanf(file, "P6 %d %d %d", &width, &height, &max), 3);
    assert_int_equal(fgetc(file), '\n');
    assert_true(width == WIDTH && height == HEIGHT && max == 255);
    assert_int_equal(fread(pixels, 3, WIDTH * HEIGHT, file), WIDTH * HEIGHT);
    assert_int_equal(fgetc(file), EOF);
    fclose(file);
}

static void example_draws_hair_like_its_golden_picture(void** state)
{
    static uint8_t pixels[3 * WIDTH * HEIGHT];
    const char* name = *state;
    char command[512], path[256], golden[64];
    snprintf(path, sizeof path, HAIR_BUILD_DIR "/example_%s.ppm", name);
    snprintf(command, sizeof command, ENVIRONMENT HAIR_BUILD_DIR "/examples/%s %s%s%s", name,
             strcmp(name, "hello_window") ? "" : "20 ", path, strcmp(name, "hello_window") ? " 256" : "");
    int status = system(command);
    assert_true(WIFEXITED(status) && WEXITSTATUS(status) == 0);
    read_ppm(path, pixels);
    assert_true(hair_test_distinct_colors(pixels, WIDTH, HEIGHT) >= 30);
    snprintf(golden, sizeof golden, "example_%s", name);
    hair_test_golden(golden, pixels, WIDTH, HEIGHT);
}

int main(void)
{
    enum { COUNT = sizeof names / sizeof *names };
    struct CMUnitTest tests[COUNT];
    for (int i = 0; i < COUNT; ++i)
        tests[i] = (struct CMUnitTest){.name = names[i],
                                       .test_func = example_draws_hair_like_its_golden_picture,
                                       .initial_state = (void*)names[i]};
    return cmocka_run_group_tests_name("examples", tests, NULL, NULL);
}
