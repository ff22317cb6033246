// follower.glsl - where a follower is (shared.h says how it is made of guides). Reads the smoothed guides and the
// followers as textures; with HAIR_STORED as storage buffers, which a GPU reads several times as fast, but which stages
// that draw are not promised. What draws evaluates followers by evaluate.glsl.
#include "rotation.glsl"
#include "random.glsl"
#include "draw_params.glsl"

#ifdef HAIR_STORED
layout(std430, binding = HAIR_BIND_STORED_POSITION) readonly restrict buffer position_buffer { vec4 stored_position[]; };
layout(std430, binding = HAIR_BIND_STORED_TANGENT) readonly restrict buffer tangent_buffer { vec4 stored_tangent[]; };
layout(std430, binding = HAIR_BIND_STORED_FRAME) readonly restrict buffer frame_buffer { vec4 stored_frame[]; };
layout(std430, binding = HAIR_BIND_STORED_FOLLOWER) readonly restrict buffer follower_buffer {
    hair_follower stored_follower[];
};

vec4          fetch_position(int at) { return stored_position[at]; }
vec4          fetch_tangent(int at) { return stored_tangent[at]; }
vec4          fetch_turn(int at) { return stored_frame[at]; }
hair_follower fetch_follower(uint number) { return stored_follower[number]; }
#else
#include "position_texture.glsl"
layout(binding = HAIR_UNIT_TANGENT) uniform samplerBuffer tangent_texture;
layout(binding = HAIR_UNIT_FRAME) uniform samplerBuffer frame_texture;
layout(binding = HAIR_UNIT_FOLLOWER) uniform usamplerBuffer follower_texture;

vec4 fetch_position(int at) { return texelFetch(position_texture, at); }
vec4 fetch_tangent(int at) { return texelFetch(tangent_texture, at); }
vec4 fetch_turn(int at) { return texelFetch(frame_texture, at); }

hair_follower fetch_follower(uint number)
{
    int           at = int(number) * HAIR_FOLLOWER_TEXELS;
    hair_follower follower;
    uvec4         ids   = texelFetch(follower_texture, at);
    vec4          reals = uintBitsToFloat(texelFetch(follower_texture, at + 1));
    follower.guide0 = ids.x, follower.guide1 = ids.y, follower.guide2 = ids.z, follower.seed = ids.w;
    follower.weight1 = reals.x, follower.weight2 = reals.y, follower.length_ratio = reals.z, follower.multi = reals.w;
    for (int i = 0; i < 4; ++i) follower.offset[i] = uintBitsToFloat(texelFetch(follower_texture, at + 2 + i));
    return follower;
}
#endif

struct hair_point {
    vec3  position; // m, from the head's origin
    vec3  tangent;  // unit
    float radius;   // m
};

struct guide_point {
    vec3  position, tangent;
    float to_root; // m, along the guide
};

struct guide_place { // between a sample of a smoothed guide and the next
    int   at;
    float share;
};

guide_place find_place(uint number, float u)
{
    float along = min(u, 1.0) * float(draw.smooth_vertices - 1u);
    int   k     = min(int(along), int(draw.smooth_vertices) - 2);
    return guide_place(int(number * draw.smooth_vertices) + k, along - float(k));
}

// Beyond its tip (u > 1) a guide goes on straight. `beyond`: it may; else its place needs no tangents.
guide_point fetch_guide(uint number, float u, bool beyond)
{
    guide_place place = find_place(number, u);
    vec4        a     = fetch_position(place.at);
    vec4        b     = fetch_position(place.at + 1);
    vec3        ta    = fetch_tangent(place.at).xyz;
    vec3        tb    = fetch_tangent(place.at + 1).xyz;
    vec4        p     = mix(a, b, place.share);
    vec3        t     = direction_or(mix(ta, tb, place.share), ta);
    float       more  = max(u - 1.0, 0.0) * b.w;
    return beyond ? guide_point(p.xyz + more * t, t, p.w + more) : guide_point(p.xyz, t, p.w);
}

