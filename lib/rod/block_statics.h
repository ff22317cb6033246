// block_statics.h - forces and stress of a block of rods in a pose, and their poses of rest.
//
// Let x_k be the position of vertex k, m_k its mass, and X_k its position in the groom. Let F_i be
// the force on all beyond segment i, by gravity g and the pull p_k = m_k w_k^2 to the groom:
//
//   F_i = sum_(k > i) m_k g + p_k (X_k - x_k)
//
// In equilibrium the moment in the strand at vertex i is
//
//   M_i = M_(i+1) + l_i t_i x F_i,   M_(n-1) = 0
//
// where l_i is the length of segment i, and t_i its direction.
//
// Let (w, v) = conj(q_(i-1)) q_i. A turn of segment i by d, in the frame of segment i-1, changes
// the strain u = 2 v by w d + d x v, and 2 w by -v . d. The stress G = dE/du and e = dE/d(2 w) thus
// exert the moment M = w G + v x G - e v. In a pose whose 2 w equal those at rest, e is 0. The
// stress for a moment is then
//
//   G = w M + v (v . M) / w - v x M
//
// A pose of rest is found by Newton's method on the turns of the segments, as in block_variation.h.
// Where the matrix is not positive, a multiple of the unit matrix is added. Each step is halved
// until it does not raise the energy.
#ifndef HAIR_ROD_BLOCK_STATICS_H
#define HAIR_ROD_BLOCK_STATICS_H

#include "lib/rod/block_variation.h"

// Minimum cosine of half the angle between segments. At 0 there is no stress for some moments.
#define HAIR_BLOCK_MIN_COSINE 1e-6
#define HAIR_BLOCK_LONGEST_TURN 0.5 // Maximum turn of a segment in one step, radians.
#define HAIR_BLOCK_HALVINGS 30 // Maximum halvings of a step.
#define HAIR_BLOCK_ROUNDING 1e-14 // Rounding error of the energy, as a fraction.
// Torque that ends the search, as a fraction of the maximum possible.
#define HAIR_BLOCK_AT_REST 1e-10
// Torque that is tried in an unstable pose without torque, as a fraction of the maximum possible.
#define HAIR_BLOCK_KICK 1e-3
// First added multiple of the unit matrix, over the maximum stiffness.
#define HAIR_BLOCK_FIRST_SHIFT 1e-3
#define HAIR_BLOCK_SHIFT_GROWTH 4.0 // Growth factor of the added multiple.
#define HAIR_BLOCK_LAST_SHIFT 1e6 // Upper limit of the added multiple, over the maximum stiffness.

HAIR_LANES_INLINE struct hair_lanes3 hair_block_axis(struct hair_lanes4 q)
{
    return (struct hair_lanes3){q.x, q.y, q.z};
}

// Set turns and places of a pose from its frames. The scalp keeps its frame.
HAIR_LANES_INLINE void hair_block_place(struct hair_block* b)
{
    struct hair_block_vertex* v = b->vertex;
    // Frame of the segment before, which is that of the scalp at first.
    struct hair_lanes4 before = hair_lanes_multiply(v->frame, hair_lanes_conjugate(v->turn));
    v->pose.place = (struct hair_lanes3){{0}, {0}, {0}};
    for (uint32_t i = 0; i + 1 < b->count; ++i, ++v) {
        struct hair_lanes4 q = v->pose.frame;
        struct hair_lanes3 along = hair_lanes_rotate(q, (struct hair_lanes3){{0}, v->length, {0}});
        v->pose.turn = hair_lanes_forward(hair_lanes_multiply(hair_lanes_conjugate(before), q));
        v[1].pose.place = hair_lanes_add(v->pose.place, along);
        before = q;
    }
}

// Set the forces of a pose to the pull to the groom and `gravity` times the load.
HAIR_LANES_INLINE void hair_block_load(struct hair_block* b, hair_lanes gravity)
{
    struct hair_lanes3 sum = {{0}, {0}, {0}},
                       load = {b->load[0] * gravity, b->load[1] * gravity, b->load[2] * gravity};
    for (uint32_t i = b->count - 1; i-- > 0;) {
        struct hair_block_vertex* v = b->vertex + i;
        struct hair_lanes3 back = hair_lanes_subtract(v[1].place, v[1].pose.place);
        struct hair_lanes3 own = hair_lanes_add(load, hair_lanes_scale(back, v[1].pull));
        sum = hair_lanes_add(sum, hair_lanes_scale(own, v[1].mass));
        v->pose.force = hair_lanes_rotate(hair_lanes_conjugate(v->pose.frame), sum);
    }
}

HAIR_LANES_INLINE struct hair_lanes3 hair_block_stress_for(struct hair_lanes4 turn, struct hair_lanes3 moment)
{
    struct hair_lanes3 v = hair_block_axis(turn), across = hair_lanes_cross(v, moment);
    hair_lanes w = hair_lanes_max(turn.w, hair_lanes_of(HAIR_BLOCK_MIN_COSINE));
    hair_lanes twist = hair_lanes_dot(v, moment) / w;
    return hair_lanes_subtract(hair_lanes_add(hair_lanes_scale(moment, w), hair_lanes_scale(v, twist)),
                               across);
}

