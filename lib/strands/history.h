// history.h - vertices and head transform of the previous frame, for motion vectors. They take
// memory only on demand.
#ifndef HAIR_STRANDS_HISTORY_H
#define HAIR_STRANDS_HISTORY_H

#include "lib/base/math.h"
#include "lib/base/pose.h"
#include "lib/gl/commands.h"

// Transform from positions relative to the head's origin to the world in an earlier frame. `turn`
// is the rotation by teleports since then.
struct hair_history_pose {
    double position[3];
    hair_quat turn;
};

struct hair_vertex_history {
    GLuint buffer, texture; // Vertices of the previous frame. 0 until needed.
    uint32_t frame; // Number of the frame drawn last.
    // Value of hair_vertex_cache.writes or hair_smooth.runs in that frame. 0 if none was drawn.
    uint32_t shown;
    int still; // Nonzero if the vertices have not moved since the previous frame.
    // Transforms of the frame drawn last and of the frame before it.
    struct hair_history_pose last, before;
};

#endif
