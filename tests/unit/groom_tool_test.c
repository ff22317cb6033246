// groom_tool_test.c - the command line of hair-groom: files, pipes, exit codes, and no partially
// written files.
#include "tests/support/files.h"
#include "tests/support/groomfile.h"
#include "tests/support/shell.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

#define TOOL HAIR_BUILD_DIR "/hair-groom"

#define expect hair_test_shell_expect
#define said hair_test_said

static void save(const char* name, struct hair_test_file file)
{
    FILE* out = hair_test_shell_create(name, "");
    assert_int_equal(fwrite(file.bytes, 1, file.size, out), file.size);
    fclose(out);
    free(file.bytes);
}

static int make_folder(void** state)
{
    (void)state;
    if (hair_test_shell_start(TOOL)) return -1;
    save("a.hair", hair_test_hair(31));
    save("a4.tfx", hair_test_tfx4());
    save("a3.tfx", hair_test_tfx3());
    save("a2.tfx", hair_test_tfx2());
    return 0;
}

static void info_prints_the_contents_of_a_haircut(void** state)
{
    (void)state;
    expect(0, "$T info $D/a.hair", "strands:   3, of 3 in the file");
    assert_non_null(strstr(said, "fewest 2, most 4"));
    assert_non_null(strstr(said, "nothing repaired"));
    assert_non_null(strstr(said, "guides of"));
    expect(0, "$T info --scale 0.01 --up z $D/a3.tfx", "x 0 to 0.02, y 0 to 0.00375, z -0.03 to 0 m");
    expect(0, "$T info $D/a2.tfx", "tfx2");
    expect(0, "$T info --keep-fraction 0.4 $D/a4.tfx", "strands:   1, of 3 in the file");
}

static void info_prints_repairs(void** state)
{
    (void)state;
    struct hair_test_file file = hair_test_tfx3();
    for (size_t i = 0; i < 48; i += 4) hair_test_set_float(&file, 296 + i, 1e30f);
    for (size_t i = 0; i < 48; i += 4) hair_test_set_float(&file, 344 + i, 1);
    save("bad.tfx", file);
    expect(0, "$T info $D/bad.tfx", "repairs:   1 strand of fewer than two vertices dropped");
    assert_non_null(strstr(said, "1 strand shorter than 10 micrometres dropped"));
    assert_non_null(strstr(said, "4 vertices not finite or too far away removed"));
}

static void haircuts_are_read_from_pipes_and_written_to_them(void** state)
{
    (void)state;
    expect(0, "cat $D/a3.tfx | $T info -", "tfx3");
    expect(0, "cat $D/a3.tfx | $T info /dev/stdin", "tfx3");
    expect(0, "$T convert $D/a3.tfx $D/b.hair && cat $D/a3.tfx | $T convert - - | cmp - $D/b.hair", "");
    expect(0, "$T convert $D/a3.tfx /dev/stdout --format hair | cmp - $D/b.hair", "");
    expect(
        0,
        "mkfifo $D/fifo; $T convert $D/a3.tfx $D/fifo & cmp $D/fifo $D/b.hair && wait $! && test -p $D/fifo",
        "");
}

// Check inputs without an end. Their beginning tells how much to read.
static void inputs_without_an_end_are_read_as_far_as_their_format_goes(void** state)
{
    (void)state;
    const char* few = hair_test_shell_limit(400000);
    char command[256];
    snprintf(command, sizeof command, "%s timeout 20 $T info /dev/zero", few);
    expect(4, command, "at byte 0 stands none of");
    snprintf(command, sizeof command, "%s (cat $D/a.hair; cat /dev/zero) | timeout 20 $T info -", few);
    expect(0, command, "is not read");
    expect(0, "$T convert $D/a.hair $D/z.groom", "");
    snprintf(command, sizeof command, "%s (cat $D/z.groom; cat /dev/zero) | timeout 20 $T info -", few);
    expect(0, command, "groom, all strands");
    snprintf(command, sizeof command, "%s (cat $D/a3.tfx; yes) | timeout 20 $T info -", few);
    expect(0, command, "tfx3");
}

