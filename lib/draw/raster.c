// raster.c - compute rasterisation of segments, composited tile by tile into the framebuffer. It is
// fast on GPUs with few raster units, and for strands so thin that triangle setup dominates.
#include "lib/draw/batch.h"
#include "lib/draw/draw.h"
#include "lib/draw/params.h"

#include <math.h>
#include <string.h>

#define MANY_SEGMENTS 1000000u // Segments that keep a GPU busy with two threads each.
// Numbers of a head are a multiple of this. Parts of buffers begin at multiples of 256 bytes.
#define ALIGNED 64u
#define BESIDE 2.0f // Pixels of margin around those that hair covers.

// Find the positions of the samples in a pixel, or of one in `divisor` samples.
static void find_samples(const struct hair_gl_draw_state* state, uint32_t divisor,
                         struct hair_raster_params* out)
{
    static const GLfloat middle[2] = {0.5f, 0.5f};
    out->samples = state->multisamples ? state->samples : 1;
    if (divisor > 1) out->samples = out->samples > divisor ? out->samples / divisor : 1;
    memcpy(out->at, out->samples > 1 ? state->sample[0] : middle,
           out->samples > 1 ? sizeof state->sample : sizeof middle);
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

// Return about how many segments a view draws, each strand with all of its segments.
static uint64_t estimate_segments(const struct hair_renderer* renderer, const hair_view* view)
{
    double fraction = hair_draw_estimate_fraction(renderer, view->lod);
    double strands = fmax(ceil(fraction * (double)renderer->geometry->followers), 1);
    return (uint64_t)strands * renderer->geometry->look.strand.segments;
}

// Return the threads of a segment. A GPU is busy with many segments, and with the lines of few.
static uint32_t split_segments(uint64_t segments)
{
    return segments < MANY_SEGMENTS ? 4 : segments < 4 * MANY_SEGMENTS ? 2 : 1;
}

// Return the bits that the numbers of vertices leave in 32 bits.
static uint32_t find_fraction_bits(size_t vertices)
{
    uint32_t bits = 0;
    while (bits < 31 && vertices <= UINT32_MAX >> (bits + 1)) ++bits;
    HAIR_ASSERT(bits > 0); // The limits of followers and segments leave some.
    return bits;
}

bool hair_draw_find_depth_test(struct hair_gl* gl, struct hair_depth_test* out)
{
    GLint framebuffer = 0, type = GL_NONE, name = 0, level = 0, base = 0;
    const GLenum function = gl->draw_state.depth_function;
    memset(out, 0, sizeof *out);
    if (gl->draw_state.samples > 1) return false;
    if (!gl->draw_state.tests_depth || function == GL_ALWAYS) return true;
    gl->GetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &framebuffer);
    const float direction = hair_draw_depth_direction(gl);
    if (!framebuffer || direction == 0) return false;
    gl->GetFramebufferAttachmentParameteriv(GL_DRAW_FRAMEBUFFER, GL_DEPTH_ATTACHMENT,
                                            GL_FRAMEBUFFER_ATTACHMENT_OBJECT_TYPE, &type);
    if (type == GL_NONE) return true;
    if (type != GL_TEXTURE) return false;
    gl->GetFramebufferAttachmentParameteriv(GL_DRAW_FRAMEBUFFER, GL_DEPTH_ATTACHMENT,
                                            GL_FRAMEBUFFER_ATTACHMENT_OBJECT_NAME, &name);
    gl->GetFramebufferAttachmentParameteriv(GL_DRAW_FRAMEBUFFER, GL_DEPTH_ATTACHMENT,
                                            GL_FRAMEBUFFER_ATTACHMENT_TEXTURE_LEVEL, &level);
    if (hair_gl_find_texture_target(gl, (GLuint)name) != GL_TEXTURE_2D) return false;
    gl->GetTextureParameteriv((GLuint)name, GL_TEXTURE_BASE_LEVEL, &base);
    out->depth = (GLuint)name;
    out->tests = direction > 0 ? HAIR_TEST_NEARER : HAIR_TEST_FARTHER;
    if (function == GL_LEQUAL || function == GL_GEQUAL) out->tests |= HAIR_TEST_EQUAL;
    return level == 0 && base == 0;
}

