/// hair_groom.h - grooms: import of strands, maps on the scalp, and the haircut itself.
///
/// A groom is immutable and lives on the CPU. No call in this header uses OpenGL.
#ifndef HAIR_HAIR_GROOM_H
#define HAIR_HAIR_GROOM_H

#include <hair/hair_physics.h>

// Import ------------------------------------------------------------------------------------------

/// Axis that points up.
typedef enum hair_up { HAIR_UP_Y = 0, HAIR_UP_Z, HAIR_UP_X } hair_up;

/// Conversion of imported strands to the conventions of the library: metres, +y up, root first, and
/// vertices that can be simulated.
typedef struct hair_import {
    hair_struct_header header;
    /// Length of one unit of the positions.
    float scale; ///< m. [1e-6, 1e6]. Default 1.
    /// Axis that points up in the positions. The import rotates this axis to +y.
    hair_up up; ///< Default HAIR_UP_Y.
    /// Order of the vertices of a strand, false for root to tip and true for tip to root.
    bool tip_first; ///< Default false.
    /// Fraction of the strands that the import keeps, chosen at random from `seed`.
    float keep_fraction; ///< [1e-6, 1]. Default 1.
    /// Number of vertices to which every strand is resampled. 0 keeps the vertices of each strand.
    uint32_t strand_vertices; ///< [0, 256]. Default 0.
    /// Seed of all random choices.
    uint32_t seed; ///< Default 1.
} hair_import;
HAIR_DESC(hair_import)

/// Numbers of repairs that an import has made.
typedef struct hair_import_stats {
    uint32_t dropped_single; ///< Strands with fewer than two vertices after the repairs below.
    uint32_t dropped_short; ///< Strands shorter than 10 micrometres.
    uint32_t removed_nonfinite; ///< Vertices that were NaN, infinite or beyond 1e6 m.
    uint32_t removed_repeated; ///< Vertices closer to the previous one than 1e-5 strand lengths.
    uint32_t resampled; ///< Strands with more than 256 vertices, resampled to 256.
} hair_import_stats;

// Maps on the scalp -------------------------------------------------------------------------------

/// Source of the values of a map.
typedef enum hair_map_source {
    /// No values. The map is 1 everywhere.
    HAIR_MAP_SOURCE_NONE = 0,
    /// An image, sampled at hair_groom_desc.scalp_uvs with smooth interpolation.
    HAIR_MAP_SOURCE_IMAGE,
    /// One value per vertex of the scalp, interpolated linearly over triangles.
    HAIR_MAP_SOURCE_VERTICES,
    /// One value per triangle of the scalp.
    HAIR_MAP_SOURCE_TRIANGLES
} hair_map_source;

/// A scalar function on the scalp.
typedef struct hair_map {
    hair_map_source source; ///< Default HAIR_MAP_SOURCE_NONE.
    /// Values of the source. Images are stored row by row, and the first row is at v = 0. Required
    /// unless `source` is HAIR_MAP_SOURCE_NONE.
    const float* values;
    uint32_t width; ///< Width of the image, in texels, at least 1. [0, 16384]. Default 0.
    uint32_t height; ///< Height of the image, in texels, at least 1. [0, 16384]. Default 0.
} hair_map;

/// Scalp maps of follower density and strand thickness. A groom has up to four sets, and
/// hair_look.followers.map_set blends between two of them.
typedef struct hair_map_set {
    hair_struct_header header;
    hair_map density; ///< Fraction of the followers that are drawn. [0, 1].
    hair_map thickness; ///< Radius of a strand as a multiple of hair_look.strand.radius. [0, 4].
} hair_map_set;
HAIR_DESC(hair_map_set)

// Attributes of strands ---------------------------------------------------------------------------

