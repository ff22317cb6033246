// raster.comp - rasterisation of segments by compute, for GPUs with few graphics units. It finds
// the nearest segment and its depth at each sample. The first of equally near segments wins.
// Without 64-bit atomics a first pass finds the depth, and a second pass with the same arithmetic
// finds the segment that claims it. With HAIR_ALPHA_COVERAGE it adds up the opacity of strands in
// each pixel, whatever their order.
//
// raster.split threads share the lines of pixels of a segment. The lines of larger segments are
// distributed among all threads of the work group.
#version 450 core
#ifdef HAIR_LONG_ATOMICS
#extension GL_ARB_gpu_shader_int64 : require
#extension GL_NV_shader_atomic_int64 : require
#endif
#include "draw/raster_quad.glsl"
#include "draw/raster_walk.glsl"
#include "workgroup.glsl"
layout(local_size_x = HAIR_GROUP_SIZE) in;

#ifdef HAIR_BATCH
uint count_strands() { return uint(ribbon_position[draw.strands_at].x); }
#else
layout(std430, binding = HAIR_BIND_COMMAND) readonly restrict buffer command_buffer
{
    hair_draw_command command[];
};

uint count_strands() { return command[0].strands; }
#endif

shared bool has_large; // Some segments of this work group are too large for their threads.
shared uint ends[HAIR_GROUP_SIZE]; // Inclusive prefix sum of the pieces of those segments.

// Rasterise a sample of `count` pixels of a line from number `from` on.
void fill(uint segment, raster_quad q, raster_walk w, int line, uint s, int from, int count)
{
    int   low = w.low + from, high = min(w.high, low + count - 1);
    vec2  own   = w.upright ? sample_at(s) : sample_at(s).yx;
    float at    = w.start + w.slope * (float(line - w.first) + own.y) - own.x;
    int   first = int(clamp(ceil(at - w.reach), float(low), float(high + 1)));
    int   last  = int(clamp(floor(at + w.reach), float(low - 1), float(high)));
    for (int i = first; i <= last; ++i) {
        ivec2 pixel = w.upright ? ivec2(i, line) : ivec2(line, i);
        vec2  place = vec2(pixel) - q.origin + sample_at(s);
        uint  number =
            first_sample() + (uint(pixel.y) * raster.columns + uint(pixel.x)) * raster.samples + s;
#ifdef HAIR_ALPHA_COVERAGE
        add_opacity(segment, q, number, pixel, place);
#else
        float fraction, depth;
        if (sees(q, place, fraction, depth)) take(segment, number, depth);
#endif
    }
}

// Return the number of pieces of a line.
uint pieces_of(raster_walk w) { return 1u + uint(w.high - w.low) / HAIR_RASTER_PIECE; }

// Return the large segment of a piece: the first whose pieces end behind it.
uint large_of(uint piece)
{
    uint first = 0u;
    for (uint step_ = HAIR_GROUP_SIZE / 2u; step_ > 0u; step_ /= 2u)
        if (ends[first + step_ - 1u] <= piece) first += step_;
    return first;
}

// Rasterise one of raster.split lines of a segment, from number `own` on, unless the segment is
// large. Return the number of its pieces then, for one of its threads.
uint fill_small(uint segment, int own)
{
    raster_quad q     = quad_of(ribbon_of(segment));
    raster_walk w     = walk_of(q);
    int         lines = w.last - w.first + 1;
    float       width = min(2.0 * w.reach + 1.0, float(w.high - w.low + 1));
    if (float(lines) * width > HAIR_RASTER_SMALL * float(raster.split))
        return own == 0 ? uint(lines) * pieces_of(w) : 0u;
    int count = w.high - w.low + 1;
    if (raster.samples == 1u) {
        for (int line = w.first + own; line <= w.last; line += int(raster.split))
            fill(segment, q, w, line, 0u, 0, count);
        return 0u;
    }
    // Neighbouring threads have the samples of a pixel, which are side by side in memory.
    uint all = uint(lines) * raster.samples;
    for (uint i = uint(own); i < all; i += raster.split)
        fill(segment, q, w, w.first + int(i / raster.samples), i % raster.samples, 0, count);
    return 0u;
}

// Rasterise the segments of the threads from `base` on.
void rasterise(uint base)
{
    uint own = gl_LocalInvocationID.x, pieces = 0u;
    if (own == 0u) has_large = false;
    synchronise();
    uint mine = (base + own) / raster.split;
    int  line = int((base + own) % raster.split);
    if (mine / draw.segments < count_strands()) pieces = fill_small(mine, line);
    ends[own] = pieces;
    if (pieces > 0u) has_large = true;
    synchronise();
    if (!has_large) return;
    for (uint reach = 1u; reach < HAIR_GROUP_SIZE; reach *= 2u) {
        uint before = own >= reach ? ends[own - reach] : 0u;
        synchronise();
        ends[own] += before;
        synchronise();
    }
    for (uint i = own; i < ends[HAIR_GROUP_SIZE - 1]; i += HAIR_GROUP_SIZE) {
        uint        k    = large_of(i), piece = i - (k > 0u ? ends[k - 1u] : 0u);
        uint segment     = (base + k) / raster.split;
        raster_quad q    = quad_of(ribbon_of(segment));
        raster_walk w    = walk_of(q);
        uint        each = pieces_of(w);
        for (uint s = 0u; s < raster.samples; ++s)
            fill(segment, q, w, w.first + int(piece / each), s, int(piece % each) * HAIR_RASTER_PIECE,
                 HAIR_RASTER_PIECE);
    }
}

void main()
{
    // The CPU dispatches as many groups as it expects strands, and does not know their number.
    uint group = hair_group(), groups = hair_group_count();
#ifdef HAIR_BATCH
    group  = find_head(group, false);
    groups = draw.raster_end - (own_head > 0u ? groups_until(own_head - 1u, false) : 0u);
#endif
    uint threads = count_strands() * draw.segments * raster.split;
    uint stride  = groups * HAIR_GROUP_SIZE;
    for (uint base = group * HAIR_GROUP_SIZE; base < threads; base += stride) {
        rasterise(base);
        synchronise();
    }
}
