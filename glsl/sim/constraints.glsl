// constraints.glsl - distance, angular and collision constraints of a guide in shared memory,
// after Tariq 2010, "Hair".
//
// A work group has one thread per vertex. Each function is one phase, in which no two threads touch
// the same vertex. The scalp pins vertices 0 and 1, which never move.

shared vec3 vertex[HAIR_GUIDE_THREADS];

// Move the ends of the link (a, b) towards the distance `rest_length` by the fraction `stiffness`
// of the error. Each end moves half of it. A free end moves all of it where the other end is pinned
// (Tariq 2010, figure 10).
void relax_link(uint a, uint b, float rest_length, float stiffness)
{
    vec3  link = vertex[b] - vertex[a];
    float l    = length(link);
    if (l < 1e-12 || b < 2u) return;
    vec3  correction = link * (stiffness * (l - rest_length) / l);
    float fraction      = a < 2u ? 1.0 : 0.5;
    if (a >= 2u) vertex[a] += 0.5 * correction;
    vertex[b] -= fraction * correction;
}

// Apply the red distance constraints in phase 0, to links (0,1), (2,3), ... Apply the black ones in
// phase 1, to links (1,2), (3,4), ...
void relax_distance(uint i, uint count, uint phase, uint first)
{
    uint a = 2u * i + phase;
    if (a + 1u < count) relax_link(a, a + 1u, rest[first + a].position.w, 1.0);
}

// Apply angular constraints as distances over two segments. Phase 0 takes links (0,2), (1,3),
// (4,6), ... Phase 1 takes links (2,4), (3,5), (6,8), ...
void relax_bend(uint i, uint count, uint phase, uint first, float stiffness)
{
    uint a = 4u * (i / 2u) + (i & 1u) + 2u * phase;
    if (a + 2u >= count) return;
    vec3 from = rest[first + a].position.xyz, to = rest[first + a + 2u].position.xyz;
    relax_link(a, a + 2u, distance(from, to), stiffness);
}

#include "sim/capsules.glsl"

// Assumed maximum movement of a vertex by a substep's iterations, m.
#define COLLISION_REACH 0.05

// Return one bit per collider that the vertex can touch in this substep, because iterations need
// not test the others.
uvec2 find_colliders(vec3 position, float fraction)
{
    uvec2 found = uvec2(0u);
    for (uint k = 0u; k < params.colliders; ++k) {
        capsule collider =
            collider_at(params.collider[k], fraction, params.collision_margin + COLLISION_REACH);
        if (length(from_axis(position, collider)) < collider.radius) found[k / 32u] |= 1u << (k % 32u);
    }
    return found;
}

// Return the position pushed out of each of the given colliders in turn.
vec3 collide(vec3 position, uvec2 colliders, float fraction)
{
    for (int word = 0; word < 2; ++word)
        for (uint bits = colliders[word]; bits != 0u; bits &= bits - 1u) {
            uint k   = 32u * uint(word) + uint(findLSB(bits));
            position = push_out(position, collider_at(params.collider[k], fraction, params.collision_margin));
        }
    return position;
}
