// golden_test.c - pictures of the built-in scenes equal the previous ones, and are not black.
//
// Goldens are those of llvmpipe: golden/llvmpipe/<scene>.png. FLIP compares zink with them. Other
// renderers check only the range of lit pixels. HAIR_BLESS=1 writes the goldens again. Look at them
// before committing.
#include "tests/support/golden.h"
#include "tests/support/support.h"

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/wait.h>

#define WIDTH 320
#define HEIGHT 180

struct golden {
    const char* name;
    const char* arguments;
    // Range of the fraction of pixels that change when hair is added to the picture.
    double min_lit, max_lit;
    bool is_long; // Compared only with HAIR_TEST_FULL=1.
};

// Fewer guides, and fewer and wider strands, than in the scenes. All of them would take a CPU half
// a minute, and use the same shaders.
#define FEW "--guides 80 --followers 3000 --set strand.radius=4e-4"
#define FEWER "--guides 40 --followers 1500 --set strand.radius=6e-4"
static const struct golden goldens[] = {
    {"demo", "--scene demo --frames 10:11 " FEW, 0.05, 0.5, false},
    {"demo_lines", "--scene demo --frames 10:11 " FEW " --primitive lines", 0.05, 0.5, true},
    {"bob", "--scene bob --frames 0:1 " FEW, 0.03, 0.5, true},
    {"short", "--scene short --frames 0:1 " FEW, 0.015, 0.5, false},
    {"ponytail", "--scene ponytail --frames 0:1 " FEW, 0.02, 0.5, true},
    {"curly", "--scene curly --frames 0:1 " FEWER, 0.05, 0.5, false},
    {"afro", "--scene afro --frames 0:1 " FEWER, 0.05, 0.5, false},
    {"fur", "--scene fur --frames 0:1", 0.05, 0.9, false},
};

static void capture(const struct golden* golden, const char* more, const char* out)
{
    char command[512];
    snprintf(command, sizeof command,
             HAIR_BUILD_DIR "/hair-capture %s --render-path tessellation --supersample 1 --size %dx%d "
                            "--quiet %s -o %s",
             golden->arguments, WIDTH, HEIGHT, more, out);
    int status = system(command);
    assert_true(WIFEXITED(status) && WEXITSTATUS(status) == 0);
}

static double lit_fraction(const uint8_t* with, const uint8_t* without)
{
    size_t lit = 0;
    for (size_t i = 0; i < WIDTH * HEIGHT; ++i)
        lit += hair_test_color_distance(with + 3 * i, without + 3 * i) > 0.02;
    return (double)lit / (WIDTH * HEIGHT);
}

static void scene_equals_its_golden_picture_and_shows_hair(void** state)
{
    static uint8_t with[3 * WIDTH * HEIGHT], without[3 * WIDTH * HEIGHT];
    const struct golden* golden = *state;
    char actual[256], bald[256];
    snprintf(actual, sizeof actual, HAIR_BUILD_DIR "/golden_%s.png", golden->name);
    snprintf(bald, sizeof bald, HAIR_BUILD_DIR "/golden_%s_bald.png", golden->name);
    capture(golden, "", actual);
    // A picture without visible hair. This solver knows no meshes, and has the smallest programs.
    capture(golden, "--set followers.density=0 --solver redblack --followers 100 --guides 16", bald);
    hair_test_read_png(actual, with, WIDTH, HEIGHT);
    hair_test_read_png(bald, without, WIDTH, HEIGHT);

    double lit = lit_fraction(with, without);
    print_message("%s: lit %.3f, colours %zu\n", golden->name, lit,
                  hair_test_distinct_colors(with, WIDTH, HEIGHT));
    assert_true(lit >= golden->min_lit && lit <= golden->max_lit);
    assert_true(hair_test_distinct_colors(with, WIDTH, HEIGHT) >= 30);

    hair_test_golden(golden->name, with, WIDTH, HEIGHT);
}

int main(void)
{
    enum { COUNT = sizeof goldens / sizeof *goldens };
    struct CMUnitTest tests[COUNT] = {{0}}; // Tests without a function are left out.
    bool is_full = getenv("HAIR_TEST_FULL") || getenv("HAIR_BLESS");
    for (int i = 0; i < COUNT; ++i)
        if (is_full || !goldens[i].is_long)
            tests[i] = (struct CMUnitTest){.name = goldens[i].name,
                                           .test_func = scene_equals_its_golden_picture_and_shows_hair,
                                           .initial_state = (void*)&goldens[i]};
    return cmocka_run_group_tests_name("pictures", tests, NULL, NULL);
}
