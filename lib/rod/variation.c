// variation.c - a rod's energy to second order in the turns of its segments. It gives the test for
// stability, and the step of Newton's method.
//
// The forces F_i, the stress G, e and (w, v) are those of statics.c. Let segment i turn by a_i in
// its own frame: q_i <- q_i exp(a_i / 2). Let a and b be the turns before and after a vertex, k its
// stiffness, and R the ratios of rod.h. To second order the vertex's energy changes by
//
//   G . du + k/2 du . R du - (G . v + e w) (a^2 + b^2) / 4 - G . Im(a (w, v) b) / 2
//     + e v . (a - b) + k R_z/2 (v . (a - b))^2 + e/2 a . (w + [v]x) b
//   du = (w + [v]x) b - (w - [v]x) a
//
// The force F on a segment of length l along y changes the energy by
//
//   -l (y x F) . a + l (F.y a^2 - (a . F) a.y) / 2
//
// The pull adds sum_k p_k |dx_k|^2 / 2, where
//
//   dx_(i+1) = dx_i + D_i a_i,   D_i a = l_i q_i (a x y) q_i*
//
// This couples every segment to every other. But the part beyond vertex i depends on the rest only
// through x = dx_i and a = a_(i-1). The minimum of its energy is
//
//   V_i(x, a) = min_b [vertex_i(a, b) + segment_i(b) + p_(i+1) |x + D_i b|^2 / 2
//                      + V_(i+1)(x + D_i b, b)]
//
// V_i is again quadratic, from V_(n-1) = 0 at the tip to V_0(0, 0) at the clamp. The whole energy
// is positive when the 3 x 3 matrix of each b is positive. This is a Riccati recursion, and its
// cost is linear in the number of vertices. The turns include twist. The test thus finds all
// buckling of a rod, in and out of plane.
//
// Small motions about a pose oscillate at a squared frequency of more than W when the energy less
//
//   sum_k m_k W |dx_k|^2 / 2
//
// is positive. Subtracting this term is equivalent to a pull p_k that is weaker by m_k W.
#include "lib/rod/statics.h"

#include <string.h>

struct block3 {
    double m[3][3];
};

// Compute out += a b.
static void add_product(struct block3* out, const struct block3* a, const struct block3* b)
{
    for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c)
            out->m[r][c] += a->m[r][0] * b->m[0][c] + a->m[r][1] * b->m[1][c] + a->m[r][2] * b->m[2][c];
}

// Compute out += sign a^T b.
static void add_transposed(struct block3* out, double sign, const struct block3* a, const struct block3* b)
{
    for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c)
            out->m[r][c] +=
                sign * (a->m[0][r] * b->m[0][c] + a->m[1][r] * b->m[1][c] + a->m[2][r] * b->m[2][c]);
}

// Factor a = L L^T. Read only the lower half of a, and write L there. Return false if a is not
// positive.
static bool factor(struct block3* a)
{
    for (int c = 0; c < 3; ++c) {
        double d = a->m[c][c];
        for (int n = 0; n < c; ++n) d -= a->m[c][n] * a->m[c][n];
        if (!(d > 0)) return false;
        a->m[c][c] = sqrt(d);
        for (int r = c + 1; r < 3; ++r) {
            double sum = a->m[r][c];
            for (int n = 0; n < c; ++n) sum -= a->m[r][n] * a->m[c][n];
            a->m[r][c] = sum / a->m[c][c];
        }
    }
    return true;
}

// Compute x = L^-1 x.
static void solve_lower(const struct block3* l, double* x, int stride)
{
    for (int r = 0; r < 3; ++r) {
        HAIR_ASSERT(l->m[r][r] > 0);
        for (int n = 0; n < r; ++n) x[stride * r] -= l->m[r][n] * x[stride * n];
        x[stride * r] /= l->m[r][r];
    }
}

// Compute x = L^-T x.
static void solve_upper(const struct block3* l, double* x)
{
    for (int r = 3; r-- > 0;) {
        for (int n = r + 1; n < 3; ++n) x[r] -= l->m[n][r] * x[n];
        x[r] /= l->m[r][r];
    }
}

// Second derivatives of a vertex's energy by the turns a a, b a and b b.
struct hinge {
    struct block3 before, between, after;
};

