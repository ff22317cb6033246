// rod.c - rods for the shaders: rest strain, masses, and the factors of the implicit systems.
//
// The implicit systems take vertex i to bend like a round, straight strand that is at least as
// stiff. With the stiffness k, the positions x and the segment lengths l, the energy of vertex i is
// k/2 |row x|^2. The entries of the row for the vertices i-1, i and i+1 are
//
//   row = (1/l_(i-1), -1/l_(i-1) - 1/l_i, 1/l_i)
//
// At the root the row is (-1/l_0, 1/l_0). The matrix K is the sum of k row^T row over all vertices.
// The systems have five diagonals, are symmetric and positive, and are
//
//   diag(m_i A_i) + b^2 K,   A_i = 1 + c b + w_i^2 b^2
//
// where m is the mass, c the damping and w the angular frequency of the pull. In a substep of
// length h, b is 2/3 h for BDF2, and h for implicit Euler.
#include "lib/rod/rod_shape.h"

#include <string.h>

// Minimum substeps per frame of the accurate solver, for an error of a whip of half a millimetre.
#define MIN_PER_FRAME 18
#define MIN_PER_FRAME_MIXED 24 // Substeps per frame with which BDF2 has that accuracy.
#define MAX_PER_FRAME 100 // Maximum substeps per frame that one guide can impose on all.
#define EXPLICIT_MARGIN 1.15 // Stability margin of explicit bending.
#define EXPLICIT_MARGIN_BENT 1.5 // Stability margin of strands that are not straight at rest.
#define STRAIGHT 1e-4 // Maximum sine of half the angle at a vertex of a straight strand.
// Maximum length of a part of a substep of a guide that whips, in substeps at which explicit
// bending is just stable.
#define MAX_WHIP_PART 0.5
// Minimum length of a part with which a whip may begin. A guide that needs shorter parts would take
// too long.
#define MIN_WHIP_PART (1.0 / 32)
// Maximum substeps per frame of direct, for a heavy tip. Beyond that, tip inertia is added: see
// tip_inertia.c.
#define MAX_PER_FRAME_DIRECT 16
#define MAX_STIFF 1e6 // Maximum of h^2 K_ii / m_i.
#define MIXED_STIFFER 2e4 // Multiple of that maximum that the mixed scheme can solve.
#define MIXED_STIFFER_FREE 1e5 // Multiple of MAX_STIFF_FREE that the mixed scheme can solve.
// Maximum of h^2 K_ii / m_i for a free strand. Only its mass determines its motion as a whole.
#define MAX_STIFF_FREE 1e4

// Row of a symmetric matrix: the diagonal, and the entries one and two to its right.
struct band {
    double x, y, z;
};

static bool is_fixed(const struct hair_rod_shape* s, uint32_t i)
{
    return (i == 0 && s->held) || s->pinned[i];
}

static double implicit_ratio(const struct hair_rod_shape* s)
{
    return fmax(s->ratio[0], s->ratio[2]);
}

// Return the row of vertex i, for the vertices before, at and after it.
static hair_dvec3 row_of_vertex(const struct hair_rod_shape* s, uint32_t i)
{
    HAIR_ASSERT(i + 1 < s->count && s->length[i] > 0);
    double before = i > 0 ? 1 / s->length[i - 1] : 0, after = 1 / s->length[i];
    return (hair_dvec3){before, -before - after, after};
}

double hair_rod_max_stiffness(const struct hair_rod_shape* s, uint32_t i, double h)
{
    HAIR_ASSERT(h > 0);
    hair_dvec3 row = row_of_vertex(s, i);
    double after = row.z * row.z / s->mass[i + 1], max = after;
    double own = row.y * row.y / s->mass[i];
    if (i > 0 && own > max) max = own;
    double before = i > 1 || (i == 1 && !s->held) ? row.x * row.x / s->mass[i - 1] : 0;
    if (before > max) max = before;
    return (s->held ? MAX_STIFF : MAX_STIFF_FREE) / (h * h * max * implicit_ratio(s));
}

static void add_row(struct band* k, uint32_t i, hair_dvec3 row, double stiffness)
{
    if (i > 0) {
        k[i - 1].x += stiffness * row.x * row.x;
        k[i - 1].y += stiffness * row.x * row.y;
        k[i - 1].z += stiffness * row.x * row.z;
    }
    k[i].x += stiffness * row.y * row.y;
    k[i].y += stiffness * row.y * row.z;
    k[i + 1].x += stiffness * row.z * row.z;
}

