// cut.c - public calls that cut hair and let it grow.
#include "lib/api/api.h"

#include <hair/hair_cut.h>

// Check a range of guides.
static hair_result check_range(const hair_instance* hair, uint32_t first, uint32_t count)
{
    uint32_t guides = hair->sim.guides;
    if (first <= guides && count <= guides - first) return HAIR_OK;
    return hair_fail(&hair->context->host, HAIR_ERROR_ARGUMENT,
                     "%s: first is %u and count is %u, but there are %u guides", hair->label, first, count,
                     guides);
}

static hair_result check_fractions(const hair_instance* hair, uint32_t count, const float* fractions)
{
    for (uint32_t i = 0; i < count; ++i)
        if (!(fractions[i] >= 0 && fractions[i] <= 1)) // NaN fails too.
            return hair_fail(&hair->context->host, HAIR_ERROR_ARGUMENT,
                             "%s: fractions[%u] is %g, not in [0, 1]", hair->label, i, (double)fractions[i]);
    return HAIR_OK;
}

// Discard what has been computed from strands of other lengths. A strand that becomes shorter does
// not move, so that there is no velocity of this change.
static void invalidate(hair_instance* hair)
{
    hair_geometry_invalidate_guides(&hair->geometry);
    hair_geometry_invalidate(&hair->geometry);
    hair_geometry_forget_history(&hair->geometry);
}

static hair_result set_lengths(hair_instance* hair, uint32_t first, uint32_t count, const float* fractions)
{
    bool changes = false;
    hair_enter(hair);
    hair_result result = hair_sim_set_lengths(&hair->sim, first, count, fractions, &changes);
    if (!result && changes) invalidate(hair);
    return hair_leave(hair->context, result);
}

hair_result hair_set_lengths(hair_instance* hair, uint32_t first, uint32_t count, const float* fractions)
{
    HAIR_TRY(hair_check_instance(hair));
    const hair_host* host = &hair->context->host;
    HAIR_TRY(check_range(hair, first, count));
    if (fractions) HAIR_TRY(check_fractions(hair, count, fractions));
    if (hair->creation.thread_mapping == HAIR_THREAD_MAPPING_FEEDBACK)
        return hair_fail(host, HAIR_ERROR_ARGUMENT,
                         "%s: lengths cannot change with HAIR_THREAD_MAPPING_FEEDBACK", hair->label);
    HAIR_TRY(hair_check_current(hair->context));
    if (fractions || !count) return set_lengths(hair, first, count, fractions);
    float* whole = hair_alloc(host, count, sizeof *whole);
    if (!whole) return hair_fail_memory(host, "the lengths of guides");
    for (uint32_t i = 0; i < count; ++i) whole[i] = 1;
    hair_result result = set_lengths(hair, first, count, whole);
    hair_free(host, whole);
    return result;
}

hair_result hair_get_lengths(const hair_instance* hair, uint32_t first, uint32_t count, float* fractions)
{
    HAIR_TRY(hair_check_instance(hair));
    HAIR_TRY(check_range(hair, first, count));
    if (!fractions && count)
        return hair_fail(&hair->context->host, HAIR_ERROR_ARGUMENT, "%s: fractions is NULL but count is %u",
                         hair->label, count);
    for (uint32_t i = 0; i < count; ++i) fractions[i] = hair_sim_length_fraction(&hair->sim, first + i);
    return HAIR_OK;
}
