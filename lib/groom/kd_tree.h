// kd_tree.h - k-d tree over points of any dimension (Bentley 1975), and the split that builds it.
#ifndef HAIR_GROOM_KD_TREE_H
#define HAIR_GROOM_KD_TREE_H

#include "lib/base/host.h"

#define HAIR_KD_MAX_DIMENSIONS 13 // Maximum number of dimensions.

struct hair_point_set {
    const float* points; // finite
    uint32_t dimensions;
};

// Return the axis along which the points named by `order` have the largest extent.
uint32_t hair_kd_widest_axis(struct hair_point_set point_set, const uint32_t* order, uint32_t count);

// Reorder so that the front lies before the back along `axis`. Return the length of the front. The
// front is as long as possible while its weights add up to at most `target`. Neither part is empty.
// The back begins with its lowest point along the axis. Requires count >= 2. `weights` is indexed
// by point. NULL gives every point the weight 1.
uint32_t hair_kd_split(struct hair_point_set point_set, uint32_t* order, uint32_t count, uint32_t axis,
                       const uint32_t* weights, uint64_t target);

struct hair_kd_plane {
    float at;
    uint32_t axis;
};

struct hair_kd_tree {
    struct hair_point_set point_set;
    uint32_t* order;
    // Planes that split `order`, indexed by the position of the first point behind each.
    struct hair_kd_plane* plane;
    uint32_t count;
};

// Build the tree. The points must outlive it.
hair_result hair_kd_tree_build(const hair_host* host, struct hair_point_set point_set, uint32_t count,
                               struct hair_kd_tree* tree);
void hair_kd_tree_free(const hair_host* host, struct hair_kd_tree* tree);

struct hair_kd_neighbor {
    uint32_t index;
    float squared; // squared distance
};

// Find the `wanted` points nearest to `point`, nearest first. Return how many were found. `near`
// already holds `found` of them. The search only replaces those by nearer ones. 0 starts afresh.
uint32_t hair_kd_tree_nearest(const struct hair_kd_tree* tree, const float* point,
                              struct hair_kd_neighbor* near, uint32_t found, uint32_t wanted);

#endif
