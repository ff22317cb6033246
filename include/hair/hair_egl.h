/// hair_egl.h - an OpenGL context without a window, for tools, tests and servers. In libhair_egl.
#ifndef HAIR_HAIR_EGL_H
#define HAIR_HAIR_EGL_H

#include <hair/hair.h>

/// An OpenGL context made by EGL, without a surface.
typedef struct hair_egl hair_egl;

/// Create an OpenGL 4.5 core context and make it current without a surface.
///
/// The call tries every EGL device, hardware first, and then the surfaceless platform of Mesa. The
/// log tells which device is used, and why each other device is not.
///
/// The context reports its loss if the driver can: its reset notification strategy is
/// EGL_LOSE_CONTEXT_ON_RESET. A context that shares objects with it must have the same strategy.
///
/// @param host Callbacks. NULL selects the allocator of the C library and disables the log.
/// @param device Index of a device in the order of EGL. -1 tries all devices.
/// @param out Receives the context.
/// Errors: HAIR_ERROR_ARGUMENT if there is no such device, HAIR_ERROR_MEMORY, HAIR_ERROR_OPENGL if
///     no device has OpenGL 4.5 core.
HAIR_API hair_result hair_egl_create(const hair_host* host, int device, hair_egl** out);

/// Destroy a context. NULL does nothing.
HAIR_API void hair_egl_destroy(hair_egl* egl);

/// Make a context current on the calling thread. NULL makes no context current.
/// Errors: HAIR_ERROR_OPENGL if EGL refuses.
HAIR_API hair_result hair_egl_make_current(hair_egl* egl);

/// Return the address of an OpenGL function, or NULL. Use it as hair_context_desc.get_proc. `user`
/// is ignored.
HAIR_API void* hair_egl_get_proc(const char* name, void* user);

#endif
