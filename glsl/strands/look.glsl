// look.glsl - deviations of a strand by its look: curves along it, strays, kinks and curls, as
// offsets across the strand in its guide's frame. Kinks, curls and cuts need HAIR_STYLED.
#include "draw_params.glsl"
#include "random.glsl"
#include "strands/group_look.glsl"
#include "strands/spline.glsl"
#include "strands/strand_factors.glsl"

// Intervals of a stray over the length.
#define STRAY_WAVES 6.0
// Intervals over which a curl changes along the strand.
#define CURL_WAVES 8.0

// Return value and derivative by t of a curve at t in [0, 1].
vec2 curve_at(int curve, float t)
{
    float at = t * float(HAIR_CURVE_INTERVALS);
    int   k  = min(int(at), HAIR_CURVE_INTERVALS - 1);
    float x  = at - float(k);
    vec4  c  = draw.strand.curve[curve * HAIR_CURVE_INTERVALS + k];
    return vec2(c.x + x * (c.y + x * (c.z + x * c.w)),
                float(HAIR_CURVE_INTERVALS) * (c.y + x * (2.0 * c.z + 3.0 * x * c.w)));
}

struct aside {
    vec2 at;    // Offset along x and z of the frame, m.
    vec2 slope; // Derivative by t.
};

aside scaled(aside a, vec2 curve) { return aside(curve.x * a.at, curve.x * a.slope + curve.y * a.at); }

// Return two random numbers in [0, 1).
vec2 random_pair(uint seed)
{
    uint h = hash(seed);
    return vec2(h & 0xffffu, h >> 16) * (1.0 / 65536.0);
}

// Return a point of a smooth random path within the square [-1, 1]^2. It is a B-spline of random
// control points, with `waves` intervals for t from 0 to 1.
aside wander(uint seed, float t, float waves)
{
    float  along = t * waves, k = floor(along);
    mat4x2 control;
    for (uint i = 0u; i < 4u; ++i) control[i] = unpackSnorm2x16(hash(seed + uint(k) + i));
    return aside(control * spline(along - k), waves * (control * spline_slope(along - k)));
}

aside stray(uint seed, float t, float length_)
{
    vec2 own = random_pair(seed + 1u), by = vec2(0.0);
    if (own.x < draw.strand.tip_stray_fraction) by += curve_at(HAIR_CURVE_TIP_STRAY, t);
    if (own.y < draw.strand.stray_fraction) by += curve_at(HAIR_CURVE_STRAY, t);
    if (by == vec2(0.0)) return aside(vec2(0.0), vec2(0.0));
    return scaled(wander(seed + 16u, t, STRAY_WAVES), length_ * by);
}

#ifdef HAIR_STYLED
// Return the offset of a kinked strand. Its seed is a third of the 32-bit range away from that of
// strays, which have few control points.
aside kink(uint group, uint seed, float t, float length_)
{
    if (random_pair(seed + 4u).x >= draw.strand.frizz_fraction) return aside(vec2(0.0), vec2(0.0));
    return scaled(wander(seed + 0x55555555u, t, length_ * draw.strand.kinks),
                  GROUP_FACTOR(group, frizz) * STRAND_FACTOR(HAIR_FACTOR_FRIZZ) *
                      curve_at(HAIR_CURVE_FRIZZ, t));
}

// Return the offset of a curl. Turns that are shorter along the strand have a smaller radius.
// Strands of a guide share its phase and its variation, and drift apart by their own length of
// turns. `ratio` is the length of the strand in lengths of the guide. The variation depends on the
// distance from the root, so that long and short strands of a lock turn together.
aside curl(uint group, uint guide, uint seed, float t, float length_, float ratio)
{
    vec2  lock = random_pair(guide), own = random_pair(seed + 2u);
    float spread = draw.strand.curl_spread * (2.0 * own.y - 1.0);
    float shared_spread = draw.strand.curl_guide_spread * (2.0 * random_pair(guide + 0x2aaaaaaau).x - 1.0);
    float size   = (1.0 + spread) * (1.0 + shared_spread);
    float turns  = GROUP_FACTOR(group, curl_turns) * STRAND_FACTOR(HAIR_FACTOR_CURL_TURNS) *
                   (length_ * draw.strand.curl_waves + draw.strand.curl_turns) / size;
    float places = float(HAIR_TURN_PLACES);
    aside wind   = scaled(wander(64u * guide + 0x71c71c71u, t * ratio, CURL_WAVES),
                          vec2(draw.strand.curl_variation, 0.0));
    wind.slope *= ratio;
    float slower = turns / (max(ratio, 1e-3) * CURL_WAVES);
    float at = places * fract(t * turns + slower * wind.at.x + draw.strand.curl_guide_phase * lock.x +
                              draw.strand.curl_strand_phase * own.x);
    int   k  = min(int(at), HAIR_TURN_PLACES - 1);
    float x  = at - float(k);
    mat2x4 c = mat2x4(draw.strand.loop[k], draw.strand.loop[HAIR_TURN_PLACES + k]);
    if (lock.y < draw.strand.curl_left_fraction) c[1] = -c[1];
    aside a = aside(vec4(1.0, x, x * x, x * x * x) * c,
                    (turns + slower * wind.slope.x) * places * (vec4(0.0, 1.0, 2.0 * x, 3.0 * x * x) * c));
    a = scaled(a, GROUP_FACTOR(group, curl_radius) * STRAND_FACTOR(HAIR_FACTOR_CURL_RADIUS) *
                      draw.strand.curl_radius * size * curve_at(HAIR_CURVE_CURL, t));
    return scaled(a, vec2(1.0 + wind.at.y, wind.slope.y));
}

// Cut a follower to the fraction of its length that is drawn. The offsets' curve is cut by de
// Casteljau's algorithm.
void cut(inout hair_follower follower)
{
    float fraction = draw.strand.drawn * (1.0 - draw.strand.length_variation * random(follower.seed + 3u));
    vec3 a = follower.offset[0].xyz, b = follower.offset[1].xyz, c = follower.offset[2].xyz,
         d = follower.offset[3].xyz;
    vec3  ab = mix(a, b, fraction), bc = mix(b, c, fraction), cd = mix(c, d, fraction);
    vec3  abc = mix(ab, bc, fraction), bcd = mix(bc, cd, fraction);
    follower.offset[1].xyz = ab;
    follower.offset[2].xyz = abc;
    follower.offset[3].xyz = mix(abc, bcd, fraction);
    follower.length_ratio *= fraction;
    if (follower.multi < 0.0) follower.multi *= fraction;
}
#endif

// Return the offset by which the look moves a follower. `length_` is its length, in m.
aside find_aside(hair_follower follower, float t, float length_)
{
    uint  guide = follower.guide0, seed = follower.seed, group = group_of(follower);
    float ratio = follower.length_ratio;
    aside a     = stray(seed, t, length_);
#ifdef HAIR_STYLED
    aside kinked = kink(group, seed, t, length_), curled = curl(group, guide, seed, t, length_, ratio);
    a = aside(a.at + kinked.at + curled.at, a.slope + kinked.slope + curled.slope);
#endif
    return a;
}
