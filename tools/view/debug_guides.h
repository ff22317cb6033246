// debug_guides.h - Numbers of the guides for the debug view: stretch, tension, velocity, contact.
#ifndef HAIR_TOOLS_VIEW_DEBUG_GUIDES_H
#define HAIR_TOOLS_VIEW_DEBUG_GUIDES_H

#include "tools/view/viewer.h"

// Read the guides after a step of `dt` s, and compute the values of the mode. The call waits for
// the GPU. Return an exit status.
int view_debug_update(viewer& viewer, double dt);

// Write the guides as coloured segments.
void view_debug_segments(const viewer& viewer, std::vector<view_debug_segment>& out);

// Compute the colour of a value as a fraction of the range, by which all modes are coloured.
void view_debug_color(int mode, float fraction, float out[3]);

// Return the legend's text for a value of the mode.
std::string view_debug_text(int mode, float value);

#endif
