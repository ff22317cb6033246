// strand.glsl - a vertex of a drawn strand: its position, its width and, where colour is drawn, its
// colour. Shading runs per vertex and not per sample of a pixel, because light changes slowly along
// a strand and not at all across it.

// First, because a file is inserted at its first mention, even in a branch that is left out.
#include "strands/follower.glsl"
#include "strands/packed.glsl"
#include "eye.glsl"
#ifdef HAIR_VERTEX_CACHE
#include "draw/vertex_cache.glsl"
#else
#include "strands/evaluate.glsl"
#endif
#ifdef HAIR_WIDENED
#include "strands/lod_contract.glsl"
#endif
#define HAIR_OF_VERTICES 1
#include "light/shading.glsl"

struct strand_vertex {
    vec4  position; // xyz: m, from the head's origin. w: radius, m.
    vec3  tangent;  // Unit.
    vec3  color;
    uvec3 numbers; // See draw/varyings.glsl.
    vec3  place;
    vec3  before; // Position in the previous frame.
};

#ifdef HAIR_ROOT_UV
layout(binding = HAIR_UNIT_UV) uniform samplerBuffer uv_texture;
layout(binding = HAIR_UNIT_COLOR) uniform sampler2D color_texture;
#endif

#ifdef HAIR_GROOM_COLORS
layout(binding = HAIR_UNIT_GROOM_COLOR) uniform samplerBuffer groom_color_texture;

// Return the colour before random variation: the look's ramp, blended with the groom's colour,
// which wetness may darken. Alpha is 1 where a group's colour replaces both.
vec3 color_at(uint number, float t)
{
    float along = t * float(HAIR_CURVE_INTERVALS);
    int k = min(int(along), HAIR_CURVE_INTERVALS - 1), at = int(number) * (HAIR_CURVE_INTERVALS + 1) + k;
    vec4 own = mix(texelFetch(groom_color_texture, at), texelFetch(groom_color_texture, at + 1),
                   along - float(k));
    return mix(ramp_at(t), pow(max(own.rgb, 0.0), vec3(draw.tint.groom_color_power)),
               mix(draw.tint.groom_color, 1.0, own.a));
}
#else
vec3 color_at(uint number, float t) { return ramp_at(t); }
#endif

hair_fragment fragment_of(hair_follower follower, uint number, uint cached, hair_point point, float t)
{
    hair_fragment f;
    f.position = point.position;
    f.tangent  = point.tangent;
    f.to_eye   = normalize(towards_eye(draw.eye, point.position));
    f.t        = t;
    f.random   = random(follower.seed + 7u);
    f.seed     = follower.seed;
    f.lock     = follower.guide0;
    f.group    = group_of(follower);
    f.strand   = number;
    f.cached   = cached;
    f.uv       = vec2(0.0);
    f.across   = 0.0;
    f.color    = tint_of(f.seed, f.lock, whole_t(t), f.random, color_at(number, whole_t(t)));
#ifdef HAIR_ROOT_UV
    f.uv = texelFetch(uv_texture, int(number)).xy;
    if (draw.textured != 0u) f.color *= textureLod(color_texture, f.uv, 0.0).rgb;
#endif
    return f;
}

// Return the colour of a vertex, or only its reflectance if the application's shader runs per
// pixel.
vec3 shade(hair_fragment f)
{
#ifdef HAIR_USER_PIXELS
    return f.color;
#elif defined(HAIR_USER_VERTICES)
    return hair_shade(f).rgb;
#else
    return hair_shade(f);
#endif
}

// Return t of the k-th vertex of a strand with a number of segments that may end in a fraction.
float place_of(uint k, float segments) { return min(float(k) / segments, 1.0); }

#ifdef HAIR_SHADED
layout(binding = HAIR_UNIT_SHADED) uniform samplerBuffer shaded_texture;
#endif

// Return a vertex of a strand. `cached` is the number of the strand in the vertex cache. `width` is
// a factor of its own width. `widened` is the factor in `width` that compensates for strands that
// are left out, 1 or more.
strand_vertex strand_at(uint number, uint cached, float t, float width, float widened)
{
    hair_follower follower = fetch_follower(number);
    hair_point    point    = evaluate(follower, number, t);
    vec3          moved = vec3(0.0), tangent = point.tangent;
#ifdef HAIR_WIDENED
    if (widened > 1.0) moved = gather(follower, whole_t(t), point.radius * (widened - 1.0), point);
#endif
    strand_vertex v;
    v.position = vec4(point.position, point.radius * width);
    v.tangent  = point.tangent;
    v.color    = vec3(0.0);
#ifdef HAIR_IDS
    v.numbers = uvec3(number, follower.guide0, follower.seed);
#else
    v.numbers = uvec3(number, pack_lock(follower), follower.seed);
#endif
    v.place    = vec3(t, 0.0, 0.0);
    v.before   = point.position;
#ifdef HAIR_SHADED
    v.color =
        texelFetch(shaded_texture, int(number * (draw.segments + 1u) + uint(t * float(draw.segments) + 0.5)))
            .rgb;
#else
    if (draw.colored != 0u) {
        // A wider strand stands for others, which point as this one did before it moved.
        point.tangent   = tangent;
        hair_fragment f = fragment_of(follower, number, cached, point, t);
        v.color         = shade(f);
        v.place.yz      = f.uv;
    }
#endif
#ifdef HAIR_MOTION
    v.before = before_at(number, t) + moved;
#endif
    return v;
}
