// grab.h - Hair and colliders that the mouse holds.
#ifndef HAIR_TOOLS_VIEW_GRAB_H
#define HAIR_TOOLS_VIEW_GRAB_H

#include "tools/view/viewer.h"

// Take the collider or the strand at a place of the window. Return VIEW_DRAG_HAIR or
// VIEW_DRAG_COLLIDER, or VIEW_DRAG_NONE if there is neither.
view_drag view_grab(viewer& viewer, float x, float y);

// Move what is held by a fraction of the picture's height.
void view_grab_move(viewer& viewer, float x, float y);

// Let go.
void view_grab_end(viewer& viewer);

// Add a ball in front of the camera's target.
void view_add_ball(viewer& viewer);

#endif
