// constraints.glsl - the constraints of a guide in shared memory: distance, angular, collision. One thread per
// vertex; each function is one phase in which no two threads touch the same vertex. After Tariq 2010, "Hair".
//
// Vertices 0 and 1 are pinned by the scalp and never moved.

shared vec3 vertex[HAIR_MAX_GUIDE_VERTICES];

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

// Out of a solid by the shortest way; `share` is how much of the step is done.
vec3 push_out(vec3 position, hair_capsule solid, float share, float margin)
{
    vec4  a      = mix(solid.start[0], solid.end[0], share);
    vec4  b      = mix(solid.start[1], solid.end[1], share);
    vec3  axis   = b.xyz - a.xyz;
    float along  = clamp(dot(position - a.xyz, axis) / max(dot(axis, axis), 1e-12), 0.0, 1.0);
    vec3  nearest = a.xyz + along * axis;
    vec3  out_to = position - nearest;
    float radius = a.w + margin;
    float l      = length(out_to);
    if (!(l < radius)) return position; // NaN stays NaN, for the solver to find.
    return nearest + (l > 1e-9 ? out_to * (radius / l) : vec3(0.0, radius, 0.0));
}
