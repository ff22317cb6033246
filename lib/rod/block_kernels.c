// block_kernels.c - the functions of gravity_preload.c that run through all vertices of a block.
//
// Each function is compiled for several sets of instructions. All sets give the same bits, because
// no operations are fused.
#include "lib/rod/block_kernels.h"

#include "lib/rod/block_statics.h"

#define MARGIN 1.05 // Multiple of gravity under which a pose must be stable.
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
HAIR_LANES_INLINE void find_shape(struct hair_block* b, const hair_physics* physics,
                                  const struct hair_lanes4* scalp)
{
    hair_block_find_masses(b, physics);
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
    hair_block_load(b, hair_lanes_of(1));
    hair_block_balance(b);
    for (uint32_t i = 0; i + 1 < b->count; ++i)
        b->vertex[i].strain = strain_by(b->vertex[i].pose.stress, hair_block_ratios(b, i));
    b->root_stress = b->vertex[0].pose.stress;
    hair_block_load(b, hair_lanes_of(MARGIN));
    hair_block_balance(b);
    hair_block_prepare_stability(b, SLOWEST * SLOWEST);
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

// Set `rest` to the rest shape that balances the pose under gravity. Return where the strain of the
// rest shape is allowed.
HAIR_LANES_INLINE hair_lane_mask balance_gravity(struct hair_block* b)
{
    hair_lane_mask allowed = ~(hair_lane_mask){0};
    hair_block_load(b, hair_lanes_of(1));
    hair_block_balance(b);
    for (uint32_t i = 0; i + 1 < b->count; ++i) {
        struct hair_block_vertex* v = b->vertex + i;
        struct hair_lanes3 g = hair_lanes_scale(v->pose.stress, 1 / v->stiffness);
        struct hair_lanes3 ratio = hair_block_ratios(b, i);
        struct hair_lanes4 t = v->pose.turn;
        v->rest = (struct hair_lanes4){2 * t.x - g.x / ratio.x, 2 * t.y - g.y / ratio.y,
                                       2 * t.z - g.z / ratio.z, 2 * t.w};
        allowed &= hair_lanes_length(strain_off(v)) <= HAIR_ROD_MAX_STRAIN;
    }
    return allowed;
}

// Find where the pose can be held. Set `rest` to the rest shape that holds the pose.
HAIR_LANES_INLINE void test_pose(struct hair_block* b)
{
    hair_lane_mask allowed = b->active & balance_gravity(b);
    hair_block_load(b, hair_lanes_of(MARGIN));
    hair_block_balance(b);
    b->holds = hair_block_is_stable(b, SLOWEST * SLOWEST, allowed);
}

// Set the stress of the pose to the stress that the rest strain causes in the groom.
HAIR_LANES_INLINE void find_result(struct hair_block* b)
{
    if (!b->sags) balance_gravity(b);
    for (uint32_t i = 0; i + 1 < b->count; ++i) {
        struct hair_block_vertex* v = b->vertex + i;
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
    target static void find_shape_##suffix(struct hair_block* b, const hair_physics* physics,                \
                                           const struct hair_lanes4* scalp)                                  \
    {                                                                                                        \
        find_shape(b, physics, scalp);                                                                       \
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
