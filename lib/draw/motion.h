// motion.h - what velocities need of the frame before: where vertices were, and the head. Only while they are asked for.
#ifndef HAIR_DRAW_MOTION_H
#define HAIR_DRAW_MOTION_H

#include "lib/base/math.h"
#include "lib/base/pose.h"
#include "lib/gl/gl.h"

// Where positions from the head's origin were in the world: turned, since a teleport, and moved.
struct hair_was {
    double position[3];
    hair_quat turn;
};

struct hair_motion {
    GLuint buffer, texture; // vertices of the frame before; 0 until they are needed
    uint32_t frame; // that was drawn last
    uint32_t shown; // hair_expanded.writes then; 0: none was
    int still; // vertices are where they were in the frame before
    struct hair_was last, before; // frame
};

#endif
