// shell.h - a tool as its users call it: shell commands, exit codes, words.
#ifndef HAIR_TESTS_SUPPORT_SHELL_H
#define HAIR_TESTS_SUPPORT_SHELL_H

#include <jansson.h>

// For cmocka_run_group_tests: a new folder, and its end. `tool` is a path.
int hair_test_shell_start(const char* tool);
int hair_test_shell_finish(void** state);
const char* hair_test_folder(void); // Where it is.

extern char hair_test_said[16384]; // By the last command, both streams.

// Run a shell command in which $T is the tool and $D the folder. Returns its exit code.
int hair_test_shell(const char* command);

// The command must exit with `code` and say `words`.
void hair_test_shell_expect(int code, const char* command, const char* words);

// Load a JSON file of the folder, or fail. The caller releases it.
json_t* hair_test_shell_json(const char* name);
// Return the number that an object has under a key, 0 without one.
double hair_test_json_number(const json_t* object, const char* key);

// The tool with such arguments must tell that what it prints cannot be written: also where some of that goes before the end.
void hair_test_shell_expect_full(const char* arguments);

#endif
