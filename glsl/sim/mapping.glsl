// mapping.glsl - macros that spread a guide over threads in one of three ways. Without a flag, a
// work group has a guide, and a thread has a vertex. With HAIR_SUBGROUP, a guide that fits into a
// subgroup uses shuffles instead of shared memory. With HAIR_THREAD_PER_GUIDE, a thread loops over
// the vertices of its guide.
//
//   EACH(n)   Loop over the vertices i below n, in any order. A subgroup also executes the body for
//             the other vertices, whose results are not used.
//   OWN       A value that only its vertex reads: a register, or an array. Accessed by own(name).
//   PARKED    A value as in OWN that is rarely used. A subgroup keeps it in shared memory, because
//             a GPU runs more subgroups at once the fewer registers each takes. Accessed by
//             parked(name).
//   SHARED    A value that neighbours read too, by seen(name) and BEFORE(name). SHARED_VEC3 is for
//             vectors: GET(name), PUT(name, v), BEFORE_VEC3(name) and AFTER_VEC3(name). Beyond the
//             ends the value is undefined. All threads must execute these together. They must not
//             be in a condition that differs between vertices, or in an EACH that writes the value.
//   MEET_TO_VOTE
//             A barrier before a vote. After the vote, shared memory written by others is visible.
//   MEET      A barrier between two EACH, where the first writes values of other vertices that the
//             second reads. Votes and sums are barriers too. any_of and all_bits combine the values
//             of the guide's threads, and sum_of and most_of give their sum and maximum.
//             bits_of_lanes is all_bits of bits that a thread has only where i % lanes is its
//             number.
//   ONCE      A block that handles the whole guide, as recurrences do, by GET_AT(name, k) and
//             PUT_AT(name, k, v). RENEW(name) must follow, because a vertex's own value is kept in
//             registers too.
//   lend      Broadcast a vector to all threads of a work group or subgroup. lent_by(thread) reads
//             the vector of a thread, whose number wraps around.
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
#ifdef HAIR_FIRST
#if HAIR_SOLVER != 0
#define SHARES_GROUPS
#endif
#endif

#if defined(HAIR_SUBGROUP) && HAIR_GUIDE_THREADS == 32 && !defined(HAIR_THREAD_PER_GUIDE)

// With many guides, a work group has several of them, because a launch takes equally long for any
// size. Votes alone keep the threads of a guide together. NVIDIA implements barriers of subgroups
// as barriers of the whole GPU, which take longer.
#ifdef SHARES_GROUPS
#define GROUP_GUIDES uint(HAIR_FIRST_GUIDES)
#define guide_of_group gl_SubgroupID
#define MEET_TO_VOTE subgroupMemoryBarrierShared()
#else
#define GROUP_GUIDES 1u
#define guide_of_group 0u
#define MEET_TO_VOTE synchronise()
#endif
#define GUIDES_IN_GROUP GROUP_GUIDES
#define GROUP_THREADS (32u * GROUP_GUIDES)
#define EACH(n) for (uint i = lane, goes = 1u; goes > 0u; goes = 0u)
#define ONCE
#define SHARED(T, name) T name
#define SHARED_VEC3(name) vec3 name
#define OWN(T, name) T name
#define own(name) name
#define PARKED(T, name) shared T name[GROUP_THREADS]
#define parked(name) name[32u * guide_of_group + lane]
#define seen(name) name
#define GET(name) name
#define PUT(name, v) name = v
// Shuffles among 32 threads wrap around, because only five bits of a thread's number count.
#define BEFORE(name) subgroupShuffle(name, lane - 1u)
#define BEFORE_VEC3(name) BEFORE(name)
#define AFTER_VEC3(name) subgroupShuffle(name, lane + 1u)
#define GET_AT(name, k) subgroupShuffle(name, k)
#define PUT_AT(name, k, v)                                                                                   \
    if ((k) == lane) name = v
#define RENEW(name)
#define MEET
#define lane gl_SubgroupInvocationID
#define lanes 32u
uint  hair_guide_number() { return hair_group() * GROUP_GUIDES + guide_of_group; }
bvec2 any_of(bvec2 v) { return bvec2(subgroupAny(v.x), subgroupAny(v.y)); }
uvec2 all_bits(uvec2 bits) { return subgroupOr(bits); }
uint  bits_of_lanes(uint bits) { return subgroupBallot(bits != 0u).x; }
float sum_of(float v) { return subgroupAdd(v); }
float most_of(float v) { return subgroupMax(v); }
vec3  lent;
void  lend(vec3 v) { lent = v; }
vec3  lent_by(uint thread) { return subgroupShuffle(lent, thread); }

