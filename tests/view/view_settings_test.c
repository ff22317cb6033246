// view_settings_test.c - every setting with a range is found in the panel of hair-view by its name,
// changes the scene when it is dragged, and is reset by its button.
#include "tests/support/shell.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <cmocka.h>

#define TOOL HAIR_BUILD_DIR "/hair-view"
#define MAX_KEYS 200

static char keys[MAX_KEYS][64];

// Read the keys of the rows from --help. Elements of a vector or colour have one row. A scale that
// is guessed is a button, and many guides or followers would take too long. Settings of groups
// have a row for each group instead.
static int read_keys(void)
{
    char path[256];
    hair_test_shell_expect(
        0,
        "$T --help | sed -n '/^Settings for/,$p' | grep '\\[' | grep -v 'One of' | "
        "awk '{print $1}' | sed -E 's/\\.([xyzrgb]|white|tinted|along|across|round)$//' | sort -u | "
        "grep -vxE 'scale|guides|followers|guide_vertices|vertices|groups\\.N\\..*' >$D/keys",
        "");
    snprintf(path, sizeof path, "%s/keys", hair_test_folder());
    FILE* file = fopen(path, "r");
    assert_non_null(file);
    int count = 0;
    while (count < MAX_KEYS && fscanf(file, "%63s", keys[count]) == 1) ++count;
    fclose(file);
    return count;
}

static void settings_are_found_changed_and_reset(void** state)
{
    (void)state;
    char path[256], command[512];
    const char* folder = hair_test_folder();
    int count = read_keys();
    assert_true(count > 60);
    snprintf(path, sizeof path, "%s/s", folder);
    FILE* file = fopen(path, "w");
    assert_non_null(file);
    fprintf(file, "key P\nsave %s/0.json\n", folder);
    for (int i = 0; i < count; ++i) {
        int way = strcmp(keys[i], "pigment.dye") ? 19 : -19; // A colour of 1 only becomes darker.
        fprintf(file,
                "click Search\nkey Ctrl+A\ntext %s\nwait 2\ndrag %s %d 3\nsave %s/c%d.json\n"
                "click Reset %s\nsave %s/r%d.json\n",
                keys[i], keys[i], way, folder, i, keys[i], folder, i);
    }
    fclose(file);
    snprintf(command, sizeof command,
             "$T $D/small.json --style long --set redblack.iterations=20 --size 1200x1500 --scale 1 --script "
             "$D/s --frames %d",
             30 * count + 50);
    hair_test_shell_expect(0, command, "");
    for (int i = 0; i < count; ++i) {
        snprintf(command, sizeof command,
                 "diff $D/0.json $D/c%d.json | grep '^>' | grep -qF '\"%s' && cmp $D/0.json $D/r%d.json || "
                 "{ echo %s; diff $D/0.json $D/c%d.json; false; }",
                 i, keys[i], i, keys[i], i);
        hair_test_shell_expect(0, command, "");
    }
    print_message("    %d settings\n", count);
}

static int start(void** state)
{
    (void)state;
    return hair_test_shell_start_capture(TOOL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(settings_are_found_changed_and_reset)};
    return cmocka_run_group_tests(tests, start, hair_test_shell_finish);
}
