// block_kernels.c - the functions of gravity_preload.c that run through all vertices of a block.
//
// Each function is compiled for several sets of instructions. All sets give the same bits, because
// no operations are fused.
#include "lib/rod/block_kernels.h"

#include "lib/rod/block_statics.h"

// Multiple of gravity under which a pose must be stable. Closer to their limit, guides at a parting
// buckle when the head nods or turns, and move unlike the guides beside them.
#define MARGIN 1.3
// Minimum frequency about a pose, rad/s. The default damping of 4/s damps this frequency
// critically.
#define SLOWEST 2.0

HAIR_LANES_INLINE void find_levers(struct hair_block* b)
{
    struct hair_block_vertex* v = b->vertex;
    hair_lanes beyond = {0};
    v[b->count - 1].lever = beyond;
    for (uint32_t i = b->count - 1; i-- > 0;) {
        beyond += v[i + 1].mass;
        v[i].lever = v[i + 1].lever + beyond * v[i].length;
    }
    for (uint32_t i = b->count; i-- > 0;) v[i].lever /= v[0].lever;
}

// Compute the shape of the guides, whose rounded frames, vectors of segments and lengths are set.
HAIR_LANES_INLINE void find_shape(struct hair_block* b, const struct hair_lanes4* scalp)
{
    hair_block_find_masses(b);
    hair_block_find_turns(b, *scalp);
    if (b->is_loaded) find_levers(b);
    hair_block_find_stiffness(b);
    hair_lane_mask resists = ~(hair_lane_mask){0};
    for (uint32_t i = 0; i + 1 < b->count; ++i) {
        b->vertex[i].pose.frame = b->vertex[i].frame;
        resists &= b->vertex[i].stiffness > 0;
    }
    b->active &= resists;
    hair_block_place(b);
}

// Return the length of the strain that a stress causes with the stiffness 1.
HAIR_LANES_INLINE hair_lanes strain_by(struct hair_lanes3 stress, struct hair_lanes3 ratio)
{
    return hair_lanes_length(
        (struct hair_lanes3){stress.x / ratio.x, stress.y / ratio.y, stress.z / ratio.z});
}

// Prepare tests of the groom. The pose is the groom, whose stress does not depend on the stiffness.
HAIR_LANES_INLINE void prepare_groom(struct hair_block* b)
{
    struct hair_lanes3 own = {{0}, {0}, {0}}, load = own, own_moment = own, moment = own;
    for (uint32_t i = b->count - 1; i-- > 0;) {
        struct hair_block_vertex* v = b->vertex + i;
        struct hair_lanes3 force = hair_block_add_load(b, v, hair_lanes_of(1), &own);
        b->root_stress = hair_block_balance(v, force, &own_moment);
        v->strain = strain_by(b->root_stress, hair_block_ratios(b, i));
        force = hair_block_add_load(b, v, hair_lanes_of(MARGIN), &load);
        struct hair_lanes3 stress = hair_block_balance(v, force, &moment);
        hair_block_prepare_stability(b, i, force, stress, SLOWEST * SLOWEST);
    }
}

// Find where the groom can be held with the present stiffness.
HAIR_LANES_INLINE void test_groom(struct hair_block* b)
{
    hair_lane_mask holds = b->active;
    // The stiffness changes the ratios at the clamp.
    b->vertex[0].strain = strain_by(b->root_stress, b->clamp_ratio);
    for (uint32_t i = 0; i + 1 < b->count; ++i)
        holds &= b->vertex[i].strain <= HAIR_ROD_MAX_STRAIN * b->vertex[i].stiffness;
    b->holds = hair_block_test_stability(b, holds);
}

// Stiffen the guides by 1 + `amount` at the root.
HAIR_LANES_INLINE void stiffen(struct hair_block* b)
{
    for (uint32_t i = 0; i + 1 < b->count; ++i) {
        struct hair_block_vertex* v = b->vertex + i;
        v->bend = v->material * hair_lanes_min(hair_lanes_of(HAIR_ROD_MAX_STIFFEN), 1 + b->amount * v->lever);
    }
    hair_block_find_stiffness(b);
}

// Return the difference of the groom's own strain and the rest strain.
HAIR_LANES_INLINE struct hair_lanes3 strain_off(const struct hair_block_vertex* v)
{
    struct hair_lanes4 own = hair_block_own_rest(v->turn);
    return (struct hair_lanes3){own.x - v->rest.x, own.y - v->rest.y, own.z - v->rest.z};
}

