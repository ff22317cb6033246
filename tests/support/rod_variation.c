// rod_variation.c - a rod's energy to second order in the turns of its segments, as
// lib/rod/block_variation.h describes.
#include "tests/support/rod_statics.h"

#include <string.h>

// Compute the part of a hinge that unit stiffness causes.
static void write_unit_hinge(hair_dquat t, hair_dvec3 ratios, struct hair_rod_hinge* h)
{
    const double v[3] = {t.x, t.y, t.z}, w = t.w;
    const double k[3] = {ratios.x, ratios.y, ratios.z};
    // Derivative of du by b. The transpose is the derivative by -a.
    const double d[3][3] = {{w, -v[2], v[1]}, {v[2], w, -v[0]}, {-v[1], v[0], w}};
    double kd[3][3];
    for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c) kd[r][c] = k[r] * d[r][c];
    for (int r = 0, n = 0; r < 3; ++r)
        for (int c = 0; c <= r; ++c, ++n) {
            double real = k[2] * v[r] * v[c];
            h->before[n] =
                real + k[0] * d[r][0] * d[c][0] + k[1] * d[r][1] * d[c][1] + k[2] * d[r][2] * d[c][2];
            h->after[n] = real + kd[0][r] * d[0][c] + kd[1][r] * d[1][c] + kd[2][r] * d[2][c];
        }
    for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c)
            h->between[r][c] =
                -k[2] * v[r] * v[c] - d[c][0] * kd[0][r] - d[c][1] * kd[1][r] - d[c][2] * kd[2][r];
}

// Compute the part of a hinge that the stress `g` and `e` causes. Return what it subtracts from the
// diagonals of the hinge by a a and by b b.
static double write_stressed_hinge(hair_dquat t, hair_dvec3 g, double e, double between[3][3])
{
    double strained = (g.x * t.x + g.y * t.y + g.z * t.z) / 2, real = e * t.w / 2;
    double x = (t.w * g.x + e * t.x) / 2, y = (t.w * g.y + e * t.y) / 2, z = (t.w * g.z + e * t.z) / 2;
    double xy = (t.x * g.y + t.y * g.x) / 2, xz = (t.x * g.z + t.z * g.x) / 2;
    double yz = (t.y * g.z + t.z * g.y) / 2;
    between[0][0] = t.x * g.x + real - strained;
    between[1][1] = t.y * g.y + real - strained;
    between[2][2] = t.z * g.z + real - strained;
    between[0][1] = xy + z;
    between[1][0] = xy - z;
    between[0][2] = xz - y;
    between[2][0] = xz + y;
    between[1][2] = yz + x;
    between[2][1] = yz - x;
    return strained + real;
}

// Compute a hinge from its part by unit stiffness and its part by stress.
static void combine_hinge(const struct hair_rod_hinge* unit, double stiffness, double self,
                          const double between[3][3], struct hair_rod_hinge* out)
{
    for (int n = 0; n < 6; ++n) {
        double own = n == 0 || n == 2 || n == 5 ? self : 0;
        out->before[n] = stiffness * unit->before[n] - own;
        out->after[n] = stiffness * unit->after[n] - own;
    }
    for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c) out->between[r][c] = stiffness * unit->between[r][c] + between[r][c];
}

static struct hair_rod_swing swing_of(hair_dquat q, double length)
{
    double l2 = 2 * length;
    return (struct hair_rod_swing){
        {l2 * (q.x * q.z + q.w * q.y), l2 * (q.y * q.z - q.w * q.x), length - l2 * (q.x * q.x + q.y * q.y)},
        {l2 * (q.y * q.y + q.z * q.z) - length, -l2 * (q.x * q.y + q.w * q.z), l2 * (q.w * q.y - q.x * q.z)}};
}

// Quadratic energy of the part beyond a vertex, V_(i+1) before eliminate_blocks() and V_i after it:
//
//   V(x, a) = x . xx x / 2 + x . xa a + a . aa a / 2 + along_x . x + along_a . a
//
// xx and aa are symmetric. They hold the entries 00, 10, 11, 20, 21 and 22.
struct beyond {
    double xx[6], xa[3][3], aa[6];
    double along_x[3], along_a[3];
};

struct variation_stage {
    // Row r of L^-1, where the matrix of b is L D L^T, and the diagonal of D^-1.
    double l10, l20, l21, over_d[3];
    // L^-1 times the derivatives of b's slope by x and by a.
    double by_x[3][3], by_a[3][3];
    double slope[3]; // L^-1 times b's slope.
    struct hair_rod_swing swing;
};