static struct hinge hinge_of(const struct hair_rod_shape* s, const struct hair_rod_pose* pose, uint32_t i)
{
    HAIR_ASSERT(i + 1 < s->count);
    const hair_dquat t = pose->turn[i];
    const hair_dvec3 q = pose->stress[i];
    const double v[3] = {t.x, t.y, t.z}, g[3] = {q.x, q.y, q.z}, w = t.w, e = pose->real_stress[i];
    // Derivative of du by b. The transpose is the derivative by -a.
    const double by_b[3][3] = {{w, -v[2], v[1]}, {v[2], w, -v[0]}, {-v[1], v[0], w}};
    const double turned[3][3] = {{0, -g[2], g[1]}, {g[2], 0, -g[0]}, {-g[1], g[0], 0}};
    const double strained = g[0] * v[0] + g[1] * v[1] + g[2] * v[2], stiffness = hair_rod_stiffness(s, i);
    const hair_dvec3 ratios = hair_rod_ratios_at(s, i);
    const double ratio[3] = {ratios.x, ratios.y, ratios.z};
    // Stiffness times the derivative of du by -a, and by b.
    double by_a[3][3], with_b[3][3];
    struct hinge h;
    for (int n = 0; n < 3; ++n)
        for (int c = 0; c < 3; ++c) {
            by_a[n][c] = stiffness * ratio[n] * by_b[c][n];
            with_b[n][c] = stiffness * ratio[n] * by_b[n][c];
        }
    for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c) {
            const double* row = by_b[r];
            double same = r == c ? strained / 2 : 0, self = r == c ? (strained + e * w) / 2 : 0;
            double real = stiffness * ratio[2] * v[r] * v[c];
            double aa = row[0] * by_a[0][c] + row[1] * by_a[1][c] + row[2] * by_a[2][c];
            double ab = row[0] * with_b[0][c] + row[1] * with_b[1][c] + row[2] * with_b[2][c];
            double bb = by_b[0][r] * with_b[0][c] + by_b[1][r] * with_b[1][c] + by_b[2][r] * with_b[2][c];
            h.before.m[r][c] = aa + real - self;
            h.between.m[c][r] =
                (w * turned[r][c] + v[r] * g[c] + g[r] * v[c] + e * row[c]) / 2 - same - ab - real;
            h.after.m[r][c] = bb + real - self;
        }
    return h;
}

// Return D_i of segment i.
static struct block3 swing_of(const struct hair_rod_shape* s, const struct hair_rod_pose* pose, uint32_t i)
{
    hair_dvec3 x = hair_drotate(pose->frame[i], (hair_dvec3){s->length[i], 0, 0});
    hair_dvec3 z = hair_drotate(pose->frame[i], (hair_dvec3){0, 0, s->length[i]});
    return (struct block3){{{z.x, 0, -x.x}, {z.y, 0, -x.y}, {z.z, 0, -x.z}}};
}

// Quadratic energy of the part beyond a vertex, V_(i+1) before eliminate_blocks() and V_i after it:
//
//   V(x, a) = x . xx x / 2 + x . xa a + a . aa a / 2 + along_x . x + along_a . a
struct beyond {
    struct block3 xx, xa, aa;
    double along_x[3], along_a[3];
};

struct variation_stage {
    // L of b's matrix, and L^-1 times the derivatives of b's slope by x and by a.
    struct block3 pivot, by_x, by_a;
    double slope[3]; // L^-1 times b's slope.
};

static struct block3 pivot_of(const struct hair_rod_pose* pose, uint32_t i, double length,
                              const struct block3* swing, const struct beyond* v, struct variation_stage* out)
{
    struct block3 x_b = v->xa, b = v->aa;
    add_product(&x_b, &v->xx, swing);
    add_transposed(&b, 1, swing, &x_b);
    add_transposed(&b, 1, &v->xa, swing);
    hair_dvec3 f = hair_dscale(pose->force[i], length);
    b.m[0][0] += f.y;
    b.m[2][2] += f.y;
    b.m[1][0] -= f.x / 2; // The upper half is not read.
    b.m[2][1] -= f.z / 2;
    for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c) out->by_x.m[r][c] = x_b.m[c][r];
    return b;
}

