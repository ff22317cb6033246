// lengths.glsl - rest lengths, exactly: Newton's method on all lengths of a strand at once, each step a tridiagonal
// system (Han and Harada 2013), contact within it. The corrections of vertex i, wanted by the segments on both its
// sides, pass its contact: that makes its inverse mass an operator.
//
// Where bending is taken implicitly what keeps the lengths moves the strand by A^-1 = (M + b^2 K)^-1, as all forces
// do: by M^-1 alone the shape at rest would depend on the substep. The first steps correct them so, the others, of
// what is left, by M^-1, which is exact sooner.
#include "sim/contact.glsl"

SHARED(float, strain_along); // relative correction of length that is wanted of segment i
SHARED(float, hinge_along);  // what bending, taken for a spring along the strand, has against it

#define STIFFLY (HAIR_SOLVER == SHAKE ? 3u : 1u) // steps by A^-1: the bias at rest is a tenth with each
#define MOST_STEPS 8u
#define HEAVY_ROUNDS 6u
#define KEEP_FROM 4u // steps: from here on contacts are only added, so that the steps come to an end

// Which displacement is allowed of what is wanted; and how long that leaves the segments.
void try_wanted(vec3 head_moved, bool keep, float tolerance)
{
    EACH(guide_count) {
        vec4 freedom = vec4(0.0);
        PUT(moved, i, own(wanted));
        if (SOLIDS) {
            if ((own(reachable).x | own(reachable).y) != 0u)
                PUT(moved, i, allowed(i, own(wanted), own(reachable), keep ? own(met) : uvec2(0u), head_moved, freedom, own(met)));
            touch[i] = freedom;
        }
    }
    MEET;
    measure(tolerance);
}

vec3 direction_of(uint i, bool of_start) { return of_start ? GET(lever, i) : GET(edge, i); }

// The inverse of J A^-1 J^T out of that of J M^-1 J^T: add b^2 times what K does along the strand, a tridiagonal
// product. Of a straight strand that is the inverse, of another nearly (as of fluids, Cahouet and Chabard 1988).
void stiffen_solution()
{
    uint  segments = guide_count - 1u;
    float b        = 2.0 / 3.0 * params.gravity.w;
    EACH(segments) {
        float turned = strain_along[i] - (i > 0u ? strain_along[i - 1u] : 0.0);
        hinge_along[i] = own(strain).w * max(params.ratio.x, params.ratio.z) * turned;
    }
    MEET;
    EACH(segments) {
        float massive = 1.0 + b * params.damping + b * b * own(aim).w;
        float stiffly = b * b * (hinge_along[i] - (i + 1u < segments ? hinge_along[i + 1u] : 0.0)) / rest_length[i];
        solution[i]   = massive * solution[i] + stiffly;
    }
    MEET;
}

void correct_lengths(bool of_start, bool stiffly)
{
    uint segments = guide_count - 1u;
    EACH(segments) {
        vec3  below = slack[i] * (SOLIDS ? pass_on(touch[i], GET(edge, i)) : GET(edge, i));
        vec3  above = slack[i + 1u] * (SOLIDS ? pass_on(touch[i + 1u], GET(edge, i)) : GET(edge, i));
        float b     = dot(below + above, direction_of(i, of_start));
        row[i]     = vec4(i > 0u ? -dot(below, direction_of(i - 1u, of_start)) : 0.0, b,
                          i + 1u < segments ? -dot(above, direction_of(i + 1u, of_start)) : 0.0,
                          -own(excess));
        if (b == 0.0) row[i] = vec4(0.0, 1.0, 0.0, 0.0); // Both ends are held.
        if (stiffly) strain_along[i] = -own(excess) / rest_length[i];
    }
    MEET;
    solve_rows(segments);
    if (stiffly) stiffen_solution();
    EACH(guide_count) {
        vec3 force = vec3(0.0);
        if (i > 0u) force += solution[i - 1u] * direction_of(i - 1u, of_start);
        if (i + 1u < guide_count) force -= solution[i] * direction_of(i, of_start);
        if (stiffly) { PUT(moved, i, slack[i] > 0.0 ? force : vec3(0.0)); }
        else own(wanted) += slack[i] * force;
    }
    if (!stiffly) return;
    MEET;
    solve_implicit(false);
    EACH(guide_count) {
        if (slack[i] > 0.0) own(wanted) += GET(moved, i);
    }
}

// False: some length is broken even so.
bool fit_lengths(int method, float tolerance, vec3 head_moved)
{
    bool of_start = method == SHAKE;
    find_solids(head_moved);
    for (uint n = 0u;; ++n) {
        try_wanted(head_moved, n >= KEEP_FROM, tolerance);
        // One step at least: errors let pass would gather over substeps, and leave at once with a jerk.
        if ((n > 0u && loose[slot] == 0u) || n == MOST_STEPS) return broken[slot] == 0u;
        correct_lengths(of_start, own_method != SHAKE && method == BACK && n < STIFFLY);
    }
}

// Vertex k at its length from the one it follows, in the direction that it has from there.
void draw_along(uint k, uint leader, float len, inout vec3 last)
{
    vec3  between = GET(place, k) - GET(place, leader), to = between + (GET(moved, k) - GET(moved, leader));
    float l       = length(to);
    if (bits_of(l) < 0x7f800000u && l > 1e-3 * len) last = to / l;
    PUT(moved, k, GET(moved, leader) - between + len * last);
}

// Each segment drawn after the one above it (Müller et al. 2012), whose place is right already. A tip that outweighs
// its strand is not to be thrown about by it: first the strand is drawn after both ends in turn (Aristidou and Lasenby
// 2011).
void draw_strand()
{
    uint tip  = guide_count - 1u, rounds = heavy ? HEAVY_ROUNDS : 0u;
    vec3 goal = GET(moved, tip), last = rotate(scalp, vec3(0.0, 1.0, 0.0));
    for (uint n = 0u;; ++n) {
        for (uint k = 1u; k <= tip; ++k) draw_along(k, k - 1u, rest_length[k - 1u], last);
        if (n == rounds) break;
        PUT(moved, tip, goal);
        for (uint k = tip; k-- > 1u;) draw_along(k, k + 1u, rest_length[k], last);
    }
}

// What that draws into solids is turned out of them, once.
void follow_leader(vec3 head_moved)
{
    find_solids(head_moved);
    for (uint n = 0u; n < (SOLIDS ? 2u : 1u); ++n) {
        EACH(guide_count) {
            vec4 freedom = vec4(0.0);
            PUT(moved, i, n == 0u ? own(wanted) : GET(moved, i));
            if (SOLIDS) {
                if ((own(reachable).x | own(reachable).y) != 0u)
                    PUT(moved, i, allowed(i, GET(moved, i), own(reachable), uvec2(0u), head_moved, freedom, own(met)));
                touch[i] = vec4(0.0);
            }
        }
        MEET;
        ONCE(1u) { draw_strand(); }
        MEET;
    }
}
