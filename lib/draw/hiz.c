// hiz.c - Hi-Z, the farthest depth of the application's geometry in texels of growing size. See
// glsl/draw/hiz.glsl.
#include "lib/draw/occlusion.h"

static uint32_t next(uint32_t texels)
{
    return (texels + HAIR_HIZ_NEXT - 1) / HAIR_HIZ_NEXT;
}

// Return the number of levels. A box is looked up in at most HAIR_HIZ_TEXELS texels along each
// axis, so a level of that size needs none above it.
uint32_t hair_hiz_levels(uint32_t columns, uint32_t rows)
{
    HAIR_ASSERT(columns > 0 && rows > 0);
    uint32_t levels = 1;
    for (; columns > HAIR_HIZ_TEXELS || rows > HAIR_HIZ_TEXELS; ++levels) {
        columns = next(columns);
        rows = next(rows);
    }
    return levels;
}

size_t hair_hiz_texels(uint32_t columns, uint32_t rows)
{
    size_t texels = 0;
    for (uint32_t levels = hair_hiz_levels(columns, rows); levels > 0; --levels) {
        texels += (size_t)columns * rows;
        columns = next(columns);
        rows = next(rows);
    }
    return texels;
}

void hair_hiz_run(struct hair_gl* gl, GLuint uniform, struct hair_occlusion_params* params)
{
    uint32_t columns = params->columns, rows = params->rows;
    HAIR_ASSERT(params->levels == hair_hiz_levels(columns, rows));
    for (params->level = 0; params->level < params->levels; ++params->level) {
        uint32_t groups = (uint32_t)(((size_t)columns * rows + HAIR_GROUP_SIZE - 1) / HAIR_GROUP_SIZE);
        hair_gl_write_uniform(gl, uniform, sizeof *params, params);
        hair_gl_run(gl, params->level ? HAIR_GL_HIZ_DOWNSAMPLE : HAIR_GL_HIZ_REDUCE_DEPTH, groups);
        columns = next(columns);
        rows = next(rows);
    }
}
