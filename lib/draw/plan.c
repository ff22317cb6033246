// plan.c - the plan of a view. The render path is the requested path, or the fastest measured path
// of this driver. Two tables say what the view draws by that path.
#include "lib/draw/draw.h"

#include <math.h>
#include <string.h>

// Bytes of a vertex in the vertex cache, with 8 for its shading, and of a sample of compute
// rasterisation.
#define POSITION_BYTES 16u
#define VERTEX_BYTES 32u
#define SAMPLE_BYTES 8u

// Methods of drawing strands.
enum method { TESS, PROC, CACHE, VIEW, COMP, COMPV, METHODS };

static const struct {
    hair_render_path path;
    enum hair_vertex_source vertices;
    bool is_computed;
} methods[METHODS] = {
    [TESS] = {HAIR_RENDER_PATH_TESSELLATION, HAIR_VERTICES_TESSELLATED, false},
    [PROC] = {HAIR_RENDER_PATH_PROCEDURAL, HAIR_VERTICES_PROCEDURAL, false},
    [CACHE] = {HAIR_RENDER_PATH_CACHED, HAIR_VERTICES_CACHED, false},
    [VIEW] = {HAIR_RENDER_PATH_CACHED, HAIR_VERTICES_PER_VIEW, false},
    [COMP] = {HAIR_RENDER_PATH_COMPUTE, HAIR_VERTICES_CACHED, true},
    [COMPV] = {HAIR_RENDER_PATH_COMPUTE, HAIR_VERTICES_PER_VIEW, true},
};

// Kinds of views. The first three have colour or depth, and differ in the application's shader.
// COLOR_MOTION has colour and motion vectors, without a pixel shader.
enum kind { PLAIN, VERTEX_SHADER, PIXEL_SHADER, SORTED, OPACITY, IDS, MOTION, COLOR_MOTION, KINDS };

// The method of each kind of view by render path, without and with a level of detail.
//
// A level of detail leaves out many vertices of the vertex cache and places others differently, so
// it uses per-view vertices. They hold a position, a width and a colour. Other outputs need
// vertices that the vertex shader computes. Motion vectors compare vertices of the vertex cache,
// and sorted segments index them. Pixels by compute hold only colour, depth or opacity.
// Lines take the column `cached` in place of `compute`. HAIR_RENDER_PATH_PROCEDURAL has no column.
// Its vertices are procedural wherever they need not be those of the vertex cache.

// clang-format off
static const uint8_t method_of[KINDS][3][2] = {
    //                 tessellation    cached          compute
    [PLAIN]         = {{TESS,  TESS},  {CACHE, VIEW},  {COMP,  COMPV}},
    [VERTEX_SHADER] = {{TESS,  TESS},  {CACHE, PROC},  {COMP,  COMPV}},
    [PIXEL_SHADER]  = {{TESS,  TESS},  {CACHE, PROC},  {CACHE, PROC}},
    [SORTED]        = {{CACHE, CACHE}, {CACHE, CACHE}, {CACHE, CACHE}},
    [OPACITY]       = {{TESS,  TESS},  {CACHE, PROC},  {COMP,  COMPV}},
    [IDS]           = {{TESS,  TESS},  {CACHE, PROC},  {CACHE, PROC}},
    [MOTION]        = {{CACHE, CACHE}, {CACHE, CACHE}, {CACHE, CACHE}},
    [COLOR_MOTION]  = {{CACHE, CACHE}, {CACHE, CACHE}, {COMP,  CACHE}},
};
// clang-format on

