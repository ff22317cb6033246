// gallery_test.c - the command line of hair-gallery: a sheet of pictures, its rows, and exit codes.
#include "tests/support/shell.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <cmocka.h>

#define TOOL HAIR_BUILD_DIR "/hair-gallery"
#define expect hair_test_shell_expect

static void wrong_use_exits_with_2(void** state)
{
    (void)state;
    static const char* const wrong[][2] = {
        {"", "nothing to do"},
        {"-o $D/a.png --size 0x3", "--size is 0x3, not WxH with both in [1, 4096]"},
        {"-o $D/a.png --size 3x4097", "--size"},
        {"-o $D/a.png --size 3", "--size"},
        {"-o $D/a.png --jobs 0", "--jobs is 0, not a whole number in [1, 256]"},
        {"-o $D/a.png --jobs 2x", "--jobs"},
        {"-o $D/a.png --only nothing", "--only is nothing, a word of no row's title"},
        {"-o $D/a.png more", "more is one argument too many"},
        {"--dance", "dance"},
        {"-o $D/a.jpg", "a.jpg ends in .jpg, but what is written is .png"},
    };
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; ++i) {
        char command[256];
        snprintf(command, sizeof command, "$T %s", wrong[i][0]);
        expect(2, command, wrong[i][1]);
    }
    expect(1, "test -e $D/a.png -o -e $D/a.jpg", "");
    expect(0, "$T --help", "hair-gallery - ");
    expect(0, "$T --version", "hair-gallery 0.");
    hair_test_shell_expect_full("--help");
    hair_test_shell_expect_full("--version");
    hair_test_shell_expect_full("--list");
}

// Check that hair-capture accepts the arguments of every listed picture.
static void every_row_has_arguments_that_hair_capture_takes(void** state)
{
    (void)state;
    expect(0, // All commands reach the error that is there on purpose.
           "$T --list | sed -n 's/^  .*: //p' | while read -r arguments; do eval " HAIR_BUILD_DIR
           "/hair-capture $arguments --frames 0:0 -o $D/a.png >$D/said 2>&1; "
           "if grep -v -- '--frames is 0:0' $D/said; then exit 1; fi; done",
           "");
}

static void a_sheet_has_the_pictures_of_its_rows(void** state)
{
    (void)state;
    expect(0, "mkdir $D/tmp; TMPDIR=$D/tmp $T --only 'a ball comes' --size 41x31 -o $D/a.png", "");
    expect(0, "head -c 24 $D/a.png | tail -c 8 | od -An -tu1", "   0   0   0 244   0   0   0 183");
    expect(0, "rmdir $D/tmp", "");
}

static void unwritable_output_exits_with_1(void** state)
{
    (void)state;
    expect(1, "$T --only 'a ball comes' --size 1x1 -o $D/none/a.png", "none/a.png");
    expect(1, "cp $T $D/; $D/hair-gallery --only 'a ball comes' --size 1x1 -o $D/b.png",
           "hair-capture failed");
    expect(1, "test -e $D/b.png", "");
}

static int start(void** state)
{
    (void)state;
    return hair_test_shell_start(TOOL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(wrong_use_exits_with_2),
        cmocka_unit_test(every_row_has_arguments_that_hair_capture_takes),
        cmocka_unit_test(a_sheet_has_the_pictures_of_its_rows),
        cmocka_unit_test(unwritable_output_exits_with_1),
    };
    return cmocka_run_group_tests(tests, start, hair_test_shell_finish);
}
