// bending.glsl - forces of bending of round strands that are straight at rest, of energy k/2 |t_b - t_a|^2 of the
// vertex between segments of directions t_a, t_b, with k the bending stiffness over its length. No frame is needed.
OWN(vec4, strain); // w: k

// Find the forces of bending on each vertex, and hand them to its neighbours.
void find_bending()
{
    EACH(guide_count) {
        vec3 before = BEFORE_VEC3(edge);
        if (i == 0u) before = clamp_way;
        PUT(lever, i + 1u < guide_count ? own(strain).w * (GET(edge) - before) : vec3(0.0));
    }
    MEET;
    EACH(guide_count - 1u) { // What a segment does to the vertex before it; to that after it the opposite.
        vec3 d = GET(lever) - AFTER_VEC3(lever);
        PUT(handed, d / own(rest_length));
    }
    MEET;
}

// What the segments beside a vertex do to it, as they handed it.
vec3 by_segments(uint i)
{
    vec3 before = BEFORE_VEC3(handed);
    return (i + 1u < guide_count ? GET(handed) : vec3(0.0)) - (i > 0u ? before : vec3(0.0));
}
