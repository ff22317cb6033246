// groom.h - a haircut at rest: simulated guides, followers bound to them, and patches for drawing.
#ifndef HAIR_GROOM_GROOM_H
#define HAIR_GROOM_GROOM_H

#include "lib/base/host.h"
#include "lib/base/math.h"
#include "lib/groom/guide_factors.h"
#include "lib/groom/scalp_binding.h"
#include "glsl/shared.h"

struct hair_groom {
    hair_host host;
    atomic_uint holders; // the application, and instances
    hair_groom_info info;
    struct hair_guide* guides; // info.guide_count
    struct hair_rest* rest; // info.guide_vertex_count
    uint32_t* guide_order; // Guides in an order of levels of detail, see guide_order.c.
    float* roots; // xyz of the root of each guide
    hair_vec3 lower, upper; // bounds of the guides at rest, m
    // info.follower_count, and after them the shapes of followers, HAIR_SHAPE_TEXELS() of 16 bytes
    // each.
    struct hair_follower* followers;
    // Number of vertices of a follower's shape, 0 if followers have none.
    uint32_t shape_vertices;
    // Smoothed guides at rest, from the root and in the root frame, m. NULL without shapes.
    hair_vec4* guide_shapes;
    struct hair_patch* patches; // info.patch_count
    // rgb and an unused value at HAIR_STRAND_COLORS points of each follower. 65535 stands for 1.
    // NULL disables.
    uint16_t* colors;
    // Factors of the look of each follower as half floats, factor_count of each. NULL if no
    // attribute has them. See hair_strand_look for the slots.
    uint16_t* factors;
    uint32_t factor_slots, factor_count;
    float max_follower_factors[HAIR_FACTORS]; // Maximum of all followers.
    // Factors of the physics of each guide, and the bounds of all. NULL if no attribute has them.
    struct hair_guide_factors* guide_factors;
    struct hair_guide_factors min_factors, max_factors;
    // A sphere inside the head. xyz is its centre and w its radius, m. A radius of 0 means no
    // sphere.
    hair_vec4 head_sphere;
    uint32_t max_vertices; // maximum of all guides
    uint32_t map_sets;
    // NULL without a scalp that has a triangle with three different corners.
    struct hair_root_bindings* root_bindings;
    float* root_uvs; // uv of the root of each follower. NULL without scalp uvs.
    hair_tasks tasks; // threads of the application. A NULL `run` means the calling thread.
    // The guides as rods, prepared for physics, and the function that frees them. NULL if they are
    // not prepared.
    struct hair_prepared_rods* prepared;
    void (*free_prepared)(const hair_host* host, struct hair_prepared_rods* prepared);
};

// Strands that the guides and followers of a groom of full strands are made of, after the repairs.
struct hair_groom_origin {
    uint32_t *guide, *follower;
};

// Build a groom. `desc` is complete and checked, except the contents of its arrays. `origin`
// receives arrays that the caller frees, also on failure. NULL disables it. On failure *out is
// untouched.
hair_result hair_groom_build(const hair_host* host, const hair_groom_desc* desc, const hair_import* import,
                             struct hair_groom_origin* origin, hair_groom** out);
// Return the size of followers and of their shapes.
size_t hair_groom_follower_bytes(const struct hair_groom* groom);
// Add a reference. Any thread. Return `groom`.
hair_groom* hair_groom_retain(hair_groom* groom);
// Remove a reference, and free the groom with the last one. Any thread. NULL is ignored.
void hair_groom_release(hair_groom* groom);

// Functions of cut.c.

// Write a guide of which a fraction of its length is kept, [0, 1], and the vertices of the whole
// guide at rest. The vertices beyond the new tip are those of the groom. position.w of the tip is
// the length that is cut off, m.
void hair_groom_cut_guide(const struct hair_groom* groom, uint32_t guide, float fraction,
                          struct hair_guide* out, struct hair_rest* rest);
// Return the weighted mean of values of the guides of a follower, which are `stride` floats apart.
float hair_groom_follower_mean(const struct hair_groom* groom, uint32_t follower, const float* guide_values,
                               uint32_t stride);
// Return the fraction of its length that a follower has beside guides with the given fractions.
float hair_groom_follower_fraction(const struct hair_groom* groom, uint32_t follower,
                                   const float* guide_fraction);

// Return a factor of a follower, HAIR_FACTOR_CLUMP or another. It is 1 without an attribute.
float hair_groom_follower_factor(const struct hair_groom* groom, uint32_t follower, int factor);

// Find the roots and the bounds of the guides at rest.
hair_result hair_measure_rest(struct hair_groom* groom);
// Find the order of guides for levels of detail, from their rest shape.
hair_result hair_order_guides(struct hair_groom* groom);
// Return the root of a guide.
static inline hair_vec3 hair_guide_root(const struct hair_groom* groom, uint32_t guide)
{
    HAIR_ASSERT(guide < groom->info.guide_count);
    return hair_load3(groom->roots + 3 * (size_t)guide);
}

// Compute the reach and length of each patch from its followers.
void hair_measure_patches(struct hair_groom* groom);
// Return the sphere inside the head: xyz is its centre, w its radius, m. The radius is 0 if none
// fits.
hair_vec4 hair_find_head_sphere(const struct hair_groom* groom);

#endif
