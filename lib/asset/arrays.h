// arrays.h - strands and scalps from the arrays of an application, which hair_groom_desc has.
#ifndef HAIR_ASSET_ARRAYS_H
#define HAIR_ASSET_ARRAYS_H

#include "lib/asset/asset.h"

// Copy and clean the strands of a desc with their radii, groups, factors and colours, in tasks.
// Fail if no strand is left.
hair_result hair_strands_import(const hair_host* host, const hair_tasks* tasks, const hair_groom_desc* desc,
                                const hair_import* import, struct hair_strands* strands,
                                hair_import_stats* repairs);

// Copy the factors of strands from the attributes of a desc. Attributes of one kind multiply.
hair_result hair_strands_copy_factors(const hair_host* host, const hair_groom_desc* desc,
                                      struct hair_strands* strands);

// Check the triangles and the density of a scalp.
hair_result hair_scalp_check(const hair_host* host, const hair_groom_desc* desc);
// Convert the vertices of a scalp to metres and +y up.
hair_result hair_scalp_place(const hair_host* host, const hair_groom_desc* desc, const hair_import* import,
                             float* positions);

#define HAIR_MAX_MAP_SIDE 16384u // Maximum number of values along a side of an image.
#define HAIR_MAX_MAP_THICKNESS 4.0f

// Return the number of values of a map on a scalp.
uint64_t hair_map_count_values(const hair_map* map, uint32_t vertices, uint32_t triangles);
// Return the range of the values of maps of density, or of thickness.
struct hair_attribute_range hair_map_range_of(int thickness);
uint32_t hair_count_map_sets(const hair_groom_desc* desc);
// Check the texture coordinates of a scalp.
hair_result hair_check_uvs(const hair_host* host, const hair_groom_desc* desc);
// Check all map sets, and texture coordinates.
hair_result hair_check_map_sets(const hair_host* host, const hair_groom_desc* desc);
// Check the maps of all attributes, and texture coordinates if there is one.
hair_result hair_check_attribute_maps(const hair_host* host, const hair_groom_desc* desc);
// Check and copy all maps of a desc, which has a scalp.
hair_result hair_asset_copy_maps(const hair_groom_desc* desc, hair_asset* asset);

// Joints of the vertices of a scalp, as for hair_set_scalp_weights(). NULL if there are none.
struct hair_skin_arrays {
    const uint16_t* joints;
    const float* weights;
    uint32_t joint_count;
    const char* joint_names; // One after another, each with a byte 0 at its end. NULL if unknown.
};

// Make an asset of the arrays of a desc, whose pointers have been checked. On failure *out is
// untouched.
hair_result hair_asset_from_arrays(const hair_host* host, const hair_groom_desc* desc,
                                   const hair_import* import, const struct hair_skin_arrays* skin,
                                   hair_asset** out);

#endif
