// raster.glsl - ribbons of segments in the window, for the compute rasteriser. They lie between
// vertices of the vertex cache or, with levels of detail, between per-view vertices. Their shape is
// that of ribbon.geom.
#include "draw/raster_params.glsl"
#ifndef HAIR_BATCH
#include "draw_params.glsl"
#endif
#include "draw/ribbon.glsl"
#include "strands/packed.glsl"

#ifndef HAIR_BATCH
layout(std430, binding = HAIR_BIND_LISTED_STRAND) readonly restrict buffer strand_buffer
{
    hair_strand strand[];
};
#endif
layout(std430, binding = HAIR_BIND_RIBBON_POSITION) readonly restrict buffer position_buffer
{
    vec4 ribbon_position[];
};
layout(std430, binding = HAIR_BIND_RIBBON_TANGENT) readonly restrict buffer tangent_buffer
{
    uvec2 ribbon_tangent[];
};

// A ribbon in the window, times w. It has a middle at both ends, and vectors from there to a side.
struct raster_ribbon {
    vec4 middle[2], side[2];
    vec2 seen; // Range in [0, 1] that is in front of the eye.
};

// Return the index of a segment's first vertex among those of the head. `width` is the factor of
// its width. `there` is whether its strand has the segment.
int vertex_of(uint segment, out float width, out bool there)
{
    uint each = draw.segments, k = segment % each;
#ifdef HAIR_BATCH
    // Segments beyond the tip of a strand have no length.
    there = float(k + 1u) < ribbon_position[draw.strands_at].y;
#else
    hair_strand own = strand[segment / each];
    there           = float(k) < own.whole;
#endif
#if defined(HAIR_WIDENED) || defined(HAIR_BATCH)
    width = 1.0;
    return int(segment / each * (each + 1u) + k);
#else
    width = own.width;
    return int(own.follower * (each + 1u) + k);
#endif
}

// Clip the range `seen` of [0, 1] to where a linear function with the end values a and b is not
// negative.
void keep(float a, float b, inout vec2 seen)
{
    float at = a / (a - b); // Not used where a and b are equal.
    if (a < 0.0) seen.x = b > 0.0 ? max(seen.x, at) : 2.0;
    else if (b < 0.0) seen.y = min(seen.y, at);
}

raster_ribbon ribbon_of(uint segment)
{
    raster_ribbon r;
    float         width;
    bool          there;
    int           at = first_vertex() + vertex_of(segment, width, there);
    for (int end = 0; end < 2; ++end) {
        vec4 vertex   = ribbon_position[at + end];
        vec3 tangent  = unpack_tangent(ribbon_tangent[at + end]);
        r.middle[end] = raster.to_window * vec4(vertex.xyz, 1.0);
        r.side[end]   = raster.to_window * vec4(side_of(vec4(vertex.xyz, vertex.w * width), tangent), 0.0);
    }
    vec4  a = r.middle[0], b = r.middle[1];
    float min_value = 1e-6 * max(abs(a.w), abs(b.w));
    r.seen = there ? vec2(0.0, 1.0) : vec2(2.0);
    keep(a.w - min_value, b.w - min_value, r.seen);
    if (raster.clamps == 0u) {
        keep(a.z, b.z, r.seen);
        keep(a.w - a.z, b.w - b.z, r.seen);
    }
    return r;
}

// Return the position of a sample in its pixel.
vec2 sample_at(uint number)
{
    vec4 pair = raster.at[number / 2u];
    return (number & 1u) == 0u ? pair.xy : pair.zw;
}
