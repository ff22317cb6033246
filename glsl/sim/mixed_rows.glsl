// mixed_rows.glsl - the rows of Newton's system of a guide, one for each segment and vertex, as
// named vectors.
//
//   FIELD(name, n)        declares the vector n of all rows.
//   ROW(name, k)          reads it in row k. All threads must execute this together.
//   PUT_ROW(name, k, v)   writes it in row k.
//
// A guide that fits into a subgroup has the rows in registers, which its threads read by shuffles.
#if defined(HAIR_SUBGROUP) && HAIR_GUIDE_THREADS == 32 && !defined(HAIR_THREAD_PER_GUIDE)
#define ROWS_IN_REGISTERS
#define ROWS_BARRIER
#define FIELD(name, n) vec3 name
#define ROW(name, k) subgroupShuffle(name, k)
#define PUT_ROW(name, k, v) \
    if ((k) == lane) name = v
#elif defined(HAIR_THREAD_PER_GUIDE)
#define ROWS_BARRIER
#define FIELD(name, n) vec3 name[MAX_VERTICES]
#define ROW(name, k) name[k]
#define PUT_ROW(name, k, v) name[k] = v
#elif HAIR_GUIDE_THREADS <= 64
#define ROWS_BARRIER synchronise()
#define FIELD(name, n) shared vec3 name[HAIR_GUIDE_THREADS + 1]
#define ROW(name, k) name[k]
#define PUT_ROW(name, k, v) name[k] = v
#else // A work group has too little shared memory for such rows.
#define ROWS_BARRIER memoryBarrierBuffer(), synchronise()
#define FIELD(name, n) const uint name = uint(n)
#define ROW(name, k) bend[3u * params.vertices + HAIR_MIXED_ROW_VECTORS * (guide_first + (k)) + name].xyz
#define PUT_ROW(name, k, v) ROW(name, k) = v
#endif

// A symmetric matrix is stored as its diagonal and the elements yz, zx, xy.
// Second derivative of the hinge's energy at vertex k by the turn of one segment.
FIELD(hinge_diagonal, 0);
FIELD(hinge_beside, 1);
FIELD(hinge_moment, 2);      // Moment of the hinge
// W of vertex k. Without colliders and wind only x is used, because W is a multiple of one.
FIELD(mobility_diagonal, 3);
FIELD(mobility_beside, 4);
// Block of the turn of segment k, and its inverse after elimination.
FIELD(turn_diagonal, 5);
FIELD(turn_beside, 6);
// Length of segment k along its tangent, and the inverse of its force's block after elimination.
FIELD(force_diagonal, 7);
FIELD(force_beside, 8);
// Columns of Y, the block between turn and force times the inverse of the force's block.
FIELD(between_x, 9);
FIELD(between_y, 10);
FIELD(between_z, 11);
FIELD(right_turn, 12);       // Residuals, and the solution after the solve
FIELD(right_force, 13);

struct symmetric {
    vec3 diagonal, beside;
};

mat3 full(symmetric s)
{
    vec3 d = s.diagonal, o = s.beside;
    return mat3(d.x, o.z, o.y, o.z, d.y, o.x, o.y, o.x, d.z);
}
symmetric half_of(mat3 m)
{
    return symmetric(vec3(m[0][0], m[1][1], m[2][2]), vec3(m[1][2], m[2][0], m[0][1]));
}
symmetric multiple_of_one(float v) { return symmetric(vec3(v), vec3(0.0)); }
symmetric plus(symmetric a, symmetric b) { return symmetric(a.diagonal + b.diagonal, a.beside + b.beside); }
symmetric minus(symmetric a, symmetric b) { return symmetric(a.diagonal - b.diagonal, a.beside - b.beside); }
symmetric times(float f, symmetric a) { return symmetric(f * a.diagonal, f * a.beside); }

vec3 times(symmetric s, vec3 v)
{
    return s.diagonal * v + s.beside.zxy * v.yzx + s.beside.yzx * v.zxy;
}

// Return v v^T.
symmetric outer(vec3 v) { return symmetric(v * v, v.yzx * v.zxy); }

// Return v w^T + w v^T.
symmetric twice_mixed(vec3 v, vec3 w) { return symmetric(2.0 * v * w, v.yzx * w.zxy + v.zxy * w.yzx); }

// Return a b^T, which must be symmetric.
symmetric times_transposed(mat3 a, mat3 b)
{
    return symmetric(a[0] * b[0] + a[1] * b[1] + a[2] * b[2],
                     a[0].yzx * b[0].zxy + a[1].yzx * b[1].zxy + a[2].yzx * b[2].zxy);
}

// Return a^T b, which must be symmetric.
symmetric transposed_times(mat3 a, mat3 b)
{
    return symmetric(vec3(dot(a[0], b[0]), dot(a[1], b[1]), dot(a[2], b[2])),
                     vec3(dot(a[1], b[2]), dot(a[2], b[0]), dot(a[0], b[1])));
}

symmetric inverse_of(symmetric s, out float determinant)
{
    vec3 d = s.diagonal, o = s.beside;
    symmetric c = symmetric(d.yzx * d.zxy - o * o, o.yzx * o.zxy - d * o);
    determinant = d.x * c.diagonal.x + o.z * c.beside.z + o.y * c.beside.y;
    return times(1.0 / determinant, c);
}

mat3 crossing(vec3 v) { return mat3(0.0, v.z, -v.y, -v.z, 0.0, v.x, v.y, -v.x, 0.0); }
