// cutter.h - shapes that cut hair, and the places where strands first meet them.
#ifndef HAIR_COLLIDE_CUTTER_H
#define HAIR_COLLIDE_CUTTER_H

#include "lib/base/math.h"

#include <stdbool.h>

#include <hair/hair_cut.h>

// A shape of hair_cut_desc. Its positions are from an origin near the strands, m.
struct hair_cutter {
    hair_cut_shape shape;
    hair_vec3 start, end, last_start, last_end;
    hair_vec3 normal; // A unit vector.
    float radius;
};

// Return a shape with its positions from `origin`.
struct hair_cutter hair_cutter_from(const hair_cut_desc* desc, const double origin[3]);
// Return whether the segment from `a` to `b` meets the shape. `t` receives the first place, from 0
// at `a` to 1 at `b`.
bool hair_cutter_meets(const struct hair_cutter* cutter, hair_vec3 a, hair_vec3 b, float* t);
// Return whether the shape may meet a segment in a box. It may also return true for a shape close
// to the box.
bool hair_cutter_reaches(const struct hair_cutter* cutter, hair_vec3 lower, hair_vec3 upper);

#endif
