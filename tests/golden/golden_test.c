// golden_test.c - pictures of the built-in scenes equal the previous ones, and are not black.
//
// A golden belongs to the renderer that made it: golden/<renderer>/<scene>.png. Other renderers
// check only the range of lit pixels. HAIR_BLESS=1 writes the goldens again. Look at them before
// committing.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include <math.h>
#include <png.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include <hair/hair_egl.h>

#define WIDTH 320
#define HEIGHT 180

// Maximum root mean square error. Two runs on one driver do not differ. An SSE4.1 CPU differs from
// an AVX2 CPU by 0.00004.
#define MOST_RMSE 0.003
#define MOST_BAD_PIXELS 0.002 // Maximum fraction of pixels that differ by more than a quarter.

struct golden {
    const char* name;
    const char* arguments;
    // Range of the fraction of pixels that change when hair is added to the picture.
    double least_lit, most_lit;
};

// Fewer and wider strands than in the scenes. All strands would take a CPU half a minute, and use
// the same shaders.
#define FEW "--followers 3000 --set radius=4e-4"
#define FEWER "--followers 1500 --set radius=6e-4"
static const struct golden goldens[] = {
    {"demo", "--scene demo --frames 10:11 " FEW, 0.05, 0.5},
    {"demo_lines", "--scene demo --frames 10:11 " FEW " --primitive lines", 0.05, 0.5},
    {"bob", "--scene bob --frames 0:1 " FEW, 0.03, 0.5},
    {"short", "--scene short --frames 0:1 " FEW, 0.015, 0.5},
    {"ponytail", "--scene ponytail --frames 0:1 " FEW, 0.02, 0.5},
    {"curly", "--scene curly --frames 0:1 " FEWER, 0.05, 0.5},
    {"afro", "--scene afro --frames 0:1 " FEWER, 0.05, 0.5},
    {"fur", "--scene fur --frames 0:1", 0.05, 0.9},
};

static void capture(const struct golden* golden, const char* more, const char* out)
{
    char command[512];
    snprintf(command, sizeof command,
             HAIR_BUILD_DIR "/hair-capture %s --supersample 1 --size %dx%d --quiet %s -o %s",
             golden->arguments, WIDTH, HEIGHT, more, out);
    int status = system(command);
    assert_true(WIFEXITED(status) && WEXITSTATUS(status) == 0);
}

static int read_png(const char* path, uint8_t* pixels)
{
    png_image image = {.version = PNG_IMAGE_VERSION};
    if (!png_image_begin_read_from_file(&image, path)) return 0;
    assert_int_equal(image.width, WIDTH);
    assert_int_equal(image.height, HEIGHT);
    image.format = PNG_FORMAT_RGB;
    return png_image_finish_read(&image, NULL, pixels, 0, NULL);
}

static double distance(const uint8_t* a, const uint8_t* b)
{
    double sum = 0;
    for (int k = 0; k < 3; ++k) sum += pow((a[k] - b[k]) / 255.0, 2);
    return sqrt(sum / 3);
}

static double lit_share(const uint8_t* with, const uint8_t* without)
{
    size_t lit = 0;
    for (size_t i = 0; i < WIDTH * HEIGHT; ++i) lit += distance(with + 3 * i, without + 3 * i) > 0.02;
    return (double)lit / (WIDTH * HEIGHT);
}

static size_t distinct_colors(const uint8_t* pixels)
{
    static uint8_t seen[1 << 15]; // Five bits per channel.
    memset(seen, 0, sizeof seen);
    size_t count = 0;
    for (size_t i = 0; i < WIDTH * HEIGHT; ++i, pixels += 3) {
        unsigned key = (unsigned)(pixels[0] >> 3 << 10 | pixels[1] >> 3 << 5 | pixels[2] >> 3);
        count += !seen[key];
        seen[key] = 1;
    }
    return count;
}

static const char* renderer_folder(void)
{
    hair_egl* egl = NULL;
    assert_int_equal(hair_egl_create(NULL, -1, &egl), HAIR_OK);
    const unsigned char* (*get_string)(unsigned) = NULL;
    void* address = hair_egl_get_proc("glGetString", NULL);
    memcpy(&get_string, &address, sizeof address);
    const char* folder =
        strncmp((const char*)get_string(0x1F01), "llvmpipe", 8) == 0 ? "tests/golden/llvmpipe" : NULL;
    hair_egl_destroy(egl);
    return folder;
}

static void compare(const struct golden* golden, const uint8_t* now, const char* path)
{
    static uint8_t before[3 * WIDTH * HEIGHT];
    if (!read_png(path, before)) fail_msg("%s is not there: make it with HAIR_BLESS=1 and look at it", path);
    double square = 0;
    size_t bad = 0;
    for (size_t i = 0; i < WIDTH * HEIGHT; ++i) {
        double d = distance(now + 3 * i, before + 3 * i);
        square += d * d;
        bad += d > 0.25;
    }
    double rmse = sqrt(square / (WIDTH * HEIGHT)), share = (double)bad / (WIDTH * HEIGHT);
    print_message("%s: rmse %.5f, pixels further off than a quarter %.5f\n", golden->name, rmse, share);
    assert_true(rmse <= MOST_RMSE && share <= MOST_BAD_PIXELS);
}

static void the_picture_is_the_same_as_last_time_and_shows_hair(void** state)
{
    static uint8_t with[3 * WIDTH * HEIGHT], without[3 * WIDTH * HEIGHT];
    const struct golden* golden = *state;
    char path[256], actual[256], bald[256];
    snprintf(actual, sizeof actual, HAIR_BUILD_DIR "/golden_%s.png", golden->name);
    snprintf(bald, sizeof bald, HAIR_BUILD_DIR "/golden_%s_bald.png", golden->name);
    capture(golden, "", actual);
    // A picture without visible hair. The little hair there is simulated the fastest way.
    capture(golden, "--set density=0 --solver follow --followers 100 --guides 16", bald);
    assert_true(read_png(actual, with) && read_png(bald, without));

    double lit = lit_share(with, without);
    print_message("%s: lit %.3f, colours %zu\n", golden->name, lit, distinct_colors(with));
    assert_true(lit >= golden->least_lit && lit <= golden->most_lit);
    assert_true(distinct_colors(with) >= 30);

    const char* folder = renderer_folder();
    if (!folder) {
        print_message("%s: no golden of this renderer, none compared\n", golden->name);
        return;
    }
    snprintf(path, sizeof path, "%s/%s.png", folder, golden->name);
    if (getenv("HAIR_BLESS")) {
        char command[600];
        snprintf(command, sizeof command, "cp %s %s", actual, path);
        assert_int_equal(system(command), 0);
    }
    compare(golden, with, path);
}

int main(void)
{
    enum { COUNT = sizeof goldens / sizeof *goldens };
    struct CMUnitTest tests[COUNT];
    for (int i = 0; i < COUNT; ++i)
        tests[i] = (struct CMUnitTest){.name = goldens[i].name,
                                       .test_func = the_picture_is_the_same_as_last_time_and_shows_hair,
                                       .initial_state = (void*)&goldens[i]};
    return cmocka_run_group_tests_name("pictures", tests, NULL, NULL);
}
