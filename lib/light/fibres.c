// fibres.c - texture of the table in fibre.h.
#include "lib/light/lighting.h"

#include <string.h>

#define REFRACTION 1.55f // Index of refraction of keratin.

hair_result hair_lighting_ensure_fibres(struct hair_lighting* lighting, const hair_look* look)
{
    struct hair_fibres* fibres = &lighting->fibres;
    struct hair_gl* gl = lighting->gl;
    struct hair_fibre params = {look->shading.roughness[1], look->shading.roughness[0], REFRACTION,
                                look->flatness};
    if (fibres->texture && memcmp(&params, &fibres->params, sizeof params) == 0) return HAIR_OK;

    static const uint32_t size[3] = {HAIR_FIBRE_COLUMNS, HAIR_FIBRE_ROWS, HAIR_FIBRE_LAYERS};
    hair_vec4(*table)[HAIR_FIBRE_ROWS][HAIR_FIBRE_COLUMNS] =
        hair_alloc(&gl->host, HAIR_FIBRE_LAYERS, sizeof *table);
    if (!table) return hair_fail_memory(&gl->host, "the table of fibres");
    hair_result result = HAIR_OK;
    if (!fibres->texture)
        result = hair_gl_texture_3d(gl, HAIR_GL_CATEGORY_COLOR, "hair fibres", GL_RGBA32F, size, GL_LINEAR,
                                    &fibres->texture);
    if (!result) {
        hair_fibre_fill(&params, table);
        hair_gl_fill_texture_3d(gl, fibres->texture, size, table);
        fibres->params = params;
    }
    hair_free(&gl->host, table);
    return result;
}

void hair_lighting_free_fibres(struct hair_lighting* lighting)
{
    hair_gl_free_texture(lighting->gl, &lighting->fibres.texture);
}
