/// hair_egl.h - an OpenGL context with no window, for tools, tests and servers. In libhair_egl.
#ifndef HAIR_HAIR_EGL_H
#define HAIR_HAIR_EGL_H

#include <hair/hair_base.h>

typedef struct hair_egl hair_egl;

/// Try every EGL device, hardware first, then Mesa's surfaceless platform, until one gives OpenGL 4.5 core;
/// make it current with no surface. The log says which device was taken and why each other was not. `device`
/// picks one by its index in the order EGL lists them; -1: any. host NULL: no log.
HAIR_API hair_result hair_egl_create(const hair_host* host, int device, hair_egl** out);
HAIR_API void hair_egl_destroy(hair_egl* egl); ///< Takes NULL.
HAIR_API hair_result hair_egl_make_current(hair_egl* egl); ///< On the calling thread. NULL: none is current.
HAIR_API void* hair_egl_get_proc(const char* name, void* user); ///< For hair_context_desc.get_proc.

#endif
