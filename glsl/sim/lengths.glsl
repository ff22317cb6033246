// lengths.glsl - rest lengths, exactly: Newton's method on all lengths of a strand at once, each step a tridiagonal
// system (Han and Harada 2013), contact within it. The corrections of vertex i, wanted by the segments on both its
// sides, pass its contact: that makes its inverse mass an operator.
//
// Where bending is taken implicitly what keeps the lengths moves the strand by A^-1 = (M + b^2 K)^-1, as all forces
// do: by M^-1 alone the shape at rest would depend on the substep, and a stiff strand with a kink would flail. The
// first steps correct them so, the others, of what is left, by M^-1, which is exact sooner.
#include "sim/contact_try.glsl"
#include "sim/past.glsl"
#ifdef HAIR_TIED
#include "sim/tie.glsl"
#endif
#include "sim/leader.glsl"

OWN(float, hinge_along); // what bending, taken for a spring along the strand, has against what is wanted of it

#ifndef KEEPS_RATES
#define STIFFLY 0u // None is that stiff.
#else
#define STIFFLY (HAIR_SOLVER == SHAKE ? 3u : 1u) // steps by A^-1: the bias at rest is a tenth with each
#endif
#define MOST_STEPS 8u

// The inverse of J A^-1 J^T out of that of J M^-1 J^T: add b^2 times what K does along the strand, a tridiagonal
// product. Of a straight strand that is the inverse, of another nearly (as of fluids, Cahouet and Chabard 1988).
void stiffen_solution(float b)
{
    uint segments = guide_count - 1u;
    EACH(segments) { PUT(handed, vec3(own(hinge_along))); }
    MEET;
    EACH(segments) {
        vec3  after   = AFTER_VEC3(handed);
        float massive = 1.0 + b * params.damping + b * b * own(aim).w;
        float stiffly = b * b * (own(hinge_along) - (i + 1u < segments ? after.x : 0.0)) / own(rest_length);
        own(solution) = massive * own(solution) + stiffly;
    }
    MEET;
}

// By A^-1 of the forces in moved[].
void move_stiffly()
{
    solve_implicit(false);
    EACH(guide_count) {
        if (own(slack) > 0.0) own(wanted) += GET(moved);
        FIND_TENSION(1.0);
    }
}

// Of vertex i and the segments p and q beside it, with S its inverse mass as an operator: p.S q and so on. Of a leap, whose
// forces are those of the start, what is lacking at first is made up for along the segments there.
void correct_lengths(int method, uint n)
{
    bool of_start = IS_SHAKE(method), stiffly = n < STIFFLY && IS_BACK(method);
    uint segments = guide_count - 1u;
    if (SOLIDS && LEAPS(method) && n == 0u) {
        EACH(segments) { PUT(edge, normalize(AFTER_VEC3(place) - GET(place))); }
        MEET;
    }
    EACH(guide_count) {
        vec3 before = BEFORE_VEC3(edge), along_before = before, along = GET(edge);
        if (HAIR_SOLVER == SHAKE) { // Which alone has other directions.
            vec3 first   = BEFORE_VEC3(lever);
            along_before = of_start ? first : before;
            along        = of_start ? GET(lever) : along;
        }
        vec3 by_own    = own(slack) * (SOLIDS ? pass_back(own(touch), own(slip), GET(edge)) : GET(edge));
        vec3 by_before = own(slack) * (SOLIDS ? pass_back(own(touch), own(slip), before) : before);
        own(row)       = vec4(i > 0u ? -dot(by_own, along_before) : 0.0, dot(by_own, along), 0.0, -own(excess));
        PUT(handed, vec3(dot(by_before, along_before), -dot(by_before, along), -own(excess) / own(rest_length))); // To the neighbours.
    }
    MEET;
    EACH(segments) {
        vec3 after = AFTER_VEC3(handed), before = BEFORE_VEC3(handed);
        float turned = GET(handed).z - (i > 0u ? before.z : 0.0);
        own(hinge_along) = own(strain).w * max(params.ratio.x, params.ratio.z) * turned;
        own(row).y += after.x;
        own(row).z = i + 1u < segments ? after.y : 0.0;
#ifdef HAIR_TIED
        own(row).y *= 1.0 + own(gives);
#endif
        if (own(row).y == 0.0) own(row) = vec4(0.0, 1.0, 0.0, 0.0); // Both ends are held.
    }
    solve_rows(segments);
    if (stiffly) stiffen_solution(2.0 / 3.0 * params.gravity.w);
    EACH(segments) { PUT(handed, -own(solution) * (of_start ? GET(lever) : GET(edge))); }
    MEET;
    EACH(guide_count) {
        vec3 force = by_segments(i);
        if (stiffly) {
            vec3 by_solids = n == 0u ? pressed(i, method) : vec3(0.0);
            own(wanted) -= by_solids;
            PUT(moved, own(slack) > 0.0 ? force + by_solids / own(slack) : vec3(0.0));
        } else {
            own(wanted) += own(slack) * force;
            FIND_TENSION(1.0);
        }
    }
    if (stiffly) move_stiffly();
}

// Or, by the last of the methods, from root to tip. False: some length is broken even so.
bool fit_lengths(int method, float tolerance, vec3 head_moved)
{
    for (uint n = 0u;; ++n) {
        length_steps = n;
        try_wanted(head_moved, n >= KEEP_FROM);
        if (IS_LEADER(method)) { // What that draws into solids is turned out of them, once.
            follow_leader();
            if (n == (SOLIDS ? 1u : 0u)) return true;
        } else {
            measure(tolerance);
            // One step at least: errors let pass would gather over substeps, and leave at once with a jerk.
            if ((n > 0u && !loose) || n == MOST_STEPS || !has_rounds()) return !broken;
            correct_lengths(method, n);
        }
    }
}
