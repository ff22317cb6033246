// mixed.glsl - rods by the turns of their segments and the forces in them. Derivation:
//
// Vertices i = 0..n-1, segments j = 0..n-2 of frames q_j, whose y axes are the unit tangents t_j.
// f_j is the force in segment j, theta_j a small turn of the segment about the world's axes.
// Everything is divided by the line density.
//
// Time. Implicit Euler (b = 1) and BDF2 (b = 2/3) both move vertex i over a substep h by
//
//   x_i' - x_i = p_i + W_i (f_i - f_(i-1)),   W_i = b^2 h^2 / (m_i (1 + b c h + b^2 h^2 w^2))
//
// with p_i known, damping c and pull w. Drag and contact make W_i a symmetric matrix.
//
// Energy of the hinge at vertex i between the frames a = q_(i-1) and b = q_i:
//
//   E = k/2 (u - u0) . R (u - u0) + k R_z/2 (2 w - 2 w0)^2,   (s, w) = conj(a) b, w >= 0,   u = 2 s
//
// The second term makes the energy grow with the turn from the rest shape up to half a turn. With
// only the first term, a hinge that is bent by nearly half a turn at rest would be soft. Its energy
// would jump where the turn passes half a turn. The moment in the world and the second derivative
// by the turns of both segments are
//
//   g = k R (u - u0),   e = k R_z (2 w - 2 w0),   M_i = a (w g + s x g - e s) a*
//   H_aa = H_bb = C - (g.s + e w)/2 1,   H_ab = -H_bb + [M_i]x / 2
//   C = k R_z 1 + sum_k k (R_k - R_z) j_k j_k^T,   j_k = a (w e_k + s x e_k) a*
//
// The term [M]x / 2 couples bending and twist of a curved strand. Without this term, the one Newton
// step of a substep diverges, because twist has no inertia.
//
// Balance. Segment j of length l_j turns no further, and connects its vertices, where both
// residuals vanish:
//
//   r_j = M_(j+1) - M_j + l_j t_j x f_j
//   e_j = l_j t_j - (x_(j+1)' - x_j')
//
// Newton's method on both is a symmetric system of tridiagonal 6 x 6 blocks. mixed_solve.glsl
// solves it. Positions are sums of l_j t_j, so that lengths are exact whatever is left of e_j.
//
// Sources: M. Bergou et al., Discrete Elastic Rods, 2008, has the energy. T. Kugelstadt and E.
// Schoemer, Position and Orientation Based Cosserat Rods, 2016, and C. Deul et al., Direct
// Position-Based Solver for Stiff Rods, 2018, have turns and forces as unknowns. Both are unknowns
// of one implicit substep here.
// Turn of a segment above which a Newton step is not trusted, rad.
#define MAX_TURN 0.5
// Increment of `known` in a substep whose prediction sufficed.
#define CALM (1.0 / 16.0)
#define MAX_CALM 2.5      // Value of `known` from which turns are extrapolated linearly

LOCAL(vec4, strain);     // xyz: rest strain u0. w: stiffness k.
LOCAL(float, rest_real); // 2 w0 of the hinge
SHARED(vec4, section); // Frame of segment i at the start of the substep
SHARED(vec4, tried);   // Frame that is tried
LOCAL(vec4, turn);       // Rotation from `section` to `tried`
LOCAL(vec3, turned);     // Rodrigues vector of this rotation in the last substep
LOCAL(vec3, turned_before); // Rodrigues vector in the substep before
// Force in segment i at the start of the substep. `handed` has the force that is tried.
LOCAL(vec3, force);
LOCAL(vec3, reached);    // Displacement of vertex i if segments exerted no forces
LOCAL(float, mobility);  // W_i of vertex i without drag and contact
#ifdef HAIR_WIND
// Unit vector along the strand at vertex i, which distinguishes the directions of drag.
LOCAL(vec3, flow);
LOCAL(vec2, mobilities); // Fractions of `mobility` across and along the strand
#endif

bool touching;        // Some vertex can touch a collider in this substep.
bool root_is_clamped; // The hinge at the root has a stiffness.
vec3 root_ratio;      // Value of params.ratio for the hinge at the root

