// cloud.h - points of any dimension, cut into halves and searched: the k-d tree (Bentley 1975) and its step.
#ifndef HAIR_GROOM_CLOUD_H
#define HAIR_GROOM_CLOUD_H

#include "lib/base/host.h"

#define HAIR_CLOUD_DIMENSIONS 12 // At most.

struct hair_cloud {
    const float* points; // finite
    uint32_t dimensions;
};

// The axis along which the points that `order` names reach farthest.
uint32_t hair_cloud_widest(struct hair_cloud cloud, const uint32_t* order, uint32_t count);

// Reorder so that the front lies before the back along the axis. The front is as long as it can be while its
// weights add up to no more than `target`, and the back begins with its nearest; but neither is ever empty.
// `weights` by point; NULL: 1 each. count >= 2. Returns the length of the front.
uint32_t hair_cloud_split(struct hair_cloud cloud, uint32_t* order, uint32_t count, uint32_t axis,
                          const uint32_t* weights, uint64_t target);

struct hair_plane {
    float at;
    uint32_t axis;
};

struct hair_tree {
    struct hair_cloud cloud;
    uint32_t* order;
    struct hair_plane* plane; // where `order` is split, by the place of the back's first
    uint32_t count;
};

// The cloud's points must outlive the tree.
hair_result hair_tree_build(const hair_host* host, struct hair_cloud cloud, uint32_t count,
                            struct hair_tree* tree);
void hair_tree_free(const hair_host* host, struct hair_tree* tree);

struct hair_near {
    uint32_t index;
    float squared; // distance
};

// The `wanted` points nearest to `point`, nearest first. `near` holds `found` of them already, which the
// search may only better (0: none). Returns how many there are.
uint32_t hair_tree_nearest(const struct hair_tree* tree, const float* point, struct hair_near* near,
                           uint32_t found, uint32_t wanted);

#endif
