// thread_mapping.glsl - macros that spread a guide over threads in one of three ways. Without a
// flag, a work group has a guide, and a thread has a vertex. With HAIR_SUBGROUP, a guide that fits
// into a subgroup uses shuffles instead of shared memory. With HAIR_THREAD_PER_GUIDE, a thread
// loops over the vertices of its guide.
//
//   FOR_VERTICES(n) Loop over the vertices i below n, in any order. A subgroup also executes the
//                  body for the other vertices, whose results are not used.
//   LOCAL          A value that only its vertex reads: a register, or an array. Accessed by
//                  local(name).
//   SPILLED        A value as in LOCAL that is rarely used. A subgroup keeps it in shared memory,
//                  because a GPU runs more subgroups at once the fewer registers each takes.
//                  Accessed by spilled(name).
//   SHARED         A value that neighbours read too, by SHARED_READ(name) and BEFORE(name).
//                  SHARED_VEC3 is for vectors: GET(name), PUT(name, v), BEFORE_VEC3(name) and
//                  AFTER_VEC3(name). Beyond the ends the value is undefined. All threads must
//                  execute these together. They must not be in a condition that differs between
//                  vertices, or in a FOR_VERTICES that writes the value.
//   VOTE_BARRIER   A barrier before a vote. After the vote, shared memory written by others is
//                  visible.
//   GROUP_BARRIER  A barrier between two FOR_VERTICES, where the first writes values of other
//                  vertices that the second reads. Votes and sums are barriers too. group_any and
//                  all_bits combine the values of the guide's threads, and group_sum and group_max
//                  give their sum and maximum. bits_of_lanes is all_bits of bits that a thread has
//                  only where i % lanes is its number.
//   SINGLE_THREAD  A block that handles the whole guide, as recurrences do, by GET_AT(name, k) and
//                  PUT_AT(name, k, v). RELOAD(name) must follow, because a vertex's own value is
//                  kept in registers too.
//   broadcast      Broadcast a vector to all threads of a work group or subgroup.
//                  broadcast_from(thread) reads the vector of a thread, whose number wraps around.
#include "workgroup.glsl"

// Features of a program as constants. Constants remove code, while software rasterisers execute
// both sides of a branch.
#ifdef HAIR_COLLIDERS
#define COLLIDERS true
#else
#define COLLIDERS false
#endif
#ifdef HAIR_PINNED
#define PINNED true
#else
#define PINNED false
#endif

// Programs that many guides go through first have few registers per guide. The program of SHAKE has
// enough.
#ifdef HAIR_PASS1
#if HAIR_SOLVER != 0
#define SEVERAL_GUIDES_PER_GROUP
#endif
#endif

#if defined(HAIR_SUBGROUP) && HAIR_GUIDE_THREADS == 32 && !defined(HAIR_THREAD_PER_GUIDE)

// With many guides, a work group has several of them, because a launch takes equally long for any
// size. Votes alone keep the threads of a guide together. NVIDIA implements barriers of subgroups
// as barriers of the whole GPU, which take longer.
#ifdef SEVERAL_GUIDES_PER_GROUP
#define GROUP_GUIDES uint(HAIR_PASS1_GUIDES)
#define guide_of_group gl_SubgroupID
#define VOTE_BARRIER subgroupMemoryBarrierShared()
#else
#define GROUP_GUIDES 1u
#define guide_of_group 0u
#define VOTE_BARRIER synchronise()
#endif
#define GUIDES_IN_GROUP GROUP_GUIDES
#define GROUP_THREADS (32u * GROUP_GUIDES)
#define FOR_VERTICES(n) for (uint i = lane, goes = 1u; goes > 0u; goes = 0u)
#define SINGLE_THREAD
#define SHARED(T, name) T name
#define SHARED_VEC3(name) vec3 name
#define LOCAL(T, name) T name
#define local(name) name
#define SPILLED(T, name) shared T name[GROUP_THREADS]
#define spilled(name) name[32u * guide_of_group + lane]
#define SHARED_READ(name) name
#define GET(name) name
#define PUT(name, v) name = v
// Shuffles among 32 threads wrap around, because only five bits of a thread's number count.
#define BEFORE(name) subgroupShuffle(name, lane - 1u)
#define BEFORE_VEC3(name) BEFORE(name)
#define AFTER_VEC3(name) subgroupShuffle(name, lane + 1u)
#define GET_AT(name, k) subgroupShuffle(name, k)
#define PUT_AT(name, k, v)                                                                                   \
    if ((k) == lane) name = v
#define RELOAD(name)
#define GROUP_BARRIER
#define lane gl_SubgroupInvocationID
#define lanes 32u
uint  hair_guide_number() { return hair_group() * GROUP_GUIDES + guide_of_group; }
bvec2 group_any(bvec2 v) { return bvec2(subgroupAny(v.x), subgroupAny(v.y)); }
uvec2 all_bits(uvec2 bits) { return subgroupOr(bits); }
uint  bits_of_lanes(uint bits) { return subgroupBallot(bits != 0u).x; }
float group_sum(float v) { return subgroupAdd(v); }
float group_max(float v) { return subgroupMax(v); }
vec3  broadcast_values;
void  broadcast(vec3 v) { broadcast_values = v; }
vec3  broadcast_from(uint thread) { return subgroupShuffle(broadcast_values, thread); }

