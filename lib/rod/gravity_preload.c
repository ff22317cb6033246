// gravity_preload.c - how guides hold their groom against gravity.
//
// Guides are computed in blocks: see block.h. A first pass tests all guides. Guides that need more
// stiffness, and guides that sag, are collected and computed in blocks of their own, so that all
// guides of a block take about the same steps.
//
// A clamped strand is statically determinate. In any pose, the stress that balances all forces
// follows from the pose alone, and so does the rest strain that gives this stress. The groom can
// therefore always be made an equilibrium. Two things can still be wrong with it: it may be
// unstable, and the rest strain may be far from the groom's own strain. Both get better with more
// stiffness, at any vertex.
//
// Stiffness is a property of the material. As little as possible is added, and the result is never
// more than three times the original. Vertex i becomes min(3, 1 + c e_i) times as stiff, with the
// smallest c that suffices. The lever of vertex i is
//
//   e_i = sum_(k > i) m_k (s_k - s_i)
//
// where m is the mass of a vertex and s its arc length. The lever e_i is the moment that all beyond
// vertex i would exert on it if it stood out straight. On the built-in haircuts, this lever adds
// about half as much stiffness as one multiple for all vertices.
//
// Where three times is not enough, the guide holds another pose, which sags. The candidates are the
// poses y(t) of rest of a guide three times as stiff under t times the gravity, with the groom as
// its rest shape. y(0) is the groom, and y(1) is stable because it is at rest. In the pose y(t) the
// rest strain again balances the whole gravity, with the 2 w0 of rod.h from that pose. This balance
// is exact however roughly y(t) was computed, so one step of Newton's method for each t is enough.
// The smallest t is taken whose pose is stable and is reached by the guide when released from its
// groom. Other ways from the groom to a hanging pose sag farther on the built-in haircuts. Examples
// are gravity on a part of the strand only, and a pull to the groom that weakens.
#include "lib/rod/block_kernels.h"

#include <stdint.h>
#include <string.h>

#define FINENESS 1.02 // Precision of 1 + c, as a ratio.
#define STEP 0.125 // Step of t.
#define BISECTIONS 3 // Number of bisections of a step of t.
#define STEPS 1 // Steps of Newton's method for each t below 1.
#define LAST_STEPS 60 // Maximum steps of Newton's method where it must converge.
#define SAME 1e-4 // Maximum distance between equal poses, as a fraction of the length.
#define ALIGNMENT (8 * HAIR_LANES) // Bytes of a vector.

struct preload {
    const struct hair_rods_preload* desc;
    const struct hair_guide* guides;
    const struct hair_rest* rest;
    const struct hair_block_kernels* run;
    struct hair_block* block;
    // Guides in the order of their numbers of vertices, those that need more stiffness, and those
    // that sag.
    uint32_t *all, *soft, *sagging, soft_count, sagging_count;
    uint32_t guide[HAIR_LANES], lanes; // Guides of the block.
    hair_lanes sag; // Distance from the groom, m.
};

// Set the physics and the load of lane k. Return whether the load is not 0.
static bool load_physics(struct preload* a, uint32_t k, uint32_t guide)
{
    struct hair_block* b = a->block;
    const hair_physics* physics = a->desc->find_physics(a->desc->user, guide, &b->own[k]);
    hair_dvec3 load = hair_dscale(hair_dload(physics->gravity), (double)physics->shape.gravity_preload);
    b->physics[k] = physics;
    b->load.x[k] = load.x, b->load.y[k] = load.y, b->load.z[k] = load.z;
    // Only a clamped strand can balance gravity. A hinged strand hangs. A free one falls.
    return physics->root == HAIR_ROOT_CLAMPED && hair_ddot(load, load) > 0;
}

// Choose guides that have equal numbers of vertices from the list. All of them have a load, or none
// has one. The last guide fills the rest of the lanes. Return the number of guides.
static uint32_t fill_lanes(struct preload* a, const uint32_t* list, uint32_t count)
{
    struct hair_block* b = a->block;
    uint32_t lanes = 0;
    b->count = a->guides[list[0]].count;
    for (; lanes < count && lanes < HAIR_LANES; ++lanes) {
        if (a->guides[list[lanes]].count != b->count) break;
        bool is_loaded = load_physics(a, lanes, list[lanes]);
        if (lanes > 0 && is_loaded != b->is_loaded) break;
        b->is_loaded = is_loaded;
        a->guide[lanes] = list[lanes];
    }
    for (uint32_t k = lanes; k < HAIR_LANES; ++k) load_physics(a, k, list[lanes - 1]);
    hair_rods_ratios(b->physics[0], b->ratio);
    b->is_round = b->ratio[0] == b->ratio[2];
    return lanes;
}

