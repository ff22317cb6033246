// batch.c - rasterisation of the heads of a batch by one dispatch per pass, and one draw.
#include "lib/draw/batch.h"

#include "lib/draw/draw.h"
#include "lib/draw/params.h"

#define MAX_VERTICES 100000u // Vertices of a head from which on its own passes take little time.

bool hair_batch_is_possible(struct hair_gl* gl)
{
    GLint blocks = 0;
    GLboolean writes = GL_FALSE;
    gl->GetIntegerv(GL_MAX_VERTEX_SHADER_STORAGE_BLOCKS, &blocks);
    gl->GetBooleanv(GL_DEPTH_WRITEMASK, &writes);
    bool is_ordered = gl->draw_state.tests_depth && hair_draw_depth_direction(gl) != 0;
    return blocks > 0 && writes && is_ordered && !gl->IsEnabled(GL_BLEND) &&
           !gl->IsEnabled(GL_STENCIL_TEST) && !gl->IsEnabled(GL_COLOR_LOGIC_OP);
}

bool hair_batch_accepts(const struct hair_draw_plan* plan)
{
    return plan->is_computed && plan->vertices == HAIR_VERTICES_PER_VIEW && !plan->shader &&
           plan->view->pass == HAIR_PASS_COLOR && !plan->blending && !plan->has_motion_output;
}

bool hair_batch_join(struct hair_renderer* renderer, const struct hair_pose* head,
                     const struct hair_draw_plan* plan)
{
    struct hair_view_cache* cache = &renderer->view_cache;
    const struct hair_batch_place was = cache->place;
    uint64_t strands = hair_draw_max_strands(renderer, head, plan->view);
    uint64_t vertices = strands * (renderer->geometry->look.strand.segments + 1);
    HAIR_ASSERT(hair_batch_accepts(plan));
    bool joins = vertices <= MAX_VERTICES && hair_batch_take_place(renderer->batch, &cache->place, vertices);
    if (!joins || cache->place.first != was.first || cache->place.blocks != was.blocks)
        cache->is_complete &= !cache->is_in_place;
    return joins;
}

void hair_batch_add(struct hair_renderer* renderer, const struct hair_draw_plan* plan)
{
    struct hair_batch* batch = renderer->batch;
    const struct hair_batch_place place = renderer->view_cache.place;
    HAIR_ASSERT(batch->heads < HAIR_BATCH_HEADS && place.blocks && plan->raster.tiles > 0);
    hair_mat4 view = hair_mat4_from_head(plan->view->view, plan->head);
    struct hair_batch_head own = {.raster = plan->raster,
                                  .eye = hair_draw_find_eye(&view, plan->view->projection),
                                  .segments = renderer->geometry->look.strand.segments,
                                  .first_vertex = hair_batch_first_vertex(place)};
    own.strands_at = own.first_vertex + hair_batch_count_vertices(place) - 1;
    own.raster_end = hair_draw_raster_groups(renderer, plan->view, &own.raster);
    own.compose_end = own.raster.tiles;
    batch->head[batch->heads++] = own;
}

// Heads of a batch whose samples fit into one buffer.
struct part {
    struct hair_batch_head* head;
    uint32_t heads;
    size_t samples, tiles;
};

// Return the part that begins with a head, and has at least that head. Count what the heads before
// each head of the part take.
static struct part find_part(const struct hair_batch* batch, uint32_t first)
{
    struct part part = {.head = &batch->head[first]};
    for (uint32_t i = first; i < batch->heads; ++i) {
        struct hair_batch_head* own = &batch->head[i];
        size_t samples = (size_t)own->raster.columns * own->raster.rows * own->raster.samples;
        if (part.heads && 2 * (part.samples + samples) > batch->samples.max) break;
        own->first_sample = (hair_uint)part.samples;
        own->first_tile = (hair_uint)part.tiles;
        own->raster_end += part.heads ? own[-1].raster_end : 0;
        own->compose_end += part.heads ? own[-1].compose_end : 0;
        part.samples += samples;
        part.tiles += own->raster.tiles;
        ++part.heads;
    }
    for (uint32_t i = 0; i < part.heads; ++i) {
        part.head[i].heads = part.heads;
        part.head[i].samples = (hair_uint)part.samples;
    }
    return part;
}

