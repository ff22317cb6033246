// implicit.glsl - solve A q = r in place, for r in moved[]. A has five diagonals. The CPU prepares
// it for the solver's own method and for implicit Euler.

// Eliminate and substitute by A = L D L^T, with two recurrences over the strand.
void substitute(bool euler)
{
    GROUP_BARRIER;
    SINGLE_THREAD {
        // Sums to subtract from the next row and from the one after it.
        vec3 one = vec3(0.0), two = vec3(0.0);
        for (uint k = 0u; k < guide_count; ++k) {
            vec4 f     = euler ? rod_factor_euler(guide_first + k) : rod_factor(guide_first + k);
            vec3 value = GET_AT(moved, k) - one;
            one        = two + f.y * value;
            two        = f.z * value;
            PUT_AT(moved, k, value * f.x);
        }
        vec3 below = vec3(0.0), below_two = vec3(0.0);
        for (uint k = guide_count; k-- > 0u;) {
            vec4 f     = euler ? rod_factor_euler(guide_first + k) : rod_factor(guide_first + k);
            vec3 value = GET_AT(moved, k) - f.y * below - f.z * below_two;
            below_two  = below;
            below      = value;
            PUT_AT(moved, k, value);
        }
    }
    GROUP_BARRIER;
    RELOAD(moved)
}

#ifdef HAIR_THREAD_PER_GUIDE

void solve_implicit(bool euler) { substitute(euler); }

#else

// Solve by parallel cyclic reduction of pairs of vertices. The CPU has reduced the matrix already
// (lib/rod/cyclic_reduction.c). Its factors are 0 where a pair has no other pair at that distance.
// Implicit Euler is rare, and substitutes. Guides without a reduction substitute too, because they
// mostly have one thread each.
void solve_implicit(bool euler)
{
#if !defined(HAIR_PASS1) || defined(HAIR_STIFF)
    if (euler || uint(reduction.length()) < params.vertices) {
        substitute(euler);
        return;
    }
#endif
    uint i = lane;
    bool there = i < guide_count;
    uint row_of = there ? guide_first + i : (params.rounds + 1u) * params.vertices,
         next = there ? params.vertices : 0u;
    uint pair = i & ~1u, rounds = params.rounds;
    vec3 r = there ? GET(moved) : vec3(0.0);
    for (uint reach = 2u; reach < guide_count && rounds > 0u; reach *= 2u, --rounds, row_of += next) {
        vec4 m    = reduction[row_of];
        uint up = pair - reach, down = pair + reach;
        broadcast(r);
        // Separate statements compile to one instruction each.
        r = m.x * broadcast_from(up) + r;
        r = m.y * broadcast_from(up + 1u) + r;
        r = m.z * broadcast_from(down) + r;
        r = m.w * broadcast_from(down + 1u) + r;
    }
    vec4 m = reduction[row_of];
    broadcast(r);
    PUT(moved, m.x * broadcast_from(pair) + m.y * broadcast_from(pair + 1u));
}

#endif
