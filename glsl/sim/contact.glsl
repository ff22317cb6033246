// contact.glsl - what solids make of a displacement: out of them, and held by friction as far as Coulomb allows.
//
// The reaction of a solid is what is done minus what is wanted. Its part along the normal may only push; its part
// along the surface is at most `friction` times that, and against the slip. Where that suffices there is no slip at
// all: a strand at rest does not creep.
//
// A root that is held nearer to solids than the margin, or in one, leaves what follows it no way out that is as long
// as it is: there a vertex may be as deep as its root, less a fifth of its distance from it.
#include "sim/solids.glsl"

#define FREE 0.0
#define SLIDES 1.0
#define GLIDES 2.0 // between two solids, along both
#define STICKS 3.0
#define STICK_PASS 0.1 // see pass_on
#define EMERGE 1.0     // m/s, and in a substep half a segment at most, for lengths to be found
#define RISE 0.2       // of a vertex out of where its root is, by its distance from that

OWN(vec4, touch);      // xyz: normal, of GLIDES the way it can go; w: FREE to STICKS
OWN(uvec2, reachable); // solids, one bit each,
OWN(uvec2, met);       // and those met in this substep
float share_then, share_now; // of the step that is done at the substep's start and end
float sunk;                  // how deep in solids the root is held. m

struct capsule { // a solid at one moment
    vec3  start, axis;
    float radius;
};

capsule solid_at(uint k, float share)
{
    vec4 a = mix(SOLID_START(k, 0), SOLID_END(k, 0), share);
    vec4 b = mix(SOLID_START(k, 1), SOLID_END(k, 1), share);
    return capsule(a.xyz, b.xyz - a.xyz, a.w + params.margin);
}

float nearest_share(vec3 position, capsule solid)
{
    return clamp(dot(position - solid.start, solid.axis) / max(dot(solid.axis, solid.axis), 1e-12), 0.0, 1.0);
}

vec3 from_axis(vec3 position, capsule solid)
{
    return position - solid.start - nearest_share(position, solid) * solid.axis;
}

// How far the axis of a solid moves in this substep, at most.
float swept_by(uint k, capsule now)
{
    capsule then = solid_at(k, share_then);
    vec3    start = now.start - then.start;
    return max(length(start), length(start + now.axis - then.axis));
}

// How deep a vertex may be; and how far it comes out in a substep if it was deeper.
vec2 granted_to(uint i)
{
    float rise = min(EMERGE * params.gravity.w, 0.5 * guide_length / float(guide_count - 1u));
    return vec2(max(sunk - RISE * length(GET(place)), 0.0), rise);
}

// How deep in one solid the displacement d from `start`, both from the head's origin, leads; below 0: how far off it
// stays. And the normal there, and what the surface does. A vertex that goes right through is stopped where it goes in.
float depth_in(uint k, vec3 start, vec3 d, vec3 head_moved, vec2 granted, out vec3 normal, out vec3 surface)
{
    capsule now = solid_at(k, share_now), then = solid_at(k, share_then);
    vec3    end = start + d - head_moved;
    vec3    out_a = from_axis(start, then), out_b = from_axis(end, now), pass = out_b - out_a;
    float   away  = length(out_b);
    float   depth = now.radius - away;
    normal        = away > 1e-9 ? out_b / away : vec3(0.0, 1.0, 0.0);
    float a = dot(pass, pass), b = dot(out_a, pass), c = dot(out_a, out_a) - now.radius * now.radius, root = b * b - a * c;
    if (c > 0.0 && b < 0.0 && root > 0.0 && dot(out_b, out_a) < 0.0) {
        normal = normalize(out_a + pass * ((-b - sqrt(root)) / a));
        depth  = now.radius - dot(normal, out_b);
    }
    depth -= max(then.radius - length(out_a) - granted.y, granted.x);
    float along = nearest_share(end, now);
    surface     = head_moved + (now.start - then.start) + along * (now.axis - then.axis) +
              cross(SOLID_SPIN(k).xyz * (share_now - share_then), normal * now.radius);
    return depth;
}

// The freedom that a further contact leaves of what others do.
vec4 left_of(vec4 freedom, vec3 normal)
{
    if (freedom.w == FREE) return vec4(normal, SLIDES);
    vec3  way = freedom.w == SLIDES ? cross(freedom.xyz, normal) : freedom.xyz;
    float l   = length(way);
    return l > 0.1 && freedom.w != STICKS ? vec4(way / l, GLIDES) : freedom;
}

#ifdef HAIR_BODIES
#include "sim/body.glsl"
#endif

float root_depth_in(uint k, bool is_body)
{
#ifdef HAIR_BODIES
    if (is_body) return depth_of_place(k, root_now);
#endif
    capsule solid = solid_at(k, share_now);
    return solid.radius - length(from_axis(root_now, solid));
}

// Out of one solid by the depth, and held by its friction.
uint push_from(uint word, uint bit, float factor, float depth, vec3 normal, vec3 surface, uvec2 kept, inout vec3 d,
          inout vec4 freedom, inout uvec2 met)
{
    if (depth <= 0.0 && (kept[word] & bit) == 0u) return 0u;
    vec3 slip = d - surface;
    slip -= dot(slip, normal) * normal;
    float speed = length(slip), grip = params.friction * factor * max(depth, 0.0);
    bool  stuck = speed <= grip;
    d += depth * normal - (stuck ? slip : slip * (grip / speed));
    freedom = stuck ? vec4(normal, STICKS) : left_of(freedom, normal);
    met[word] |= bit;
    return 1u;
}

uvec2 first_of(uvec2 bits) { return bits.x != 0u ? uvec2(0u, bits.x & -bits.x) : uvec2(1u, bits.y & -bits.y); }

// One loop for both words: a software rasteriser goes once through what is in one that nobody enters.
#define EACH_BIT(bits)                                                                                       \
    for (uvec2 left = bits, at = first_of(left); at.y != 0u; left[at.x] &= ~at.y, at = first_of(left))

#ifdef HAIR_ANY
#include "sim/contact_any.glsl"
#else
#include "sim/contact_few.glsl"
#endif

// What solids make of what is wanted, and what freedom they leave. Those in `kept` hold the vertex even where they
// would have to pull. Out of a second solid may lead into the first: then out of them once more.
vec3 allowed(uint i, vec3 want, uvec2 solids, uvec2 kept, vec3 head_moved, out vec4 freedom, inout uvec2 met)
{
    vec3 d     = want;
    vec3 start = root_now - root_moved + head_moved + GET(place);
    freedom    = vec4(0.0, 0.0, 0.0, FREE);
    uint contacts = 2u;
    for (uint n = 0u; n < 2u && contacts > 1u; ++n) { // In a loop, so that a compiler need not make so much of it twice.
#ifdef HAIR_ANY
        uvec2 tried = enough(i, start, start + d - head_moved);
        contacts    = push_out(i, start, tried | kept, kept, head_moved, d, freedom, met);
        if (tried != enough(i, start, start + d - head_moved)) contacts = 2u; // It was led to others.
#else
        contacts = push_out(i, start, solids, kept, head_moved, d, freedom, met);
#endif
    }
    return d;
}

// The part of a displacement that a contact lets pass. What sticks passes on a little, so that lengths between what
// sticks can be found: by a tension that grows until something slips.
vec3 pass_on(vec4 freedom, vec3 d)
{
    vec3 part = dot(d, freedom.xyz) * freedom.xyz;
    return freedom.w == FREE ? d : freedom.w == SLIDES ? d - part : freedom.w == GLIDES ? part : STICK_PASS * (d - part);
}
