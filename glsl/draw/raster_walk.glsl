// raster_walk.glsl - the way of the compute rasteriser over the pixels of a ribbon.
#include "draw/nearest.glsl"

// The way over the pixels of a ribbon: lines of pixels across its longer extent. Along a line, few
// pixels or none have a sample in a thin ribbon, and they are found without a search.
struct raster_walk {
    bool  upright;     // Lines are rows. Otherwise they are columns.
    int   first, last; // Lines.
    int   low, high;   // Pixels of a line.
    float start, slope; // Pixel of the middle line in the first line, and its increase by line.
    float reach;       // Half of the pixels of a line that the ribbon covers.
};

raster_walk walk_of(raster_quad q)
{
    raster_walk w;
    float margin = margin_of(q), beside = margin + (raster.samples > 1u ? 0.5 : 0.0);
    vec2  lower  = min(min(q.corner[0].xy, q.corner[1].xy), min(q.corner[2].xy, q.corner[3].xy));
    vec2  upper  = max(max(q.corner[0].xy, q.corner[1].xy), max(q.corner[2].xy, q.corner[3].xy));
    vec2  size   = vec2(raster.columns, raster.rows);
    lower        = max(ceil(q.origin + lower - beside - 0.5), 0.0);
    upper        = min(floor(q.origin + upper + beside - 0.5), size - 1.0);
    bool there   = q.there && all(lessThan(lower, size)) && all(greaterThanEqual(upper, vec2(0.0)));
    w.upright    = abs(q.across.x) >= abs(q.across.y);
    vec2 n = q.across.xy, origin = q.origin;
    if (!w.upright) n = n.yx, origin = origin.yx, lower = lower.yx, upper = upper.yx;
    w.first = there ? int(lower.y) : 0;
    w.last  = there ? int(upper.y) : -1;
    w.low   = there ? int(lower.x) : 0;
    w.high  = there ? int(upper.x) : -1;
    w.slope = -n.y / n.x;
    w.start = origin.x - q.across.z / n.x + w.slope * (lower.y - origin.y);
    w.reach = (q.half_width + margin) / abs(n.x);
    return w;
}
