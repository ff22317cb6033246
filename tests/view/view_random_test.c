// view_random_test.c - random events of mouse, keys, drops and resizes leave hair-view with finite
// hair and without an error. HAIR_TEST_FULL=1 runs 10,000 events.
#include "tests/support/shell.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <cmocka.h>

#define TOOL HAIR_BUILD_DIR "/hair-view"
#define COUNT(rows) (uint32_t)(sizeof(rows) / sizeof *(rows))

static uint64_t seed = 1;

static uint32_t below(uint32_t count)
{
    seed = seed * 6364136223846793005u + 1442695040888963407u;
    return (uint32_t)(seed >> 33) % count;
}

static void write_event(FILE* file)
{
    // Keys that write files, or that run long measurements, are left out.
    static const char* const keys[] = {"1", "2", "3", "4",   "5",     "A",      "B",      "C",      "D",
                                       "F", "H", "I", "J",   "K",     "L",      "M",      "N",      "O",
                                       "P", "R", "S", "T",   "U",     "V",      "X",      "Y",      "[",
                                       "]", ".", "?", "Tab", "Space", "Ctrl+Z", "Ctrl+Y", "Return", "Escape"};
    static const char* const buttons[] = {"left", "left", "left", "middle", "right"};
    static const char* const modifiers[] = {"Left Shift", "Left Ctrl", "Left Alt"};
    static const char* const drops[] = {"small.json", "broken.json", "broken.tfx", "none.hair", "cube.obj"};
    switch (below(12)) {
    case 0: fprintf(file, "key %s\n", keys[below(COUNT(keys))]); break;
    case 1: fprintf(file, "down %s\n", buttons[below(COUNT(buttons))]); break;
    case 2: fprintf(file, "up %s\n", buttons[below(COUNT(buttons))]); break;
    case 3: fprintf(file, "wheel %d\n", (int)below(7) - 3); break;
    case 4: fprintf(file, "press %s\n", modifiers[below(COUNT(modifiers))]); break;
    case 5: fprintf(file, "release %s\n", modifiers[below(COUNT(modifiers))]); break;
    case 6: fprintf(file, "text %d\n", (int)below(2000) - 1000); break;
    case 7:
        if (!below(20)) fprintf(file, "drop %s/%s\n", hair_test_folder(), drops[below(COUNT(drops))]);
        if (!below(20)) fprintf(file, "size %u %u\n", 64 + below(900), 64 + below(900));
        break;
    default: fprintf(file, "move %u %u\n", below(900), below(700)); break;
    }
}

static void random_events_leave_finite_hair(void** state)
{
    (void)state;
    uint32_t events = getenv("HAIR_TEST_FULL") ? 10000 : 300;
    char path[256], command[256];
    snprintf(path, sizeof path, "%s/s", hair_test_folder());
    FILE* file = fopen(path, "w");
    assert_non_null(file);
    for (uint32_t i = 0; i < events; ++i) {
        write_event(file);
        if (!below(100)) fprintf(file, "key R\n"); // Hair that is far away comes back.
    }
    fprintf(file, "report %s/r.json\n", hair_test_folder());
    fclose(file);
    hair_test_shell_expect(0,
                           "echo '{' >$D/broken.json; echo x >$D/broken.tfx; printf 'v 0 0 0\nv 0.1 0 "
                           "0\nv 0 0.1 0\nv 0 0 0.1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n' >$D/cube.obj",
                           "");
    snprintf(command, sizeof command, "$T $D/small.json --size 900x700 --script $D/s --frames %u --quality 4",
             2 * events + 100);
    hair_test_shell_expect(0, command, "");
    json_t* root = hair_test_shell_json("r.json");
    assert_true(json_is_true(json_object_get(root, "is_finite")));
    json_decref(root);
}

static int start(void** state)
{
    (void)state;
    return hair_test_shell_start_capture(TOOL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(random_events_leave_finite_hair)};
    return cmocka_run_group_tests(tests, start, hair_test_shell_finish);
}
