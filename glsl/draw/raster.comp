// raster.comp - rasterisation of segments by compute, for GPUs with few graphics units. It finds
// the nearest segment and its depth at each sample. The first of equally near segments wins.
// Without 64-bit atomics a first pass finds the depth, and a second pass with the same arithmetic
// finds the segment that claims it. A work group distributes the pixel rows of its segments among
// its threads, which balances long and short segments.
#version 450 core
#ifdef HAIR_LONG_ATOMICS
#extension GL_ARB_gpu_shader_int64 : require
#extension GL_NV_shader_atomic_int64 : require
#endif
#include "draw/raster.glsl"
#include "workgroup.glsl"
layout(local_size_x = HAIR_GROUP_SIZE) in;

layout(std430, binding = HAIR_BIND_COMMAND) readonly restrict buffer command_buffer
{
    hair_draw_command command[];
};
#ifdef HAIR_DEPTH
layout(std430, binding = HAIR_BIND_NEAREST) restrict buffer nearest_buffer { uint nearest[]; };
#elif defined(HAIR_LONG_ATOMICS)
layout(std430, binding = HAIR_BIND_NEAREST) restrict buffer nearest_buffer { uint64_t nearest[]; };
#else
layout(std430, binding = HAIR_BIND_NEAREST) restrict buffer nearest_buffer { uvec2 nearest[]; };
#endif
layout(std430, binding = HAIR_BIND_TILE) writeonly restrict buffer tile_buffer { uint tile[]; };

// Segments of this work group.
shared raster_outline outlines[HAIR_RASTER_SEGMENTS];
shared ivec4          bounds[HAIR_RASTER_SEGMENTS]; // Pixel bounds. xy: the first, zw: the last.
shared uint           ends[HAIR_RASTER_SEGMENTS];   // Inclusive prefix sum of the segments' pieces.

// Return a ribbon's middle line in pixels. xy: start. zw: direction.
vec4 line_of(raster_outline o)
{
    vec2 start = 0.5 * (o.corner[0].xy + o.corner[1].xy);
    return vec4(start, 0.5 * (o.corner[2].xy + o.corner[3].xy) - start);
}

// Return half of a ribbon's width, pixels.
float half_of(raster_outline o)
{
    return 0.5 * max(distance(o.corner[0].xy, o.corner[1].xy), distance(o.corner[2].xy, o.corner[3].xy));
}

ivec4 bounds_of(raster_ribbon r, raster_outline o)
{
    vec2 max_value  = vec2(raster.columns, raster.rows);
    vec2 lower = min(min(o.corner[0].xy, o.corner[1].xy), min(o.corner[2].xy, o.corner[3].xy));
    vec2 upper = max(max(o.corner[0].xy, o.corner[1].xy), max(o.corner[2].xy, o.corner[3].xy));
    // A ribbon that is not finite is nowhere.
    bool there =
        r.seen.x < r.seen.y && all(lessThan(lower, max_value)) && all(greaterThanEqual(upper, vec2(0.0)));
    return there ? ivec4(max(lower, vec2(0.0)), min(upper, max_value - 1.0)) : ivec4(0, 0, -1, -1);
}

void take(uint segment, uint at, float depth)
{
    uint key = floatBitsToUint(clamp(abs(depth), 0.0, 1.0)) ^ raster.flips;
#ifdef HAIR_DEPTH
    atomicMin(nearest[at], key);
#elif defined(HAIR_LONG_ATOMICS)
    atomicMin(nearest[at], packUint2x32(uvec2(segment, key)));
#else
    if (raster.claims == 0u) atomicMin(nearest[at].y, key);
    else if (nearest[at].y == key) atomicMin(nearest[at].x, segment);
#endif
}

// Return how far the middle line advances in x per pixel in y, pixels.
float slant_of(vec2 way) { return way.x / (abs(way.y) < 1e-6 ? 1e-6 : way.y); }

// Return the maximum number of pieces of a row.
uint pieces_of(raster_outline o, ivec4 about)
{
    float half_ = half_of(o),
          max_value = abs(slant_of(line_of(o).zw)) * (1.0 + 2.0 * half_) + 2.0 * half_ + 2.0;
    return 1u + uint(min(max_value, float(about.z - about.x))) / HAIR_RASTER_PIECE;
}

// Rasterise one piece of a row. It covers the part of the middle line that is no farther from the
// row than half the width, and half the width to either side.
void fill(uint segment, raster_outline o, ivec4 about, int y, uint piece)
{
    vec4  line  = line_of(o);
    float half_ = half_of(o), end = line.x + line.z;
    vec2  x = line.x + (vec2(-half_, 1.0 + half_) + float(y) - line.y) * slant_of(line.zw);
    x       = clamp(x, min(line.x, end), max(line.x, end));
    int   first = max(int(max(min(x.x, x.y) - half_, 0.0)), about.x) + int(piece * HAIR_RASTER_PIECE);
    int   last  = min(min(int(max(x.x, x.y) + half_), about.z), first + HAIR_RASTER_PIECE - 1);
    uint  told = raster.tiles, row = uint(y) / HAIR_RASTER_TILE * raster.across;
    for (int i = first; i <= last; ++i) {
        uint at = (uint(y) * raster.columns + uint(i)) * raster.samples,
             own = row + uint(i) / HAIR_RASTER_TILE;
        for (uint s = 0u; s < raster.samples; ++s) {
            float fraction, depth;
            if (!sees(o, vec2(i, y) + sample_at(s), fraction, depth)) continue;
            take(segment, at + s, depth);
            if (own != told) tile[own] = 1u;
            told = own;
        }
    }
}

// Return the segment of a piece: the first whose pieces end behind it.
uint segment_of(uint piece)
{
    uint first = 0u;
    for (uint step_ = HAIR_RASTER_SEGMENTS / 2u; step_ > 0u; step_ /= 2u)
        if (ends[first + step_ - 1u] <= piece) first += step_;
    return first;
}

void main()
{
    uint own = gl_LocalInvocationID.x, base = hair_group() * HAIR_RASTER_SEGMENTS, pieces = 0u;
    if (own < HAIR_RASTER_SEGMENTS && (base + own) / draw.segments < command[0].strands) {
        raster_ribbon r = ribbon_of(base + own);
        outlines[own]   = outline_of(r);
        bounds[own]     = bounds_of(r, outlines[own]);
        pieces          = uint(bounds[own].w - bounds[own].y + 1);
        if (pieces > 0u) pieces *= pieces_of(outlines[own], bounds[own]);
    }
    if (own < HAIR_RASTER_SEGMENTS) ends[own] = pieces;
    for (uint reach = 1u; reach < HAIR_RASTER_SEGMENTS; reach *= 2u) {
        synchronise();
        uint before = own >= reach && own < HAIR_RASTER_SEGMENTS ? ends[own - reach] : 0u;
        synchronise();
        if (own < HAIR_RASTER_SEGMENTS) ends[own] += before;
    }
    synchronise();
    for (uint i = own; i < ends[HAIR_RASTER_SEGMENTS - 1]; i += HAIR_GROUP_SIZE) {
        uint k = segment_of(i), piece = i - (k > 0u ? ends[k - 1u] : 0u),
             each = pieces_of(outlines[k], bounds[k]);
        ivec4 about = bounds[k];
        fill(base + k, outlines[k], about, about.y + int(piece / each), piece % each);
    }
}