vec4 fetch_frame(uint number, float u)
{
    guide_place place = find_place(number, u);
    vec4        a     = fetch_turn(place.at);
    vec4        b     = fetch_turn(place.at + 1);
    return normalize(mix(a, dot(a, b) < 0.0 ? -b : b, place.share));
}

// The strand's own smooth deviation across it, growing from the root, as a share of the length.
vec2 deviation(uint seed, float t)
{
    vec4 r = vec4(random(seed), random(seed + 1u), random(seed + 2u), random(seed + 3u));
    vec2 waves = sin(6.2831853 * (r.xy + t * (0.6 + 1.4 * r.zw)));
    return draw.frizz * t * sqrt(t) * (0.3 + 2.2 * r.w * r.w) * waves;
}

// What is done at t to a follower that meets a solid.
struct repair {
    vec3  away, away_slope;   // how far it is moved, m, and slope by t
    float freed, freed_slope; // share to which it is freed of all guides but its own
};
const repair UNTOUCHED = repair(vec3(0.0), vec3(0.0), 0.0, 0.0);

// Beyond t = 1 straight on. `beyond`: the follower may be longer than its guides.
hair_point interpolate(hair_follower follower, float t, repair r, bool beyond)
{
    float       u     = t * follower.length_ratio;
    float       v     = min(t, 1.0);
    guide_point g0    = fetch_guide(follower.guide0, u, beyond);
    vec4        frame = fetch_frame(follower.guide0, u);
    float       s     = 1.0 - v;

    vec3 offset = s * s * s * follower.offset[0].xyz + 3.0 * s * s * v * follower.offset[1].xyz +
                  3.0 * s * v * v * follower.offset[2].xyz + v * v * v * follower.offset[3].xyz;
    vec3 slope = 3.0 * (s * s * (follower.offset[1].xyz - follower.offset[0].xyz) +
                        2.0 * s * v * (follower.offset[2].xyz - follower.offset[1].xyz) +
                        v * v * (follower.offset[3].xyz - follower.offset[2].xyz));
    float length_ = max(g0.to_root / max(t, 1e-3), 1e-6); // Of this strand: the guide has come so far at t.
    vec2  wave    = deviation(follower.seed, v) * length_;
    offset.xz += wave;

    vec3 position = g0.position + rotate(frame, offset);
    vec3 tangent  = g0.tangent + (rotate(frame, slope) + r.away_slope) / length_;

    // Multi-strand at the root, single-strand where it clumps.
    float clumped = follower.multi * (1.0 - draw.clump * smoothstep(0.1, 1.0, v));
    float multi   = clumped * (1.0 - r.freed);
    if (multi > 0.0) {
        guide_point g1 = fetch_guide(follower.guide1, u, beyond);
        guide_point g2 = fetch_guide(follower.guide2, u, beyond);
        float       w1 = follower.weight1, w2 = follower.weight2, w0 = 1.0 - w1 - w2;
        vec3        own     = vec3(follower.offset[1].w, follower.offset[2].w, follower.offset[3].w);
        vec3        blended = w0 * g0.position + w1 * g1.position + w2 * g2.position +
                       rotate(frame, own + vec3(wave.x, 0.0, wave.y));
        tangent  = mix(tangent, w0 * g0.tangent + w1 * g1.tangent + w2 * g2.tangent, multi);
        tangent -= clumped * r.freed_slope / length_ * (blended - position);
        position = mix(position, blended, multi);
    }
    float taper = mix(1.0, draw.tip_radius, v * v);
    return hair_point(position + r.away, direction_or(tangent, g0.tangent), draw.radius * follower.offset[0].w * taper);
}

hair_point interpolate(hair_follower follower, float t, repair r) { return interpolate(follower, t, r, true); }
