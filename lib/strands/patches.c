// patches.c - drawing of patches by the tessellator.
#include "lib/strands/geometry.h"

// Return how many patches one draw may hold so that it generates no more vertices than the driver
// handles. Count every patch with the maximum number of isolines.
static uint32_t batch_size(const struct hair_geometry* geometry)
{
    uint32_t segments = geometry->look.strand.segments;
    if (segments > HAIR_MAX_ISOLINE_SEGMENTS) segments = HAIR_MAX_ISOLINE_SEGMENTS;
    uint32_t patches = geometry->gl->max_draw_vertices / (HAIR_MAX_ISOLINES * (segments + 1));
    return patches < 1 ? 1 : patches;
}

void hair_geometry_draw_patches(struct hair_geometry* geometry)
{
    struct hair_gl* gl = geometry->gl;
    uint32_t batch = batch_size(geometry);
    uint32_t parts =
        (geometry->look.strand.segments + HAIR_MAX_ISOLINE_SEGMENTS - 1) / HAIR_MAX_ISOLINE_SEGMENTS;
    parts *= (geometry->max_isolines + HAIR_MAX_ISOLINES - 1) / HAIR_MAX_ISOLINES;
    HAIR_ASSERT(batch > 0 && parts > 0);
    gl->PatchParameteri(GL_PATCH_VERTICES, 1);
    for (uint32_t first = 0; first < geometry->patches; first += batch) {
        uint32_t count = geometry->patches - first < batch ? geometry->patches - first : batch;
        gl->DrawArraysInstanced(GL_PATCHES, (GLint)first, (GLsizei)count, (GLsizei)parts);
    }
}
