// tessellated.c - drawing of patches by the tessellator.
#include "lib/draw/draw.h"

// Return how many patches one draw may hold so that it generates no more vertices than the driver
// handles. Count every patch with the maximum number of isolines.
static uint32_t batch_size(const struct hair_draw* draw)
{
    uint32_t segments = draw->look.segments;
    if (segments > HAIR_MAX_ISOLINE_SEGMENTS) segments = HAIR_MAX_ISOLINE_SEGMENTS;
    uint32_t patches = draw->gl->max_draw_vertices / (HAIR_MAX_ISOLINES * (segments + 1));
    return patches < 1 ? 1 : patches;
}

void hair_draw_patches(struct hair_draw* draw)
{
    struct hair_gl* gl = draw->gl;
    uint32_t batch = batch_size(draw);
    uint32_t parts = (draw->look.segments + HAIR_MAX_ISOLINE_SEGMENTS - 1) / HAIR_MAX_ISOLINE_SEGMENTS;
    parts *= (draw->max_isolines + HAIR_MAX_ISOLINES - 1) / HAIR_MAX_ISOLINES;
    HAIR_ASSERT(batch > 0 && parts > 0);
    gl->PatchParameteri(GL_PATCH_VERTICES, 1);
    for (uint32_t first = 0; first < draw->patches; first += batch) {
        uint32_t count = draw->patches - first < batch ? draw->patches - first : batch;
        gl->DrawArraysInstanced(GL_PATCHES, (GLint)first, (GLsizei)count, (GLsizei)parts);
    }
}
