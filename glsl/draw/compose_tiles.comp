// compose_tiles.comp - the list of tiles that contain hair. Only those are drawn. The visible
// segment of a sample is replaced by the vertex before the sample, and the fraction of the way from
#version 450 core
#include "draw/raster_quad.glsl"
#include "workgroup.glsl"
layout(local_size_x = HAIR_RASTER_TILE * HAIR_RASTER_TILE) in;

#ifdef HAIR_DEPTH
layout(std430, binding = HAIR_BIND_NEAREST) readonly restrict buffer nearest_buffer { uint nearest[]; };
#else
layout(std430, binding = HAIR_BIND_NEAREST) restrict buffer nearest_buffer { uvec2 nearest[]; };
#endif
layout(std430, binding = HAIR_BIND_TILE) restrict buffer tile_buffer { uint tile[]; };

shared bool is_there;

#ifdef HAIR_DEPTH
bool compose(uint at, vec2 pixel)
{
#ifdef HAIR_ALPHA_COVERAGE
    return nearest[at] != 0u;
#else
    for (uint s = 0u; s < raster.samples; ++s)
        if (nearest[at + s] != HAIR_NOBODY) return true;
    return false;
#endif
}
#else
// Return where a sample is between the vertices of a segment. The upper bits are the vertex, and
// the lower ones the fraction.
uint between(uint segment, raster_ribbon r, raster_quad q, vec2 place)
{
    float width, fraction, depth;
    bool  there;
    sees(q, place - q.origin, fraction, depth);
    vec2  w = mix(vec2(r.middle[0].w), vec2(r.middle[1].w), r.seen);
    // Fraction along the strand, from the fraction along the picture.
    float along = mix(r.seen.x, r.seen.y, fraction * w.x / mix(w.y, w.x, fraction));
    float steps = float(1u << raster.fraction_bits);
    return uint(vertex_of(segment, width, there)) << raster.fraction_bits |
           uint(min(max(along, 0.0) * steps, steps - 1.0));
}

bool compose(uint at, vec2 pixel)
{
    uint          known = HAIR_NOBODY;
    raster_ribbon r;
    raster_quad   q;
    for (uint s = 0u; s < raster.samples; ++s) {
        uint segment = nearest[at + s].x;
        if (segment == HAIR_NOBODY) continue;
        if (segment != known) {
            r     = ribbon_of(segment);
            q     = quad_of(r);
            known = segment;
        }
        nearest[at + s].x = between(segment, r, q, pixel + sample_at(s));
    }
    return known != HAIR_NOBODY;
}
#endif

void main()
{
    uint number = hair_group(), own = gl_LocalInvocationID.x, command = 0u, first_tile = HAIR_TILE_FIRST;
#ifdef HAIR_BATCH
    number     = find_head(number, true);
    command    = own_head * HAIR_TILE_FIRST;
    first_tile = uint(HAIR_BATCH_HEADS) * HAIR_TILE_FIRST + draw.first_tile;
#endif
    uvec2 pixel = uvec2(number % raster.across, number / raster.across) * HAIR_RASTER_TILE +
                  uvec2(own % HAIR_RASTER_TILE, own / HAIR_RASTER_TILE);
    if (own == 0u) is_there = false;
    synchronise();
    if (pixel.x < raster.columns && pixel.y < raster.rows &&
        compose(first_sample() + (pixel.y * raster.columns + pixel.x) * raster.samples, vec2(pixel)))
        is_there = true;
    synchronise();
    if (own > 0u || !is_there) return;
    // Tiles may be drawn in any order.
    uint place = atomicAdd(tile[command + HAIR_TILE_VERTICES], HAIR_TILE_CORNERS) / HAIR_TILE_CORNERS;
#ifdef HAIR_BATCH
    number |= own_head << HAIR_BATCH_TILE_BITS;
#endif
    tile[first_tile + place] = number;
}
