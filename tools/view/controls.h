// controls.h - Mouse and keys outside of the panels.
#ifndef HAIR_TOOLS_VIEW_CONTROLS_H
#define HAIR_TOOLS_VIEW_CONTROLS_H

#include "tools/view/viewer.h"

// A line of the help about a mouse control.
struct view_mouse_help {
    const char *gesture, *about;
};
// Return the lines, which a line without a gesture ends.
const view_mouse_help* view_mouse_controls();

// Let an event change the document or the viewer.
void view_controls_event(viewer& viewer, const SDL_Event& event);

#endif
