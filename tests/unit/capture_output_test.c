// capture_output_test.c - output of hair-capture: hashes, pictures, videos and statistics. Output
// that fails leaves no file behind, and keeps an old one.
#define _XOPEN_SOURCE 700
#include "tests/support/shell.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>
#include <cmocka.h>

#define TOOL HAIR_BUILD_DIR "/hair-capture"

// The least hair and the fewest pixels that suffice. The head takes longest to make.
#define SMALL "$D/small.json --samples 1"
#define WITH_HEAD "--size 64x36 --followers 300 --guides 32 --samples 1 --set redblack.iterations=2"

// Check that no temporary file is left.
#define ANY "[A-Za-z0-9]"
#define TEMPORARY "*." ANY ANY ANY ANY ANY ANY
#define CLEAN " && test -z \"$(find $D -name '" TEMPORARY "')\""

#define expect hair_test_shell_expect

static void hashes_are_equal_twice_and_with_any_thread_count(void** state)
{
    (void)state;
    expect(0,
           "$T --hash --frames 2:4 " WITH_HEAD " >$D/1 && for n in 0 1 $(nproc); do LP_NUM_THREADS=$n "
           "$T --hash --frames 2:4 " WITH_HEAD " >$D/2 && cmp $D/1 $D/2 || exit; done",
           "");
    expect(0, "cat $D/1", "strands ");
    assert_non_null(strstr(hair_test_said, "\npixels "));
    assert_int_equal(strlen(hair_test_said), strlen("strands 0123456789abcdef\npixels 0123456789abcdef\n"));
}

// Check that captures differ in both lines: the hash of strands and the hash of pixels.
static void hashes_of_different_captures_differ(void** state)
{
    (void)state;
    static const char* const others[] = {"--frames 3:5",
                                         "--frames 2:4 --style bob",
                                         "--frames 2:4 --seed 7",
                                         "--frames 2:4 --set gravity.y=-5",
                                         "--frames 2:4 --motion still",
                                         "--frames 2:4 --solver follow",
                                         "--frames 2:4 --set preset=wet"};
    expect(0, "$T --hash --frames 2:4 " SMALL " >$D/1", "");
    for (size_t i = 0; i < sizeof others / sizeof *others; ++i) {
        char command[512];
        snprintf(command, sizeof command, "$T --hash %s " SMALL " >$D/2; cat $D/1 $D/2 | sort | uniq | wc -l",
                 others[i]);
        expect(0, command, "4\n");
    }
    // The look does not change the strands.
    expect(0,
           "$T --hash --frames 2:4 " SMALL
           " --set color.root.r=0.9 >$D/2; cat $D/1 $D/2 | sort | uniq | wc -l",
           "3\n");
}

static void frame_alone_equals_the_frame_in_a_sequence(void** state)
{
    (void)state;
    expect(0, "$T " SMALL " --frames 0:4 -o $D/f_%03d.png && $T " SMALL " --frames 3:4 -o $D/f.png", "");
    expect(0, "cmp $D/f.png $D/f_003.png && test $(ls $D/f_*.png | wc -l) = 4" CLEAN, "");
    expect(0, "! cmp -s $D/f_000.png $D/f_003.png", "");
    expect(0, "$T " SMALL " --frames 3:4 -o $D/f_%d.png && cmp $D/f.png $D/f_3.png", "");
}

static void pictures_and_videos_have_the_format_of_their_name(void** state)
{
    (void)state;
    expect(0, "$T " SMALL " --frames 0:1 -o $D/p.png && head -c 8 $D/p.png | od -An -tx1",
           "89 50 4e 47 0d 0a 1a 0a");
    expect(0, "$T " SMALL " --frames 0:1 -o $D/p.exr && head -c 4 $D/p.exr | od -An -tx1", "76 2f 31 01");
    expect(0, "$T " SMALL " --frames 0:2 -o $D/p.y4m && head -n 1 $D/p.y4m",
           "YUV4MPEG2 W64 H36 F30000:1000 Ip A1:1 C420jpeg");
    // A header line, and then twice "FRAME" with 1.5 bytes per pixel.
    expect(0, "test $(tail -n +2 $D/p.y4m | wc -c) = $((2 * (6 + 64 * 36 * 3 / 2)))", "");
    expect(0, "$T " SMALL " --frames 0:2 -o - | cmp - $D/p.y4m", "");
    expect(0, "$T " SMALL " --size 1x1 --frames 0:1 -o - | tail -n 1 | wc -c", "3\n");
    expect(0, "$T " SMALL " --size 3x5 --frames 0:1 -o - | wc -c", "");
    expect(0, "$T " SMALL " --size 1x1 --frames 0:1 -o $D/1.png && test -s $D/1.png" CLEAN, "");
}

