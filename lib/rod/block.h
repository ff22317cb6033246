// block.h - a block of guides as rods, one guide a lane.
//
// All guides of a block have the same number of vertices. Their physics differ at most by group and
// by factors. The functions of the files block_*.h work on all lanes at once. See rod_shape.h for
// the shape of a single guide.
#ifndef HAIR_ROD_BLOCK_H
#define HAIR_ROD_BLOCK_H

#include "lib/rod/lanes.h"
#include "lib/rod/rod_shape.h"

// Second derivatives of a vertex's energy by the turns a before and b after it. See
// block_variation.h.
struct hair_block_hinge {
    hair_lanes before[6], after[6]; // Entries 00, 10, 11, 20, 21 and 22 by a a and by b b.
    hair_lanes between[3][3]; // Row r has the derivatives by component r of b.
};

// Columns of the derivative of a segment by its turn, of which the second is 0.
struct hair_block_swing {
    hair_lanes x[3], z[3];
};

// Terms of a segment in the energy of small motions.
struct hair_block_terms {
    struct hair_lanes3 force; // Force on all beyond the segment, in its frame, times its length.
    hair_lanes pull; // Stiffness of the pull at the end of the segment, less that of slow motions.
    struct hair_block_swing swing;
};

// Row of a segment after elimination, from which its turn is computed. See block_variation.h.
struct hair_block_stage {
    hair_lanes l10, l20, l21, over_d[3]; // Row r of L^-1, and the diagonal of D^-1.
    hair_lanes by_x[3][3], by_a[3][3]; // L^-1 times the derivatives of b's slope by x and by a.
    hair_lanes slope[3]; // L^-1 times b's slope.
    struct hair_block_swing swing;
};

struct hair_block_vertex {
    // Shape of the groom. See struct hair_rod_shape.
    hair_lanes length, mass, pull, bend;
    struct hair_lanes4 frame, turn;
    struct hair_lanes3 place;
    hair_lanes material; // Stiffness of the material. `bend` may be stiffer.
    hair_lanes stiffness; // hair_rod_stiffness()
    hair_lanes lever;
    hair_lanes strain; // Strain that balances gravity in the groom, times the stiffness.
    struct hair_lanes4 rest; // Rest shape that balances the pose. w is 2 w at rest.
    struct {
        struct hair_lanes4 frame, turn;
        struct hair_lanes3 place, force, stress;
        hair_lanes real_stress;
    } pose; // See block_statics.h.
    union {
        struct { // Stability of the groom for any stiffness.
            struct hair_block_hinge unit;
            hair_lanes self, between[3][3];
            struct hair_block_terms terms;
        } groom;
        struct { // A search for a pose of rest.
            struct hair_lanes3 slope, turns, at;
            struct hair_lanes4 from, failed, found;
            struct hair_block_stage stage;
        } search;
    };
};

struct hair_block {
    uint32_t count; // Number of vertices.
    double ratio[3];
    const hair_physics* physics[HAIR_LANES]; // Physics of each guide.
    hair_physics own[HAIR_LANES]; // Physics that factors have changed.
    struct hair_lanes3 load; // Gravity that the rest strain is to balance, m/s^2.
    bool is_round; // True if the section is round.
    bool is_loaded; // True if no load is 0. Otherwise all loads are 0.
    bool sags; // True if the guides hold another pose than their groom.
    bool is_own; // True if the rest shape of a search is the groom, not `rest`.
    hair_lanes weight; // Weight of all vertices but the root.
    hair_lanes cut_off; // Length that is cut off beyond the tip, m.
    struct hair_lanes3 clamp_ratio; // Ratios at the root. See hair_rod_ratios_at().
    struct hair_lanes3 root_stress; // Stress of the groom at the root.
    hair_lane_mask active; // Guides that a function works on.
    hair_lane_mask holds; // Result of a test.
    hair_lanes gravity; // Multiple of the load.
    hair_lanes amount; // Multiple c of the levers. See gravity_preload.c.
    bool has_target; // True if a search stops near the places `at`.
    double near; // Distance of such places, as a fraction of the length.
    uint32_t steps[HAIR_LANES]; // Maximum steps of Newton's method.
    struct hair_block_vertex vertex[];
};

// Return the stiffness of the hinge at the clamp, divided by B / l. See rod_shape.c.
HAIR_LANES_INLINE hair_lanes hair_block_clamp_factor(hair_lanes length, hair_lanes weight, hair_lanes bend)
{
    hair_lanes p = length * hair_lanes_sqrt(weight / bend);
    return 1 + p / 2 + hair_lanes_sqrt(1 + p * p / 4);
}

// Compute stiffness and ratios from `bend`. Vertices that do not resist get no numbers.
HAIR_LANES_INLINE void hair_block_find_stiffness(struct hair_block* b)
{
    struct hair_block_vertex* root = b->vertex;
    hair_lanes factor = hair_block_clamp_factor(root->length, b->weight, root->bend);
    root->stiffness = factor * root->bend / root->length;
    b->clamp_ratio.x =
        b->ratio[0] * hair_block_clamp_factor(root->length, b->weight, b->ratio[0] * root->bend) / factor;
    b->clamp_ratio.y = b->ratio[1] * 2 / factor;
    b->clamp_ratio.z =
        b->ratio[2] * hair_block_clamp_factor(root->length, b->weight, b->ratio[2] * root->bend) / factor;
    for (uint32_t i = 1; i + 1 < b->count; ++i) {
        struct hair_block_vertex* v = root + i;
        v->stiffness = 2 * v->bend / (v[-1].length + v->length);
    }
}

