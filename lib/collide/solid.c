// solid.c - lists of colliders: checked, stored and counted.
#include "lib/collide/solid.h"

#include <string.h>

#include "lib/collide/form.h"
#include "lib/collide/pair.h"

// Return how many components of `size` a shape uses.
static int sizes_of(hair_shape shape)
{
    switch (shape) {
    case HAIR_SHAPE_SPHERE: return 1;
    case HAIR_SHAPE_CAPSULE:
    case HAIR_SHAPE_CYLINDER:
    case HAIR_SHAPE_CONE: return 2;
    case HAIR_SHAPE_BOX: return 3;
    default: return 0;
    }
}

static int in_range(float value, float min, float max)
{
    return value >= min && value <= max; // False for NaN.
}

static hair_result check_size(const hair_host* host, const hair_solid* solid, uint32_t i)
{
    int sizes = sizes_of(solid->shape);
    for (int k = 0; k < sizes; ++k) {
        int may_be_0 = solid->rounding > 0 || (solid->shape == HAIR_SHAPE_CAPSULE && k == 1);
        if (!in_range(solid->size[k], 0, 1e6f) || (solid->size[k] == 0 && !may_be_0))
            return hair_fail(host, HAIR_ERROR_ARGUMENT, "solids[%u].size[%d] is %g, not in %s0, 1e6]", i, k,
                             (double)solid->size[k], may_be_0 ? "[" : "(");
    }
    return HAIR_OK;
}

static hair_result check_rotation(const hair_host* host, const hair_solid* solid, uint32_t i)
{
    float norm = 0;
    for (int k = 0; k < 4; ++k) norm += solid->rotation[k] * solid->rotation[k];
    if (fabsf(norm - 1) <= 1e-3f) return HAIR_OK;
    return hair_fail(host, HAIR_ERROR_ARGUMENT, "solids[%u].rotation has norm %g, not 1", i,
                     (double)sqrtf(norm));
}

static hair_result check(const hair_host* host, const hair_solid* solid, uint32_t i)
{
    const struct {
        const char* name;
        float value, min, max;
    } numbers[] = {{"position[0]", solid->position[0], -1e9f, 1e9f},
                   {"position[1]", solid->position[1], -1e9f, 1e9f},
                   {"position[2]", solid->position[2], -1e9f, 1e9f},
                   {"rounding", solid->rounding, 0, 1e6f},
                   {"friction", solid->friction, 0, 100},
                   {"scale", solid->scale, 1e-6f, 1e6f}};
    if ((uint32_t)solid->shape > HAIR_SHAPE_FORM)
        return hair_fail(host, HAIR_ERROR_ARGUMENT, "solids[%u].shape is %d, not in [0, %d]", i,
                         (int)solid->shape, HAIR_SHAPE_FORM);
    for (size_t k = 0; k < sizeof numbers / sizeof *numbers; ++k)
        if (!in_range(numbers[k].value, numbers[k].min, numbers[k].max))
            return hair_fail(host, HAIR_ERROR_ARGUMENT, "solids[%u].%s is %g, not in [%g, %g]", i,
                             numbers[k].name, (double)numbers[k].value, (double)numbers[k].min,
                             (double)numbers[k].max);
    hair_result result = check_rotation(host, solid, i);
    return result ? result : check_size(host, solid, i);
}

static hair_solid solid_at(const hair_solid* from, uint32_t i, size_t stride)
{
    hair_solid solid;
    memcpy(&solid, (const unsigned char*)from + i * stride, sizeof solid);
    return solid;
}

// Lists -------------------------------------------------------------------------------------------

static hair_result reserve(const hair_host* host, struct hair_solid_list* list, uint32_t count)
{
    if (count <= list->capacity) return HAIR_OK;
    uint32_t capacity = count < 8 ? 8 : count + count / 2;
    hair_solid* grown = hair_alloc(host, capacity, sizeof *grown);
    if (!grown) return hair_fail_memory(host, "solids");
    if (list->count) memcpy(grown, list->solid, list->count * sizeof *grown);
    hair_free(host, list->solid);
    list->solid = grown;
    list->capacity = capacity;
    return HAIR_OK;
}

static hair_result reserve_all(const hair_host* host, struct hair_solids* solids, uint32_t count,
                               uint32_t count_before)
{
    hair_result result = reserve(host, &solids->now, count);
    if (!result) result = reserve(host, &solids->before, count > count_before ? count : count_before);
    if (result || count <= solids->capacity) return result;
    uint32_t* pair = hair_alloc(host, solids->now.capacity, sizeof *pair);
    if (!pair) return hair_fail_memory(host, "solids");
    if (solids->now.count) memcpy(pair, solids->pair, solids->now.count * sizeof *pair);
    hair_free(host, solids->pair);
    solids->pair = pair;
    solids->capacity = solids->now.capacity;
    return HAIR_OK;
}

// Replace a list that has room. New collision meshes are held before old ones are released, because
// they may be equal.
static void put(struct hair_solid_list* list, const hair_solid* from, uint32_t count, size_t stride)
{
    for (uint32_t i = 0; i < count; ++i) hair_form_hold(solid_at(from, i, stride).form);
    for (uint32_t i = 0; i < list->count; ++i) hair_form_release(list->solid[i].form);
    for (uint32_t i = 0; i < count; ++i) list->solid[i] = solid_at(from, i, stride);
    list->count = count;
}

