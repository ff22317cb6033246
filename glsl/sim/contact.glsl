// contact.glsl - what solids make of a displacement: out of them, and held by friction as far as Coulomb allows.
//
// The reaction of a solid is what is done minus what is wanted. Its part along the normal may only push; its part
// along the surface is at most `friction` times that, and against the slip. Where that suffices there is no slip at
// all: a strand at rest does not creep.
//
// A root that is held nearer to solids than the margin, or in one, leaves what follows it no way out that is as long
// as it is: there a vertex may be as deep as its root, less a fifth of its distance from it.
#include "sim/contact_capsules.glsl"

#define FREE 0.0
#define SLIDES 1.0
#define GLIDES 2.0 // between two solids, along both
#define STICKS 3.0
#define STICK_PASS 0.1 // see pass_on
#define LOCKED 0.9     // share that friction may take of what is along a segment
#define EMERGE 1.0     // m/s, and in a substep half a segment at most, for lengths to be found
#define RISE 0.2       // of a vertex out of where its root is, by its distance from that

OWN(vec4, touch);      // xyz: normal, of GLIDES the way it can go; w: FREE to STICKS
#ifndef HAIR_MIXED
OWN(vec4, slip);       // of SLIDES, xyz: the way it slides, as long as friction is; w: share that friction takes of it; of STICKS w: friction
#endif
#ifdef HAIR_ANY
#define BITS uvec2 // one for each solid of a list,
#else
#define BITS uint // or for each there is
#endif
OWN(BITS, reachable); // solids,
OWN(BITS, met);       // and those met in this substep
float sunk;                  // how deep in solids the root is held. m

// The vertices that can touch any. Of software rasterisers, which run what is within a condition for vertices for which it is
// not true as well, a thread goes from one to the next.
#ifdef HAIR_THREAD_PER_GUIDE
#define LISTS_REACHING true
#define EACH_REACHING for (uint i = first_reaching; i < guide_count; i = next_reaching[i])
uint first_reaching, next_reaching[MOST];

void list_reaching()
{
    first_reaching = guide_count;
    for (uint i = guide_count; i-- > 0u;) {
        next_reaching[i] = first_reaching;
        first_reaching   = own(reachable) != BITS(0u) ? i : first_reaching;
    }
}
#else
#define LISTS_REACHING false
#define EACH_REACHING EACH(guide_count)
void list_reaching() {}
#endif

// Rounds that a thread of a software rasteriser may yet go from solid to solid in a substep, of the few that it may go in all:
// see lib/sim/rounds.c. Without any left each vertex leaves the solid it is deepest in, and the strand is led.
#if defined(HAIR_THREAD_PER_GUIDE) && defined(HAIR_ANY)
uint rounds_left;
void grant_rounds() { rounds_left = HAIR_CONTACT_ROUNDS; }
void take_rounds(uint count) { rounds_left -= min(count, rounds_left); }
bool has_rounds() { return rounds_left > 0u; }
#else
void grant_rounds() {}
void take_rounds(uint count) {}
bool has_rounds() { return true; }
#endif

// How deep a vertex may be; and how far it comes out in a substep if it was deeper.
vec2 granted_to(uint i)
{
    float rise = min(EMERGE * SUBSTEP, 0.5 * guide_length / float(guide_count - 1u));
    return vec2(max(sunk - RISE * length(GET(place)), 0.0), rise);
}

