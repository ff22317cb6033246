// wide_strands.glsl - the light on strands that a level of detail draws wider, because each stands
// for several. The constants are fitted to the light of all strands. tools/bench/README.md has the
// errors. Strands of their own width keep their light.
#include "eye.glsl"
#include "light/strand_in_map.glsl"

// Return how much wider the view draws a strand than the shadow map of a light does, from 0 to 6.
// Lights without a map return 0.
float find_gain(uint map, float widened)
{
    float ratio = map < uint(HAIR_SHADOW_MAPS) ? max(widened / widened_in[map], 1.0) : 1.0;
    return 6.0 * (ratio - 1.0) / (ratio + 19.0);
}

// Return the direction across a strand, as the eye sees the strand, to the side with less hair. The
// length is 1 at the surface of dense hair, and 0 where both sides have as much hair.
vec3 find_outer_side(density_grid grid, vec3 at, vec3 tangent)
{
    const float FIT_LAYER = 0.008; // m
    vec3  side  = cross(tangent, normalize(towards_eye(draw.eye, at))), place = place_in(grid, at);
    side /= max(length(side), 1e-6);
    vec3  reach = min(FIT_LAYER / grid.cell, 1.0) * in_head(side);
    float right = density_at(grid, place + reach), left = density_at(grid, place - reach);
    return (left - right) / max(left + right, 1e-6) * side;
}

// Return the distance from the middle of a strand to the middle of its visible part at the surface
// of hair, m. Strands in front hide the inner side of a strand that is wider by `gained` to each
// side, m.
float find_seen(float gained)
{
    const float FIT_DEPTH = 0.001; // Largest distance, m.
    return gained * FIT_DEPTH / (gained + FIT_DEPTH);
}

// Return how much a light shines on curls from the side, from 0 to 1. `between` is the cosine of
// the angle between light and eye.
float on_side_of_curls(float order, float between) { return (1.0 - order) * (1.0 - between * between); }

// Return the open fraction of a light for the visible part of a strand that stands for several. The
// eye sees the front ones. `cut` is the fraction of the segments that are left out, which cut curls
// off.
float open_in_front(float open, float order, float between, float gain, float cut)
{
    const float FIT_FRONT = -0.02, FIT_SEEN = 0.12, FIT_SEEN_CURLED = 0.3, FIT_ASIDE = 0.1;
    if (gain == 0.0) return open;
    float raised = FIT_FRONT + FIT_ASIDE * on_side_of_curls(order, between) +
                   (FIT_SEEN + FIT_SEEN_CURLED * cut * (1.0 - order)) * between;
    return pow(max(open, 1e-6), max(1.0 - gain * raised, 0.0));
}

// Return the open fraction of a light from a shadow map whose strands are `widened` times as wide.
// Shading raises the fraction if the eye is near the light, because the visible places of a thin
// strand are lit more often (find_visible_light). A wide strand of the map hides whole vertices,
// and the picture itself shows which ones. It hides curls too often from light from the side.
float open_past_wide(float open, float order, float between, float widened)
{
    const float FIT_HIDDEN = 0.4, FIT_WIDTH = 8.0, FIT_ASIDE = 0.58;
    float wider = max(widened - 1.0, 0.0);
    if (wider == 0.0) return open;
    float raised = FIT_ASIDE * on_side_of_curls(order, between) - FIT_HIDDEN * between;
    return pow(max(open, 1e-6), max(1.0 - raised * wider / (wider + FIT_WIDTH), 0.0));
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
