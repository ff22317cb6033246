// bending.glsl - forces of bending and twist. Energy of the vertex between segments a and b of frames q_a, q_b:
//
//   E = k/2 (u - u0) . R (u - u0),  u = 2 Im(conj(q_a) q_b)
//
// with k the bending stiffness over its length, R the stiffnesses about the section's axes and along the strand as
// ratios to that, u0 the rest strain. Of a round strand that is straight at rest, u is the difference of the edges,
// turned: then no frame is needed. Twist has no inertia: its angles follow the shape, by a Newton step a substep.
OWN(vec4, strain);     // u0, k
SHARED(vec4, section); // frame of segment i: y along it

void bend_straight()
{
    EACH(guide_count) {
        vec3 before = BEFORE_VEC3(edge);
        if (i == 0u) before = clamp_way;
        PUT(lever, i + 1u < guide_count ? own(strain).w * (GET(edge) - before) : vec3(0.0));
    }
    MEET;
}

void bend_curved()
{
    EACH(guide_count - 1u) { // Frames follow their segments by the least rotation.
        vec4 q    = seen(section);
        vec4 next = normalize(quat_multiply(quat_between(rotate(q, vec3(0.0, 1.0, 0.0)), GET(edge)), q));
        // What an attempt that is not finite makes of it must not outlive it.
        seen(section) = bits_of(dot(next, next) - 1.0) < floatBitsToUint(0.1)
                           ? next : quat_multiply(turn_now, rest[min(guide_first + i, params.vertices - 1u)].frame);
    }
    MEET;
    EACH(guide_count) {
        vec4 a = BEFORE(section);
        if (i == 0u) a = scalp;
        PUT(lever, vec3(0.0)); // The moment.
        PUT(handed, vec3(0.0)); // Of the twist's Hessian: to the diagonals of both segments, to the entry between them.
        if (i + 1u < guide_count) {
            vec4 r = quat_multiply(quat_conjugate(a), seen(section));
            if (r.w < 0.0) r = -r;
            float k     = own(strain).w;
            vec3  g     = k * params.ratio.xyz * (2.0 * r.xyz - own(strain).xyz);
            PUT(lever, rotate(a, r.w * g + cross(r.xyz, g)));
            // By turns of both segments alike and opposite. Where the energy is not convex: what of it always is.
            vec2  across = r.xz * r.xz, stiff_across = params.ratio.zx, excess = 2.0 * r.xz - own(strain).xz;
            float bend = k * max(dot(stiff_across, across) - 0.5 * dot(params.ratio.xz * excess, r.xz),
                                 dot(stiff_across - min(stiff_across.x, stiff_across.y), across));
            float twist = k * params.ratio.y;
            PUT(handed, vec3(twist + bend, bend - twist, 0.0));
        }
    }
    MEET;
}

// One Newton step of the angles about the edges, towards the least energy.
void relax_twist()
{
    uint segments = guide_count - 1u;
    EACH(segments) {
        vec3  a = GET(handed), b = AFTER_VEC3(handed);
        float diagonal = (a.x + b.x) * 1.0001; // What nothing holds about its axis may turn as one.
        own(row) = vec4(i > 0u ? a.y : 0.0, diagonal > 0.0 ? diagonal : 1.0, b.y,
                        dot(AFTER_VEC3(lever) - GET(lever), GET(edge)));
    }
    solve_rows(segments);
    EACH(segments) {
        float half_angle = bits_of(own(solution)) < 0x7f800000u ? 0.5 * clamp(own(solution), -0.5, 0.5) : 0.0;
        seen(section) = quat_multiply(vec4(sin(half_angle) * GET(edge), cos(half_angle)), seen(section));
    }
}

// Frames and hinges of the edges, the twist as they have it: forces of the twist that the substep before had would
// feed what swings.
void find_bending()
{
    if (CURVED) {
        bend_curved();
        relax_twist();
        bend_curved();
    } else {
        bend_straight();
    }
    EACH(guide_count - 1u) { // What a segment does to the vertex before it; to that after it the opposite.
        vec3 d = GET(lever) - AFTER_VEC3(lever);
        PUT(handed, (CURVED ? cross(d, GET(edge)) : d) / own(rest_length));
    }
    MEET;
}

// What the segments beside a vertex do to it, as they handed it.
vec3 by_segments(uint i)
{
    vec3 before = BEFORE_VEC3(handed);
    return (i + 1u < guide_count ? GET(handed) : vec3(0.0)) - (i > 0u ? before : vec3(0.0));
}