static void count_contacts(struct hair_solids* solids)
{
    uint32_t capsules = 0, bodies = 0, forms = 0;
    for (uint32_t i = 0; i < solids->now.count; ++i) {
        const hair_solid* solid = &solids->now.solid[i];
        capsules += solid->shape <= HAIR_SHAPE_CAPSULE;
        bodies += solid->shape <= HAIR_SHAPE_PLANE;
        forms += solid->shape == HAIR_SHAPE_FORM && solid->form;
    }
    solids->contacts = bodies + forms;
    solids->forms = forms;
    solids->capsules = capsules < HAIR_STEP_SOLIDS ? capsules : HAIR_STEP_SOLIDS;
    solids->bodies = bodies < HAIR_STEP_SOLIDS ? bodies : HAIR_STEP_SOLIDS;
}

static hair_result check_list(const hair_host* host, const hair_solid* from, uint32_t count, size_t stride)
{
    if (count > HAIR_MOST_SOLIDS)
        return hair_fail(host, HAIR_ERROR_ARGUMENT, "solid count is %u, not in [0, %u]", count,
                         HAIR_MOST_SOLIDS);
    if (count && !from)
        return hair_fail(host, HAIR_ERROR_ARGUMENT, "solids is NULL but their count is %u", count);
    if (count && (stride < sizeof(hair_solid) || stride > 4096))
        return hair_fail(host, HAIR_ERROR_ARGUMENT, "solid stride is %zu, not in [%zu, 4096]", stride,
                         sizeof(hair_solid));
    for (uint32_t i = 0; i < count; ++i) {
        hair_solid solid = solid_at(from, i, stride);
        hair_result result = check(host, &solid, i);
        if (result) return result;
    }
    return HAIR_OK;
}

// Return whether the list already has these colliders. Setting them again is no change.
static int are_there(const struct hair_solid_list* list, const hair_solid* from, uint32_t count,
                     size_t stride)
{
    int same = list->count == count;
    for (uint32_t i = 0; i < count && same; ++i)
        same = memcmp(&list->solid[i], (const unsigned char*)from + i * stride, sizeof *from) == 0;
    return same;
}

hair_result hair_solids_set(const hair_host* host, struct hair_solids* solids, const hair_solid* from,
                            uint32_t count, size_t stride)
{
    hair_result result = check_list(host, from, count, stride);
    for (uint32_t i = 0; i < count && !result; ++i) {
        hair_solid solid = solid_at(from, i, stride);
        if (solid.shape == HAIR_SHAPE_FORM && !solid.form)
            result = hair_fail(host, HAIR_ERROR_ARGUMENT, "solids[%u].form is NULL", i);
        if (solid.shape != HAIR_SHAPE_FORM && solid.form)
            result = hair_fail(host, HAIR_ERROR_ARGUMENT,
                               "solids[%u].form is not NULL, but its shape is not HAIR_SHAPE_FORM", i);
    }
    if (!result && are_there(&solids->now, from, count, stride)) return HAIR_OK;
    if (!result) result = reserve_all(host, solids, count, solids->before.count);
    if (!result)
        result = hair_pair_solids(host, from, count, stride, solids->before.solid, solids->before.count,
                                  solids->pair);
    if (result) return result;
    put(&solids->now, from, count, stride);
    count_contacts(solids);
    solids->changed = 1;
    return HAIR_OK;
}

hair_result hair_solids_restore(const hair_host* host, struct hair_solids* solids, const hair_solid* now,
                                uint32_t count, const hair_solid* before, uint32_t count_before)
{
    hair_result result = check_list(host, now, count, sizeof *now);
    if (!result) result = check_list(host, before, count_before, sizeof *before);
    if (!result) result = reserve_all(host, solids, count, count_before);
    if (!result) result = hair_pair_solids(host, now, count, sizeof *now, before, count_before, solids->pair);
    if (result) return result;
    put(&solids->now, now, count, sizeof *now);
    put(&solids->before, before, count_before, sizeof *before);
    count_contacts(solids);
    solids->changed = 1;
    return HAIR_OK;
}

void hair_solids_free(const hair_host* host, struct hair_solids* solids)
{
    put(&solids->now, NULL, 0, 0);
    put(&solids->before, NULL, 0, 0);
    hair_free(host, solids->now.solid);
    hair_free(host, solids->before.solid);
    hair_free(host, solids->pair);
    *solids = (struct hair_solids){0};
}

const hair_solid* hair_solids_before(const struct hair_solids* solids, uint32_t i)
{
    const hair_solid* now = &solids->now.solid[i];
    uint32_t k = solids->pair[i];
    if (k >= solids->before.count) return now;
    const hair_solid* before = &solids->before.solid[k];
    return before->shape == now->shape ? before : now;
}

void hair_solids_settle(struct hair_solids* solids)
{
    if (!solids->changed) return;
    solids->changed = 0;
    put(&solids->before, solids->now.solid, solids->now.count, sizeof *solids->now.solid);
    for (uint32_t i = 0; i < solids->now.count; ++i) solids->pair[i] = i;
}

void hair_solids_forget(struct hair_solids* solids)
{
    put(&solids->before, NULL, 0, 0);
    solids->changed = 1;
}
