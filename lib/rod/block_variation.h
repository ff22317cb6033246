// block_variation.h - the energy of a block of rods to second order in the turns of their segments.
// It gives the test for stability, and the step of Newton's method.
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
//
// A bisection over the stiffness tests one pose many times. All that does not depend on the
// stiffness is then computed once: see hair_block_prepare_groom().
#ifndef HAIR_ROD_BLOCK_VARIATION_H
#define HAIR_ROD_BLOCK_VARIATION_H

#include "lib/rod/block.h"

// Compute the part of a hinge that the stiffness k causes. With D = w + [v]x, the derivative of du
// by b, the parts are
//
//   a a: D K D^T + K_z v v^T   b b: D^T K D + K_z v v^T   b a: -(D K D)^T - K_z v v^T
//
// where K = k R. As D D^T + v v^T = 1, and D D + v v^T is the matrix of the rotation (w, v), only
// the differences of K_x and K_y from K_z need products of D.
HAIR_LANES_INLINE void hair_block_stiff_hinge(struct hair_lanes4 t, hair_lanes k, struct hair_lanes3 ratios,
                                              bool is_round, struct hair_block_hinge* h)
{
    const hair_lanes v[3] = {t.x, t.y, t.z}, w = t.w, z = k * ratios.z;
    const hair_lanes more[2] = {k * ratios.y - z, k * ratios.x - z};
    const hair_lanes row[2][3] = {{v[2], w, -v[0]}, {w, -v[2], v[1]}}; // Rows y and x of D.
    const hair_lanes column[2][3] = {{-v[2], w, v[0]}, {w, v[2], -v[1]}};
    const hair_lanes vz[3] = {2 * z * v[0], 2 * z * v[1], 2 * z * v[2]}, wz = 2 * z * w;
    hair_lanes xy = vz[0] * v[1], xz = vz[0] * v[2], yz = vz[1] * v[2], own = z - wz * w;
    HAIR_LANES_UNROLL
    for (int n = 0; n < 6; ++n) h->before[n] = h->after[n] = (hair_lanes){0};
    h->before[0] = h->before[2] = h->before[5] = h->after[0] = h->after[2] = h->after[5] = z;
    h->between[0][0] = own - vz[0] * v[0];
    h->between[1][1] = own - vz[1] * v[1];
    h->between[2][2] = own - vz[2] * v[2];
    h->between[0][1] = -xy - wz * v[2];
    h->between[1][0] = -xy + wz * v[2];
    h->between[0][2] = -xz + wz * v[1];
    h->between[2][0] = -xz - wz * v[1];
    h->between[1][2] = -yz - wz * v[0];
    h->between[2][1] = -yz + wz * v[0];
    for (int m = 0; m < (is_round ? 1 : 2); ++m) HAIR_LANES_UNROLL
    for (int r = 0, n = 0; r < 3; ++r) HAIR_LANES_UNROLL
    for (int c = 0; c < 3; ++c) {
        h->between[r][c] -= more[m] * row[m][r] * column[m][c];
        if (c > r) continue;
        h->before[n] += more[m] * column[m][r] * column[m][c];
        h->after[n++] += more[m] * row[m][r] * row[m][c];
    }
}