static double dot3(const double* a, const double* b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

// Compute L^-1 b of a column b.
static void solve_lower(const struct variation_stage* s, double b[3][3], int column)
{
    b[1][column] -= s->l10 * b[0][column];
    b[2][column] -= s->l20 * b[0][column] + s->l21 * b[1][column];
}

// Factor the matrix of b, which is given by its lower half. Return false if it is not positive.
static bool factor(const double b[6], struct variation_stage* out)
{
    if (!(b[0] > 0)) return false;
    double over0 = 1 / b[0];
    out->l10 = b[1] * over0;
    out->l20 = b[3] * over0;
    double d1 = b[2] - out->l10 * b[1], below = b[4] - out->l20 * b[1];
    if (!(d1 > 0)) return false;
    double over1 = 1 / d1;
    out->l21 = below * over1;
    double d2 = b[5] - out->l20 * b[3] - out->l21 * below;
    if (!(d2 > 0)) return false;
    out->over_d[0] = over0;
    out->over_d[1] = over1;
    out->over_d[2] = 1 / d2;
    return true;
}

// Advance from V_(i+1) to V_i. Return false if there is no minimum.
static inline bool eliminate_blocks(const struct hair_rod_hinge* h, const struct hair_rod_segment_terms* t,
                                    double shift, struct beyond* v, struct variation_stage* out)
{
    const double *sx = t->swing.x, *sz = t->swing.z;
    v->xx[0] += t->pull;
    v->xx[2] += t->pull;
    v->xx[5] += t->pull;
    const double rows[3][3] = {
        {v->xx[0], v->xx[1], v->xx[3]}, {v->xx[1], v->xx[2], v->xx[4]}, {v->xx[3], v->xx[4], v->xx[5]}};
    double b[6], x_b[3][3]; // Column c of x_b is row c of xa + xx D.
    for (int r = 0; r < 3; ++r) {
        x_b[0][r] = v->xa[r][0] + dot3(rows[r], sx);
        x_b[1][r] = v->xa[r][1];
        x_b[2][r] = v->xa[r][2] + dot3(rows[r], sz);
    }
    const double xa0[3] = {v->xa[0][0], v->xa[1][0], v->xa[2][0]},
                 xa2[3] = {v->xa[0][2], v->xa[1][2], v->xa[2][2]};
    b[0] = v->aa[0] + h->after[0] + dot3(sx, x_b[0]) + dot3(sx, xa0) + t->force.y + shift;
    b[1] = v->aa[1] + h->after[1] + dot3(sx, x_b[1]) - t->force.x / 2;
    b[2] = v->aa[2] + h->after[2] + shift;
    b[3] = v->aa[3] + h->after[3] + dot3(sz, x_b[0]) + dot3(sx, xa2);
    b[4] = v->aa[4] + h->after[4] + dot3(sz, x_b[1]) - t->force.z / 2;
    b[5] = v->aa[5] + h->after[5] + dot3(sz, x_b[2]) + dot3(sz, xa2) + t->force.y + shift;
    if (!factor(b, out)) return false;
    memcpy(out->by_x, x_b, sizeof x_b);
    memcpy(out->by_a, h->between, sizeof out->by_a);
    double wx[3][3], wa[3][3];
    for (int c = 0; c < 3; ++c) {
        solve_lower(out, out->by_x, c);
        solve_lower(out, out->by_a, c);
        for (int r = 0; r < 3; ++r) {
            wx[r][c] = out->by_x[r][c] * out->over_d[r];
            wa[r][c] = out->by_a[r][c] * out->over_d[r];
        }
    }
    for (int r = 0, n = 0; r < 3; ++r)
        for (int c = 0; c <= r; ++c, ++n) {
            v->xx[n] -= wx[0][r] * out->by_x[0][c] + wx[1][r] * out->by_x[1][c] + wx[2][r] * out->by_x[2][c];
            v->aa[n] = h->before[n] -
                       (wa[0][r] * out->by_a[0][c] + wa[1][r] * out->by_a[1][c] + wa[2][r] * out->by_a[2][c]);
        }
    for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c)
            v->xa[r][c] =
                -(wx[0][r] * out->by_a[0][c] + wx[1][r] * out->by_a[1][c] + wx[2][r] * out->by_a[2][c]);
    return true;
}

// Advance the linear terms of V, after eliminate_blocks(). `slope` is the derivative of the energy
// by the turn of the segment.
static void eliminate_slope(const hair_dvec3* slope, const struct hair_rod_swing* swing, struct beyond* v,
                            struct variation_stage* out)
{
    double* s = out->slope;
    s[0] = slope->x + v->along_a[0] + dot3(swing->x, v->along_x);
    s[1] = slope->y + v->along_a[1];
    s[2] = slope->z + v->along_a[2] + dot3(swing->z, v->along_x);
    s[1] -= out->l10 * s[0];
    s[2] -= out->l20 * s[0] + out->l21 * s[1];
    const double w[3] = {s[0] * out->over_d[0], s[1] * out->over_d[1], s[2] * out->over_d[2]};
    for (int r = 0; r < 3; ++r) {
        v->along_x[r] -= w[0] * out->by_x[0][r] + w[1] * out->by_x[1][r] + w[2] * out->by_x[2][r];
        v->along_a[r] = -(w[0] * out->by_a[0][r] + w[1] * out->by_a[1][r] + w[2] * out->by_a[2][r]);
    }
}

