/// hair_base.h - version, results, application callbacks and the header of every desc.
#ifndef HAIR_HAIR_BASE_H
#define HAIR_HAIR_BASE_H

#include <stddef.h>
#include <stdint.h>

#define HAIR_VERSION_MAJOR 0 ///< A change that can break a caller.
#define HAIR_VERSION_MINOR 2 ///< A change that only adds.
#define HAIR_VERSION_PATCH 0 ///< A change that only repairs.
#define HAIR_VERSION (HAIR_VERSION_MAJOR * 10000u + HAIR_VERSION_MINOR * 100u + HAIR_VERSION_PATCH)

// HAIR_SHARED: the caller links the shared library. HAIR_BUILD_SHARED: the library is making it.
// The static library exports nothing, so a program that links it does not pass its symbols on.
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

typedef struct hair_groom hair_groom;
typedef struct hair_collision_mesh hair_collision_mesh;
typedef struct hair_context hair_context;
typedef struct hair_instance hair_instance;
typedef struct hair_shader hair_shader;

typedef enum hair_result {
    HAIR_OK = 0,
    HAIR_ERROR_ARGUMENT, ///< A value outside its documented range; the log names it.
    HAIR_ERROR_MEMORY, ///< hair_host.alloc or the driver refused.
    HAIR_ERROR_OPENGL, ///< No context current, older than 4.5, or a shader it would not compile.
    HAIR_ERROR_FILE, ///< Unreadable, or not in the format it claims; the log has the byte offset.
    HAIR_ERROR_VERSION ///< Compiled against another major version, or no default function was used.
} hair_result;

HAIR_API uint32_t hair_version(void); ///< The library's HAIR_VERSION. [any thread]
HAIR_API const char* hair_result_string(hair_result result); ///< Static text, never NULL. [any thread]

typedef enum hair_log_level { HAIR_LOG_ERROR = 0, HAIR_LOG_WARNING, HAIR_LOG_INFO } hair_log_level;

/// What the program lends the library. Called on the thread that called the library.
typedef struct hair_host {
    void* (*alloc)(size_t size, size_t align, void* user); ///< NULL, with free: the C library's.
    void (*free)(void* memory, size_t size, void* user); ///< size is what alloc was asked for.
    void (*log)(hair_log_level level, const char* sentence, void* user); ///< NULL: silence.
    void* user; ///< Given back in every call.
} hair_host;

/// Every desc begins with `header`, which its default function fills in where the caller is compiled: fields
/// can then be added at the end without breaking it. Always start from the defaults:
///     hair_desc desc = hair_desc_default();
typedef struct hair_struct_header {
    uint32_t size, version;
} hair_struct_header;

#define HAIR_DESC(T)                                                                                         \
    HAIR_API void T##_init(T* desc, hair_struct_header header);                                              \
    static inline T T##_default(void)                                                                        \
    {                                                                                                        \
        T desc;                                                                                              \
        hair_struct_header header = {(uint32_t)sizeof desc, HAIR_VERSION};                                   \
        T##_init(&desc, header);                                                                             \
        return desc;                                                                                         \
    }

#endif
