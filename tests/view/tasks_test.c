// tasks_test.c - what a newcomer wants to do in the window of hair-view takes at most three clicks,
// without scrolling, in a window of 1280 by 720 pixels.
#include "tests/support/shell.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <cmocka.h>

#define TOOL HAIR_BUILD_DIR "/hair-view"
#define MAX_CLICKS 3

// A task. Clicks are counted in the script, which may also move the mouse, type and wait. The time
// is paused, except where it must run. `check` is a shell command in the folder of the task, which
// has 0.json and 1.json from before and after the script, and the state of the window in r.json.
struct task {
    const char *name, *script, *check;
    int frames, quality;
};

static const struct task tasks[] = {
    {"open a haircut", "click Browse\nclick bob.tfx\n", "grep '\"groom\": .*/bob.tfx' 1.json", 25, 4},
    {"comb by pulling",
     "key Space\nmove 605 228\npress Left Ctrl\ndown left\nmove 640 210\nwait 5\nreport held.json\nup left\n"
     "release Left Ctrl\n",
     "grep -q '\"held\"' held.json && ! grep '\"held\"' r.json", 25, 4},
    {"make it blond and curly", "click Colour\nclick blond\nclick Curly\n",
     "grep -q '\"color.root.r\"' 1.json && grep '\"curl.radius\"' 1.json", 30, 4},
    {"put it in wind", "click Wind\n", "grep '\"wind.x\": \"4\"' 1.json", 20, 4},
    {"find what costs most", "", "grep -A4 '\"stages\"' r.json | grep '\"ms\": [0-9.]*[1-9]'", 20, 4},
    {"halve the time", "click Faster\nwait 36\nclick Halve the time\n", "grep 'Took .* ms, FLIP' r.json", 65,
     0},
    {"see what error that makes", "click motion\nwait 8\nclick Pause\nclick image\nwait 10\n",
     "grep -q '\"flip\"' r.json && grep '\"rms\"' r.json", 50, 2},
    {"save", "click Save\n", "cmp 1.json scene.json", 20, 4},
    {"film", "click Record\nwait 6\nclick Record\n",
     "test -s hair-view-1.mp4 && grep 'Wrote the film' r.json", 30, 4},
    {"report a defect with a scene file", "click Bug report\n",
     "cmp 1.json hair-view-1-bug.json && test -s hair-view-1-bug.png && grep '\"renderer\"' "
     "hair-view-1-bug-state.json",
     20, 4},
};
#define TASKS (sizeof tasks / sizeof *tasks)

static int count_clicks(const char* script)
{
    int clicks = 0;
    for (const char* line = script; *line; line = strchr(line, '\n') + 1)
        clicks += !strncmp(line, "click ", 6) || !strncmp(line, "down ", 5) || !strncmp(line, "drag ", 5);
    return clicks;
}

static void run(const struct task* task)
{
    char command[1024];
    hair_test_shell_expect(0, "rm -rf $D/task && mkdir $D/task && cp $D/bob.tfx $D/task", "");
    FILE* file = hair_test_shell_create("task/s", "");
    fprintf(file, "wait 3\nsave 0.json\n%swait 3\nsave 1.json\nreport r.json\n", task->script);
    fclose(file);
    snprintf(command, sizeof command,
             "cd $D/task && $T ../small.json --set guides=100 --set followers=1000 --size 1280x720 "
             "--scale 1 --quality %d --script s --frames %d --save scene.json && %s",
             task->quality, task->frames, task->check);
    hair_test_shell_expect(0, command, "");
}

static void newcomers_need_at_most_three_clicks(void** state)
{
    (void)state;
    hair_test_shell_expect(0, HAIR_BUILD_DIR "/hair-groom generate bob $D/bob.tfx --guides 40", "");
    for (size_t i = 0; i < TASKS; ++i) {
        int clicks = count_clicks(tasks[i].script);
        print_message("    %s: %d clicks\n", tasks[i].name, clicks);
        assert_true(clicks <= MAX_CLICKS);
        run(&tasks[i]);
    }
}

static int start(void** state)
{
    (void)state;
    return hair_test_shell_start_capture(TOOL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(newcomers_need_at_most_three_clicks)};
    return cmocka_run_group_tests(tests, start, hair_test_shell_finish);
}
