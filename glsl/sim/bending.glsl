// bending.glsl - bending forces of round strands that are straight at rest. The vertex between
// segments of directions t_a and t_b has the energy k/2 |t_b - t_a|^2. k is the bending stiffness
// divided by the length at the vertex. No frame is needed.
LOCAL(vec4, strain); // w: k

// Compute the bending forces, and store each segment's force in `handed` for its vertices.
void find_bending()
{
    FOR_VERTICES(guide_count) {
        vec3 before = BEFORE_VEC3(edge);
        if (i == 0u) before = clamp_way;
        PUT(lever, i + 1u < guide_count ? local(strain).w * (GET(edge) - before) : vec3(0.0));
    }
    GROUP_BARRIER;
    // `handed` is the force of a segment on its first vertex. The force on its second vertex is
    // opposite.
    FOR_VERTICES(guide_count - 1u) {
        vec3 d = GET(lever) - AFTER_VEC3(lever);
        PUT(handed, d / local(rest_length));
    }
    GROUP_BARRIER;
}

// Return the force on a vertex from the segments before and after it.
vec3 by_segments(uint i)
{
    vec3 before = BEFORE_VEC3(handed);
    return (i + 1u < guide_count ? GET(handed) : vec3(0.0)) - (i > 0u ? before : vec3(0.0));
}
