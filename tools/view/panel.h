// panel.h - The panels of the window.
#ifndef HAIR_TOOLS_VIEW_PANEL_H
#define HAIR_TOOLS_VIEW_PANEL_H

#include "tools/view/viewer.h"

// Show all panels of a frame, and set viewer.picture to what they leave of the window.
void view_panels(viewer& viewer);

// Show over the picture what a newcomer does not find in the panels.
void view_hint(const viewer& viewer);

#endif
