// head_shape.h - Distance function of the bust, made of blended parts.
#ifndef TOOLS_COMMON_HEAD_SHAPE_H
#define TOOLS_COMMON_HEAD_SHAPE_H

#include "tools/common/head.h"

struct head_point {
    float x, y, z;
};

// Lowest height of the bust, where it is cut off, in m.
#define HEAD_BOTTOM 1.25f

// Return the distance to the skin or garment, in m, negative inside. The distance is accurate
// within a few centimetres of the surface.
float head_distance(struct head_point p);

// Return the depth of p below the collar of the garment, in m.
float head_below_collar(struct head_point p);

// Compute the linear reflectance of the skin or of the garment at p.
void head_color(struct head_point p, int is_worn, float rgb[3]);

// Cut a mesh along the collar and colour it. Return 0, or -1 if memory runs out.
int head_cut_collar(struct head_mesh* mesh);

#endif
