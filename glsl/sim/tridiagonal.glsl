// tridiagonal.glsl - solve a x_(i-1) + b x_i + c x_(i+1) = r for i < n. The first a and the last c
// are 0.
LOCAL(vec4, row); // a, b, c, r
LOCAL(float, solution);

#ifdef HAIR_THREAD_PER_GUIDE

// Thomas algorithm: eliminate downwards, and substitute upwards.
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

// Return row (a, 1, c, r) without its terms of the neighbours.
vec3 reduced(vec3 mine, vec3 above, vec3 below)
{
    float scale = 1.0 / (1.0 - mine.x * above.y - mine.y * below.x);
    return scale * vec3(-mine.x * above.x, -mine.y * below.y, mine.z - mine.x * above.z - mine.y * below.z);
}

// Solve by parallel cyclic reduction (Hockney 1965). Each round removes the neighbours of every row
// at distance 1, 2, 4, and so on. Rows beyond the ends are empty. Rows read around the end have a
// and c of 0.
void solve_rows(uint n)
{
    vec3 mine = lane < n ? row.xzw / row.y : vec3(0.0);
    for (uint reach = 1u; reach < lanes; reach *= 2u) {
        broadcast(mine);
        mine = reduced(mine, broadcast_from(lane - reach), broadcast_from(lane + reach));
    }
    solution = mine.z;
}

#endif
