// glstate.h - all of the OpenGL state that an application may care about: set to odd values,
// recorded, compared.
#ifndef HAIR_TESTS_SUPPORT_GLSTATE_H
#define HAIR_TESTS_SUPPORT_GLSTATE_H

#include <stddef.h>
#include <stdint.h>

#define HAIR_TEST_VALUES 4096
#define HAIR_TEST_UNITS 24 // texture units that are compared

struct hair_test_glstate {
    size_t count;
    struct {
        char name[56]; // such as "GL_PATCH_VERTICES" or "GL_TEXTURE_BINDING_2D of unit 5"
        int64_t value;
    } values[HAIR_TEST_VALUES];
};

// Bind and set what an application might, with nothing at its default. The objects live as long as
// the context.
void hair_test_glstate_disturb(void);

void hair_test_glstate_read(struct hair_test_glstate* out);

// Return the index of the first value from `first` on in which both differ, or the count if they
// are equal.
size_t hair_test_glstate_differ(const struct hair_test_glstate* a, const struct hair_test_glstate* b,
                                size_t first);

#endif
