/// hair_asset.h - haircuts from bytes, from parameters, and back to bytes. In libhair; never opens a file.
///
/// A hair_asset is plain arrays: strands in metres, +y up, root first, repaired, with the scalp if there is
/// one. All calls are [any thread].
#ifndef HAIR_HAIR_ASSET_H
#define HAIR_HAIR_ASSET_H

#include <hair/hair_groom.h>

typedef struct hair_asset hair_asset;

typedef enum hair_format {
    HAIR_FORMAT_NONE = 0, ///< Made by hair_asset_generate.
    HAIR_FORMAT_HAIR, ///< .hair ("cyHair"): all strands, any number of vertices each.
    HAIR_FORMAT_TFX4, ///< .tfx version 4: guides, the same number of vertices each, 4 to 64, a power of two.
    HAIR_FORMAT_TFX3, ///< .tfx version 3. Read only.
    HAIR_FORMAT_TFX2 ///< .tfx version 2, text. Read only.
} hair_format;

typedef struct hair_asset_desc {
    hair_struct_header header;
    const hair_host* host; ///< NULL: the C library's allocator, no log.
    const hair_import* import; ///< NULL: the defaults.
} hair_asset_desc;
HAIR_DESC(hair_asset_desc)

/// Read strands. The format is told by the first bytes. Malformed input of any kind is HAIR_ERROR_FILE and a
/// sentence with the byte offset. Memory stays under 4 times `size` and 64 MiB, whatever the bytes claim, and
/// 12 bytes for every vertex that import.strand_vertices asks for.
HAIR_API hair_result hair_asset_read(const hair_asset_desc* desc, const void* bytes, size_t size,
                                     hair_asset** out);
HAIR_API void hair_asset_destroy(hair_asset* asset);

/// Write strands as HAIR_FORMAT_HAIR or HAIR_FORMAT_TFX4. Returns in `size` the bytes needed; writes them if
/// `capacity` is enough. Colours of files are sRGB, and kept at 8 places of a strand. For .tfx all strands must have the same fitting number of vertices: resample first.
HAIR_API hair_result hair_asset_write(const hair_asset* asset, hair_format format, void* bytes,
                                      size_t capacity, size_t* size);

/// The built-in haircuts, on the built-in scalp.
typedef enum hair_style {
    HAIR_STYLE_LONG = 0,
    HAIR_STYLE_BOB,
    HAIR_STYLE_SHORT,
    HAIR_STYLE_PONYTAIL,
    HAIR_STYLE_CURLY,
    HAIR_STYLE_AFRO,
    HAIR_STYLE_COUNT
} hair_style;

typedef struct hair_style_desc {
    hair_struct_header header;
    const hair_host* host; ///< NULL: the C library's allocator, no log.
    hair_style style; ///< Default HAIR_STYLE_LONG.
    uint32_t guide_count; ///< Guides, spread evenly over the scalp. [16, 4096]. Default 166.
    uint32_t strand_vertices; ///< Vertices of each. 0 (as the style needs) to 256. Default 0.
    float length; ///< Of the style's own lengths. [0.1, 4]. Default 1.
    uint32_t seed; ///< Of every random choice. Default 1.
} hair_style_desc;
HAIR_DESC(hair_style_desc)

/// Make a haircut: guides whose roots are the scalp's vertices. The built-in scalp is the hair-bearing part
/// of the skull, an ellipsoid around (0, 1.63, 0) of half axes (0.077, 0.098, 0.096) m, on which the middles of its
/// triangles lie; the face looks along +z; the neck goes down from there to shoulders 0.40 m wide at height 1.40.
HAIR_API hair_result hair_asset_generate(const hair_style_desc* desc, hair_asset** out);

HAIR_API const char* hair_style_name(hair_style style); ///< "long", "bob", … NULL beyond the last.
HAIR_API const char* hair_format_name(hair_format format); ///< "hair", "tfx4", … NULL beyond the last.

typedef struct hair_asset_info {
    hair_struct_header header;
    hair_format format;
    hair_strand_set strand_set; ///< .tfx and the built-in haircuts hold guides; .hair holds all.
    uint32_t strand_count; ///< After the repairs.
    uint32_t vertex_count;
    uint32_t min_vertices, max_vertices; ///< Vertices of a strand.
    float length[3]; ///< Least, mean, greatest. m.
    float lower[3], upper[3]; ///< Bounds. m.
    uint32_t file_strands; ///< Before the repairs and `share`.
    uint32_t file_vertices;
    hair_import_stats import_stats;
    const float* positions; ///< xyz per vertex. Lives as long as the asset, as do the following.
    const uint32_t* strand_vertices; ///< Per strand.
    const float* strand_radii; ///< Per strand, at the root. m. NULL: the file has none.
    const float* scalp_positions; ///< xyz per vertex. NULL: no scalp.
    const uint32_t* scalp_triangles;
    uint32_t scalp_vertex_count, scalp_triangle_count;
    /// Per strand, linear rgb at 8 even places from root to tip. NULL: the file has none.
    const float* strand_colors;
} hair_asset_info;
HAIR_DESC(hair_asset_info)

HAIR_API hair_result hair_asset_describe(const hair_asset* asset, hair_asset_info* out);

/// Point `desc` at the asset's strands, their radii and colours, scalp and what they are; the rest of `desc` stays. The asset must
/// live until hair_groom_create has returned.
HAIR_API hair_result hair_asset_to_groom_desc(const hair_asset* asset, hair_groom_desc* desc);

#endif
