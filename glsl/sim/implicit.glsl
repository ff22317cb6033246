// implicit.glsl - A q = r for r in moved[], in place. A has five diagonals and was made ready on the CPU, for the
// solver's own method and for implicit Euler.

// Elimination and substitution by A = L D L^T: two recurrences over the strand.
void substitute(bool euler)
{
    MEET;
    ONCE {
        vec3 one = vec3(0.0), two = vec3(0.0); // what the rows one and two above hand down
        for (uint k = 0u; k < guide_count; ++k) {
            vec4 f     = euler ? rod[guide_first + k].factor_euler : rod[guide_first + k].factor;
            vec3 value = GET_AT(moved, k) - one;
            one        = two + f.y * value;
            two        = f.z * value;
            PUT_AT(moved, k, value * f.x);
        }
        vec3 below = vec3(0.0), below_two = vec3(0.0);
        for (uint k = guide_count; k-- > 0u;) {
            vec4 f     = euler ? rod[guide_first + k].factor_euler : rod[guide_first + k].factor;
            vec3 value = GET_AT(moved, k) - f.y * below - f.z * below_two;
            below_two  = below;
            below      = value;
            PUT_AT(moved, k, value);
        }
    }
    MEET;
    RENEW(moved)
}

#ifdef HAIR_THREAD_PER_GUIDE

void solve_implicit(bool euler) { substitute(euler); }

#else

// Parallel cyclic reduction of pairs of vertices, the matrix's part of it done (lib/sim/reduce.c): 0 where a pair has no
// other at that distance. Implicit Euler is rare, and substitutes; so does who has no reduction, since threads have the
// guides mostly.
void solve_implicit(bool euler)
{
#ifndef HAIR_FIRST
    if (euler || uint(reduction.length()) < params.vertices) {
        substitute(euler);
        return;
    }
#endif
    uint i = lane;
    bool there = i < guide_count;
    uint row_of = there ? guide_first + i : (params.rounds + 1u) * params.vertices, next = there ? params.vertices : 0u;
    uint pair = i & ~1u, rounds = params.rounds;
    vec3 r = there ? GET(moved) : vec3(0.0);
    for (uint reach = 2u; reach < guide_count && rounds > 0u; reach *= 2u, --rounds, row_of += next) {
        vec4 m    = reduction[row_of];
        uint up = pair - reach, down = pair + reach;
        lend(r);
        r = m.x * lent_by(up) + r; // One after the other, so that each is one instruction.
        r = m.y * lent_by(up + 1u) + r;
        r = m.z * lent_by(down) + r;
        r = m.w * lent_by(down + 1u) + r;
    }
    vec4 m = reduction[row_of];
    lend(r);
    PUT(moved, m.x * lent_by(pair) + m.y * lent_by(pair + 1u));
}

#endif
