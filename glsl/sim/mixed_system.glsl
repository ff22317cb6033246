// mixed_system.glsl - the rows of Newton's system of a guide, one for each segment, with the hinge
// to the next one.
#define TWIST_HELD 1e-5 // See twist_hold().
// Fraction of the mobility that a contact leaves across it. A block between two contacts then has
// an inverse.
#define HELD 1e-3
#if defined(HAIR_COLLIDERS) || defined(HAIR_WIND) || defined(HAIR_PINNED)
#define MOBILITY_IS_MATRIX
#endif

void put_hinge(uint i, bool exact, vec4 a)
{
    vec4  r = quat_multiply(quat_conjugate(a), SHARED_READ(tried));
    if (r.w < 0.0) r = -r;
    float k      = i + 1u < guide_count ? local(strain).w : 0.0;
    vec3  ratio  = i == 0u ? root_ratio : params.ratio.xyz;
    vec3  s      = r.xyz, g = k * ratio * (2.0 * s - local(strain).xyz);
    // For a round section, `even` is the stiffness about both axes.
    float even   = k * ratio.z;
    float opens  = even * (2.0 * r.w - local(rest_real));
    symmetric c  = multiple_of_one(even - (exact ? 0.5 * (dot(g, s) + opens * r.w) : 0.0));
    c = plus(c, times(k * ratio.y - even, outer(rotate(a, vec3(-s.z, r.w, s.x)))));
    if (params.ratio.x != params.ratio.z)
        c = plus(c, times(k * ratio.x - even, outer(rotate(a, vec3(r.w, s.z, -s.y)))));
    PUT_ROW(hinge_diagonal, i, c.diagonal);
    PUT_ROW(hinge_beside, i, c.beside);
    PUT_ROW(hinge_moment, i, rotate(a, r.w * g + cross(s, g) - opens * s));
}

void put_mobility(uint i)
{
#ifdef MOBILITY_IS_MATRIX
    mat3 w = mat3(local(mobility));
#ifdef HAIR_WIND
    w *= local(mobilities).x;
    w += local(mobility) * (local(mobilities).y - local(mobilities).x) *
         outerProduct(local(flow), local(flow));
#endif
    if (COLLIDERS && local(touch).w != FREE) {
        w = full(local(freedom));
#ifdef HAIR_WIND
        w *= local(mobilities).x;
#endif
        w *= local(mobility);
    }
    // Two held neighbours would leave the force between them nothing to act on.
    // The tip has no segment of its own, so that the mean length of a segment is taken.
    if (PINNED && local(slack) == 0.0)
        w = mat3(HELD * SUBSTEP * SUBSTEP / segment_length());
    symmetric half_w = half_of(w);
    PUT_ROW(mobility_diagonal, i, half_w.diagonal);
    PUT_ROW(mobility_beside, i, half_w.beside);
#else
    PUT_ROW(mobility_diagonal, i, vec3(local(mobility)));
#endif
}

// Return the stiffness that keeps an increment of twist finite. It is needed where too little else
// resists twist. A strand without a clamp turns about its own axis freely. A strand may also have
// no stiffness. The result is relative to the stiffness that inertia gives to other turns.
float twist_hold(float l, float twist)
{
    float inertia = l * l * l / (SUBSTEP * SUBSTEP) * (touching ? 0.5 / HELD : 1.0);
    return max(TWIST_HELD * inertia - twist, root_is_clamped ? 0.0 : TWIST_HELD * max(twist, 0.0));
}

// Return the relative error that contact may leave in a segment's length. A segment that turns in a
// substep may have a larger error. An error that recurs in each substep would make a strand at rest
// tremble.
float length_error(vec4 turn) { return clamp(0.04 * length(turn.xyz), 1e-5, 2e-4); }

// Write all rows, by the exact second derivatives or only by their part that is always convex.
// Return whether the length error of a segment exceeds `looser` times the allowed error.
bool put_rows(bool exact, float looser)
{
    bool loose = false;
    FOR_VERTICES(guide_count) {
        vec4 a = BEFORE(tried);
        if (i == 0u) a = scalp;
        put_hinge(i, exact, a);
        put_mobility(i);
    }
    ROWS_BARRIER;
    FOR_VERTICES(guide_count - 1u) {
        vec3  f = GET(handed), to = AFTER_VEC3(moved) - GET(moved), between = BETWEEN;
        vec3  then = along_of(SHARED_READ(section)), t = along_of(SHARED_READ(tried));
        float l = local(rest_length), pull = l * dot(t, f);
        symmetric c = symmetric(ROW(hinge_diagonal, i) + ROW(hinge_diagonal, i + 1u),
                                ROW(hinge_beside, i) + ROW(hinge_beside, i + 1u));
        vec3 moment = ROW(hinge_moment, i + 1u) - ROW(hinge_moment, i);
        // Tension resists turning, compression does the opposite.
        if (exact) c = minus(plus(c, multiple_of_one(pull)), times(0.5 * l, twice_mixed(t, f)));
        else c = plus(c, minus(multiple_of_one(max(pull, 0.0)), times(max(pull, 0.0), outer(t))));
        c      = plus(c, times(twist_hold(l, dot(t, times(c, t))), outer(t)));
        vec3 e = l * change_by(local(turn), then) - to;
#ifdef HAIR_PINNED
        e += l * then - between;
#endif
        if (i + 1u < guide_count) {
            float max_value = looser * l * length_error(local(turn));
            loose      = loose || bits_of(dot(e, e)) > floatBitsToUint(max_value * max_value);
            PUT_ROW(turn_diagonal, i, c.diagonal);
            PUT_ROW(turn_beside, i, c.beside);
            PUT_ROW(force_diagonal, i, l * t);
            PUT_ROW(right_turn, i, moment + l * cross(t, f));
            PUT_ROW(right_force, i, e);
        }
    }
    ROWS_BARRIER;
    return loose;
}