// Set `rest` to the rest shape that balances a stress. Return where the strain of the rest shape is
// allowed.
HAIR_LANES_INLINE hair_lane_mask balance_stress(const struct hair_block* b, uint32_t i,
                                                struct hair_block_vertex* v, struct hair_lanes3 stress)
{
    struct hair_lanes3 g = hair_lanes_scale(stress, 1 / v->stiffness), ratio = hair_block_ratios(b, i);
    struct hair_lanes4 t = v->pose.turn;
    v->rest = (struct hair_lanes4){2 * t.x - g.x / ratio.x, 2 * t.y - g.y / ratio.y, 2 * t.z - g.z / ratio.z,
                                   2 * t.w};
    struct hair_lanes3 off = strain_off(v);
    return hair_lanes_dot(off, off) <= HAIR_ROD_MAX_STRAIN * HAIR_ROD_MAX_STRAIN;
}

// Find where the pose can be held. Set `rest` to the rest shape that holds the pose.
HAIR_LANES_INLINE void test_pose(struct hair_block* b)
{
    struct hair_lanes3 own = {{0}, {0}, {0}}, load = own, own_moment = own, moment = own;
    struct hair_block_beyond v = {0};
    struct hair_block_stage stage;
    struct hair_block_hinge hinge;
    hair_lane_mask holds = b->active;
    for (uint32_t i = b->count - 1; i-- > 0;) {
        struct hair_block_vertex* at = b->vertex + i;
        struct hair_lanes3 force = hair_block_add_load(b, at, hair_lanes_of(1), &own);
        holds &= balance_stress(b, i, at, hair_block_balance(at, force, &own_moment));
        if (!hair_lanes_any(holds)) continue;
        force = hair_block_add_load(b, at, hair_lanes_of(MARGIN), &load);
        struct hair_lanes3 stress = hair_block_balance(at, force, &moment);
        struct hair_block_terms terms = hair_block_terms_of(at, force, SLOWEST * SLOWEST);
        hair_block_write_hinge(b, i, stress, (hair_lanes){0}, &hinge);
        holds &= hair_block_eliminate(&hinge, &terms, (hair_lanes){0}, &v, &stage);
    }
    b->holds = holds;
}

// Set the stress of the pose to the stress that the rest strain causes in the groom.
HAIR_LANES_INLINE void find_result(struct hair_block* b)
{
    struct hair_lanes3 load = {{0}, {0}, {0}}, moment = load;
    for (uint32_t i = b->count - 1; i-- > 0;) {
        struct hair_block_vertex* v = b->vertex + i;
        if (!b->sags) {
            struct hair_lanes3 force = hair_block_add_load(b, v, hair_lanes_of(1), &load);
            v->pose.stress = hair_block_balance(v, force, &moment);
            balance_stress(b, i, v, v->pose.stress);
        }
        struct hair_lanes3 u = hair_lanes_scale(strain_off(v), v->stiffness);
        struct hair_lanes3 ratio = hair_block_ratios(b, i), g = v->pose.stress;
        // No stiffness holds a guide with a vertex that does not resist.
        v->pose.stress = (struct hair_lanes3){hair_lanes_select(b->active, ratio.x * u.x, g.x),
                                              hair_lanes_select(b->active, ratio.y * u.y, g.y),
                                              hair_lanes_select(b->active, ratio.z * u.z, g.z)};
        v->rest.w = hair_lanes_select(b->active, v->rest.w, 2 * v->turn.w);
    }
}

#define KERNEL(name, function, suffix, target)                                                               \
    target static void name##_##suffix(struct hair_block* b)                                                 \
    {                                                                                                        \
        function(b);                                                                                         \
    }
#define KERNELS(suffix, target)                                                                              \
    target static void find_shape_##suffix(struct hair_block* b, const struct hair_lanes4* scalp)            \
    {                                                                                                        \
        find_shape(b, scalp);                                                                                \
    }                                                                                                        \
    KERNEL(prepare_groom, prepare_groom, suffix, target)                                                     \
    KERNEL(test_groom, test_groom, suffix, target)                                                           \
    KERNEL(stiffen, stiffen, suffix, target)                                                                 \
    KERNEL(place, hair_block_place, suffix, target)                                                          \
    KERNEL(settle, hair_block_settle, suffix, target)                                                        \
    KERNEL(test_pose, test_pose, suffix, target)                                                             \
    KERNEL(find_result, find_result, suffix, target)                                                         \
    static const struct hair_block_kernels suffix##_kernels = {                                              \
        find_shape_##suffix, prepare_groom_##suffix, test_groom_##suffix, stiffen_##suffix,                  \
        place_##suffix,      settle_##suffix,        test_pose_##suffix,  find_result_##suffix};

KERNELS(plain, )
#if defined(__x86_64__) && !defined(_WIN32)
KERNELS(avx2, __attribute__((target("avx2"))))
#endif

const struct hair_block_kernels* hair_block_kernels(void)
{
#if defined(__x86_64__) && !defined(_WIN32)
    if (__builtin_cpu_supports("avx2")) return &avx2_kernels;
#endif
    return &plain_kernels;
}