// Load guides from the list. Return their number.
static uint32_t load_block(struct preload* a, const uint32_t* list, uint32_t count)
{
    struct hair_block* b = a->block;
    struct hair_lanes4 scalp;
    a->lanes = fill_lanes(a, list, count);
    for (uint32_t k = 0; k < HAIR_LANES; ++k) {
        const struct hair_guide* guide = a->guides + a->guide[k < a->lanes ? k : a->lanes - 1];
        const struct hair_rest* rest = a->rest + guide->first;
        hair_vec4 q = guide->root_frame;
        scalp.x[k] = (double)q.x, scalp.y[k] = (double)q.y, scalp.z[k] = (double)q.z,
        scalp.w[k] = (double)q.w;
        b->active[k] = k < a->lanes ? -1 : 0;
        for (uint32_t i = 0; i < b->count; ++i) {
            struct hair_block_vertex* v = b->vertex + i;
            bool is_tip = i + 1 == b->count;
            q = rest[i].frame;
            v->frame.x[k] = (double)q.x, v->frame.y[k] = (double)q.y;
            v->frame.z[k] = (double)q.z, v->frame.w[k] = (double)q.w;
            v->length[k] = is_tip ? 0 : fmax((double)rest[i].position.w, HAIR_ROD_SHORTEST);
            if (is_tip) b->cut_off[k] = (double)rest[i].position.w;
            if (is_tip) continue;
            v->place.x[k] = (double)rest[i + 1].position.x - (double)rest[i].position.x;
            v->place.y[k] = (double)rest[i + 1].position.y - (double)rest[i].position.y;
            v->place.z[k] = (double)rest[i + 1].position.z - (double)rest[i].position.z;
        }
    }
    a->run->find_shape(b, &scalp);
    return a->lanes;
}

// Write the vertices of the guide in lane k.
static void write_held_guide(const struct hair_block* b, uint32_t k, struct hair_rod_borne* out)
{
    for (uint32_t i = 0; i < b->count; ++i) {
        const struct hair_block_vertex* v = b->vertex + i;
        out[i] = (struct hair_rod_borne){.stiffen = 1};
        if (i + 1 == b->count) break;
        out[i].rest_real = 2 * v->turn.w[k];
        if (!b->is_loaded) continue;
        out[i].stress[0] = v->pose.stress.x[k];
        out[i].stress[1] = v->pose.stress.y[k];
        out[i].stress[2] = v->pose.stress.z[k];
        out[i].rest_real = v->rest.w[k];
        if (v->material[k] > 0) out[i].stiffen = v->bend[k] / v->material[k];
    }
}

// Write some guides of the block.
static void write_guides(struct preload* a, hair_lane_mask mask)
{
    struct hair_block* b = a->block;
    if (b->is_loaded) a->run->find_result(b);
    for (uint32_t k = 0; k < a->lanes; ++k) {
        if (!mask[k]) continue;
        struct hair_rod_borne* out = a->desc->out + a->guides[a->guide[k]].first;
        write_held_guide(b, k, out);
        HAIR_ASSERT(out->stiffen >= 1 && out->stiffen < 1.001 * HAIR_ROD_MAX_STIFFEN);
        a->desc->sags[a->guide[k]] = b->sags ? (float)a->sag[k] : -1;
    }
}

// Stiffen the guides as much as is allowed.
static void stiffen_fully(struct preload* a)
{
    struct hair_block* b = a->block;
    b->amount = (HAIR_ROD_MAX_STIFFEN - 1) / b->vertex[b->count - 2].lever;
    a->run->stiffen(b);
}

// Write the guides of the block that hold their groom. Collect the others.
static void test_block(struct preload* a)
{
    struct hair_block* b = a->block;
    hair_lane_mask resists = b->active, holds = ~resists;
    a->run->prepare_groom(b);
    a->run->test_groom(b);
    holds |= b->holds;
    b->active = ~holds;
    if (hair_lanes_any(b->active)) {
        stiffen_fully(a);
        a->run->test_groom(b);
        for (uint32_t k = 0; k < a->lanes; ++k) {
            if (holds[k]) continue;
            if (b->holds[k])
                a->soft[a->soft_count++] = a->guide[k];
            else
                a->sagging[a->sagging_count++] = a->guide[k];
        }
        b->amount = (hair_lanes){0};
        a->run->stiffen(b);
    }
    b->active = resists;
    if (hair_lanes_any(holds)) write_guides(a, holds);
}