/// Property of strands that a hair_strand_attribute multiplies.
///
/// Colours of strands are hair_groom_desc.colors, and a map of colours on the scalp is
/// hair_view.color_texture.
///
/// The first four belong to guides. A guide has the values of its strand and of the map at its
/// root. HAIR_SOLVER_REDBLACK ignores these four. They take no memory of the GPU. The five from
/// HAIR_STRAND_ATTRIBUTE_CLUMP on take 2 bytes each per follower. The others change the groom when
/// it is created, and take nothing more.
typedef enum hair_strand_attribute_kind {
    /// Multiple of hair_physics.fiber.youngs_modulus. [0, 100].
    HAIR_STRAND_ATTRIBUTE_STIFFNESS = 0,
    /// Multiple of hair_physics.damping. [0, 100].
    HAIR_STRAND_ATTRIBUTE_DAMPING,
    /// Multiple of hair_physics.shape.frequency_root and frequency_tip. [0, 100].
    HAIR_STRAND_ATTRIBUTE_SHAPE_FREQUENCY,
    /// Multiple of hair_physics.shape.gravity_preload. [0, 100].
    HAIR_STRAND_ATTRIBUTE_GRAVITY_PRELOAD,
    /// Multiple of the blend weight of locks. See hair_look.clump. [0, 1].
    HAIR_STRAND_ATTRIBUTE_CLUMP,
    /// Multiple of hair_look.curl.radius. [0, 4].
    HAIR_STRAND_ATTRIBUTE_CURL_RADIUS,
    /// Multiple of the number of turns of curls along the strand. [0, 4].
    HAIR_STRAND_ATTRIBUTE_CURL_FREQUENCY,
    /// Multiple of hair_look.strays.frizz. [0, 4].
    HAIR_STRAND_ATTRIBUTE_FRIZZ,
    /// Multiple of the roughness along the fibre. [0.2, 4].
    HAIR_STRAND_ATTRIBUTE_ROUGHNESS,
    /// Multiple of hair_look.strand.radius. [0, 4].
    HAIR_STRAND_ATTRIBUTE_RADIUS,
    /// Fraction of its length from the root on that a strand has. Guides have it too. [0.01, 1].
    HAIR_STRAND_ATTRIBUTE_LENGTH,
    /// Probability that a follower exists. The followers that exist are the same as without the
    /// attribute, unless they grow around guides without a scalp. All guides exist. [0, 1].
    HAIR_STRAND_ATTRIBUTE_DENSITY
} hair_strand_attribute_kind;

/// Factor that differs from strand to strand, by strand, by a map on the scalp, or by both, which
/// multiply each other. Attributes of one kind multiply each other too, and those of groups. Every
/// product is limited to the range of the kind, and the result to the range of the member that the
/// kind multiplies.
typedef struct hair_strand_attribute {
    hair_struct_header header;
    /// Property that the factors multiply. It decides the range of the factors.
    hair_strand_attribute_kind kind; ///< Default HAIR_STRAND_ATTRIBUTE_STIFFNESS.
    /// Factor of each strand. Followers between guides have the weighted mean of their guides. NULL
    /// selects 1 for all strands.
    const float* strand_values; ///< Default NULL.
    /// Map of factors on the scalp, which strands and followers have at their roots.
    hair_map map;
} hair_strand_attribute;
HAIR_DESC(hair_strand_attribute)

/// Return the name of a kind of attributes, such as "stiffness", or NULL beyond the last.
/// OpenGL: not used. Any thread.
HAIR_API const char* hair_strand_attribute_name(hair_strand_attribute_kind kind);

// Grooms ------------------------------------------------------------------------------------------

/// Meaning of the strands that a groom is made from.
typedef enum hair_strand_set {
    /// All strands of the haircut. The groom chooses guides among them. The others are followers.
    HAIR_STRAND_SET_FULL = 0,
    /// Guides only. The groom generates followers on the scalp, or around guides if there is no
    /// scalp.
    HAIR_STRAND_SET_GUIDES
} hair_strand_set;

