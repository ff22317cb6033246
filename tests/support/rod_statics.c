// rod_statics.c - forces and stress of a rod in a pose, and its poses of rest, as
// lib/rod/block_statics.h describes.
#include "tests/support/rod_statics.h"

#include <string.h>

// Minimum cosine of half the angle between segments. At 0 there is no stress for some moments.
#define MIN_COSINE 1e-6
#define LONGEST_TURN 0.5 // Maximum turn of a segment in one step, radians.
#define HALVINGS 30 // Maximum halvings of a step.
#define ROUNDING 1e-14 // Rounding error of the energy, as a fraction.
#define AT_REST 1e-10 // Torque that ends the search, as a fraction of the maximum possible.
// Torque that is tried in an unstable pose without torque, as a fraction of the maximum possible.
#define KICK 1e-3
#define FIRST_SHIFT 1e-3 // First added multiple of the unit matrix, over the maximum stiffness.
#define SHIFT_GROWTH 4.0 // Growth factor of the added multiple.
#define LAST_SHIFT 1e6 // Upper limit of the added multiple, over the maximum stiffness.

static hair_dvec3 axis_of(hair_dquat q)
{
    return (hair_dvec3){q.x, q.y, q.z};
}

void hair_rod_pose_at(const struct hair_rod_shape* s, const hair_dquat* frames, struct hair_rod_pose* out)
{
    HAIR_ASSERT(s->count >= 2 && out->frame != frames);
    // Frame of the segment before, which is that of the scalp at first.
    hair_dquat before = hair_dmultiply(s->frame[0], hair_dconjugate(s->turn[0]));
    out->place[0] = (hair_dvec3){0, 0, 0};
    for (uint32_t i = 0; i + 1 < s->count; ++i) {
        hair_dquat q = frames[i], r = hair_dmultiply(hair_dconjugate(before), q);
        hair_dvec3 along = hair_drotate(q, (hair_dvec3){0, s->length[i], 0});
        out->turn[i] = r.w < 0 ? (hair_dquat){-r.x, -r.y, -r.z, -r.w} : r;
        out->frame[i] = q;
        out->place[i + 1] = hair_dadd(out->place[i], along);
        before = q;
    }
}

void hair_rod_load(const struct hair_rod_shape* s, double gravity, struct hair_rod_pose* pose)
{
    hair_dvec3 load = {0, 0, 0};
    HAIR_ASSERT(gravity >= 0);
    for (uint32_t i = s->count - 1; i-- > 0;) {
        hair_dvec3 back = hair_dadd(s->place[i + 1], hair_dscale(pose->place[i + 1], -1));
        hair_dvec3 own = hair_dadd(hair_dscale(s->load, gravity), hair_dscale(back, s->pull[i + 1]));
        load = hair_dadd(load, hair_dscale(own, s->mass[i + 1]));
        pose->force[i] = hair_drotate(hair_dconjugate(pose->frame[i]), load);
    }
}

static hair_dvec3 stress_for(hair_dquat turn, hair_dvec3 moment)
{
    hair_dvec3 v = axis_of(turn), across = hair_dcross(v, moment);
    double w = fmax(turn.w, MIN_COSINE), twist = hair_ddot(v, moment) / w;
    return hair_dadd(hair_dadd(hair_dscale(moment, w), hair_dscale(v, twist)), hair_dscale(across, -1));
}

// The moments are in the frame of the segment they act on:
//
//   q_i* M_i = q_i* M_(i+1) + l_i y x F_i
void hair_rod_balance(const struct hair_rod_shape* s, struct hair_rod_pose* pose)
{
    hair_dvec3 moment = {0, 0, 0};
    for (uint32_t i = s->count - 1; i-- > 0;) {
        hair_dvec3 lever = {s->length[i] * pose->force[i].z, 0, -s->length[i] * pose->force[i].x};
        moment = hair_drotate(pose->turn[i], hair_dadd(moment, lever)); // In frame i-1.
        pose->stress[i] = stress_for(pose->turn[i], moment);
        pose->real_stress[i] = 0;
    }
}

// Return the difference of a turn from the rest shape.
static hair_dquat excess_of(hair_rod_rest rest, hair_dquat turn)
{
    return (hair_dquat){2 * turn.x - rest.x, 2 * turn.y - rest.y, 2 * turn.z - rest.z, 2 * turn.w - rest.w};
}

void hair_rod_strain(const struct hair_rod_shape* s, const hair_rod_rest* rest, struct hair_rod_pose* pose)
{
    for (uint32_t i = 0; i + 1 < s->count; ++i) {
        hair_dquat u = excess_of(rest[i], pose->turn[i]);
        double k = hair_rod_stiffness(s, i);
        hair_dvec3 r = hair_rod_ratios_at(s, i);
        pose->stress[i] = (hair_dvec3){k * r.x * u.x, k * r.y * u.y, k * r.z * u.z};
        pose->real_stress[i] = k * r.z * u.w;
    }
}

