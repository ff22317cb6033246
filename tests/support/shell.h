// shell.h - a tool run as its users run it: shell commands, exit codes and output.
#ifndef HAIR_TESTS_SUPPORT_SHELL_H
#define HAIR_TESTS_SUPPORT_SHELL_H

#include <jansson.h>
#include <stdio.h>

// Create a new folder. For cmocka_run_group_tests(). `tool` is a path.
int hair_test_shell_start(const char* tool);
// Create a new folder that holds small.json, a scene that hair-capture renders quickly.
int hair_test_shell_start_capture(const char* tool);
// Remove the folder. For cmocka_run_group_tests().
int hair_test_shell_finish(void** state);
const char* hair_test_folder(void); // Return the path of the folder.
// Create a file in the folder, or fail. The caller closes it. `ending` may be "".
FILE* hair_test_shell_create(const char* name, const char* ending);

extern char hair_test_said[65536]; // output of the last command, both streams

// Run a shell command in which $T is the tool and $D the folder. Return its exit code.
int hair_test_shell(const char* command);

// Run a command that must exit with `code` and print `words`.
void hair_test_shell_expect(int code, const char* command, const char* words);

// Return shell text that limits the memory of the commands after it to that many KiB. The text is
// empty with a sanitizer, which reserves terabytes of addresses. The next call overwrites the text.
const char* hair_test_shell_limit(unsigned kib);

// Load a JSON file from the folder, or fail. The caller releases it.
json_t* hair_test_shell_json(const char* name);
// Return the number that an object has under a key, or 0 without one.
double hair_test_json_number(const json_t* object, const char* key);

// Check that the tool reports output that cannot be written, even if part of the output is written
// before the end.
void hair_test_shell_expect_full(const char* arguments);

#endif
