// batch.c - rasterisation of the heads of a batch by one dispatch per pass, and one draw.
#include "lib/draw/batch.h"

#include "lib/draw/draw.h"
#include "lib/draw/params.h"

#define MAX_VERTICES 100000u // Vertices of a head from which on its own passes take little time.

bool hair_batch_is_possible(struct hair_gl* gl)
{
    GLint function = GL_ALWAYS, blocks = 0;
    GLboolean writes = GL_FALSE;
    gl->GetIntegerv(GL_MAX_VERTEX_SHADER_STORAGE_BLOCKS, &blocks);
    gl->GetIntegerv(GL_DEPTH_FUNC, &function);
    gl->GetBooleanv(GL_DEPTH_WRITEMASK, &writes);
    bool is_ordered =
        function == GL_LESS || function == GL_LEQUAL || function == GL_GREATER || function == GL_GEQUAL;
    return blocks > 0 && writes && is_ordered && gl->IsEnabled(GL_DEPTH_TEST) && !gl->IsEnabled(GL_BLEND) &&
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
    const struct hair_batch_head* last = batch->heads ? &batch->head[batch->heads - 1] : NULL;
    HAIR_ASSERT(batch->heads < HAIR_BATCH_HEADS && renderer->view_cache.place.blocks &&
                plan->raster.tiles > 0);
    const struct hair_batch_place place = renderer->view_cache.place;
    hair_mat4 view = hair_mat4_from_head(plan->view->view, plan->head);
    struct hair_batch_head own = {.raster = plan->raster,
                                  .eye = hair_draw_find_eye(&view, plan->view->projection),
                                  .segments = renderer->geometry->look.strand.segments,
                                  .first_vertex = hair_batch_first_vertex(place)};
    own.strands_at = own.first_vertex + hair_batch_count_vertices(place) - 1;
    if (last) {
        own.first_sample =
            last->first_sample + last->raster.columns * last->raster.rows * last->raster.samples;
        own.first_tile = last->first_tile + last->raster.tiles;
        own.raster_end = last->raster_end;
        own.compose_end = last->compose_end;
    }
    own.raster_end += hair_draw_raster_groups(renderer, plan->view, &own.raster);
    own.compose_end += own.raster.tiles;
    batch->head[batch->heads++] = own;
}

static hair_result ensure_buffers(struct hair_batch* batch, size_t samples, size_t tiles)
{
    struct hair_gl* gl = batch->gl;
    size_t size = HAIR_BATCH_HEADS * sizeof *batch->head;
    tiles += HAIR_BATCH_HEADS * HAIR_TILE_FIRST;
    if (!batch->params)
        HAIR_TRY(hair_gl_uniform(gl, HAIR_GL_NO_CATEGORY, "hair batch", size, &batch->params));
    if (tiles > batch->tile_room) hair_gl_free_buffer_texture(gl, &batch->tile_texture);
    HAIR_TRY(hair_draw_ensure_numbers(gl, HAIR_GL_NO_CATEGORY, "hair batch tiles", tiles, &batch->tile,
                                      &batch->tile_room));
    if (!batch->tile_texture)
        HAIR_TRY(hair_gl_buffer_texture(gl, "hair batch tiles", GL_R32UI, batch->tile, &batch->tile_texture));
    return hair_draw_ensure_numbers(gl, HAIR_GL_NO_CATEGORY, "hair batch samples", 2 * samples,
                                    &batch->nearest, &batch->nearest_room);
}

static void run(struct hair_gl* gl, hair_gl_pass row, const struct hair_draw_plan* plan, uint64_t groups)
{
    hair_gl_run(gl, hair_gl_add_features(row, plan->features), (uint32_t)groups);
}

static void rasterise(struct hair_batch* batch, const struct hair_draw_plan* plan, size_t samples)
{
    struct hair_gl* gl = batch->gl;
    const struct hair_batch_head* last = &batch->head[batch->heads - 1];
    const GLuint buffers[] = {batch->nearest, batch->tile},
                 vertices[] = {batch->vertices[0], batch->vertices[1]};
    size_t size = batch->heads * sizeof *batch->head;
    hair_gl_bind_buffers(gl, GL_SHADER_STORAGE_BUFFER, HAIR_BIND_NEAREST, 2, buffers);
    hair_gl_bind_buffers(gl, GL_SHADER_STORAGE_BUFFER, HAIR_BIND_BATCH, 1, &batch->params);
    hair_gl_bind_buffers(gl, GL_SHADER_STORAGE_BUFFER, HAIR_BIND_RIBBON_POSITION, 2, vertices);
    hair_gl_write_uniform(gl, batch->params, size, batch->head);
    run(gl, HAIR_GL_RASTER_CLEAR, plan,
        (2 * samples / 4 + HAIR_GROUP_SIZE) / HAIR_GROUP_SIZE + HAIR_TILE_FIRST);
    run(gl, HAIR_GL_RASTER, plan, last->raster_end);
    if (!gl->long_atomics) {
        for (uint32_t i = 0; i < batch->heads; ++i) batch->head[i].raster.claims = 1;
        hair_gl_write_uniform(gl, batch->params, size, batch->head);
        run(gl, HAIR_GL_RASTER, plan, last->raster_end);
    }
    run(gl, HAIR_GL_COMPOSE_TILES, plan, last->compose_end);
}

static void resolve_batch(struct hair_batch* batch, const struct hair_draw_plan* plan)
{
    struct hair_gl* gl = batch->gl;
    struct hair_outputs outputs;
    gl->BindVertexArray(gl->vertex_array);
    gl->Disable(GL_CULL_FACE);
    hair_gl_begin(gl, plan->draw);
    hair_gl_bind_texture(gl, HAIR_UNIT_TILE, batch->tile_texture);
    hair_gl_bind_texture(gl, HAIR_UNIT_SHADED, batch->shaded_texture);
    hair_draw_begin_outputs(gl, hair_draw_find_outputs(gl, plan), &outputs);
    hair_draw_issue_tiles(gl, batch->tile, batch->heads);
    hair_draw_end_outputs(gl, &outputs);
    hair_gl_end(gl, plan->draw);
}

hair_result hair_batch_draw(struct hair_batch* batch, const struct hair_draw_plan* plan)
{
    if (!batch->heads) return HAIR_OK;
    const struct hair_batch_head* last = &batch->head[batch->heads - 1];
    size_t samples =
        (size_t)last->first_sample + (size_t)last->raster.columns * last->raster.rows * last->raster.samples;
    for (uint32_t i = 0; i < batch->heads; ++i) {
        batch->head[i].heads = batch->heads;
        batch->head[i].samples = (hair_uint)samples;
    }
    hair_result result = ensure_buffers(batch, samples, last->first_tile + last->raster.tiles);
    if (!result) {
        rasterise(batch, plan, samples);
        resolve_batch(batch, plan);
    }
    batch->heads = 0;
    return result;
}