bool hair_draw_find_raster(const struct hair_renderer* renderer, const struct hair_pose* head,
                           struct hair_draw_plan* plan)
{
    const struct hair_gl* gl = renderer->gl;
    const struct hair_gl_draw_state* state = &gl->draw_state;
    struct hair_raster_params* out = &plan->raster;
    const GLfloat *viewport = state->viewport, *range = state->depth_range;
    float unit[16], matrix[16], window[4];
    memset(out, 0, sizeof *out);
    hair_draw_clip_to_unit_matrix(gl, unit);
    find_place(renderer, head, plan->view, unit, matrix, window);
    out->columns = find_pixels(viewport[0], viewport[2], window[0], window[2], &out->first_x);
    out->rows = find_pixels(viewport[1], viewport[3], window[1], window[3], &out->first_y);
    if (!out->columns || !out->rows) return false;
    write_pixels(viewport, unit, matrix, out);
    out->depth_from = range[0];
    out->depth_by = range[1] - range[0];
    out->clamps = state->clamps_depth;
    out->encode = (hair_uint)plan->view->encode;
    out->flips = hair_draw_depth_direction(gl) * out->depth_by < 0 ? UINT32_MAX : 0;
    out->across = (out->columns + HAIR_RASTER_TILE - 1) / HAIR_RASTER_TILE;
    out->tiles = out->across * ((out->rows + HAIR_RASTER_TILE - 1) / HAIR_RASTER_TILE);
    out->tests = plan->depth_test.tests;
    out->fraction_bits = find_fraction_bits(hair_geometry_count_vertices(renderer->geometry));
    find_samples(state, renderer->sample_divisor, out);
    return true;
}

size_t hair_draw_count_numbers(const struct hair_draw_plan* plan)
{
    const struct hair_raster_params* params = &plan->raster;
    uint32_t each = plan->draw & HAIR_GL_WITH(DEPTH) ? 1 : 2;
    if (!plan->is_computed || plan->is_empty || plan->is_of_batch) return 0;
    return ((size_t)params->columns * params->rows * params->samples * each + ALIGNED - 1) / ALIGNED *
           ALIGNED;
}

hair_result hair_draw_ensure_raster(struct hair_renderer* renderer, struct hair_draw_plan* plan)
{
    const struct hair_raster_params* params = &plan->raster;
    struct hair_gl* gl = renderer->gl;
    if (params->samples > HAIR_RASTER_SAMPLES)
        return hair_fail(&gl->host, HAIR_ERROR_OPENGL,
                         "HAIR_RENDER_PATH_COMPUTE draws into pixels of up to %d samples, not of %u",
                         HAIR_RASTER_SAMPLES, params->samples);
    struct hair_samples* samples = &renderer->batch->samples;
    if (!renderer->raster.params) ++samples->users;
    hair_result result = hair_raster_ensure(gl, HAIR_GL_CATEGORY_COLOR, sizeof *params,
                                            params->tiles + HAIR_TILE_FIRST, &renderer->raster);
    if (!renderer->raster.params) hair_batch_leave_samples(renderer->batch);
    return result ? result : hair_samples_ensure(gl, hair_draw_count_numbers(plan), samples);
}

void hair_draw_free_raster(struct hair_renderer* renderer)
{
    if (!renderer->raster.params) return;
    hair_raster_free(renderer->gl, &renderer->raster);
    hair_batch_leave_samples(renderer->batch);
}

static uint32_t groups_for(uint64_t threads)
{
    return (uint32_t)((threads + HAIR_GROUP_SIZE - 1) / HAIR_GROUP_SIZE);
}

uint32_t hair_draw_raster_groups(const struct hair_renderer* renderer, const hair_view* view,
                                 struct hair_raster_params* params)
{
    uint64_t segments = estimate_segments(renderer, view);
    params->split = split_segments(segments);
    return groups_for(segments * params->split);
}

void hair_draw_run(struct hair_gl* gl, hair_gl_pass row, const struct hair_draw_plan* plan, uint32_t groups)
{
    hair_gl_run(gl, hair_gl_add_features(row, plan->features), groups);
}

// Bind the vertices of ribbons, which are those of the view or of the vertex cache.
static void bind_ribbons(struct hair_renderer* renderer, const struct hair_draw_plan* plan)
{
    const struct hair_vertex_cache* cache = &renderer->geometry->vertex_cache;
    const GLuint cached[] = {cache->position, cache->tangent};
    bool is_of_view = plan->vertices == HAIR_VERTICES_PER_VIEW;
    hair_gl_bind_buffers(renderer->gl, GL_SHADER_STORAGE_BUFFER, HAIR_BIND_RIBBON_POSITION, 2,
                         is_of_view ? renderer->view_cache.buffer : cached);
}

