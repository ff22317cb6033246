/// hair_context.h - the library in one OpenGL context.
#ifndef HAIR_HAIR_CONTEXT_H
#define HAIR_HAIR_CONTEXT_H

#include <hair/hair_base.h>

typedef enum hair_gl_state {
    HAIR_GL_STATE_RESTORE = 0, ///< A [GL] call leaves all OpenGL state as it found it.
    HAIR_GL_STATE_CLOBBER ///< It may change: program, vertex array, patch vertices, culling, primitive restart,
    ///< indirect draw and dispatch buffers, storage buffers 0-7, uniform buffers 0-2, buffer textures of units 0-7,
    ///< buffer textures of units 17 and 18, 2D textures, samplers of units 12-16 and 19-23, 3D textures, samplers of units 8-11, image units 0-1.
} hair_gl_state;

/// Where a host keeps programs as its driver has compiled them, so that they need not be compiled in every run: bytes under
/// keys, in files or wherever it likes. Of what it gives back, anything that is damaged, cut off or of another driver is
/// noticed, and the program compiled and kept again. Strangers should not be able to write there: drivers believe what is
/// whole. Called while the context is used, on that thread.
typedef struct hair_cache {
    /// Copy what was put under the key, if that is no more than `capacity` bytes. Returns how many it is; 0: nothing is there.
    size_t (*get)(uint64_t key, void* bytes, size_t capacity, void* user);
    /// Keep a copy, in place of what was there; or do not.
    void (*put)(uint64_t key, const void* bytes, size_t size, void* user);
    void* user; ///< Given back in every call.
} hair_cache;

typedef struct hair_context_desc {
    hair_struct_header header;
    const hair_host* host; ///< NULL: the C library's allocator, no log.
    void* (*get_proc)(const char* name, void* user); ///< Finds OpenGL functions. Required.
    void* get_proc_user; ///< Given back to get_proc.
    hair_gl_state gl_state; ///< Default HAIR_GL_STATE_RESTORE.
    uint32_t timings; ///< 1: time passes, for hair_get_timings. [0, 1]. Default 0.
    const char* glsl_dir; ///< For development: glsl/ read from here. NULL: built in.
    /// Copied; get and put are required. NULL: every program is compiled.
    const hair_cache* cache; ///< Default NULL.
} hair_context_desc;
HAIR_DESC(hair_context_desc)

/// Compiles no program yet: each is compiled when something first needs it, and kept as long as the context.

HAIR_API hair_result hair_context_create(const hair_context_desc* desc, hair_context** out);
HAIR_API void hair_context_destroy(hair_context* context);

/// Compile the shaders of glsl_dir that have been needed again. One that fails to compile keeps its last good program.
HAIR_API hair_result hair_context_reload(hair_context* context);

#endif
