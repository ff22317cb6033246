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

vec4 reduced(vec4 above, vec4 own_row, vec4 below)
{
    float up   = above.y != 0.0 ? -own_row.x / above.y : 0.0;
    float down = below.y != 0.0 ? -own_row.z / below.y : 0.0;
    return vec4(up * above.x, own_row.y + up * above.z + down * below.x, down * below.z,
                own_row.w + up * above.w + down * below.w);
}

// Parallel cyclic reduction (Hockney 1965): every row is freed of its neighbours at distance 1, 2, 4, ...
void solve_rows(uint n)
{
    uint i     = gl_LocalInvocationID.x;
    bool there = false;
    for (uint reach = 1u; reach < n; reach *= 2u) {
        synchronise();
        if (i < n) {
            vec4 none = vec4(0.0);
            if (there)
                row[i] = reduced(i >= reach ? row_next[i - reach] : none, row_next[i],
                                 i + reach < n ? row_next[i + reach] : none);
            else
                row_next[i] = reduced(i >= reach ? row[i - reach] : none, row[i],
                                      i + reach < n ? row[i + reach] : none);
        }
        there = !there;
    }
    if (i < n) solution[i] = there ? row_next[i].w / row_next[i].y : row[i].w / row[i].y;
    synchronise();
}

#endif
