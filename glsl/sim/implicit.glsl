// implicit.glsl - A q = r for r in moved[], in place. A has five diagonals and was made ready on the CPU, for the
// solver's own method and for implicit Euler.

// Elimination and substitution by A = L D L^T: two recurrences over the strand.
void substitute(bool euler)
{
    EACH(guide_count) { row[i] = euler ? rod[guide_first + i].factor_euler : rod[guide_first + i].factor; }
    MEET;
    ONCE(3u) { // each component by itself
        float one = 0.0, two = 0.0; // what the rows one and two above hand down
        for (uint k = 0u; k < guide_count; ++k) {
            vec4  f     = row[k];
            float value = COMPONENT(moved, k, j) - one;
            one         = two + f.y * value;
            two         = f.z * value;
            COMPONENT(moved, k, j) = value * f.x;
        }
        float below = 0.0, below_two = 0.0;
        for (uint k = guide_count; k-- > 0u;) {
            vec4  f     = row[k];
            float value = COMPONENT(moved, k, j) - f.y * below - f.z * below_two;
            below_two   = below;
            below       = value;
            COMPONENT(moved, k, j) = value;
        }
    }
    MEET;
}

#ifdef HAIR_THREAD_PER_GUIDE

void solve_implicit(bool euler) { substitute(euler); }

#else

vec3 reduced_from(vec4 m, uint block, uint reach)
{
    uint i = gl_LocalInvocationID.x;
    vec3 r = GET(moved, i);
    if (block >= reach) {
        uint k = 2u * (block - reach);
        r += m.x * GET(moved, k) + m.y * GET(moved, k + 1u);
    }
    uint k = 2u * (block + reach);
    if (k < guide_count) r += m.z * GET(moved, k) + m.w * (k + 1u < guide_count ? GET(moved, k + 1u) : vec3(0.0));
    return r;
}

// Of a work group: parallel cyclic reduction of pairs of vertices, the matrix's part of it done (lib/sim/reduce.c).
// Implicit Euler is rare, and substitutes; so does who has no reduction, since threads have the guides mostly.
void solve_implicit(bool euler)
{
    MEET;
    if (euler || uint(reduction.length()) < params.vertices) {
        substitute(euler);
        return;
    }
    uint i = gl_LocalInvocationID.x, block = i / 2u, at = guide_first + i, blocks = (guide_count + 1u) / 2u;
    for (uint reach = 1u; reach < blocks; reach *= 2u, at += params.vertices) {
        vec3 r = i < guide_count ? reduced_from(reduction[at], block, reach) : vec3(0.0);
        MEET;
        if (i < guide_count) PUT(moved, i, r);
        MEET;
    }
    vec3 q = vec3(0.0);
    if (i < guide_count) {
        vec4 m    = reduction[at];
        uint k    = 2u * block;
        vec3 odd  = k + 1u < guide_count ? GET(moved, k + 1u) : vec3(0.0);
        q         = m.x * GET(moved, k) + m.y * odd;
    }
    MEET;
    if (i < guide_count) PUT(moved, i, q);
    MEET;
}

#endif
