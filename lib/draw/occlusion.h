// occlusion.h - occlusion culling of patches. It takes memory only while a view has a depth
// texture.
#ifndef HAIR_DRAW_OCCLUSION_H
#define HAIR_DRAW_OCCLUSION_H

#include "lib/gl/commands.h"

struct hair_occlusion {
    GLuint params, depth, box; // Buffers, as in shared.h. 0 until needed.
    size_t room; // Capacity of `depth`, in texels.
};

// Return the number of Hi-Z levels for a first level of this size. Defined in hiz.c.
uint32_t hair_hiz_levels(uint32_t columns, uint32_t rows);
// Return the number of texels of all levels together.
size_t hair_hiz_texels(uint32_t columns, uint32_t rows);
// Build all levels, the farthest depths of the bound texture, as `params` describe.
void hair_hiz_run(struct hair_gl* gl, GLuint uniform, struct hair_occlusion_params* params);

#endif
