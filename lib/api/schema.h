// schema.h - the table of the numbers of all descs, and the checks at the library's boundary.
#ifndef HAIR_API_SCHEMA_H
#define HAIR_API_SCHEMA_H

#include <hair/hair_asset.h>

#include "lib/base/desc.h"
#include "lib/draw/render_path.h"

#define BEGIN(S) struct hair_schema hair_schema_of_##S(void);
#define FIELD(S, member, type, value, min, max)
#define MATRIX(S, member)
#define END(S)
#include "lib/api/schema.inl"
#undef BEGIN
#undef FIELD
#undef MATRIX
#undef END

// Copy and check the caller's desc of type S into `own`.
#define HAIR_COPY_IN(host, S, desc, own) hair_schema_copy_in(host, #S, desc, own, hair_schema_of_##S())

// Copy and check the caller's desc, or use the defaults if it is NULL.
#define HAIR_COPY_IN_OR_DEFAULT(host, S, desc, own)                                                          \
    ((desc) ? HAIR_COPY_IN(host, S, desc, own) : (*(own) = S##_default(), (hair_result)HAIR_OK))

// Fill the caller's struct S from `own`. The caller's struct may be shorter than the library's.
#define HAIR_COPY_OUT(host, S, own, out) hair_schema_copy_out(host, #S, own, sizeof(S), out)

hair_result hair_schema_copy_out(const hair_host* host, const char* name, const void* own, size_t size,
                                 void* out);

// The host of a desc, taken before the rest is checked, so that the check has a log. Every desc
// with a host has it right after `header`. A desc that no default function has filled in is not
// trusted.
#define HAIR_HOST_OF(desc)                                                                                   \
    hair_host_or_default((desc) && (desc)->header.version && (desc)->header.size >= 16 &&                    \
                                 (desc)->header.size <= 4096                                                 \
                             ? (desc)->host                                                                  \
                             : NULL)

#endif