static void mp4_can_be_played_before_it_is_complete(void** state)
{
    (void)state;
    expect(0, "$T " SMALL " --frames 0:3 -o $D/v.mp4 && head -c 8 $D/v.mp4 | tail -c 4", "ftyp");
    expect(0,
           "test $(grep -abo moov $D/v.mp4 | cut -d: -f1) -lt $(grep -abo mdat $D/v.mp4 | cut -d: -f1)" CLEAN,
           "");
    // 3 x 64 x 36.
    expect(0, "ffmpeg -v error -i $D/v.mp4 -f rawvideo -pix_fmt gray - | wc -c", "6912\n");
}

static void an_encoder_that_fails_leaves_no_video(void** state)
{
    (void)state;
    expect(1, "PATH=/nonexistent $T " SMALL " --frames 0:1 -o $D/w.mp4", "cannot start ffmpeg");
    expect(0, "mkdir -p $D/bin && printf '#!/bin/sh\\nexit 7\\n' >$D/bin/ffmpeg && chmod +x $D/bin/ffmpeg",
           "");
    expect(1, "PATH=$D/bin:$PATH $T " SMALL " --frames 0:30 -o $D/w.mp4", "ffmpeg");
    expect(0, "printf '#!/bin/sh\\ncat >/dev/null; kill -9 $$\\n' >$D/bin/ffmpeg", "");
    expect(1, "PATH=$D/bin:$PATH $T " SMALL " --frames 0:2 -o $D/w.mp4", "status 137");
    expect(0, "! test -e $D/w.mp4" CLEAN, "");
}

static void full_disk_exits_with_1_and_keeps_the_device_file(void** state)
{
    (void)state;
    expect(1, "$T " SMALL " --frames 0:2 -o /dev/full", "No space left");
    expect(0, "ln -s /dev/full $D/full.png && ln -s /dev/full $D/full.exr && ln -s /dev/full $D/full.mp4",
           "");
    expect(1, "$T " SMALL " --frames 0:1 -o $D/full.png", "full.png");
    expect(1, "$T " SMALL " --frames 0:1 -o $D/full.exr", "full.exr");
    expect(1, "$T " SMALL " --frames 0:2 -o $D/full.mp4", "ffmpeg");
    expect(1, "$T " SMALL " --frames 0:1 --stats /dev/full", "No space left");
    expect(1, "$T " SMALL " --frames 0:1 --hash >/dev/full", "cannot write");
    expect(0, "test -c /dev/full && test -L $D/full.png && test -L $D/full.mp4", "");
}

static void output_that_is_no_regular_file_is_written_in_place(void** state)
{
    (void)state;
    expect(0, "$T " SMALL " --frames 0:1 -o /dev/null && test -c /dev/null", "");
    expect(0,
           "mkfifo $D/p.fifo; $T " SMALL " --frames 0:1 -o $D/p.fifo & head -n 1 $D/p.fifo && wait $!; "
           "test -p $D/p.fifo",
           "YUV4MPEG2");
    expect(0, "$T " SMALL " --frames 0:1 -o /dev/stdout | head -n 1", "YUV4MPEG2");
}

static void closed_pipe_exits_with_1(void** state)
{
    (void)state;
    expect(1,
           "{ $T " SMALL " --size 640x360 --frames 0:9 -o -; echo $? >$D/code; } | head -c 9 >/dev/null; "
           "exit $(cat $D/code)",
           "Broken pipe");
}

