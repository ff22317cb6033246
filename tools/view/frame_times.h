// frame_times.h - Times of frames by the quality of their picture, for --fps.
#ifndef HAIR_TOOLS_VIEW_FRAME_TIMES_H
#define HAIR_TOOLS_VIEW_FRAME_TIMES_H

#include "tools/view/quality.h"

#include <vector>

struct view_frame_times {
    uint32_t frames = 0; // frames so far, with those that are not counted
    std::vector<double> moving[view_quality_levels]; // ms, by the level of the moving picture
    std::vector<double> resting; // ms, of frames that keep a picture at rest or improve it
};

// Add the time of a frame, ms. The first frames compile programs and are not counted.
void view_frame_times_add(view_frame_times& times, bool is_moving, uint32_t level, double ms);

// Print the median, the 99th percentile and the worst of each quality.
void view_frame_times_print(view_frame_times& times);

#endif
