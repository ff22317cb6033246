// collider.c - lists of colliders: checked, stored and counted.
#include "lib/collide/collider.h"

#include <string.h>

#include "lib/base/schema.h"
#include "lib/collide/collision_mesh.h"
#include "lib/collide/match.h"

// Return how many components of `size` a shape uses.
static int sizes_of(hair_shape shape)
{
    switch (shape) {
    case HAIR_SHAPE_SPHERE: return 1;
    case HAIR_SHAPE_CAPSULE:
    case HAIR_SHAPE_CYLINDER:
    case HAIR_SHAPE_CONE: return 2;
    case HAIR_SHAPE_BOX:
    case HAIR_SHAPE_ELLIPSOID: return 3;
    default: return 0;
    }
}

// Check that the shape has an extent. The table of members has checked the ranges.
static hair_result check_size(const hair_host* host, const hair_collider* collider, uint32_t i)
{
    int sizes = sizes_of(collider->shape);
    for (int k = 0; k < sizes; ++k) {
        int may_be_0 = collider->rounding > 0 || (collider->shape == HAIR_SHAPE_CAPSULE && k == 1);
        if (collider->size[k] == 0 && !may_be_0)
            return hair_fail(host, HAIR_ERROR_ARGUMENT, "colliders[%u].size[%d] is 0, not in (0, 1e6]", i, k);
    }
    return HAIR_OK;
}

static hair_result check_rotation(const hair_host* host, const hair_collider* collider, uint32_t i)
{
    float norm = 0;
    for (int k = 0; k < 4; ++k) norm += collider->rotation[k] * collider->rotation[k];
    if (fabsf(norm - 1) <= 1e-3f) return HAIR_OK;
    return hair_fail(host, HAIR_ERROR_ARGUMENT, "colliders[%u].rotation has norm %g, not 1", i,
                     (double)sqrtf(norm));
}

static hair_result check_collider(const hair_host* host, const hair_collider* collider, uint32_t i)
{
    hair_collider used = *collider;
    for (int k = sizes_of(used.shape); k < 3; ++k) used.size[k] = 0; // The shape ignores them.
    HAIR_TRY(hair_schema_check_element(host, "colliders", i, &used, hair_schema_of_hair_collider()));
    HAIR_TRY(check_rotation(host, collider, i));
    return check_size(host, collider, i);
}

static hair_collider collider_at(const hair_collider* from, uint32_t i, size_t stride)
{
    hair_collider collider;
    memcpy(&collider, (const unsigned char*)from + i * stride, sizeof collider);
    return collider;
}

// Lists -------------------------------------------------------------------------------------------

static hair_result reserve(const hair_host* host, struct hair_collider_list* list, uint32_t count)
{
    HAIR_ASSERT(list->count <= list->capacity);
    if (count <= list->capacity) return HAIR_OK;
    void* grown = hair_grow(host, list->collider, sizeof *list->collider, &list->capacity,
                            count < 8 ? 8 : count + count / 2);
    if (!grown) return hair_fail_memory(host, "colliders");
    list->collider = grown;
    return HAIR_OK;
}

static hair_result reserve_all(const hair_host* host, struct hair_colliders* colliders, uint32_t count,
                               uint32_t count_before)
{
    HAIR_TRY(reserve(host, &colliders->current, count));
    HAIR_TRY(reserve(host, &colliders->previous, count > count_before ? count : count_before));
    if (count <= colliders->capacity) return HAIR_OK;
    // The second half is for the generations.
    uint32_t* pair = hair_alloc(host, 2 * (size_t)colliders->current.capacity, sizeof *pair);
    if (!pair) return hair_fail_memory(host, "colliders");
    uint32_t* generation = pair + colliders->current.capacity;
    if (colliders->current.count) memcpy(pair, colliders->match, colliders->current.count * sizeof *pair);
    if (colliders->generations)
        memcpy(generation, colliders->generation, colliders->generations * sizeof *generation);
    hair_free(host, colliders->match);
    colliders->match = pair;
    colliders->generation = generation;
    colliders->capacity = colliders->current.capacity;
    return HAIR_OK;
}

