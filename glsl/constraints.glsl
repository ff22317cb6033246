// constraints.glsl - the constraints of a guide in shared memory: distance, angular, collision. One thread per
// vertex; each function is one phase in which no two threads touch the same vertex. After Tariq 2010, "Hair".
//
// Vertices 0 and 1 are pinned by the scalp and never moved.

shared vec3 vertex[HAIR_GUIDE_THREADS];

// Move the ends of the link (a, b) towards the distance `rest_length`, by the share `stiffness` of the error,
// half each, or all of it by the free end (Tariq 2010, figure 10).
void relax_link(uint a, uint b, float rest_length, float stiffness)
{
    vec3  link = vertex[b] - vertex[a];
    float l    = length(link);
    if (l < 1e-12 || b < 2u) return;
    vec3  correction = link * (stiffness * (l - rest_length) / l);
    float share      = a < 2u ? 1.0 : 0.5;
    if (a >= 2u) vertex[a] += 0.5 * correction;
    vertex[b] -= share * correction;
}

// Red (phase 0) or black (phase 1) distance constraints: links (0,1), (2,3), … or (1,2), (3,4), …
void relax_distance(uint i, uint count, uint phase, uint first)
{
    uint a = 2u * i + phase;
    if (a + 1u < count) relax_link(a, a + 1u, rest[first + a].position.w, 1.0);
}

// Angular constraints, as distances over two segments: links (0,2), (1,3), (4,6), … or (2,4), (3,5), (6,8), …
void relax_bend(uint i, uint count, uint phase, uint first, float stiffness)
{
    uint a = 4u * (i / 2u) + (i & 1u) + 2u * phase;
    if (a + 2u < count) relax_link(a, a + 2u, rest[first + a].direction.w, stiffness);
}

#include "capsules.glsl"

#define COLLISION_REACH 0.05 // m: farther than this no vertex is taken to be moved by a substep's iterations

// One bit for each solid that the vertex can meet in this substep: the others need no look at every iteration.
uvec2 find_solids(vec3 position, float share)
{
    uvec2 found = uvec2(0u);
    for (uint k = 0u; k < params.solids; ++k) {
        capsule solid = solid_at(params.solid[k], share, params.margin + COLLISION_REACH);
        if (length(from_axis(position, solid)) < solid.radius) found[k / 32u] |= 1u << (k % 32u);
    }
    return found;
}

vec3 collide(vec3 position, uvec2 solids, float share)
{
    for (int word = 0; word < 2; ++word)
        for (uint bits = solids[word]; bits != 0u; bits &= bits - 1u) {
            uint k   = 32u * uint(word) + uint(findLSB(bits));
            position = push_out(position, solid_at(params.solid[k], share, params.margin));
        }
    return position;
}
