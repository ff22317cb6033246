// tridiagonal.glsl - a x_(i-1) + b x_i + c x_(i+1) = r for i < n, a of the first and c of the last being 0.

#ifdef HAIR_THREAD_PER_GUIDE

vec4  row[MOST]; // a, b, c, r
float solution[MOST];

// Thomas: elimination downwards, substitution upwards.
void solve_rows(uint n)
{
    vec2 above = vec2(0.0); // c / b and r / b of the row above
    for (uint i = 0u; i < n; ++i) {
        float scale = 1.0 / (row[i].y - row[i].x * above.x);
        above       = vec2(row[i].z * scale, (row[i].w - row[i].x * above.y) * scale);
        row[i].zw   = above;
    }
    float below = 0.0;
    for (uint i = n; i-- > 0u;) {
        below       = row[i].w - row[i].z * below;
        solution[i] = below;
    }
}

#else

shared vec4  row[MOST];
shared vec4  row_next[MOST];
shared float solution[MOST];

// Rows whose diagonal is 1: it need not be handed on.
vec4 reduced(vec4 own_row, vec4 above, vec4 below)
{
    float scale = 1.0 / (1.0 - own_row.x * above.z - own_row.z * below.x);
    return scale * vec4(-own_row.x * above.x, 0.0, -own_row.z * below.z,
                        own_row.w - own_row.x * above.w - own_row.z * below.w);
}

// Parallel cyclic reduction (Hockney 1965): every row is freed of its neighbours at distance 1, 2, 4, ...
void solve_rows(uint n)
{
    uint i    = gl_LocalInvocationID.x;
    vec4 mine = vec4(0.0);
    if (i < n) row[i] = mine = row[i] / row[i].y;
    bool there = false;
    for (uint reach = 1u; reach < n; reach *= 2u) {
        synchronise();
        if (i < n) {
            vec4 none  = vec4(0.0);
            vec4 above = i >= reach ? (there ? row_next[i - reach] : row[i - reach]) : none;
            vec4 below = i + reach < n ? (there ? row_next[i + reach] : row[i + reach]) : none;
            mine       = reduced(mine, above, below);
            if (there) row[i] = mine;
            else row_next[i] = mine;
        }
        there = !there;
    }
    if (i < n) solution[i] = mine.w;
    synchronise();
}

#endif
