// contact.glsl - contact and Coulomb friction of displacements. Colliders push vertices out, and
// friction holds vertices on surfaces.
//
// The reaction of a collider is the allowed displacement minus the wanted one. Its normal part only
// pushes. Its tangential part opposes the slip, and is at most `friction` times the normal part. If
// this force suffices there is no slip at all, and a strand at rest does not creep.
//
// A held root may be inside a collider, or nearer than the margin. The vertices after it then have
// no way out that keeps their lengths. A vertex near such a root may be as deep as the root, less a
// fifth of its distance from the root.
#include "sim/contact_capsules.glsl"
#include "sim/impulses.glsl"

#define FREE 0.0
#define SLIDES 1.0
#define GLIDES 2.0 // Slides between two colliders, along both.
#define STICKS 3.0
#define STICK_PASS 0.1 // Fraction passed on by a contact that sticks. See pass_on().
#define LOCKED 0.9     // Maximum fraction that friction may take of a displacement along a segment
// Speed at which a vertex leaves a collider, m/s. The way per substep is at most half a segment, so
// that lengths can still be found.
#define EMERGE 1.0
// Decrease of the allowed depth per distance from a root that is inside colliders.
#define RISE 0.2

// Contact of a vertex. xyz: normal, or for GLIDES the direction in which the vertex can move. w:
// FREE to STICKS.
LOCAL(vec4, touch);
#ifndef HAIR_MIXED
// Slip of a vertex. For SLIDES, xyz has the direction of the slip and friction as its length. w is
// the fraction of the slip that friction takes. For STICKS, w is the friction.
LOCAL(vec4, slip);
#endif
#ifdef HAIR_COLLIDER_GRID
#define BITS uvec2 // One bit for each collider of a list
#else
#define BITS uint // One bit for each collider
#endif
LOCAL(BITS, reachable); // Colliders that the vertex can touch
LOCAL(BITS, met);       // Colliders that the vertex met in this substep
float sunk;                  // Depth of the root in colliders, m

// Loop over the vertices that can touch a collider. A software rasteriser executes a conditional
// block for all vertices, even where the condition is false. There, a thread follows a linked list
// of these vertices instead.
#ifdef HAIR_THREAD_PER_GUIDE
#define LISTS_REACHING true
#define EACH_REACHING for (uint i = first_reaching; i < guide_count; i = next_reaching[i])
uint first_reaching, next_reaching[MAX_VERTICES];

void list_reaching()
{
    first_reaching = guide_count;
    for (uint i = guide_count; i-- > 0u;) {
        next_reaching[i] = first_reaching;
        first_reaching   = local(reachable) != BITS(0u) ? i : first_reaching;
    }
}
#else
#define LISTS_REACHING false
#define EACH_REACHING FOR_VERTICES(guide_count)
void list_reaching() {}
#endif

// Number of loop rounds over colliders that a thread of a software rasteriser has left in this
// substep. The limit is explained in lib/sim/loop_budget.c. With no rounds left, each vertex leaves
// only the collider in which it is deepest, and the strand falls back to follow-the-leader.
#if defined(HAIR_THREAD_PER_GUIDE) && defined(HAIR_COLLIDER_GRID)
uint rounds_left;
void grant_rounds() { rounds_left = HAIR_CONTACT_ROUNDS; }
void take_rounds(uint count) { rounds_left -= min(count, rounds_left); }
bool has_rounds() { return rounds_left > 0u; }
#else
void grant_rounds() {}
void take_rounds(uint count) {}
bool has_rounds() { return true; }
#endif

// Return the depth that vertex i may have, and how far a deeper vertex comes out in a substep.
vec2 granted_to(uint i)
{
    float rise = min(EMERGE * SUBSTEP, 0.5 * segment_length());
    return vec2(max(sunk - RISE * length(GET(place)), 0.0), rise);
}

// Return the depth in one collider after the displacement d from `start`, both relative to the
// head's origin. A negative depth is the distance from the surface. `was` is the depth before, and
// `normal` the normal at the end. A vertex that passes through the collider is stopped where it
// enters.
float depth_in(uint k, vec3 start, vec3 d, vec3 head_moved, out float was, out vec3 normal)
{
    capsule now = collider_now(k), then = collider_then(k);
    vec3    end = start + d - head_moved;
    vec3    out_a = from_axis(start, then), out_b = from_axis(end, now), pass = out_b - out_a;
    float   away  = length(out_b);
    float   depth = now.radius - away;
    normal        = away > 1e-9 ? out_b / away : vec3(0.0, 1.0, 0.0);
    if (dot(out_b, out_a) < 0.0) {
        float a = dot(pass, pass), b = dot(out_a, pass), c = dot(out_a, out_a) - now.radius * now.radius,
              root = b * b - a * c;
        if (c > 0.0 && b < 0.0 && root > 0.0) {
            normal = normalize(out_a + pass * ((-b - sqrt(root)) / a));
            depth  = now.radius - dot(normal, out_b);
        }
    }
    was = then.radius - length(out_a);
    return depth;
}

