// schema.h - the tables of the members of all public structs, and the checks at the library's
// boundary.
#ifndef HAIR_BASE_SCHEMA_H
#define HAIR_BASE_SCHEMA_H

#include <hair/hair_asset.h>
#include <hair/hair_cut.h>

#include "lib/base/desc.h"

// List all public structs: descs with a header, structs without one, and structs that the library
// fills in, whose members have no rows. The first two are in the order of hair_struct.
#define HAIR_SCHEMAS(DESC, PLAIN, INFO)                                                                      \
    DESC(hair_import)                                                                                        \
    DESC(hair_map_set)                                                                                       \
    DESC(hair_groom_desc)                                                                                    \
    DESC(hair_context_desc)                                                                                  \
    DESC(hair_desc)                                                                                          \
    DESC(hair_physics)                                                                                       \
    DESC(hair_collision_mesh_desc)                                                                           \
    PLAIN(hair_collider)                                                                                     \
    PLAIN(hair_pin)                                                                                          \
    PLAIN(hair_wind_source)                                                                                  \
    DESC(hair_wind)                                                                                          \
    DESC(hair_look)                                                                                          \
    DESC(hair_lod)                                                                                           \
    DESC(hair_shader_desc)                                                                                   \
    DESC(hair_light)                                                                                         \
    DESC(hair_view)                                                                                          \
    DESC(hair_buffers)                                                                                       \
    DESC(hair_asset_desc)                                                                                    \
    DESC(hair_style_desc)                                                                                    \
    DESC(hair_target_blend)                                                                                  \
    DESC(hair_body_desc)                                                                                     \
    DESC(hair_group_look)                                                                                    \
    DESC(hair_cut_desc)                                                                                      \
    DESC(hair_strand_attribute)                                                                              \
    INFO(hair_groom_info)                                                                                    \
    INFO(hair_collision_mesh_info)                                                                           \
    INFO(hair_memory)                                                                                        \
    INFO(hair_solver_stats)                                                                                  \
    INFO(hair_report_info)                                                                                   \
    INFO(hair_field_info)                                                                                    \
    INFO(hair_cut_info)                                                                                      \
    INFO(hair_asset_info)

#define HAIR_DECLARE_SCHEMA(S) struct hair_schema hair_schema_of_##S(void);
HAIR_SCHEMAS(HAIR_DECLARE_SCHEMA, HAIR_DECLARE_SCHEMA, HAIR_DECLARE_SCHEMA)
#undef HAIR_DECLARE_SCHEMA

// Copy and check the caller's desc of type S into `own`.
#define HAIR_COPY_IN(host, S, desc, own) hair_schema_copy_in(host, desc, own, hair_schema_of_##S())

// Copy and check the caller's desc, or use the defaults if it is NULL.
#define HAIR_COPY_IN_OR_DEFAULT(host, S, desc, own)                                                          \
    ((desc) ? HAIR_COPY_IN(host, S, desc, own) : (*(own) = S##_default(), (hair_result)HAIR_OK))

// Fill the caller's struct S from `own`. The caller's struct may be shorter than the library's.
#define HAIR_COPY_OUT(host, S, own, out) hair_schema_copy_out(host, own, out, hair_schema_of_##S())

// The host of a desc, taken before the rest is checked, so that the check has a log. Every desc
// with a host has it right after `header`. A desc that no default function has filled in is not
// trusted.
#define HAIR_HOST_OF(desc)                                                                                   \
    hair_host_or_default((desc) && (desc)->header.version && (desc)->header.size >= 16 &&                    \
                                 (desc)->header.size <= 4096                                                 \
                             ? (desc)->host                                                                  \
                             : NULL)

#endif
