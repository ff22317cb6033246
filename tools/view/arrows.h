// arrows.h - Arrows of light and wind over the picture.
#ifndef HAIR_TOOLS_VIEW_ARROWS_H
#define HAIR_TOOLS_VIEW_ARROWS_H

#include "tools/view/viewer.h"

// Draw the arrows of what the mouse turns, and that of the wind.
void view_arrows(const viewer& viewer);

// Compute the place of a point of the world in the window. Return false if it is behind the camera.
bool view_project(const viewer& viewer, const float point[3], ImVec2& out);

#endif
