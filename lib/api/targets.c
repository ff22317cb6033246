// targets.c - public calls on target poses of guides.
#include "lib/api/api.h"

// End the targets.
static hair_result end_targets(hair_instance* hair, uint32_t count)
{
    if (count)
        return hair_fail(&hair->context->host, HAIR_ERROR_ARGUMENT,
                         "%s: positions is NULL but their count is %u", hair->label, count);
    HAIR_TRY(hair_check_current(hair->context));
    hair_enter(hair);
    hair_targets_fade(&hair->sim);
    return hair_leave(hair->context, HAIR_OK);
}

hair_result hair_set_targets(hair_instance* hair, const float* positions, uint32_t count, size_t stride,
                             const float to_world[16])
{
    HAIR_TRY(hair_check_instance(hair));
    struct hair_pose space;
    if (!positions) return end_targets(hair, count);
    HAIR_TRY(hair_check_positions(hair, stride, to_world, &space));
    if (count != hair->sim.guide_vertices)
        return hair_fail(&hair->context->host, HAIR_ERROR_ARGUMENT,
                         "%s: count is %u, not the %u of the guides' vertices", hair->label, count,
                         hair->sim.guide_vertices);
    hair_result result;
    float* packed = hair_copy_positions(hair, "the targets", positions, count, stride, &result);
    if (!packed) return result;
    hair_enter(hair);
    result = hair_targets_create(&hair->sim);
    if (!result) hair_targets_set(&hair->sim, packed, &space);
    hair_free(&hair->context->host, packed);
    return hair_leave(hair->context, result);
}

hair_result hair_set_targets_buffer(hair_instance* hair, uint32_t gl_buffer, size_t offset, size_t stride,
                                    const float to_world[16])
{
    HAIR_TRY(hair_check_instance(hair));
    struct hair_pose space;
    size_t from = 0, size = 0;
    HAIR_TRY(hair_check_positions(hair, stride, to_world, &space));
    hair_result result = hair_check_position_buffer(hair->context, hair->label, "targets", gl_buffer, offset,
                                                    stride, hair->sim.guide_vertices, &from, &size);
    if (result) return hair_check_lost(hair->context, result);
    hair_enter(hair);
    result = hair_targets_create(&hair->sim);
    if (!result)
        hair_targets_set_buffer(&hair->sim, gl_buffer, from, size, (uint32_t)((offset - from) / 4),
                                (uint32_t)(stride / 4), &space);
    return hair_leave(hair->context, result);
}

static hair_result check_weights(const hair_instance* hair, const hair_target_blend* blend)
{
    const hair_host* host = &hair->context->host;
    if (blend->guide_weights && blend->guide_count != hair->sim.guides)
        return hair_fail(host, HAIR_ERROR_ARGUMENT,
                         "hair_target_blend.guide_count is %u, not the %u of the guides", blend->guide_count,
                         hair->sim.guides);
    if (!blend->guide_weights && blend->guide_count)
        return hair_fail(host, HAIR_ERROR_ARGUMENT,
                         "hair_target_blend.guide_weights is NULL but guide_count is %u", blend->guide_count);
    for (uint32_t i = 0; i < blend->guide_count; ++i)
        if (!(blend->guide_weights[i] >= 0 && blend->guide_weights[i] <= 1)) // NaN fails too.
            return hair_fail(host, HAIR_ERROR_ARGUMENT,
                             "hair_target_blend.guide_weights[%u] is %g, not in [0, 1]", i,
                             (double)blend->guide_weights[i]);
    return HAIR_OK;
}

hair_result hair_set_target_blend(hair_instance* hair, const hair_target_blend* blend)
{
    HAIR_TRY(hair_check_instance(hair));
    hair_target_blend own;
    HAIR_TRY(HAIR_COPY_IN(&hair->context->host, hair_target_blend, blend, &own));
    HAIR_TRY(check_weights(hair, &own));
    if (!hair_targets_are_on(&hair->sim)) return hair_targets_set_blend(&hair->sim, &own, own.guide_weights);
    HAIR_TRY(hair_check_current(hair->context));
    hair_enter(hair);
    return hair_leave(hair->context, hair_targets_set_blend(&hair->sim, &own, own.guide_weights));
}
