// cull_patches.comp - occlusion culling of patches. A patch is occluded if each part of all its
// followers lies behind the application's depth. A work group per patch.
#version 450 core
#include "draw/hiz.glsl"
#include "strands/fetch.glsl"
#include "strands/look.glsl"
#include "light/float_key.glsl"
#ifdef HAIR_HITS
layout(binding = HAIR_UNIT_HIT) uniform samplerBuffer hit_texture;
layout(binding = HAIR_UNIT_REPAIR) uniform samplerBuffer repair_texture;
#endif

layout(std430, binding = HAIR_BIND_GUIDE_BOUNDS) readonly restrict buffer guide_bounds_buffer { vec4 box[]; };
layout(std430, binding = HAIR_BIND_STORED_PATCH) restrict buffer patch_buffer
{
    hair_patch patches[];
};

#define GIVE 1.1 // See strands/lod.glsl.
#define TURNS (HAIR_GROUP_SIZE / HAIR_OCCLUSION_PARTS) // Threads that look up a part.
#define DIAGONAL 1.4142136 // Factor for offsets along two axes.

// Bounding box of all followers for each part, in the encoding of light/float_key.glsl. The bits of
// `upper` are inverted.
shared uint lower[HAIR_OCCLUSION_PARTS][3], upper[HAIR_OCCLUSION_PARTS][3];
shared uint seen;
// Samples of each curve at equal steps.
shared float given[HAIR_CURVES][HAIR_CURVE_INTERVALS + 1];

// Return bounds of the repair of a follower. x: displacement, m. y: relative increase of its
// length. z: 1 if it is freed of all guides but its own, otherwise 0.
vec3 find_repair(uint number)
{
    vec3 max_value = vec3(0.0);
#ifdef HAIR_HITS
    if (texelFetch(hit_texture, int(number)).x > float(draw.segments)) return max_value;
    max_value.z = 1.0;
    if (draw.follower_collision == HAIR_COLLISION_IS_SINGLE_GUIDE) return max_value;
    int first = int(number) * HAIR_REPAIR_CONTROLS;
    max_value.y    = max(texelFetch(repair_texture, first).x, 0.0);
    for (int i = 1; i < HAIR_REPAIR_CONTROLS; ++i)
        max_value.x = max(max_value.x, length(texelFetch(repair_texture, first + i).xyz));
#endif
    return max_value;
}

// Return the maximum of a curve between two t. A curve never exceeds its neighbouring samples.
float max_of(int curve, float from, float to)
{
    int   last = int(ceil(to * float(HAIR_CURVE_INTERVALS)));
    float max_value = 0.0;
    for (int k = int(from * float(HAIR_CURVE_INTERVALS)); k <= last; ++k)
        max_value = max(max_value, given[curve][k]);
    return max_value;
}

// Return a bound of the distance between a follower and its guides between two t, m.
float find_beside(hair_follower f, float length_, float freed, float from, float to)
{
    float offset = 0.0, clump = max(max_of(HAIR_CURVE_CLUMP, from, to), freed);
    for (int i = 0; i < 4; ++i) offset = max(offset, length(f.offset[i].xyz));
    vec2  own    = random_pair(f.seed + 1u); // See stray() in strands/look.glsl.
    float strays = 0.0;
    if (own.x < draw.strand.tip_stray_fraction) strays += max_of(HAIR_CURVE_TIP_STRAY, from, to);
    if (own.y < draw.strand.stray_fraction) strays += max_of(HAIR_CURVE_STRAY, from, to);
    offset *= (1.0 - f.multi * (1.0 - clump)) * max_of(HAIR_CURVE_CLUMP_WIDTH, from, to);
    if (f.multi > 0.0) offset += length(vec3(f.offset[1].w, f.offset[2].w, f.offset[3].w));
    return offset + DIAGONAL * strays * length_ + draw.strand.max_offset;
}

// Enlarge the box of a part by the box of a guide's part, widened by `by`.
void widen(uint part, uint guide, float by)
{
    uint  at = 2u * (guide * HAIR_OCCLUSION_PARTS + part);
    uvec3 low = to_float_key(box[at].xyz - by), high = ~to_float_key(box[at + 1u].xyz + by);
    for (int k = 0; k < 3; ++k) {
        atomicMin(lower[part][k], low[k]);
        atomicMin(upper[part][k], high[k]);
    }
}