// Replace a list that has room. New collision meshes are held before old ones are released, because
// they may be equal.
static void append_colliders(struct hair_collider_list* list, const hair_collider* from, uint32_t count,
                             size_t stride)
{
    HAIR_ASSERT(count <= list->capacity);
    for (uint32_t i = 0; i < count; ++i) hair_collision_mesh_hold(collider_at(from, i, stride).mesh);
    for (uint32_t i = 0; i < list->count; ++i) hair_collision_mesh_release(list->collider[i].mesh);
    for (uint32_t i = 0; i < count; ++i) list->collider[i] = collider_at(from, i, stride);
    list->count = count;
}

static void count_contacts(struct hair_colliders* colliders)
{
    uint32_t capsules = 0, bodies = 0, meshes = 0, deforming = 0;
    for (uint32_t i = 0; i < colliders->current.count; ++i) {
        const hair_collider* collider = &colliders->current.collider[i];
        capsules += collider->shape <= HAIR_SHAPE_CAPSULE;
        bodies += collider->shape != HAIR_SHAPE_MESH;
        meshes += collider->shape == HAIR_SHAPE_MESH && collider->mesh;
        deforming += collider->shape == HAIR_SHAPE_MESH && collider->mesh && collider->mesh->home;
    }
    colliders->contacts = bodies + meshes;
    HAIR_ASSERT(capsules <= bodies && colliders->contacts <= colliders->current.count);
    colliders->meshes = meshes;
    colliders->deforming = deforming;
    colliders->capsules = capsules < HAIR_STEP_COLLIDERS ? capsules : HAIR_STEP_COLLIDERS;
    colliders->bodies = bodies < HAIR_STEP_COLLIDERS ? bodies : HAIR_STEP_COLLIDERS;
}

// Note the shapes of bodies at the last step.
static void note_generations(struct hair_colliders* colliders)
{
    const struct hair_collider_list* list = &colliders->previous;
    uint32_t count = list->count < colliders->capacity ? list->count : colliders->capacity;
    for (uint32_t i = 0; i < count; ++i)
        colliders->generation[i] = list->collider[i].mesh ? list->collider[i].mesh->generation : 0;
    colliders->generations = count;
}

static hair_result check_list(const hair_host* host, const hair_collider* from, uint32_t count, size_t stride)
{
    if (count > HAIR_MAX_COLLIDERS)
        return hair_fail(host, HAIR_ERROR_ARGUMENT, "collider count is %u, not in [0, %u]", count,
                         HAIR_MAX_COLLIDERS);
    if (count && !from)
        return hair_fail(host, HAIR_ERROR_ARGUMENT, "colliders is NULL but their count is %u", count);
    if (count && (stride < sizeof(hair_collider) || stride > 4096))
        return hair_fail(host, HAIR_ERROR_ARGUMENT, "collider stride is %zu, not in [%zu, 4096]", stride,
                         sizeof(hair_collider));
    for (uint32_t i = 0; i < count; ++i) {
        hair_collider collider = collider_at(from, i, stride);
        HAIR_TRY(check_collider(host, &collider, i));
    }
    return HAIR_OK;
}

// Return whether the list already has these colliders. Setting them again is no change.
static int are_there(const struct hair_collider_list* list, const hair_collider* from, uint32_t count,
                     size_t stride)
{
    int same = list->count == count;
    for (uint32_t i = 0; i < count && same; ++i)
        same = memcmp(&list->collider[i], (const unsigned char*)from + i * stride, sizeof *from) == 0;
    return same;
}

static hair_result check_meshes(const hair_host* host, const struct hair_colliders* colliders,
                                const hair_collider* from, uint32_t count, size_t stride)
{
    for (uint32_t i = 0; i < count; ++i) {
        hair_collider collider = collider_at(from, i, stride);
        if (collider.shape == HAIR_SHAPE_MESH && !collider.mesh)
            return hair_fail(host, HAIR_ERROR_ARGUMENT, "colliders[%u].mesh is NULL", i);
        if (collider.shape != HAIR_SHAPE_MESH && collider.mesh)
            return hair_fail(host, HAIR_ERROR_ARGUMENT,
                             "colliders[%u].mesh is not NULL, but its shape is not HAIR_SHAPE_MESH", i);
        if (collider.mesh && collider.mesh->home && collider.mesh->home != colliders->home)
            return hair_fail(host, HAIR_ERROR_ARGUMENT,
                             "colliders[%u].mesh is that of a hair_body of another context", i);
    }
    return HAIR_OK;
}

