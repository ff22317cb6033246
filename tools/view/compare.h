// compare.h - The picture with earlier settings beside that with the present ones, with a wipe.
#ifndef HAIR_TOOLS_VIEW_COMPARE_H
#define HAIR_TOOLS_VIEW_COMPARE_H

#include "tools/view/viewer.h"

// Keep the present settings as those of the left side, or end the comparison.
void view_toggle_compare(viewer& viewer);
bool view_compares(const viewer& viewer);

// Draw the left side over the picture. Return an exit status.
int view_compare_draw(viewer& viewer, uint32_t width, uint32_t height, const view_quality& quality);

// Return whether a place of the window is on the line between the sides.
bool view_is_on_wipe(const viewer& viewer, float x, float y);
// Move the line to a place of the window.
void view_move_wipe(viewer& viewer, float x);

#endif
