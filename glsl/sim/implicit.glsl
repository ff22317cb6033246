// implicit.glsl - A q = r for r in moved[], in place: A = L D L^T has five diagonals and was factored on the CPU.

vec4 factor_of(uint i, bool euler) { return euler ? rod[guide_first + i].factor_euler : rod[guide_first + i].factor; }

void solve_implicit(bool euler)
{
    MEET;
    ONCE(3u) { // each component by itself
        float one = 0.0, two = 0.0; // what the rows one and two above hand down
        for (uint k = 0u; k < guide_count; ++k) {
            vec4  f     = factor_of(k, euler);
            float value = moved[k][j] - one;
            one         = two + f.y * value;
            two         = f.z * value;
            moved[k][j] = value * f.x;
        }
        float below = 0.0, below_two = 0.0;
        for (uint k = guide_count; k-- > 0u;) {
            vec4  f     = factor_of(k, euler);
            float value = moved[k][j] - f.y * below - f.z * below_two;
            below_two   = below;
            below       = value;
            moved[k][j] = value;
        }
    }
    MEET;
}
