// view_test.c - the command line of hair-view, its scripts, and the effect of mouse and keys.
#include "tests/support/shell.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <cmocka.h>

#define TOOL HAIR_BUILD_DIR "/hair-view"
#define expect hair_test_shell_expect

// A run of a script in a small window. Shell variables of the test name the script and the picture.
#define RUN "$T $D/small.json --size 800x480 --script $D/s --frames 20 --shot $D/"

static void wrong_use_exits_with_2(void** state)
{
    (void)state;
    static const char* const wrong[][2] = {
        {"--size 0x3", "--size is 0x3, not WxH with both in [64, 8192]"},
        {"--size 300", "--size is 300"},
        {"--size -300x300", "--size is -300x300"},
        {"--scale 9", "--scale is 9, not a number in [0.5, 8]"},
        {"--scale nan", "--scale is nan"},
        {"--frames 0", "--frames is 0, not a whole number in [1, 1000000]"},
        {"--script $D/s", "--script needs --frames N"},
        {"--shot $D/a.png", "--shot and --device need --script FILE"},
        {"--shot $D/a.jpg", "a.jpg ends in .jpg, but what is written is .png"},
        {"--set damping", "--set is damping, not KEY=VALUE"},
        {"--set damping=-1", "damping is -1"},
        {"--style none", "there is no style none"},
        {"a.json --scene demo", "a file and --scene are one too many"},
        {"a.json more", "more is one argument too many"},
        {"--dance", "--dance"},
    };
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; ++i) {
        char command[256];
        snprintf(command, sizeof command, "$T %s", wrong[i][0]);
        expect(2, command, wrong[i][1]);
    }
    expect(0, "$T --help", "hair-view - ");
    expect(0, "$T --version", "hair-view 0.");
    hair_test_shell_expect_full("--help");
}

static void a_missing_display_exits_with_3_and_names_scripts(void** state)
{
    (void)state;
    expect(3, "env -u DISPLAY -u WAYLAND_DISPLAY SDL_VIDEODRIVER=dummy $T",
           "--script FILE --frames N --shot");
}

static void wrong_scripts_exit_with_4(void** state)
{
    (void)state;
    static const char* const wrong[][2] = {
        {"jump 3", "s:1: there is no command jump"},
        {"\\n\\n move 3", "s:3: move needs X Y"},
        {"down here", "s:1: down needs left, middle or right"},
        {"key Nokey", "s:1: there is no key Nokey"},
        {"click Nowhere", "s:1: no widget is in sight with the label Nowhere"},
        {"wait 1e999", "s:1: wait needs N"},
    };
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; ++i) {
        char command[256];
        snprintf(command, sizeof command, "printf '%s' >$D/s; " RUN "a.png", wrong[i][0]);
        expect(4, command, wrong[i][1]);
    }
    expect(4, "rm $D/s; " RUN "a.png", "/s: No such file");
    expect(1, "test -e $D/a.png", "");
}

// The strip shows times, which differ from run to run, therefore it is hidden.
static void equal_scripts_give_equal_pictures(void** state)
{
    (void)state;
    expect(0, "printf 'key I\\nmove 9 9' >$D/s; " RUN "a.png && " RUN "b.png && cmp $D/a.png $D/b.png", "");
    expect(0, "head -c 24 $D/a.png | tail -c 8 | od -An -tu1", "   0   0   3  32   0   0   1 224");
}

// Each script must change the picture of the test above.
static void mouse_and_keys_change_the_picture(void** state)
{
    (void)state;
    static const char* const scripts[] = {
        "move 400 120\\ndown left\\nmove 460 120\\nup left\\nmove 9 9",
        "move 400 120\\npress Left Alt\\ndown left\\nmove 460 120\\nup left\\nrelease Left Alt\\nmove 9 9",
        "move 400 120\\nwheel 3\\nmove 9 9",
        "key ?\\nmove 9 9",
        "key Tab\\nmove 9 9",
        "click Curly\\nmove 9 9",
        "key 1\\nmove 9 9",
        "key P\\nmove 9 9",
        "key W\\nkey C\\nmove 9 9",
    };
    for (size_t i = 0; i < sizeof scripts / sizeof *scripts; ++i) {
        char command[512];
        snprintf(command, sizeof command,
                 "printf 'key I\\n%s' >$D/s; " RUN "b.png && ! cmp -s $D/a.png $D/b.png", scripts[i]);
        expect(0, command, "");
    }
    expect(0,
           "printf 'key I\\nmove 400 120\\nwheel 3\\nkey Ctrl+Z\\nmove 9 9' >$D/s; " RUN
           "b.png; cmp $D/a.png $D/b.png",
           "");
}

// A glide orbits the camera in several frames. The first 60 frames are not counted.
static void frame_times_are_printed(void** state)
{
    (void)state;
    expect(
        0,
        "printf 'wait 60\\nmove 400 120\\ndown left\\nglide 460 120 6\\nup left\\nsave '$D/o.json >$D/s; $T "
        "$D/small.json --size 800x480 --script $D/s --frames 72 --fps | tee $D/fps",
        "99th percentile");
    expect(
        0,
        "awk '/^moving|^at rest/ {for (i = 1; i < NF; i++) if ($(i+1) == \"ms\") {n++; s = $(i-1); break}; "
        "frames += s} END {exit frames != 12}' $D/fps",
        "");
    expect(0, "grep -q camera $D/o.json", "");
}

static void shaders_of_a_folder_are_compiled_again(void** state)
{
    (void)state;
    expect(0,
           "cp -r glsl $D/glsl; printf 'wait 2\\nkey F5\\nreport '$D'/r.json' >$D/s; " RUN
           "b.png --glsl $D/glsl",
           "");
    expect(0, "grep 'Compiled all shaders again' $D/r.json", "");
    expect(3, "echo 'vec9 broken;' >>$D/glsl/draw/strand.frag; " RUN "b.png --glsl $D/glsl",
           "shader glsl/draw/strand.frag does not compile");
}

static int start(void** state)
{
    (void)state;
    return hair_test_shell_start_capture(TOOL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(wrong_use_exits_with_2),
        cmocka_unit_test(a_missing_display_exits_with_3_and_names_scripts),
        cmocka_unit_test(wrong_scripts_exit_with_4),
        cmocka_unit_test(equal_scripts_give_equal_pictures),
        cmocka_unit_test(frame_times_are_printed),
        cmocka_unit_test(shaders_of_a_folder_are_compiled_again),
        cmocka_unit_test(mouse_and_keys_change_the_picture),
    };
    return cmocka_run_group_tests(tests, start, hair_test_shell_finish);
}
