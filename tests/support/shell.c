// shell.c - a tool run as its users run it: shell commands, exit codes and output.
#define _XOPEN_SOURCE 700
#include "tests/support/shell.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>
#include <cmocka.h>

char hair_test_said[65536];

static char folder[64];
static char program[4096];

int hair_test_shell_start(const char* tool)
{
    snprintf(folder, sizeof folder, "/tmp/hair-shell-test-XXXXXX");
    return realpath(tool, program) && mkdtemp(folder) ? access(program, X_OK) : -1;
}

int hair_test_shell_finish(void** state)
{
    (void)state;
    return hair_test_shell("rm -r \"$D\"");
}

const char* hair_test_folder(void)
{
    return folder;
}

FILE* hair_test_shell_create(const char* name, const char* ending)
{
    char path[512];
    assert_in_range(snprintf(path, sizeof path, "%s/%s%s", folder, name, ending), 1, sizeof path - 1);
    FILE* file = fopen(path, "wb");
    assert_non_null(file);
    return file;
}

int hair_test_shell(const char* command)
{
    static char line[8192];
    int length = snprintf(line, sizeof line, "{ T=%s; D=%s; %s\n} 2>&1", program, folder, command);
    assert_in_range(length, 1, sizeof line - 1);
    FILE* pipe = popen(line, "r");
    assert_non_null(pipe);
    size_t size = fread(hair_test_said, 1, sizeof hair_test_said - 1, pipe);
    hair_test_said[size] = 0;
    assert_in_range(size, 0, sizeof hair_test_said - 2); // Longer output would be cut off.
    int status = pclose(pipe);
    assert_true(WIFEXITED(status));
    return WEXITSTATUS(status);
}

void hair_test_shell_expect(int code, const char* command, const char* words)
{
    int got = hair_test_shell(command);
    if (got != code || !strstr(hair_test_said, words))
        fail_msg("%s: exit %d, not %d; said \"%s\", without \"%s\"", command, got, code, hair_test_said,
                 words);
}

const char* hair_test_shell_limit(unsigned kib)
{
    static char text[32];
#if !defined __SANITIZE_ADDRESS__ && !defined __SANITIZE_THREAD__
    snprintf(text, sizeof text, "ulimit -v %u; ", kib);
#else
    (void)kib;
#endif
    return text;
}

json_t* hair_test_shell_json(const char* name)
{
    char path[256];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    json_t* root = json_load_file(path, 0, NULL);
    assert_non_null(root);
    return root;
}

double hair_test_json_number(const json_t* object, const char* key)
{
    return json_number_value(json_object_get(object, key));
}

void hair_test_shell_expect_full(const char* arguments)
{
    char command[256];
    snprintf(command, sizeof command, "$T %s >/dev/full", arguments);
    hair_test_shell_expect(1, command, "cannot write to the standard output: No space left");
}

int hair_test_shell_start_capture(const char* tool)
{
    if (hair_test_shell_start(tool)) return -1;
    return hair_test_shell(
        "echo '{\"head\": false, \"motion\": \"demo\", \"size\": [64, 36], \"settings\":"
        " {\"followers\": 300, \"guides\": 32, \"redblack.iterations\": 2}}' >$D/small.json");
}
