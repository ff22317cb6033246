// rod.glsl - a guide as an inextensible rod: the state that its solvers share, and measures of its
// lengths.
//
// Positions are relative to the guide's root, where the scalp has it at the start of a substep.
// Displacements are in the world, over the substep. After the substep, x' = x + displacement -
// root_moved.
#include "sim/buffers.glsl"
#include "rotation.glsl"
#include "sim/rod_buffers.glsl"
#include "sim/thread_mapping.glsl"
#include "sim/tridiagonal.glsl"

SHARED_VEC3(place);      // Position at the start of the substep.
SHARED_VEC3(moved);      // Trial displacement.
SHARED_VEC3(edge);       // Unit vector along segment i after `moved`.
// Effect of a hinge in bending. Later the direction in which a length is corrected.
SHARED_VEC3(lever);
SHARED_VEC3(handed);     // Vector for the neighbours, such as a segment's force. See each use.
LOCAL(float, rest_length); // Rest length of segment i. 0 for the tip.
LOCAL(float, slack);       // 1 / mass. 0 if the scalp or a pin holds the vertex.
LOCAL(vec3, wanted);       // Displacement without contact.
LOCAL(vec3, displacement); // Displacement over the last substep.
LOCAL(float, excess);      // Excess length of segment i.
// xyz is the rest position from the root in groom space. w is the squared frequency of the pull to
// it.
LOCAL(vec4, aim);
#ifdef HAIR_GRID
layout(binding = HAIR_UNIT_ACCELERATION) uniform samplerBuffer acceleration_texture;
LOCAL(vec3, hair_acceleration); // Acceleration by the hair-hair grid, in m/s^2.
#endif

// Data of the guide, which are equal in all its threads.
uint  guide_number, guide_first, guide_count;
float guide_length;
bool  heavy; // The tip outweighs the rest of the guide.
vec3 root_then;  // Position of the root at the start of the substep, from the head's origin.
vec3 root_now;   // Position of the root at the end of the substep.
vec3 root_moved; // Displacement of the root over the substep.
vec3 root_at_rest; // Position of the root in groom space.
vec4 turn_now;   // Rotation of the head.
vec4 turn_then;  // Rotation of the head in the previous substep.
vec4 scalp;      // Frame that clamps the first segment.
vec3 clamp_way, clamp_at_rest; // Direction of the clamp, and the same direction in groom space.
bool root_is_free;

#include "sim/damping.glsl"

// Return the mean length of segments, m.
float segment_length() { return guide_length / float(guide_count - 1u); }

vec3 rest_from_root(uint i)
{
    return rest[guide_first + min(i, guide_count - 1u)].position.xyz - root_at_rest;
}

// Seconds of the present motion, which covers a substep or a part of one.
#ifdef HAIR_MIXED
float part_length;
#define SUBSTEP part_length
#elif defined(HAIR_PASS2)
#define SUBSTEP (leap_part * params.gravity.w)
#else
#define SUBSTEP params.gravity.w
#endif

#ifdef HAIR_PINNED // Without pins only the root is held. See pins.glsl.
vec3 held_move(uint i);
void give_length();
#else
#define held_move(i) root_moved
#define give_length()
#endif

// Return the bits of |v|, which order like floats. They replace comparisons with NaN, which
// compilers may remove. NaN and infinity are above all other values.
uint bits_of(float v) { return floatBitsToUint(v) & 0x7fffffffu; }

// Limit of a distance from the head's origin, and of a displacement in a substep, in metres.
#define FARTHEST 1e4

// Vector from vertex i to the next at the start of the substep. Only work groups of several guides
// store it. They have few registers, so that some of their values are in memory. Other programs
// have no register to spare for a value that is quickly computed.
#ifdef SEVERAL_GUIDES_PER_GROUP
LOCAL(vec3, kept_between);
#define KEEP_BETWEEN local(kept_between) = AFTER_VEC3(place) - GET(place)
#define BETWEEN local(kept_between)
#else
#define KEEP_BETWEEN
#define BETWEEN (AFTER_VEC3(place) - GET(place))
#endif

// Compute unit edges after `moved`, and excess lengths.
void find_edges()
{
    GROUP_BARRIER;
    give_length();
    FOR_VERTICES(guide_count - 1u) {
        KEEP_BETWEEN;
        vec3  to = BETWEEN + (AFTER_VEC3(moved) - GET(moved));
        float l  = length(to);
        PUT(edge, to / l);
        local(excess) = l - local(rest_length);
    }
}

void count_in(uint what)
{
    if (lane == 0u) atomicAdd(solver_stats[what], 1u);
}

// Return v after an operation that compilers cannot remove, so that the sum is rounded. `precise`
// would apply to all values that v depends on, and would disable fused multiply-add in the whole
// substep.
vec3 rounded(vec3 v)
{
    uint nothing = params.substeps >> 31;
    return uintBitsToFloat(floatBitsToUint(v) ^ nothing);
}
