// hair_actions.h - Actions that change the hair of the document: look, wind, detail and simulation.
#ifndef HAIR_TOOLS_VIEW_HAIR_ACTIONS_H
#define HAIR_TOOLS_VIEW_HAIR_ACTIONS_H

#include "tools/view/viewer.h"

void view_next_color(viewer& viewer);

// Shorter strands.
void view_toggle_short(viewer& viewer);
bool view_is_short(const viewer& viewer);
void view_toggle_curly(viewer& viewer);
bool view_is_curly(const viewer& viewer);

// Interpolation of followers from several guides or from one guide. Without both, it is mixed.
void view_toggle_multi(viewer& viewer);
bool view_is_multi(const viewer& viewer);
void view_toggle_single(viewer& viewer);
bool view_is_single(const viewer& viewer);

// Tessellation by hardware, or vertices that compute shaders write.
void view_toggle_tessellation(viewer& viewer);
bool view_is_tessellated(const viewer& viewer);

void view_toggle_lod(viewer& viewer);
bool view_has_lod(const viewer& viewer);
// Levels by the size on the screen, or the levels of the sliders.
void view_toggle_dynamic(viewer& viewer);
bool view_is_dynamic(const viewer& viewer);

// Fractions of the strands and of their segments that are drawn at the distance of the camera's
// target.
struct view_levels {
    float strands, segments;
};
view_levels view_present_levels(const viewer& viewer);

// Simulation by passes of transform feedback, as of Direct3D 10, or by compute shaders.
void view_toggle_passes(viewer& viewer);
bool view_has_passes(const viewer& viewer);
// Fewer substeps of hair that is far away or out of the picture.
void view_toggle_simulation_lod(viewer& viewer);
bool view_has_simulation_lod(const viewer& viewer);

void view_toggle_wind(viewer& viewer);
bool view_has_wind(const viewer& viewer);
void view_stronger_wind(viewer& viewer);
void view_weaker_wind(viewer& viewer);
float view_wind_speed(const hair_scene& scene); // m/s
// Set the speed of the wind. Still air gets the direction of the last wind.
void view_set_wind_speed(viewer& viewer, float speed);

#endif