// How deep in one solid the displacement d from `start`, both from the head's origin, leads; below 0: how far off it
// stays. And how deep it was, and the normal there. A vertex that goes right through is stopped where it goes in.
float depth_in(uint k, vec3 start, vec3 d, vec3 head_moved, out float was, out vec3 normal)
{
    capsule now = solid_now(k), then = solid_then(k);
    vec3    end = start + d - head_moved;
    vec3    out_a = from_axis(start, then), out_b = from_axis(end, now), pass = out_b - out_a;
    float   away  = length(out_b);
    float   depth = now.radius - away;
    normal        = away > 1e-9 ? out_b / away : vec3(0.0, 1.0, 0.0);
    if (dot(out_b, out_a) < 0.0) {
        float a = dot(pass, pass), b = dot(out_a, pass), c = dot(out_a, out_a) - now.radius * now.radius, root = b * b - a * c;
        if (c > 0.0 && b < 0.0 && root > 0.0) {
            normal = normalize(out_a + pass * ((-b - sqrt(root)) / a));
            depth  = now.radius - dot(normal, out_b);
        }
    }
    was = then.radius - length(out_a);
    return depth;
}

// What the surface does there, at the end of the displacement.
vec3 surface_of(uint k, vec3 end, vec3 head_moved, vec3 normal)
{
    capsule now = solid_now(k), then = solid_then(k);
    float along = nearest_share(end, now);
    return head_moved + (now.start - then.start) + along * (now.axis - then.axis) +
           cross(SOLID_SPIN(k).xyz * (share_now - share_then), normal * now.radius);
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
    capsule solid = solid_now(k);
    return solid.radius - length(from_axis(root_now, solid));
}

#ifdef HAIR_MIXED
#include "sim/contact_planes.glsl"
#else

// What solids have made of a displacement, and what they leave of it.
struct outcome {
    vec3 d;
    vec4 freedom, slip; // as touch and slip have them
};

outcome untouched(vec3 want) { return outcome(want, vec4(0.0, 0.0, 0.0, FREE), vec4(0.0)); }

// Out of one solid by the depth, and held by its friction.
void push_by(float factor, float depth, vec3 normal, vec3 surface, inout outcome made)
{
    float friction = params.friction * factor;
    vec3  way      = made.d - surface;
    way -= dot(way, normal) * normal;
    float far = length(way), grip = friction * max(depth, 0.0);
    bool  stuck = far <= grip;
    made.d += depth * normal - (stuck ? way : way * (grip / far));
    made.slip    = depth <= 0.0 ? vec4(0.0) : stuck ? vec4(0.0, 0.0, 0.0, friction) : vec4(way * (friction / far), grip / far);
    made.freedom = stuck ? vec4(normal, STICKS) : left_of(made.freedom, normal);
}

#endif

#ifdef HAIR_ANY
#include "sim/contact_any.glsl"
#else
#include "sim/contact_few.glsl"
#endif

// What solids make of what is wanted, and what freedom they leave. Those in `kept` hold the vertex even where they
// would have to pull.
outcome allowed(uint i, vec3 want, BITS solids, BITS kept, vec3 head_moved, inout BITS met)
{
    outcome made = untouched(want);
    get_out(i, root_now - root_moved + head_moved + GET(place), solids, kept, head_moved, made, met);
    return made;
}

// The part of a displacement that a contact lets pass. What sticks passes on a little, so that lengths between what
// sticks can be found: by a tension that grows until something slips.
vec3 pass_on(vec4 freedom, vec3 d)
{
    vec3 part = dot(d, freedom.xyz) * freedom.xyz, rest = d - part; // Of what is free the normal is 0.
    rest *= freedom.w == STICKS ? STICK_PASS : 1.0;
    return mix(rest, part, bvec3(freedom.w == GLIDES));
}

// The transpose of what a contact makes of a small change of what is wanted: of what slides friction takes a share across
// the slip, and along it the more the harder it is pressed. Where that would be all and more it would stick.
vec3 pass_back(vec4 freedom, vec4 slip, vec3 d)
{
    vec3  passed = pass_on(freedom, d);
    float square = dot(slip.xyz, slip.xyz), along = dot(slip.xyz, d);
    if (freedom.w != SLIDES || square == 0.0) return passed;
    passed -= slip.w * (passed - slip.xyz * (along / square));
    float left = dot(passed, d), pressed = along * dot(freedom.xyz, d);
    return passed + along * min(1.0, LOCKED * left / max(-pressed, 1e-12)) * freedom.xyz;
}
