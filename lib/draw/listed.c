// listed.c - strands drawn without a tessellator. Compute shaders list the strands that patches
// draw. Each strand is drawn by the ends of its segments. The driver shades the end that two
// segments share only once.
#include "lib/draw/draw.h"

#include <string.h>

static hair_result make_lists(struct hair_draw* draw, int hides)
{
    struct hair_gl* gl = draw->gl;
    struct hair_listed* listed = &draw->listed;
    hair_result result = HAIR_OK;
    if (!listed->of) listed->of = hair_alloc(&gl->host, 1, sizeof *listed->of);
    if (!listed->of) return hair_fail_memory(&gl->host, "the list of strands");
    if (!listed->start)
        result =
            hair_gl_storage(gl, "hair strand starts", draw->patches * sizeof(uint32_t), NULL, &listed->start);
    if (!result && !listed->strand)
        result = hair_gl_storage(gl, "hair strands", draw->followers * sizeof(struct hair_strand), NULL,
                                 &listed->strand);
    if (!result && !listed->strand_texture)
        result =
            hair_gl_buffer_texture(gl, "hair strands", GL_RGBA32UI, listed->strand, &listed->strand_texture);
    if (!result && !listed->command)
        result = hair_gl_storage(gl, "hair commands", HAIR_COMMANDS * sizeof(struct hair_draw_command), NULL,
                                 &listed->command);
    return result ? result
                  : hair_gl_need_rows(gl, HAIR_GL_COUNT, HAIR_GL_LIST, hides ? HAIR_GL_WITH(HIDDEN) : 0);
}

// Return the indices of one instance of 64 strands for each segment count n, n/2, ... 1, from which
// count.comp selects. There are two per segment for lines, and six for ribbons of paired vertices.
// 16 bits suffice, because 64 strands of 256 segments have 16,448 vertices, or twice as many if
// paired.
static uint16_t* write_indices(const struct hair_gl* gl, uint32_t segments, int paired, size_t* count)
{
    static const uint32_t corners[2][HAIR_PAIRED_INDICES] = {{0, 1}, {0, 1, 2, 2, 1, 3}};
    uint32_t corner_count = paired ? HAIR_PAIRED_INDICES : 2, each_end = paired ? 2 : 1;
    size_t at = 0;
    *count = HAIR_INSTANCE_STRANDS;
    for (uint32_t each = segments; each > 1; each = (each + 1) / 2) *count += HAIR_INSTANCE_STRANDS * each;
    *count *= corner_count;
    uint16_t* indices = hair_alloc(&gl->host, *count, sizeof *indices);
    for (uint32_t each = segments; indices && each; each = each > 1 ? (each + 1) / 2 : 0)
        for (uint32_t strand = 0; strand < HAIR_INSTANCE_STRANDS; ++strand)
            for (uint32_t i = 0; i < each; ++i)
                for (uint32_t k = 0; k < corner_count; ++k)
                    indices[at++] = (uint16_t)((strand * (segments + 1) + i) * each_end + corners[paired][k]);
    HAIR_ASSERT(!indices || at == *count);
    HAIR_ASSERT(HAIR_INSTANCE_STRANDS * (segments + 1) * each_end <= 65536);
    return indices;
}

hair_result hair_draw_make_indices(struct hair_draw* draw, int paired)
{
    struct hair_gl* gl = draw->gl;
    HAIR_ASSERT(paired == 0 || paired == 1);
    struct hair_listed_indices* own = &draw->listed.indices[paired];
    uint32_t segments = draw->look.segments;
    if (own->segments == segments) return HAIR_OK;
    own->segments = 0;
    hair_gl_free_buffer(gl, &own->index);
    size_t count;
    uint16_t* indices = write_indices(gl, segments, paired, &count);
    if (!indices) return hair_fail_memory(&gl->host, "the segments of strands");
    hair_result result = hair_gl_buffer(gl, "hair segments", count * sizeof *indices, indices, &own->index);
    hair_free(&gl->host, indices);
    if (result) return result;
    if (!own->vertex_array) gl->CreateVertexArrays(1, &own->vertex_array);
    if (!own->vertex_array)
        return hair_fail(&gl->host, HAIR_ERROR_OPENGL, "the driver makes no vertex array for strands");
    gl->VertexArrayElementBuffer(own->vertex_array, own->index);
    own->segments = segments;
    return HAIR_OK;
}

