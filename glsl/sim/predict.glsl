// predict.glsl - where a substep would lead if lengths were free and no solid in the way. With v the velocity, c the
// damping, u the wind, g the gravity, w the pull to the target t, f the bending force on the mass m:
//
//   dv/dt = g + f/m + w^2 (t - x) - c (v - u) + a
//
// with a, where there is a crowd, what the hair around does, the same for a block of substeps; u is 0 where there is no
// wind, and where there is, drag comes in as well: see drag.glsl.
// All in displacements over a substep of length h. `wanted` is the answer.
#include "sim/implicit.glsl"

#define SHAKE 0  // leapfrog: Verlet's second order, damping exact; lengths corrected along the edges of the start
#define BACK 1   // BDF2: second order, stable at any stiffness
#define EULER 2  // implicit Euler: first order, more stable still
#define LEADER 3 // the same, then follow the leader

#if HAIR_SOLVER != SHAKE || defined(HAIR_STIFF)
#define KEEPS_RATES
OWN(vec3, rate);        // h v at the end of the last substep; the displacement while known < 2
OWN(vec3, rate_before); // and of the one before
#endif
#ifdef HAIR_CROWD
layout(binding = HAIR_UNIT_PUSH) uniform samplerBuffer push_texture;
OWN(vec3, push); // acceleration by the hair around, m/s^2
#endif
#ifdef HAIR_STIFF
int own_method; // of the guide
#else
const int own_method = HAIR_SOLVER;
#endif
OWN(vec4, aim);         // rest position from the root, in groom space; w^2
float     known;     // of the past: 0: nothing, at rest; 1: displacement; 2: rates too
vec4      turn_then; // turn_now, of the substep before

// The configuration whose bending acts, as a displacement from the start.
vec3 offset_of(uint i, int method, vec3 last)
{
    if (own(slack) == 0.0) return method != SHAKE ? held_move(i) : vec3(0.0);
    return method == BACK ? last / 3.0 : vec3(0.0);
}

#ifdef HAIR_WIND
#include "sim/drag.glsl"
#endif

// SHAKE: d' = keep d + kick (g + f/m), forces of the start.
void leap(uint i, vec3 force, vec3 bending)
{
    float part = known == 0.0 ? 0.5 : 1.0; // The first leap is half a step.
    vec3  d    = own(displacement), push = force + own(slack) * bending;
#ifdef HAIR_WIND
    own(wanted) = d + part * dragged_on(d, push);
#else
    own(wanted) = d + part * ((params.keep - 1.0) * d + params.kick * push);
#endif
}

// What BDF2, or implicit Euler, begins with: h v.
vec3 rate_from(uint i, bool two)
{
#ifdef KEEPS_RATES
    return two ? (4.0 * own(rate) - own(rate_before)) / 3.0 : known < 2.0 ? own(displacement) : own(rate);
#else
    return own(displacement);
#endif
}

// x' = x + e d + q, q = b h v' with b = 2/3, e = 1/3 (BDF2) or 1, 0 (Euler):
// ((1 + b c h + b^2 h^2 w^2) m + b^2 h^2 K) q = b h v m + b^2 h^2 (m (g + c u) + f), f of the end but for q.
void step_back(uint i, bool two, vec3 force, vec3 bending)
{
    float h = params.gravity.w, b = two ? 2.0 / 3.0 : 1.0;
    vec3  hv = rate_from(i, two);
    own(wanted) = two ? own(displacement) / 3.0 : vec3(0.0);
#ifdef HAIR_WIND
    hv += b * drifts;
#endif
    PUT(moved, (b * hv + b * b * h * h * force) / own(slack) + b * b * h * h * bending);
#ifdef HAIR_WIND
    PUT(moved, dragged_back(i, b, GET(moved)));
#endif
}

void predict(int method)
{
    bool at_end  = method != SHAKE; // is where forces are of
    vec4 turn    = at_end ? turn_now : turn_then;
    scalp        = quat_multiply(turn, guide[guide_number].root_frame);
    EACH(guide_count) { PUT(moved, offset_of(i, method, own(displacement))); }
    MEET;
    give_length();
    measure(1.0);
    find_bending();

    EACH(guide_count) {
        // Of what its inertia would weigh: see lib/sim/taut.c.
        float share  = heavy && i > 0u && i + 1u < guide_count
                           ? min(0.5 * (rod[guide_first + i - 1u].segment.x + own(rest_length)) * own(slack), 1.0) : 1.0;
#ifdef HAIR_WIND
        vec3 before = BEFORE_VEC3(edge);
        feel_air(i, before, share, method == SHAKE ? own(displacement) : rate_from(i, method == BACK));
#endif
        own(wanted)  = held_move(i);
        vec3 bending = by_segments(i);
        vec3 force   = share * params.gravity.xyz;
        if (own(aim).w > 0.0) force += own(aim).w * (rotate(turn, own(aim).xyz) + (at_end ? root_moved - GET(moved) : vec3(0.0)) - GET(place));
#ifdef HAIR_CROWD
        force += own(push);
#endif
        PUT(moved, vec3(0.0));
        if (own(slack) > 0.0) {
            if (method == SHAKE) leap(i, force, bending);
            else step_back(i, method == BACK, force, bending);
        }
    }
    if (method == SHAKE) {
        EACH(guide_count - 1u) { PUT(lever, GET(edge)); }
        MEET;
    }
    if (at_end) {
        solve_implicit(method >= EULER);
        EACH(guide_count) {
            if (own(slack) > 0.0) own(wanted) += GET(moved);
        }
    }
}
