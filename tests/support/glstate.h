// glstate.h - the whole of OpenGL's state that a host may care about: set to odd values, written down,
// compared.
#ifndef HAIR_TESTS_SUPPORT_GLSTATE_H
#define HAIR_TESTS_SUPPORT_GLSTATE_H

#include <stddef.h>
#include <stdint.h>

#define HAIR_TEST_VALUES 4096

struct hair_test_glstate {
    size_t count;
    struct {
        char name[56]; // "GL_PATCH_VERTICES", "GL_TEXTURE_BINDING_2D of unit 5"
        int64_t value;
    } values[HAIR_TEST_VALUES];
};

// What a host might have bound and set, nothing of it at its default. Objects live as long as the context.
void hair_test_glstate_disturb(void);

void hair_test_glstate_read(struct hair_test_glstate* out);

// The index of a value in which they differ, from `first` on; count when they are alike.
size_t hair_test_glstate_differ(const struct hair_test_glstate* a, const struct hair_test_glstate* b,
                                size_t first);

#endif
