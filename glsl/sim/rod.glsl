// rod.glsl - a guide as an inextensible rod: what its solvers keep of it, and how they measure it.
//
// Positions are from the guide's root, where the scalp has it at the start of a substep; displacements are in the
// world, over the substep. After it x' = x + displacement - root_moved.
#include "buffers.glsl"
#include "rotation.glsl"
#include "sim/rod_buffers.glsl"
#include "sim/mapping.glsl"
#include "sim/tridiagonal.glsl"

SHARED_VEC3(place);      // at the start of the substep
SHARED_VEC3(moved);      // displacement that is tried
SHARED_VEC3(edge);       // unit, of segment i, where `moved` leads
SHARED_VEC3(lever);      // bending: what a hinge does; then: directions in which lengths are corrected
SHARED_VEC3(handed);     // to the neighbours, of forces: see there
OWN(float, rest_length); // of segment i; 0 for the tip
OWN(float, slack);       // 1 / mass; 0: held, by the scalp or a pin
OWN(vec3, wanted);       // displacement if no collider were in the way
OWN(vec3, displacement); // over the last substep
OWN(float, excess);      // of length, of segment i
OWN(vec4, aim);          // rest position from the root, in groom space; squared frequency of the pull to it
#ifdef HAIR_CROWD
layout(binding = HAIR_UNIT_PUSH) uniform samplerBuffer push_texture;
OWN(vec3, push); // acceleration by the hair around, m/s^2
#endif

// The guide, the same for all its vertices.
uint  guide_number, guide_first, guide_count;
float guide_length;
bool  heavy; // its tip outweighs the rest of it
vec3 root_then;  // from the head's origin, at the start of the substep,
vec3 root_now;   // and at its end
vec3 root_moved; // over it
vec3 root_at_rest; // in groom space
vec4 turn_now;   // of the head
vec4 turn_then;  // of the substep before
vec4 scalp;      // frame that clamps the first segment
vec3 clamp_way, clamp_at_rest; // its way, and in groom space
bool root_is_free;
bool loose, broken; // what measure() finds

vec3 rest_from_root(uint i) { return rest[guide_first + min(i, guide_count - 1u)].position.xyz - root_at_rest; }

// Seconds that the motion under way takes: a substep, or a part of one.
#ifdef HAIR_MIXED
float part_length;
#define SUBSTEP part_length
#elif defined(HAIR_LISTED)
#define SUBSTEP (leap_part * params.gravity.w)
#else
#define SUBSTEP params.gravity.w
#endif

#ifdef HAIR_PINNED // See pin.glsl; without pins nothing but the root is held.
vec3 held_move(uint i);
void give_length();
#else
#define held_move(i) root_moved
#define give_length()
#endif

// By the bits, for comparisons with NaN may be compiled away: what is not finite is above all else.
uint bits_of(float v) { return floatBitsToUint(v) & 0x7fffffffu; }

#define FARTHEST 1e4  // m from the head's origin, or in a substep: no hair is there
#define TOO_LONG 0.01 // relative error of length with which a method has failed

// From vertex i to the next, at the start of the substep. Work groups of several guides have so few registers each that some are in
// memory; other programs have none to spare for what is quickly found again.
#ifdef SHARES_GROUPS
OWN(vec3, kept_between);
#define KEEP_BETWEEN own(kept_between) = AFTER_VEC3(place) - GET(place)
#define BETWEEN own(kept_between)
#else
#define KEEP_BETWEEN
#define BETWEEN (AFTER_VEC3(place) - GET(place))
#endif

// Unit edges where `moved` leads.
void find_edges()
{
    MEET;
    give_length();
    EACH(guide_count - 1u) {
        KEEP_BETWEEN;
        vec3  to = BETWEEN + (AFTER_VEC3(moved) - GET(moved));
        float l  = length(to);
        PUT(edge, to / l);
        own(excess) = l - own(rest_length);
    }
}

#define MIN_GRANT 3e-7  // of the length of the guide: rounding of positions is a tenth of that
#define SLOW_GRANT 0.02 // of the displacement of a vertex

// Return the error of length that segment i may keep, by the relative `tolerance`. Among colliders what moves
// slowly may keep less: the part that a Newton step leaves differs from substep to substep, and what hangs between
// a root and a vertex that sticks would tremble with it.
float granted_error(uint i, float tolerance)
{
    float grant = tolerance * own(rest_length);
#ifdef HAIR_COLLIDERS
    grant = clamp(SLOW_GRANT * length(own(displacement) - root_moved), MIN_GRANT * guide_length, grant);
#endif
    return grant;
}

// Find unit edges; and whether the length of a segment is loose, wrong by more than the relative `tolerance` grants,
// or broken.
void measure(float tolerance)
{
    bool is_loose = false, is_broken = false;
    find_edges();
    EACH(guide_count - 1u) {
        if (i + 1u < guide_count) {
            is_loose  = is_loose || bits_of(own(excess)) > floatBitsToUint(granted_error(i, tolerance));
            is_broken = is_broken || bits_of(own(excess)) > floatBitsToUint(TOO_LONG * own(rest_length));
        }
    }
    bvec2 found = any_of(bvec2(is_loose, is_broken));
    loose  = found.x;
    broken = found.y;
}

void count_in(uint what)
{
    if (lane == 0u) atomicAdd(solver_stats[what], 1u);
}

// Return v rounded by a sum whose parts no compiler takes away again. `precise` says so too, but of all that leads there:
// then nothing in a substep is multiplied and added at once.
vec3 rounded(vec3 v)
{
    uint nothing = params.substeps >> 31;
    return uintBitsToFloat(floatBitsToUint(v) ^ nothing);
}
