// smooth.h - guides smoothed into buffers that every draw reads.
#ifndef HAIR_STRANDS_SMOOTH_H
#define HAIR_STRANDS_SMOOTH_H

#include "lib/gl/commands.h"
#include "lib/sim/sim.h"

struct hair_smooth {
    struct hair_gl* gl;
    GLuint buffer[2]; // Position and frame.
    GLuint texture[2]; // Their buffer textures, for stages without storage buffers.
    GLuint tangent; // Buffer of tangents. 0 unless the application has asked for tangents.
    uint32_t tangent_run; // Run to which the tangents belong.
    GLuint guide_shape; // Buffer of guides at rest. 0 unless followers have shapes of their own.
    uint32_t vertices; // Total number of vertices.
    uint32_t runs; // Number of runs so far.
    int done; // Nonzero if the guides have not moved since the last run.
};

hair_result hair_smooth_create(struct hair_smooth* smooth, struct hair_gl* gl, const struct hair_groom* groom,
                               const struct hair_sim* sim);
void hair_smooth_destroy(struct hair_smooth* smooth);

// Smooth the guides as the last step left them. This reads the step buffer.
void hair_smooth_run(struct hair_smooth* smooth, struct hair_sim* sim);
// Smooth the guides if they have moved since the last run, so that guides are smoothed only if
// drawn or read.
void hair_smooth_ensure(struct hair_smooth* smooth, struct hair_sim* sim);
// Compute the tangents of the last run, unless that is done. This reads the step buffer.
hair_result hair_smooth_ensure_tangents(struct hair_smooth* smooth, const struct hair_sim* sim);
void hair_smooth_free_tangents(struct hair_smooth* smooth);
// Record that the guides have moved.
void hair_smooth_invalidate(struct hair_smooth* smooth);

#endif
