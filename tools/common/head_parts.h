// head_parts.h - Parts of the bust's mesh: points, growing meshes, skin, eyes and small hairs.
#ifndef TOOLS_COMMON_HEAD_PARTS_H
#define TOOLS_COMMON_HEAD_PARTS_H

#include "tools/common/head.h"
#include "tools/common/head_subdivide.h"

struct head_point {
    float x, y, z;
};

// Look of a vertex.
struct head_paint {
    float color[3]; // linear reflectance
    // 1 for skin, whose light spreads below the surface, plus the fraction that hair covers.
    // HEAD_KIND_HAIR for a hair, 0 for anything else.
    float kind;
    float gloss; // strength of the highlight
    float open; // visible fraction of the surroundings
};

// A mesh that grows. `failed` is set when memory runs out.
struct head_builder {
    struct head_mesh mesh;
    uint32_t vertex_room, triangle_room;
    bool failed;
};

// Centre of the left eye, in m. The right eye is at the same place with the opposite x.
#define HEAD_EYE ((struct head_point){0.0303f, 1.6114f, 0.0682f})
#define HEAD_EYE_RADIUS 0.0153f

// Parts that bust.inl holds.
enum head_part { HEAD_SKIN, HEAD_CLOTH, HEAD_BAND, HEAD_PARTS };

// Read a part of the bust. Return 0, or -1 if memory runs out. Release the surface with
// head_surface_free(), in either case.
int head_load_part(enum head_part part, struct head_surface* out);

// Return t in [0, 1] for x between two bounds, by a cubic with level ends.
float head_smooth(float from, float to, float x);
float head_mix(float a, float b, float t);
struct head_point head_add(struct head_point a, struct head_point b, float scale); // a + scale b
struct head_point head_cross(struct head_point a, struct head_point b);
struct head_point head_unit(struct head_point a);
float head_dot(struct head_point a, struct head_point b);
// Return a random number in [0, 1) and advance the seed.
float head_random(uint32_t* seed);

// Add a vertex and return its index.
uint32_t head_put_vertex(struct head_builder* builder, struct head_point p, struct head_point normal,
                         const struct head_paint* paint);
void head_put_triangle(struct head_builder* builder, uint32_t a, uint32_t b, uint32_t c);

// Return a point of skin where hair grows, moved onto the skull that roots of hair are on. Return
// other points as they are.
struct head_point head_on_skull(struct head_point p);

// Return the paint of skin at a point. `lip` and `open` come from the face that the point is on.
struct head_paint head_paint_skin(struct head_point p, float lip, float open);

// Edges of the lids of the left eye from the inner to the outer corner, in m: upper, then lower.
#define HEAD_LID_POINTS 9
extern const float head_lids[2][HEAD_LID_POINTS][3];

// Return the density of the brows at a point of the face, in [0, 1].
float head_brow(struct head_point p);

// Return the height of p above the hairline of the built-in haircuts, in m.
float head_above_hairline(struct head_point p);

// Add both eyeballs.
void head_put_eyes(struct head_builder* builder);
// Add a band around hair. Defined in head_tie.c.
void head_put_tie(struct head_builder* builder, const struct head_tie* tie);
// Add brows and lashes. Brows grow on the triangles that the mesh has.
void head_put_brows(struct head_builder* builder);
void head_put_lashes(struct head_builder* builder);
// Add short, fine hairs along the hairline, on the triangles that the mesh has. A tie leaves some
// longer ones loose.
void head_put_fringe(struct head_builder* builder, bool is_tied);

#endif
