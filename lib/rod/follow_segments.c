// follow_segments.c - the parameters of each segment for glsl/sim/follow.comp: its stiffness, and
// the moments of all masses beyond.
//
// The energy of segment i in the direction t is
//
//   E = K/2 |t - Q r|^2 - (Q a' + C') . t
//
// K is the bending stiffness at the segment's first vertex, and r its rest direction. Q is the
// rotation of the segment before it from the rest pose. C' is the weight of all beyond. a' is the
// force that balances this weight as the rest strain does. Its moment r x a' is the opposite of the
// stress in the groom. The segment rests at t = r if the stress is the moment of the weight. C = c
// r + p is the first moment of the masses beyond, with p perpendicular to r. The strand beyond is
// not rigid but bends towards the vertical, so less of its moment reaches segment i. K is therefore
// divided by the fraction of the moment that reaches segment i.
#include "lib/rod/rod_shape.h"

// Fraction of the damping against growth that is applied. See find_damping().
#define DAMPED 0.8
// Part b of the damping in find_damping() of a segment without weight.
#define RELATIVE 2.0
#define LARGEST 1e30 // Maximum number of a rod. Extreme physics can exceed the range of floats.

static float clamp_to_float(double v)
{
    return (float)fmax(-LARGEST, fmin(LARGEST, v));
}

static hair_vec4 vec4_of(hair_dvec3 v, double w)
{
    return (hair_vec4){clamp_to_float(v.x), clamp_to_float(v.y), clamp_to_float(v.z), clamp_to_float(w)};
}

// Find the first moment about vertex i of the masses beyond. Return their moment of inertia.
static double find_moments(const struct hair_rod_shape* s, uint32_t i, hair_dvec3* first)
{
    HAIR_ASSERT(i + 1 < s->count);
    double inertia = 0;
    *first = (hair_dvec3){0, 0, 0};
    for (uint32_t k = i + 1; k < s->count; ++k) {
        hair_dvec3 arm = hair_dadd(s->place[k], hair_dscale(s->place[i], -1));
        *first = hair_dadd(*first, hair_dscale(arm, s->mass[k]));
        inertia += s->mass[k] * hair_ddot(arm, arm);
    }
    // Masses beyond may coincide with the vertex itself. The next vertex cannot.
    return fmax(inertia, s->mass[i + 1] * s->length[i] * s->length[i]);
}

// Find the moment that a hanging chain passes to each segment, over the moment that it would pass
// if it were rigid. Segments at small angles a_i from the vertical are in equilibrium when
//
//   K_i (a_i - a_(i-1)) + S_i a_i = 0,   S_i = T_i l_i + K_(i+1) S_(i+1) / (K_(i+1) + S_(i+1))
//
// with T_i the weight of all masses beyond segment i. If all K are infinite, S_i is the sum of T l
// from i on.
static void find_softness(const struct hair_rod_shape* s, double* softness)
{
    double weight = 0, bent = 0, rigid = 0;
    softness[s->count - 1] = 1;
    for (uint32_t i = s->count - 1; i-- > 0;) {
        double next = hair_rod_stiffness(s, i + 1);
        weight += s->mass[i + 1] * s->gravity;
        rigid += weight * s->length[i];
        bent = weight * s->length[i] + (bent > 0 ? bent * next / (next + bent) : 0);
        softness[i] = rigid > 0 ? bent / rigid : 1;
    }
}

// Return the moment of the stress at vertex i, in the groom.
static hair_dvec3 moment_of_stress(const struct hair_rod_shape* s, uint32_t i)
{
    hair_dquat turn = s->turn[i];
    hair_dvec3 v = {turn.x, turn.y, turn.z};
    double real = hair_rod_stiffness(s, i) * hair_rod_ratios_at(s, i).z * (2 * turn.w - s->rest_real[i]);
    hair_dvec3 part = hair_dadd(hair_dcross(v, s->stress[i]), hair_dscale(v, real));
    return hair_drotate(s->frame[i], hair_dadd(hair_dscale(s->stress[i], turn.w), hair_dscale(part, -1)));
}

// Return the damping rate of a segment, divided by its own frequency w. The damping keeps a chain
// of segments from amplifying a swing. The part b of the rate damps the turn against that of the
// segment before. If the segment before swings by 1 at the frequency x w, the segment swings by
//
//   H = (e + q x^2 + i b x) / (1 - x^2 + i d x)
//
// d is the result. e = K / (K + |C| g) is the part of the stiffness in the restoring moment. q = l
// |C| / I comes from the acceleration of the segment's first vertex. |H| is at most 1 for all x up
// to 1 if
//
//   d^2 >= b^2 + 2 - 2 sqrt(1 - (e + q)^2)
//
// DAMPED of all but b in this d is enough, because frequencies differ from segment to segment. The
// value was found by experiment. If e is 0, 4 q lets a swing at w grow by sqrt(1 + 1/16) at most.
static double find_damping(double elastic, double lever, double relative)
{
    HAIR_ASSERT(0 <= elastic && elastic <= 1 && lever >= 0);
    double passed = fmin(elastic + lever, 1), grown = DAMPED * DAMPED * (2 - 2 * sqrt(1 - passed * passed));
    return fmax(4 * lever, sqrt(relative * relative + grown));
}

static void write_segment(const struct hair_rod_shape* s, uint32_t i, double softness, struct hair_rod* out)
{
    hair_dvec3 moment, r = hair_drotate(s->frame[i], (hair_dvec3){0, 1, 0});
    double inertia = find_moments(s, i, &moment), stiffness = hair_rod_stiffness(s, i) / softness;
    HAIR_ASSERT(inertia > 0 && softness > 0);
    double c = hair_ddot(moment, r), arm = hair_dlength(moment);
    hair_dvec3 across = hair_dadd(moment, hair_dscale(r, -c));
    hair_dvec3 aim = hair_dscale(r, stiffness);
    if (stiffness > 0) aim = hair_dadd(aim, hair_dcross(r, moment_of_stress(s, i)));
    double weight = arm * s->gravity, swing = sqrt((stiffness + weight) / inertia);
    double elastic = stiffness > 0 ? stiffness / (stiffness + weight) : 0;
    double relative = i > 0 ? RELATIVE * elastic : 0;
    double damping = find_damping(elastic, s->length[i] * arm / inertia, relative);
    out->segment.w = clamp_to_float(relative * swing);
    out->strain = vec4_of(hair_dscale(aim, 1 / inertia), c / inertia);
    out->factor = vec4_of(hair_dscale(across, 1 / inertia), (double)out->factor.w);
    out->factor_euler = vec4_of(r, damping * swing);
}

void hair_follow_write(const struct hair_rod_shape* s, struct hair_rod* out)
{
    HAIR_ASSERT(2 <= s->count && s->count <= HAIR_MAX_GUIDE_VERTICES);
    double softness[HAIR_MAX_GUIDE_VERTICES];
    find_softness(s, softness);
    for (uint32_t i = 0; i < s->count; ++i) {
        int fixed = (i == 0 && s->held) || s->pinned[i];
        out[i] = (struct hair_rod){
            .segment = {(float)s->length[i], fixed ? 0 : (float)(1 / s->mass[i]), (float)s->pull[i], 0}};
        if (i + 1 < s->count) write_segment(s, i, softness[i], out + i);
    }
}
