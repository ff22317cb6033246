/// hair_context.h - contexts: the objects of the library in one OpenGL context.
///
/// A context and its instances belong to one thread at a time. Different contexts run in parallel.
#ifndef HAIR_HAIR_CONTEXT_H
#define HAIR_HAIR_CONTEXT_H

#include <hair/hair_base.h>

/// Treatment of the OpenGL state by calls that use OpenGL.
typedef enum hair_gl_state {
    /// Every call leaves all OpenGL state as it was.
    HAIR_GL_STATE_RESTORE = 0,
    /// Calls may change only this state:
    /// - program, vertex array, patch vertices, face culling, primitive restart,
    /// - indirect draw buffer and indirect dispatch buffer,
    /// - storage buffers 0 to 7 and uniform buffers 0 to 2,
    /// - buffer textures of units 0 to 7, 17 and 18,
    /// - 3D textures and samplers of units 8 to 11,
    /// - 2D textures and samplers of units 12 to 16 and 19 to 23,
    /// - image units 0 and 1.
    HAIR_GL_STATE_CLOBBER
} hair_gl_state;

/// A cache of compiled program binaries, provided by the application, for example in files. The
/// library detects entries that are damaged, truncated or from another driver, and compiles and
/// stores those programs again. Do not let untrusted code write to the cache, because drivers trust
/// well-formed binaries. The callbacks run while the context is used, on its thread.
typedef struct hair_cache {
    /// Function that copies the entry of `key` to `bytes` if the entry has at most `capacity`
    /// bytes. It returns the size of the entry, or 0 if there is none.
    size_t (*get)(uint64_t key, void* bytes, size_t capacity, void* user);
    /// Function that stores a copy of the entry of `key`, replacing an older entry. It may also do
    /// nothing.
    void (*put)(uint64_t key, const void* bytes, size_t size, void* user);
    /// Pointer passed to both callbacks.
    void* user;
} hair_cache;

/// Input of hair_context_create().
typedef struct hair_context_desc {
    hair_struct_header header;
    /// Callbacks. NULL selects the allocator of the C library and disables the log.
    const hair_host* host; ///< Default NULL.
    /// Function that returns the address of an OpenGL function, or NULL. Required. It is also asked
    /// for eglGetCurrentContext, wglGetCurrentContext and glXGetCurrentContext. If it has none of
    /// them, calls do not notice a current context that shares objects with the right one.
    void* (*get_proc)(const char* name, void* user);
    /// Pointer passed to get_proc.
    void* get_proc_user; ///< Default NULL.
    hair_gl_state gl_state; ///< Default HAIR_GL_STATE_RESTORE.
    /// Measurement of the GPU time of passes, for hair_get_timings() and hair_report(). True
    /// enables it.
    bool timings; ///< Default false.
    /// Directory from which the shaders of glsl/ are read, for development. NULL selects the
    /// built-in shaders.
    const char* glsl_dir; ///< Default NULL.
    /// Cache of program binaries. The struct is copied. `get` and `put` are required. NULL disables
    /// the cache.
    const hair_cache* cache; ///< Default NULL.
    /// Preparation for hair_context_restore(). True makes each instance keep its groom, and every
    /// hair_step() begin an asynchronous copy of the state to the CPU.
    bool restorable; ///< Default false.
} hair_context_desc;
HAIR_DESC(hair_context_desc)

/// Create a context for the OpenGL context that is current. OpenGL 4.5 core is required. A context
/// of the compatibility profile of that version will do too.
///
/// The call compiles only a small test of the driver, and waits for its result. The library
/// compiles every other program when a call first needs it, and keeps the program as long as the
/// context. See hair_precompile().
///
/// @param desc Callbacks and settings. They are copied.
/// @param out Receives the context.
/// Errors: HAIR_ERROR_ARGUMENT, HAIR_ERROR_MEMORY, HAIR_ERROR_OPENGL, HAIR_ERROR_VERSION.
/// OpenGL: required. Waits for the GPU.
HAIR_API hair_result hair_context_create(const hair_context_desc* desc, hair_context** out);

