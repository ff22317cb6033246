// nearest.glsl - what the compute rasteriser keeps of ribbons at a sample: the nearest, or the sum
// of their opacities.
#include "draw/coverage.glsl"
#include "random.glsl"

#ifdef HAIR_ALPHA_COVERAGE
layout(std430, binding = HAIR_BIND_NEAREST) restrict buffer nearest_buffer { uint opacity[]; };
layout(binding = HAIR_UNIT_OCCLUSION) uniform sampler2D attached_depth;

// Return whether the depth of opaque geometry, if the application tests it, leaves a ribbon
// visible.
bool is_visible(ivec2 pixel, float depth)
{
    if (raster.tests == 0u) return true;
    float there = texelFetch(attached_depth, pixel + ivec2(raster.first_x, raster.first_y), 0).r;
    float own   = raster.depth_from + raster.depth_by * clamp(depth, 0.0, 1.0);
    uint  is    = own < there ? HAIR_TEST_NEARER : own > there ? HAIR_TEST_FARTHER : HAIR_TEST_EQUAL;
    return (raster.tests & is) != 0u;
}

// Return half the widths of the base and the top of a pixel seen along a ribbon. See coverage_of().
vec2 trapezoid_of(raster_quad q)
{
    vec2 n = abs(q.across.xy);
    return 0.5 * vec2(n.x + n.y, abs(n.x - n.y));
}

// Return the distance beside a ribbon up to which it covers pixels, from their centres.
float margin_of(raster_quad q) { return trapezoid_of(q).x; }

// Add the opacity of a ribbon in a pixel. Opacities of independent strands multiply, so their
// logarithms are added, as integers because their order must not matter. They are rounded up or
// down at random, because the sum of many strands must not depend on the rounding.
void add_opacity(uint segment, raster_quad q, uint at, ivec2 pixel, vec2 place)
{
    float first = at_place(q.sides[0], place), second = at_place(q.sides[1], place);
    float off   = 0.5 * (second - first), half_ = 0.5 * (first + second);
    if (!is_between(q, place)) return;
    if (!is_visible(pixel, depth_at(q, fraction_at(q, place), first, second))) return;
    float covered = coverage_of(vec4(off, half_, trapezoid_of(q)));
    float left    = max(1.0 - covered * draw.viewport.w, HAIR_OPACITY_MIN_LEFT);
    uint  sum     = uint(-log2(left) * HAIR_OPACITY_SCALE + random(hash(segment) ^ at));
    if (sum > 0u && opacity[at] < HAIR_OPACITY_FULL) atomicAdd(opacity[at], sum);
}
#else
#ifdef HAIR_DEPTH
layout(std430, binding = HAIR_BIND_NEAREST) restrict buffer nearest_buffer { uint nearest[]; };
#elif defined(HAIR_LONG_ATOMICS)
layout(std430, binding = HAIR_BIND_NEAREST) restrict buffer nearest_buffer { uint64_t nearest[]; };
#else
layout(std430, binding = HAIR_BIND_NEAREST) restrict buffer nearest_buffer { uvec2 nearest[]; };
#endif

float margin_of(raster_quad q) { return 0.0; }

// Take a ribbon as the nearest at a sample, if it is. Values only decrease, so one that was read is
// never less than the current one. Reading before saves most atomic operations.
void take(uint segment, uint at, float depth)
{
    uint key = floatBitsToUint(clamp(abs(depth), 0.0, 1.0)) ^ raster.flips;
#ifdef HAIR_DEPTH
    if (key < nearest[at]) atomicMin(nearest[at], key);
#elif defined(HAIR_LONG_ATOMICS)
    uint64_t own = packUint2x32(uvec2(segment, key));
    if (own < nearest[at]) atomicMin(nearest[at], own);
#else
    if (raster.claims == 0u) {
        if (key < nearest[at].y) atomicMin(nearest[at].y, key);
    } else if (nearest[at].y == key)
        atomicMin(nearest[at].x, segment);
#endif
}
#endif
