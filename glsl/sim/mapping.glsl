// mapping.glsl - one text for two ways to spread a guide over threads: a work group per guide and a thread per
// vertex, or, with HAIR_THREAD_PER_GUIDE, a thread per guide that goes over its vertices.
//
//   EACH(n)  for the vertices i below n, in any order; between two of them MEET where one reads what the other
//            wrote for another vertex
//   SHARED   an array that all vertices of the guide see
//   OWN      what only its vertex sees: a register, or an array; read as own(name)
//   ONCE(n)  n jobs j that each go over the whole guide, as recurrences do
#include "workgroup.glsl"

// Vectors in arrays, component after component: neighbouring threads then use neighbouring banks of a GPU's memory.
#define SHARED_VEC3(name) SHARED_FLOATS(name, 3 * MOST)
#define COMPONENT(name, i, c) name[uint(MOST) * (c) + (i)]
#define GET(name, i) vec3(COMPONENT(name, i, 0u), COMPONENT(name, i, 1u), COMPONENT(name, i, 2u))
#define PUT(name, i, v)                                                                                      \
    {                                                                                                        \
        vec3 put_value           = v;                                                                        \
        COMPONENT(name, i, 0u) = put_value.x;                                                                \
        COMPONENT(name, i, 1u) = put_value.y;                                                                \
        COMPONENT(name, i, 2u) = put_value.z;                                                                \
    }

// What a program leaves out. Constants, for software rasterisers run both sides of a branch.
#ifdef HAIR_CURVED
#define CURVED true
#else
#define CURVED false
#endif
#ifdef HAIR_SOLIDS
#define SOLIDS true
#else
#define SOLIDS false
#endif

#ifdef HAIR_THREAD_PER_GUIDE

// Vertices, and one more: Mesa unrolls a loop over an array of 32, and then takes 16 s to compile it.
#define MOST (HAIR_GUIDE_THREADS + 1)
#define GROUP_THREADS 8 // the width of software rasterisers, for which this mapping is
#define EACH(n) for (uint i = 0u; i < (n); ++i)
#define ONCE(n) for (uint j = 0u; j < (n); ++j)
#define SHARED(T, name) T name[MOST]
#define SHARED_FLOATS(name, n) float name[n]
#define OWN(T, name) T name[MOST]
#define own(name) name[i]
#define MEET
uint loose[3], broken[3];
uint hair_guide_number() { return hair_group() * GROUP_THREADS + gl_LocalInvocationID.x; }

#else

#define MOST HAIR_GUIDE_THREADS // vertices
#define GROUP_THREADS MOST
#define EACH(n) for (uint i = gl_LocalInvocationID.x; i < (n); i = 0xffffffffu)
#define ONCE(n) for (uint j = gl_LocalInvocationID.x; j < (n); j = 0xffffffffu)
#define SHARED(T, name) shared T name[MOST]
#define SHARED_FLOATS(name, n) shared float name[n]
#define OWN(T, name) T name
#define own(name) name
#define MEET synchronise()
shared uint loose[3], broken[3];
uint hair_guide_number() { return hair_group(); }

#endif
