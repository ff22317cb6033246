// schema.c - the tables of the members of all public structs, and their default functions.
#include "lib/base/schema.h"

#include <float.h>

// Each file in lib/base/schema has a row per member, in the order of the struct. The columns are
// the struct, the member, the defaults, the accepted range, the useful range of a slider, the scale
// of the slider, the unit, and the first sentence of the comment in the header.
#define LINEAR false
#define LOG true
#define WORDS(...) ((const char* const[]){__VA_ARGS__})
#define VALUES(...) ((const double[]){__VA_ARGS__})
#define IDENTITY VALUES(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1)
#define ZEROS VALUES(0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0)
#define COUNT(...) (sizeof WORDS(__VA_ARGS__) / sizeof(char*))

#define MEMBER(S, path, type, layout, count, elements, defaults, min, max, low, high, scale, is_auto,        \
               choices, names, unit, about)                                                                  \
    {#path,                                                                                                  \
     GROUP,                                                                                                  \
     unit,                                                                                                   \
     about,                                                                                                  \
     type,                                                                                                   \
     layout,                                                                                                 \
     offsetof(S, path),                                                                                      \
     sizeof(((S*)0)->path) / (count),                                                                        \
     count,                                                                                                  \
     elements,                                                                                               \
     defaults,                                                                                               \
     min,                                                                                                    \
     max,                                                                                                    \
     low,                                                                                                    \
     high,                                                                                                   \
     scale,                                                                                                  \
     is_auto,                                                                                                \
     choices,                                                                                                \
     names},
#define ROW(S, path, type, layout, count, elements, defaults, min, max, low, high, scale, unit, about)       \
    MEMBER(S, path, type, layout, count, elements, defaults, min, max, low, high, scale, false, 0, NULL,     \
           unit, about)
#define AUTO(S, path, type, min, max, low, high, scale, unit, about)                                         \
    MEMBER(S, path, type, HAIR_LAYOUT_SCALAR, 1, NULL, VALUES(HAIR_AUTO), min, max, low, high, scale, true,  \
           0, NULL, unit, about)

// Numbers.
#define SCALAR(S, path, type, value, min, max, low, high, scale, unit, about)                                \
    ROW(S, path, type, HAIR_LAYOUT_SCALAR, 1, NULL, VALUES(value), min, max, low, high, scale, unit, about)
#define FLOAT(S, path, value, min, max, low, high, scale, unit, about)                                       \
    SCALAR(S, path, HAIR_MEMBER_FLOAT, value, min, max, low, high, scale, unit, about)
#define UINT(S, path, value, min, max, low, high, scale, unit, about)                                        \
    SCALAR(S, path, HAIR_MEMBER_UINT, value, min, max, low, high, scale, unit, about)
#define AUTO_FLOAT(S, path, min, max, low, high, scale, unit, about)                                         \
    AUTO(S, path, HAIR_MEMBER_FLOAT, min, max, low, high, scale, unit, about)
#define AUTO_UINT(S, path, min, max, low, high, scale, unit, about)                                          \
    AUTO(S, path, HAIR_MEMBER_UINT, min, max, low, high, scale, unit, about)
#define UINT64(S, path, about)                                                                               \
    SCALAR(S, path, HAIR_MEMBER_UINT64, 0, 0, (double)UINT64_MAX, 0, 1000, LINEAR, "", about)
#define BOOL(S, path, value, about) SCALAR(S, path, HAIR_MEMBER_BOOL, value, 0, 1, 0, 1, LINEAR, "", about)
#define ENUM(S, path, value, about, ...)                                                                     \
    MEMBER(S, path, HAIR_MEMBER_ENUM, HAIR_LAYOUT_SCALAR, 1, NULL, VALUES(value), 0, COUNT(__VA_ARGS__) - 1, \
           0, COUNT(__VA_ARGS__) - 1, LINEAR, false, COUNT(__VA_ARGS__), WORDS(__VA_ARGS__), "", about)

// Several numbers.
#define PAIR(S, path, a, b, first, second, min, max, low, high, scale, unit, about)                          \
    ROW(S, path, HAIR_MEMBER_FLOAT, HAIR_LAYOUT_VECTOR, 2, WORDS(first, second), VALUES(a, b), min, max,     \
        low, high, scale, unit, about)
