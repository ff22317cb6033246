// profile.c - the profile of the OpenGL contexts of a test program.
#include "tests/support/support.h"

#include <epoxy/egl.h>
#include <stdlib.h>
#include <string.h>

#define MAX_ATTRIBUTES 32 // EGLints of one context, with the end.

static bool is_compatible;

void hair_test_set_compatibility(bool is_wanted)
{
    is_compatible = is_wanted;
}

// Replace the function of libEGL for libhair_egl, which always asks for the core profile. Epoxy
// calls that of libEGL.
#undef eglCreateContext
EGLContext EGLAPIENTRY eglCreateContext(EGLDisplay display, EGLConfig config, EGLContext share,
                                        const EGLint* attributes);
EGLContext EGLAPIENTRY eglCreateContext(EGLDisplay display, EGLConfig config, EGLContext share,
                                        const EGLint* attributes)
{
    const char* profile = getenv("HAIR_TEST_PROFILE");
    EGLint own[MAX_ATTRIBUTES + 3] = {EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                      EGL_CONTEXT_OPENGL_COMPATIBILITY_PROFILE_BIT, EGL_NONE};
    if (!is_compatible && !(profile && strcmp(profile, "compatibility") == 0))
        return epoxy_eglCreateContext(display, config, share, attributes);
    for (int i = 0; attributes && i < MAX_ATTRIBUTES - 1 && attributes[i] != EGL_NONE; i += 2) {
        own[i + 2] = attributes[i];
        own[i + 3] = attributes[i + 1];
        own[i + 4] = EGL_NONE;
    }
    return epoxy_eglCreateContext(display, config, share, own);
}

int hair_test_start_compatibility(void** state)
{
    hair_test_set_compatibility(true);
    int result = hair_test_start(state);
    hair_test_set_compatibility(false);
    return result;
}
