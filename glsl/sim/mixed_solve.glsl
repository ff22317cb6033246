// mixed_solve.glsl - Newton's system of a guide, solved by block elimination (L D L^T, blocks of 6
// x 6). With the hinge of segment j to the next one, B = H_ab and W the mobility of the vertex
// between, the rows are
//
//   |  P_j   Q_j | theta_j   | B 0 |                          Q_j = -l [t]x at first
//   | Q_j^T -R_j |  f_j    + | 0 W | (theta, f)_(j+1) + (transposed terms of j-1) = (r, e)_j
//
// The force of a block is eliminated first, with Y = Q R^-1. P + Y Q^T is stiffness with inertia,
// and must be positive. A work group eliminates from both ends at once and meets in the middle. Two
// threads do the work. In a subgroup, each half of the threads does the work of one of them
// redundantly.
struct carried { // Terms that elimination subtracts from the next row.
    symmetric turn, force;
    mat3 between;
    vec3 right_turn, right_force;
};

#ifdef HAIR_THREAD_PER_GUIDE
#define BOTH_ENDS false
#define ELIMINATES true
#define GOES_UP(middle) true
#elif defined(ROWS_IN_REGISTERS)
#define BOTH_ENDS true
#define ELIMINATES true
// A row is in the registers of a thread that eliminates it.
#define GOES_UP(middle) (lane <= (middle))
#else
#define BOTH_ENDS true
#define ELIMINATES (lane < 2u)
#define GOES_UP(middle) (lane == 0u)
#endif
bool convex; // All blocks of turns were positive.

#ifdef MOBILITY_IS_MATRIX
#define MOBILITY symmetric
#define MOBILITY_AT(k) symmetric(ROW(mobility_diagonal, k), ROW(mobility_beside, k))
#define BY_MOBILITY(m, w) ((m) * full(w))
symmetric by_mobility(MOBILITY w, symmetric m) { return transposed_times(full(w), full(m) * full(w)); }
symmetric mobility_of(MOBILITY w) { return w; }
#else
#define MOBILITY float
#define MOBILITY_AT(k) ROW(mobility_diagonal, k).x
#define BY_MOBILITY(m, w) ((w) * (m))
symmetric by_mobility(MOBILITY w, symmetric m) { return times(w * w, m); }
symmetric mobility_of(MOBILITY w) { return multiple_of_one(w); }
vec3 times(float w, vec3 v) { return w * v; }
#endif

// Return the block between the turns of two segments. If `up`, its rows belong to the segment
// nearer to the root.
mat3 hinge_between(symmetric c, vec3 moment, bool exact, bool up)
{
    float half_exact = exact ? up ? 0.5 : -0.5 : 0.0;
    return crossing(half_exact * moment) - full(c);
}

symmetric hinge_at(uint i) { return symmetric(ROW(hinge_diagonal, i), ROW(hinge_beside, i)); }

// Eliminate row j. Replace the terms carried to it by those that it carries on across vertex i.
// Nothing changes unless `counts` is set.
void eliminate_row(uint j, uint i, bool exact, bool up, bool counts, inout carried s)
{
    vec3 t = ROW(force_diagonal, j);
    vec3 right = ROW(right_turn, j) - s.right_turn, right_f = ROW(right_force, j) - s.right_force;
    symmetric p = minus(symmetric(ROW(turn_diagonal, j), ROW(turn_beside, j)), s.turn);
    // Mobilities at both ends of the segment.
    MOBILITY  w_other = MOBILITY_AT(up ? j : j + 1u), w = MOBILITY_AT(i);
    symmetric r = plus(plus(mobility_of(w_other), mobility_of(w)), s.force), c = hinge_at(i);
    vec3      moment = ROW(hinge_moment, i);
    mat3      q = -crossing(t) - s.between, b = hinge_between(c, moment, exact, up);
    float     of_r, of_p;
    symmetric of_force = inverse_of(r, of_r);
    mat3      y = q * full(of_force);
    p           = plus(p, times_transposed(y, q));
    symmetric of_turn = inverse_of(p, of_p);
    bool positive = p.diagonal.x > 0.0 && p.diagonal.x * p.diagonal.y > p.beside.z * p.beside.z &&
                    of_p > 0.0 && r.diagonal.x > 0.0;
    convex  = convex && (positive || !counts);
    vec3 turns = times(of_turn, right + y * right_f), forces = turns * y - times(of_force, right_f);
    mat3 xy = full(of_turn) * y, bt = transpose(b), bx = bt * full(of_turn);
    if (counts) {
        PUT_ROW(turn_diagonal, j, of_turn.diagonal);
        PUT_ROW(turn_beside, j, of_turn.beside);
        PUT_ROW(force_diagonal, j, of_force.diagonal);
        PUT_ROW(force_beside, j, of_force.beside);
        PUT_ROW(between_x, j, y[0]);
        PUT_ROW(between_y, j, y[1]);
        PUT_ROW(between_z, j, y[2]);
        PUT_ROW(right_turn, j, turns);
        PUT_ROW(right_force, j, forces);
        s = carried(times_transposed(bx, bt), by_mobility(w, minus(transposed_times(y, xy), of_force)),
                    BY_MOBILITY(bt * xy, w), bt * turns, times(w, forces));
    }
}

#include "sim/mixed_meet.glsl"
#include "sim/mixed_back.glsl"

// Solve the rows. The solution is written to right_turn and right_force.
void solve_system(bool exact)
{
    uint segments = guide_count - 1u, last = segments - 1u, middle = BOTH_ENDS ? segments / 2u : last;
    bool up       = GOES_UP(middle);
    uint rows     = up ? middle : last - middle, max_value = BOTH_ENDS ? max(middle, last - middle) : middle;
    convex        = true;
    carried s     = nothing_carried();
    // The loop includes the middle row, which makes programs half as long.
    for (uint n = 0u; n <= max_value; ++n) {
        bool meets = n == max_value;
        uint j     = meets ? middle : up ? n : last - min(n, last);
        if (meets) add_other_end(up, s);
        if (ELIMINATES) eliminate_row(j, up ? j + 1u : j, exact, up, meets ? up : n < rows, s);
    }
    ROWS_BARRIER;
    substitute_rows(exact, up, rows, max_value, last);
    ROWS_BARRIER;
}
