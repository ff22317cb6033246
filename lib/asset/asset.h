// asset.h - a haircut as plain arrays, independent of its source.
#ifndef HAIR_ASSET_ASSET_H
#define HAIR_ASSET_ASSET_H

#include <hair/hair_asset.h>
#include "glsl/shared.h"
#include "lib/asset/strands.h"

// Maximum difference of the sum of the weights of a vertex from 1. Weights may be stored as bytes,
// whose sum is not exactly 1.
#define HAIR_MAX_WEIGHT_ERROR 0.01f

struct hair_asset {
    hair_host host;
    hair_format format;
    hair_strand_set strand_set;
    struct hair_strands strands;
    float* scalp_positions; // xyz per vertex. NULL without a scalp.
    uint32_t* scalp_triangles;
    float* scalp_density; // of each vertex. NULL if unknown.
    float* scalp_uvs; // uv of each vertex. NULL if unknown.
    uint16_t* scalp_joints; // 4 of each vertex. NULL without a skin.
    float* scalp_weights; // of these joints
    uint32_t scalp_vertex_count, scalp_triangle_count, scalp_joint_count;
    char* joint_names; // in UTF-8, each followed by a byte 0. NULL if unknown.
    size_t joint_names_size;
    uint32_t file_strands, file_vertices;
    hair_import_stats repairs;
    // Maps, whose values belong to the asset, and attributes, whose strand_values are the factors
    // of `strands`. Each kind with factors has them in its first attribute.
    hair_map_set map_sets[HAIR_MAP_SETS];
    hair_strand_attribute attributes[HAIR_MAX_ATTRIBUTES];
    uint32_t map_set_count, attribute_count;
};

// Return the size that a file with this beginning can have. See hair_asset_max_size().
uint64_t hair_asset_find_max_size(const void* bytes, size_t size);
// Decode a file. `import` has been checked. On failure *out is untouched.
hair_result hair_asset_decode(const hair_host* host, const hair_import* import, const void* bytes,
                              size_t size, hair_asset** out);
hair_result hair_asset_encode(const hair_asset* asset, hair_format format, void* bytes, size_t capacity,
                              size_t* size);
void hair_asset_free(hair_asset* asset);

// Append an attribute without values. There must be room.
hair_strand_attribute* hair_asset_add_attribute(hair_asset* asset, hair_strand_attribute_kind kind);
// Return the number of attributes that the asset will have with its factors.
uint32_t hair_asset_count_attributes(hair_asset* asset);
// Let attributes point at the factors of strands, whose arrays change no more.
void hair_asset_link_factors(hair_asset* asset);

#endif
