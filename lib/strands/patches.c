// patches.c - drawing of patches by the tessellator.
#include "lib/strands/geometry.h"

// Return how many patches one draw may hold so that it generates no more vertices than the driver
// handles, and a GPU takes little time. Count every patch with the maximum number of isolines.
static uint32_t batch_size(const struct hair_geometry* geometry, uint32_t parts)
{
    const struct hair_gl* gl = geometry->gl;
    uint32_t segments = geometry->look.strand.segments;
    if (segments > HAIR_MAX_ISOLINE_SEGMENTS) segments = HAIR_MAX_ISOLINE_SEGMENTS;
    uint32_t each = HAIR_MAX_ISOLINES * (segments + 1);
    uint64_t by_driver = gl->max_draw_vertices / each, by_time = gl->draw_vertices / ((uint64_t)each * parts);
    uint64_t patches = by_driver < by_time ? by_driver : by_time;
    return patches < 1 ? 1 : (uint32_t)patches;
}

void hair_geometry_draw_patches(struct hair_geometry* geometry)
{
    struct hair_gl* gl = geometry->gl;
    uint32_t parts =
        (geometry->look.strand.segments + HAIR_MAX_ISOLINE_SEGMENTS - 1) / HAIR_MAX_ISOLINE_SEGMENTS;
    parts *= (geometry->max_isolines + HAIR_MAX_ISOLINES - 1) / HAIR_MAX_ISOLINES;
    HAIR_ASSERT(parts > 0);
    uint32_t batch = batch_size(geometry, parts);
    gl->PatchParameteri(GL_PATCH_VERTICES, 1);
    for (uint32_t first = 0; first < geometry->patches; first += batch) {
        uint32_t count = geometry->patches - first < batch ? geometry->patches - first : batch;
        gl->DrawArraysInstanced(GL_PATCHES, (GLint)first, (GLsizei)count, (GLsizei)parts);
    }
}
