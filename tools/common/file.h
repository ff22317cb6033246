// file.h - whole files into memory, output that is never seen half written, and the complaints of a tool.
//
// What fails says so on stderr, as "TOOL: sentence", before it returns.
#ifndef HAIR_TOOLS_COMMON_FILE_H
#define HAIR_TOOLS_COMMON_FILE_H

#include <stdbool.h>
#include <stdio.h>

#include <hair/hair.h>

// What every tool exits with.
enum { HAIR_EXIT_OK = 0, HAIR_EXIT_RUNTIME, HAIR_EXIT_USAGE, HAIR_EXIT_OPENGL, HAIR_EXIT_INPUT };

// For hair_host.log, with `tool` ("hair-groom") as its user. Leaves out HAIR_LOG_INFO.
void hair_print_log(hair_log_level level, const char* sentence, void* tool);

// "TOOL: PATH", to be such a user while a file is read, so that one sentence says which. Lives until the next call.
const char* hair_log_name(const char* tool, const char* path);

// What was printed on the standard output is there: HAIR_EXIT_OK, else HAIR_EXIT_RUNTIME.
int hair_flush(const char* tool);

void hair_complain(const char* tool, const char* format, ...) __attribute__((format(printf, 2, 3)));

struct hair_bytes {
    unsigned char* data; // free() it
    size_t size;
};

// All of a file, pipe or device; "-" is the standard input. More than `limit` bytes is a failure.
bool hair_file_read(const char* tool, const char* path, size_t limit, struct hair_bytes* out);

// A file being written. It appears under its name only when committed; what is not a regular file (a pipe, a
// device, "-" for the standard output) is written in place.
struct hair_output {
    FILE* file; // write here
    const char* tool;
    char* path;
    char* temporary; // NULL: in place
};

// `tool` must outlive the output. Each opened output is ended by exactly one of commit and discard.
bool hair_output_open(const char* tool, const char* path, struct hair_output* out);
bool hair_output_commit(struct hair_output* output); // On failure it is discarded.
void hair_output_discard(struct hair_output* output);

#endif
