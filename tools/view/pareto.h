// pareto.h - Time against visible error of several settings for the present picture.
#ifndef HAIR_TOOLS_VIEW_PARETO_H
#define HAIR_TOOLS_VIEW_PARETO_H

#include "tools/view/viewer.h"

// Show the window, and measure all settings. The time pauses meanwhile.
void view_pareto_begin(viewer& viewer);

// Measure the next setting, if a measurement is under way. Return an exit status.
int view_pareto_update(viewer& viewer, uint32_t width, uint32_t height);

// Show the window with the plot.
void view_pareto_window(viewer& viewer);

#endif