// Enlarge the boxes of all parts by a follower. A follower lies where its guides are, as far as
// they reach, except for its bounded offset. Beyond their tips it goes on straight.
void widen(uint number, float thickness)
{
    hair_follower f       = fetch_whole(number);
    vec3          repair  = find_repair(number);
    float length_ =
        GIVE * f.length_ratio * box[2u * (f.guide0 * HAIR_OCCLUSION_PARTS + HAIR_OCCLUSION_PARTS) - 1u].w;
    float last = f.length_ratio * (1.0 + repair.y),
          each = 1.0 / (float(HAIR_OCCLUSION_PARTS) * f.length_ratio);
    for (uint part = 0u; part < HAIR_OCCLUSION_PARTS; ++part) {
        bool  ends = part == HAIR_OCCLUSION_PARTS - 1u;
        float from = float(part) * each, to = ends ? 1.0 : min(from + each, 1.0);
        if (float(part) > last * float(HAIR_OCCLUSION_PARTS)) break;
        float by = find_beside(f, length_, repair.z, min(from, 0.999), to) + repair.x +
                   hide.thick * thickness * f.offset[0].w;
        if (ends) by += length_ * (1.0 + repair.y) * max(1.0 - 1.0 / last, 0.0);
        widen(part, f.guide0, by);
        if (f.multi > 0.0) widen(part, f.guide1, by);
        if (f.multi > 0.0) widen(part, f.guide2, by);
    }
}

// Return whether the texels of this thread show that a box is occluded. The texels are in a level
// of which the box covers few. A box is visible if it crosses the plane of the eye, is partly
// outside the texture, or is not finite.
bool is_occluded(vec3 low, vec3 high, int turn)
{
    vec2  from = vec2(NOWHERE), to = vec2(-NOWHERE);
    float near = NOWHERE;
    for (int i = 0; i < 8; ++i) {
        vec4 at = hide.to_texture * vec4(mix(low, high, notEqual(i & ivec3(1, 2, 4), ivec3(0))), 1.0);
        if (!(at.w > 0.0)) return false;
        from = min(from, at.xy / at.w);
        to   = max(to, at.xy / at.w);
        near = min(near, at.z / at.w);
    }
    vec2 beside = vec2(hide.beside_x, hide.beside_y),
         texels = vec2(hide.width, hide.height) / float(HAIR_HIZ_FIRST);
    from = hide.clips != 0u ? max(from - beside, 0.0) : from - beside;
    to   = hide.clips != 0u ? min(to + beside, 1.0) : to + beside;
    if (!(all(greaterThanEqual(from, vec2(0.0))) && all(lessThanEqual(to, vec2(1.0))) &&
          all(lessThan(from, to))))
        return false;
    ivec2 first = ivec2(hide.first_x, hide.first_y), max_value = ivec2(ceil(texels)) - 1;
    ivec2 a = min(ivec2(from * texels), max_value) - first, b = min(ivec2(to * texels), max_value) - first;
    hiz_level level = first_level();
    if (any(lessThan(a, ivec2(0))) || any(greaterThanEqual(b, level.size))) return false;
    for (uint k = 1u; k < hide.levels && any(greaterThanEqual(b - a, ivec2(HAIR_HIZ_TEXELS))); ++k) {
        level = next_level(level);
        a /= HAIR_HIZ_NEXT, b /= HAIR_HIZ_NEXT;
    }
    float far = -NOWHERE;
    ivec2 count = b - a + 1;
    for (int k = turn; k < count.x * count.y; k += TURNS)
        far = max(far, farthest[level.first + (a.y + k / count.x) * level.size.x + a.x + k % count.x]);
    return near < NOWHERE && min(near, hide.max_size) > far + hide.slack;
}

void main()
{
    uint number = hair_group(), i = gl_LocalInvocationID.x;
    if (number >= uint(patches.length())) return;
    if (i < HAIR_OCCLUSION_PARTS)
        for (int k = 0; k < 3; ++k) lower[i][k] = upper[i][k] = 0xffffffffu;
    if (i == 0u) seen = 0u;
    for (uint k = i; k < HAIR_CURVES * (HAIR_CURVE_INTERVALS + 1u); k += HAIR_GROUP_SIZE)
        given[k % HAIR_CURVES][k / HAIR_CURVES] =
            curve_at(int(k % HAIR_CURVES), float(k / HAIR_CURVES) / float(HAIR_CURVE_INTERVALS)).x;
    synchronise();
    float thickness = dot(patches[number].map_thickness, draw.map_weights);
    for (uint k = i; k < patches[number].count; k += HAIR_GROUP_SIZE)
        widen(patches[number].first + k, thickness);
    synchronise();
    uint  part = i / TURNS;
    uvec3 low = uvec3(lower[part][0], lower[part][1], lower[part][2]);
    uvec3 high = ~uvec3(upper[part][0], upper[part][1], upper[part][2]);
    bool  there = low.x <= high.x;
    if (there && !is_occluded(from_float_key(low), from_float_key(high), int(i % TURNS))) atomicOr(seen, 1u);
    synchronise();
    if (i == 0u) patches[number].occluded = 1u - seen;
}