// Stiffen the guides of the block by as little as they need, and write them. The guides hold their
// groom with the maximum stiffness.
static void stiffen_block(struct preload* a)
{
    struct hair_block* b = a->block;
    hair_lane_mask all = b->active;
    a->run->prepare_groom(b);
    stiffen_fully(a);
    hair_lanes fails = hair_lanes_of(1), does = 1 + b->amount; // 1 + c
    for (;;) {
        hair_lanes middle = hair_lanes_sqrt(fails * does);
        b->active = all & (does > FINENESS * fails);
        if (!hair_lanes_any(b->active)) break;
        b->amount = middle - 1;
        a->run->stiffen(b);
        a->run->test_groom(b);
        does = hair_lanes_select(b->holds, middle, does);
        fails = hair_lanes_select(b->active & ~b->holds, middle, fails);
    }
    b->active = all;
    b->amount = does - 1;
    a->run->stiffen(b);
    write_guides(a, all);
}

// Move the poses of some guides to y(t), and find where they hold. The other guides keep theirs.
static void test_at(struct preload* a, hair_lanes t, hair_lane_mask active)
{
    struct hair_block* b = a->block;
    b->active = active;
    b->gravity = t;
    b->is_own = true;
    for (int k = 0; k < HAIR_LANES; ++k) b->steps[k] = t[k] < 1 ? STEPS : LAST_STEPS;
    a->run->settle(b);
    b->active = active;
    a->run->test_pose(b);
}

// Set the frames of the poses of some guides.
#define SET_FRAMES(block, mask, to, value)                                                                   \
    for (uint32_t i = 0; i + 1 < (block)->count; ++i) {                                                      \
        struct hair_block_vertex* v = (block)->vertex + i;                                                   \
        (to) = hair_lanes_select4((mask), (value), (to));                                                    \
    }

// Find the smallest t whose pose holds, and set the pose. Set t to more than 1 where no pose holds.
static void find_pose(struct preload* a, hair_lanes* t)
{
    struct hair_block* b = a->block;
    hair_lane_mask all = b->active, active = all;
    hair_lanes fails = {0}, does = hair_lanes_of(STEP);
    SET_FRAMES(b, all, v->search.failed, v->frame)
    while (hair_lanes_any(active)) {
        test_at(a, does, active);
        hair_lane_mask failed = active & ~b->holds, more = failed & (does < 1);
        SET_FRAMES(b, b->holds, v->search.found, v->pose.frame)
        SET_FRAMES(b, more, v->search.failed, v->pose.frame)
        fails = hair_lanes_select(more, does, fails);
        does = hair_lanes_select(failed, does + STEP, does);
        active = more;
    }
    hair_lane_mask found = all & (does <= 1);
    for (int k = 0; k < BISECTIONS && hair_lanes_any(found); ++k) {
        hair_lanes middle = (fails + does) / 2;
        SET_FRAMES(b, found, v->pose.frame, v->search.failed)
        a->run->place(b);
        test_at(a, middle, found);
        hair_lane_mask failed = found & ~b->holds;
        SET_FRAMES(b, b->holds, v->search.found, v->pose.frame)
        SET_FRAMES(b, failed, v->search.failed, v->pose.frame)
        does = hair_lanes_select(b->holds, middle, does);
        fails = hair_lanes_select(failed, middle, fails);
    }
    SET_FRAMES(b, found, v->pose.frame, v->search.found)
    a->run->place(b);
    *t = hair_lanes_select(all, does, hair_lanes_of(1 + STEP));
}

// Return the maximum distance of a vertex of the pose from its position in the groom, or from `at`.
HAIR_LANES_INLINE hair_lanes max_distance(const struct hair_block* b, bool is_from_groom)
{
    hair_lanes max = {0};
    for (uint32_t i = 1; i < b->count; ++i) {
        const struct hair_block_vertex* v = b->vertex + i;
        struct hair_lanes3 d = hair_lanes_subtract(v->pose.place, is_from_groom ? v->place : v->search.at);
        max = hair_lanes_max(max, hair_lanes_dot(d, d));
    }
    return hair_lanes_sqrt(max);
}

// Find the active guides that come to rest in the pose when released from their groom. Add them to
// the mask.
static void find_reached(struct preload* a, hair_lane_mask* out)
{
    struct hair_block* b = a->block;
    hair_lane_mask active = b->active;
    hair_lanes length = {0};
    for (uint32_t i = 0; i < b->count; ++i) {
        b->vertex[i].search.at = b->vertex[i].pose.place;
        length += b->vertex[i].length;
    }
    SET_FRAMES(b, active, v->search.found, v->pose.frame)
    SET_FRAMES(b, active, v->pose.frame, v->frame)
    a->run->place(b);
    b->gravity = hair_lanes_of(1);
    b->is_own = false;
    for (int k = 0; k < HAIR_LANES; ++k) b->steps[k] = LAST_STEPS;
    b->has_target = true;
    b->near = SAME;
    a->run->settle(b);
    b->has_target = false;
    *out |= active & (max_distance(b, false) < SAME * length);
    SET_FRAMES(b, active, v->pose.frame, v->search.found)
    a->run->place(b);
}

