/// hair_groom.h - grooms: import of strands, scalp maps, and the haircut itself. [any thread]
#ifndef HAIR_HAIR_GROOM_H
#define HAIR_HAIR_GROOM_H

#include <hair/hair_base.h>

typedef enum hair_up { HAIR_UP_Y = 0, HAIR_UP_Z, HAIR_UP_X } hair_up;

/// How foreign strands become the library's: in metres, +y up, root first, fit to simulate.
typedef struct hair_import {
    hair_struct_header header;
    float scale; ///< Metres per unit of the positions. [1e-6, 1e6]. Default 1.
    hair_up up; ///< The axis that points up in them; turned to +y. Default HAIR_UP_Y.
    uint32_t tip_first; ///< 1: strands run from tip to root. [0, 1]. Default 0.
    float keep_fraction; ///< Share of the strands to keep, by `seed`. [1e-6, 1]. Default 1.
    uint32_t strand_vertices; ///< Vertices to resample every strand to. 0 (as they are) to 256. Default 0.
    uint32_t seed; ///< Of every random choice. Default 1.
} hair_import;
HAIR_DESC(hair_import)

/// What was wrong with foreign strands and what was done about it.
typedef struct hair_import_stats {
    uint32_t dropped_single; ///< Strands of fewer than two vertices, also after the repairs below.
    uint32_t dropped_short; ///< Strands shorter than 10 micrometres.
    uint32_t removed_nonfinite; ///< Vertices that were NaN, infinite or beyond 1e6 m.
    uint32_t removed_repeated; ///< Vertices nearer to the one before than 1e-5 of the strand's length.
    uint32_t resampled; ///< Strands of more than 256 vertices, brought down to 256.
} hair_import_stats;

typedef enum hair_strand_set {
    HAIR_STRAND_SET_FULL = 0, ///< Every hair: guides are chosen among them and the others follow those.
    HAIR_STRAND_SET_GUIDES ///< Guides only: followers are grown on the scalp, or around guides without one.
} hair_strand_set;

typedef enum hair_map_source {
    HAIR_MAP_SOURCE_NONE = 0, ///< 1 everywhere.
    HAIR_MAP_SOURCE_IMAGE, ///< Values of an image, by scalp_uvs, smoothly from one to the next.
    HAIR_MAP_SOURCE_VERTICES, ///< A value per vertex of the scalp, linear between.
    HAIR_MAP_SOURCE_TRIANGLES ///< A value per triangle of the scalp.
} hair_map_source;

/// Values all over a scalp.
typedef struct hair_map {
    hair_map_source source; ///< Default HAIR_MAP_SOURCE_NONE.
    const float* values; ///< Of an image row after row, the first row at v = 0. Required but for none.
    uint32_t width, height; ///< Of an image. [1, 16384] each.
} hair_map;

/// Which share of followers grows where, and how thick. A groom has up to four sets; what is drawn may lie between.
typedef struct hair_map_set {
    hair_struct_header header;
    hair_map density; ///< Share of the followers that are drawn. [0, 1].
    hair_map thickness; ///< Of a strand, as a multiple of the look's radius. [0, 4].
} hair_map_set;
HAIR_DESC(hair_map_set)

typedef struct hair_groom_desc {
    hair_struct_header header;
    const hair_host* host; ///< NULL: the C library's allocator, no log.
    const float* positions; ///< xyz per vertex, strand after strand; `import` says the unit. Required.
    const uint32_t* strand_vertices; ///< Vertices in each strand, any number. Required.
    uint32_t strand_count; ///< [1, 4194304].
    const hair_import* import; ///< NULL: the defaults: metres, +y up, root first.
    hair_strand_set strand_set; ///< Default HAIR_STRAND_SET_FULL.
    uint32_t guide_count; ///< To choose of HAIR_STRAND_SET_FULL. 0 (one in ten, at least 64) to 262144.
    uint32_t guide_vertices; ///< Most simulated per guide; the scalp holds two. [2, 256]. Default 32.
    uint32_t follower_count; ///< To grow for HAIR_STRAND_SET_GUIDES. [0, 4194304]. Default 18000.
    float clump_radius; ///< Of what grows around a guide, no scalp given. m. [0, 1]. Default 0.01.
    const float* scalp_positions; ///< xyz per vertex, in the space of `positions`. NULL: no scalp.
    const uint32_t* scalp_triangles; ///< Three indices each, counter-clockwise from outside.
    const float* scalp_density; ///< Per scalp vertex, share of the full density. [0, 1]. NULL: 1.
    uint32_t scalp_vertex_count; ///< [0, 4194304].
    uint32_t scalp_triangle_count; ///< [0, 4194304].
    uint32_t seed; ///< Of every random choice. Default 1.
    const float* scalp_uvs; ///< uv per scalp vertex, for maps that are images. NULL: none.
    const hair_map_set* map_sets[4]; ///< Maps on the scalp, up to the first NULL. NULL: none.
    /// Per strand, in the unit of `positions`: of the mean of all that much thicker than hair_look.radius are it and what
    /// grows of it, at most 4 times. [0, 1e6]. NULL: chance has it.
    const float* strand_radii;
    /// Of strands, linear rgb; followers between guides have what lies between. See hair_look.groom_colors. [0, 1]. NULL:
    /// none. They are kept at 8 even places from root to tip.
    const float* colors;
    /// Of each strand, at even places from root to tip; 0: one per vertex.
    uint32_t color_count; ///< [0, 256]. Default 0.
} hair_groom_desc;
HAIR_DESC(hair_groom_desc)

/// Repair strands, choose guides, find rest shapes, bind or grow followers.
HAIR_API hair_result hair_groom_create(const hair_groom_desc* desc, hair_groom** out);
HAIR_API void hair_groom_destroy(hair_groom* groom);

typedef struct hair_groom_info {
    hair_struct_header header;
    uint32_t strand_count; ///< Left after the repairs.
    uint32_t guide_count;
    uint32_t guide_vertex_count; ///< In all guides together.
    uint32_t follower_count; ///< Strands drawn at full density.
    uint32_t patch_count;
    float length[3]; ///< Of the strands: least, mean, greatest. m.
    float lower[3], upper[3]; ///< Bounds of the strands at rest. m.
    hair_import_stats import_stats;
} hair_groom_info;
HAIR_DESC(hair_groom_info)

HAIR_API hair_result hair_groom_describe(const hair_groom* groom, hair_groom_info* out);

#endif
