/// hair_asset.h - haircuts from bytes, from parameters, and back to bytes. Part of libhair.
///
/// A hair_asset holds plain arrays. They are strands in metres, +y up, root first and repaired, and
/// the scalp if there is one. The library never opens a file. No call in this header uses OpenGL.
#ifndef HAIR_HAIR_ASSET_H
#define HAIR_HAIR_ASSET_H

#include <hair/hair.h>

/// A haircut as plain arrays. It is immutable.
typedef struct hair_asset hair_asset;

// Files -------------------------------------------------------------------------------------------

/// Format of a file of strands.
typedef enum hair_format {
    /// No file. The asset comes from hair_asset_generate() or hair_asset_create().
    HAIR_FORMAT_NONE = 0,
    /// .hair ("cyHair"). All strands, with any number of vertices each.
    HAIR_FORMAT_HAIR,
    /// .tfx version 4. Guides with the same number of vertices, a power of two from 4 to 64.
    HAIR_FORMAT_TFX4,
    /// .tfx version 3. Read only.
    HAIR_FORMAT_TFX3,
    /// .tfx version 2, text. Read only.
    HAIR_FORMAT_TFX2,
    /// .groom, the format of this library. It holds all that a hair_asset has: strands with radii,
    /// groups, colours and attributes, and the scalp with density, texture coordinates, maps and
    /// joints. Positions are compressed, with errors of at most 5e-6 of the length of their strand.
    /// Roots are exact. Colours are rounded by at most 1.6e-5. All other numbers are exact.
    HAIR_FORMAT_GROOM
} hair_format;

/// Input of hair_asset_read().
typedef struct hair_asset_desc {
    hair_struct_header header;
    /// Callbacks. NULL selects the allocator of the C library and disables the log.
    const hair_host* host; ///< Default NULL.
    /// Conversion of the strands. NULL selects the defaults.
    const hair_import* import; ///< Default NULL.
} hair_asset_desc;
HAIR_DESC(hair_asset_desc)

/// Read strands from the bytes of a file. The first bytes determine the format.
///
/// Any bytes may be passed. Memory stays below 4 times `size` plus 64 MiB, whatever the bytes
/// claim, plus 12 bytes per vertex that hair_import.strand_vertices asks for. The compression of a
/// .groom file may need 200 times `size` instead. A file may have at most 16,777,216 strands and
/// 67,108,864 vertices. A text has at most 256 MiB, and a .groom file 4 GiB.
///
/// @param desc Callbacks and import settings.
/// @param bytes Content of the file.
/// @param size Size of the content in bytes.
/// @param out Receives the asset.
/// Errors: HAIR_ERROR_ARGUMENT, HAIR_ERROR_FILE for malformed bytes, with the byte offset in the
///     log, HAIR_ERROR_MEMORY, HAIR_ERROR_VERSION.
/// OpenGL: not used. Any thread.
HAIR_API hair_result hair_asset_read(const hair_asset_desc* desc, const void* bytes, size_t size,
                                     hair_asset** out);

/// Return an upper bound on the bytes of a file of strands that hair_asset_read() can need, by the
/// beginning of the file. A pipe or a device without an end need not be read further. A beginning
/// that is refused needs no more bytes than its header.
///
/// @param bytes The first bytes of the file: 296 or more, or all of a shorter file.
/// @param size Number of those bytes.
/// @return The bound, which is 256 MiB for text. 0 if the beginning is of no known format or
///     `bytes` is NULL.
/// OpenGL: not used. Any thread.
HAIR_API uint64_t hair_asset_max_size(const void* bytes, size_t size);

/// Create an asset from arrays, to write a file. Physics and the numbers of guides and followers
/// are not used.
///
/// @param desc Strands and scalp with guides, attributes and maps, of the members of
///     hair_groom_desc. They are copied. Values of attributes of one kind are multiplied.
/// @param scalp_joints Joints of the scalp's vertices, as for hair_set_scalp_weights(). NULL if
///     there are none. The next three arguments must then be NULL, 0 and NULL.
/// @param scalp_weights Weights of the joints.
/// @param scalp_joint_count Number of joints. [1, 65536].
/// @param scalp_joint_names Names of the joints, as hair_asset_info.scalp_joint_names. NULL if
///     unknown.
/// @param out Receives the asset.
/// Errors: HAIR_ERROR_ARGUMENT, also if no strand is usable, HAIR_ERROR_MEMORY, HAIR_ERROR_VERSION.
/// OpenGL: not used. Any thread.
HAIR_API hair_result hair_asset_create(const hair_groom_desc* desc, const uint16_t* scalp_joints,
                                       const float* scalp_weights, uint32_t scalp_joint_count,
                                       const char* scalp_joint_names, hair_asset** out);