static hair_result ensure_buffers(struct hair_batch* batch, const struct part* part)
{
    HAIR_TRY(hair_raster_ensure(batch->gl, HAIR_GL_NO_CATEGORY, HAIR_BATCH_HEADS * sizeof *batch->head,
                                part->tiles + HAIR_BATCH_HEADS * HAIR_TILE_FIRST, &batch->raster));
    return hair_samples_ensure(batch->gl, 2 * part->samples, &batch->samples);
}

static void rasterise_heads(struct hair_batch* batch, const struct hair_draw_plan* plan, struct part* part)
{
    struct hair_gl* gl = batch->gl;
    const struct hair_batch_head* last = &part->head[part->heads - 1];
    const GLuint buffers[] = {batch->samples.nearest, batch->raster.tile};
    size_t size = part->heads * sizeof *part->head;
    uint32_t numbers = (uint32_t)(2 * part->samples), heads = HAIR_BATCH_HEADS * HAIR_TILE_FIRST;
    uint32_t threads = (numbers + 3) / 4 > heads ? (numbers + 3) / 4 : heads;
    hair_gl_bind_buffers(gl, GL_SHADER_STORAGE_BUFFER, HAIR_BIND_NEAREST, 2, buffers);
    hair_gl_bind_buffers(gl, GL_SHADER_STORAGE_BUFFER, HAIR_BIND_BATCH, 1, &batch->raster.params);
    hair_gl_bind_buffers(gl, GL_SHADER_STORAGE_BUFFER, HAIR_BIND_RIBBON_POSITION, 2, batch->vertices);
    hair_gl_write_uniform(gl, batch->raster.params, size, part->head);
    hair_draw_run(gl, HAIR_GL_RASTER_CLEAR, plan,
                  (threads + HAIR_CLEARED_BY_GROUP - 1) / HAIR_CLEARED_BY_GROUP);
    hair_draw_run(gl, HAIR_GL_RASTER, plan, last->raster_end);
    if (!gl->long_atomics) {
        for (uint32_t i = 0; i < part->heads; ++i) part->head[i].raster.claims = 1;
        hair_gl_write_uniform(gl, batch->raster.params, size, part->head);
        hair_draw_run(gl, HAIR_GL_RASTER, plan, last->raster_end);
    }
    hair_draw_run(gl, HAIR_GL_COMPOSE_TILES, plan, last->compose_end);
}

static void resolve_heads(struct hair_batch* batch, const struct hair_draw_plan* plan, uint32_t heads)
{
    struct hair_gl* gl = batch->gl;
    struct hair_outputs outputs;
    gl->BindVertexArray(gl->vertex_array);
    gl->Disable(GL_CULL_FACE);
    hair_gl_begin(gl, plan->draw);
    hair_gl_bind_texture(gl, HAIR_UNIT_TILE, batch->raster.tile_texture);
    hair_gl_bind_texture(gl, HAIR_UNIT_SHADED, batch->shaded_texture);
    hair_draw_begin_outputs(gl, hair_draw_find_outputs(gl, plan), &outputs);
    hair_draw_issue_tiles(gl, batch->raster.tile, heads);
    hair_draw_end_outputs(gl, &outputs);
    hair_gl_end(gl, plan->draw);
}

hair_result hair_batch_draw(struct hair_batch* batch, const struct hair_draw_plan* plan)
{
    hair_result result = HAIR_OK;
    for (uint32_t first = 0; first < batch->heads && !result;) {
        struct part part = find_part(batch, first);
        hair_gl_barrier(batch->gl, GL_SHADER_STORAGE_BARRIER_BIT); // The last draw may still read.
        result = ensure_buffers(batch, &part);
        if (result) break;
        rasterise_heads(batch, plan, &part);
        resolve_heads(batch, plan, part.heads);
        first += part.heads;
    }
    batch->heads = 0;
    return result;
}