static void interrupted_capture_exits_with_1_and_keeps_the_old_file(void** state)
{
    (void)state;
    static const char* const names[] = {"i.y4m", "i.mp4"};
    for (int i = 0; i < 2; ++i) {
        char command[512];
        snprintf(command, sizeof command,
                 "echo old >$D/%s; $T " SMALL " --frames 0:100000 -o $D/%s & "
                 "while ! ls $D/" TEMPORARY
                 " >/dev/null 2>&1; do sleep 0.02; done; sleep 0.2; kill -INT $!; wait $!",
                 names[i], names[i]);
        // A busy machine may not finish its frame in time.
        expect(1, command, "interrupted ");
        snprintf(command, sizeof command, "cat $D/%s" CLEAN, names[i]);
        expect(0, command, "old\n");
    }
}

// Check a frame that takes minutes. A busy machine may need seconds to end the process.
static void interrupt_within_a_frame_exits_with_1_in_time(void** state)
{
    (void)state;
    const char* command = "$T --size 2048x2048 --samples 8 --supersample 4 --frames 0:1 -o $D/w.mp4 & "
                          "while ! ls $D/" TEMPORARY " >/dev/null 2>&1; do sleep 0.02; done; sleep 1; "
                          "kill -TERM $!; date +%s >$D/then; wait $!; code=$?; "
                          "[ $(($(date +%s) - $(cat $D/then))) -le 20 ] && exit $code; exit 99";
    expect(1, command, "interrupted within a frame");
    expect(0, "true" CLEAN, "");
}

static void missing_output_folder_exits_with_1(void** state)
{
    (void)state;
    expect(1, "$T " SMALL " --frames 0:1 -o $D/none/a.png", "none/a.png");
    expect(1, "$T " SMALL " --frames 0:1 -o $D/none/a_%d.png", "none/a_");
    expect(1, "$T " SMALL " --frames 0:1 --stats $D/none/s.json", "none/s.json");
}

static void stats_contain_what_was_drawn(void** state)
{
    (void)state;
    expect(0, "$T " SMALL " --frames 0:2 --stats $D/s.json && cat $D/s.json", "\"suite\": \"capture\"");
    assert_non_null(strstr(hair_test_said, "\"renderer\": \""));
    assert_non_null(strstr(hair_test_said, "\"followers\": 300"));
    assert_non_null(strstr(hair_test_said, "\"method\": \"sim/mixed"));
    assert_null(strstr(hair_test_said, "redblack")); // A pass that has not run is not listed.
    assert_null(strstr(hair_test_said, "\"runs\": 0"));
    assert_non_null(strstr(hair_test_said, "\"solver_stats\": {\n    \"euler_fallbacks\": "));
    assert_non_null(strstr(hair_test_said, "\"reset\": 0"));
    assert_non_null(strstr(hair_test_said, "\"substep\": 0.00416667"));
    assert_non_null(strstr(hair_test_said, "\"import_stats\""));
    expect(0, "$T " SMALL " --frames 0:2 --stats - | cmp -n 20 - $D/s.json", "");
}

// Check header, size and order of dumps of the guides and followers of frames.
static void dumps_contain_the_positions_of_every_frame(void** state)
{
    (void)state;
    expect(0, "$T " SMALL " --frames 2:5 --dump-guides $D/g.dump --dump-followers $D/f.dump" CLEAN, "");
    expect(0, "head -c 8 $D/g.dump", "HAIRDUMP");
    expect(0, "od -An -tu4 -j8 -N24 -w24 $D/g.dump | tr -s ' '", " 1 32 63 3 2 0\n");
    expect(0, "od -An -tu4 -j8 -N24 -w24 $D/f.dump | tr -s ' '", " 1 300 33 3 2 1\n");
    expect(0, "od -An -tf8 -j32 -N8 $D/g.dump | tr -d ' '", "30\n");
    expect(0, "stat -c %s $D/g.dump $D/f.dump | xargs", "72616 356440\n");
    // Drawing does not change positions, and frames are in order.
    expect(0, "$T " SMALL " --frames 2:5 --dump-followers - -o $D/d.y4m | cmp - $D/f.dump", "");
    expect(0,
           "$T " SMALL
           " --frames 4:5 --dump-guides - | tail -c 24192 >$D/4; tail -c 24192 $D/g.dump | cmp - $D/4",
           "");
    expect(0, "! head -c 24232 $D/g.dump | tail -c 24192 | cmp -s - $D/4", "");
}