// Check inputs without an end whose headers claim more than the library reads, and a text.
static void inputs_that_claim_too_much_are_refused_by_their_beginning(void** state)
{
    (void)state;
    static const char* const wrong[][2] = {
        {"(printf 'HAIR\\377\\377\\377\\377\\377\\377\\377\\377\\003\\0\\0\\0'; cat /dev/zero)",
         "make 4294967295 strands and 4294967295 vertices, more than 16777216 and 67108864"},
        {"(head -c 12 $D/a.hair; printf '\\377\\377\\377\\377'; tail -c +17 $D/a.hair; cat /dev/zero)",
         "unknown arrays"},
        {"(head -c 12 $D/a4.tfx; printf '\\360\\377\\377\\377'; cat /dev/zero)",
         "is 4294967280, but all sections fit before byte"},
        {"(head -c 4 $D/a3.tfx; printf '\\0\\0\\0\\001\\377\\0\\0\\0'; cat /dev/zero)", "more than"},
        {"(printf 'GROOM\\r\\n\\032'; cat /dev/zero)", "the checksum at byte 24 is 0x00000000"},
        {"(cat $D/a2.tfx; yes '#')", "goes on after byte 268435456"},
    };
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; ++i) {
        char command[512];
        snprintf(command, sizeof command, "%s %s | timeout 20 $T info -",
                 hair_test_shell_limit(i + 1 < sizeof wrong / sizeof *wrong ? 100000 : 500000), wrong[i][0]);
        expect(i == 1 ? 0 : 4, command, wrong[i][1]);
    }
}

// Check that text of files and arguments cannot command a terminal.
static void text_that_is_printed_is_escaped(void** state)
{
    (void)state;
    expect(2, "$T generate \"$(printf '\\033]0;owned\\007')\" $D/x.hair", "\\x1b]0;owned\\x07");
    expect(2, "$T \"--$(printf '\\033')]0;\" info a", "--\\x1b]0; is not an option");
    expect(4, "$T info \"$D/$(printf 'caf\\303\\251 \\302\\233 \\377')\"", "caf\303\251 \\xc2\\x9b \\xff");
}

static void every_format_converts_to_every_writable_format(void** state)
{
    (void)state;
    expect(0,
           "for f in a4.tfx a3.tfx a2.tfx; do $T convert $D/$f $D/$f.hair && $T convert $D/$f $D/c.tfx && "
           "$T convert $D/c.tfx $D/c.hair && cmp $D/c.hair $D/$f.hair || exit 9; done",
           "");
    expect(0, "$T convert $D/a.hair $D/d.TFX --vertices 16 && $T info $D/d.TFX", "fewest 16, most 16");
    expect(0, "$T convert --format tfx4 --vertices 8 $D/a.hair - | $T info -", "tfx4");
    expect(2, "$T convert $D/a.hair $D/none.tfx", "give --vertices");
    expect(0,
           "$T convert $D/a.hair $D/a.groom && $T convert --format groom $D/a.groom - | cmp - $D/a.groom && "
           "$T info $D/a.groom",
           "groom, all strands");
    expect(0, "$T generate bob $D/f.groom && $T info $D/f.groom", "triangles");
    expect(4, "head -c 1000 $D/f.groom | $T info -", "the file ends at byte 1000, but it had");
    expect(1, "test -e $D/none.tfx", "");
}

// Return the number of sentences of the last command.
static int count_sentences(void)
{
    int count = 0;
    for (const char* at = said; (at = strstr(at, "hair-groom: ")); ++at) ++count;
    return count;
}

