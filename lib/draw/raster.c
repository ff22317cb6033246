// raster.c - compute rasterisation of segments, composited tile by tile into the framebuffer. It is
// fast on GPUs with few raster units, and for strands so thin that triangle setup dominates.
#include "lib/draw/draw.h"
#include "lib/draw/params.h"

#include <string.h>

// Features of compute rasterisation. DEPTH selects depth without colour, and WIDENED per-view
// vertices.
#define FEATURES (HAIR_GL_WITH(DEPTH) | HAIR_GL_WITH(WIDENED))
#define BESIDE 2.0f // Pixels of margin around those that hair covers.

// Find the positions of the samples in a pixel.
static void find_samples(struct hair_gl* gl, struct hair_raster_params* out)
{
    GLint samples = 0;
    GLfloat at[2] = {0.5f, 0.5f};
    gl->GetIntegerv(GL_SAMPLES, &samples);
    out->samples = samples > 1 && gl->IsEnabled(GL_MULTISAMPLE) ? (uint32_t)samples : 1;
    for (uint32_t i = 0; i < out->samples && i < HAIR_RASTER_SAMPLES; ++i) {
        if (out->samples > 1) gl->GetMultisamplefv(GL_SAMPLE_POSITION, i, at);
        memcpy((float*)out->at + 2 * i, at, sizeof at);
    }
}

// Return the number of pixels along one axis of the viewport that hair can cover. Set *first to the
// first of them in the window.
static uint32_t find_pixels(float origin, float size, float lower, float upper, uint32_t* first)
{
    float to = fminf(ceilf(origin + upper * size + BESIDE), ceilf(origin + size));
    float from = fmaxf(floorf(origin + lower * size - BESIDE), floorf(origin));
    from = fmaxf(fminf(from, to), 0); // The window begins at 0.
    *first = (uint32_t)from;
    return to > from ? (uint32_t)(to - from) : 0;
}

// Compute the matrix from the head's origin to the viewport, in the coordinates of
// hair_draw_clip_to_unit_matrix(). Set `window` to the lower and the upper corner of the part that
// hair can cover.
static void find_place(const struct hair_renderer* renderer, const struct hair_pose* head,
                       const hair_view* view, const float unit[16], float matrix[16], float window[4])
{
    hair_mat4 own = hair_mat4_from_head(view->view, head), to_viewport;
    float projection[16], placed[16], clip[16];
    hair_draw_project(renderer, view, projection);
    memcpy(placed, &own, sizeof placed);
    hair_mat4_multiply(projection, placed, clip);
    hair_mat4_multiply(unit, clip, matrix);
    memcpy(&to_viewport, matrix, sizeof to_viewport);
    window[0] = window[1] = 0;
    window[2] = window[3] = 1;
    if (renderer->has_attached_roots) hair_draw_find_window(renderer, head, view->lod, &to_viewport, window);
}

// Write the clip-space part that the pixels cover, and the matrix from the head's origin to them.
static void write_pixels(const float viewport[4], const float unit[16], float matrix[16],
                         struct hair_raster_params* out)
{
    const float first[2] = {(float)out->first_x, (float)out->first_y};
    const float count[2] = {(float)out->columns, (float)out->rows};
    float* part = &out->part.x;
    for (int k = 0; k < 2; ++k) {
        float from = (first[k] - viewport[k]) / viewport[2 + k], to = from + count[k] / viewport[2 + k];
        part[k] = (from - unit[12 + k]) / unit[5 * k];
        part[2 + k] = (to - unit[12 + k]) / unit[5 * k];
        for (int i = k; i < 16; i += 4)
            matrix[i] = matrix[i] * viewport[2 + k] + matrix[i - k + 3] * (viewport[k] - first[k]);
    }
    memcpy(&out->to_window, matrix, sizeof out->to_window);
}

bool hair_draw_find_raster(const struct hair_renderer* renderer, const struct hair_pose* head,
                           const hair_view* view, struct hair_raster_params* out)
{
    struct hair_gl* gl = renderer->gl;
    GLfloat viewport[4] = {0}, range[2] = {0, 1};
    float unit[16], matrix[16], window[4];
    memset(out, 0, sizeof *out);
    gl->GetFloati_v(GL_VIEWPORT, 0, viewport);
    gl->GetFloatv(GL_DEPTH_RANGE, range);
    hair_draw_clip_to_unit_matrix(gl, unit);
    find_place(renderer, head, view, unit, matrix, window);
    out->columns = find_pixels(viewport[0], viewport[2], window[0], window[2], &out->first_x);
    out->rows = find_pixels(viewport[1], viewport[3], window[1], window[3], &out->first_y);
    if (!out->columns || !out->rows) return false;
    write_pixels(viewport, unit, matrix, out);
    out->depth_from = range[0];
    out->depth_by = range[1] - range[0];
    out->clamps = gl->IsEnabled(GL_DEPTH_CLAMP);
    out->flips = hair_draw_depth_direction(gl) * out->depth_by < 0 ? UINT32_MAX : 0;
    out->across = (out->columns + HAIR_RASTER_TILE - 1) / HAIR_RASTER_TILE;
    out->tiles = out->across * ((out->rows + HAIR_RASTER_TILE - 1) / HAIR_RASTER_TILE);
    find_samples(gl, out);
    return true;
}