static struct hair_rod_segment_terms terms_of(const struct hair_rod_shape* s,
                                              const struct hair_rod_pose* pose, uint32_t i,
                                              double squared_frequency)
{
    return (struct hair_rod_segment_terms){hair_dscale(pose->force[i], s->length[i]),
                                           s->mass[i + 1] * (s->pull[i + 1] - squared_frequency),
                                           swing_of(pose->frame[i], s->length[i])};
}

static void write_hinge(const struct hair_rod_shape* s, const struct hair_rod_pose* pose, uint32_t i,
                        struct hair_rod_hinge* out)
{
    HAIR_ASSERT(i + 1 < s->count);
    double between[3][3];
    struct hair_rod_hinge unit;
    double self = write_stressed_hinge(pose->turn[i], pose->stress[i], pose->real_stress[i], between);
    write_unit_hinge(pose->turn[i], hair_rod_ratios_at(s, i), &unit);
    combine_hinge(&unit, hair_rod_stiffness(s, i), self, between, out);
}

bool hair_rod_is_stable(const struct hair_rod_shape* s, const struct hair_rod_pose* pose,
                        double squared_frequency)
{
    struct beyond v = {0};
    struct variation_stage stage;
    struct hair_rod_hinge hinge;
    for (uint32_t i = s->count - 1; i-- > 0;) {
        struct hair_rod_segment_terms terms = terms_of(s, pose, i, squared_frequency);
        write_hinge(s, pose, i, &hinge);
        if (!eliminate_blocks(&hinge, &terms, 0, &v, &stage)) return false;
    }
    return true;
}

void hair_rod_prepare_stability(const struct hair_rod_shape* s, const struct hair_rod_pose* pose,
                                double squared_frequency, struct hair_rod_stability* out)
{
    for (uint32_t i = 0; i + 1 < s->count; ++i) {
        struct hair_rod_stability_vertex* at = &out->vertex[i];
        at->self = write_stressed_hinge(pose->turn[i], pose->stress[i], pose->real_stress[i], at->between);
        if (i > 0) write_unit_hinge(pose->turn[i], hair_rod_ratios_at(s, i), &at->unit);
        at->terms = terms_of(s, pose, i, squared_frequency);
    }
}

bool hair_rod_test_stability(const struct hair_rod_shape* s, const struct hair_rod_pose* pose,
                             const struct hair_rod_stability* stability)
{
    struct beyond v = {0};
    struct variation_stage stage;
    struct hair_rod_hinge hinge;
    for (uint32_t i = s->count - 1; i-- > 0;) {
        const struct hair_rod_stability_vertex* at = &stability->vertex[i];
        if (i > 0)
            combine_hinge(&at->unit, hair_rod_stiffness(s, i), at->self, at->between, &hinge);
        else
            write_hinge(s, pose, 0, &hinge); // The stiffness changes the ratios at the clamp.
        if (!eliminate_blocks(&hinge, &at->terms, 0, &v, &stage)) return false;
    }
    return true;
}

bool hair_rod_find_step(const struct hair_rod_shape* s, const struct hair_rod_pose* pose, double shift,
                        const hair_dvec3* slope, hair_dvec3* out)
{
    struct variation_stage stage[HAIR_MAX_GUIDE_VERTICES];
    struct hair_rod_hinge hinge;
    struct beyond v = {0};
    double x[3] = {0}, a[3] = {0};
    for (uint32_t i = s->count - 1; i-- > 0;) {
        struct hair_rod_segment_terms terms = terms_of(s, pose, i, 0);
        write_hinge(s, pose, i, &hinge);
        if (!eliminate_blocks(&hinge, &terms, shift, &v, stage + i)) return false;
        stage[i].swing = terms.swing;
        eliminate_slope(slope + i, &terms.swing, &v, stage + i);
    }
    for (uint32_t i = 0; i + 1 < s->count; ++i) {
        const struct variation_stage* at = stage + i;
        double b[3];
        for (int r = 0; r < 3; ++r)
            b[r] = -(at->slope[r] + dot3(at->by_x[r], x) + dot3(at->by_a[r], a)) * at->over_d[r];
        b[1] -= at->l21 * b[2];
        b[0] -= at->l10 * b[1] + at->l20 * b[2];
        for (int r = 0; r < 3; ++r) x[r] += at->swing.x[r] * b[0] + at->swing.z[r] * b[2];
        memcpy(a, b, sizeof a);
        out[i] = (hair_dvec3){b[0], b[1], b[2]};
    }
    return true;
}
