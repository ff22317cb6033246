// predict.glsl - the displacement of a substep if lengths were free and there were no colliders. v
// is the velocity, c the damping, u the wind, g gravity, w the pull to the target t, and f the
// bending force on the mass m:
//
//   dv/dt = g + f/m + w^2 (t - x) - c (v - u) + a
//
// a is the acceleration by the hair around, constant for a block of substeps, or 0 without
// hair-hair interaction. u is 0 without wind. Wind also adds drag, which drag.glsl explains. All
// quantities are displacements over a substep of length h. `wanted` is the result.
#include "sim/implicit.glsl"
#include "sim/methods.glsl"

// Return the configuration whose bending acts, as a displacement from the start.
vec3 offset_of(uint i, int method, vec3 last)
{
    if (IS_SHAKE(method) || LEAPS(method)) return vec3(0.0);
    return local(slack) == 0.0 ? held_move(i) : IS_BACK(method) ? last : vec3(0.0);
}

#ifdef HAIR_WIND
#include "sim/drag.glsl"
#endif

// SHAKE: d' = keep d + kick (g + f/m), with the forces of the start.
void leap(uint i, vec3 force, vec3 bending)
{
    float span = leap_span();
    vec3  d    = leap_part * local(displacement), push = force + local(slack) * bending;
#ifdef HAIR_WIND
    local(wanted) = d + span * dragged_on(d, push);
#else
    local(wanted) = d + span * ((part_keep - 1.0) * d + part_kick * push);
#endif
}

// Return h v from which BDF2, a leap or implicit Euler begins.
vec3 rate_from(uint i, int method)
{
#ifdef KEEPS_RATES
    if (known < 2.0) return local(displacement);
    return IS_BACK(method) ? (4.0 * local(rate) - spilled(rate_before)) / 3.0 : local(rate);
#else
    return local(displacement);
#endif
}

// Set up the right side of BDF2, implicit Euler or a leap. x' = x + e d + q and q = b h v'. BDF2
// has b = 2/3 and e = 1/3. Euler has b = 1 and e = 0:
//
//   ((1 + b c h + b^2 h^2 w^2) m + b^2 h^2 K) q = b h v m + b^2 h^2 (m (g + c u) + f)
//
// f is the force at the end of the substep without q. BDF2 solves for q - (2/3) d, with f at x + d.
// The matrix K is that of a straight rod. For a bent rod that turns, K is stiffer than the rod. K
// therefore acts only on a term of second order, and not on the whole turn of a substep. A leap is
// x' = x + d + q. Its right side is h^2 (m (g + c (u - v)) + f), with f at the start.
void step_back(uint i, int method, vec3 force, vec3 bending)
{
    float h = params.gravity.w, b = IS_BACK(method) ? 2.0 / 3.0 : 1.0;
    bool  leaps = LEAPS(method);
    vec3  hv = rate_from(i, method), q = leaps ? -guide_damping * h * hv : b * hv;
    local(wanted) = leaps ? hv : IS_BACK(method) ? local(displacement) : vec3(0.0);
#ifdef HAIR_WIND
    q += leaps ? drifts - by_parts(drags, hv) : b * b * drifts;
#endif
    PUT(moved, (q + of_force * force) / local(slack) + of_force * bending);
#ifdef HAIR_WIND
    PUT(moved, dragged_back(i, b, GET(moved)));
#endif
    if (IS_BACK(method) && !leaps)
        PUT(moved, GET(moved) - (1.0 + b * guide_damping * h) * b / local(slack) * local(displacement));
}

#ifdef KEEPS_RATES
#include "sim/tension.glsl"
#endif

// True if a program keeps the clamp's direction at rest in registers. Programs do so if registers
// suffice, or if they are too few anyway.
#if defined(HAIR_SUBGROUP) && (defined(HAIR_PASS1) || HAIR_SOLVER != BACK)
#define KEEPS_CLAMP true
#else
#define KEEPS_CLAMP false
#endif

void predict(int method)
{
    // Forces are those at the end of the substep.
    bool at_end  = !IS_SHAKE(method) && !LEAPS(method);
    vec4 turn    = at_end ? turn_now : turn_then;
    scalp        = quat_multiply(turn, guide[guide_number].root_frame);
    clamp_way    = KEEPS_CLAMP ? rotate(turn, clamp_at_rest) : rotate(scalp, vec3(0.0, 1.0, 0.0));
    FOR_VERTICES(guide_count) {
        PUT(moved, offset_of(i, method, local(displacement)));
        PUT_SPREAD;
    }
    find_edges();
    KEEP_SPREAD
    GROUP_BARRIER;
    find_bending();
    of_force = params.gravity.w * params.gravity.w * (IS_BACK(method) && at_end ? 4.0 / 9.0 : 1.0);
#ifdef KEEPS_RATES
    if (IS_BACK(method)) pull_on();
#endif

    FOR_VERTICES(guide_count) {
        // Fraction of the vertex's inertia that has weight. See lib/rod/tip_inertia.c.
        float fraction =
            heavy && i > 0u && i + 1u < guide_count
                ? min(0.5 * (rod_segment(guide_first + i - 1u).x + local(rest_length)) * local(slack), 1.0)
                : 1.0;
#ifdef HAIR_WIND
        vec3 before = BEFORE_VEC3(edge);
        feel_air(i, before, fraction,
                 IS_SHAKE(method) ? leap_part * local(displacement) : rate_from(i, method));
#endif
        local(wanted)  = held_move(i);
        vec3 bending = by_segments(i);
        vec3 force   = fraction * params.gravity.xyz;
        if (local(aim).w > 0.0) {
            vec3 ahead = at_end ? root_moved - offset_of(i, method, local(displacement)) : vec3(0.0);
            force += local(aim).w * (rotate(turn, local(aim).xyz) + ahead - GET(place));
        }
#ifdef HAIR_GRID
        force += local(hair_acceleration);
#endif
        PUT(moved, vec3(0.0));
        if (local(slack) > 0.0) {
            if (IS_SHAKE(method)) leap(i, force, bending);
            else step_back(i, method, force, bending);
        }
    }
    if (IS_SHAKE(method)) {
        FOR_VERTICES(guide_count - 1u) { PUT(lever, GET(edge)); }
        GROUP_BARRIER;
    }
    if (!IS_SHAKE(method)) {
        solve_implicit(method >= EULER);
        FOR_VERTICES(guide_count) {
            if (local(slack) > 0.0) local(wanted) += GET(moved);
        }
    }
}
