// groom_builder.h - a groom under construction: the data that the steps of hair_groom_build pass
// on.
#ifndef HAIR_GROOM_GROOM_BUILDER_H
#define HAIR_GROOM_GROOM_BUILDER_H

#include "lib/asset/strands.h"
#include "lib/groom/kd_tree.h"
#include "lib/groom/groom.h"
#include "lib/groom/guide_spline.h"

// Number of features of a strand: its root, the points at 1/3, 2/3 and 1 of its length from the
// root, relative to its length, and the logarithm of its length. See lib/groom/import.c.
#define HAIR_FEATURES 13
#define HAIR_MIN_TASK_STRANDS 64 // Minimum number of strands of a task.
// Number of guides between which a follower of full strands moves.
#define HAIR_FOLLOWED 3

// The closest point on the scalp to a root.
struct hair_scalp_point {
    uint32_t triangle;
    float weight[3]; // barycentric, per corner
};

struct hair_groom_builder {
    const hair_host* host;
    const hair_groom_desc* desc;
    const hair_import* import;
    struct hair_groom* groom; // the result

    struct hair_strands strands; // after cleaning
    uint32_t* first; // first vertex of each strand
    float* length; // length of each strand, m
    float* features; // HAIR_FEATURES per strand, only with HAIR_STRAND_SET_FULL

    float* scalp; // xyz per vertex, in the space of the strands. NULL without a scalp.
    float* density; // mean over each triangle

    float* map_lengths; // fraction of each strand's length by maps. NULL without such maps.

    uint32_t* chosen; // strand of each guide
    bool has_given_guides; // The application or a file names the guides of HAIR_STRAND_SET_FULL.
    uint32_t* owner; // a nearby guide of each strand, only with HAIR_STRAND_SET_FULL
    // First guide of each group, and the number of guides, only with HAIR_STRAND_SET_FULL.
    uint32_t group_first[HAIR_MAX_STRAND_GROUPS + 1];
    // The HAIR_FOLLOWED guides nearest to each strand, only with HAIR_STRAND_SET_FULL.
    struct hair_kd_neighbor* near;

    // A candidate is a follower before its place in the draw order is known. It grows on a root
    // bin, which is a scalp triangle or a guide. The candidates of a root bin are neighbours.
    uint32_t bin_count;
    uint32_t* bin_candidates; // number of candidates of each root bin
    uint32_t* bin_first; // first candidate of each root bin
    float* bin_centres; // xyz of each root bin
    const float* bin_density; // of each root bin. NULL means 1.
    uint32_t candidate_count;
    // True if root bins are triangles and any run of candidates of one is spread evenly over it.
    bool is_scattered;
    uint32_t* strand_of; // strand of each candidate, only with HAIR_STRAND_SET_FULL
    uint32_t* place; // follower of each candidate
    uint32_t* number; // of each candidate before some were removed. NULL if none was.

    // Closest point on the scalp of each candidate. NULL without a scalp that has a usable
    // triangle.
    struct hair_scalp_point* scalp_points;
    hair_vec4* map_density; // of each candidate, one component per set of maps. NULL without maps.
    float* map_thickness; // of each candidate, the maximum over all sets
    hair_vec4* map_fraction; // thickness in each set as a fraction of map_thickness
};

static inline uint32_t hair_group_of(const struct hair_groom_builder* builder, uint32_t strand)
{
    return builder->strands.groups ? builder->strands.groups[strand] : 0;
}

// Strands that a follower is made of, with their weights.
struct hair_strand_mix {
    uint32_t strand[3];
    float weight[3];
};
// Return the mix of the strands of guides. The weight of guide 0 is the rest to 1.
struct hair_strand_mix hair_mix_guides(const struct hair_groom_builder* builder, const uint32_t guide[3],
                                       float weight1, float weight2);
struct hair_strand_mix hair_mix_of(const struct hair_groom_builder* builder, uint32_t candidate,
                                   const struct hair_follower* follower);

// Return whether any attribute of a kind has values of strands or, if `is_map`, a map.
bool hair_has_attribute(const struct hair_groom_builder* builder, hair_strand_attribute_kind kind,
                        bool is_map);
// Return the factor of a kind for a mix of strands. Only maps need `scalp_point`, the root.
float hair_find_factor(const struct hair_groom_builder* builder, hair_strand_attribute_kind kind,
                       const struct hair_strand_mix* mix, const struct hair_scalp_point* scalp_point);

// Return the product of all maps of a kind at a point of the scalp.
float hair_find_map_factor(const struct hair_groom_builder* builder, hair_strand_attribute_kind kind,
                           const struct hair_scalp_point* scalp_point);
// Shorten a grown follower where the map of lengths is shorter at its root than at its guides.
void hair_shorten_follower(const struct hair_groom_builder* builder, const struct hair_strand_mix* mix,
                           const struct hair_scalp_point* root, struct hair_follower* follower);

// Return the value of a map at a point of the scalp. A map without a source has no point.
float hair_map_value(const struct hair_groom_builder* builder, const hair_map* map,
                     const struct hair_scalp_point* scalp_point);
