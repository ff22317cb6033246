// groom.h - a groom at rest: guides, followers and patches.
#ifndef HAIR_SHARED_GROOM_H
#define HAIR_SHARED_GROOM_H

#define HAIR_MAX_GUIDES 262144       // Per groom.
#define HAIR_MAX_GUIDE_VERTICES 256  // Per guide. A work group has one thread per vertex.
#define HAIR_MAX_SMOOTH_VERTICES 511 // Per guide. Two samples per segment of the longest guide.
#define HAIR_MAX_GUIDE_STRIDE 8 // Maximum of hair_step_params.guide_stride, a power of two.
#define HAIR_FOLLOWER_TEXELS 6 // Per hair_follower.
#define HAIR_PATCH_TEXELS 4 // Per hair_patch.
#define HAIR_MAP_SETS 4 // Maximum per groom.

// A guide at rest, in groom space.
struct hair_guide {
    hair_vec4 root_frame; // Unit quaternion of the first segment, y along the segment.
    hair_uint first;      // Index of the first vertex.
    hair_uint count; // Number of vertices.
    float     arc_length; // m.
    hair_uint group;
};
HAIR_SIZE(hair_guide)

// A guide vertex at rest, in groom space.
struct hair_rest {
    // xyz: m. w: distance to the next vertex, m. For the tip: length that has been cut off, m.
    hair_vec4 position;
    // Frame of the segment to the next vertex, parallel-transported from the root's frame. Unit
    // quaternion, y along the segment.
    hair_vec4 frame;
};
HAIR_SIZE(hair_rest)

// Texels of two vertices each that the shape of a follower takes, with a vertex beyond each end.
#define HAIR_SHAPE_TEXELS(vertices) (((vertices) + 3) / 2)

// A strand that is interpolated while drawing. t goes from 0 at its root to 1 at its tip, and u = t
// length_ratio. g_k(u) and F_k(u) are the position and frame of guide k. o(t) is the cubic Bezier
// curve of `offset`.
//   single(t) = g_0(u) + F_0(u) o(t)
//   multi(t)  = (1 - weight1 - weight2) g_0(u) + weight1 g_1(u) + weight2 g_2(u)
//               + F_0(u) (offset[1..3].w)
// With multi = -1 the follower has a shape of its own, c(t), from its root in the root frame of
// guide 0, in units of offset[2].w. D_k(t) is the displacement of guide k, see
// strands/displace.comp. offset[3].w is the follower's number. Its shape is a Catmull-Rom spline,
// whose vertices are snorms of 16 bits, and follows all followers in their buffer.
//   own(t) = g_0(0) + F_0(0) (offset[0].xyz + c(t))
//            + offset[1].w D_0(t) + weight1 D_1(t) + weight2 D_2(t)
struct hair_follower {
    hair_uint guide0, guide1, guide2;
    hair_uint seed;
    float     weight1, weight2; // Barycentric weights of guides 1 and 2.
    // Its length as a fraction of guide 0's. Beyond 1 it goes on straight.
    float     length_ratio;
    // 0 for a single-strand follower. 1 for multi-strand at the root, tending to single-strand as
    // it clumps. -1 for a follower with a shape of its own.
    float     multi;
    // xyz: control points in guide 0's frame, m. [0].w: radius, as a fraction of the look's.
    hair_vec4 offset[4];
};
HAIR_SIZE(hair_follower)

// Root binding: the point on the scalp to which a root is bound, at rest.
struct hair_root_binding {
    hair_uint corner0, corner1, corner2; // Scalp vertices of its triangle.
    float     weight1, weight2;          // Barycentric weights of corner1 and corner2.
    float     away_x, away_y, away_z;    // Offset from the point to the root, m.
};
HAIR_SIZE(hair_root_binding)

// Followers that are drawn together, in an order that may be cut short. Grooms make patches of at
// most HAIR_MAX_ISOLINES followers.
struct hair_patch {
    hair_uint first; // First follower.
    hair_uint count;
    float     density;    // Local density: fraction of the followers that grow here. [0, 1].
    hair_uint guide;      // Guide whose root is the origin of `reach`.
    hair_vec4 map_density;   // Factor of the density by each set of maps.
    hair_vec4 map_thickness; // Factor of the followers' radius by each set of maps.
    float     reach;         // Maximum distance of any follower from the guide's root, m.
    float     longest;       // Length of its longest follower, m.
    float     importance;    // Factor of the size on the screen.
    hair_uint occluded;        // 1 if the last occlusion culling found the patch occluded.
};
HAIR_SIZE(hair_patch)

#endif
