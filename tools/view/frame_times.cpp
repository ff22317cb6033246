// frame_times.cpp - Times of frames by the quality of their picture, for --fps.
#include "tools/view/frame_times.h"

#include <stdio.h>

#include <algorithm>
#include <string>

namespace
{

constexpr uint32_t first_frames = 60; // frames that compile programs, and that are not counted

void print(const char* name, std::vector<double>& ms)
{
    if (ms.empty()) return;
    std::sort(ms.begin(), ms.end());
    double median = ms[ms.size() / 2], late = ms[(size_t)(0.99 * (double)(ms.size() - 1))], worst = ms.back();
    printf("%-24s %6zu %8.2f ms %7.1f/s %8.2f ms %7.1f/s %8.2f ms %7.1f/s\n", name, ms.size(), median,
           1000 / median, late, 1000 / late, worst, 1000 / worst);
}

} // namespace

void view_frame_times_add(view_frame_times& times, bool is_moving, uint32_t level, double ms)
{
    if (times.frames++ < first_frames) return;
    (is_moving ? times.moving[level] : times.resting).push_back(std::max(ms, 1e-3));
}

void view_frame_times_print(view_frame_times& times)
{
    printf("%-24s %6s %22s %22s %22s\n", "picture", "frames", "median", "99th percentile", "worst");
    for (uint32_t i = 0; i < view_quality_levels; ++i) {
        std::string name = std::string("moving, ") + view_quality_of(i).about;
        print(name.c_str(), times.moving[i]);
    }
    print("at rest", times.resting);
}
