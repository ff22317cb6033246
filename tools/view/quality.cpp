// quality.cpp - Cost of a picture: full at rest, and by a budget of time while anything moves.
#include "tools/view/quality.h"

namespace
{

constexpr double slow_ms = 45, fast_ms = 18; // budget of a frame
constexpr uint32_t slow_frames = 2, fast_frames = 90; // frames until the level changes

const view_quality levels[view_quality_levels] = {
    {1, 4, 0, 0, true, true, false, "full"},           {1, 4, 0.5f, 4, true, true, false, "level of detail"},
    {1, 1, 1, 8, false, true, true, "no shadow maps"}, {0.5f, 1, 1, 8, false, true, true, "half resolution"},
    {0.4f, 1, 2, 16, false, false, false, "coarse"},
};

} // namespace

const view_quality& view_quality_of(uint32_t level)
{
    return levels[level < view_quality_levels ? level : view_quality_levels - 1];
}

void view_governor_add(view_governor& governor, double ms)
{
    governor.slow = ms > slow_ms ? governor.slow + 1 : 0;
    governor.fast = ms < fast_ms ? governor.fast + 1 : 0;
    if (governor.slow >= slow_frames && governor.level + 1 < view_quality_levels) {
        ++governor.level;
        governor.slow = governor.fast = 0;
    } else if (governor.fast >= fast_frames && governor.level > 0) {
        --governor.level;
        governor.slow = governor.fast = 0;
    }
}