// Set the stress to the one that balances the forces, where 2 w at rest equals 2 w of the pose. The
// moments are in the frame of the segment they act on:
//
//   q_i* M_i = q_i* M_(i+1) + l_i y x F_i
HAIR_LANES_INLINE void hair_block_balance(struct hair_block* b)
{
    struct hair_lanes3 moment = {{0}, {0}, {0}};
    for (uint32_t i = b->count - 1; i-- > 0;) {
        struct hair_block_vertex* v = b->vertex + i;
        struct hair_lanes3 lever = {v->length * v->pose.force.z, {0}, -v->length * v->pose.force.x};
        moment = hair_lanes_rotate(v->pose.turn, hair_lanes_add(moment, lever)); // In frame i-1.
        v->pose.stress = hair_block_stress_for(v->pose.turn, moment);
        v->pose.real_stress = (hair_lanes){0};
    }
}

// Return the difference of a turn from the rest shape.
HAIR_LANES_INLINE struct hair_lanes4 hair_block_excess(struct hair_lanes4 rest, struct hair_lanes4 turn)
{
    return (struct hair_lanes4){2 * turn.x - rest.x, 2 * turn.y - rest.y, 2 * turn.z - rest.z,
                                2 * turn.w - rest.w};
}

// Set the stress that results from the stiffness and the rest shape.
HAIR_LANES_INLINE void hair_block_strain(struct hair_block* b)
{
    for (uint32_t i = 0; i + 1 < b->count; ++i) {
        struct hair_block_vertex* v = b->vertex + i;
        struct hair_lanes4 u =
            hair_block_excess(b->is_own ? hair_block_own_rest(v->turn) : v->rest, v->pose.turn);
        hair_lanes k = v->stiffness;
        struct hair_lanes3 r = hair_block_ratios(b, i);
        v->pose.stress = (struct hair_lanes3){k * r.x * u.x, k * r.y * u.y, k * r.z * u.z};
        v->pose.real_stress = k * r.z * u.w;
    }
}

HAIR_LANES_INLINE hair_lanes hair_block_energy(const struct hair_block* b)
{
    hair_lanes energy = {0};
    for (uint32_t i = 0; i + 1 < b->count; ++i) {
        const struct hair_block_vertex* v = b->vertex + i;
        struct hair_lanes4 u =
            hair_block_excess(b->is_own ? hair_block_own_rest(v->turn) : v->rest, v->pose.turn);
        struct hair_lanes3 r = hair_block_ratios(b, i), place = v[1].pose.place;
        struct hair_lanes3 back = hair_lanes_subtract(v[1].place, place);
        hair_lanes bent = r.x * u.x * u.x + r.y * u.y * u.y + r.z * (u.z * u.z + u.w * u.w);
        energy += v->stiffness / 2 * bent;
        energy -=
            v[1].mass * b->gravity * (b->load[0] * place.x + b->load[1] * place.y + b->load[2] * place.z);
        energy += v[1].mass * v[1].pull / 2 * hair_lanes_dot(back, back);
    }
    return energy;
}

// Return the derivative of vertex i's energy by the turn of the segment after it. With a `side` of
// -1, return that by the turn of the segment before. Each is in the frame of its segment.
HAIR_LANES_INLINE struct hair_lanes3 hair_block_slope_at(const struct hair_block_vertex* v, double side)
{
    struct hair_lanes3 g = v->pose.stress, axis = hair_block_axis(v->pose.turn);
    struct hair_lanes3 own =
        hair_lanes_subtract(hair_lanes_scale(g, v->pose.turn.w), hair_lanes_scale(axis, v->pose.real_stress));
    return hair_lanes_add(hair_lanes_scale(own, hair_lanes_of(side)), hair_lanes_cross(g, axis));
}

// Set the slopes to the derivative of the energy by the turns. Return the maximum torque.
HAIR_LANES_INLINE hair_lanes hair_block_find_slope(struct hair_block* b)
{
    hair_lanes max = {0};
    for (uint32_t i = 0; i + 1 < b->count; ++i) {
        struct hair_block_vertex* v = b->vertex + i;
        struct hair_lanes3 f = hair_lanes_scale(v->pose.force, v->length), slope = {-f.z, {0}, f.x};
        slope = hair_lanes_add(slope, hair_block_slope_at(v, 1));
        if (i + 2 < b->count) slope = hair_lanes_add(slope, hair_block_slope_at(v + 1, -1));
        v->search.slope = slope;
        max = hair_lanes_max(max, hair_lanes_dot(slope, slope));
    }
    return hair_lanes_sqrt(max);
}

