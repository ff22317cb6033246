// file.h - Reading of whole files, atomic output files, error messages and exit statuses of a tool.
//
// A function that fails prints "TOOL: sentence" to stderr before it returns.
#ifndef HAIR_TOOLS_COMMON_FILE_H
#define HAIR_TOOLS_COMMON_FILE_H

#include <stdbool.h>
#include <stdio.h>

#include <hair/hair.h>

// Exit statuses of every tool.
enum { HAIR_EXIT_OK = 0, HAIR_EXIT_RUNTIME, HAIR_EXIT_USAGE, HAIR_EXIT_OPENGL, HAIR_EXIT_INPUT };

// Return the exit status of a tool for a result of the library.
int hair_exit_for(hair_result result);

// Print a message. Use this as hair_host.log with the tool's name, such as "hair-groom", as user.
// HAIR_LOG_INFO is not printed.
void hair_print_log(hair_log_level level, const char* sentence, void* tool);

// Return "TOOL: PATH" for use as that user while a file is read, such that each message names the
// file. The string is valid until the next call.
const char* hair_log_name(const char* tool, const char* path);

// Flush the standard output. Return HAIR_EXIT_OK, or HAIR_EXIT_RUNTIME if any output was lost.
int hair_flush(const char* tool);

// Print "TOOL: sentence" to stderr, escaped as hair_escape() does.
void hair_complain(const char* tool, const char* format, ...) __attribute__((format(printf, 2, 3)));

// Pass each later message also to a function, on the thread of the message. NULL ends this.
void hair_complain_to(void (*hear)(const char* sentence, void* user), void* user);

// Say that getopt_long() cannot use the argument before optind. Its own message would not be
// escaped, so set opterr to 0.
void hair_complain_option(const char* tool, const char* argument);

// Write `text` with control characters and bytes that are not UTF-8 as \x1b, so that text of a file
// cannot command a terminal. The result ends at `size`.
void hair_escape(const char* text, char* out, size_t size);

struct hair_bytes {
    unsigned char* data; // release with free()
    size_t size;
};

// Read all of a file, pipe or device. "-" is the standard input. More than `limit` bytes are an
// error.
bool hair_file_read(const char* tool, const char* path, size_t limit, struct hair_bytes* out);

// Read a haircut. Do not read beyond the size that its beginning allows, plus one byte.
bool hair_file_read_haircut(const char* tool, const char* path, size_t limit, struct hair_bytes* out);

// An output file. A regular file appears under its name only when it is committed. A pipe, a device
// or "-" (the standard output) is written in place.
struct hair_output {
    FILE* file; // stream to write to
    const char* tool;
    char* path;
    char* temporary; // NULL if written in place
};

// Open an output. `tool` must outlive the output. End each opened output with exactly one of commit
// and discard.
bool hair_output_open(const char* tool, const char* path, struct hair_output* out);
bool hair_output_commit(struct hair_output* output); // A failure discards the output.
void hair_output_discard(struct hair_output* output);

// Return whether the name of an output ends in `ending`, such as ".csv", or in no ending at all.
// Print an error otherwise, because the user may expect another format.
bool hair_output_has_ending(const char* tool, const char* path, const char* ending);

// Remove the temporary files of all open outputs. A signal handler that ends the program may call
// this.
void hair_output_remove_all(void);

#endif
