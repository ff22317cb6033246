// strip.h - The strip below the picture: time and memory of each stage, and the errors of picture
// and motion.
#ifndef HAIR_TOOLS_VIEW_STRIP_H
#define HAIR_TOOLS_VIEW_STRIP_H

#include "tools/view/viewer.h"

// Read new values, at most every few frames.
void view_strip_update(viewer& viewer);

// Show the contents of the strip in the current window.
void view_strip(viewer& viewer);

#endif