// Fail because no triangle of the scalp has an area on which maps could lie.
hair_result hair_fail_degenerate(const struct hair_groom_builder* builder);

// Steps, in order. Each reports a failure by one sentence and leaves its results in the builder.
hair_result hair_build_strands(struct hair_groom_builder* builder);
hair_result hair_build_scalp(struct hair_groom_builder* builder);
// Check the maps of attributes, and shorten strands by those of their length.
hair_result hair_shorten_strands(struct hair_groom_builder* builder);
hair_result hair_measure_strands(struct hair_groom_builder* builder);
hair_result hair_build_guides(struct hair_groom_builder* builder);
hair_result hair_build_rest(struct hair_groom_builder* builder);
// Compute the factors of guides.
hair_result hair_build_guide_factors(struct hair_groom_builder* builder);
// Sources of followers. The desc selects one: full strands (bind.c), the guides and the space
// around them (generate.c), or the scalp (scalp.c). First all candidates are counted per root bin.
// Then the patches give them places. Then followers are made from them.
hair_result hair_strand_candidates(struct hair_groom_builder* builder);
hair_result hair_guide_candidates(struct hair_groom_builder* builder);
hair_result hair_scalp_candidates(struct hair_groom_builder* builder);
// Find the closest point on the scalp of all candidates. The candidates of scalp.c have theirs
// already.
hair_result hair_build_scalp_points(struct hair_groom_builder* builder);
// Remove candidates by the attributes of density.
hair_result hair_thin_candidates(struct hair_groom_builder* builder);
// Read the maps for all candidates.
hair_result hair_build_maps(struct hair_groom_builder* builder);
// Scale the radii of followers by the maps.
void hair_apply_thickness(struct hair_groom_builder* builder);
hair_result hair_build_patches(struct hair_groom_builder* builder);
hair_result hair_strand_followers(struct hair_groom_builder* builder);
// Give a follower the shape of its strand, and weights of the guides with which it moves.
void hair_shape_follower(const struct hair_groom_builder* builder, uint32_t strand, uint32_t place,
                         const struct hair_guide_spline* spline, struct hair_follower* follower);
// Write a guide at rest in its root frame.
void hair_shape_guide(struct hair_groom* groom, uint32_t guide, const struct hair_guide_spline* spline);
hair_result hair_guide_followers(struct hair_groom_builder* builder);
hair_result hair_scalp_followers(struct hair_groom_builder* builder);
// Write the guides between which each candidate of scalp.c will grow.
hair_result hair_scalp_mixes(struct hair_groom_builder* builder, struct hair_strand_mix* out);
// Give followers the radii and colours of strands.
hair_result hair_build_strand_attributes(struct hair_groom_builder* builder);
// Compute the factors of followers from the attributes of strands.
hair_result hair_build_follower_factors(struct hair_groom_builder* builder);
hair_result
// Bind guides and followers to the scalp.
hair_build_root_bindings(struct hair_groom_builder* builder);

// Reorder the neighbouring candidates in `queue` so that the front needs another patch than the
// back. Return the length of the front, or 0 if maps allow one patch for all.
uint32_t hair_map_split(const struct hair_groom_builder* builder, uint32_t* queue, uint32_t count);
// Put the candidates of one patch in density order and fill in the map values of the patch.
void hair_map_patch(const struct hair_groom_builder* builder, uint32_t* queue, struct hair_patch* patch);
// Sort both arrays by `from`, the density fraction from which on each candidate is drawn.
void hair_sort_by_density(uint32_t* queue, float* from, uint32_t count);

// Create root bins without candidates, one per guide or one per scalp triangle.
hair_result hair_guide_bins(struct hair_groom_builder* builder);
hair_result hair_scalp_bins(struct hair_groom_builder* builder);
// Number the candidates: set the first candidate of each root bin from the counts.
void hair_number_candidates(struct hair_groom_builder* builder);

// Return the root of a candidate. Not valid for the candidates of scalp.c.
hair_vec3 hair_candidate_root(const struct hair_groom_builder* builder, uint32_t bin, uint32_t candidate);
hair_vec3 hair_scalp_corner(const struct hair_groom_builder* builder, uint32_t triangle, uint32_t corner);

// Return the number of a candidate before attributes removed some.
static inline uint32_t hair_candidate_number(const struct hair_groom_builder* builder, uint32_t candidate)
{
    return builder->number ? builder->number[candidate] : candidate;
}
// Return the seed of a candidate's random choices.
uint32_t hair_candidate_random(const struct hair_groom_builder* builder, uint32_t candidate);

// Return a follower equal to its guide, except for its random values.
struct hair_follower hair_own_follower(uint32_t guide, uint32_t* random);
// Return a follower that clumps towards its guide. `offset` leads from the guide's root to its
// root, in the root frame.
struct hair_follower hair_grown_follower(uint32_t guide, hair_vec3 offset, uint32_t* random);

#endif
