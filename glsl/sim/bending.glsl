// bending.glsl - forces of bending and twist. Energy of the vertex between segments a and b of frames q_a, q_b:
//
//   E = k/2 (u - u0) . R (u - u0),  u = 2 Im(conj(q_a) q_b)
//
// with k the bending stiffness over its length, R the stiffnesses about the section's axes and along the strand as
// ratios to that, u0 the rest strain. Of a round strand that is straight at rest, u is the difference of the edges,
// turned: then no frame is needed. Twist has no inertia: its angles follow the shape, by a Newton step a substep.
OWN(vec4, strain);         // u0, k
OWN(vec4, section);        // frame of segment i: y along it
SHARED(vec2, twist_hinge); // of the twist's Hessian: to the diagonals of both segments, to the entry between them

void bend_straight()
{
    vec3 root_edge = rotate(scalp, vec3(0.0, 1.0, 0.0));
    EACH(guide_count) {
        vec3 before = i > 0u ? GET(edge, i - 1u) : root_edge;
        PUT(lever, i, i + 1u < guide_count ? own(strain).w * (GET(edge, i) - before) : vec3(0.0));
    }
    MEET;
}

void bend_curved()
{
    EACH(guide_count - 1u) { // Frames follow their segments by the least rotation. Neighbours find them in row[].
        vec4 q    = own(section);
        vec4 next = normalize(quat_multiply(quat_between(rotate(q, vec3(0.0, 1.0, 0.0)), GET(edge, i)), q));
        // What an attempt that is not finite makes of it must not outlive it.
        own(section) = bits_of(dot(next, next) - 1.0) < floatBitsToUint(0.1)
                           ? next : quat_multiply(turn_now, rest[guide_first + i].frame);
        row[i]       = own(section);
    }
    MEET;
    EACH(guide_count) {
        PUT(lever, i, vec3(0.0)); // The moment.
        twist_hinge[i] = vec2(0.0);
        if (i + 1u < guide_count) {
            vec4 a = i > 0u ? row[i - 1u] : scalp;
            vec4 r = quat_multiply(quat_conjugate(a), own(section));
            if (r.w < 0.0) r = -r;
            float k     = own(strain).w;
            vec3  g     = k * params.ratio.xyz * (2.0 * r.xyz - own(strain).xyz);
            PUT(lever, i, rotate(a, r.w * g + cross(r.xyz, g)));
            // By turns of both segments alike and opposite. Where the energy is not convex: what of it always is.
            vec2  across = r.xz * r.xz, stiff_across = params.ratio.zx, excess = 2.0 * r.xz - own(strain).xz;
            float bend = k * max(dot(stiff_across, across) - 0.5 * dot(params.ratio.xz * excess, r.xz),
                                 dot(stiff_across - min(stiff_across.x, stiff_across.y), across));
            float twist    = k * params.ratio.y;
            twist_hinge[i] = vec2(twist + bend, bend - twist);
        }
    }
    MEET;
}

// One Newton step of the angles about the edges, towards the least energy.
void relax_twist()
{
    uint segments = guide_count - 1u;
    EACH(segments) {
        vec2  a = twist_hinge[i], b = twist_hinge[i + 1u];
        float diagonal = (a.x + b.x) * 1.0001; // What nothing holds about its axis may turn as one.
        row[i] = vec4(i > 0u ? a.y : 0.0, diagonal > 0.0 ? diagonal : 1.0, b.y,
                      dot(GET(lever, i + 1u) - GET(lever, i), GET(edge, i)));
    }
    MEET;
    solve_rows(segments);
    EACH(segments) {
        float half_angle = bits_of(solution[i]) < 0x7f800000u ? 0.5 * clamp(solution[i], -0.5, 0.5) : 0.0;
        own(section) = quat_multiply(vec4(sin(half_angle) * GET(edge, i), cos(half_angle)), own(section));
    }
    MEET;
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
}

// Force on a vertex, over the mass of a metre.
vec3 bending_force(uint i)
{
    vec3 force = vec3(0.0);
    if (i + 1u < guide_count) {
        vec3 d = GET(lever, i) - GET(lever, i + 1u);
        force  = (CURVED ? cross(d, GET(edge, i)) : d) / rest_length[i];
    }
    if (i > 0u) {
        vec3 d = GET(lever, i - 1u) - GET(lever, i);
        force -= (CURVED ? cross(d, GET(edge, i - 1u)) : d) / rest_length[i - 1u];
    }
    return force;
}