/// Destroy an asset. NULL does nothing.
/// OpenGL: not used. Any thread.
HAIR_API void hair_asset_destroy(hair_asset* asset);

/// Write strands in the format of a file. Colours become sRGB. An asset has 8 colours per strand.
///
/// @param asset Asset to write.
/// @param format HAIR_FORMAT_GROOM, HAIR_FORMAT_HAIR or HAIR_FORMAT_TFX4. Only the first has
///     groups, attributes and the scalp. The strands of a .tfx file must all have 4, 8, 16, 32 or
///     64 vertices. Set hair_import.strand_vertices to resample them.
/// @param bytes Receives the content of the file if `capacity` suffices. NULL only queries the
///     size.
/// @param capacity Size of `bytes`. 0 if `bytes` is NULL.
/// @param size Receives the size of the content in bytes. The call succeeds also if `capacity` is
///     too small, so compare the two.
/// Errors: HAIR_ERROR_ARGUMENT.
/// OpenGL: not used. Any thread.
HAIR_API hair_result hair_asset_write(const hair_asset* asset, hair_format format, void* bytes,
                                      size_t capacity, size_t* size);

/// Return the name of a format, such as "tfx4", or NULL beyond the last.
/// OpenGL: not used. Any thread.
HAIR_API const char* hair_format_name(hair_format format);

// Built-in haircuts -------------------------------------------------------------------------------

/// Built-in haircuts, on the built-in scalp. Guides of HAIR_STYLE_CURLY and HAIR_STYLE_AFRO are
/// curled and simulated as such. HAIR_LOOK_CURLY curls any haircut while drawing. A haircut with
/// both is curled twice.
typedef enum hair_style {
    HAIR_STYLE_LONG = 0,
    HAIR_STYLE_BOB,
    HAIR_STYLE_SHORT,
    HAIR_STYLE_PONYTAIL,
    HAIR_STYLE_CURLY,
    HAIR_STYLE_AFRO,
    HAIR_STYLE_FRINGE, ///< A bob without a parting, cut above the brows.
    HAIR_STYLE_FADE, ///< Short hair that fades to stubble at the sides and the back.
    HAIR_STYLE_BUN, ///< Hair that is wound into a coil at the back of the head.
    HAIR_STYLE_BRAID, ///< Hair that is braided into three strands at the nape.
    HAIR_STYLE_COUNT
} hair_style;

/// Input of hair_asset_generate().
typedef struct hair_style_desc {
    hair_struct_header header;
    /// Callbacks. NULL selects the allocator of the C library and disables the log.
    const hair_host* host; ///< Default NULL.
    hair_style style; ///< Default HAIR_STYLE_LONG.
    /// Number of guides, spread evenly over the scalp.
    uint32_t guide_count; ///< [16, 4096]. Default 166.
    /// Number of vertices per guide, at least 2. HAIR_AUTO selects the number by `style`. A groom
    /// keeps at most hair_groom_desc.guide_vertices of them.
    uint32_t strand_vertices; ///< [0, 256]. Default HAIR_AUTO.
    /// Multiple of the lengths of the style.
    float length; ///< [0.1, 4]. Default 1.
    /// Seed of all random choices.
    uint32_t seed; ///< Default 1.
} hair_style_desc;
HAIR_DESC(hair_style_desc)

/// Generate a haircut. The roots of its guides are the vertices of the scalp. Its density falls off
/// towards the hairline.
///
/// The scalp is the part of the skull that bears hair. The skull is an ellipsoid around (0, 1.63,
/// 0) m with the half axes (0.077, 0.098, 0.096) m. The centres of the scalp's triangles lie on it.
/// The face looks along +z. The neck goes down to shoulders that are 0.40 m wide at the height 1.40
/// m.
///
/// @param desc Style and sizes.
/// @param out Receives the asset.
/// Errors: HAIR_ERROR_ARGUMENT, HAIR_ERROR_MEMORY, HAIR_ERROR_VERSION.
/// OpenGL: not used. Any thread.
HAIR_API hair_result hair_asset_generate(const hair_style_desc* desc, hair_asset** out);