void hair_draw_rasterise(struct hair_renderer* renderer, const struct hair_draw_plan* plan, size_t first)
{
    struct hair_raster_params params = plan->raster;
    struct hair_gl* gl = renderer->gl;
    const struct hair_samples* samples = &renderer->batch->samples;
    const struct hair_raster* raster = &renderer->raster;
    const GLuint buffers[] = {raster->tile, renderer->strand_list.strand};
    size_t numbers = hair_draw_count_numbers(plan);
    if (!numbers) return;
    HAIR_ASSERT(samples->room >= first + numbers && first % ALIGNED == 0);
    HAIR_ASSERT(raster->tile_room >= params.tiles + HAIR_TILE_FIRST);
    const GLintptr at = (GLintptr)(first * sizeof(uint32_t));
    const GLsizeiptr size = (GLsizeiptr)(numbers * sizeof(uint32_t));
    uint32_t groups = hair_draw_raster_groups(renderer, plan->view, &params);
    hair_gl_bind_texture(gl, HAIR_UNIT_TILE, raster->tile_texture);
    if (plan->depth_test.depth) {
        hair_gl_bind_texture(gl, HAIR_UNIT_OCCLUSION, plan->depth_test.depth);
        hair_gl_bind_sampler(gl, HAIR_UNIT_OCCLUSION, gl->shadow_sampler[0]);
    }
    hair_gl_bind_buffers(gl, GL_UNIFORM_BUFFER, HAIR_BIND_RASTER, 1, &raster->params);
    hair_gl_bind_ranges(gl, GL_SHADER_STORAGE_BUFFER, HAIR_BIND_NEAREST, 1, &samples->nearest, &at, &size);
    hair_gl_bind_buffers(gl, GL_SHADER_STORAGE_BUFFER, HAIR_BIND_NEAREST + 1, 2, buffers);
    bind_ribbons(renderer, plan);
    hair_gl_bind_buffers(gl, GL_SHADER_STORAGE_BUFFER, HAIR_BIND_COMMAND, 1, &renderer->strand_list.command);
    hair_gl_barrier(gl, GL_SHADER_STORAGE_BARRIER_BIT); // The last draw may still read.
    hair_gl_write_uniform(gl, raster->params, sizeof params, &params);
    hair_draw_run(gl, HAIR_GL_RASTER_CLEAR, plan,
                  (uint32_t)((numbers + 4 * HAIR_CLEARED_BY_GROUP - 1) / (4 * HAIR_CLEARED_BY_GROUP)));
    hair_draw_run(gl, HAIR_GL_RASTER, plan, groups);
    if (!(plan->draw & HAIR_GL_WITH(DEPTH)) && !gl->long_atomics) {
        params.claims = 1;
        hair_gl_write_uniform(gl, raster->params, sizeof params, &params);
        hair_draw_run(gl, HAIR_GL_RASTER, plan, groups);
    }
    hair_draw_run(gl, HAIR_GL_COMPOSE_TILES, plan, params.tiles);
}

void hair_draw_issue_tiles(struct hair_gl* gl, GLuint commands, uint32_t count)
{
    GLint mode[2] = {GL_FILL, GL_FILL};
    gl->GetIntegerv(GL_POLYGON_MODE, mode);
    if (mode[0] != GL_FILL) gl->PolygonMode(GL_FRONT_AND_BACK, GL_FILL);
    gl->BindBuffer(GL_DRAW_INDIRECT_BUFFER, commands);
    gl->MultiDrawArraysIndirect(GL_TRIANGLES, NULL, (GLsizei)count, 0);
    if (mode[0] != GL_FILL) gl->PolygonMode(GL_FRONT_AND_BACK, (GLenum)mode[0]);
}

void hair_draw_resolve_tiles(struct hair_renderer* renderer, const struct hair_draw_plan* plan)
{
    struct hair_gl* gl = renderer->gl;
    HAIR_ASSERT(plan->raster.tiles > 0);
    // Opacity has been tested against depth before.
    bool tests_depth = plan->blending && gl->draw_state.tests_depth;
    if (tests_depth) gl->Disable(GL_DEPTH_TEST);
    hair_draw_issue_tiles(gl, renderer->raster.tile, 1);
    if (tests_depth) gl->Enable(GL_DEPTH_TEST);
}
