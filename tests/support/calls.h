// calls.h - every call that uses OpenGL, in a valid order.
#ifndef HAIR_TESTS_SUPPORT_CALLS_H
#define HAIR_TESTS_SUPPORT_CALLS_H

#include <epoxy/gl.h>
#include <hair/hair.h>

#define HAIR_TEST_CALLS 21 // Number of calls. The last destroys the context.

// Objects of an application that makes all calls.
struct hair_test_calls {
    const hair_host* host;
    hair_groom* groom;
    hair_context* context;
    hair_instance *hair, *twin; // The twin is in lists only.
    GLuint shadow, wind; // Textures of the application.
    hair_gl_state promise;
    int way; // Index of solver and mapping.
};

const char* hair_test_call_name(uint32_t number);
// Make one of the calls, which all calls before it must precede.
hair_result hair_test_call(struct hair_test_calls* f, uint32_t number);

#endif
