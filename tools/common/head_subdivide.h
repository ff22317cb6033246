// head_subdivide.h - Subdivision of a mesh of triangles and quadrilaterals into a smooth surface.
#ifndef TOOLS_COMMON_HEAD_SUBDIVIDE_H
#define TOOLS_COMMON_HEAD_SUBDIVIDE_H

#include <stdint.h>

// Number of values of a vertex. The first three are its position, the others are carried along.
#define HEAD_VALUES 5u
// Fourth corner of a triangle.
#define HEAD_NO_CORNER UINT32_MAX

struct head_surface {
    float (*vertices)[HEAD_VALUES];
    uint32_t (*faces)[4]; // counter-clockwise from outside
    uint32_t vertex_count, face_count;
};

// Replace each face by one quadrilateral per corner, once. Return 0, or -1 if memory runs out.
int head_subdivide(struct head_surface* surface);
void head_surface_free(struct head_surface* surface);

#endif
