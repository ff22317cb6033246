// hidden.h - patches that are behind what the host has drawn. Only while a view has a texture of depth.
#ifndef HAIR_DRAW_HIDDEN_H
#define HAIR_DRAW_HIDDEN_H

#include "lib/gl/gl.h"

struct hair_hidden {
    GLuint params, depth, box; // buffers, as in shared.h; 0 until they are needed
    size_t room; // for numbers of the second
};

// pyramid.c: how many levels there are above so many texels, and how many texels they have together; the farthest depth of
// what is bound as `params` say, made.
uint32_t hair_pyramid_levels(uint32_t columns, uint32_t rows);
size_t hair_pyramid_texels(uint32_t columns, uint32_t rows);
void hair_pyramid_run(struct hair_gl* gl, GLuint uniform, struct hair_hide_params* params);

#endif