static void every_loss_of_a_conversion_has_a_sentence(void** state)
{
    (void)state;
    static const char* const lost[] = {"the groups of strands",
                                       "the choice of guides",
                                       "the scalp",
                                       "the density on the scalp",
                                       "the texture coordinates of the scalp",
                                       "the joints of the scalp",
                                       "the attribute stiffness of strands",
                                       "the attribute length of strands",
                                       "the map of the attribute length",
                                       "the map of the attribute frizz",
                                       "the map set 0",
                                       "the map set 1"};
    // The attribute frizz has two maps, and the strands are guides.
    const int sentences = sizeof lost / sizeof *lost + 2;
    save("all.groom", hair_test_groomfile());
    expect(0, "$T convert $D/all.groom $D/l.hair", "");
    for (size_t i = 0; i < sizeof lost / sizeof *lost; ++i) {
        char sentence[128];
        snprintf(sentence, sizeof sentence, "/l.hair is written without %s, which .hair files do not hold",
                 lost[i]);
        if (!strstr(said, sentence)) fail_msg("\"%s\" is not in: %s", sentence, said);
    }
    assert_int_equal(count_sentences(), sentences);
    expect(0, "$T convert $D/all.groom $D/l.tfx --vertices 8", "the radii of strands, which .tfx files");
    assert_int_equal(count_sentences(), sentences);
    expect(0, "$T convert $D/a.hair $D/l.tfx --vertices 8", "l.tfx become guides, because .tfx files hold");
    expect(0, "$T convert $D/all.groom $D/l.groom", "");
    assert_int_equal(count_sentences(), 0);
    expect(0, "$T convert $D/a4.tfx $D/l.hair", "guides become all strands of");
    assert_int_equal(count_sentences(), 1);
    expect(1, "$T convert $D/all.groom /dev/full --format hair", "cannot write");
    assert_int_equal(count_sentences(), 1);
}

static void built_in_haircuts_are_written(void** state)
{
    (void)state;
    for (int i = 0; i < HAIR_STYLE_COUNT; ++i) {
        char command[256];
        snprintf(command, sizeof command,
                 "$T generate %s $D/e.tfx --vertices 16 --guides 64 && $T info $D/e.tfx",
                 hair_style_name((hair_style)i));
        expect(0, command, "fewest 16, most 16");
    }
    expect(0, "$T generate long $D/f.hair --seed 3; $T generate --seed 3 long - | cmp - $D/f.hair", "");
    expect(0, "$T generate long $D/g.hair --seed 4; ! cmp -s $D/f.hair $D/g.hair", "");
}

static void wrong_use_exits_with_2(void** state)
{
    (void)state;
    const char* wrong[] = {"",
                           "dance",
                           "info",
                           "info a b",
                           "convert a",
                           "generate long",
                           "--dance info a",
                           "info --scale a.hair",
                           "info --scale one $D/a.hair",
                           "info --scale 0 $D/a.hair",
                           "info --scale nan $D/a.hair",
                           "info --keep-fraction 2 $D/a.hair",
                           "info --up w $D/a.hair",
                           "info --up yz $D/a.hair",
                           "info --vertices 257 $D/a.hair",
                           "info --vertices -1 $D/a.hair",
                           "info --seed 4294967296 $D/a.hair",
                           "generate mullet $D/x.hair",
                           "generate long $D/x.hair --guides 1",
                           "generate long $D/x.hair --length 99",
                           "generate long $D/x.groomer",
                           "generate long $D/x.",
                           "convert $D/a.hair $D/x.obj",
                           "convert --format tfx3 $D/a.hair $D/x.tfx"};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; ++i) {
        char command[256];
        snprintf(command, sizeof command, "$T %s", wrong[i]);
        expect(2, command, "hair-groom: ");
    }
    expect(1, "test -e $D/x.hair", "");
    expect(2, "$T generate mullet -", "long, bob, short, ponytail, curly, afro");
    expect(2, "$T generate long $D/x.groomer", "ends in none of .groom, .hair and .tfx");
}

