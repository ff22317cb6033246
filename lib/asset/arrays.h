// arrays.h - strands and scalps from the arrays of an application, which hair_groom_desc has.
#ifndef HAIR_ASSET_ARRAYS_H
#define HAIR_ASSET_ARRAYS_H

#include "lib/asset/asset.h"

// Copy and clean the strands of a desc with their radii, groups, factors and colours. Fail if no
// strand is left.
hair_result hair_strands_import(const hair_host* host, const hair_groom_desc* desc, const hair_import* import,
                                struct hair_strands* strands, hair_import_stats* repairs);

// Copy the factors of strands from the attributes of a desc. Attributes of one kind multiply.
hair_result hair_strands_copy_factors(const hair_host* host, const hair_groom_desc* desc,
                                      struct hair_strands* strands);

// Check the triangles and the density of a scalp.
hair_result hair_scalp_check(const hair_host* host, const hair_groom_desc* desc);
// Convert the vertices of a scalp to metres and +y up.
hair_result hair_scalp_place(const hair_host* host, const hair_groom_desc* desc, const hair_import* import,
                             float* positions);

// Joints of the vertices of a scalp, as for hair_set_scalp_weights(). NULL if there are none.
struct hair_skin_arrays {
    const uint16_t* joints;
    const float* weights;
    uint32_t joint_count;
};

// Make an asset of the arrays of a desc, whose pointers have been checked. On failure *out is
// untouched.
hair_result hair_asset_from_arrays(const hair_host* host, const hair_groom_desc* desc,
                                   const hair_import* import, const struct hair_skin_arrays* skin,
                                   hair_asset** out);

#endif
