// refusal.h - a driver that refuses to create an object.
#ifndef HAIR_TESTS_SUPPORT_REFUSAL_H
#define HAIR_TESTS_SUPPORT_REFUSAL_H

#include <stdint.h>

// Creations of objects and of their memory in all contexts of hair_test_refusing_proc().
struct hair_test_refusal {
    uint32_t creations; // Number of creations so far.
    uint32_t refuse; // Number of the creation that fails, from 1. 0 refuses none.
};
extern struct hair_test_refusal hair_test_refusal;

// Return a function of OpenGL, as hair_context_desc.get_proc does.
void* hair_test_refusing_proc(const char* name, void* user);

#endif