// Return the maximum difference of the numbers of two dumps, which have the same number of frames.
static float differ(const char* first, const char* second)
{
    static float numbers[2][65536];
    const char* const names[] = {first, second};
    size_t count[2];
    float max = 0;
    for (int i = 0; i < 2; ++i) {
        char path[512];
        snprintf(path, sizeof path, "%s/%s", hair_test_folder(), names[i]);
        FILE* file = fopen(path, "rb");
        assert_non_null(file);
        assert_int_equal(fseek(file, 40, SEEK_SET), 0);
        count[i] = fread(numbers[i], sizeof(float), 65536, file);
        fclose(file);
    }
    assert_true(count[0] == count[1] && count[0] > 1000);
    for (size_t i = 0; i < count[0]; ++i) max = fmaxf(max, fabsf(numbers[0][i] - numbers[1][i]));
    return max;
}

// Check that hair plays back a cache of a shaken head by another solver, which by itself moves
// otherwise. Samples of a dump lie between vertices, so that 0.1 mm is lost. After the last frame
// the hair is simulated.
static void a_cache_is_played_back(void** state)
{
    (void)state;
    expect(0, "$T " SMALL " --motion shake --frames 0:8 --dump-guides $D/c.dump" CLEAN, "");
    expect(0, "$T " SMALL " --solver follow --frames 0:8 --cache $D/c.dump --dump-guides $D/p.dump" CLEAN,
           "");
    expect(0, "$T " SMALL " --solver follow --frames 0:8 --dump-guides $D/o.dump" CLEAN, "");
    assert_true(differ("c.dump", "p.dump") < 2e-4f && differ("c.dump", "o.dump") > 1e-3f);
    expect(0, "$T " SMALL " --frames 0:30 --cache $D/c.dump --hash", "strands ");
    expect(4, "head -c 1000 $D/c.dump >$D/s.dump; $T " SMALL " --frames 0:2 --hash --cache $D/s.dump",
           "not the 193576 of a header and 8 frames");
    expect(4, "$T " SMALL " --frames 0:2 --hash --cache $D/small.json", "HAIRDUMP");
    expect(4, "$T " SMALL " --frames 0:2 --hash --guides 24 --cache $D/c.dump", "is 32, not the");
    expect(4, "$T " SMALL " --frames 0:2 --hash --cache $D/none.dump", "none.dump");
}

static void a_dump_that_fails_leaves_no_output(void** state)
{
    (void)state;
    expect(1, "$T " SMALL " --frames 0:2 --dump-guides $D/n.dump --dump-followers /dev/full", "cannot write");
    expect(0, "! test -e $D/n.dump" CLEAN, "");
    expect(1, "$T " SMALL " --frames 0:2 -o $D/n.y4m --dump-guides $D/none/n.dump", "none/n.dump");
    expect(0, "! test -e $D/n.y4m" CLEAN, "");
    expect(2, "$T " SMALL " --dump-guides $D/n.txt", ".dump");
    expect(2, "$T " SMALL " --dump-guides - --hash", "--dump-guides -");
}

static int start(void** state)
{
    (void)state;
    return hair_test_shell_start_capture(TOOL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(hashes_are_equal_twice_and_with_any_thread_count),
        cmocka_unit_test(hashes_of_different_captures_differ),
        cmocka_unit_test(frame_alone_equals_the_frame_in_a_sequence),
        cmocka_unit_test(pictures_and_videos_have_the_format_of_their_name),
        cmocka_unit_test(mp4_can_be_played_before_it_is_complete),
        cmocka_unit_test(an_encoder_that_fails_leaves_no_video),
        cmocka_unit_test(full_disk_exits_with_1_and_keeps_the_device_file),
        cmocka_unit_test(output_that_is_no_regular_file_is_written_in_place),
        cmocka_unit_test(closed_pipe_exits_with_1),
        cmocka_unit_test(interrupted_capture_exits_with_1_and_keeps_the_old_file),
        cmocka_unit_test(interrupt_within_a_frame_exits_with_1_in_time),
        cmocka_unit_test(missing_output_folder_exits_with_1),
        cmocka_unit_test(stats_contain_what_was_drawn),
        cmocka_unit_test(dumps_contain_the_positions_of_every_frame),
        cmocka_unit_test(a_cache_is_played_back),
        cmocka_unit_test(a_dump_that_fails_leaves_no_output),
    };
    return cmocka_run_group_tests(tests, start, hair_test_shell_finish);
}