HAIR_LANES_INLINE struct hair_lanes3 hair_block_ratios(const struct hair_block* b, uint32_t i)
{
    if (i == 0) return b->clamp_ratio;
    return (struct hair_lanes3){hair_lanes_of(b->ratio[0]), hair_lanes_of(b->ratio[1]),
                                hair_lanes_of(b->ratio[2])};
}

// Return the rest shape that equals the groom.
HAIR_LANES_INLINE struct hair_lanes4 hair_block_own_rest(struct hair_lanes4 turn)
{
    return (struct hair_lanes4){2 * turn.x, 2 * turn.y, 2 * turn.z, 2 * turn.w};
}

HAIR_LANES_INLINE struct hair_lanes4 hair_block_unit(struct hair_lanes4 q)
{
    hair_lanes s = hair_lanes_sqrt(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w);
    struct hair_lanes4 none = {{0}, {0}, {0}, hair_lanes_of(1)};
    hair_lanes over = 1 / s;
    struct hair_lanes4 unit = {q.x * over, q.y * over, q.z * over, q.w * over};
    return hair_lanes_select4(s > 1e-20, unit, none);
}

// Return a frame of the groom, corrected for rounding. See frame_of() of rod_shape.c.
HAIR_LANES_INLINE struct hair_lanes4 hair_block_frame(struct hair_lanes4 rounded, struct hair_lanes3 segment)
{
    struct hair_lanes4 q = hair_block_unit(rounded), flipped = {q.w, q.z, -q.y, -q.x};
    struct hair_lanes3 from = hair_lanes_rotate(q, (struct hair_lanes3){{0}, hair_lanes_of(1), {0}});
    hair_lanes size = hair_lanes_length(segment);
    struct hair_lanes3 to = hair_lanes_scale(segment, 1 / size), c = hair_lanes_cross(from, to);
    hair_lanes w = 1 + hair_lanes_dot(from, to);
    struct hair_lanes4 turned =
        hair_block_unit(hair_lanes_multiply(hair_block_unit((struct hair_lanes4){c.x, c.y, c.z, w}), q));
    struct hair_lanes4 frame = hair_lanes_select4(w < 1e-6, flipped, turned);
    return hair_lanes_select4(size > 0, frame, q);
}

HAIR_LANES_INLINE void hair_block_find_masses(struct hair_block* b)
{
    struct hair_block_vertex* v = b->vertex;
    hair_lanes total = {0}, so_far = {0}, bend, root, tip, tip_mass;
    double radius = (double)b->physics[0]->fiber.radius, density = (double)b->physics[0]->fiber.density;
    double g = hair_dlength(hair_dload(b->physics[0]->gravity));
    for (int k = 0; k < HAIR_LANES; ++k) {
        const hair_physics* physics = b->physics[k];
        bend[k] = (double)physics->fiber.youngs_modulus * radius * radius / (4 * density);
        root[k] = (double)physics->shape.stiffness_root;
        tip[k] = (double)physics->shape.stiffness_tip;
        tip_mass[k] = (double)physics->tip_mass;
    }
    for (uint32_t i = 0; i < b->count; ++i) {
        v[i].mass = i > 0 ? (v[i].length + v[i - 1].length) / 2 : v[i].length / 2;
        total += v[i].length;
    }
    const hair_lanes whole = total + b->cut_off, none = {0};
    v[b->count - 1].mass += hair_lanes_select(b->cut_off > 0, none, tip_mass * total);
    b->weight = (hair_lanes){0};
    for (uint32_t i = 0; i < b->count; ++i) {
        hair_lanes fraction = so_far / whole;
        v[i].material = bend * (root + fraction * (tip - root));
        v[i].bend = v[i].material;
        for (int k = 0; k < HAIR_LANES; ++k)
            v[i].pull[k] =
                hair_rod_pull_squared(b->physics[k], (double)i / (b->count - 1) * (total[k] / whole[k]));
        so_far += v[i].length;
        if (i > 0) b->weight += v[i].mass * g;
    }
}

// Compute the frames of the groom. On entry, `frame` has the rounded frames, and `place` has the
// vectors of segments. `before` is the frame of the scalp.
HAIR_LANES_INLINE void hair_block_find_turns(struct hair_block* b, struct hair_lanes4 before)
{
    struct hair_lanes3 place = {{0}, {0}, {0}};
    before = hair_block_unit(before);
    for (uint32_t i = 0; i + 1 < b->count; ++i) {
        struct hair_block_vertex* v = b->vertex + i;
        v->frame = hair_block_frame(v->frame, v->place);
        v->turn = hair_lanes_forward(hair_lanes_multiply(hair_lanes_conjugate(before), v->frame));
        before = v->frame;
        v->place = place;
        struct hair_lanes3 y = {{0}, hair_lanes_of(1), {0}};
        place = hair_lanes_add(place, hair_lanes_scale(hair_lanes_rotate(v->frame, y), v->length));
    }
    b->vertex[b->count - 1].place = place;
}

#endif
