// follow.c - what glsl/sim/follow.comp knows of each segment: how stiff it is, and all that it carries.
//
// The energy of segment i of direction t is, with Q the rotation of the segment before it from the rest pose,
//
//   E = K/2 |t - Q r|^2 - (Q a' + C') . t
//
// where K is the bending stiffness at its first vertex, r its rest direction, C' the weight of all beyond and a'
// the force that bears it as the rest strain does: its moment r x a' is the opposite of the stress in the groom.
// The segment rests at t = r if the stress is the moment of the weight. C = c r + p is the first moment of the
// masses beyond, p across r.
#include "lib/sim/rod_shape.h"

#define LARGEST 1e30 // number of a rod: what physics at their limits make may be beyond floats.

static float float_of(double v)
{
    return (float)fmax(-LARGEST, fmin(LARGEST, v));
}

static hair_vec4 vec4_of(hair_dvec3 v, double w)
{
    return (hair_vec4){float_of(v.x), float_of(v.y), float_of(v.z), float_of(w)};
}

// Find the first moment of the masses beyond vertex i about it. Return their moment of inertia.
static double find_moments(const struct hair_rod_shape* s, uint32_t i, hair_dvec3* first)
{
    double inertia = 0;
    *first = (hair_dvec3){0, 0, 0};
    for (uint32_t k = i + 1; k < s->count; ++k) {
        hair_dvec3 arm = hair_dadd(s->place[k], hair_dscale(s->place[i], -1));
        *first = hair_dadd(*first, hair_dscale(arm, s->mass[k]));
        inertia += s->mass[k] * hair_ddot(arm, arm);
    }
    // Masses beyond may lie about the vertex itself, but not the next vertex.
    return fmax(inertia, s->mass[i + 1] * s->length[i] * s->length[i]);
}

// Return the moment of the stress at vertex i, in the groom.
static hair_dvec3 moment_of_stress(const struct hair_rod_shape* s, uint32_t i)
{
    hair_dquat turn = s->turn[i];
    hair_dvec3 v = {turn.x, turn.y, turn.z};
    double real = hair_rod_stiffness(s, i) * s->ratio[2] * (2 * turn.w - s->rest_real[i]);
    hair_dvec3 part = hair_dadd(hair_dcross(v, s->stress[i]), hair_dscale(v, real));
    return hair_drotate(s->frame[i], hair_dadd(hair_dscale(s->stress[i], turn.w), hair_dscale(part, -1)));
}

static void write_segment(const struct hair_rod_shape* s, uint32_t i, struct hair_rod* out)
{
    hair_dvec3 moment, r = hair_drotate(s->frame[i], (hair_dvec3){0, 1, 0});
    double inertia = find_moments(s, i, &moment), stiffness = hair_rod_stiffness(s, i);
    double c = hair_ddot(moment, r), arm = hair_dlength(moment);
    hair_dvec3 across = hair_dadd(moment, hair_dscale(r, -c));
    hair_dvec3 aim = hair_dscale(r, stiffness);
    if (stiffness > 0) aim = hair_dadd(aim, hair_dcross(r, moment_of_stress(s, i)));
    // A swing of the segment before it, at its own frequency, becomes sqrt(1 + 1/16) times as large at most.
    double swing = sqrt((stiffness + arm * s->gravity) / inertia);
    out->strain = vec4_of(hair_dscale(aim, 1 / inertia), c / inertia);
    out->factor = vec4_of(hair_dscale(across, 1 / inertia), (double)out->factor.w);
    out->factor_euler = vec4_of(r, 4 * s->length[i] * arm / inertia * swing);
}

void hair_follow_write(const struct hair_rod_shape* s, struct hair_rod* out)
{
    for (uint32_t i = 0; i < s->count; ++i) {
        int fixed = (i == 0 && s->held) || s->tied[i];
        out[i] = (struct hair_rod){
            .segment = {(float)s->length[i], fixed ? 0 : (float)(1 / s->mass[i]), (float)s->pull[i], 0}};
        if (i + 1 < s->count) write_segment(s, i, out + i);
    }
}
