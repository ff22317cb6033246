// length_constraints.glsl - exact rest lengths by Newton's method on all lengths of a strand at
// once. Each step solves a tridiagonal system (Han and Harada 2013) that includes contact. Vertex i
// is corrected by the segments on both its sides. Each correction passes its contact, which makes
// the inverse mass of the vertex an operator.
//
// With implicit bending, the forces that keep lengths move the strand by A^-1 = (M + b^2 K)^-1, as
// all forces do. With M^-1 alone, the shape at rest would depend on the substep, and a stiff strand
// with a kink would flail. The first steps use A^-1. The others correct the remaining error by
// M^-1, which converges faster.
#include "sim/contact_try.glsl"
#include "sim/velocity_history.glsl"
#ifdef HAIR_PINNED
#include "sim/pins.glsl"
#endif
#include "sim/follow_the_leader.glsl"

// Resistance of bending to the wanted change of length, with bending as a spring along the strand.
LOCAL(float, hinge_along);

#ifndef KEEPS_RATES
#define STIFFLY 0u // No bending is implicit.
#else
// Number of steps by A^-1. Each of them reduces the bias at rest to a tenth.
#define STIFFLY (HAIR_SOLVER == SHAKE ? 3u : 1u)
#endif
#define MAX_STEPS 8u

#define TOO_LONG 0.01   // Relative error of length at which a method has failed.
#define MIN_GRANT 6e-8  // Fraction of the guide's length, the rounding of its positions.
#define SLOW_GRANT 0.02 // Fraction of the displacement of a vertex.

bool loose; // Result of measure().

#ifdef HAIR_COLLIDERS
#define GRANT (SLOW_GRANT * length(local(displacement) - root_moved))

// Return whether a guide in contact, all of whose vertices are slow, has an error of length above
// SLOW_GRANT of a displacement. The error that a Newton step leaves differs between substeps, so
// that a span between the root and a sticking vertex would tremble.
bool trembles()
{
    bool is_rough = false, touches = false;
    FOR_VERTICES(guide_count) {
        float grant = max(GRANT, MIN_GRANT * guide_length);
        is_rough = is_rough || (i + 1u < guide_count && bits_of(local(excess)) > floatBitsToUint(grant));
        touches  = touches || (i < guide_count && local(touch).w != FREE);
    }
    bvec2 found = group_any(bvec2(is_rough, touches));
    return found.x && found.y;
}
#else
#define GRANT 0.0
#define trembles() false
#endif

// Compute unit edges. Set `loose` if the error of a length exceeds what the relative `tolerance`
// permits. From the first step on, set `loose` also if the guide trembles. The displacement of a
// fast vertex hides errors within the tolerance.
void measure(float tolerance, uint steps)
{
    bool is_loose = false, is_fast = false;
    find_edges();
    FOR_VERTICES(guide_count - 1u) {
        if (i + 1u < guide_count) {
            float max_error = tolerance * local(rest_length);
            is_loose = is_loose || bits_of(local(excess)) > floatBitsToUint(max_error);
            is_fast  = is_fast || GRANT > max_error;
        }
    }
    bvec2 found = group_any(bvec2(is_loose, is_fast));
    loose = found.x || (COLLIDERS && steps > 0u && !found.y && trembles());
}

// Return whether an error of length means that the method has failed.
bool is_broken()
{
    bool broken = false;
    FOR_VERTICES(guide_count - 1u) {
        if (i + 1u < guide_count)
            broken = broken || bits_of(local(excess)) > floatBitsToUint(TOO_LONG * local(rest_length));
    }
    return group_any(bvec2(broken, false)).x;
}

// Turn the solution with J M^-1 J^T into that with J A^-1 J^T. Add b^2 times the effect of K along
// the strand, a tridiagonal product. The sum is exact for a straight strand, and nearly so for
// others (as for fluids, Cahouet and Chabard 1988).
void stiffen_solution(float b)
{
    uint segments = guide_count - 1u;
    FOR_VERTICES(segments) { PUT(handed, vec3(local(hinge_along))); }
    GROUP_BARRIER;
    FOR_VERTICES(segments) {
        vec3  after   = AFTER_VEC3(handed);
        float massive = 1.0 + b * guide_damping + b * b * local(aim).w;
        float stiffly =
            b * b * (local(hinge_along) - (i + 1u < segments ? after.x : 0.0)) / local(rest_length);
        local(solution) = massive * local(solution) + stiffly;
    }
    GROUP_BARRIER;
}