static void options_of_another_command_are_wrong_use(void** state)
{
    (void)state;
    static const char* const wrong[][2] = {
        {"guides", "info --guides 64 $D/a.hair"},
        {"length", "info --length 2 $D/a.hair"},
        {"format", "info --format hair $D/a.hair"},
        {"guides", "convert --guides 64 $D/a.hair $D/x.hair"},
        {"length", "convert --length 2 $D/a.hair $D/x.hair"},
        {"scale", "generate --scale 2 long $D/x.hair"},
        {"up", "generate --up z long $D/x.hair"},
        {"tip-first", "generate --tip-first long $D/x.hair"},
        {"keep-fraction", "generate --keep-fraction 0.5 long $D/x.hair"},
    };
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; ++i) {
        char command[256], sentence[64];
        snprintf(command, sizeof command, "$T %s", wrong[i][1]);
        snprintf(sentence, sizeof sentence, "--%s is not an option of", wrong[i][0]);
        expect(2, command, sentence);
    }
    expect(1, "test -e $D/x.hair", "");
}

static void bad_input_exits_with_4(void** state)
{
    (void)state;
    expect(4, "$T info $D/missing.hair", "missing.hair: No such file");
    expect(4, "$T info $D", "Is a directory");
    expect(4, "$T info /dev/null", "byte 0");
    expect(4, "head -c 100 $D/a.hair | $T info -", "byte 100");
    expect(4, "echo hello | $T convert - $D/y.hair", "byte 0");
    expect(4, "$T info --scale 1e-6 $D/a.hair", "3 are shorter than 10 micrometres");
    expect(1, "test -e $D/y.hair", "");
}

static void unwritable_output_exits_with_1_and_leaves_no_file(void** state)
{
    (void)state;
    expect(1, "$T convert $D/a.hair /dev/full", "cannot write /dev/full: No space left");
    expect(1, "$T info $D/a.hair > /dev/full", "cannot write to the standard output: No space left");
    expect(1, "$T convert $D/a.hair - > /dev/full", "No space left");
    expect(1, "$T convert $D/a.hair $D/no/b.hair", "No such file");
    expect(0,
           "echo old > $D/old.hair; chmod 640 $D/old.hair; ln -s old.hair $D/link.hair; "
           "$T convert $D/a.hair $D/link.hair && test -L $D/link.hair && stat -c %a $D/old.hair && "
           "$T info $D/old.hair",
           "640");
    expect(0, "ls $D | grep -c 'hair\\.......' || true", "0"); // There are no temporary files.
}

static void closed_pipe_is_a_failed_write(void** state)
{
    (void)state;
    expect(0,
           "{ $T generate long - --guides 4096 --vertices 256; echo exit $? >&2; } | head -c 10 >/dev/null",
           "exit 1");
}

static void help_and_version_are_printed(void** state)
{
    (void)state;
    expect(0, "$T --help", "--tip-first");
    expect(0, "$T -h", "Exit status");
    expect(0, "$T --version", "hair-groom 0.");
    hair_test_shell_expect_full("--help");
    hair_test_shell_expect_full("--version");
    // Help is printed at once, ignoring the arguments that follow.
    expect(0, "$T info --help --scale", "--scale");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(info_prints_the_contents_of_a_haircut),
        cmocka_unit_test(info_prints_repairs),
        cmocka_unit_test(haircuts_are_read_from_pipes_and_written_to_them),
        cmocka_unit_test(inputs_without_an_end_are_read_as_far_as_their_format_goes),
        cmocka_unit_test(inputs_that_claim_too_much_are_refused_by_their_beginning),
        cmocka_unit_test(text_that_is_printed_is_escaped),
        cmocka_unit_test(every_format_converts_to_every_writable_format),
        cmocka_unit_test(every_loss_of_a_conversion_has_a_sentence),
        cmocka_unit_test(built_in_haircuts_are_written),
        cmocka_unit_test(wrong_use_exits_with_2),
        cmocka_unit_test(options_of_another_command_are_wrong_use),
        cmocka_unit_test(bad_input_exits_with_4),
        cmocka_unit_test(unwritable_output_exits_with_1_and_leaves_no_file),
        cmocka_unit_test(closed_pipe_is_a_failed_write),
        cmocka_unit_test(help_and_version_are_printed),
    };
    return cmocka_run_group_tests(tests, make_folder, hair_test_shell_finish);
}
