// wide_strands.glsl - the light on strands that a level of detail draws wider, because each stands
// for several. The constants are fitted to the light of all strands. tools/bench/README.md has the
// errors. Strands of their own width keep their light.
#include "light/strand_in_map.glsl"

// Return how much wider the view draws a strand than the shadow map of a light does, from 0 to 6.
// Lights without a map return 0.
float find_gain(uint map, float widened)
{
    float ratio = map < uint(HAIR_SHADOW_MAPS) ? max(widened / widened_in[map], 1.0) : 1.0;
    return 6.0 * (ratio - 1.0) / (ratio + 19.0);
}

// Return the open fraction of a light for the visible part of a strand that stands for several. The
// eye sees the front ones. `between` is the cosine of the angle between light and eye. `cut` is the
// fraction of the segments that are left out, which cut curls off.
float open_in_front(float open, float met, float order, float between, float gain, float cut)
{
    const float FIT_FRONT = 0.02, FIT_SEEN = 0.02, FIT_SEEN_CURLED = 0.33, FIT_WAVY = 6.0;
    if (gain == 0.0) return open;
    float curled = cut * (1.0 - order), wavy = order * (1.0 - order);
    float power  = 1.0 - gain * (FIT_FRONT + (FIT_SEEN + FIT_SEEN_CURLED * curled) * between);
    open         = pow(max(open, 1e-6), max(power, 0.0));
    return open + min(FIT_WAVY * wavy * wavy * cut * gain, 1.0) * (1.0 - open) * exp(-0.5 * met);
}

// Return the open fraction of a light from a shadow map whose strands are `widened` times as wide.
// Shading raises the fraction if the eye is near the light, because the visible places of a thin
// strand are lit more often (find_visible_light). A wide strand of the map hides whole vertices,
// and the picture itself shows which ones.
float open_past_wide(float open, float between, float widened)
{
    const float FIT_HIDDEN = 0.39, FIT_WIDTH = 6.0;
    float wider = max(widened - 1.0, 0.0);
    if (wider == 0.0) return open;
    return pow(max(open, 1e-6), 1.0 + FIT_HIDDEN * between * wider / (wider + FIT_WIDTH));
}

// Return the visible fraction of the sky in a grid of wide strands. Light passes few wide strands
// more easily than many thin strands of the same area. `wider` is the width that a strand has
// gained, in cells. A quarter of a cell is spread evenly. A grid that views share has all strands.
float sky_past_wide(float open, float wider)
{
    const float FIT_UNEVEN = 0.085, EVEN = 0.25;
    bool is_wide = draw.grid_has_all == 0u && wider > EVEN;
    return is_wide ? pow(max(open, 1e-6), 1.0 + FIT_UNEVEN * (wider - EVEN)) : open;
}
