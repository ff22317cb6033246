// gizmo.h - Handles of colliders: arrows that move them along an axis, and rings that turn them.
#ifndef HAIR_TOOLS_VIEW_GIZMO_H
#define HAIR_TOOLS_VIEW_GIZMO_H

#include "tools/view/viewer.h"

// Return a collider of the scene as it is in the world now.
hair_collider view_collider_now(const viewer& viewer, const hair_scene_collider& from);

// Move a collider of the scene by a way in the world, m.
void view_move_collider(const viewer& viewer, hair_scene_collider& collider, const float by[3]);

// Return the handle at a place of the window. Its collider is -1 if there is none.
view_handle view_find_handle(const viewer& viewer, float x, float y);

// Pull viewer.handle from viewer.mouse to a place of the window.
void view_pull_handle(viewer& viewer, float x, float y);

// Tell scripts the places of the handles, as "Arrow 0 x" and "Ring 0 x".
void view_mark_handles(viewer& viewer);

// Draw the handles if colliders are shown.
void view_draw_handles(const viewer& viewer);

#endif
