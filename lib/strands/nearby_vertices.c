// nearby_vertices.c - vertices of the patches that a shape may cut. The GPU computes a box around
// each patch, so that a cut of one lock does not read all hair.
#include "lib/strands/nearby_vertices.h"

static hair_result run_patch_bounds(struct hair_geometry* geometry, GLuint bounds)
{
    struct hair_gl* gl = geometry->gl;
    struct hair_draw_params params;
    GLuint buffers[] = {geometry->vertex_cache.position, bounds};
    HAIR_TRY(hair_gl_ensure_program(gl, HAIR_GL_PATCH_BOUNDS));
    hair_geometry_write_params(geometry, &params);
    hair_gl_write_uniform(gl, geometry->params, sizeof params, &params);
    hair_geometry_bind(geometry);
    hair_gl_bind_buffers(gl, GL_SHADER_STORAGE_BUFFER, HAIR_BIND_CACHED_POSITION, 2, buffers);
    hair_gl_run(gl, HAIR_GL_PATCH_BOUNDS, geometry->patches);
    hair_gl_bind_buffers(gl, GL_SHADER_STORAGE_BUFFER, HAIR_BIND_CACHED_POSITION, 2, NULL);
    return HAIR_OK;
}

// Read the boxes of all patches. `boxes` has two corners per patch.
static hair_result read_patch_bounds(struct hair_geometry* geometry, hair_vec4* boxes)
{
    struct hair_gl* gl = geometry->gl;
    size_t size = 2 * sizeof *boxes * geometry->patches;
    GLuint bounds = 0;
    HAIR_TRY(hair_gl_undefined_storage(gl, HAIR_GL_CATEGORY_EXPAND, "hair bounds of patches", size, &bounds));
    hair_result result = run_patch_bounds(geometry, bounds);
    if (!result) hair_gl_read(gl, bounds, size, boxes);
    hair_gl_free_buffer(gl, &bounds);
    return result;
}

// Find the patches that the shape reaches. Neighbours share a part. Return the number of parts.
static uint32_t find_nearby_parts(const struct hair_geometry* geometry, const struct hair_groom* groom,
                                  const struct hair_cutter* cutter, const hair_vec4* boxes, size_t* first,
                                  struct hair_gl_part* parts)
{
    size_t each = geometry->look.strand.segments + 1, vertices = 0, end = SIZE_MAX;
    uint32_t count = 0;
    for (uint32_t i = 0; i < geometry->patches; ++i) {
        const struct hair_patch* patch = &groom->patches[i];
        size_t from = patch->first * each * sizeof *boxes, size = patch->count * each * sizeof *boxes;
        first[i] = SIZE_MAX;
        if (!hair_cutter_reaches(cutter, hair_load3(&boxes[2 * (size_t)i].x),
                                 hair_load3(&boxes[2 * (size_t)i + 1].x)))
            continue;
        first[i] = vertices;
        vertices += patch->count * each;
        if (from != end) parts[count++] = (struct hair_gl_part){.from = from};
        parts[count - 1].size += size;
        end = from + size;
    }
    return count;
}

static hair_result read_nearby_parts(struct hair_geometry* geometry, const struct hair_gl_part* parts,
                                     uint32_t count, hair_vec4** out)
{
    struct hair_gl* gl = geometry->gl;
    size_t size = 0;
    for (uint32_t i = 0; i < count; ++i) size += parts[i].size;
    if (!size) return HAIR_OK;
    *out = hair_alloc(&gl->host, 1, size);
    if (!*out) return hair_fail_memory(&gl->host, "the followers to read");
    hair_gl_read_parts(gl, geometry->vertex_cache.position, parts, count, *out);
    return HAIR_OK;
}

static hair_result read_nearby(struct hair_geometry* geometry, const struct hair_groom* groom,
                               const struct hair_cutter* cutter, hair_vec4* boxes, struct hair_gl_part* parts,
                               struct hair_nearby_vertices* out)
{
    HAIR_TRY(hair_geometry_ensure_vertex_cache(geometry, NULL));
    HAIR_TRY(read_patch_bounds(geometry, boxes));
    uint32_t count = find_nearby_parts(geometry, groom, cutter, boxes, out->first, parts);
    return read_nearby_parts(geometry, parts, count, &out->vertices);
}

hair_result hair_geometry_read_nearby(struct hair_geometry* geometry, const struct hair_groom* groom,
                                      const struct hair_cutter* cutter, struct hair_nearby_vertices* out)
{
    const hair_host* host = &geometry->gl->host;
    uint32_t patches = geometry->patches;
    bool kept = geometry->vertex_cache.vertices > 0;
    HAIR_ASSERT(groom->info.patch_count == patches && !out->vertices && !out->first);
    hair_vec4* boxes = hair_alloc(host, patches, 2 * sizeof *boxes);
    struct hair_gl_part* parts = hair_alloc(host, patches, sizeof *parts);
    out->first = hair_alloc(host, patches, sizeof *out->first);
    hair_result result =
        boxes && parts && out->first ? HAIR_OK : hair_fail_memory(host, "the followers to read");
    if (!result) result = read_nearby(geometry, groom, cutter, boxes, parts, out);
    // Keep the memory only if drawing uses it.
    if (!kept) hair_geometry_free_vertex_cache(geometry);
    hair_free(host, parts);
    hair_free(host, boxes);
    return result;
}