#else

#define GROUP_GUIDES 1u
#define guide_of_group 0u
#define VOTE_BARRIER synchronise()

// Size of arrays: the vertices, and one more that AFTER_VEC3 may read. Mesa takes very long to
// unroll a loop over an array of 32.
#define MAX_VERTICES (HAIR_GUIDE_THREADS + 1)

#define GET_AT(name, k) name[k]
#define PUT_AT(name, k, v) name[k] = v
#define SHARED_READ(name) name[i]
#define BEFORE(name) name[max(i, 1u) - 1u]
#define BEFORE_VEC3(name) GET_AT(name, max(i, 1u) - 1u)
#define AFTER_VEC3(name) GET_AT(name, i + 1u)

#ifdef HAIR_THREAD_PER_GUIDE

#define GUIDES_IN_GROUP uint(GROUP_THREADS)
#define GROUP_THREADS 8 // Width of software rasterisers, which use this mapping
#define FOR_VERTICES(n) for (uint i = 0u; i < (n); ++i)
#define SINGLE_THREAD
#define SHARED(T, name) T name[MAX_VERTICES]
#define SHARED_VEC3(name) vec3 name[MAX_VERTICES]
#define GET(name) name[i]
#define PUT(name, v) name[i] = v
#define RELOAD(name)
#define LOCAL(T, name) T name[MAX_VERTICES]
#define local(name) name[i]
#define SPILLED(T, name) LOCAL(T, name)
#define spilled(name) local(name)
#define GROUP_BARRIER
#define lane 0u
#define lanes 1u
uint  hair_guide_number() { return hair_group() * GROUP_THREADS + gl_LocalInvocationID.x; }
bvec2 group_any(bvec2 v) { return v; }
uvec2 all_bits(uvec2 bits) { return bits; }
uint  bits_of_lanes(uint bits) { return bits; }
float group_sum(float v) { return v; }
float group_max(float v) { return v; }

#else

#define GUIDES_IN_GROUP 1u
#define GROUP_THREADS HAIR_GUIDE_THREADS
#define FOR_VERTICES(n) for (uint i = lane; i < (n); i = 0xffffffffu)
#define SINGLE_THREAD if (lane == 0u)
#define SHARED(T, name) shared T name[MAX_VERTICES]
#define SHARED_VEC3(name) shared vec3 name[MAX_VERTICES]
// Shared values of the thread's own vertex.
struct { vec3 place, moved, edge, lever, handed; } mine;
#define GET(name) mine.name
#define PUT(name, v) name[i] = mine.name = v
#define RELOAD(name) FOR_VERTICES(guide_count) { mine.name = name[i]; }
#define LOCAL(T, name) T name
#define local(name) name
#define SPILLED(T, name) LOCAL(T, name)
#define spilled(name) local(name)
#define GROUP_BARRIER synchronise()
#define lane gl_LocalInvocationID.x
#define lanes uint(HAIR_GUIDE_THREADS)

shared uvec2 gathered[3]; // Used in turn, so that one can be cleared while another is read
// Two buffers, used in turn. Components are stored one after the other, because vectors would not
// fit into 32 KB.
shared float broadcast_values[6 * MAX_VERTICES];
uint gathering, broadcasting;

uint hair_guide_number()
{
    if (lane == 0u) gathered[0] = uvec2(0u);
    gathering = broadcasting = 0u;
    synchronise();
    return hair_group();
}

uvec2 all_bits(uvec2 bits)
{
    uint next = gathering == 2u ? 0u : gathering + 1u;
    if (lane == 0u) gathered[next] = uvec2(0u);
    if (bits.x != 0u) atomicOr(gathered[gathering].x, bits.x);
    if (bits.y != 0u) atomicOr(gathered[gathering].y, bits.y);
    synchronise();
    bits      = gathered[gathering];
    gathering = next;
    return bits;
}
bvec2 group_any(bvec2 v) { return notEqual(all_bits(uvec2(v)), uvec2(0u)); }
uint  bits_of_lanes(uint bits) { return all_bits(uvec2(bits, 0u)).x; }

void broadcast(vec3 v)
{
    broadcasting = uint(3 * MAX_VERTICES) - broadcasting;
    for (int c = 0; c < 3; ++c) broadcast_values[broadcasting + uint(MAX_VERTICES * c) + lane] = v[c];
    synchronise();
}
vec3 broadcast_from(uint thread)
{
    uint k = broadcasting + (thread & (lanes - 1u));
    return vec3(broadcast_values[k], broadcast_values[k + uint(MAX_VERTICES)],
                broadcast_values[k + uint(2 * MAX_VERTICES)]);
}

float group_sum(float v)
{
    for (uint reach = 1u; reach < lanes; reach *= 2u) {
        broadcast(vec3(v));
        v += broadcast_from(lane ^ reach).x;
    }
    return v;
}
float group_max(float v)
{
    for (uint reach = 1u; reach < lanes; reach *= 2u) {
        broadcast(vec3(v));
        v = max(v, broadcast_from(lane ^ reach).x);
    }
    return v;
}

#endif
#endif