// Move vertices by A^-1 times the forces in moved[].
void move_stiffly()
{
    solve_implicit(false);
    FOR_VERTICES(guide_count) {
        if (local(slack) > 0.0) local(wanted) += GET(moved);
        FIND_TENSION(1.0);
    }
}

// Do one Newton step on the lengths. The entries of the matrix are p.S q, with the directions p and
// q of the segments beside vertex i. S is the inverse mass of the vertex as an operator. The forces
// of a leap are those of the start. The first step of a leap therefore corrects along the
// directions at the start.
void correct_lengths(int method, uint n)
{
    bool of_start = IS_SHAKE(method), stiffly = n < STIFFLY && IS_BACK(method);
    uint segments = guide_count - 1u;
    if (COLLIDERS && LEAPS(method) && n == 0u) {
        FOR_VERTICES(segments) { PUT(edge, normalize(AFTER_VEC3(place) - GET(place))); }
        GROUP_BARRIER;
    }
    FOR_VERTICES(guide_count) {
        vec3 before = BEFORE_VEC3(edge), along_before = before, along = GET(edge);
        // Only SHAKE corrects along other directions.
        if (HAIR_SOLVER == SHAKE) {
            vec3 first   = BEFORE_VEC3(lever);
            along_before = of_start ? first : before;
            along        = of_start ? GET(lever) : along;
        }
        vec3 by_own =
            local(slack) * (COLLIDERS ? pass_back(local(touch), local(slip), GET(edge)) : GET(edge));
        vec3 by_before = local(slack) * (COLLIDERS ? pass_back(local(touch), local(slip), before) : before);
        local(row) = vec4(i > 0u ? -dot(by_own, along_before) : 0.0, dot(by_own, along), 0.0, -local(excess));
        // Hand the terms of this vertex to the rows of the neighbours.
        PUT(handed,
            vec3(dot(by_before, along_before), -dot(by_before, along), -local(excess) / local(rest_length)));
    }
    GROUP_BARRIER;
    FOR_VERTICES(segments) {
        vec3 after = AFTER_VEC3(handed), before = BEFORE_VEC3(handed);
        float turned = GET(handed).z - (i > 0u ? before.z : 0.0);
        local(hinge_along) = local(strain).w * max(params.ratio.x, params.ratio.z) * turned;
        local(row).y += after.x;
        local(row).z = i + 1u < segments ? after.y : 0.0;
#ifdef HAIR_PINNED
        local(row).y *= 1.0 + local(gives);
#endif
        // Both ends are held.
        if (local(row).y == 0.0) local(row) = vec4(0.0, 1.0, 0.0, 0.0);
    }
    solve_rows(segments);
    if (stiffly) stiffen_solution(2.0 / 3.0 * params.gravity.w);
    FOR_VERTICES(segments) { PUT(handed, -local(solution) * (of_start ? GET(lever) : GET(edge))); }
    GROUP_BARRIER;
    FOR_VERTICES(guide_count) {
        vec3 force = by_segments(i);
        if (stiffly) {
            vec3 by_colliders = n == 0u ? pressed(i, method) : vec3(0.0);
            local(wanted) -= by_colliders;
            PUT(moved, local(slack) > 0.0 ? force + by_colliders / local(slack) : vec3(0.0));
        } else {
            local(wanted) += local(slack) * force;
            FIND_TENSION(1.0);
        }
    }
    if (stiffly) move_stiffly();
}

// Fit the lengths by Newton steps, or by follow-the-leader if `method` is the last one. Return
// false if a length is still broken.
bool fit_lengths(int method, float tolerance, vec3 head_moved)
{
    for (uint n = 0u;; ++n) {
        length_steps = n;
        try_wanted(head_moved, n >= KEEP_FROM);
        // Vertices that are drawn into colliders are pushed out once.
        if (IS_LEADER(method)) {
            follow_leader();
            if (n == (COLLIDERS ? 1u : 0u)) return true;
        } else {
            measure(tolerance, n);
            // Do at least one step. Skipped errors would add up over substeps, and then leave at
            // once with a jerk.
            if (n > 0u && !loose) return true;
            if (n == MAX_STEPS || !has_rounds()) return !is_broken();
            correct_lengths(method, n);
        }
    }
}
