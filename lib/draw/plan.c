// plan.c - decisions about a view, such as its render path. The render path is the requested path,
// the fastest measured path of this driver, or the only one that supports the view.
#include "lib/draw/draw.h"
#include "lib/draw/params.h"

#include <math.h>
#include <string.h>

// Maximum vertices, of 24 bytes each. Beyond it, memory costs more than time.
#define MAX_CACHED 4194304u
#define MAX_SAMPLES 33554432.0 // Maximum samples of a viewport, of 8 bytes each.

static const struct {
    const char* renderer; // Part of the renderer's name.
    // Paths of ribbons and lines, then of both with level of detail, then of depth without it.
    uint8_t path[5];
} fastest[] = {
#define FASTEST(renderer, ribbons, lines, lod_ribbons, lod_lines, depth)                                     \
    {renderer,                                                                                               \
     {HAIR_RENDER_PATH_##ribbons, HAIR_RENDER_PATH_##lines, HAIR_RENDER_PATH_##lod_ribbons,                  \
      HAIR_RENDER_PATH_##lod_lines, HAIR_RENDER_PATH_##depth}},
#include "lib/draw/paths.inl"
#undef FASTEST
};

void hair_draw_find_fastest(struct hair_renderer* renderer)
{
    const char* name = (const char*)renderer->gl->GetString(GL_RENDERER);
    renderer->driver = 0;
    while (*fastest[renderer->driver].renderer && !(name && strstr(name, fastest[renderer->driver].renderer)))
        ++renderer->driver;
}

bool hair_draw_uses_alpha(const hair_view* view)
{
    return view->pass == HAIR_PASS_COLOR && view->coverage == HAIR_COVERAGE_ALPHA;
}

bool hair_draw_uses_analytic_coverage(const hair_view* view)
{
    return view->pass == HAIR_PASS_OPACITY || hair_draw_uses_alpha(view);
}

static bool is_of_lines(const hair_view* view)
{
    return view->primitive == HAIR_PRIMITIVE_LINES && !hair_draw_uses_analytic_coverage(view);
}

static bool has_few_samples(const struct hair_gl* gl)
{
    GLfloat viewport[4] = {0};
    GLint samples = 0;
    gl->GetFloati_v(GL_VIEWPORT, 0, viewport);
    gl->GetIntegerv(GL_SAMPLES, &samples);
    double max = (double)viewport[2] * (double)viewport[3] * fmax(samples, 1);
    return samples <= HAIR_RASTER_SAMPLES && max <= MAX_SAMPLES;
}

// Return whether compute rasterisation supports the view. Its pixels are opaque, and hold only
// colour or depth.
static bool is_computable(const hair_view* view)
{
    int shown = view->pass == HAIR_PASS_COLOR || view->pass == HAIR_PASS_DEPTH;
    return shown && view->primitive == HAIR_PRIMITIVE_RIBBONS;
}

static hair_render_path find_fastest_for(const struct hair_renderer* renderer, const hair_view* view)
{
    int column = view->lod || view->pass == HAIR_PASS_COLOR ? is_of_lines(view) + 2 * (view->lod != NULL) : 4;
    HAIR_ASSERT(0 <= column && column < 5 && renderer->driver < sizeof fastest / sizeof *fastest);
    hair_render_path path = fastest[renderer->driver].path[column];
    size_t vertices = hair_geometry_count_vertices(renderer->geometry);
    if ((path == HAIR_RENDER_PATH_CACHED || path == HAIR_RENDER_PATH_COMPUTE) && vertices > MAX_CACHED)
        return HAIR_RENDER_PATH_TESSELLATION;
    if (path != HAIR_RENDER_PATH_COMPUTE ||
        (is_computable(view) && !view->shader && has_few_samples(renderer->gl)))
        return path;
    return view->pass == HAIR_PASS_COLOR ? HAIR_RENDER_PATH_CACHED : HAIR_RENDER_PATH_TESSELLATION;
}

// Return whether the view needs the vertex cache. Motion vectors compare its vertices, and
// sorted segments index them.
static bool keeps_vertices(const hair_view* view)
{
    return view->pass == HAIR_PASS_MOTION || hair_draw_uses_alpha(view);
}

// A level of detail leaves out most vertices of the cache and places others differently, so it uses
// per-view vertices.
bool hair_draw_uses_view_cache(const hair_view* view)
{
    return view->lod && !keeps_vertices(view) &&
           (view->render_path == HAIR_RENDER_PATH_CACHED || view->render_path == HAIR_RENDER_PATH_COMPUTE);
}

bool hair_draw_uses_vertex_cache(const hair_view* view)
{
    return (view->render_path == HAIR_RENDER_PATH_CACHED || view->render_path == HAIR_RENDER_PATH_COMPUTE) &&
           !hair_draw_uses_view_cache(view);
}

bool hair_draw_caches_sides(const hair_view* view)
{
    return view->render_path == HAIR_RENDER_PATH_CACHED && hair_draw_uses_view_cache(view);
}

bool hair_draw_is_paired(const hair_view* view)
{
    return view->primitive == HAIR_PRIMITIVE_RIBBONS && !hair_draw_uses_analytic_coverage(view) &&
           view->render_path == HAIR_RENDER_PATH_CACHED;
}

// Return whether per-view vertices suffice. They hold a position, a width and a colour.
static bool is_view_cacheable(const hair_view* view)
{
    return (view->pass == HAIR_PASS_COLOR || view->pass == HAIR_PASS_DEPTH) && !view->shader;
}

hair_render_path hair_draw_path(const struct hair_renderer* renderer, const hair_view* view)
{
    if (keeps_vertices(view)) return HAIR_RENDER_PATH_CACHED;
    hair_render_path path =
        view->render_path == HAIR_RENDER_PATH_AUTO ? find_fastest_for(renderer, view) : view->render_path;
    if (path == HAIR_RENDER_PATH_COMPUTE && !is_computable(view)) path = HAIR_RENDER_PATH_CACHED;
    return path == HAIR_RENDER_PATH_CACHED && view->lod && !is_view_cacheable(view)
               ? HAIR_RENDER_PATH_INSTANCED
               : path;
}

bool hair_draw_is_shaded(const hair_view* view, const struct hair_gl_shader* shader)
{
    return view->pass == HAIR_PASS_COLOR && !view->lod && !(shader && shader->pixels) &&
           hair_draw_uses_vertex_cache(view);
}

bool hair_draw_uses_occlusion(const hair_view* view)
{
    return view->occluder_depth && view->pass != HAIR_PASS_GUIDES;
}
