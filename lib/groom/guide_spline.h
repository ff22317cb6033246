// guide_spline.h - a guide at rest as it is drawn. The CPU version of smooth.comp and
// strands/follower.glsl.
#ifndef HAIR_GROOM_GUIDE_SPLINE_H
#define HAIR_GROOM_GUIDE_SPLINE_H

#include "lib/base/math.h"
#include "lib/groom/groom.h"

struct hair_guide_spline {
    hair_vec3 position[HAIR_MAX_SMOOTH_VERTICES];
    hair_vec3 tangent[HAIR_MAX_SMOOTH_VERTICES];
    hair_quat frame[HAIR_MAX_SMOOTH_VERTICES];
    uint32_t count;
    float length; // m
};

struct hair_guide_spline_point {
    hair_vec3 position, tangent;
    hair_quat frame;
};

void hair_guide_spline_fit(const struct hair_groom* groom, uint32_t guide, struct hair_guide_spline* out);

// Return the point at u, which runs from 0 at the root to 1 at the tip. Beyond 1 the guide is
// extended straight.
struct hair_guide_spline_point hair_guide_spline_at(const struct hair_guide_spline* spline, float u);

#endif