struct matrix {
    double shift; // Shift that is added to the diagonal.
    double squared_frequency; // Slower oscillations count as unstable.
};

// Advance from V_(i+1) to V_i. Return false if there is no minimum. `slope` is the derivative of
// the energy by the turn of segment i. NULL omits the linear terms.
static bool eliminate_blocks(const struct hair_rod_shape* s, const struct hair_rod_pose* pose, uint32_t i,
                             struct matrix matrix, const hair_dvec3* slope, struct beyond* v,
                             struct variation_stage* out)
{
    struct hinge h = hinge_of(s, pose, i);
    struct block3 swing = swing_of(s, pose, i);
    double pull = s->mass[i + 1] * (s->pull[i + 1] - matrix.squared_frequency);
    for (int r = 0; r < 3; ++r) v->xx.m[r][r] += pull;
    out->pivot = pivot_of(pose, i, s->length[i], &swing, v, out);
    out->by_a = h.between;
    for (int r = 0; r < 3; ++r) {
        for (int c = 0; c < 3; ++c) out->pivot.m[r][c] += h.after.m[r][c];
        out->pivot.m[r][r] += matrix.shift;
    }
    if (!factor(&out->pivot)) return false;
    for (int c = 0; c < 3; ++c) {
        solve_lower(&out->pivot, &out->by_x.m[0][c], 3);
        solve_lower(&out->pivot, &out->by_a.m[0][c], 3);
    }
    v->xa = (struct block3){0};
    v->aa = h.before;
    add_transposed(&v->xx, -1, &out->by_x, &out->by_x);
    add_transposed(&v->xa, -1, &out->by_x, &out->by_a);
    add_transposed(&v->aa, -1, &out->by_a, &out->by_a);
    if (!slope) return true;
    double own[3] = {slope->x, slope->y, slope->z};
    for (int r = 0; r < 3; ++r) {
        out->slope[r] = own[r] + v->along_a[r];
        for (int n = 0; n < 3; ++n) out->slope[r] += swing.m[n][r] * v->along_x[n];
    }
    solve_lower(&out->pivot, out->slope, 1);
    for (int r = 0; r < 3; ++r) {
        v->along_a[r] = 0;
        for (int n = 0; n < 3; ++n) {
            v->along_x[r] -= out->by_x.m[n][r] * out->slope[n];
            v->along_a[r] -= out->by_a.m[n][r] * out->slope[n];
        }
    }
    return true;
}

bool hair_rod_is_stable(const struct hair_rod_shape* s, const struct hair_rod_pose* pose,
                        double squared_frequency)
{
    struct beyond v = {0};
    struct variation_stage stage;
    for (uint32_t i = s->count - 1; i-- > 0;)
        if (!eliminate_blocks(s, pose, i, (struct matrix){0, squared_frequency}, NULL, &v, &stage))
            return false;
    return true;
}

bool hair_rod_find_step(const struct hair_rod_shape* s, const struct hair_rod_pose* pose, double shift,
                        const hair_dvec3* slope, hair_dvec3* out)
{
    struct variation_stage stage[HAIR_MAX_GUIDE_VERTICES];
    struct beyond v = {0};
    double x[3] = {0}, a[3] = {0};
    for (uint32_t i = s->count - 1; i-- > 0;)
        if (!eliminate_blocks(s, pose, i, (struct matrix){shift, 0}, slope + i, &v, stage + i)) return false;
    for (uint32_t i = 0; i + 1 < s->count; ++i) {
        const struct variation_stage* at = stage + i;
        struct block3 swing = swing_of(s, pose, i);
        double b[3];
        for (int r = 0; r < 3; ++r) {
            b[r] = -at->slope[r];
            for (int n = 0; n < 3; ++n) b[r] -= at->by_x.m[r][n] * x[n] + at->by_a.m[r][n] * a[n];
        }
        solve_upper(&at->pivot, b);
        for (int r = 0; r < 3; ++r)
            for (int n = 0; n < 3; ++n) x[r] += swing.m[r][n] * b[n];
        memcpy(a, b, sizeof a);
        out[i] = (hair_dvec3){b[0], b[1], b[2]};
    }
    return true;
}
