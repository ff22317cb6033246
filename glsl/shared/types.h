// types.h - types by which C, C++ and GLSL read one text of structs.
#ifndef HAIR_SHARED_TYPES_H
#define HAIR_SHARED_TYPES_H

#ifdef GL_core_profile
#define hair_vec4 vec4
#define hair_mat4 mat4
#define hair_uint uint
#define HAIR_STRUCT(T) T
#define HAIR_SIZE(T)
#else
#include <stdint.h>
typedef struct hair_vec4 {
    float x, y, z, w;
} hair_vec4;
typedef struct hair_mat4 {
    hair_vec4 column[4];
} hair_mat4;
typedef uint32_t hair_uint;
#define HAIR_STRUCT(T) struct T
#ifdef __cplusplus
#define HAIR_SIZE(T) static_assert(sizeof(struct T) % 16 == 0, #T " needs members unused0, ... at its end");
#else
#define HAIR_SIZE(T) _Static_assert(sizeof(struct T) % 16 == 0, #T " needs members unused0, ... at its end");
#endif
#endif

#endif
