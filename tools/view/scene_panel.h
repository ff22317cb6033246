// scene_panel.h - The panel of files, presets and actions.
#ifndef HAIR_TOOLS_VIEW_SCENE_PANEL_H
#define HAIR_TOOLS_VIEW_SCENE_PANEL_H

#include "tools/view/viewer.h"

// Show the contents of the panel in the current window.
void view_scene_panel(viewer& viewer);

#endif