// Return whether compute rasterisation has room for the samples of the viewport.
static bool has_few_samples(const struct hair_renderer* renderer)
{
    const struct hair_gl* gl = renderer->gl;
    const struct hair_gl_draw_state* state = &gl->draw_state;
    if (state->samples > HAIR_RASTER_SAMPLES) return false;
    double pixels = (double)state->viewport[2] * (double)state->viewport[3];
    double bytes = pixels * fmax(state->samples, 1) * SAMPLE_BYTES;
    double had = (double)renderer->batch->samples.room * sizeof(uint32_t);
    if (bytes <= had) return true;
    return bytes < 1e12 && hair_gl_fits(gl, (uint64_t)bytes, sizeof(uint32_t)) &&
           hair_gl_memory_allows(&gl->memory, (uint64_t)(bytes - had));
}

static enum kind find_kind(const hair_view* view, const struct hair_gl_shader* shader)
{
    switch (view->pass) {
    case HAIR_PASS_MOTION: return MOTION;
    case HAIR_PASS_OPACITY: return OPACITY;
    case HAIR_PASS_COLOR:
        if (view->coverage == HAIR_COVERAGE_ALPHA) return SORTED;
        if (view->motion_output) return shader && shader->pixels ? MOTION : COLOR_MOTION;
        break;
    case HAIR_PASS_DEPTH: break;
    default: return IDS;
    }
    if (!shader) return PLAIN;
    return shader->pixels ? PIXEL_SHADER : VERTEX_SHADER;
}

// Return the method by a render path. Compute rasterisation has no lines. Opacity is always of
// ribbons.
static enum method find_method(enum kind kind, const hair_view* view, hair_render_path path)
{
    if (path == HAIR_RENDER_PATH_COMPUTE && view->primitive == HAIR_PRIMITIVE_LINES && kind != OPACITY)
        path = HAIR_RENDER_PATH_CACHED;
    if (path == HAIR_RENDER_PATH_PROCEDURAL)
        return kind == SORTED || kind == MOTION || kind == COLOR_MOTION ? CACHE : PROC;
    HAIR_ASSERT((unsigned)path < sizeof method_of[0] / sizeof method_of[0][0]);
    return method_of[kind][path][view->lod != NULL];
}

// Return whether the vertices of all followers may be cached, within the limits of the driver and
// of memory. Vertices that are already cached may stay.
static bool can_cache(const struct hair_renderer* renderer)
{
    uint64_t vertices = hair_geometry_count_vertices(renderer->geometry);
    if (renderer->scarce_vertices && vertices >= renderer->scarce_vertices) return false;
    if (renderer->geometry->vertex_cache.vertices >= vertices) return true;
    return hair_gl_fits(renderer->gl, vertices * POSITION_BYTES, POSITION_BYTES) &&
           hair_gl_memory_allows(&renderer->gl->memory, vertices * VERTEX_BYTES);
}

// Return the render path that HAIR_RENDER_PATH_AUTO selects.
static hair_render_path find_fastest_for(const struct hair_renderer* renderer, enum kind kind,
                                         const hair_view* view)
{
    bool is_of_lines = view->primitive == HAIR_PRIMITIVE_LINES && !hair_draw_uses_analytic_coverage(view);
    enum hair_path_use use = is_of_lines ? HAIR_USE_LINES : HAIR_USE_RIBBONS;
    if (view->lod)
        use = is_of_lines ? HAIR_USE_LOD_LINES : HAIR_USE_LOD_RIBBONS;
    else if (view->pass != HAIR_PASS_COLOR)
        use = HAIR_USE_DEPTH;
    const uint8_t* paths = renderer->fastest->path;
    hair_render_path path = (hair_render_path)paths[use];
    if (path == HAIR_RENDER_PATH_COMPUTE &&
        !(methods[find_method(kind, view, path)].is_computed && has_few_samples(renderer)))
        path = view->pass == HAIR_PASS_COLOR ? HAIR_RENDER_PATH_CACHED : HAIR_RENDER_PATH_TESSELLATION;
    if (path == HAIR_RENDER_PATH_TESSELLATION || can_cache(renderer)) return path;
    return (hair_render_path)paths[HAIR_USE_UNCACHED];
}

