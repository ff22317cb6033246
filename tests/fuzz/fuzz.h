// fuzz.h - support of the fuzz programs: a target per parser, memory that is refused, and a sink
// for the text that parsers print.
//
// A target is written once. With HAIR_FUZZ_PROGRAM it is the only one of a libFuzzer program.
// Without it, all targets are linked into a program that replays the corpus.
#ifndef HAIR_TESTS_FUZZ_FUZZ_H
#define HAIR_TESTS_FUZZ_FUZZ_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <hair/hair.h>

// Parse bytes and check the properties of what is accepted. Add the accepted content to *hash.
// Return whether the parser accepts the bytes.
typedef bool hair_fuzz_function(const uint8_t* bytes, size_t size, uint64_t* hash);

struct hair_fuzz_target {
    const char* name; // also the folder of the corpus
    hair_fuzz_function* function;
};

// Targets of a replay. A target without a name ends the list.
extern const struct hair_fuzz_target hair_fuzz_targets[];

hair_fuzz_function hair_fuzz_hairfile, hair_fuzz_groomfile, hair_fuzz_tfx, hair_fuzz_tfx_text, hair_fuzz_obj,
    hair_fuzz_scene, hair_fuzz_save, hair_fuzz_members, hair_fuzz_groom_arguments,
    hair_fuzz_capture_arguments, hair_fuzz_bench_arguments, hair_fuzz_gltf;

// Run a target on one input. By a hash of the input, run the target also with an allocation that
// fails.
bool hair_fuzz_run(hair_fuzz_function* function, const uint8_t* bytes, size_t size, uint64_t* hash);

// Define a target.
#ifdef HAIR_FUZZ_PROGRAM
#define HAIR_FUZZ(name)                                                                                      \
    int LLVMFuzzerTestOneInput(const uint8_t* bytes, size_t size);                                           \
    int LLVMFuzzerTestOneInput(const uint8_t* bytes, size_t size)                                            \
    {                                                                                                        \
        uint64_t hash = 0;                                                                                   \
        hair_fuzz_run(hair_fuzz_##name, bytes, size, &hash);                                                 \
        return 0;                                                                                            \
    }                                                                                                        \
    bool hair_fuzz_##name(const uint8_t* bytes, size_t size, uint64_t* hash)
#else
#define HAIR_FUZZ(name) bool hair_fuzz_##name(const uint8_t* bytes, size_t size, uint64_t* hash)
#endif

// Abort with the condition and its place unless the condition holds.
#define HAIR_FUZZ_CHECK(condition) ((condition) ? (void)0 : hair_fuzz_fail(#condition, __FILE__, __LINE__))
_Noreturn void hair_fuzz_fail(const char* condition, const char* file, int line);

// Memory ------------------------------------------------------------------------------------------

// Host that counts memory and errors.
struct hair_fuzz_host {
    hair_host host;
    size_t live, peak; // bytes
    uint32_t blocks, errors;
    char sentence[512]; // last error
};
void hair_fuzz_host_init(struct hair_fuzz_host* host);

// Return whether an allocation has been refused since the target began.
bool hair_fuzz_was_refused(void);
// Allocate memory that is never refused. json_set_alloc_funcs() gives it to libjansson, which frees
// an invalid pointer if it runs out of memory within a string (version 2.14).
void* hair_fuzz_alloc(size_t size);
// Refuse no further allocation. A target calls this before it checks properties.
void hair_fuzz_end_refusals(void);

// Text --------------------------------------------------------------------------------------------

// Replace stdout and stderr by sinks without system calls, or restore them. The sinks check that no
// text can command a terminal.
void hair_fuzz_mute(void);
void hair_fuzz_unmute(void);
// Return the number of bytes that have been printed to stderr since hair_fuzz_mute().
size_t hair_fuzz_printed(void);

// Files -------------------------------------------------------------------------------------------

// Split bytes at their line ends into a command line. The first argument is `tool`. Arguments begin
// at arguments[0]. The caller frees the result.
char* hair_fuzz_split(const char* tool, const uint8_t* bytes, size_t size, int* count, char* arguments[],
                      int room);

// Hashes of accepted content, equal on all machines ----------------------------------------------

void hair_fuzz_add(uint64_t* hash, uint32_t value);
void hair_fuzz_add_floats(uint64_t* hash, const float* values, size_t count);
void hair_fuzz_add_text(uint64_t* hash, const char* text); // NULL is allowed.

#endif
