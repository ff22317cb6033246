// save.c - public calls that save and restore the state of an instance as bytes.
#include "lib/api/api.h"

hair_result hair_save(hair_instance* hair, void* bytes, size_t capacity, size_t* size)
{
    HAIR_TRY(hair_check_instance(hair));
    const hair_host* host = &hair->context->host;
    if (!size) return hair_fail(host, HAIR_ERROR_ARGUMENT, "%s: size is NULL", hair->label);
    if (!bytes && capacity)
        return hair_fail(host, HAIR_ERROR_ARGUMENT, "%s: bytes is NULL but capacity is %zu", hair->label,
                         capacity);
    HAIR_TRY(hair_check_current(hair->context));
    *size = hair_sim_save_size(&hair->sim);
    if (!bytes) return HAIR_OK;
    if (capacity < *size)
        return hair_fail(host, HAIR_ERROR_ARGUMENT, "%s: capacity is %zu, less than the state's %zu bytes",
                         hair->label, capacity, *size);
    HAIR_TRY(hair_catch_up(&hair, 1));
    hair_sim_save(&hair->sim, bytes);
    return hair_check_lost(hair->context, HAIR_OK);
}

hair_result hair_load(hair_instance* hair, const void* bytes, size_t size)
{
    HAIR_TRY(hair_check_instance(hair));
    hair_context* context = hair->context;
    if (!bytes) return hair_fail(&context->host, HAIR_ERROR_ARGUMENT, "%s: bytes is NULL", hair->label);
    HAIR_TRY(hair_check_current(context));
    hair_enter_unprofiled(hair);
    hair_result result = hair_sim_load(&hair->sim, bytes, size);
    if (!result) {
        hair->pace.pending = 0;
        hair_geometry_invalidate_guides(&hair->geometry);
        hair_geometry_forget_history(&hair->geometry);
    }
    return hair_leave(context, result);
}
