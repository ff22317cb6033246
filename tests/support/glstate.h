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
// the context. A context of the compatibility profile also has its fixed-function state set.
void hair_test_glstate_disturb(void);

// Record the state, with the fixed-function state of a context of the compatibility profile.
void hair_test_glstate_read(struct hair_test_glstate* out);

// Return the index of the first value from `first` on in which both differ, or the count if they
// are equal.
size_t hair_test_glstate_differ(const struct hair_test_glstate* a, const struct hair_test_glstate* b,
                                size_t first);

// Add one value, or each of `count` values by its bits. `i` below 0 leaves the number out.
void hair_test_glstate_put(struct hair_test_glstate* out, const char* name, int i, int64_t value);
void hair_test_glstate_put_reals(struct hair_test_glstate* out, const char* name, int count,
                                 const float* values);

// Return whether the current context has the compatibility profile.
int hair_test_glstate_is_legacy(void);
// Set or record the state that only the compatibility profile has.
void hair_test_glstate_disturb_legacy(void);
void hair_test_glstate_read_legacy(struct hair_test_glstate* out);

#endif