// No pose of some guides can be held. Their rest shape balances no gravity, and they hang.
static void hang(struct preload* a, hair_lane_mask mask)
{
    struct hair_block* b = a->block;
    for (uint32_t i = 0; i + 1 < b->count; ++i) {
        struct hair_block_vertex* v = b->vertex + i;
        v->rest = hair_lanes_select4(mask, hair_block_own_rest(v->turn), v->rest);
    }
    SET_FRAMES(b, mask, v->pose.frame, v->frame)
    a->run->place(b);
    b->active = mask;
    b->gravity = hair_lanes_of(1);
    b->is_own = true;
    for (int k = 0; k < HAIR_LANES; ++k) b->steps[k] = LAST_STEPS;
    a->run->settle(b);
}

// Find the poses that the guides of the block hold, and write the guides. The guides do not hold
// their groom with the maximum stiffness.
static void sag_block(struct preload* a)
{
    struct hair_block* b = a->block;
    hair_lane_mask all = b->active, done = ~all;
    stiffen_fully(a);
    hair_lanes t;
    find_pose(a, &t);
    hair_lane_mask pending = all & (t <= 1);
    while (hair_lanes_any(pending)) {
        b->active = pending;
        a->run->test_pose(b);
        b->active = b->holds;
        if (hair_lanes_any(b->active)) find_reached(a, &done);
        pending &= ~done & (t < 1);
        t = hair_lanes_min(t + STEP, hair_lanes_of(1));
        if (hair_lanes_any(pending)) test_at(a, t, pending);
    }
    if (hair_lanes_any(~done)) hang(a, ~done);
    a->sag = max_distance(b, true);
    b->active = all;
    b->sags = true;
    write_guides(a, all);
    b->sags = false;
}

static void run_all(struct preload* a, uint32_t count)
{
    struct hair_block* b = a->block;
    for (uint32_t i = 0; i < count;) {
        i += load_block(a, a->all + i, count - i);
        hair_lane_mask all = {0};
        if (b->is_loaded)
            test_block(a);
        else
            write_guides(a, ~all);
    }
    for (uint32_t i = 0; i < a->soft_count;) {
        i += load_block(a, a->soft + i, a->soft_count - i);
        stiffen_block(a);
    }
    for (uint32_t i = 0; i < a->sagging_count;) {
        i += load_block(a, a->sagging + i, a->sagging_count - i);
        sag_block(a);
    }
}

// Sort the listed guides by their number of vertices. Return the maximum of a guide.
static uint32_t sort_guides(const struct hair_rods_preload* desc, uint32_t* out)
{
    uint32_t first[HAIR_MAX_GUIDE_VERTICES + 2] = {0}, max = 0;
    for (uint32_t i = 0; i < desc->count; ++i) {
        uint32_t vertices = desc->guides[desc->list ? desc->list[i] : i].count;
        HAIR_ASSERT(2 <= vertices && vertices <= HAIR_MAX_GUIDE_VERTICES);
        ++first[vertices + 1];
        if (vertices > max) max = vertices;
    }
    for (uint32_t n = 1; n < HAIR_MAX_GUIDE_VERTICES + 2; ++n) first[n] += first[n - 1];
    for (uint32_t i = 0; i < desc->count; ++i) {
        uint32_t guide = desc->list ? desc->list[i] : i;
        out[first[desc->guides[guide].count]++] = guide;
    }
    return max;
}

hair_result hair_rods_preload_list(const struct hair_rods_preload* desc)
{
    const hair_host whole = hair_host_or_default(desc->host);
    struct preload a = {.desc = desc, .guides = desc->guides, .rest = desc->rest};
    if (!desc->count) return HAIR_OK;
    a.run = hair_block_kernels();
    a.all = hair_alloc(&whole, desc->count, 3 * sizeof *a.all);
    if (!a.all) return HAIR_ERROR_MEMORY;
    a.soft = a.all + desc->count;
    a.sagging = a.soft + desc->count;
    size_t bytes = sizeof *a.block + sort_guides(desc, a.all) * sizeof *a.block->vertex;
    char* memory = hair_alloc(&whole, bytes + ALIGNMENT, 1);
    if (memory) {
        a.block = (struct hair_block*)(memory + (ALIGNMENT - (uintptr_t)memory % ALIGNMENT) % ALIGNMENT);
        run_all(&a, desc->count);
    }
    hair_free(&whole, memory);
    hair_free(&whole, a.all);
    return memory ? HAIR_OK : HAIR_ERROR_MEMORY;
}
