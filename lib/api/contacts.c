// contacts.c - public calls that record and report the contacts of hair with colliders.
#include "lib/api/api.h"

#define MAX_STRANDS 1e6f // Maximum number of strands whose mass a guide has.

hair_result hair_record_contacts(hair_instance* hair, float strands)
{
    HAIR_TRY(hair_check_instance(hair));
    const hair_host* host = &hair->context->host;
    struct hair_sim* sim = &hair->sim;
    if (!(strands >= 0 && strands <= MAX_STRANDS))
        return hair_fail(host, HAIR_ERROR_ARGUMENT, "%s: strands is %g, not in [0, 1e6]", hair->label,
                         (double)strands);
    if (strands > 0 && sim->solver != HAIR_SOLVER_DIRECT && sim->solver != HAIR_SOLVER_ACCURATE)
        return hair_fail(host, HAIR_ERROR_ARGUMENT, "%s: its solver has no forces of contacts", hair->label);
    HAIR_TRY(hair_check_current(hair->context));
    hair_enter_unprofiled(hair);
    hair_impulses_set(sim, (double)strands);
    return hair_leave(hair->context, HAIR_OK);
}

static hair_collider_contact convert(const struct hair_impulse* impulse)
{
    hair_collider_contact out = {
        .key = impulse->key, .collider = impulse->collider, .vertices = impulse->vertices};
    const double *n = impulse->normal, size = impulse->size > 0 ? impulse->size : 1;
    double length = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    for (int i = 0; i < 3; ++i) {
        out.position[i] = (float)(impulse->place[i] / size);
        out.normal[i] = length > 0 ? (float)(n[i] / length) : 0;
        out.impulse[i] = (float)impulse->impulse[i];
        out.angular_impulse[i] = (float)impulse->moment[i];
    }
    return out;
}

hair_result hair_get_contacts(hair_instance* hair, bool wait, hair_collider_contact* contacts, size_t stride,
                              uint32_t capacity, uint32_t* count)
{
    HAIR_TRY(hair_check_instance(hair));
    const hair_host* host = &hair->context->host;
    struct hair_impulses* impulses = &hair->sim.impulses;
    if (!count) return hair_fail(host, HAIR_ERROR_ARGUMENT, "%s: count is NULL", hair->label);
    if (!contacts && capacity)
        return hair_fail(host, HAIR_ERROR_ARGUMENT, "%s: contacts is NULL but capacity is %u", hair->label,
                         capacity);
    if (stride != sizeof *contacts)
        return hair_fail(host, HAIR_ERROR_ARGUMENT, "%s: stride is %zu, not sizeof(hair_collider_contact)",
                         hair->label, stride);
    if (impulses->strands == 0)
        return hair_fail(host, HAIR_ERROR_ARGUMENT, "%s: hair_record_contacts() records no contacts",
                         hair->label);
    HAIR_TRY(hair_check_current(hair->context));
    hair_enter_unprofiled(hair);
    HAIR_TRY(hair_leave(hair->context, hair_impulses_collect(&hair->sim, wait)));
    *count = impulses->totals;
    for (uint32_t i = 0; i < impulses->totals && i < capacity; ++i)
        contacts[i] = convert(&impulses->total[i]);
    if (impulses->totals <= capacity) impulses->totals = impulses->merged = 0;
    return HAIR_OK;
}
