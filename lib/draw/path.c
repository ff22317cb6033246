// path.c - by which path a view is drawn: the one that it asks for, the one that was measured to be the fastest on this
// driver, or the only one that makes what it wants.
#include "lib/draw/draw.h"

#include <string.h>

#define MOST_EXPANDED 4194304u // vertices, of 24 bytes: beyond, memory is dearer than time

static const struct {
    const char* renderer; // is in its name
    uint8_t
        path[5]; // of ribbons, of lines; then with levels of detail; of what has no colour and none of those
} fastest[] = {
#define FASTEST(renderer, ribbons, lines, lod_ribbons, lod_lines, depth)                                     \
    {renderer,                                                                                               \
     {HAIR_PATH_##ribbons, HAIR_PATH_##lines, HAIR_PATH_##lod_ribbons, HAIR_PATH_##lod_lines,                \
      HAIR_PATH_##depth}},
#include "lib/draw/paths.inl"
#undef FASTEST
};

void hair_draw_find_fastest(struct hair_draw* draw)
{
    const char* renderer = (const char*)draw->gl->GetString(GL_RENDERER);
    draw->driver         = 0;
    while (*fastest[draw->driver].renderer && !(renderer && strstr(renderer, fastest[draw->driver].renderer)))
        ++draw->driver;
}

int hair_draw_is_shared(const hair_view* view)
{
    return view->pass == HAIR_PASS_COLOR && view->coverage == HAIR_COVERAGE_SHARES;
}

int hair_draw_covers(const hair_view* view)
{
    return view->pass == HAIR_PASS_OPACITY || hair_draw_is_shared(view);
}

static int is_of_lines(const hair_view* view)
{
    return view->primitive == HAIR_LINES && !hair_draw_covers(view);
}

static hair_path find_fastest_for(const struct hair_draw* draw, const hair_view* view)
{
    int column = view->lod || view->pass == HAIR_PASS_COLOR ? is_of_lines(view) + 2 * (view->lod != NULL) : 4;
    hair_path path     = fastest[draw->driver].path[column];
    uint64_t  vertices = (uint64_t)draw->followers * (draw->look.segments + 1);
    return path == HAIR_PATH_EXPANDED && vertices > MOST_EXPANDED ? HAIR_PATH_TESSELLATION : path;
}

// Levels of detail leave out most vertices, and want others. Velocities are those of vertices that are kept, and sorted are
// segments between such.
hair_path hair_draw_path(const struct hair_draw* draw, const hair_view* view)
{
    if (view->pass == HAIR_PASS_MOTION || hair_draw_is_shared(view)) return HAIR_PATH_EXPANDED;
    hair_path path = view->path == HAIR_PATH_AUTO ? find_fastest_for(draw, view) : view->path;
    return path == HAIR_PATH_EXPANDED && view->lod ? HAIR_PATH_INSTANCED : path;
}
