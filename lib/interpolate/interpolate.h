// interpolate.h - guides smoothed into buffers that everything that draws reads, and followers read back.
#ifndef HAIR_INTERPOLATE_INTERPOLATE_H
#define HAIR_INTERPOLATE_INTERPOLATE_H

#include "lib/gl/gl.h"
#include "lib/sim/sim.h"

struct hair_smooth {
    struct hair_gl* gl;
    GLuint buffer[3]; // position, tangent, frame
    GLuint texture[3]; // the same, for stages that are promised no storage buffers
    hair_gl_pass pass; // the size of smooth.comp that the longest guide needs
    uint32_t vertices; // in all
    uint32_t runs; // so far
    int done; // since the guides were last moved
};

hair_result hair_smooth_create(struct hair_smooth* smooth, struct hair_gl* gl, const struct hair_sim* sim);
void hair_smooth_destroy(struct hair_smooth* smooth);

// Smooth the guides as the last step left them; reads the step buffer. `need`: unless that is done. Who moves the guides
// sets `done` to 0: only what is drawn or read needs to be smoothed.
void hair_smooth_run(struct hair_smooth* smooth, struct hair_sim* sim);
void hair_smooth_need(struct hair_smooth* smooth, struct hair_sim* sim);

#endif