#define VECTOR(S, path, x, y, z, min, max, low, high, unit, about)                                           \
    ROW(S, path, HAIR_MEMBER_FLOAT, HAIR_LAYOUT_VECTOR, 3, WORDS("x", "y", "z"), VALUES(x, y, z), min, max,  \
        low, high, LINEAR, unit, about)
#define COLOR(S, path, r, g, b, min, max, low, high, unit, about)                                            \
    ROW(S, path, HAIR_MEMBER_FLOAT, HAIR_LAYOUT_COLOR, 3, WORDS("r", "g", "b"), VALUES(r, g, b), min, max,   \
        low, high, LINEAR, unit, about)
#define QUATERNION(S, path, about)                                                                           \
    ROW(S, path, HAIR_MEMBER_FLOAT, HAIR_LAYOUT_VECTOR, 4, WORDS("x", "y", "z", "w"), VALUES(0, 0, 0, 1),    \
        -FLT_MAX, FLT_MAX, -1, 1, LINEAR, "", about)
#define CURVE(S, path, a, b, c, d, e, f, g, h, min, max, low, high, unit, about)                             \
    ROW(S, path, HAIR_MEMBER_FLOAT, HAIR_LAYOUT_CURVE, 8, NULL, VALUES(a, b, c, d, e, f, g, h), min, max,    \
        low, high, LINEAR, unit, about)
#define MATRIX(S, path, usual, about)                                                                        \
    ROW(S, path, HAIR_MEMBER_FLOAT, HAIR_LAYOUT_MATRIX, 16, NULL, usual, -FLT_MAX, FLT_MAX, -1, 1, LINEAR,   \
        "", about)
#define ARRAY(S, path, count, min, max, about)                                                               \
    ROW(S, path, HAIR_MEMBER_FLOAT, HAIR_LAYOUT_ARRAY, count, NULL, ZEROS, min, max, min, max, LINEAR, "",   \
        about)

// Names of OpenGL, and pointers.
#define TEXTURE(S, path, about)                                                                              \
    SCALAR(S, path, HAIR_MEMBER_TEXTURE, 0, 0, UINT32_MAX, 0, UINT32_MAX, LINEAR, "", about)
#define POINTERS(S, path, count, about)                                                                      \
    ROW(S, path, HAIR_MEMBER_POINTER, count > 1 ? HAIR_LAYOUT_ARRAY : HAIR_LAYOUT_SCALAR, count, NULL, NULL, \
        0, 0, 0, 0, LINEAR, "", about)
#define POINTER(S, path, about) POINTERS(S, path, 1, about)

#define BEGIN(S) static const hair_member S##_rows[] = {
#define END                                                                                                  \
    }                                                                                                        \
    ;
#define GROUP ""
#include "lib/base/schema/groom.inl"
#include "lib/base/schema/instance.inl"
#include "lib/base/schema/physics.inl"
#include "lib/base/schema/wind.inl"
#include "lib/base/schema/look.inl"
#include "lib/base/schema/view.inl"
#include "lib/base/schema/asset.inl"
#include "lib/base/schema/targets.inl"
#include "lib/base/schema/cut.inl"

#define SCHEMA(S, rows, count, has_header)                                                                   \
    struct hair_schema hair_schema_of_##S(void) {                                                            \
        return (struct hair_schema){#S, rows, count, sizeof(S), has_header};                                 \
    }
#define DESC_INIT(S)                                                                                         \
    void S##_init(S* desc, hair_struct_header header)                                                        \
    {                                                                                                        \
        hair_schema_init(desc, header, hair_schema_of_##S());                                                \
    }
#define DESC(S) SCHEMA(S, S##_rows, sizeof S##_rows / sizeof *S##_rows, true) DESC_INIT(S)
#define PLAIN(S)                                                                                             \
    SCHEMA(S, S##_rows, sizeof S##_rows / sizeof *S##_rows, false)                                           \
    void S##_init(S* desc, size_t size)                                                                      \
    {                                                                                                        \
        hair_schema_init_plain(desc, size, hair_schema_of_##S());                                            \
    }
#define INFO(S) SCHEMA(S, NULL, 0, true) DESC_INIT(S)
HAIR_SCHEMAS(DESC, PLAIN, INFO)
