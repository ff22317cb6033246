// strand_in_map.glsl - the light that meets no strand on its way to a vertex, from the light's
// shadow map. Sample points lie on the half segments beside the vertex and across the strand, where
// the map draws the strand. The map has a level of detail of its own.
#include "strands/patch.glsl"
#include "light/shadow_map.glsl"
#include "random.glsl"
#ifdef HAIR_WIDENED
#include "strands/lod_contract.glsl"
#endif

layout(binding = HAIR_UNIT_SHADOW) uniform sampler2D hair_shadow_map[HAIR_SHADOW_MAPS];

#define TAPS 12
#define OWN_DEPTH 0.35 // In radii. A strand must be nearer to the light by this to occlude.

// Factors of the width of strands in shadow maps that compensate for strands left out.
float widened_in[HAIR_SHADOW_MAPS];

// A strand beside a vertex as a shadow map shows it.
struct strand_bit {
    vec3  before, at, after; // m, from the head's origin.
    float radius, thin; // m. `thin` is without a level of detail.
    uint  seed;
};

// Return the shadow map of a light, or HAIR_SHADOW_MAPS if it has none.
uint map_of(uint light) { return uint(draw.light[light * HAIR_LIGHT_VECTORS + HAIR_LIGHT_MORE].w); }

// Return how many texels a metre has in a shadow map at a position.
float texels_per_metre(uint map, vec3 position)
{
    mat4  m  = transpose(draw.shadow[map]);
    vec3  up = m[1].xyz - 0.5 * m[3].xyz;
    float w  = dot(m[3], vec4(position, 1.0));
    return length(up) * float(textureSize(hair_shadow_map[map], 0).y) * draw.map_part[map].w / max(w, 1e-6);
}

// Find the widths of the strands of a patch in all shadow maps. The maps are taken to be drawn with
// the level of detail of this view.
void find_widths(uint patch_, float widened)
{
    hair_patch own = fetch_patch(patch_);
    for (uint i = 0u; i < draw.lights; ++i) {
        uint map = map_of(i);
        if (map >= uint(HAIR_SHADOW_MAPS)) continue;
        float scale = 0.0;
        for (uint k = 0u; k < 3u && draw.pixels_per_unit > 0.0; ++k) {
            uint along = k * (draw.smooth_vertices - 1u) / 2u;
            scale      = max(scale, texels_per_metre(map, guide_at(own.guide, along)));
        }
        widened_in[map] =
            draw.pixels_per_unit > 0.0 ? widening_of(fraction_at(scale * own.importance)) : widened;
    }
}

// Return the place where a vertex of a follower is drawn. Wider strands of a level of detail are
// drawn elsewhere.
vec3 drawn_at(uint vertex, uint number, float widened)
{
    vec4 v = strand_vertex[vertex];
#ifdef HAIR_WIDENED
    hair_point point = hair_point(v.xyz, vec3(0.0), v.w);
    float      t     = float(vertex % (draw.segments + 1u)) / float(draw.segments);
    hair_follower follower = fetch_follower(number);
    if (widened > 1.0) gather(follower, whole_t(t), v.w * (widened - 1.0), point);
    v.xyz = point.position;
#endif
    return v.xyz;
}

// Return the follower `number` beside vertex k as it is drawn `widened` times as wide.
strand_bit find_bit(uint vertex, uint k, uint number, float widened, float thickness)
{
    strand_bit s;
    s.at     = drawn_at(vertex, number, widened);
    s.before = k > 0u ? drawn_at(vertex - 1u, number, widened) : s.at;
    s.after  = k < draw.segments ? drawn_at(vertex + 1u, number, widened) : s.at;
    s.thin   = strand_vertex[vertex].w;
    s.radius = s.thin * thickness * widened;
    s.seed   = number;
    return s;
}

// Return the fraction of sample points around a vertex that nothing occludes in a shadow map.
float open_in(uint map, uint light, vec3 to, strand_bit s)
{
    vec4  part  = draw.map_part[map];
    vec2  size  = vec2(textureSize(hair_shadow_map[map], 0));
    vec3  along = find_place_in_map(map, s.after) - find_place_in_map(map, s.before);
    vec2  texels = part.zw * along.xy * size;
    float slope = along.z / max(dot(texels, texels), 1.0); // Slope of depth along the strand.
    vec3  side  = cross(direction_or(s.after - s.before, vec3(0.0, 1.0, 0.0)), to);
    side *= s.radius / max(length(side), 1e-12);
    float each = depth_by_metre(light, find_place_in_map(map, s.at).z, distance_to_light(light, s.at));
    float own = OWN_DEPTH * s.thin * each, turn = random(s.seed + 0x3c6ef372u), open = 0.0;
    for (int i = 0; i < TAPS; ++i) {
        float x = (float(i) + turn) / float(TAPS) * 2.0 - 1.0,
              across = 2.0 * fract(turn + 0.618034 * float(i + 1)) - 1.0;
        vec3  p  = s.at + 0.5 * abs(x) * ((x < 0.0 ? s.before : s.after) - s.at) + across * side;
        vec3  at = find_place_in_map(map, p);
        vec2  here = (part.xy + part.zw * at.xy) * size;
        ivec2 texel = min(ivec2(floor(here)), ivec2(size) - 1);
        // Depth of the strand itself at the centre of the texel.
        float depth = at.z + slope * dot(vec2(texel) + 0.5 - here, texels);
        bool  there = all(greaterThanEqual(at.xy, vec2(0.0))) && all(lessThan(at.xy, vec2(1.0)));
        float stored = depth_from_light(map, texelFetch(hair_shadow_map[map], texel, 0).r);
        open += !there || depth - own <= stored ? 1.0 : 0.0;
    }
    return open / float(TAPS);
}
