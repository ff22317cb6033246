/// hair_base.h - version, result codes, application callbacks, and the header of every desc.
#ifndef HAIR_HAIR_BASE_H
#define HAIR_HAIR_BASE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

// Version -----------------------------------------------------------------------------------------

#define HAIR_VERSION_MAJOR 0 ///< Increases with a change that can break a caller.
#define HAIR_VERSION_MINOR 2 ///< Increases with a change that only adds.
#define HAIR_VERSION_PATCH 0 ///< Increases with a change that only repairs.

/// Version of these headers as one number, 10000 MAJOR + 100 MINOR + PATCH.
#define HAIR_VERSION (HAIR_VERSION_MAJOR * 10000u + HAIR_VERSION_MINOR * 100u + HAIR_VERSION_PATCH)

// Declarations of functions -----------------------------------------------------------------------

// A program that links the shared library defines HAIR_SHARED. The library defines
// HAIR_BUILD_SHARED while it is built. The static library exports nothing, so that a program which
// links it does not export the library's symbols.
#if defined(_WIN32) && defined(HAIR_BUILD_SHARED)
#define HAIR_EXPORT __declspec(dllexport)
#elif defined(_WIN32) && defined(HAIR_SHARED)
#define HAIR_EXPORT __declspec(dllimport)
#elif defined(HAIR_BUILD_SHARED)
#define HAIR_EXPORT __attribute__((visibility("default")))
#else
#define HAIR_EXPORT
#endif
#ifdef __cplusplus
#define HAIR_API extern "C" HAIR_EXPORT
#else
#define HAIR_API HAIR_EXPORT
#endif

// Objects -----------------------------------------------------------------------------------------

/// A haircut. It is immutable and can be shared by any number of instances. See hair_groom.h.
typedef struct hair_groom hair_groom;

/// A triangle mesh to collide with. It is immutable and can be shared. See hair_colliders.h.
typedef struct hair_collision_mesh hair_collision_mesh;

/// A triangle mesh to collide with that deforms from frame to frame. See hair_body.h.
typedef struct hair_body hair_body;

/// The objects of the library in one OpenGL context. See hair_context.h.
typedef struct hair_context hair_context;

/// The simulated hair of one head, made from a groom in a context. See hair_instance.h.
typedef struct hair_instance hair_instance;

/// Shading by the application. See hair_view.h.
typedef struct hair_shader hair_shader;

// Results -----------------------------------------------------------------------------------------

/// Result of a call that can fail.
typedef enum hair_result {
    /// Success.
    HAIR_OK = 0,
    /// A value is outside its documented range. The log names the value.
    HAIR_ERROR_ARGUMENT,
    /// hair_host.alloc or the driver has refused memory, or hair_set_memory_limit forbids it.
    HAIR_ERROR_MEMORY,
    /// No OpenGL context is current, or it is older than 4.5. Also an exceeded limit of the driver,
    /// or a shader that the driver does not compile.
    HAIR_ERROR_OPENGL,
    /// The bytes are unreadable, or not in the format that they claim. The log has the byte offset.
    HAIR_ERROR_FILE,
    /// The caller was compiled against another major version or a version before 0.2, or a desc
    /// does not come from its default function.
    HAIR_ERROR_VERSION,
    /// The driver has lost the OpenGL context with all its objects, for example after a GPU fault.
    /// See hair_context_restore().
    HAIR_ERROR_CONTEXT_LOST
} hair_result;

/// Return the HAIR_VERSION with which the library was compiled.
/// OpenGL: not used. Any thread.
HAIR_API uint32_t hair_version(void);

/// Return a static text that describes a result, never NULL.
/// OpenGL: not used. Any thread.
HAIR_API const char* hair_result_string(hair_result result);

// Application callbacks ---------------------------------------------------------------------------

/// Severity of a sentence in the log.
typedef enum hair_log_level { HAIR_LOG_ERROR = 0, HAIR_LOG_WARNING, HAIR_LOG_INFO } hair_log_level;

/// Callbacks for memory and log messages, provided by the application. The library calls them on
/// the thread that has called the library.
typedef struct hair_host {
    /// Function that returns `size` bytes aligned to `align`, or NULL if there are none. NULL in
    /// both `alloc` and `free` selects the allocator of the C library.
    void* (*alloc)(size_t size, size_t align, void* user);
    /// Function that frees memory of `alloc`. `size` is the size that was requested.
    void (*free)(void* memory, size_t size, void* user);
    /// Function that receives one sentence of the log. NULL disables the log.
    void (*log)(hair_log_level level, const char* sentence, void* user);
    /// Pointer passed to every callback.
    void* user;
} hair_host;

/// One of many tasks that do not depend on each other.
typedef void (*hair_task)(uint32_t index, void* data);

/// Threads of the application, on which the library may divide long work of the CPU.
typedef struct hair_tasks {
    /// Function that calls task(index, data) once for every index below `count`, on any threads and
    /// in any order, and returns when all calls have returned. Tasks use no callbacks.
    void (*run)(hair_task task, void* data, uint32_t count, void* user);
    /// Pointer passed to `run`.
    void* user;
} hair_tasks;

// Descs -------------------------------------------------------------------------------------------

/// Value of a field that lets the library choose. The comment of the field says how it chooses.
/// Only fields with "Default HAIR_AUTO" accept it.
#define HAIR_AUTO 0

/// Maximum number of groups of strands in a groom. See hair_groom_desc.strand_groups.
#define HAIR_MAX_STRAND_GROUPS 8

/// Size and version of a desc or info struct, its first member. The struct's default function fills
/// the header in where the caller is compiled. Later versions can therefore add members at the end
/// without breaking the caller. Always start from the defaults:
///
///     hair_desc desc = hair_desc_default();
typedef struct hair_struct_header {
    uint32_t size; ///< sizeof the struct, in bytes.
    uint32_t version; ///< HAIR_VERSION of the caller.
} hair_struct_header;

/// Declare T_init(), which writes all defaults, and T_default(), which returns a T with all
/// defaults.
#define HAIR_DESC(T)                                                                               \
    HAIR_API void T##_init(T* desc, hair_struct_header header);                                    \
    static inline T T##_default(void)                                                              \
    {                                                                                              \
        T desc;                                                                                    \
        hair_struct_header header = {sizeof desc, HAIR_VERSION};                                   \
        T##_init(&desc, header);                                                                   \
        return desc;                                                                               \
    }

/// Declare T_init(), which writes all defaults of a struct without a header, and T_default(), which
/// returns a T with all defaults. `size` is the size of the struct where the caller is compiled.
#define HAIR_PLAIN_DESC(T)                                                                         \
    HAIR_API void T##_init(T* desc, size_t size);                                                  \
    static inline T T##_default(void)                                                              \
    {                                                                                              \
        T desc;                                                                                    \
        T##_init(&desc, sizeof desc);                                                              \
        return desc;                                                                               \
    }

#endif
