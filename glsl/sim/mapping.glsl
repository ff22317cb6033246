// mapping.glsl - one text for three ways to spread a guide over threads: a work group per guide and a thread per
// vertex; the same of a guide that fits into a subgroup (HAIR_SUBGROUP), whose threads read each other's registers; or,
// with HAIR_THREAD_PER_GUIDE, a thread per guide that goes over its vertices.
//
//   EACH(n)  for the vertices i below n, in any order. A subgroup goes over those beyond as well: nothing of them is
//            looked at
//   OWN      what only its vertex sees: a register, or an array; own(name)
//   PARKED   the same, seldom looked at: of a subgroup in shared memory, for it has more under way at once the fewer
//            registers it takes; parked(name)
//   SHARED   what its neighbours see too: seen(name), BEFORE(name). Of vectors SHARED_VEC3: GET(name), PUT(name, v),
//            BEFORE_VEC3(name), AFTER_VEC3(name), beyond the ends anything. All threads are there together: neither
//            within a condition that differs between vertices, nor in an EACH that writes it
//   MEET_TO_VOTE
//            before a vote, after which shared memory is read that others have written
//   MEET     between two EACH of which one writes, for another vertex, what the other reads; any_of and all_bits, what
//            any of the guide's threads has, sum_of and most_of do that too; bits_of_lanes, all_bits of bits that a thread
//            has only where i % lanes is its own number
//   ONCE     what goes over the whole guide, as recurrences do, by GET_AT(name, k) and PUT_AT(name, k, v); after it
//            RENEW(name) what it has put, since a vertex's own is kept in registers too
//   lend     makes a vector seen by all threads of a work group or subgroup, as lent_by(thread), which goes round
#include "workgroup.glsl"

// What a program leaves out. Constants, for software rasterisers run both sides of a branch.
#ifdef HAIR_SOLIDS
#define SOLIDS true
#else
#define SOLIDS false
#endif
#ifdef HAIR_TIED
#define TIED true
#else
#define TIED false
#endif

// Programs that many guides go through first have few registers to a guide. The program of SHAKE has enough.
#ifdef HAIR_FIRST
#if HAIR_SOLVER != 0
#define SHARES_GROUPS
#endif
#endif

#if defined(HAIR_SUBGROUP) && HAIR_GUIDE_THREADS == 32 && !defined(HAIR_THREAD_PER_GUIDE)

// Of so many guides a work group has several, since it takes as long to launch whatever it has. What they vote on they agree on:
// barriers of subgroups NVIDIA makes barriers of the whole GPU, which take 0.1 ms of a step of 102,400 guides.
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
// Of 32 threads shuffles go round: of the number of a thread five bits count.
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

// Vertices, and one more, which AFTER_VEC3 may read. And Mesa takes 16 s to unroll a loop over an array of 32.
#define MOST (HAIR_GUIDE_THREADS + 1)

#define GET_AT(name, k) name[k]
#define PUT_AT(name, k, v) name[k] = v
#define seen(name) name[i]
#define BEFORE(name) name[max(i, 1u) - 1u]
#define BEFORE_VEC3(name) GET_AT(name, max(i, 1u) - 1u)
#define AFTER_VEC3(name) GET_AT(name, i + 1u)

#ifdef HAIR_THREAD_PER_GUIDE

#define GUIDES_IN_GROUP uint(GROUP_THREADS)
#define GROUP_THREADS 8 // the width of software rasterisers, for which this mapping is
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
struct { vec3 place, moved, edge, lever, handed; } mine; // what is shared of the thread's own vertex
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

shared uvec2 gathered[3]; // Taken in turn, so that one can be cleared while another is read.
shared float lent[6 * MOST]; // Two in turn, likewise; component after component: vectors would not fit into 32 KB.
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
