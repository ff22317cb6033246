// head_shape.h - the bust as a distance, made of blended parts.
#ifndef TOOLS_COMMON_HEAD_SHAPE_H
#define TOOLS_COMMON_HEAD_SHAPE_H

#include "tools/common/head.h"

struct head_point {
    float x, y, z;
};

// Lowest height of the bust, where it is cut. m.
#define HEAD_BOTTOM 1.25f

// Distance to the skin or garment, negative inside; near the truth within a few centimetres. m.
float head_distance(struct head_point p);

// How far p is below the collar of the garment. m.
float head_below_collar(struct head_point p);

// Linear reflectance of the skin or of the garment at p.
void head_color(struct head_point p, int is_worn, float rgb[3]);

// Cut a mesh along the collar and colour it. Returns 0, or -1 when memory ran out.
int head_cut_collar(struct head_mesh* mesh);

#endif