hair_result hair_draw_make_listed(struct hair_draw* draw, int hides)
{
    draw->used[HAIR_DRAW_LISTED] = draw->frame;
    return make_lists(draw, hides);
}

void hair_draw_free_listed(struct hair_draw* draw)
{
    struct hair_listed* listed = &draw->listed;
    struct hair_gl* gl = draw->gl;
    for (int i = 0; i < 2; ++i) {
        struct hair_listed_indices* own = &listed->indices[i];
        if (own->vertex_array) gl->DeleteVertexArrays(1, &own->vertex_array);
        own->vertex_array = 0;
        own->segments = 0;
        hair_gl_free_buffer(gl, &own->index);
    }
    hair_gl_free_buffer_texture(gl, &listed->strand_texture);
    hair_free(&gl->host, listed->of);
    listed->of = NULL;
    hair_gl_free_buffer(gl, &listed->start);
    hair_gl_free_buffer(gl, &listed->strand);
    hair_gl_free_buffer(gl, &listed->command);
}

// Describe the inputs of a strand list. All views share a list if the level of detail does not
// depend on the view.
static struct hair_listing describe(const struct hair_gl* gl, const struct hair_smooth* smooth,
                                    const struct hair_draw_params* params)
{
    struct hair_listing of;
    memset(&of, 0, sizeof of);
    of.made = gl->made;
    if (params->pixels_per_unit > 0) {
        of.runs = smooth->runs;
        of.params = *params;
        return of;
    }
    of.params.density = params->density;
    of.params.segments = params->segments;
    of.params.map_weights = params->map_weights;
    of.params.strand_share = params->strand_share;
    of.params.segment_share = params->segment_share;
    of.params.width_power = params->width_power;
    return of;
}

void hair_draw_list(struct hair_draw* draw, const struct hair_smooth* smooth,
                    const struct hair_draw_params* params, int hides)
{
    struct hair_gl* gl = draw->gl;
    struct hair_listed* listed = &draw->listed;
    GLuint buffers[] = {listed->start, listed->strand, listed->command};
    HAIR_ASSERT(listed->of && listed->command);
    struct hair_listing of = describe(gl, smooth, params);
    hair_gl_pass with = hides ? HAIR_GL_WITH(HIDDEN) : 0;
    if (!hides && memcmp(&of, listed->of, sizeof of) == 0) return;
    gl->BindBuffersBase(GL_SHADER_STORAGE_BUFFER, HAIR_BIND_START, 3, buffers);
    hair_gl_run(gl, HAIR_GL_COUNT | with, 1);
    hair_gl_run(gl, HAIR_GL_LIST | with, draw->patches);
    if (hides) of.made = 0; // No other view has the same occluded patches.
    *listed->of = of;
}

void hair_draw_listed(struct hair_draw* draw, int paired)
{
    struct hair_gl* gl = draw->gl;
    const char* first =
        (const char*)NULL + (paired ? HAIR_PAIRED_COMMAND * sizeof(struct hair_draw_command) : 0);
    HAIR_ASSERT(draw->listed.indices[paired].segments == draw->look.segments);
    gl->BindTextureUnit(HAIR_UNIT_STRAND, draw->listed.strand_texture);
    gl->BindVertexArray(draw->listed.indices[paired].vertex_array);
    gl->BindBuffer(GL_DRAW_INDIRECT_BUFFER, draw->listed.command);
    gl->Disable(GL_PRIMITIVE_RESTART);
    gl->MultiDrawElementsIndirect(paired ? GL_TRIANGLES : GL_LINES, GL_UNSIGNED_SHORT, first, 2,
                                  sizeof(struct hair_draw_command));
}