// Set colliders that are checked.
static hair_result set_current(const hair_host* host, struct hair_colliders* colliders,
                               const hair_collider* from, uint32_t count, size_t stride)
{
    if (are_there(&colliders->current, from, count, stride)) return HAIR_OK;
    HAIR_TRY(reserve_all(host, colliders, count, colliders->previous.count));
    HAIR_TRY(hair_match_colliders(host, from, count, stride, colliders->previous.collider,
                                  colliders->previous.count, colliders->match));
    append_colliders(&colliders->current, from, count, stride);
    count_contacts(colliders);
    colliders->changed = 1;
    return HAIR_OK;
}

hair_result hair_colliders_set(const hair_host* host, struct hair_colliders* colliders,
                               const hair_collider* from, uint32_t count, size_t stride)
{
    HAIR_TRY(check_list(host, from, count, stride));
    HAIR_TRY(check_meshes(host, colliders, from, count, stride));
    return set_current(host, colliders, from, count, stride);
}

hair_result hair_colliders_copy(const hair_host* host, struct hair_colliders* colliders,
                                const struct hair_colliders* from)
{
    const struct hair_collider_list* list = &from->current;
    return set_current(host, colliders, list->collider, list->count, sizeof *list->collider);
}

hair_result hair_colliders_restore(const hair_host* host, struct hair_colliders* colliders,
                                   const hair_collider* now, uint32_t count, const hair_collider* before,
                                   uint32_t count_before)
{
    HAIR_TRY(check_list(host, now, count, sizeof *now));
    HAIR_TRY(check_list(host, before, count_before, sizeof *before));
    HAIR_TRY(reserve_all(host, colliders, count, count_before));
    HAIR_TRY(hair_match_colliders(host, now, count, sizeof *now, before, count_before, colliders->match));
    append_colliders(&colliders->current, now, count, sizeof *now);
    append_colliders(&colliders->previous, before, count_before, sizeof *before);
    count_contacts(colliders);
    note_generations(colliders);
    colliders->changed = 1;
    return HAIR_OK;
}

void hair_colliders_free(const hair_host* host, struct hair_colliders* colliders)
{
    append_colliders(&colliders->current, NULL, 0, 0);
    append_colliders(&colliders->previous, NULL, 0, 0);
    hair_free(host, colliders->current.collider);
    hair_free(host, colliders->previous.collider);
    hair_free(host, colliders->match);
    *colliders = (struct hair_colliders){0};
}

const hair_collider* hair_colliders_previous(const struct hair_colliders* colliders, uint32_t i)
{
    HAIR_ASSERT(i < colliders->current.count);
    const hair_collider* now = &colliders->current.collider[i];
    uint32_t k = colliders->match[i];
    if (k >= colliders->previous.count) return now;
    const hair_collider* before = &colliders->previous.collider[k];
    return before->shape == now->shape ? before : now;
}

bool hair_colliders_has_deformed(const struct hair_colliders* colliders, uint32_t i)
{
    HAIR_ASSERT(i < colliders->current.count);
    const hair_collision_mesh* mesh = colliders->current.collider[i].mesh;
    uint32_t k = colliders->match[i];
    if (!mesh || !mesh->home || k >= colliders->generations) return false;
    return colliders->previous.collider[k].mesh == mesh && colliders->generation[k] != mesh->generation;
}

bool hair_colliders_have_deformed(const struct hair_colliders* colliders)
{
    if (!colliders->deforming) return false;
    for (uint32_t i = 0; i < colliders->current.count; ++i)
        if (hair_colliders_has_deformed(colliders, i)) return true;
    return false;
}

void hair_colliders_end_step(struct hair_colliders* colliders)
{
    if (!colliders->changed) {
        if (colliders->deforming) note_generations(colliders);
        return;
    }
    colliders->changed = 0;
    HAIR_ASSERT(colliders->current.count <= colliders->capacity);
    append_colliders(&colliders->previous, colliders->current.collider, colliders->current.count,
                     sizeof *colliders->current.collider);
    for (uint32_t i = 0; i < colliders->current.count; ++i) colliders->match[i] = i;
    note_generations(colliders);
}

void hair_colliders_reset(struct hair_colliders* colliders)
{
    append_colliders(&colliders->previous, NULL, 0, 0);
    colliders->generations = 0;
    colliders->changed = 1;
}
