// refusal.h - a driver that refuses objects, memory, mappings, compilation and limits on demand,
// and counts the objects that live.
#ifndef HAIR_TESTS_SUPPORT_REFUSAL_H
#define HAIR_TESTS_SUPPORT_REFUSAL_H

#include <stdbool.h>
#include <stdint.h>

// Calls of OpenGL that a test may have refused. Each such call is a site.
enum hair_test_refusable {
    // Buffers, textures, vertex arrays, samplers, programs, shaders and the memory of buffers.
    HAIR_TEST_REFUSE_OBJECTS = 1,
    HAIR_TEST_REFUSE_MEMORY = 2, // Memory of textures, texture buffers, and growth of buffers.
    HAIR_TEST_REFUSE_MAPS = 4,
    HAIR_TEST_REFUSE_FRAMES = 8, // Framebuffers, their completeness, and transform feedback.
    HAIR_TEST_REFUSE_QUERIES = 16, // Queries, fences and waits for them.
    HAIR_TEST_REFUSE_PROGRAMS = 32, // Success of compilation, linking and loading of binaries.
    HAIR_TEST_REFUSE_LIMITS = 64, // Sizes that the driver says are possible.
    HAIR_TEST_REFUSE_ALL = 127,
    HAIR_TEST_REFUSE_FUNCTIONS = 128 // Addresses of functions.
};

// Creations of objects and of their memory in all contexts of hair_test_refusing_proc().
struct hair_test_refusal {
    unsigned refusable; // Kinds of sites that are counted. HAIR_TEST_REFUSE_OBJECTS at first.
    uint32_t creations; // Number of sites so far.
    uint32_t refuse; // Number of the site that fails, from 1. 0 refuses none.
    bool is_lasting; // True if all later sites fail too.
    uint32_t refused; // Number of sites that have failed.
    const char* last; // Function that has failed last.
    int32_t live; // Number of objects that are created and not deleted.
};
extern struct hair_test_refusal hair_test_refusal;

// Return a function of OpenGL, as hair_context_desc.get_proc does.
void* hair_test_refusing_proc(const char* name, void* user);

#endif
