// scalp.c - public calls on scalp motion, for a scalp that the application skins.
#include "lib/api/api.h"

static hair_result check_scalp(hair_instance* hair, size_t stride, const float* to_world,
                               struct hair_pose* space)
{
    const hair_host* host = &hair->context->host;
    if (!hair_scalp_motion_vertex_count(&hair->sim))
        return hair_fail(host, HAIR_ERROR_ARGUMENT, "%s: its groom has no scalp", hair->label);
    return hair_check_positions(hair, stride, to_world, space);
}

hair_result hair_set_scalp(hair_instance* hair, const float* positions, uint32_t count, size_t stride,
                           const float to_world[16])
{
    HAIR_TRY(hair_check_instance(hair));
    const hair_host* host = &hair->context->host;
    struct hair_pose space;
    if (!positions) return hair_fail(host, HAIR_ERROR_ARGUMENT, "%s: positions is NULL", hair->label);
    HAIR_TRY(check_scalp(hair, stride, to_world, &space));
    uint32_t vertices = hair_scalp_motion_vertex_count(&hair->sim);
    if (count != vertices)
        return hair_fail(host, HAIR_ERROR_ARGUMENT, "%s: count is %u, not the %u of the groom's scalp",
                         hair->label, count, vertices);
    hair_result result;
    float* packed = hair_copy_positions(hair, "the scalp", positions, count, stride, &result);
    if (!packed) return result;
    hair_enter(hair);
    result = hair_geometry_create_scalp_roots(&hair->geometry, &hair->sim);
    if (!result) hair_scalp_motion_set(&hair->sim, packed, &space);
    hair_free(host, packed);
    return hair_leave(hair->context, result);
}

hair_result hair_set_scalp_buffer(hair_instance* hair, uint32_t gl_buffer, size_t offset, size_t stride,
                                  const float to_world[16])
{
    HAIR_TRY(hair_check_instance(hair));
    struct hair_pose space;
    size_t from = 0, size = 0;
    HAIR_TRY(check_scalp(hair, stride, to_world, &space));
    hair_result result = hair_check_position_buffer(hair, "scalp", gl_buffer, offset, stride,
                                                    hair_scalp_motion_vertex_count(&hair->sim), &from, &size);
    if (result) return hair_check_lost(hair->context, result);
    hair_enter(hair);
    result = hair_geometry_create_scalp_roots(&hair->geometry, &hair->sim);
    if (!result)
        hair_scalp_motion_set_buffer(&hair->sim, gl_buffer, from, size, (uint32_t)((offset - from) / 4),
                                     (uint32_t)(stride / 4), &space);
    return hair_leave(hair->context, result);
}
