// settings_panel.h - The panel of all settings, made from the table of the library's members.
#ifndef HAIR_TOOLS_VIEW_SETTINGS_PANEL_H
#define HAIR_TOOLS_VIEW_SETTINGS_PANEL_H

#include "tools/view/viewer.h"

// Show the contents of the panel in the current window.
void view_settings_panel(viewer& viewer);

#endif