static void find_bands(const struct hair_rod_shape* s, const double* stiffness, struct band* k)
{
    double ratio = implicit_ratio(s);
    for (uint32_t i = 0; i < s->count; ++i) k[i] = (struct band){0, 0, 0};
    for (uint32_t i = 0; i + 1 < s->count; ++i) add_row(k, i, row_of_vertex(s, i), ratio * stiffness[i]);
    // No force moves a held vertex. Its motion is known.
    for (uint32_t i = 0; i < s->count; ++i) {
        if (!is_fixed(s, i)) continue;
        k[i] = (struct band){0, 0, 0};
        if (i > 0) k[i - 1].y = 0;
        if (i > 1) k[i - 2].z = 0;
    }
}

// Return an upper bound on the squared frequency of bending. The bound is the maximum row sum of
// absolute values of m^(-1/2) K m^(-1/2).
static double max_frequency_squared(const struct hair_rod_shape* s, const struct band* k)
{
    double max = 0;
    for (uint32_t i = 0; i < s->count; ++i) {
        double sum = k[i].x / sqrt(s->mass[i]);
        if (i > 0) sum += fabs(k[i - 1].y) / sqrt(s->mass[i - 1]);
        if (i > 1) sum += fabs(k[i - 2].z) / sqrt(s->mass[i - 2]);
        if (i + 1 < s->count) sum += fabs(k[i].y) / sqrt(s->mass[i + 1]);
        if (i + 2 < s->count) sum += fabs(k[i].z) / sqrt(s->mass[i + 2]);
        sum /= sqrt(s->mass[i]);
        if (sum > max) max = sum;
    }
    return max;
}

// Return whether the shape at rest is straight. The groom must be straight, and free of stress.
static bool is_straight(const struct hair_rod_shape* s)
{
    for (uint32_t i = 0; i + 1 < s->count; ++i) {
        hair_dvec3 turn = {s->turn[i].x, s->turn[i].y, s->turn[i].z};
        if (hair_dlength(turn) > STRAIGHT || hair_dlength(s->stress[i]) > 0) return false;
    }
    return true;
}

// Return the longest substep for which explicit bending is stable. Leapfrog is stable below 2 / w,
// where w is the highest frequency. The margin covers what K leaves out. For straight strands this
// is tension. For other strands it is also curvature and twist. With a margin of 1.15 such strands
// fall back four times as often as with 1.5, and do not always come to rest.
static double longest_explicit(const struct hair_rod_shape* s, const struct band* k)
{
    double max = max_frequency_squared(s, k);
    return max > 0 ? 2 / ((is_straight(s) ? EXPLICIT_MARGIN : EXPLICIT_MARGIN_BENT) * sqrt(max)) : INFINITY;
}

// Return the longest part of a substep for a guide that whips, a power of two. `phase` is the
// substep over that at which explicit bending is stable. Return 0 if no part is short enough.
static double whip_part(double phase)
{
    double part = 1;
    while (part * phase > MAX_WHIP_PART && part > MIN_WHIP_PART) part /= 2;
    return part * phase <= MAX_WHIP_PART ? part : 0;
}

// The two rows of L D L^T above the next row. `one` is the last row, and `two` the row before that.
// x is D, y is L(i+1,i), and z is L(i+2,i).
struct rows {
    struct band one, two;
};

static hair_vec4 eliminate(struct rows* above, double diagonal, struct band beside, double b2)
{
    struct band one = above->one, two = above->two, row = {diagonal, b2 * beside.y, b2 * beside.z};
    row.x += b2 * beside.x - one.x * one.y * one.y - two.x * two.z * two.z;
    HAIR_ASSERT(row.x > 0);
    row.y = (row.y - one.x * one.y * one.z) / row.x;
    row.z = row.z / row.x;
    *above = (struct rows){row, one};
    return (hair_vec4){(float)(1 / row.x), (float)row.y, (float)row.z, 0};
}

static hair_vec4 rest_strain(const struct hair_rod_shape* s, uint32_t i, double stiffness)
{
    if (i + 1 == s->count) return (hair_vec4){0, 0, 0, 0};
    hair_dvec3 strain = hair_dscale((hair_dvec3){s->turn[i].x, s->turn[i].y, s->turn[i].z}, 2);
    if ((float)stiffness > 0) {
        hair_dvec3 excess = hair_rod_excess(s, i, stiffness);
        double squared = hair_ddot(excess, excess), max = HAIR_ROD_MAX_STRAIN;
        double kept = squared > max * max ? max / sqrt(squared) : 1;
        strain = hair_dadd(strain, hair_dscale(excess, -kept));
    }
    return (hair_vec4){(float)strain.x, (float)strain.y, (float)strain.z, (float)stiffness};
}