/// Return the name of a style, such as "long", or NULL beyond the last.
/// OpenGL: not used. Any thread.
HAIR_API const char* hair_style_name(hair_style style);

// Content -----------------------------------------------------------------------------------------

/// Content of an asset. The arrays are valid as long as the asset.
typedef struct hair_asset_info {
    hair_struct_header header;
    hair_format format; ///< Format of the file.
    /// Meaning of the strands. .tfx files and the built-in haircuts hold guides. .hair files hold
    /// all strands. .groom files tell.
    hair_strand_set strand_set;
    uint32_t strand_count; ///< Number of strands after the repairs.
    uint32_t vertex_count; ///< Number of vertices of all strands.
    uint32_t min_vertices; ///< Minimum number of vertices of a strand.
    uint32_t max_vertices; ///< Maximum number of vertices of a strand.
    float length[3]; ///< Minimum, mean and maximum length of the strands, m.
    float lower[3]; ///< Lower corner of the bounds of the strands, m.
    float upper[3]; ///< Upper corner of the bounds of the strands, m.
    uint32_t file_strands; ///< Number of strands in the file, before the import.
    uint32_t file_vertices; ///< Number of vertices in the file, before the import.
    hair_import_stats import_stats; ///< Repairs of the import.
    const float* positions; ///< Vertex positions, xyz each, strand after strand, m.
    const uint32_t* strand_vertices; ///< Number of vertices of each strand.
    const float* strand_radii; ///< Radius of each strand at the root, m. NULL if there are none.
    const float* scalp_positions; ///< Scalp vertices, xyz each, m. NULL if there is no scalp.
    const uint32_t* scalp_triangles; ///< Three vertex indices per triangle of the scalp.
    uint32_t scalp_vertex_count; ///< Number of scalp vertices.
    uint32_t scalp_triangle_count; ///< Number of scalp triangles.
    /// Linear rgb at 8 even places from root to tip of each strand. NULL if there are no colours.
    const float* strand_colors;
    /// Group of each strand, in [0, 7]. NULL if all are 0. See hair_groom_desc.strand_groups.
    const uint8_t* strand_groups;
    const float* scalp_density; ///< See hair_groom_desc.scalp_density. NULL if there is none.
    const float* scalp_uvs; ///< See hair_groom_desc.scalp_uvs. NULL if there are none.
    const uint16_t* scalp_joints; ///< See hair_set_scalp_weights(). NULL if there are none.
    const float* scalp_weights; ///< See hair_set_scalp_weights(). NULL if there are none.
    uint32_t scalp_joint_count; ///< See hair_set_scalp_weights(). 0 if there are none.
    /// See hair_groom_desc.strand_attributes. The values of a kind are in its first attribute.
    /// Attributes are header.size bytes apart. NULL if there are none.
    const hair_strand_attribute* strand_attributes;
    uint32_t strand_attribute_count; ///< Number of attributes.
    const hair_map_set* map_sets[4]; ///< See hair_groom_desc.map_sets.
    /// 1 for each strand that is a guide in the program that the haircut comes from, otherwise 0.
    /// See hair_groom_desc.strand_guides. NULL if unknown.
    const uint8_t* strand_guides;
    /// Names of the scalp's joints in UTF-8, one after another, each with a byte 0 at its end. NULL
    /// if unknown.
    const char* scalp_joint_names;
} hair_asset_info;
HAIR_DESC(hair_asset_info)

/// Write the content of an asset to `out`, which comes from hair_asset_info_default().
/// Errors: HAIR_ERROR_ARGUMENT, HAIR_ERROR_VERSION.
/// OpenGL: not used. Any thread.
HAIR_API hair_result hair_asset_describe(const hair_asset* asset, hair_asset_info* out);

/// Set the strands, radii, colours, groups, strand_set and scalp of `desc` to those of an asset.
/// Guides, density, texture coordinates, maps and attributes are set if the asset has them. Other
/// members keep their values.
/// The asset must live until hair_groom_create() has returned.
///
/// @param desc Desc to change, from hair_groom_desc_default().
/// Errors: HAIR_ERROR_ARGUMENT, HAIR_ERROR_VERSION.
/// OpenGL: not used. Any thread.
HAIR_API hair_result hair_asset_to_groom_desc(const hair_asset* asset, hair_groom_desc* desc);

#endif
