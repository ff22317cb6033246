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
// A matrix that is not positive gets a multiple of the unit matrix. Each step is halved
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

// Return the frame of the scalp.
HAIR_LANES_INLINE struct hair_lanes4 hair_block_scalp(const struct hair_block* b)
{
    return hair_lanes_multiply(b->vertex->frame, hair_lanes_conjugate(b->vertex->turn));
}

// Set the turn of a segment and the place of its end. `before` is the frame of the segment before.
HAIR_LANES_INLINE void hair_block_place_segment(struct hair_block_vertex* v, struct hair_lanes4 before)
{
    struct hair_lanes4 q = v->pose.frame;
    struct hair_lanes3 along = hair_lanes_rotate(q, (struct hair_lanes3){{0}, v->length, {0}});
    v->pose.turn = hair_lanes_forward(hair_lanes_multiply(hair_lanes_conjugate(before), q));
    v[1].pose.place = hair_lanes_add(v->pose.place, along);
}

// Set turns and places of a pose from its frames. The scalp keeps its frame.
HAIR_LANES_INLINE void hair_block_place(struct hair_block* b)
{
    struct hair_lanes4 before = hair_block_scalp(b);
    b->vertex->pose.place = (struct hair_lanes3){{0}, {0}, {0}};
    for (uint32_t i = 0; i + 1 < b->count; ++i) {
        hair_block_place_segment(b->vertex + i, before);
        before = b->vertex[i].pose.frame;
    }
}

// Add to the load the force at the end of a segment: the pull to the groom, and gravity. Return the
// load in the frame of the segment.
HAIR_LANES_INLINE struct hair_lanes3 hair_block_add_load(const struct hair_block* b,
                                                         const struct hair_block_vertex* v,
                                                         hair_lanes gravity, struct hair_lanes3* load)
{
    struct hair_lanes3 back = hair_lanes_subtract(v[1].place, v[1].pose.place),
                       fall = hair_lanes_scale(b->load, gravity);
    struct hair_lanes3 own = hair_lanes_add(fall, hair_lanes_scale(back, v[1].pull));
    *load = hair_lanes_add(*load, hair_lanes_scale(own, v[1].mass));
    return hair_lanes_rotate(hair_lanes_conjugate(v->pose.frame), *load);
}

HAIR_LANES_INLINE struct hair_lanes3 hair_block_stress_for(struct hair_lanes4 turn, struct hair_lanes3 moment)
{
    struct hair_lanes3 v = hair_block_axis(turn), across = hair_lanes_cross(v, moment);
    hair_lanes w = hair_lanes_max(turn.w, hair_lanes_of(HAIR_BLOCK_MIN_COSINE));
    hair_lanes twist = hair_lanes_dot(v, moment) / w;
    return hair_lanes_subtract(hair_lanes_add(hair_lanes_scale(moment, w), hair_lanes_scale(v, twist)),
                               across);
}

// Return the stress that balances the forces, where 2 w at rest equals 2 w of the pose. Advance the
// moment, which is in the frame of the segment it acts on:
//
//   q_i* M_i = q_i* M_(i+1) + l_i y x F_i
HAIR_LANES_INLINE struct hair_lanes3 hair_block_balance(const struct hair_block_vertex* v,
                                                        struct hair_lanes3 force, struct hair_lanes3* moment)
{
    struct hair_lanes3 lever = {v->length * force.z, {0}, -v->length * force.x};
    *moment = hair_lanes_rotate(v->pose.turn, hair_lanes_add(*moment, lever)); // In frame i-1.
    return hair_block_stress_for(v->pose.turn, *moment);
}

// Return the difference of a turn from the rest shape.
HAIR_LANES_INLINE struct hair_lanes4 hair_block_excess(struct hair_lanes4 rest, struct hair_lanes4 turn)
{
    return (struct hair_lanes4){2 * turn.x - rest.x, 2 * turn.y - rest.y, 2 * turn.z - rest.z,
                                2 * turn.w - rest.w};
}

// Return the difference of the pose from the rest shape.
HAIR_LANES_INLINE struct hair_lanes4 hair_block_excess_at(const struct hair_block* b,
                                                          const struct hair_block_vertex* v)
{
    return hair_block_excess(b->is_own ? hair_block_own_rest(v->turn) : v->rest, v->pose.turn);
}

