// view_minute_test.c - a session of hair-view of one minute needs no growing memory.
#include "tests/support/shell.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <cmocka.h>

#define TOOL HAIR_BUILD_DIR "/hair-view"
#define SECONDS 60
#define WARM 24 // seconds until every list is full and every program is compiled

// A second has 60 frames. Its events are those of every other second, except the size of the window
// and the mode of the debug view, which the report draws.
static void write_second(FILE* file, int second)
{
    static const char* const keys[] = {"K", "U", "M", "D", "V", "4"};
    int frames = 60;
    for (int i = 0; i < 12; ++i, frames -= 2) fprintf(file, "key %s\n", keys[i % 6]);
    fprintf(file, "key J\nmove 400 300\ndown left\nmove 420 310\nmove 400 300\nup left\n");
    fprintf(file, "wheel 1\nwheel -1\nsize %d 600\nwait %d\nreport %s/%d.json\n", 800 + 40 * (second % 2),
            frames - 11, hair_test_folder(), second);
}

static double read_number(int second, const char* key)
{
    char name[32];
    snprintf(name, sizeof name, "%d.json", second);
    json_t* root = hair_test_shell_json(name);
    double value = hair_test_json_number(root, key);
    assert_true(json_is_true(json_object_get(root, "is_finite")));
    json_decref(root);
    return value;
}

static void a_minute_needs_no_growing_memory(void** state)
{
    (void)state;
    char path[256];
    snprintf(path, sizeof path, "%s/s", hair_test_folder());
    FILE* file = fopen(path, "w");
    assert_non_null(file);
    for (int second = 0; second < SECONDS; ++second) write_second(file, second);
    fclose(file);
    hair_test_shell_expect(0, "$T $D/small.json --size 800x600 --script $D/s --frames 3700 --quality 4", "");
    double most = 0;
    for (int second = WARM - 11; second < WARM; ++second) {
        double bytes = read_number(second, "resident_bytes");
        most = bytes > most ? bytes : most;
    }
    for (int second = SECONDS - 11; second < SECONDS; ++second) {
        double bytes = read_number(second, "resident_bytes");
        print_message("    %d s: %.1f MB, %.1f MB before, %.1f MB of the hair\n", second, 1e-6 * bytes,
                      1e-6 * most, 1e-6 * read_number(second, "hair_bytes"));
        assert_true(bytes > 1e6 && bytes < 1.02 * most + 2e6);
    }
}

static int start(void** state)
{
    (void)state;
    return hair_test_shell_start_capture(TOOL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(a_minute_needs_no_growing_memory)};
    return cmocka_run_group_tests(tests, start, hair_test_shell_finish);
}