/// Input of hair_groom_create(). All arrays are copied.
typedef struct hair_groom_desc {
    hair_struct_header header;
    /// Callbacks. NULL selects the allocator of the C library and disables the log.
    const hair_host* host; ///< Default NULL.
    /// Vertex positions, xyz each, strand after strand, in units of hair_import.scale. Required.
    const float* positions;
    /// Number of vertices of each strand, of any size. Required.
    const uint32_t* strand_vertices;
    uint32_t strand_count; ///< Number of strands. [1, 4194304].
    /// Conversion of the positions. NULL selects the defaults: metres, +y up, root first.
    const hair_import* import; ///< Default NULL.
    hair_strand_set strand_set; ///< Default HAIR_STRAND_SET_FULL.
    /// Number of guides to choose from HAIR_STRAND_SET_FULL. HAIR_AUTO takes `strand_guides`.
    /// Without them it chooses one strand in ten, and at least 64. Every group gets at least one
    /// guide. Ignored for HAIR_STRAND_SET_GUIDES, whose strands are all guides.
    uint32_t guide_count; ///< [0, 262144]. Default HAIR_AUTO.
    /// Maximum number of simulated vertices per guide. The scalp holds the first two of them.
    uint32_t guide_vertices; ///< [2, 256]. Default 32.
    /// Number of followers to generate for HAIR_STRAND_SET_GUIDES.
    uint32_t follower_count; ///< [0, 4194304]. Default 18000.
    /// Radius around a guide in which its followers grow if there is no scalp.
    float clump_radius; ///< m. [0, 1]. Default 0.01.
    /// Positions of the scalp's vertices, xyz each, in the space of `positions`. NULL if there is
    /// no scalp. The other scalp fields must then be NULL or 0.
    const float* scalp_positions; ///< Default NULL.
    /// Three vertex indices per triangle, counter-clockwise seen from outside. Required with a
    /// scalp.
    const uint32_t* scalp_triangles;
    /// Fraction of the full follower density per scalp vertex. NULL selects 1 everywhere.
    const float* scalp_density; ///< [0, 1]. Default NULL.
    uint32_t scalp_vertex_count; ///< Number of scalp vertices. [0, 4194304].
    uint32_t scalp_triangle_count; ///< Number of scalp triangles. [0, 4194304].
    /// Seed of all random choices.
    uint32_t seed; ///< Default 1.
    /// Texture coordinates per scalp vertex, uv each, for map images and hair_view.color_texture.
    /// NULL if there are none.
    const float* scalp_uvs; ///< [-1e6, 1e6]. Default NULL.
    /// Maps on the scalp. The first NULL ends the list. Maps require a scalp.
    const hair_map_set* map_sets[4]; ///< Default NULL.
    /// Radius of each strand, in the unit of `positions`. Only the ratio to the mean radius
    /// matters. The ratio, clamped to 4, multiplies hair_look.strand.radius, also for followers
    /// generated from the strand. NULL selects random variation.
    const float* strand_radii; ///< [0, 1e6]. Default NULL.
    /// Linear rgb colours of the strands, color_count per strand. The groom resamples them to 8
    /// even places from root to tip and interpolates them between guides. See
    /// hair_look.color.groom_colors. NULL if there are none.
    const float* colors; ///< [0, 1]. Default NULL.
    /// Number of colours per strand, at even places from root to tip. 0 means one colour per
    /// vertex.
    uint32_t color_count; ///< [0, 256]. Default 0.
    /// Physics that instances will be created with. The call then prepares the guides for these
    /// physics and `solver`, on its thread. A hair_create() with both only uploads the guides, and
    /// instances share the preparation. NULL leaves the preparation to hair_create().
    const hair_physics* physics; ///< Default NULL.
    /// Solver for which `physics` prepares the guides.
    hair_solver solver; ///< Default HAIR_SOLVER_DIRECT.
    /// Threads on which the guides are prepared. This call, hair_create(), and a hair_step() after
    /// physics have changed use them. The struct is copied. NULL uses the calling thread.
    const hair_tasks* tasks; ///< Default NULL.
    /// Group of each strand, such as beard, brows or undercoat. A group has guides of its own, and
    /// its followers move with these guides only. hair_set_group_physics() sets its physics. NULL
    /// puts all strands into group 0, at no cost.
    const uint8_t* strand_groups; ///< [0, 7]. Default NULL.
    /// Attributes of strands, strand_attribute_count of them. Properties without an attribute cost
    /// nothing.
    const hair_strand_attribute* strand_attributes; ///< Default NULL.
    uint32_t strand_attribute_count; ///< Number of attributes. [0, 32].
    /// 1 for each strand that is a guide, otherwise 0. Used for HAIR_STRAND_SET_FULL if
    /// `guide_count` is HAIR_AUTO. The groom chooses a guide itself for a group without one. NULL,
    /// or zeros only, lets the groom choose all guides.
    const uint8_t* strand_guides; ///< [0, 1]. Default NULL.
} hair_groom_desc;
HAIR_DESC(hair_groom_desc)