// Return the displacement of the surface at `end` over the substep.
vec3 surface_of(uint k, vec3 end, vec3 head_moved, vec3 normal)
{
    capsule now = collider_now(k), then = collider_then(k);
    float along = nearest_fraction(end, now);
    return head_moved + (now.start - then.start) + along * (now.axis - then.axis) +
           cross(COLLIDER_SPIN(k).xyz * (fraction_now - fraction_then), normal * now.radius);
}

// Return the freedom that remains after a further contact of this normal.
vec4 left_of(vec4 freedom, vec3 normal)
{
    if (freedom.w == FREE) return vec4(normal, SLIDES);
    vec3  way = freedom.w == SLIDES ? cross(freedom.xyz, normal) : freedom.xyz;
    float l   = length(way);
    return l > 0.1 && freedom.w != STICKS ? vec4(way / l, GLIDES) : freedom;
}

#ifdef HAIR_BODIES
#include "sim/shape_contact.glsl"
#endif

float root_depth_in(uint k, bool is_body)
{
#ifdef HAIR_BODIES
    if (is_body) return depth_of_place(k, root_now);
#endif
    capsule collider = collider_now(k);
    return collider.radius - length(from_axis(root_now, collider));
}

#ifdef HAIR_MIXED
#include "sim/contact_planes.glsl"
#else

// A displacement as colliders allow it, and the freedom that they leave.
struct outcome {
    vec3 d;
    vec4 freedom, slip; // as in `touch` and `slip`
};

outcome untouched(vec3 want) { return outcome(want, vec4(0.0, 0.0, 0.0, FREE), vec4(0.0)); }

bool is_near(float depth) { return false; }

// Push a displacement out of one collider by the depth, and apply its friction.
void push_by(float factor, float depth, vec3 normal, vec3 surface, inout outcome made)
{
    float friction = params.friction * factor;
    vec3  way      = made.d - surface;
    way -= dot(way, normal) * normal;
    float far = length(way), grip = friction * max(depth, 0.0);
    bool  stuck = far <= grip;
    vec3  push = depth * normal - (stuck ? way : way * (grip / far));
    made.d += push;
    note_push(push, depth * normal);
    made.slip = depth <= 0.0 ? vec4(0.0)
                : stuck      ? vec4(0.0, 0.0, 0.0, friction)
                             : vec4(way * (friction / far), grip / far);
    made.freedom = stuck ? vec4(normal, STICKS) : left_of(made.freedom, normal);
}

#endif

#ifdef HAIR_COLLIDER_GRID
#include "sim/contact_grid.glsl"
#else
#include "sim/contact_uniform.glsl"
#endif

// Return the displacement that colliders allow for the wanted one, and the freedom that they leave.
// Colliders in `kept` hold the vertex even where they have to pull.
outcome allowed(uint i, vec3 want, BITS colliders, BITS kept, vec3 head_moved, inout BITS met)
{
    outcome made = untouched(want);
    begin_pushes();
    get_out(i, root_now - root_moved + head_moved + GET(place), colliders, kept, head_moved, made, met);
    return made;
}

// Return the part of a displacement that a contact lets pass. A contact that sticks passes a small
// part, so that lengths between sticking vertices can be found. The tension between them then grows
// until one slips.
vec3 pass_on(vec4 freedom, vec3 d)
{
    // The normal of a free vertex is 0.
    vec3 part = dot(d, freedom.xyz) * freedom.xyz, rest = d - part;
    rest *= freedom.w == STICKS ? STICK_PASS : 1.0;
    return mix(rest, part, bvec3(freedom.w == GLIDES));
}

// Apply the transpose of the derivative of the allowed displacement by the wanted one. Friction
// takes a fraction of a displacement across the slip. Along the slip, it takes more the harder the
// contact is pressed. LOCKED limits this part, because beyond the limit the contact
// would stick.
vec3 pass_back(vec4 freedom, vec4 slip, vec3 d)
{
    vec3  passed = pass_on(freedom, d);
    float square = dot(slip.xyz, slip.xyz), along = dot(slip.xyz, d);
    if (freedom.w != SLIDES || square == 0.0) return passed;
    passed -= slip.w * (passed - slip.xyz * (along / square));
    float left = dot(passed, d), pressed = along * dot(freedom.xyz, d);
    return passed + along * min(1.0, LOCKED * left / max(-pressed, 1e-12)) * freedom.xyz;
}