// Return the energy of vertex i, and of gravity and the pull at the end of the segment after it.
HAIR_LANES_INLINE hair_lanes hair_block_add_energy(const struct hair_block* b, uint32_t i, hair_lanes energy)
{
    const struct hair_block_vertex* v = b->vertex + i;
    struct hair_lanes4 u = hair_block_excess_at(b, v);
    struct hair_lanes3 r = hair_block_ratios(b, i), place = v[1].pose.place;
    struct hair_lanes3 back = hair_lanes_subtract(v[1].place, place);
    hair_lanes bent = r.x * u.x * u.x + r.y * u.y * u.y + r.z * (u.z * u.z + u.w * u.w);
    energy += v->stiffness / 2 * bent;
    energy -= v[1].mass * b->gravity * (b->load.x * place.x + b->load.y * place.y + b->load.z * place.z);
    return energy + v[1].mass * v[1].pull / 2 * hair_lanes_dot(back, back);
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

// Return the rotation by a turn of at most HAIR_BLOCK_LONGEST_TURN. The series end below the
// rounding error.
HAIR_LANES_INLINE struct hair_lanes4 hair_block_exponential(struct hair_lanes3 turn)
{
    hair_lanes h = hair_lanes_dot(turn, turn) / 4; // Square of half the angle.
    hair_lanes sine = 1 - h * (1.0 / 110) * (1 - h * (1.0 / 156));
    hair_lanes cosine = 1 - h * (1.0 / 90) * (1 - h * (1.0 / 132));
    sine = 1 - h * (1.0 / 6) * (1 - h * (1.0 / 20) * (1 - h * (1.0 / 42) * (1 - h * (1.0 / 72) * sine)));
    cosine = 1 - h * (1.0 / 2) * (1 - h * (1.0 / 12) * (1 - h * (1.0 / 30) * (1 - h * (1.0 / 56) * cosine)));
    return (struct hair_lanes4){sine / 2 * turn.x, sine / 2 * turn.y, sine / 2 * turn.z, cosine};
}

// Turn the segments from their frames `from` by a fraction of the turns. Return the energy.
HAIR_LANES_INLINE hair_lanes hair_block_turn_by(struct hair_block* b, hair_lanes fraction)
{
    hair_lanes energy = {0};
    struct hair_lanes4 before = hair_block_scalp(b);
    b->vertex->pose.place = (struct hair_lanes3){{0}, {0}, {0}};
    for (uint32_t i = 0; i + 1 < b->count; ++i) {
        struct hair_block_vertex* v = b->vertex + i;
        struct hair_lanes4 turn = hair_block_exponential(hair_lanes_scale(v->search.turns, fraction));
        v->pose.frame = hair_lanes_multiply(v->search.from, turn);
        hair_block_place_segment(v, before);
        before = v->pose.frame;
        energy = hair_block_add_energy(b, i, energy);
    }
    return energy;
}

// Take a step along the turns that does not raise the energy. `max` is the maximum turn squared.
// Return where there is such a step, and its energy. The pose of other lanes remains.
HAIR_LANES_INLINE hair_lane_mask hair_block_step_downhill(struct hair_block* b, hair_lanes max,
                                                          hair_lane_mask active, hair_lanes* energy)
{
    hair_lanes before = *energy, limit = HAIR_BLOCK_LONGEST_TURN / hair_lanes_sqrt(max);
    hair_lanes fraction = hair_lanes_min(hair_lanes_of(1), limit);
    hair_lanes allowed = before + HAIR_BLOCK_ROUNDING * hair_lanes_abs(before);
    hair_lane_mask found = ~active;
    for (uint32_t i = 0; i + 1 < b->count; ++i) b->vertex[i].search.from = b->vertex[i].pose.frame;
    for (int k = 0; k < HAIR_BLOCK_HALVINGS; ++k) {
        *energy = hair_block_turn_by(b, fraction);
        found |= *energy <= allowed;
        if (!hair_lanes_any(~found)) return active;
        fraction = hair_lanes_select(found, fraction, fraction / 2);
    }
    hair_block_turn_by(b, hair_lanes_select(found, fraction, (hair_lanes){0}));
    return found & active;
}

// Compute forces, stress and slopes of the pose, and eliminate all turns. Return where there is a
// step. Set `torque` to the maximum torque on a segment.
HAIR_LANES_INLINE hair_lane_mask hair_block_find_step(struct hair_block* b, hair_lane_mask active,
                                                      hair_lanes* torque)
{
    struct hair_block_beyond v = {0};
    struct hair_lanes3 load = {{0}, {0}, {0}};
    hair_lanes max = {0};
    for (uint32_t i = b->count - 1; i-- > 0;) {
        struct hair_block_vertex* at = b->vertex + i;
        struct hair_lanes4 u = hair_block_excess_at(b, at);
        struct hair_lanes3 r = hair_block_ratios(b, i);
        hair_lanes k = at->stiffness;
        at->pose.force = hair_block_add_load(b, at, b->gravity, &load);
        at->pose.stress = (struct hair_lanes3){k * r.x * u.x, k * r.y * u.y, k * r.z * u.z};
        at->pose.real_stress = k * r.z * u.w;
        struct hair_lanes3 f = hair_lanes_scale(at->pose.force, at->length), slope = {-f.z, {0}, f.x};
        slope = hair_lanes_add(slope, hair_block_slope_at(at, 1));
        if (i + 2 < b->count) slope = hair_lanes_add(slope, hair_block_slope_at(at + 1, -1));
        at->search.slope = slope;
        max = hair_lanes_max(max, hair_lanes_dot(slope, slope));
        active &= hair_block_eliminate_turn(b, i, (hair_lanes){0}, &v);
    }
    *torque = hair_lanes_sqrt(max);
    return active;
}

// Find a step for the slopes, with as little added to the matrix as this needs. Return where there
// is a step.
HAIR_LANES_INLINE hair_lane_mask hair_block_find_shifted(struct hair_block* b, hair_lanes stiffness,
                                                         hair_lane_mask active)
{
    hair_lanes shift = {0};
    for (;;) {
        struct hair_block_beyond v = {0};
        hair_lane_mask failed = {0};
        for (uint32_t i = b->count - 1; i-- > 0;)
            failed |= active & ~hair_block_eliminate_turn(b, i, shift, &v);
        if (!hair_lanes_any(failed)) return active;
        hair_lanes more = hair_lanes_max(HAIR_BLOCK_SHIFT_GROWTH * shift, HAIR_BLOCK_FIRST_SHIFT * stiffness);
        shift = hair_lanes_select(failed, more, shift);
        active &= ~(failed & ~(shift < HAIR_BLOCK_LAST_SHIFT * stiffness));
    }
}

// Kick lanes that are at rest in an unstable pose. Return the lanes that are at rest in a stable
// one.
HAIR_LANES_INLINE hair_lane_mask hair_block_kick(struct hair_block* b, hair_lanes kick, hair_lane_mask rests)
{
    hair_lane_mask stable = hair_block_is_stable(b, 0, rests);
    for (uint32_t i = 0; i + 1 < b->count; ++i) {
        struct hair_lanes3* slope = &b->vertex[i].search.slope;
        slope->x = hair_lanes_select(rests, kick, slope->x);
        slope->y = hair_lanes_select(rests, (hair_lanes){0}, slope->y);
        slope->z = hair_lanes_select(rests, kick, slope->z);
    }
    return stable;
}

// Return where all vertices of the pose are near their places `at`.
HAIR_LANES_INLINE hair_lane_mask hair_block_is_near(const struct hair_block* b, hair_lanes distance)
{
    hair_lanes max = {0};
    for (uint32_t i = 1; i < b->count; ++i) {
        const struct hair_block_vertex* v = b->vertex + i;
        struct hair_lanes3 d = hair_lanes_subtract(v->pose.place, v->search.at);
        max = hair_lanes_max(max, hair_lanes_dot(d, d));
    }
    return max < distance * distance;
}

// Move the pose of the active lanes to a stable equilibrium under `gravity` times the load, by at
// most `steps` steps of Newton's method. Where the pose comes near the places `at`, stop.
HAIR_LANES_INLINE void hair_block_settle(struct hair_block* b)
{
    hair_lanes length = {0}, stiffness = {0}, energy = {0}, torque;
    hair_lane_mask active = b->active;
    for (uint32_t i = 0; i + 1 < b->count; ++i) {
        length += b->vertex[i].length;
        stiffness = hair_lanes_max(stiffness, b->vertex[i].stiffness);
        energy = hair_block_add_energy(b, i, energy);
    }
    hair_lanes unit = b->weight * length;
    for (uint32_t k = 0;; ++k) {
        for (int n = 0; n < HAIR_LANES; ++n)
            if (k >= b->steps[n]) active[n] = 0;
        if (b->has_target) active &= ~hair_block_is_near(b, b->near * length);
        if (!hair_lanes_any(active)) return;
        hair_lane_mask is_found = hair_block_find_step(b, active, &torque);
        hair_lane_mask rests = active & (torque / unit < HAIR_BLOCK_AT_REST);
        if (hair_lanes_any(rests)) active &= ~hair_block_kick(b, HAIR_BLOCK_KICK * unit, rests);
        if (hair_lanes_any(active & (rests | ~is_found)))
            active = hair_block_find_shifted(b, stiffness, active);
        hair_lanes max = hair_block_find_turns_of_step(b, active);
        active = hair_block_step_downhill(b, max, active, &energy);
    }
}

#endif