/// Create a groom: repair the strands, choose guides, compute rest shapes, and bind or generate
/// followers.
///
/// @param desc Strands, scalp and maps. They are copied.
/// @param out Receives the groom.
/// Errors: HAIR_ERROR_ARGUMENT, also if no strand is usable, HAIR_ERROR_MEMORY, HAIR_ERROR_VERSION.
/// OpenGL: not used. Any thread.
HAIR_API hair_result hair_groom_create(const hair_groom_desc* desc, hair_groom** out);

/// Destroy a groom. Instances may still use the groom. NULL does nothing.
/// OpenGL: not used. Any thread.
HAIR_API void hair_groom_destroy(hair_groom* groom);

/// Sizes of a groom.
typedef struct hair_groom_info {
    hair_struct_header header;
    uint32_t strand_count; ///< Number of strands after the repairs.
    uint32_t guide_count; ///< Number of guides.
    uint32_t guide_vertex_count; ///< Number of vertices in all guides.
    uint32_t follower_count; ///< Number of strands drawn at full density.
    uint32_t patch_count; ///< Number of patches, the groups of strands that are culled together.
    float length[3]; ///< Minimum, mean and maximum length of the strands, m.
    float lower[3]; ///< Lower corner of the bounds of the strands at rest, m.
    float upper[3]; ///< Upper corner of the bounds of the strands at rest, m.
    hair_import_stats import_stats; ///< Repairs of the import.
    uint32_t group_count; ///< Highest group of the strands that are left, plus 1.
} hair_groom_info;
HAIR_DESC(hair_groom_info)

/// Write the sizes of a groom to `out`, which comes from hair_groom_info_default().
/// Errors: HAIR_ERROR_ARGUMENT, HAIR_ERROR_VERSION.
/// OpenGL: not used. Any thread.
HAIR_API hair_result hair_groom_describe(const hair_groom* groom, hair_groom_info* out);

/// Write the guides of a groom at rest, in the order of HAIR_READ_GUIDES. hair_groom_describe()
/// tells their numbers.
///
/// @param vertices Receives the number of vertices of each guide. NULL skips them.
/// @param guide_capacity Maximum number of guides to write. 0 if `vertices` is NULL.
/// @param positions Receives xyz per vertex in groom space, m. NULL skips them.
/// @param vertex_capacity Maximum number of vertices to write. 0 if `positions` is NULL.
/// Errors: HAIR_ERROR_ARGUMENT.
/// OpenGL: not used. Any thread.
HAIR_API hair_result hair_groom_get_guides(const hair_groom* groom, uint32_t* vertices,
                                           uint32_t guide_capacity, float* positions,
                                           uint32_t vertex_capacity);

/// Write the group of each guide, in the order of hair_groom_get_guides().
///
/// @param groups Receives one number per guide.
/// @param guide_capacity Maximum number of guides to write.
/// Errors: HAIR_ERROR_ARGUMENT.
/// OpenGL: not used. Any thread.
HAIR_API hair_result hair_groom_get_groups(const hair_groom* groom, uint8_t* groups,
                                           uint32_t guide_capacity);

#endif