#else

#define GROUP_GUIDES 1u
#define guide_of_group 0u
#define MEET_TO_VOTE synchronise()

// Size of arrays: the vertices, and one more that AFTER_VEC3 may read. Mesa takes very long to
// unroll a loop over an array of 32.
#define MOST (HAIR_GUIDE_THREADS + 1)

#define GET_AT(name, k) name[k]
#define PUT_AT(name, k, v) name[k] = v
#define seen(name) name[i]
#define BEFORE(name) name[max(i, 1u) - 1u]
#define BEFORE_VEC3(name) GET_AT(name, max(i, 1u) - 1u)
#define AFTER_VEC3(name) GET_AT(name, i + 1u)

#ifdef HAIR_THREAD_PER_GUIDE

#define GUIDES_IN_GROUP uint(GROUP_THREADS)
#define GROUP_THREADS 8 // Width of software rasterisers, which use this mapping
#define EACH(n) for (uint i = 0u; i < (n); ++i)
#define ONCE
#define SHARED(T, name) T name[MOST]
#define SHARED_VEC3(name) vec3 name[MOST]
#define GET(name) name[i]
#define PUT(name, v) name[i] = v
#define RENEW(name)
#define OWN(T, name) T name[MOST]
#define own(name) name[i]
#define PARKED(T, name) OWN(T, name)
#define parked(name) own(name)
#define MEET
#define lane 0u
#define lanes 1u
uint  hair_guide_number() { return hair_group() * GROUP_THREADS + gl_LocalInvocationID.x; }
bvec2 any_of(bvec2 v) { return v; }
uvec2 all_bits(uvec2 bits) { return bits; }
uint  bits_of_lanes(uint bits) { return bits; }
float sum_of(float v) { return v; }
float most_of(float v) { return v; }

#else

#define GUIDES_IN_GROUP 1u
#define GROUP_THREADS HAIR_GUIDE_THREADS
#define EACH(n) for (uint i = lane; i < (n); i = 0xffffffffu)
#define ONCE if (lane == 0u)
#define SHARED(T, name) shared T name[MOST]
#define SHARED_VEC3(name) shared vec3 name[MOST]
// Shared values of the thread's own vertex.
struct { vec3 place, moved, edge, lever, handed; } mine;
#define GET(name) mine.name
#define PUT(name, v) name[i] = mine.name = v
#define RENEW(name) EACH(guide_count) { mine.name = name[i]; }
#define OWN(T, name) T name
#define own(name) name
#define PARKED(T, name) OWN(T, name)
#define parked(name) own(name)
#define MEET synchronise()
#define lane gl_LocalInvocationID.x
#define lanes uint(HAIR_GUIDE_THREADS)

shared uvec2 gathered[3]; // Used in turn, so that one can be cleared while another is read
// Two buffers, used in turn. Components are stored one after the other, because vectors would not
// fit into 32 KB.
shared float lent[6 * MOST];
uint gathering, lending;

uint hair_guide_number()
{
    if (lane == 0u) gathered[0] = uvec2(0u);
    gathering = lending = 0u;
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
bvec2 any_of(bvec2 v) { return notEqual(all_bits(uvec2(v)), uvec2(0u)); }
uint  bits_of_lanes(uint bits) { return all_bits(uvec2(bits, 0u)).x; }

void lend(vec3 v)
{
    lending = uint(3 * MOST) - lending;
    for (int c = 0; c < 3; ++c) lent[lending + uint(MOST * c) + lane] = v[c];
    synchronise();
}
vec3 lent_by(uint thread)
{
    uint k = lending + (thread & (lanes - 1u));
    return vec3(lent[k], lent[k + uint(MOST)], lent[k + uint(2 * MOST)]);
}

float sum_of(float v)
{
    for (uint reach = 1u; reach < lanes; reach *= 2u) {
        lend(vec3(v));
        v += lent_by(lane ^ reach).x;
    }
    return v;
}
float most_of(float v)
{
    for (uint reach = 1u; reach < lanes; reach *= 2u) {
        lend(vec3(v));
        v = max(v, lent_by(lane ^ reach).x);
    }
    return v;
}

#endif
#endif
