// capture_light_test.c - lights in scenes of hair-capture. A light with a shadow leaves skin darker
// behind hair and body. The first light has a shadow by default. More than four lights give an
// error.
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
// Black hair, so that only skin is visible.
#define BLACK                                                                                                \
    "--set shading.model=lines --set color.root.r=0 --set color.tip.r=0 --set shading.specular.white=0 "     \
    "--set color.streaks=0 "                                                                                 \
    "--set strand.radius=0.0005 --set lod=off"
#define WIDTH 96
#define HEIGHT 72

// Write a scene with a ball of fur. One of three lights shines in red.
static void write_scene(const char* name, int light, const char* shadow)
{
    FILE* file = hair_test_shell_create(name, ".json");
    fprintf(
        file,
        "{\"fur\": {\"strands\": 4000, \"length\": 0.05, \"ball\": 0.1}, \"size\": [%d, %d], \"frames\": 1, ",
        WIDTH, HEIGHT);
    fprintf(file, "\"settle\": 0, \"background\": {\"centre\": [0, 0, 0], \"edge\": [0, 0, 0]}, \"motion\": "
                  "\"still\", \"camera\": {\"eye\": [0, 0, 0.6], \"target\": [0, "
                  "0, 0], \"fov\": 30}, ");
    fprintf(file,
            "\"light\": {\"direction\": [0, 1, 1], \"color\": [%d, 0, 0], \"ambient\": [0, 0, 0]%s%s}, ",
            light == 0, light ? "" : shadow, light ? ", \"shadow\": false" : "");
    fprintf(file, "\"lights\": [{\"direction\": [0, 1, 1], \"color\": [%d, 0, 0]%s}, ", light == 1,
            light == 1 ? shadow : "");
    fprintf(
        file,
        "{\"kind\": \"spot\", \"position\": [0, 0.5, 0.5], \"direction\": [0, 1, 1], \"color\": [%s, 0, 0], "
        "\"outer_angle\": 1%s}]}",
        light == 2 ? "0.4" : "0", light == 2 ? shadow : "");
    fclose(file);
}

// Return the mean red of the picture, in 1/255.
static double brightness(const char* name)
{
    static uint8_t pixels[3 * WIDTH * HEIGHT];
    char command[512], path[512];
    snprintf(command, sizeof command, "$T $D/%s.json --samples 1 --quiet " BLACK " -o $D/%s.png", name, name);
    hair_test_shell_expect(0, command, "");
    snprintf(path, sizeof path, "%s/%s.png", hair_test_folder(), name);
    hair_test_read_png(path, pixels, WIDTH, HEIGHT);
    double sum = 0;
    for (int i = 0; i < WIDTH * HEIGHT; ++i) sum += pixels[3 * i];
    return sum / (WIDTH * HEIGHT);
}

static void hair_shades_skin_for_each_light_with_a_shadow(void** state)
{
    (void)state;
    static const char* const names[] = {"first", "second", "spot"};
    for (int light = 0; light < 3; ++light) {
        write_scene(names[light], light, ", \"shadow\": false");
        double lit = brightness(names[light]);
        write_scene(names[light], light, light ? ", \"shadow\": true" : "");
        double shaded = brightness(names[light]);
        printf("    %s: %.2f without a shadow, %.2f with it\n", names[light], lit, shaded);
        assert_true(lit > 2 && shaded < 0.9 * lit && shaded > 0.1 * lit);
    }
}

static void more_than_four_lights_with_a_shadow_are_refused(void** state)
{
    (void)state;
    hair_test_shell_expect(4,
                           "echo '{\"lights\": [{\"shadow\": true}, {\"shadow\": true}, {\"shadow\": true}, "
                           "{\"shadow\": true}]}' "
                           ">$D/five.json; $T $D/five.json -o $D/five.png",
                           "at most 4 lights");
    hair_test_shell_expect(
        4, "echo '{\"light\": {\"shadow\": 1}}' >$D/odd.json; $T $D/odd.json -o $D/odd.png", "shadow");
}

static int start(void** state)
{
    (void)state;
    return hair_test_shell_start(TOOL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(hair_shades_skin_for_each_light_with_a_shadow),
        cmocka_unit_test(more_than_four_lights_with_a_shadow_are_refused),
    };
    return cmocka_run_group_tests(tests, start, hair_test_shell_finish);
}
