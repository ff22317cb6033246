// schema.c - the default functions of all descs, generated from the table.
#include "lib/api/schema.h"

#include <float.h>
#include <string.h>

#define CELL(S, member, i)                                                                                   \
    {#S "." #member "[" #i "]", offsetof(S, member[i]), HAIR_SCHEMA_FLOAT, (i) % 5 == 0, -FLT_MAX, FLT_MAX},
#define COLUMN(S, member, a, b, c, d)                                                                        \
    CELL(S, member, a) CELL(S, member, b) CELL(S, member, c) CELL(S, member, d)

#define BEGIN(S) static const struct hair_field S##_rows[] = {
#define FIELD(S, member, type, value, min, max)                                                              \
    {#S "." #member, offsetof(S, member), HAIR_SCHEMA_##type, value, min, max},
#define MATRIX(S, member)                                                                                    \
    COLUMN(S, member, 0, 1, 2, 3)                                                                            \
    COLUMN(S, member, 4, 5, 6, 7) COLUMN(S, member, 8, 9, 10, 11) COLUMN(S, member, 12, 13, 14, 15)
#define END(S)                                                                                               \
    {                                                                                                        \
        "", 0, HAIR_SCHEMA_FLOAT, 0, 0, 0                                                                    \
    } /* a table must not be empty */                                                                        \
    }                                                                                                        \
    ;                                                                                                        \
    struct hair_schema hair_schema_of_##S(void) {                                                            \
        return (struct hair_schema){S##_rows, sizeof S##_rows / sizeof *S##_rows - 1, sizeof(S)};            \
    } void S##_init(S* desc, hair_struct_header header)                                                      \
    {                                                                                                        \
        hair_schema_init(desc, header, hair_schema_of_##S());                                                \
    }
#include "lib/api/schema.inl"

hair_result hair_schema_copy_out(const hair_host* host, const char* name, const void* own, size_t size,
                                 void* out)
{
    HAIR_ASSERT(own && size >= sizeof(hair_struct_header));
    if (!out) return hair_fail(host, HAIR_ERROR_ARGUMENT, "%s is NULL", name);
    hair_struct_header header;
    memcpy(&header, out, sizeof header);
    HAIR_TRY(hair_check_header(host, name, header));
    memcpy(out, own, header.size < size ? header.size : size);
    memcpy(out, &header, sizeof header);
    return HAIR_OK;
}