bool hair_draw_avoid_cache(struct hair_renderer* renderer, const struct hair_draw_plan* plan)
{
    if (plan->view->render_path != HAIR_RENDER_PATH_AUTO || plan->vertices == HAIR_VERTICES_TESSELLATED ||
        plan->vertices == HAIR_VERTICES_PROCEDURAL)
        return false;
    renderer->scarce_vertices = hair_geometry_count_vertices(renderer->geometry);
    renderer->scarce_frame = renderer->frame;
    return renderer->scarce_vertices > 0;
}

bool hair_draw_uses_analytic_coverage(const hair_view* view)
{
    return view->pass == HAIR_PASS_OPACITY ||
           (view->pass == HAIR_PASS_COLOR && view->coverage == HAIR_COVERAGE_ALPHA);
}

bool hair_draw_has_motion(const hair_view* view)
{
    return view->pass == HAIR_PASS_MOTION || (view->pass == HAIR_PASS_COLOR && view->motion_output);
}

bool hair_draw_uses_occlusion(const hair_view* view)
{
    return view->occluder_depth && view->pass != HAIR_PASS_GUIDES;
}

void hair_draw_make_plan(const struct hair_renderer* renderer, const hair_view* view,
                         struct hair_gl_shader* shader, struct hair_draw_plan* out)
{
    const struct hair_geometry* geometry = renderer->geometry;
    bool is_colored = view->pass == HAIR_PASS_COLOR, has_uvs = hair_geometry_has_uvs(geometry);
    enum kind kind = find_kind(view, shader);
    hair_render_path path = view->render_path == HAIR_RENDER_PATH_AUTO
                                ? find_fastest_for(renderer, kind, view)
                                : view->render_path;
    struct hair_depth_test depth_test = {0};
    if (kind == OPACITY && path == HAIR_RENDER_PATH_COMPUTE &&
        !hair_draw_find_depth_test(renderer->gl, &depth_test))
        path = view->render_path == HAIR_RENDER_PATH_AUTO ? HAIR_RENDER_PATH_TESSELLATION
                                                          : HAIR_RENDER_PATH_CACHED;
    enum method method = find_method(kind, view, path);
    memset(out, 0, sizeof *out);
    out->view = view;
    out->shader = is_colored ? shader : NULL;
    out->depth_test = depth_test;
    out->path = methods[method].path;
    out->vertices = methods[method].vertices;
    out->is_computed = methods[method].is_computed;
    out->blending = kind == SORTED    ? HAIR_BLENDING_SORTED
                    : kind == OPACITY ? HAIR_BLENDING_UNSORTED
                                      : HAIR_BLENDING_NONE;
    out->is_paired =
        view->primitive == HAIR_PRIMITIVE_RIBBONS && !out->blending && out->path == HAIR_RENDER_PATH_CACHED;
    out->has_sides = method == VIEW;
    out->has_strand_list = method != TESS;
    out->is_textured = is_colored && view->color_texture && has_uvs;
    out->is_painted = is_colored && hair_lighting_has_strand_colors(renderer->lighting, &geometry->look);
    out->has_root_uvs = out->is_textured || (out->shader && has_uvs);
    out->has_motion_output = is_colored && view->motion_output;
    out->light_values = hair_lighting_value_count(&geometry->look, view);
    HAIR_ASSERT(out->path != HAIR_RENDER_PATH_AUTO && out->light_values <= 1 + HAIR_LIGHTS);
    // Pixels by compute are opaque or sums, and sorted segments index the vertex cache.
    HAIR_ASSERT(!out->is_computed || out->blending != HAIR_BLENDING_SORTED);
    HAIR_ASSERT(!out->is_computed || kind == OPACITY || view->primitive == HAIR_PRIMITIVE_RIBBONS);
    HAIR_ASSERT(out->blending != HAIR_BLENDING_SORTED || out->vertices == HAIR_VERTICES_CACHED);
    HAIR_ASSERT(!hair_draw_has_motion(view) || out->vertices == HAIR_VERTICES_CACHED);
}