// Compute the part of a hinge that the stress `g` and `e` causes. Return what it subtracts from the
// diagonals of the hinge by a a and by b b.
HAIR_LANES_INLINE hair_lanes hair_block_stressed_hinge(struct hair_lanes4 t, struct hair_lanes3 g,
                                                       hair_lanes e, hair_lanes between[3][3])
{
    hair_lanes strained = (g.x * t.x + g.y * t.y + g.z * t.z) / 2, real = e * t.w / 2;
    hair_lanes x = (t.w * g.x + e * t.x) / 2, y = (t.w * g.y + e * t.y) / 2, z = (t.w * g.z + e * t.z) / 2;
    hair_lanes xy = (t.x * g.y + t.y * g.x) / 2, xz = (t.x * g.z + t.z * g.x) / 2;
    hair_lanes yz = (t.y * g.z + t.z * g.y) / 2;
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
HAIR_LANES_INLINE void hair_block_combine_hinge(const struct hair_block_hinge* unit, hair_lanes stiffness,
                                                hair_lanes self, hair_lanes between[3][3],
                                                struct hair_block_hinge* out)
{
    HAIR_LANES_UNROLL
    for (int n = 0; n < 6; ++n) {
        out->before[n] = stiffness * unit->before[n];
        out->after[n] = stiffness * unit->after[n];
        if (n == 1 || n == 3 || n == 4) continue;
        out->before[n] -= self;
        out->after[n] -= self;
    }
    HAIR_LANES_UNROLL
    for (int r = 0; r < 3; ++r) HAIR_LANES_UNROLL
    for (int c = 0; c < 3; ++c) out->between[r][c] = stiffness * unit->between[r][c] + between[r][c];
}

HAIR_LANES_INLINE struct hair_block_swing hair_block_swing_of(struct hair_lanes4 q, hair_lanes length)
{
    hair_lanes l2 = 2 * length;
    return (struct hair_block_swing){
        {l2 * (q.x * q.z + q.w * q.y), l2 * (q.y * q.z - q.w * q.x), length - l2 * (q.x * q.x + q.y * q.y)},
        {l2 * (q.y * q.y + q.z * q.z) - length, -l2 * (q.x * q.y + q.w * q.z), l2 * (q.w * q.y - q.x * q.z)}};
}

// Quadratic energy of the part beyond a vertex, V_(i+1) before hair_block_eliminate() and V_i after
// it:
//
//   V(x, a) = x . xx x / 2 + x . xa a + a . aa a / 2 + along_x . x + along_a . a
//
// xx and aa are symmetric. They hold the entries 00, 10, 11, 20, 21 and 22.
struct hair_block_beyond {
    hair_lanes xx[6], xa[3][3], aa[6];
    hair_lanes along_x[3], along_a[3];
};

HAIR_LANES_INLINE hair_lanes hair_block_dot(const hair_lanes* a, const hair_lanes* b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

// Compute L^-1 b of a column b.
HAIR_LANES_INLINE void hair_block_solve_lower(const struct hair_block_stage* s, hair_lanes b[3][3],
                                              int column)
{
    b[1][column] -= s->l10 * b[0][column];
    b[2][column] -= s->l20 * b[0][column] + s->l21 * b[1][column];
}

// Factor the matrix of b, which is given by its lower half. Return where it is positive.
HAIR_LANES_INLINE hair_lane_mask hair_block_factor(const hair_lanes b[6], struct hair_block_stage* out)
{
    hair_lanes over0 = 1 / b[0];
    out->l10 = b[1] * over0;
    out->l20 = b[3] * over0;
    hair_lanes d1 = b[2] - out->l10 * b[1], below = b[4] - out->l20 * b[1];
    hair_lanes over1 = 1 / d1;
    out->l21 = below * over1;
    hair_lanes d2 = b[5] - out->l20 * b[3] - out->l21 * below;
    out->over_d[0] = over0;
    out->over_d[1] = over1;
    out->over_d[2] = 1 / d2;
    return (b[0] > 0) & (d1 > 0) & (d2 > 0);
}

// Compute the matrix of b, and the derivatives of b's slope by x, column by column.
HAIR_LANES_INLINE void hair_block_find_matrix(const struct hair_block_hinge* h,
                                              const struct hair_block_terms* t, hair_lanes shift,
                                              struct hair_block_beyond* v, hair_lanes x_b[3][3],
                                              hair_lanes b[6])
{
    const hair_lanes *sx = t->swing.x, *sz = t->swing.z;
    v->xx[0] += t->pull;
    v->xx[2] += t->pull;
    v->xx[5] += t->pull;
    const hair_lanes rows[3][3] = {
        {v->xx[0], v->xx[1], v->xx[3]}, {v->xx[1], v->xx[2], v->xx[4]}, {v->xx[3], v->xx[4], v->xx[5]}};
    HAIR_LANES_UNROLL
    for (int r = 0; r < 3; ++r) { // Column c of x_b is row c of xa + xx D.
        x_b[0][r] = v->xa[r][0] + hair_block_dot(rows[r], sx);
        x_b[1][r] = v->xa[r][1];
        x_b[2][r] = v->xa[r][2] + hair_block_dot(rows[r], sz);
    }
    const hair_lanes xa0[3] = {v->xa[0][0], v->xa[1][0], v->xa[2][0]},
                     xa2[3] = {v->xa[0][2], v->xa[1][2], v->xa[2][2]};
    b[0] = v->aa[0] + h->after[0] + hair_block_dot(sx, x_b[0]) + hair_block_dot(sx, xa0) + t->force.y + shift;
    b[1] = v->aa[1] + h->after[1] + hair_block_dot(sx, x_b[1]) - t->force.x / 2;
    b[2] = v->aa[2] + h->after[2] + shift;
    b[3] = v->aa[3] + h->after[3] + hair_block_dot(sz, x_b[0]) + hair_block_dot(sx, xa2);
    b[4] = v->aa[4] + h->after[4] + hair_block_dot(sz, x_b[1]) - t->force.z / 2;
    b[5] = v->aa[5] + h->after[5] + hair_block_dot(sz, x_b[2]) + hair_block_dot(sz, xa2) + t->force.y + shift;
}

// Advance from V_(i+1) to V_i. Return where there is a minimum.
HAIR_LANES_INLINE hair_lane_mask hair_block_eliminate(const struct hair_block_hinge* h,
                                                      const struct hair_block_terms* t, hair_lanes shift,
                                                      struct hair_block_beyond* v,
                                                      struct hair_block_stage* out)
{
    hair_lanes b[6], wx[3][3], wa[3][3];
    hair_block_find_matrix(h, t, shift, v, out->by_x, b);
    hair_lane_mask positive = hair_block_factor(b, out);
    HAIR_LANES_UNROLL
    for (int c = 0; c < 3; ++c) {
        HAIR_LANES_UNROLL
        for (int r = 0; r < 3; ++r) out->by_a[r][c] = h->between[r][c];
        hair_block_solve_lower(out, out->by_x, c);
        hair_block_solve_lower(out, out->by_a, c);
        HAIR_LANES_UNROLL
        for (int r = 0; r < 3; ++r) {
            wx[r][c] = out->by_x[r][c] * out->over_d[r];
            wa[r][c] = out->by_a[r][c] * out->over_d[r];
        }
    }
    HAIR_LANES_UNROLL
    for (int r = 0, n = 0; r < 3; ++r) HAIR_LANES_UNROLL
    for (int c = 0; c <= r; ++c, ++n) {
        v->xx[n] -= wx[0][r] * out->by_x[0][c] + wx[1][r] * out->by_x[1][c] + wx[2][r] * out->by_x[2][c];
        v->aa[n] = h->before[n] -
                   (wa[0][r] * out->by_a[0][c] + wa[1][r] * out->by_a[1][c] + wa[2][r] * out->by_a[2][c]);
    }
    HAIR_LANES_UNROLL
    for (int r = 0; r < 3; ++r) HAIR_LANES_UNROLL
    for (int c = 0; c < 3; ++c)
        v->xa[r][c] = -(wx[0][r] * out->by_a[0][c] + wx[1][r] * out->by_a[1][c] + wx[2][r] * out->by_a[2][c]);
    return positive;
}

// Advance the linear terms of V, after hair_block_eliminate(). `slope` is the derivative of the
// energy by the turn of the segment.
HAIR_LANES_INLINE void hair_block_eliminate_slope(struct hair_lanes3 slope, struct hair_block_beyond* v,
                                                  struct hair_block_stage* out)
{
    hair_lanes* s = out->slope;
    s[0] = slope.x + v->along_a[0] + hair_block_dot(out->swing.x, v->along_x);
    s[1] = slope.y + v->along_a[1];
    s[2] = slope.z + v->along_a[2] + hair_block_dot(out->swing.z, v->along_x);
    s[1] -= out->l10 * s[0];
    s[2] -= out->l20 * s[0] + out->l21 * s[1];
    const hair_lanes w[3] = {s[0] * out->over_d[0], s[1] * out->over_d[1], s[2] * out->over_d[2]};
    HAIR_LANES_UNROLL
    for (int r = 0; r < 3; ++r) {
        v->along_x[r] -= w[0] * out->by_x[0][r] + w[1] * out->by_x[1][r] + w[2] * out->by_x[2][r];
        v->along_a[r] = -(w[0] * out->by_a[0][r] + w[1] * out->by_a[1][r] + w[2] * out->by_a[2][r]);
    }
}

// Return the terms of the segment after a vertex. `force` is the force on all beyond the segment.
HAIR_LANES_INLINE struct hair_block_terms
hair_block_terms_of(const struct hair_block_vertex* v, struct hair_lanes3 force, double squared_frequency)
{
    return (struct hair_block_terms){hair_lanes_scale(force, v->length),
                                     v[1].mass * (v[1].pull - squared_frequency),
                                     hair_block_swing_of(v->pose.frame, v->length)};
}

HAIR_LANES_INLINE void hair_block_write_hinge(const struct hair_block* b, uint32_t i,
                                              struct hair_lanes3 stress, hair_lanes real_stress,
                                              struct hair_block_hinge* out)
{
    const struct hair_block_vertex* v = b->vertex + i;
    hair_lanes between[3][3];
    hair_lanes self = hair_block_stressed_hinge(v->pose.turn, stress, real_stress, between);
    hair_block_stiff_hinge(v->pose.turn, v->stiffness, hair_block_ratios(b, i), b->is_round, out);
    out->before[0] -= self, out->before[2] -= self, out->before[5] -= self;
    out->after[0] -= self, out->after[2] -= self, out->after[5] -= self;
    HAIR_LANES_UNROLL
    for (int r = 0; r < 3; ++r) HAIR_LANES_UNROLL
    for (int c = 0; c < 3; ++c) out->between[r][c] += between[r][c];
}

// Return where all small undamped motions about the pose are oscillations with more than the given
// squared angular frequency. The pose is stable where this holds for 0. The forces and the stress
// of the pose are set. Lanes outside of `active` are not tested.
HAIR_LANES_INLINE hair_lane_mask hair_block_is_stable(const struct hair_block* b, double squared_frequency,
                                                      hair_lane_mask active)
{
    struct hair_block_beyond v = {0};
    struct hair_block_stage stage;
    struct hair_block_hinge hinge;
    for (uint32_t i = b->count - 1; i-- > 0 && hair_lanes_any(active);) {
        const struct hair_block_vertex* at = b->vertex + i;
        struct hair_block_terms terms = hair_block_terms_of(at, at->pose.force, squared_frequency);
        hair_block_write_hinge(b, i, at->pose.stress, at->pose.real_stress, &hinge);
        active &= hair_block_eliminate(&hinge, &terms, (hair_lanes){0}, &v, &stage);
    }
    return active;
}

// Prepare tests of vertex i for small motions of at least the given squared angular frequency. The
// force and the stress balance.
HAIR_LANES_INLINE void hair_block_prepare_stability(struct hair_block* b, uint32_t i,
                                                    struct hair_lanes3 force, struct hair_lanes3 stress,
                                                    double squared_frequency)
{
    struct hair_block_vertex* v = b->vertex + i;
    v->groom.self = hair_block_stressed_hinge(v->pose.turn, stress, (hair_lanes){0}, v->groom.between);
    if (i > 0)
        hair_block_stiff_hinge(v->pose.turn, hair_lanes_of(1), hair_block_ratios(b, i), b->is_round,
                               &v->groom.unit);
    v->groom.terms = hair_block_terms_of(v, force, squared_frequency);
}

// Return the result of hair_block_is_stable() with the present stiffness.
HAIR_LANES_INLINE hair_lane_mask hair_block_test_stability(struct hair_block* b, hair_lane_mask active)
{
    struct hair_block_beyond v = {0};
    struct hair_block_stage stage;
    struct hair_block_hinge hinge, root;
    // The stiffness changes the ratios at the clamp.
    hair_block_stiff_hinge(b->vertex[0].pose.turn, hair_lanes_of(1), b->clamp_ratio, b->is_round, &root);
    for (uint32_t i = b->count - 1; i-- > 0 && hair_lanes_any(active);) {
        struct hair_block_vertex* at = b->vertex + i;
        hair_block_combine_hinge(i > 0 ? &at->groom.unit : &root, at->stiffness, at->groom.self,
                                 at->groom.between, &hinge);
        active &= hair_block_eliminate(&hinge, &at->groom.terms, (hair_lanes){0}, &v, &stage);
    }
    return active;
}

// Eliminate the turn of segment i from the search for a step, whose slope is known. Return where
// there is a minimum.
HAIR_LANES_INLINE hair_lane_mask hair_block_eliminate_turn(struct hair_block* b, uint32_t i, hair_lanes shift,
                                                           struct hair_block_beyond* v)
{
    struct hair_block_hinge hinge;
    struct hair_block_vertex* at = b->vertex + i;
    struct hair_block_stage* stage = &at->search.stage;
    struct hair_block_terms terms = hair_block_terms_of(at, at->pose.force, 0);
    hair_block_write_hinge(b, i, at->pose.stress, at->pose.real_stress, &hinge);
    hair_lane_mask positive = hair_block_eliminate(&hinge, &terms, shift, v, stage);
    stage->swing = terms.swing;
    hair_block_eliminate_slope(at->search.slope, v, stage);
    return positive;
}

// Find the turns of the segments, in their own frames, that minimise the energy to second order
// about the pose, after the elimination of all. Lanes outside of `active` do not turn. Return the
// maximum turn squared.
HAIR_LANES_INLINE hair_lanes hair_block_find_turns_of_step(struct hair_block* b, hair_lane_mask active)
{
    hair_lanes x[3] = {0}, a[3] = {0}, max = {0};
    for (uint32_t i = 0; i + 1 < b->count; ++i) {
        const struct hair_block_stage* at = &b->vertex[i].search.stage;
        hair_lanes t[3];
        HAIR_LANES_UNROLL
        for (int r = 0; r < 3; ++r)
            t[r] = -(at->slope[r] + hair_block_dot(at->by_x[r], x) + hair_block_dot(at->by_a[r], a)) *
                   at->over_d[r];
        t[1] -= at->l21 * t[2];
        t[0] -= at->l10 * t[1] + at->l20 * t[2];
        HAIR_LANES_UNROLL
        for (int r = 0; r < 3; ++r) {
            x[r] += at->swing.x[r] * t[0] + at->swing.z[r] * t[2];
            a[r] = t[r];
            t[r] = hair_lanes_select(active, t[r], (hair_lanes){0});
        }
        b->vertex[i].search.turns = (struct hair_lanes3){t[0], t[1], t[2]};
        max = hair_lanes_max(max, hair_block_dot(t, t));
    }
    return max;
}

#endif