// Write a guide of the mixed scheme. Ratios of stiffness take the place of factors. Return the
// smallest stiffness factor of a vertex.
static double write_mixed(const struct hair_rod_shape* s, double h, struct hair_rod* out)
{
    double softest = 1, stiffer = s->held ? MIXED_STIFFER : MIXED_STIFFER_FREE;
    for (uint32_t i = 0; i < s->count; ++i) {
        double full = hair_rod_stiffness(s, i), k = full, over_mass = is_fixed(s, i) ? 0 : 1 / s->mass[i];
        if (i + 1 < s->count) k = fmin(k, stiffer * hair_rod_max_stiffness(s, i, h));
        if (k < full) softest = fmin(softest, k / full);
        hair_dvec3 ratio = hair_rod_ratios_at(s, i);
        out[i] = (struct hair_rod){
            .strain = rest_strain(s, i, k),
            .factor_euler = {(float)ratio.x, (float)ratio.y, (float)ratio.z, 0},
            .segment = {(float)s->length[i], (float)over_mass, (float)s->pull[i], (float)s->rest_real[i]}};
    }
    return softest;
}

static void write_pins(const struct hair_rod_shape* s, struct hair_rod* out)
{
    for (uint32_t i = s->count - 1, next = s->pinned[i]; i-- > 0; next = s->pinned[i] ? s->pinned[i] : next)
        out[i].factor.w = (float)next;
}

// Write a guide of the scheme of straight rods. Return the smallest stiffness factor of a vertex.
static double write_guide(const struct hair_rod_shape* s, double tautness, const hair_physics* physics,
                          hair_solver solver, double h, struct hair_rod* out)
{
    struct band k[HAIR_MAX_GUIDE_VERTICES];
    double stiffness[HAIR_MAX_GUIDE_VERTICES] = {0}, softest = 1;
    for (uint32_t i = 0; i + 1 < s->count; ++i) {
        double full = hair_rod_stiffness(s, i);
        stiffness[i] = fmin(full, hair_rod_max_stiffness(s, i, h));
        if (stiffness[i] < full) softest = fmin(softest, stiffness[i] / full);
    }
    find_bands(s, stiffness, k);
    int accurate = solver == HAIR_SOLVER_ACCURATE, implicit = solver == HAIR_SOLVER_DIRECT;
    double phase = h / longest_explicit(s, k);
    if (accurate) implicit = phase * (1 - 1e-9) > 1; // h may be rounded.
    int taut = accurate && tautness * h > 2 / EXPLICIT_MARGIN;
    double damping = (double)physics->damping, b = 2 * h / 3;

    struct rows own = {0}, euler = {0};
    for (uint32_t i = 0; i < s->count; ++i) {
        int fixed = is_fixed(s, i);
        double pull = s->pull[i] * hair_rod_weight_fraction(s, i);
        double of_b = fixed ? 1 : s->mass[i] * (1 + damping * b + pull * b * b);
        double of_h = fixed ? 1 : s->mass[i] * (1 + damping * h + pull * h * h);
        out[i] = (struct hair_rod){.strain = rest_strain(s, i, stiffness[i]),
                                   .segment = {(float)s->length[i], fixed ? 0 : (float)(1 / s->mass[i]),
                                               (float)pull, taut ? 2 : (float)implicit}};
        if (accurate && i == 1) out[i].segment.w = (float)whip_part(phase);
        if (implicit) out[i].factor = eliminate(&own, of_b, k[i], b * b);
        out[i].factor_euler = eliminate(&euler, of_h, k[i], h * h);
    }
    return softest;
}

void hair_rod_shape_with(const struct hair_guide* guide, const struct hair_rest* rest,
                         const struct hair_rod_borne* borne, const hair_physics* physics,
                         struct hair_rod_shape* out)
{
    hair_rod_shape_of(guide, rest + guide->first, physics, out);
    hair_rod_bear(out, borne + guide->first);
}

