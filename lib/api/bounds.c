// bounds.c - bounds of the hair of an instance.
#include "lib/api/api.h"
#include "lib/draw/params.h"

// Factor for hair that stretches a little and for followers that stray from their guides.
#define GIVE 1.05f

static void include_sphere(hair_vec3 at, float around, hair_vec3 bounds[2])
{
    bounds[0] = hair_v3(fminf(bounds[0].x, at.x - around), fminf(bounds[0].y, at.y - around),
                        fminf(bounds[0].z, at.z - around));
    bounds[1] = hair_v3(fmaxf(bounds[1].x, at.x + around), fmaxf(bounds[1].y, at.y + around),
                        fmaxf(bounds[1].z, at.z + around));
}

float hair_find_bounds(const hair_groom* groom, hair_vec3 bounds[2])
{
    const hair_groom_info* info = &groom->info;
    bounds[0] = hair_load3(info->lower);
    bounds[1] = hair_load3(info->upper);
    for (uint32_t i = 0; i < info->guide_count; ++i)
        include_sphere(hair_guide_root(groom, i), GIVE * info->length[2], bounds);
    return GIVE * info->length[2];
}

// Include the positions of pins to the world or to the head, and the hair that hangs from them.
static void include_pins(const hair_instance* hair, int world, hair_vec3 bounds[2])
{
    uint32_t count;
    const struct hair_resolved_pin* pins = hair_pins_get(&hair->sim, &count);
    for (uint32_t i = 0; i < count; ++i) {
        const double* at = pins[i].place;
        if (pins[i].world == world)
            include_sphere(hair_v3((float)at[0], (float)at[1], (float)at[2]), hair->longest, bounds);
    }
}

hair_result hair_get_bounds(const hair_instance* hair, float lower[3], float upper[3])
{
    HAIR_TRY(hair_check_instance(hair));
    if (!lower || !upper)
        return hair_fail(&hair->context->host, HAIR_ERROR_ARGUMENT, "%s: lower or upper is NULL",
                         hair->label);
    const struct hair_pose *from = &hair->sim.head_at_last_step, *to = &hair->sim.head;
    hair_quat a = from->rotation, b = to->rotation;
    hair_vec3 box[2] = {hair->bounds[0], hair->bounds[1]};
    float far = 0;
    include_pins(hair, 0, box);
    for (int k = 0; k < 3; ++k) lower[k] = INFINITY, upper[k] = -INFINITY;
    for (int i = 0; i < 16; ++i) { // The corners at both ends of the step.
        const struct hair_pose* head = i < 8 ? from : to;
        hair_vec3 corner = hair_v3(box[i & 1].x, box[i >> 1 & 1].y, box[i >> 2 & 1].z);
        hair_vec3 at = hair_rotate(head->rotation, corner);
        const float turned[] = {at.x, at.y, at.z};
        for (int k = 0; k < 3; ++k) {
            float place = (float)(head->position[k] + (double)turned[k]);
            lower[k] = fminf(lower[k], place);
            upper[k] = fmaxf(upper[k], place);
        }
        far = fmaxf(far, hair_length(corner));
    }
    for (int k = 0; k < 3; ++k) HAIR_ASSERT(lower[k] <= upper[k]);
    // Between both ends a corner bulges out of its chord by r (1 - cos(half the angle)).
    float bulge = far * (1 - fminf(fabsf(a.x * b.x + a.y * b.y + a.z * b.z + a.w * b.w), 1));
    hair_vec3 whole[2] = {hair_sub(hair_load3(lower), hair_v3(bulge, bulge, bulge)),
                          hair_add(hair_load3(upper), hair_v3(bulge, bulge, bulge))};
    include_pins(hair, 1, whole);
    hair_store3(lower, whole[0]);
    hair_store3(upper, whole[1]);
    return HAIR_OK;
}