static double energy_of(const struct hair_rod_shape* s, const hair_rod_rest* rest, double gravity,
                        const struct hair_rod_pose* pose)
{
    double energy = 0;
    for (uint32_t i = 0; i + 1 < s->count; ++i) {
        hair_dquat u = excess_of(rest[i], pose->turn[i]);
        hair_dvec3 r = hair_rod_ratios_at(s, i);
        hair_dvec3 back = hair_dadd(s->place[i + 1], hair_dscale(pose->place[i + 1], -1));
        double bent = r.x * u.x * u.x + r.y * u.y * u.y + r.z * (u.z * u.z + u.w * u.w);
        energy += hair_rod_stiffness(s, i) / 2 * bent;
        energy -= s->mass[i + 1] * gravity * hair_ddot(s->load, pose->place[i + 1]);
        energy += s->mass[i + 1] * s->pull[i + 1] / 2 * hair_ddot(back, back);
    }
    return energy;
}

// Return the derivative of vertex i's energy by the turn of the segment after it. With a `side` of
// -1, return that by the turn of the segment before. Each is in the frame of its segment.
static hair_dvec3 slope_at(const struct hair_rod_pose* pose, uint32_t i, int side)
{
    hair_dvec3 g = pose->stress[i], v = axis_of(pose->turn[i]);
    hair_dvec3 own = hair_dadd(hair_dscale(g, pose->turn[i].w), hair_dscale(v, -pose->real_stress[i]));
    return hair_dadd(hair_dscale(own, side), hair_dcross(g, v));
}

// Set `out` to the derivative of the energy by the turns. Return the maximum torque.
static double find_slope(const struct hair_rod_shape* s, const struct hair_rod_pose* pose, hair_dvec3* out)
{
    double max = 0;
    for (uint32_t i = 0; i + 1 < s->count; ++i) {
        hair_dvec3 f = hair_dscale(pose->force[i], s->length[i]), slope = {-f.z, 0, f.x};
        slope = hair_dadd(slope, slope_at(pose, i, 1));
        if (i + 2 < s->count) slope = hair_dadd(slope, slope_at(pose, i + 1, -1));
        out[i] = slope;
        max = fmax(max, hair_dlength(slope));
    }
    return max;
}

static hair_dquat exponential(hair_dvec3 turn)
{
    double angle = hair_dlength(turn), s = angle > 1e-12 ? sin(angle / 2) / angle : 0.5;
    return (hair_dquat){s * turn.x, s * turn.y, s * turn.z, cos(angle / 2)};
}

// Turn the segments from their frames `from` by a fraction of the turns.
static void turn_by(const struct hair_rod_shape* s, const hair_dquat* from, const hair_dvec3* turns,
                    double fraction, struct hair_rod_pose* pose)
{
    hair_dquat to[HAIR_MAX_GUIDE_VERTICES];
    for (uint32_t i = 0; i + 1 < s->count; ++i)
        to[i] = hair_dmultiply(from[i], exponential(hair_dscale(turns[i], fraction)));
    hair_rod_pose_at(s, to, pose);
}

// Take a step along the turns that does not raise the energy. Return false if there is no such
// step.
static bool step_downhill(const struct hair_rod_shape* s, const hair_rod_rest* rest, double gravity,
                          const hair_dvec3* turns, struct hair_rod_pose* pose)
{
    hair_dquat from[HAIR_MAX_GUIDE_VERTICES];
    double before = energy_of(s, rest, gravity, pose), max = 0;
    for (uint32_t i = 0; i + 1 < s->count; ++i) max = fmax(max, hair_dlength(turns[i]));
    double fraction = fmin(1, LONGEST_TURN / max);
    memcpy(from, pose->frame, s->count * sizeof *from);
    for (int k = 0; k < HALVINGS; ++k, fraction /= 2) {
        turn_by(s, from, turns, fraction, pose);
        if (energy_of(s, rest, gravity, pose) <= before + ROUNDING * fabs(before)) return true;
    }
    turn_by(s, from, turns, 0, pose);
    return false;
}

double hair_rod_settle(const struct hair_rod_shape* s, const hair_rod_rest* rest, double gravity,
                       uint32_t steps, struct hair_rod_pose* pose)
{
    hair_dvec3 slope[HAIR_MAX_GUIDE_VERTICES], turns[HAIR_MAX_GUIDE_VERTICES];
    double length = 0, stiffness = 0, left = 0;
    for (uint32_t i = 0; i + 1 < s->count; ++i) {
        length += s->length[i];
        stiffness = fmax(stiffness, hair_rod_stiffness(s, i));
    }
    double torque = s->weight * length;
    HAIR_ASSERT(torque > 0 && stiffness > 0);
    for (uint32_t k = 0;; ++k) {
        hair_rod_load(s, gravity, pose);
        hair_rod_strain(s, rest, pose);
        left = find_slope(s, pose, slope) / torque;
        double shift = 0;
        if (k == steps || (left < AT_REST && hair_rod_is_stable(s, pose, 0))) return left;
        for (uint32_t i = 0; left < AT_REST && i + 1 < s->count; ++i)
            slope[i] = (hair_dvec3){KICK * torque, 0, KICK * torque};
        while (!hair_rod_find_step(s, pose, shift, slope, turns)) {
            shift = fmax(SHIFT_GROWTH * shift, FIRST_SHIFT * stiffness);
            if (!(shift < LAST_SHIFT * stiffness)) return left;
        }
        if (!step_downhill(s, rest, gravity, turns, pose)) return left;
    }
}
