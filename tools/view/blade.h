// blade.h - A blade that the mouse draws across the picture.
#ifndef HAIR_TOOLS_VIEW_BLADE_H
#define HAIR_TOOLS_VIEW_BLADE_H

#include "tools/view/viewer.h"

// Draw the line of the blade while the mouse draws it.
void view_blade_draw(const viewer& viewer);

// Cut all hair that is behind the line from viewer.blade to a place of the window.
void view_blade_cut(viewer& viewer, float x, float y);

#endif
