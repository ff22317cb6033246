// hold.c - whether guides can hold their groom, and how much stiffer it takes.
//
// The groom's shape is in equilibrium by its rest strain. It is stable when the energy's second variation is positive:
// with a and b the small turns of the segments before and after a vertex, each as its own frame sees it, (w, v) the
// turn between the frames and G its stress, the second order of that vertex's energy is
//
//   k/2 du . R du - (G . v) (a^2 + b^2) / 4 - G . Im(a (w, v) b) / 2,   du = (w + [v]x) b - (w - [v]x) a
//
// and of gravity's for a segment of length l along y with F on all beyond it, turned by w, l (F.y w^2 - (w.F)(w.y)) / 2.
// Of all segments' turns that is a matrix of 3 x 3 blocks on three diagonals; it is positive when all its pivots are.
// Twist is among the turns: this is all that buckles of a rod, in and out of plane.
//
// Left out is the pull to the rest pose, which ties every segment to every other. With the default pull the median
// multiple of the built-in haircuts would be smaller by a seventh to a third.
#include "lib/sim/rod_shape.h"

#define MARGIN 1.05   // of gravity
#define FINENESS 1.01 // of the multiple

struct block {
    double m[3][3];
};

struct hinge {
    struct block before, between, after; // of turns a a, a b, b b
};

static struct hinge hinge_of(const struct hair_rod_shape* s, uint32_t i, double stiffness)
{
    const double*    ratio = s->ratio;
    const hair_dquat t     = s->turn[i];
    const hair_dvec3 load  = hair_dscale(s->stress[i], MARGIN);
    const double     v[3] = {t.x, t.y, t.z}, g[3] = {load.x, load.y, load.z}, w = t.w;
    const double     by_b[3][3] = {{w, -v[2], v[1]}, {v[2], w, -v[0]}, {-v[1], v[0], w}}; // by -a: transposed
    const double     turned[3][3] = {{0, -g[2], g[1]}, {g[2], 0, -g[0]}, {-g[1], g[0], 0}};
    const double     strained     = g[0] * v[0] + g[1] * v[1] + g[2] * v[2];
    struct hinge     h;
    for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c) {
            double aa = 0, ab = 0, bb = 0, same = r == c ? strained / 2 : 0;
            for (int n = 0; n < 3; ++n) {
                aa += by_b[r][n] * ratio[n] * by_b[c][n];
                ab += by_b[r][n] * ratio[n] * by_b[n][c];
                bb += by_b[n][r] * ratio[n] * by_b[n][c];
            }
            h.before.m[r][c]  = stiffness * aa - same;
            h.between.m[r][c] = -stiffness * ab + (w * turned[r][c] + v[r] * g[c] + g[r] * v[c]) / 2 - same;
            h.after.m[r][c]   = stiffness * bb - same;
        }
    return h;
}

// To the lower half, which is what factor() reads.
static void add_weight(const struct hair_rod_shape* s, uint32_t i, struct block* turn)
{
    hair_dvec3 f = hair_dscale(s->force[i], MARGIN * s->length[i]);
    turn->m[0][0] += f.y;
    turn->m[2][2] += f.y;
    turn->m[1][0] -= f.x / 2;
    turn->m[2][1] -= f.z / 2;
}

// a = L L^T, L in the lower half. 0 when a is not positive.
static int factor(struct block* a)
{
    for (int c = 0; c < 3; ++c) {
        double d = a->m[c][c];
        for (int n = 0; n < c; ++n) d -= a->m[c][n] * a->m[c][n];
        if (!(d > 0)) return 0;
        a->m[c][c] = sqrt(d);
        for (int r = c + 1; r < 3; ++r) {
            double sum = a->m[r][c];
            for (int n = 0; n < c; ++n) sum -= a->m[r][n] * a->m[c][n];
            a->m[r][c] = sum / a->m[c][c];
        }
    }
    return 1;
}

// after -= between^T before^-1 between, of the factored `before`.
static void eliminate(const struct block* before, struct block* between, struct block* after)
{
    for (int c = 0; c < 3; ++c)
        for (int r = 0; r < 3; ++r) {
            for (int n = 0; n < r; ++n) between->m[r][c] -= before->m[r][n] * between->m[n][c];
            between->m[r][c] /= before->m[r][r];
        }
    for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c)
            for (int n = 0; n < 3; ++n) after->m[r][c] -= between->m[n][r] * between->m[n][c];
}

static void add(struct block* a, const struct block* b)
{
    for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c) a->m[r][c] += b->m[r][c];
}

static int holds(const struct hair_rod_shape* s, double stiffen)
{
    double stiffness[HAIR_MAX_GUIDE_VERTICES];
    for (uint32_t i = 0; i + 1 < s->count; ++i) {
        stiffness[i] = hair_rod_stiffness(s, i, stiffen);
        if (!(hair_dlength(hair_rod_excess(s, i, stiffness[i])) <= HAIR_ROD_MOST_STRAIN)) return 0;
    }
    struct block turn = hinge_of(s, 0, stiffness[0]).after; // The scalp does not turn.
    for (uint32_t i = 0;; ++i) {
        add_weight(s, i, &turn);
        if (i + 2 == s->count) return factor(&turn);
        struct hinge next = hinge_of(s, i + 1, stiffness[i + 1]);
        add(&turn, &next.before);
        if (!factor(&turn)) return 0;
        eliminate(&turn, &next.between, &next.after);
        turn = next.after;
    }
}

double hair_rod_stiffen(const struct hair_rod_shape* s)
{
    hair_dvec3 f = s->force[0];
    if (!s->clamped || hair_ddot(f, f) == 0) return 1;
    // Where a vertex resists nothing, no multiple helps.
    for (uint32_t i = 0; i + 1 < s->count; ++i)
        if (!(hair_rod_stiffness(s, i, 1) > 0)) return 1;
    if (holds(s, 1)) return 1;
    double fails = 1, does = HAIR_ROD_MOST_STIFFEN;
    if (!holds(s, does)) return does;
    while (does > FINENESS * fails) {
        double middle = sqrt(fails * does);
        if (holds(s, middle))
            does = middle;
        else
            fails = middle;
    }
    return does;
}