// Write a guide for the scheme that solves it. Change the shape. Return the smallest stiffness
// factor of a vertex.
static double write_shape(struct hair_rod_shape* s, const hair_physics* physics, hair_solver solver,
                          int mixed, double substep, struct hair_rod* out)
{
    double softest = 1;
    if (mixed) {
        softest = write_mixed(s, substep, out);
    } else if (solver == HAIR_SOLVER_FOLLOW) {
        hair_follow_write(s, out);
    } else {
        double tautness = hair_rod_tautness(s);
        hair_rod_add_inertia(s, solver == HAIR_SOLVER_DIRECT ? 2 * substep / 3 : substep);
        softest = write_guide(s, tautness, physics, solver, substep, out);
    }
    write_pins(s, out);
    out[s->count - 1].factor_euler.w = physics->damping;
    return softest;
}

double hair_rods_write(const struct hair_guide* guide, const struct hair_rest* rest,
                       const struct hair_rod_borne* borne, const hair_physics* physics, hair_solver solver,
                       int mixed, double substep, struct hair_rod* out)
{
    struct hair_rod_shape shape;
    HAIR_ASSERT(substep > 0);
    hair_rod_shape_with(guide, rest, borne, physics, &shape);
    double softest = write_shape(&shape, physics, solver, mixed, substep, out);
    HAIR_ASSERT(0 <= softest && softest <= 1);
    return softest;
}

void hair_rods_pin(const struct hair_guide* guide, const struct hair_rest* rest,
                   const struct hair_rod_borne* borne, const struct hair_resolved_pin* resolved_pin,
                   uint32_t first, uint32_t end, const hair_physics* physics, hair_solver solver, int mixed,
                   double substep, struct hair_rod* out)
{
    struct hair_rod_shape shape;
    hair_rod_shape_with(guide, rest, borne, physics, &shape);
    for (uint32_t i = first; i < end; ++i) {
        HAIR_ASSERT(resolved_pin[i].vertex < shape.count);
        shape.pinned[resolved_pin[i].vertex] = i + 1;
    }
    write_shape(&shape, physics, solver, mixed, substep, out);
}

// Return the number of substeps per frame that one guide needs for explicit bending.
static double min_explicit(const struct hair_rod_shape* s)
{
    struct band k[HAIR_MAX_GUIDE_VERTICES];
    double stiffness[HAIR_MAX_GUIDE_VERTICES] = {0};
    for (uint32_t i = 0; i + 1 < s->count; ++i) stiffness[i] = hair_rod_stiffness(s, i);
    find_bands(s, stiffness, k);
    return ceil(HAIR_ROD_FRAME / longest_explicit(s, k));
}

double hair_rod_substeps_of_straight(uint32_t vertices)
{
    const uint32_t each = HAIR_ROD_MAX_PLAIN / HAIR_ROD_PER_FRAME_DIRECT;
    uint32_t count = (vertices + each - 1) / each;
    return count > HAIR_ROD_PER_FRAME_DIRECT ? count : HAIR_ROD_PER_FRAME_DIRECT;
}

double hair_rods_substep(const struct hair_guide* guides, const struct hair_rest* rest,
                         const struct hair_rod_borne* borne, uint32_t count, const hair_physics* physics,
                         hair_solver solver, int mixed)
{
    int direct = solver == HAIR_SOLVER_DIRECT;
    if (mixed) return HAIR_ROD_FRAME / (direct ? HAIR_ROD_PER_FRAME_DIRECT : MIN_PER_FRAME_MIXED);
    if (!direct && solver != HAIR_SOLVER_ACCURATE) return HAIR_ROD_FRAME / 2;
    double max = direct ? HAIR_ROD_PER_FRAME_DIRECT : MIN_PER_FRAME;
    for (uint32_t i = 0; direct && i < count; ++i)
        max = fmax(max, hair_rod_substeps_of_straight(guides[i].count));
    for (uint32_t i = 0; i < count && (!direct || physics->tip_mass > 0); ++i) {
        struct hair_rod_shape shape;
        hair_rod_shape_with(guides + i, rest, borne, physics, &shape);
        double own = direct ? fmin(ceil(2 * HAIR_ROD_FRAME / (3 * hair_rod_longest_taut(&shape))),
                                   MAX_PER_FRAME_DIRECT)
                            : min_explicit(&shape);
        if (own <= MAX_PER_FRAME) max = fmax(max, own);
    }
    HAIR_ASSERT(max >= HAIR_ROD_PER_FRAME_DIRECT);
    return HAIR_ROD_FRAME / max;
}
