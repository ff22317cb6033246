/// hair_members.h - the members of public structs as data: their names, units, ranges and defaults.
///
/// The calls below let a program edit any struct of the library without code for each member, as
/// command lines, files of settings, panels of sliders and bindings of other languages do. The data
/// are the table by which the library itself makes defaults and checks ranges.
#ifndef HAIR_HAIR_MEMBERS_H
#define HAIR_HAIR_MEMBERS_H

#include <hair/hair_base.h>

// Description -------------------------------------------------------------------------------------

/// Structs that applications fill in. Structs of callbacks are left out.
typedef enum hair_struct {
    HAIR_STRUCT_IMPORT = 0, ///< hair_import.
    HAIR_STRUCT_MAP_SET, ///< hair_map_set.
    HAIR_STRUCT_GROOM_DESC, ///< hair_groom_desc.
    HAIR_STRUCT_CONTEXT_DESC, ///< hair_context_desc.
    HAIR_STRUCT_DESC, ///< hair_desc.
    HAIR_STRUCT_PHYSICS, ///< hair_physics.
    HAIR_STRUCT_COLLISION_MESH_DESC, ///< hair_collision_mesh_desc.
    HAIR_STRUCT_COLLIDER, ///< hair_collider.
    HAIR_STRUCT_PIN, ///< hair_pin.
    HAIR_STRUCT_WIND_SOURCE, ///< hair_wind_source.
    HAIR_STRUCT_WIND, ///< hair_wind.
    HAIR_STRUCT_LOOK, ///< hair_look.
    HAIR_STRUCT_LOD, ///< hair_lod.
    HAIR_STRUCT_SHADER_DESC, ///< hair_shader_desc.
    HAIR_STRUCT_LIGHT, ///< hair_light.
    HAIR_STRUCT_VIEW, ///< hair_view.
    HAIR_STRUCT_BUFFERS, ///< hair_buffers. Only its inputs.
    HAIR_STRUCT_ASSET_DESC, ///< hair_asset_desc.
    HAIR_STRUCT_STYLE_DESC, ///< hair_style_desc.
    HAIR_STRUCT_TARGET_BLEND, ///< hair_target_blend.
    HAIR_STRUCT_BODY_DESC, ///< hair_body_desc.
    HAIR_STRUCT_GROUP_LOOK, ///< hair_group_look.
    HAIR_STRUCT_CUT_DESC, ///< hair_cut_desc.
    HAIR_STRUCT_STRAND_ATTRIBUTE, ///< hair_strand_attribute.
    HAIR_STRUCT_COUNT
} hair_struct;

/// Type of the elements of a member.
typedef enum hair_member_type {
    HAIR_MEMBER_FLOAT = 0, ///< float.
    HAIR_MEMBER_UINT, ///< uint32_t.
    HAIR_MEMBER_UINT64, ///< uint64_t.
    HAIR_MEMBER_BOOL, ///< bool, one byte.
    HAIR_MEMBER_ENUM, ///< An enumeration, whose values are 0, 1, ... They have names.
    HAIR_MEMBER_TEXTURE, ///< uint32_t, the name of an OpenGL texture. Text cannot hold it.
    HAIR_MEMBER_POINTER ///< A pointer. Text cannot hold it.
} hair_member_type;

/// Meaning of the elements of a member.
typedef enum hair_member_layout {
    HAIR_LAYOUT_SCALAR = 0, ///< One element.
    HAIR_LAYOUT_VECTOR, ///< Elements with a name each, such as x, y and z.
    HAIR_LAYOUT_COLOR, ///< Linear rgb.
    HAIR_LAYOUT_CURVE, ///< The 8 values of a hair_curve.
    HAIR_LAYOUT_MATRIX, ///< 16 elements in column-major order.
    HAIR_LAYOUT_ARRAY ///< Elements without names.
} hair_member_layout;

/// One member of a struct. All strings and arrays are constants of the library.
typedef struct hair_member {
    const char* name; ///< Name as in C, with that of the group, such as "strand.segments".
    const char* group; ///< Name of the group, such as "strand". "" outside groups.
    const char* unit; ///< Unit, such as "m/s^2". "" for none.
    const char* about; ///< One sentence.
    hair_member_type type; ///< Type of the elements.
    hair_member_layout layout; ///< Meaning of the elements.
    uint32_t offset; ///< Offset of the first element in the struct, bytes.
    uint32_t size; ///< Size of one element, bytes.
    uint32_t count; ///< Number of elements, at most 16.
    const char* const* elements; ///< Names of the elements, such as "x". NULL if they have none.
    const double* defaults; ///< Defaults of the elements. NULL for pointers.
    /// Range that the library accepts, of each element. NaN and infinity are never accepted. It is
    /// everything that the type holds if the library sets no limit. 0 for pointers.
    double min, max;
    /// Useful range, for a slider. It is a part of the accepted range.
    double slider_min, slider_max;
    bool is_logarithmic; ///< True if a slider should be logarithmic.
    bool has_auto; ///< True if 0 is HAIR_AUTO.
    uint32_t choice_count; ///< Number of names of an enumeration, max + 1. Otherwise 0.
    const char* const* choices; ///< Names of the values 0, 1, ..., such as "helix". NULL for none.
} hair_member;

