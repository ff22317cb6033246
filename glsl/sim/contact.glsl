// contact.glsl - what solids make of a displacement: out of them, and held by friction as far as Coulomb allows.
//
// The reaction of a solid is what is done minus what is wanted. Its part along the normal may only push; its part
// along the surface is at most `friction` times that, and against the slip. Where that suffices there is no slip at
// all: a strand at rest does not creep.
#define FREE 0.0
#define SLIDES 1.0
#define GLIDES 2.0 // between two solids, along both
#define STICKS 3.0
#define STICK_PASS 0.1 // see pass_on
#define EMERGE 1.0     // m/s

OWN(vec4, touch);      // xyz: normal, of GLIDES the way it can go; w: FREE to STICKS
OWN(uvec2, reachable); // solids, one bit each,
OWN(uvec2, met);       // and those met in this substep
float share_then, share_now; // of the step that is done at the substep's start and end

struct capsule { // a solid at one moment
    vec3  start, axis;
    float radius;
};

capsule solid_at(uint k, float share)
{
    vec4 a = mix(params.solid[k].start[0], params.solid[k].end[0], share);
    vec4 b = mix(params.solid[k].start[1], params.solid[k].end[1], share);
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

// The solids that the guide can touch in this substep, of them those that a vertex can: others are not looked at
// again. A vertex is taken to be moved by the fitting of lengths no more than 2 cm farther than it would go freely.
void find_solids(vec3 head_moved)
{
    if (!SOLIDS) return;
    uvec2 near    = uvec2(0u);
    float longest = guide_length + length(root_moved - head_moved) + 0.02;
    if (root_is_free || TIED) longest = 2.0 * FARTHEST; // What the scalp does not hold, or not alone, may be anywhere.
    for (uint k = lane; k < params.solids; k += lanes) {
        capsule solid = solid_at(k, share_now);
        if (length(from_axis(root_now, solid)) < solid.radius + longest + swept_by(k, solid))
            near[k / 32u] |= 1u << (k % 32u);
    }
    near = all_bits(near);
    EACH(guide_count) {
        own(reachable) = own(met) = uvec2(0u);
        if (own(slack) > 0.0) {
            vec3  position = root_now + GET(place) + own(wanted) - root_moved;
            float reach    = 0.02 + length(own(wanted) - head_moved);
            for (int word = 0; word < 2; ++word)
                for (uint bits = near[word]; bits != 0u; bits &= bits - 1u) {
                    uint    k     = 32u * uint(word) + uint(findLSB(bits));
                    capsule solid = solid_at(k, share_now);
                    if (length(from_axis(position, solid)) < solid.radius + reach + swept_by(k, solid))
                        own(reachable)[word] |= bits & -bits;
                }
        }
    }
}

// How deep in one solid the displacement d from `start`, both from the head's origin, leads; below 0: how far off it
// stays. And the normal there, and what the surface does. A vertex that goes right through is stopped where it goes in.
float depth_in(uint k, vec3 start, vec3 d, vec3 head_moved, out vec3 normal, out vec3 surface)
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
    // What was inside already comes out no faster than this.
    depth -= max(then.radius - length(out_a) - EMERGE * params.gravity.w, 0.0);
    float along = nearest_share(end, now);
    surface     = head_moved + (now.start - then.start) + along * (now.axis - then.axis) +
              cross(params.solid[k].spin.xyz * (share_now - share_then), normal * now.radius);
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

// Out of one solid after the other, capsules first; returns of how many.
uint push_out(vec3 start, uvec2 solids, uvec2 kept, vec3 head_moved, inout vec3 d, inout vec4 freedom, inout uvec2 met)
{
    uint  contacts = 0u;
#ifdef HAIR_BODIES
    uvec2 bodies = uvec2(params.bodies0, params.bodies1);
#else
    const uvec2 bodies = uvec2(0u);
#endif
    vec3  normal, surface;
    for (uint word = 0u; word < 2u; ++word)
        for (uint bits = solids[word] & ~bodies[word]; bits != 0u; bits &= bits - 1u) {
            uint  k     = 32u * word + uint(findLSB(bits));
            float depth = depth_in(k, start, d, head_moved, normal, surface);
            contacts += push_from(word, bits & -bits, params.body[k].position[1].w, depth, normal, surface, kept, d, freedom, met);
        }
#ifdef HAIR_BODIES
    for (uint word = 0u; word < 2u; ++word)
        for (uint bits = solids[word] & bodies[word]; bits != 0u; bits &= bits - 1u) {
            uint  k     = 32u * word + uint(findLSB(bits));
            float depth = depth_in_body(k, start, start + d - head_moved, head_moved, normal, surface);
            contacts += push_from(word, bits & -bits, params.body[k].position[1].w, depth, normal, surface, kept, d, freedom, met);
        }
#endif
    return contacts;
}

// What solids make of what is wanted, and what freedom they leave. Those in `kept` hold the vertex even where they
// would have to pull. Out of a second solid may lead into the first: then out of them once more.
vec3 allowed(uint i, vec3 want, uvec2 solids, uvec2 kept, vec3 head_moved, out vec4 freedom, inout uvec2 met)
{
    vec3 d     = want;
    vec3 start = root_now - root_moved + head_moved + GET(place);
    freedom    = vec4(0.0, 0.0, 0.0, FREE);
    if (push_out(start, solids, kept, head_moved, d, freedom, met) > 1u)
        push_out(start, solids, kept, head_moved, d, freedom, met);
    return d;
}

// The part of a displacement that a contact lets pass. What sticks passes on a little, so that lengths between what
// sticks can be found: by a tension that grows until something slips.
vec3 pass_on(vec4 freedom, vec3 d)
{
    vec3 part = dot(d, freedom.xyz) * freedom.xyz;
    return freedom.w == FREE ? d : freedom.w == SLIDES ? d - part : freedom.w == GLIDES ? part : STICK_PASS * (d - part);
}