// Make a buffer that holds `count` numbers. Leave some slack, so that hair that comes nearer does
// not reallocate the buffer each time.
static hair_result ensure_room(struct hair_gl* gl, const char* label, size_t count, GLuint* buffer,
                               size_t* room)
{
    if (count <= *room) return HAIR_OK;
    count = (count + count / 2 + 3) / 4 * 4;
    hair_gl_free_buffer(gl, buffer);
    *room = 0;
    hair_result result =
        hair_gl_storage(gl, HAIR_GL_CATEGORY_COLOR, label, count * sizeof(uint32_t), NULL, buffer);
    if (!result) *room = count;
    return result;
}

static hair_result ensure_tiles(struct hair_gl* gl, struct hair_raster* raster, size_t tiles)
{
    if (tiles <= raster->tile_room) return HAIR_OK;
    hair_gl_free_buffer_texture(gl, &raster->tile_texture);
    hair_result result = ensure_room(gl, "hair tiles", tiles, &raster->tile, &raster->tile_room);
    if (!result)
        result = hair_gl_buffer_texture(gl, "hair tiles", GL_R32UI, raster->tile, &raster->tile_texture);
    if (result) raster->tile_room = 0;
    return result;
}

// Return how many numbers the samples take. A depth pass has one per sample.
static size_t count_numbers(const struct hair_raster_params* params, hair_gl_pass with)
{
    return (size_t)params->columns * params->rows * params->samples * (with & HAIR_GL_WITH(DEPTH) ? 1 : 2);
}

hair_result hair_draw_ensure_raster(struct hair_renderer* renderer, struct hair_draw_plan* plan)
{
    const struct hair_raster_params* params = &plan->raster;
    struct hair_gl* gl = renderer->gl;
    struct hair_raster* raster = &renderer->raster;
    hair_result result = HAIR_OK;
    if (params->samples > HAIR_RASTER_SAMPLES)
        return hair_fail(&gl->host, HAIR_ERROR_OPENGL,
                         "HAIR_RENDER_PATH_COMPUTE draws into pixels of up to %d samples, not of %u",
                         HAIR_RASTER_SAMPLES, params->samples);
    if (!raster->params)
        result = hair_gl_uniform(gl, HAIR_GL_CATEGORY_COLOR, "hair raster", sizeof *params, &raster->params);
    if (!result) result = ensure_tiles(gl, raster, params->tiles);
    if (result) return result;
    return ensure_room(gl, "hair nearest", count_numbers(params, plan->draw), &raster->nearest,
                       &raster->room);
}

void hair_draw_free_raster(struct hair_renderer* renderer)
{
    struct hair_raster* raster = &renderer->raster;
    hair_gl_free_buffer(renderer->gl, &raster->params);
    hair_gl_free_buffer(renderer->gl, &raster->nearest);
    hair_gl_free_array(renderer->gl, &raster->tile, &raster->tile_texture);
    raster->room = raster->tile_room = 0;
}

static uint32_t groups_for(uint64_t threads)
{
    return (uint32_t)((threads + HAIR_GROUP_SIZE - 1) / HAIR_GROUP_SIZE);
}

void hair_draw_rasterise(struct hair_renderer* renderer, struct hair_draw_plan* plan)
{
    const hair_gl_pass with = plan->draw & FEATURES;
    struct hair_raster_params* params = &plan->raster;
    struct hair_gl* gl = renderer->gl;
    struct hair_raster* raster = &renderer->raster;
    GLuint buffers[] = {raster->nearest, raster->tile};
    HAIR_ASSERT(raster->room >= count_numbers(params, with) && raster->tile_room >= params->tiles);
    uint64_t segments = (uint64_t)renderer->geometry->followers * renderer->geometry->look.strand.segments;
    uint32_t groups = (uint32_t)((segments + HAIR_RASTER_SEGMENTS - 1) / HAIR_RASTER_SEGMENTS);
    uint64_t fours = (count_numbers(params, with) + 3) / 4;
    gl->BindTextureUnit(HAIR_UNIT_STRAND, renderer->strand_list.strand_texture);
    gl->BindTextureUnit(HAIR_UNIT_TILE, raster->tile_texture);
    gl->BindBuffersBase(GL_UNIFORM_BUFFER, HAIR_BIND_RASTER, 1, &raster->params);
    gl->BindBuffersBase(GL_SHADER_STORAGE_BUFFER, HAIR_BIND_NEAREST, 2, buffers);
    gl->BindBuffersBase(GL_SHADER_STORAGE_BUFFER, HAIR_BIND_COMMAND, 1, &renderer->strand_list.command);
    hair_gl_write_uniform(gl, raster->params, sizeof *params, params);
    hair_gl_run(gl, hair_gl_add_features(HAIR_GL_RASTER_CLEAR, with),
                groups_for(fours > params->tiles ? fours : params->tiles));
    hair_gl_run(gl, HAIR_GL_RASTER | with, groups);
    if (with & HAIR_GL_WITH(DEPTH) || gl->long_atomics) return;
    params->claims = 1;
    hair_gl_write_uniform(gl, raster->params, sizeof *params, params);
    hair_gl_run(gl, HAIR_GL_RASTER | with, groups);
}

void hair_draw_resolve_tiles(struct hair_renderer* renderer, const struct hair_draw_plan* plan)
{
    struct hair_gl* gl = renderer->gl;
    HAIR_ASSERT(plan->raster.tiles > 0);
    GLint mode[2] = {GL_FILL, GL_FILL};
    gl->GetIntegerv(GL_POLYGON_MODE, mode);
    if (mode[0] != GL_FILL) gl->PolygonMode(GL_FRONT_AND_BACK, GL_FILL);
    gl->DrawArrays(GL_TRIANGLES, 0, (GLsizei)(6 * plan->raster.tiles));
    if (mode[0] != GL_FILL) gl->PolygonMode(GL_FRONT_AND_BACK, (GLenum)mode[0]);
}
