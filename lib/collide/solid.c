// solid.c - spheres and capsules between two poses of the head.
#include "lib/collide/solid.h"

#include <string.h>

_Static_assert(HAIR_MAX_SOLIDS == HAIR_STEP_SOLIDS, "hair.h and shared.h promise the same number of solids");

static hair_result check(const hair_host* host, const hair_solid* solid, uint32_t i)
{
    if ((uint32_t)solid->shape > HAIR_SHAPE_CAPSULE)
        return hair_fail(host, HAIR_ERROR_ARGUMENT, "solids[%u].shape is %d, not in [0, %d]", i,
                         (int)solid->shape, HAIR_SHAPE_CAPSULE);
    for (int k = 0; k < 3; ++k)
        if (!(fabsf(solid->position[k]) <= 1e9f))
            return hair_fail(host, HAIR_ERROR_ARGUMENT, "solids[%u].position[%d] is %g, not in [-1e9, 1e9]",
                             i, k, (double)solid->position[k]);
    float norm = 0;
    for (int k = 0; k < 4; ++k) norm += solid->rotation[k] * solid->rotation[k];
    if (!(fabsf(norm - 1) <= 1e-3f))
        return hair_fail(host, HAIR_ERROR_ARGUMENT, "solids[%u].rotation has norm %g, not 1", i,
                         (double)sqrtf(norm));
    if (!(solid->size[0] > 0 && solid->size[0] <= 1e6f))
        return hair_fail(host, HAIR_ERROR_ARGUMENT, "solids[%u].size[0] is %g, not in (0, 1e6]", i,
                         (double)solid->size[0]);
    if (solid->shape == HAIR_SHAPE_CAPSULE && !(solid->size[1] >= 0 && solid->size[1] <= 1e6f))
        return hair_fail(host, HAIR_ERROR_ARGUMENT, "solids[%u].size[1] is %g, not in [0, 1e6]", i,
                         (double)solid->size[1]);
    return HAIR_OK;
}

hair_result hair_solids_set(const hair_host* host, struct hair_solids* solids, const hair_solid* from,
                            uint32_t count, size_t stride)
{
    if (count > HAIR_MAX_SOLIDS)
        return hair_fail(host, HAIR_ERROR_ARGUMENT, "solid count is %u, not in [0, %d]", count,
                         HAIR_MAX_SOLIDS);
    if (count && !from)
        return hair_fail(host, HAIR_ERROR_ARGUMENT, "solids is NULL but their count is %u", count);
    if (count && (stride < sizeof(hair_solid) || stride > 4096))
        return hair_fail(host, HAIR_ERROR_ARGUMENT, "solid stride is %zu, not in [%zu, 4096]", stride,
                         sizeof(hair_solid));
    hair_solid taken[HAIR_MAX_SOLIDS];
    for (uint32_t i = 0; i < count; ++i) {
        memcpy(&taken[i], (const unsigned char*)from + i * stride, sizeof taken[i]);
        hair_result result = check(host, &taken[i], i);
        if (result) return result;
    }
    if (count) memcpy(solids->now, taken, count * sizeof *taken);
    solids->count = count;
    return HAIR_OK;
}

static void place(const hair_solid* solid, const struct hair_pose* head, hair_vec4 ends[2])
{
    hair_vec3 center = {(float)((double)solid->position[0] - head->position[0]),
                        (float)((double)solid->position[1] - head->position[1]),
                        (float)((double)solid->position[2] - head->position[2])};
    hair_quat q      = {solid->rotation[0], solid->rotation[1], solid->rotation[2], solid->rotation[3]};
    float     half   = solid->shape == HAIR_SHAPE_CAPSULE ? solid->size[1] : 0;
    hair_vec3 axis   = hair_rotate(hair_quat_normalize(q), hair_v3(0, half, 0));
    hair_vec3 a = hair_sub(center, axis), b = hair_add(center, axis);
    ends[0] = (hair_vec4){a.x, a.y, a.z, solid->size[0]};
    ends[1] = (hair_vec4){b.x, b.y, b.z, solid->size[0]};
}

// The turn from one pose of a solid to the next, as far as its capsule's ends do not show it.
static hair_vec4 spin_between(const hair_solid* from, const hair_solid* to)
{
    hair_quat a = hair_quat_normalize(
        (hair_quat){from->rotation[0], from->rotation[1], from->rotation[2], from->rotation[3]});
    hair_quat b =
        hair_quat_normalize((hair_quat){to->rotation[0], to->rotation[1], to->rotation[2], to->rotation[3]});
    hair_quat turn = hair_quat_multiply(b, hair_quat_conjugate(a));
    hair_vec3 v    = hair_scale(hair_v3(turn.x, turn.y, turn.z), turn.w < 0 ? -1.0f : 1.0f); // The short way.
    float     sine = hair_length(v);
    float     angle = 2 * atan2f(sine, fabsf(turn.w));
    hair_vec3 spin  = sine > 1e-9f ? hair_scale(v, angle / sine) : hair_v3(0, 0, 0);
    if (to->shape == HAIR_SHAPE_CAPSULE) {
        hair_vec3 axis = hair_rotate(b, hair_v3(0, 1, 0));
        spin           = hair_scale(axis, hair_dot(spin, axis));
    }
    return (hair_vec4){spin.x, spin.y, spin.z, 0};
}

uint32_t hair_solids_capsules(const struct hair_solids* solids, const struct hair_pose* head_before,
                              const struct hair_pose* head_now, struct hair_capsule out[HAIR_MAX_SOLIDS])
{
    for (uint32_t i = 0; i < solids->count; ++i) {
        // Another shape than before is another solid: it starts where it is.
        const hair_solid* now  = &solids->now[i];
        int               same = i < solids->count_before && solids->before[i].shape == now->shape;
        place(same ? &solids->before[i] : now, head_before, out[i].start);
        place(now, head_now, out[i].end);
        out[i].spin = spin_between(same ? &solids->before[i] : now, now);
    }
    return solids->count;
}

void hair_solids_settle(struct hair_solids* solids)
{
    memcpy(solids->before, solids->now, sizeof solids->now);
    solids->count_before = solids->count;
}