/// Return the name of a struct, such as "hair_look", or NULL beyond the last.
/// OpenGL: not used. Any thread.
HAIR_API const char* hair_struct_name(hair_struct kind);

/// Return the sizeof a struct in the library, in bytes, or 0 beyond the last.
/// OpenGL: not used. Any thread.
HAIR_API size_t hair_struct_size(hair_struct kind);

/// Describe the members of a struct, in the order of the struct. The header is left out.
///
/// A caller of an older version gets members that its struct does not have yet. They lie beyond the
/// size that it knows.
///
/// @param out Receives the members. May be NULL if `capacity` is 0.
/// @param capacity Maximum number of members to write.
/// @param stride sizeof(hair_member).
/// @return Number of members that there are. 0 beyond the last struct, or for a stride that is 0 or
///     not a multiple of 8.
/// OpenGL: not used. Any thread.
HAIR_API uint32_t hair_describe(hair_struct kind, hair_member* out, uint32_t capacity,
                                size_t stride);

// Members by name ---------------------------------------------------------------------------------

/// Set a member, or one element of a member, from text.
///
/// Names of elements follow that of the member: "gravity.y", "color.root.r" or "strand.taper[3]".
/// Elements of a whole member are separated by commas: "0, -9.81, 0". A curve also takes 1 to 7
/// values, evenly spaced and joined by lines. A bool is "false", "off" or "0", or "true", "on" or
/// "1". An enumeration is the name of a choice. Numbers are decimal in every locale.
///
/// @param host Callbacks. NULL disables the log. The sentence of a refusal names the member, the
///     value, and the range or the choices.
/// @param desc Struct to change, from its default function. Unchanged on failure.
/// @param size sizeof the struct.
/// Errors: HAIR_ERROR_ARGUMENT, also if the library would refuse the value, HAIR_ERROR_VERSION.
/// OpenGL: not used. Any thread.
HAIR_API hair_result hair_set_member(const hair_host* host, hair_struct kind, void* desc,
                                     size_t size, const char* name, const char* text);

/// Write a member, or one element of a member, as text that hair_set_member() reads back to the
/// same bits. A float has as few digits as this needs.
///
/// @param host Callbacks. NULL disables the log.
/// @param desc Struct to read, from its default function.
/// @param size sizeof the struct.
/// @param text Receives the text with a final 0. NULL only queries the length. 512 bytes hold every
///     text.
/// @param capacity Size of `text` in bytes. 0 if `text` is NULL.
/// @param length Receives the length without the final 0, also if `capacity` is too small. May be
///     NULL.
/// Errors: HAIR_ERROR_ARGUMENT, also if `capacity` is too small, HAIR_ERROR_VERSION.
/// OpenGL: not used. Any thread.
HAIR_API hair_result hair_get_member(const hair_host* host, hair_struct kind, const void* desc,
                                     size_t size, const char* name, char* text, size_t capacity,
                                     size_t* length);

// Structs as JSON ---------------------------------------------------------------------------------

/// Write a struct as a flat JSON object, with one line for each member. Pointers and textures are
/// left out, as text cannot hold them. Required counts that are not set yet are left out too.
///
/// @param host Callbacks. NULL disables the log.
/// @param desc Struct to write, from its default function.
/// @param size sizeof the struct.
/// @param base Struct of the same kind and size. Members that are equal in both are left out, which
///     makes a preset. NULL writes all members.
/// @param text Receives the text with a final 0. NULL only queries the length.
/// @param capacity Size of `text` in bytes. 0 if `text` is NULL.
/// @param length Receives the length without the final 0, also if `capacity` is too small. May be
///     NULL.
/// Errors: HAIR_ERROR_ARGUMENT, also if `capacity` is too small or a value is out of range,
///     HAIR_ERROR_VERSION.
/// OpenGL: not used. Any thread.
HAIR_API hair_result hair_write_json(const hair_host* host, hair_struct kind, const void* desc,
                                     size_t size, const void* base, char* text, size_t capacity,
                                     size_t* length);

/// Set members of a struct from a flat JSON object, such as {"damping": 2, "gravity": [0, -1, 0]}.
/// Names are those of hair_set_member(). Members without a name in the object keep their values.
///
/// Any bytes may be passed. The reader is strict: an unknown or repeated name, a value of another
/// type or out of range, and text after the object are refused.
///
/// @param host Callbacks. NULL disables the log. The sentence of a refusal names the member, the
///     value and the range, or the byte of the text.
/// @param desc Struct to change, from its default function. Unchanged on failure.
/// @param size sizeof the struct.
/// @param text JSON in UTF-8. It need not end with a 0.
/// @param length Length of the text in bytes.
/// Errors: HAIR_ERROR_ARGUMENT, HAIR_ERROR_FILE for text that is no such object, with the byte
///     offset in the log, HAIR_ERROR_VERSION.
/// OpenGL: not used. Any thread.
HAIR_API hair_result hair_read_json(const hair_host* host, hair_struct kind, void* desc,
                                    size_t size, const char* text, size_t length);

#endif
