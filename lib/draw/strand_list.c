// strand_list.c - strands drawn without a tessellator. Compute shaders list the strands that
// patches draw. Each strand is drawn by the ends of its segments. The driver shades the end that
// two segments share only once.
#include "lib/draw/draw.h"
#include "lib/draw/params.h"

#include <string.h>

#define SPARE 2 // A list is made anew once many views in sequence need less than this part of it.
#define GROWTH 8 // A list has room for this part more strands than a view needs.

// Return the instances of all strands, if the last may have fewer strands.
static uint32_t count_instances(uint32_t strands)
{
    return (strands + HAIR_INSTANCE_STRANDS - 1) / HAIR_INSTANCE_STRANDS;
}

uint32_t hair_draw_instances_at_once(const struct hair_renderer* renderer)
{
    const struct hair_geometry* geometry = renderer->geometry;
    uint32_t all = count_instances(geometry->followers);
    uint64_t vertices = 2 * (uint64_t)HAIR_INSTANCE_STRANDS * (geometry->look.strand.segments + 1);
    // The first vertex of a later draw must be a number of 32 bits.
    if (all * vertices > UINT32_MAX || renderer->gl->draw_vertices / vertices >= all) return all;
    uint32_t instances = (uint32_t)(renderer->gl->draw_vertices / vertices);
    return instances < 1 ? 1 : instances;
}

// Return the number of strands that a list is to have room for. Room that there is stays, until
// many views in sequence need much less.
static uint32_t choose_room(struct hair_renderer* renderer, const struct hair_draw_plan* plan)
{
    struct hair_strand_list* own = &renderer->strand_list;
    const uint32_t all = renderer->geometry->followers;
    uint32_t max = hair_draw_max_strands(renderer, plan->head, plan->view);
    uint32_t room = max < all / SPARE ? max + max / GROWTH : all;
    bool is_spare = hair_gl_count_spare(&own->spare, own->strand && own->room / SPARE > room);
    return own->strand && own->room >= max && !is_spare ? own->room : room;
}

static hair_result make_lists(struct hair_renderer* renderer, const struct hair_draw_plan* plan)
{
    struct hair_gl* gl = renderer->gl;
    const struct hair_geometry* geometry = renderer->geometry;
    struct hair_strand_list* own = &renderer->strand_list;
    if (!own->key) own->key = hair_alloc(&gl->host, 1, sizeof *own->key);
    if (!own->key) return hair_fail_memory(&gl->host, "the list of strands");
    uint32_t room = choose_room(renderer, plan);
    if (room != own->room) {
        hair_gl_free_array(gl, &own->strand, &own->strand_texture);
        own->room = room;
        own->key->program_generation = 0; // There is no list.
    }
    hair_result result = hair_gl_ensure_array(gl, HAIR_GL_CATEGORY_COMPACT_STRANDS, "hair strand starts",
                                              geometry->patches * sizeof(uint32_t), &own->start, 0, NULL);
    if (!result)
        result = hair_gl_ensure_array(gl, HAIR_GL_CATEGORY_COMPACT_STRANDS, "hair strands",
                                      room * sizeof(struct hair_strand), &own->strand, GL_RGBA32UI,
                                      &own->strand_texture);
    // Draws of one instance each are the most.
    size_t commands = HAIR_LIST_COMMANDS + HAIR_LIST_KINDS * (size_t)count_instances(geometry->followers);
    if (!result)
        result = hair_gl_ensure_array(gl, HAIR_GL_CATEGORY_COMPACT_STRANDS, "hair commands",
                                      commands * sizeof(struct hair_draw_command), &own->command, 0, NULL);
    return result;
}

// Return the indices of one instance of 64 strands for each segment count n, n/2, ... 1, from which
// scan_strands.comp selects. There are two per segment for lines, and six for ribbons of paired
// vertices. 16 bits suffice, because 64 strands of 256 segments have 16,448 vertices, or twice as
// many if paired.
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

static hair_result ensure_indices(struct hair_renderer* renderer, int paired)
{
    struct hair_gl* gl = renderer->gl;
    HAIR_ASSERT(paired == 0 || paired == 1);
    struct hair_strand_list_indices* own = &renderer->strand_list.indices[paired];
    uint32_t segments = renderer->geometry->look.strand.segments;
    if (own->segments == segments) return HAIR_OK;
    own->segments = 0;
    hair_gl_free_buffer(gl, &own->index);
    size_t count;
    uint16_t* indices = write_indices(gl, segments, paired, &count);
    if (!indices) return hair_fail_memory(&gl->host, "the segments of strands");
    hair_result result = hair_gl_buffer(gl, HAIR_GL_CATEGORY_COMPACT_STRANDS, "hair segments",
                                        count * sizeof *indices, indices, &own->index);
    hair_free(&gl->host, indices);
    if (result) return result;
    if (!own->vertex_array) gl->CreateVertexArrays(1, &own->vertex_array);
    if (!own->vertex_array)
        return hair_fail(&gl->host, HAIR_ERROR_OPENGL, "the driver makes no vertex array for strands");
    gl->VertexArrayElementBuffer(own->vertex_array, own->index);
    own->segments = segments;
    return HAIR_OK;
}