// Return the rotation by a turn of at most HAIR_BLOCK_LONGEST_TURN. The series end below the
// rounding error.
HAIR_LANES_INLINE struct hair_lanes4 hair_block_exponential(struct hair_lanes3 turn)
{
    hair_lanes h = hair_lanes_dot(turn, turn) / 4; // Square of half the angle.
    hair_lanes sine = 1 - h / 6 * (1 - h / 20 * (1 - h / 42 * (1 - h / 72 * (1 - h / 110 * (1 - h / 156)))));
    hair_lanes cosine = 1 - h / 2 * (1 - h / 12 * (1 - h / 30 * (1 - h / 56 * (1 - h / 90 * (1 - h / 132)))));
    return (struct hair_lanes4){sine / 2 * turn.x, sine / 2 * turn.y, sine / 2 * turn.z, cosine};
}

// Turn the segments from their frames `from` by a fraction of the turns.
HAIR_LANES_INLINE void hair_block_turn_by(struct hair_block* b, hair_lanes fraction)
{
    for (uint32_t i = 0; i + 1 < b->count; ++i) {
        struct hair_block_vertex* v = b->vertex + i;
        v->pose.frame = hair_lanes_multiply(
            v->search.from, hair_block_exponential(hair_lanes_scale(v->search.turns, fraction)));
    }
    hair_block_place(b);
}

// Take a step along the turns that does not raise the energy. Return where there is such a step.
// The pose of other lanes remains.
HAIR_LANES_INLINE hair_lane_mask hair_block_step_downhill(struct hair_block* b, hair_lane_mask active)
{
    hair_lanes before = hair_block_energy(b), max = {0}, none = {0};
    for (uint32_t i = 0; i + 1 < b->count; ++i) {
        struct hair_block_vertex* v = b->vertex + i;
        struct hair_lanes3* t = &v->search.turns;
        *t =
            (struct hair_lanes3){hair_lanes_select(active, t->x, none), hair_lanes_select(active, t->y, none),
                                 hair_lanes_select(active, t->z, none)};
        max = hair_lanes_max(max, hair_lanes_dot(*t, *t));
        v->search.from = v->pose.frame;
    }
    hair_lanes limit = HAIR_BLOCK_LONGEST_TURN / hair_lanes_sqrt(max), one = hair_lanes_of(1);
    hair_lanes fraction = hair_lanes_min(one, limit);
    hair_lanes allowed = before + HAIR_BLOCK_ROUNDING * hair_lanes_abs(before);
    hair_lane_mask found = ~active;
    for (int k = 0; k < HAIR_BLOCK_HALVINGS; ++k) {
        hair_block_turn_by(b, fraction);
        found |= hair_block_energy(b) <= allowed;
        if (!hair_lanes_any(~found)) return active;
        fraction = hair_lanes_select(found, fraction, fraction / 2);
    }
    hair_block_turn_by(b, hair_lanes_select(found, fraction, none));
    return found & active;
}

// Return where a step is found for the slopes. Add as little to the matrix as this needs.
HAIR_LANES_INLINE hair_lane_mask hair_block_find_shifted(struct hair_block* b, hair_lanes stiffness,
                                                         hair_lane_mask active)
{
    hair_lanes shift = {0};
    for (;;) {
        hair_lane_mask failed = active & ~hair_block_find_step(b, shift, active);
        if (!hair_lanes_any(failed)) return active;
        hair_lanes more = hair_lanes_max(HAIR_BLOCK_SHIFT_GROWTH * shift, HAIR_BLOCK_FIRST_SHIFT * stiffness);
        shift = hair_lanes_select(failed, more, shift);
        active &= ~(failed & ~(shift < HAIR_BLOCK_LAST_SHIFT * stiffness));
    }
}

// Move the pose of the active lanes to a stable equilibrium under `gravity` times the load, by at
// most `steps` steps of Newton's method.
HAIR_LANES_INLINE void hair_block_settle(struct hair_block* b)
{
    hair_lanes length = {0}, stiffness = {0};
    hair_lane_mask active = b->active;
    for (uint32_t i = 0; i + 1 < b->count; ++i) {
        length += b->vertex[i].length;
        stiffness = hair_lanes_max(stiffness, b->vertex[i].stiffness);
    }
    hair_lanes torque = b->weight * length, kick = HAIR_BLOCK_KICK * torque;
    for (uint32_t k = 0;; ++k) {
        for (int n = 0; n < HAIR_LANES; ++n)
            if (k >= b->steps[n]) active[n] = 0;
        if (!hair_lanes_any(active)) return;
        hair_block_load(b, b->gravity);
        hair_block_strain(b);
        hair_lane_mask rests = active & (hair_block_find_slope(b) / torque < HAIR_BLOCK_AT_REST);
        if (hair_lanes_any(rests)) {
            active &= ~hair_block_is_stable(b, 0, rests);
            rests &= active;
            if (!hair_lanes_any(active)) return;
            for (uint32_t i = 0; i + 1 < b->count; ++i) {
                struct hair_lanes3* slope = &b->vertex[i].search.slope;
                slope->x = hair_lanes_select(rests, kick, slope->x);
                slope->y = hair_lanes_select(rests, (hair_lanes){0}, slope->y);
                slope->z = hair_lanes_select(rests, kick, slope->z);
            }
        }
        active = hair_block_find_shifted(b, stiffness, active);
        active = hair_block_step_downhill(b, active);
    }
}

#endif