vec4 turn_by(vec3 v) { return normalize(vec4(0.5 * v, 1.0)); }

// Return the change of v when q turns it. A small turn loses no digits.
vec3 change_by(vec4 q, vec3 v)
{
    vec3 c = cross(q.xyz, v);
    return 2.0 * (q.w * c + cross(q.xyz, c));
}

// Return the displacement that a force causes at vertex i.
vec3 yield_to(uint i, vec3 f)
{
#ifdef HAIR_WIND
    float a = dot(f, local(flow));
    f       = local(mobilities).x * (f - a * local(flow)) + local(mobilities).y * a * local(flow);
#endif
    return local(mobility) * f;
}

// Find p_i and W_i of vertex i. `before` is the tangent of the segment before.
void move_freely(uint i, int method, vec3 before)
{
    float h = SUBSTEP, b = IS_BACK(method) ? 2.0 / 3.0 : 1.0;
    vec3  on = IS_BACK(method) ? local(displacement) / 3.0 : vec3(0.0), pull = vec3(0.0);
    vec3  hv = local(displacement);
    if (known >= 2.0) hv = IS_BACK(method) ? (4.0 * local(rate) - spilled(rate_before)) / 3.0 : local(rate);
    if (local(aim).w > 0.0)
        pull = local(aim).w * (rotate(turn_now, local(aim).xyz) + root_moved - on - GET(place));
    vec3 acceleration = params.gravity.xyz + pull;
#ifdef HAIR_GRID
    acceleration += local(hair_acceleration);
#endif
    float massive = 1.0 + b * guide_damping * h + b * b * h * h * local(aim).w;
    vec3  q       = b * hv + b * b * h * h * acceleration;
#ifdef HAIR_WIND
    feel_air(i, before, 1.0, hv);
    q += b * b * drifts;
    local(flow)       = along;
    local(mobilities) = 1.0 / (1.0 + b * drags / massive);
    q               = by_parts(local(mobilities), q);
#endif
    local(mobility) = local(slack) * b * b * h * h / massive;
    local(reached)  = local(slack) > 0.0 ? on + q / massive : held_move(i);
}

// Predict the turns of the segments, and turn the forces in them along. `afresh` predicts none.
void predict_turns(bool afresh)
{
    FOR_VERTICES(guide_count) {
        vec3 by   = known >= MAX_CALM ? 2.0 * local(turned) - local(turned_before) : local(turned);
        local(turn) = afresh ? vec4(0.0, 0.0, 0.0, 1.0) : turn_by(by);
        vec3 f    = afresh ? vec3(0.0) : rotate(local(turn), local(force));
        PUT(handed, i + 1u < guide_count ? f : vec3(0.0));
        SHARED_READ(tried) = normalize(quat_multiply(local(turn), SHARED_READ(section)));
    }
    GROUP_BARRIER;
}

// Find the displacements by the forces that are tried, as if there were no colliders.
void find_wanted()
{
    FOR_VERTICES(guide_count) {
        vec3 before = BEFORE_VEC3(handed);
        local(wanted) = local(reached) + yield_to(i, GET(handed) - (i > 0u ? before : vec3(0.0)));
    }
}

void predict(int method)
{
    scalp     = quat_multiply(turn_now, guide[guide_number].root_frame);
    clamp_way = along_of(scalp);
    GROUP_BARRIER;
    FOR_VERTICES(guide_count) { PUT(edge, along_of(SHARED_READ(section))); }
    GROUP_BARRIER;
#ifdef HAIR_PINNED
    FOR_VERTICES(guide_count) { PUT(moved, local(slack) == 0.0 ? held_move(i) : local(displacement)); }
    GROUP_BARRIER;
    give_length();
#endif
    FOR_VERTICES(guide_count) {
        vec3 before = BEFORE_VEC3(edge);
        move_freely(i, method, before);
    }
    of_force = SUBSTEP * SUBSTEP * (IS_BACK(method) ? 4.0 / 9.0 : 1.0);
    predict_turns(IS_LEADER(method));
    find_wanted();
}

#include "sim/mixed_frames.glsl"