/// Destroy a context. NULL does nothing. All its OpenGL objects are deleted, with those of its
/// instances and shaders. Instances and shaders that are left are orphans, as hair.h says.
/// OpenGL: required, unless the context is abandoned. Does not wait for the GPU.
HAIR_API void hair_context_destroy(hair_context* context);

/// Abandon the OpenGL objects of a context, for an OpenGL context that is lost or destroyed. Memory
/// of the CPU is freed, and no OpenGL function is called. An OpenGL context that lives on keeps the
/// objects until it ends.
///
/// The context, its instances and its shaders are then orphans, as hair.h says. Later calls on the
/// context fail with HAIR_ERROR_ARGUMENT, and hair_get_timings() returns 0. The orphans and the
/// context are still to be destroyed, which needs no OpenGL any more.
///
/// @param context Context. NULL, or a context that is abandoned already, does nothing.
/// OpenGL: none, and no context need be current.
HAIR_API void hair_context_abandon(hair_context* context);

/// Make everything in a context again, in the OpenGL context that is current now. This is for an
/// OpenGL context that is lost or destroyed. Instances and shaders stay valid.
///
/// hair_context_desc.restorable must have been true. Each instance then has its settings, colliders
/// and pins as they were set last. The motion continues from the last state that had arrived on the
/// CPU, at most some steps old. An instance without such a state is at rest under its transform.
/// hair_load() brings back a state that the application has saved.
///
/// Names of the application's OpenGL objects are not kept: hair_wind.texture becomes 0. Programs
/// are compiled when they are needed again. Objects are left in an OpenGL context that lives on.
///
/// On failure the context stays as it was, and the call may be repeated.
/// Errors: HAIR_ERROR_ARGUMENT, HAIR_ERROR_MEMORY, HAIR_ERROR_OPENGL, HAIR_ERROR_CONTEXT_LOST.
/// OpenGL: required, but the current context need not be that of hair_context_create(). Waits for
/// the GPU.
HAIR_API hair_result hair_context_restore(hair_context* context);

/// Compile all programs in use again, from hair_context_desc.glsl_dir. A program that fails to
/// compile keeps its last valid version.
/// Errors: HAIR_ERROR_ARGUMENT, HAIR_ERROR_MEMORY, HAIR_ERROR_OPENGL if a program does not compile.
/// OpenGL: required. Does not wait for the GPU.
HAIR_API hair_result hair_context_reload(hair_context* context);

/// Bytes that the text of hair_context_tune() takes at most, with its terminating 0.
#define HAIR_TUNING_SIZE 256

/// Measure which render path is the fastest on this driver for each kind of view. From then on
/// HAIR_RENDER_PATH_AUTO selects these paths in the context, in place of the built-in table. The
/// simulation does not change, and all paths draw the same image.
///
/// The call draws hair of its own into a texture of its own. It measures for about half a second.
/// Before, it compiles the programs of all paths, which may take seconds. Keep the text, for
/// example in a file beside the programs of hair_cache. Pass it to hair_context_set_tuning() when
/// the application starts again. The OpenGL state is left as it was, whatever
/// hair_context_desc.gl_state is.
///
/// @param context Context.
/// @param out Receives the paths as text, with a key of the driver.
/// @param capacity Bytes of `out`. At least HAIR_TUNING_SIZE.
/// Errors: HAIR_ERROR_ARGUMENT, HAIR_ERROR_MEMORY, HAIR_ERROR_OPENGL, HAIR_ERROR_CONTEXT_LOST. The
/// paths are then those of before.
/// OpenGL: required. Waits for the GPU.
HAIR_API hair_result hair_context_tune(hair_context* context, char* out, size_t capacity);

/// Select the paths of an earlier hair_context_tune() for HAIR_RENDER_PATH_AUTO.
/// hair_context_restore() goes back to the built-in table.
///
/// @param context Context.
/// @param tuning Text of hair_context_tune(). It may be from an untrusted file, because every other
///               text is refused. NULL selects the built-in table.
/// Errors: HAIR_ERROR_ARGUMENT if the text is not of hair_context_tune(), or of another driver.
/// OpenGL: required. Does not wait for the GPU.
HAIR_API hair_result hair_context_set_tuning(hair_context* context, const char* tuning);

#endif
