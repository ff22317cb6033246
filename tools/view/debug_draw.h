// debug_draw.h - Pictures of the debug view, in place of the picture of the hair.
#ifndef HAIR_TOOLS_VIEW_DEBUG_DRAW_H
#define HAIR_TOOLS_VIEW_DEBUG_DRAW_H

#include "tools/view/viewer.h"

// Names of the modes for the panel, in the order of view_debug_mode. The last is followed by null.
const char* view_debug_name(int mode);
// Select a mode, or the next one.
void view_debug_select(viewer& viewer, int mode);
void view_debug_next(viewer& viewer);

// Draw the debug view over the darkened picture of `width` by `height` pixels. Return an exit
// status.
int view_debug_draw(viewer& viewer, uint32_t width, uint32_t height);
// Show the debug view in the window, with its legend.
void view_debug_show(const viewer& viewer);
// Free all objects of OpenGL.
void view_debug_close(view_debug& debug);

#endif