hair_result hair_draw_ensure_strand_list(struct hair_renderer* renderer, struct hair_draw_plan* plan)
{
    hair_result result = make_lists(renderer, plan);
    if (!result && !plan->is_computed) result = ensure_indices(renderer, plan->is_paired);
    return result;
}

void hair_draw_free_strand_list(struct hair_renderer* renderer)
{
    struct hair_strand_list* strand_list = &renderer->strand_list;
    struct hair_gl* gl = renderer->gl;
    for (int i = 0; i < 2; ++i) {
        struct hair_strand_list_indices* own = &strand_list->indices[i];
        if (own->vertex_array) gl->DeleteVertexArrays(1, &own->vertex_array);
        own->vertex_array = 0;
        own->segments = 0;
        hair_gl_free_buffer(gl, &own->index);
    }
    hair_gl_free_buffer_texture(gl, &strand_list->strand_texture);
    hair_free(&gl->host, strand_list->key);
    strand_list->key = NULL;
    hair_gl_free_buffer(gl, &strand_list->start);
    hair_gl_free_buffer(gl, &strand_list->strand);
    strand_list->room = strand_list->spare = 0;
    hair_gl_free_buffer(gl, &strand_list->command);
}

// Describe the inputs of a strand list. All views share a list if the level of detail does not
// depend on the view.
static struct hair_strand_list_key list_key(const struct hair_renderer* renderer,
                                            const struct hair_draw_params* params)
{
    struct hair_strand_list_key of;
    memset(&of, 0, sizeof of);
    of.program_generation = renderer->gl->program_generation;
    if (params->pixels_per_unit > 0) {
        of.runs = renderer->geometry->smooth.runs;
        of.params = *params;
        return of;
    }
    of.params.density = params->density;
    of.params.segments = params->segments;
    of.params.draw_instances = params->draw_instances;
    of.params.map_weights = params->map_weights;
    of.params.strand_fraction = params->strand_fraction;
    of.params.segment_fraction = params->segment_fraction;
    of.params.width_power = params->width_power;
    of.params.cache_fraction = params->cache_fraction;
    return of;
}

void hair_draw_update_strand_list(struct hair_renderer* renderer, const struct hair_draw_plan* plan,
                                  const struct hair_draw_params* params)
{
    struct hair_gl* gl = renderer->gl;
    struct hair_strand_list* strand_list = &renderer->strand_list;
    GLuint buffers[] = {strand_list->start, strand_list->strand, strand_list->command};
    HAIR_ASSERT(strand_list->key && strand_list->command);
    struct hair_strand_list_key of = list_key(renderer, params);
    hair_gl_pass with = plan->has_occlusion ? HAIR_GL_WITH(OCCLUSION) : 0;
    if (!plan->has_occlusion && memcmp(&of, strand_list->key, sizeof of) == 0) return;
    renderer->view_cache.is_complete = false;
    hair_gl_bind_buffers(gl, GL_SHADER_STORAGE_BUFFER, HAIR_BIND_START, 3, buffers);
    hair_gl_run(gl, HAIR_GL_SCAN_STRANDS | with, 1);
    hair_gl_run(gl, HAIR_GL_COMPACT_STRANDS | with, renderer->geometry->patches);
    // No other view has the same occluded patches.
    if (plan->has_occlusion) of.program_generation = 0;
    *strand_list->key = of;
}

static const void* find_command(size_t command)
{
    const uintptr_t at = command * sizeof(struct hair_draw_command);
    return (const void*)at;
}

void hair_draw_issue_commands(struct hair_renderer* renderer, const struct hair_draw_plan* plan,
                              uint32_t kind, GLenum mode, GLenum type)
{
    struct hair_gl* gl = renderer->gl;
    HAIR_ASSERT(kind < HAIR_LIST_KINDS);
    uint32_t instances = count_instances(hair_draw_max_strands(renderer, plan->head, plan->view));
    uint32_t each = hair_draw_instances_at_once(renderer), draws = (instances + each - 1) / each;
    gl->BindBuffer(GL_DRAW_INDIRECT_BUFFER, renderer->strand_list.command);
    gl->Disable(GL_PRIMITIVE_RESTART);
    for (uint32_t i = 0; i < draws; ++i)
        gl->MultiDrawElementsIndirect(
            mode, type, find_command(HAIR_LIST_COMMANDS + HAIR_LIST_KINDS * (size_t)i + kind), 1, 0);
}

void hair_draw_issue_strand_list(struct hair_renderer* renderer, const struct hair_draw_plan* plan)
{
    struct hair_gl* gl = renderer->gl;
    const struct hair_strand_list_indices* indices = &renderer->strand_list.indices[plan->is_paired];
    const GLenum mode = plan->is_paired ? GL_TRIANGLES : GL_LINES;
    HAIR_ASSERT(indices->segments == renderer->geometry->look.strand.segments);
    hair_gl_bind_texture(gl, HAIR_UNIT_STRAND, renderer->strand_list.strand_texture);
    gl->BindVertexArray(indices->vertex_array);
    hair_draw_issue_commands(renderer, plan, plan->is_paired ? HAIR_LIST_PAIRED : HAIR_LIST_LINES, mode,
                             GL_UNSIGNED_SHORT);
    gl->MultiDrawElementsIndirect(mode, GL_UNSIGNED_SHORT,
                                  find_command(plan->is_paired ? HAIR_PAIRED_COMMAND : 0), 1, 0);
}
