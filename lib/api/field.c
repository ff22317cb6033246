// field.c - the public call by which the application reads the field of an instance.
#include "lib/api/api.h"

#include <math.h>

#define MAX_DOUBLINGS 3 // A field of 256 voxels then has 32.
#define MAX_PIXELS 2 // Maximum size of a doubled voxel.

// Write the transform from the world to the box's [0, 1]^3: p becomes (conj(q) (p - head) - lower)
// * inverse. It is computed in double, because far from the origin the head's position and its
// product nearly cancel.
static void write_transform(const struct hair_field_box* box, const struct hair_pose* head, float out[16])
{
    hair_quat back = hair_quat_conjugate(head->rotation);
    hair_vec3 x = hair_rotate(back, hair_v3(1, 0, 0)), y = hair_rotate(back, hair_v3(0, 1, 0)),
              z = hair_rotate(back, hair_v3(0, 0, 1));
    const float m[9] = {x.x, x.y, x.z, y.x, y.y, y.z, z.x, z.y, z.z};
    const float low[] = {box->lower.x, box->lower.y, box->lower.z};
    for (int row = 0; row < 3; ++row) {
        HAIR_ASSERT(box->voxel > 0 && box->bricks[row] > 0);
        double scale = 1 / ((double)box->voxel * HAIR_BRICK * box->bricks[row]), at = (double)low[row];
        for (int k = 0; k < 3; ++k) {
            out[4 * k + row] = (float)(scale * (double)m[3 * k + row]);
            at += (double)m[3 * k + row] * head->position[k];
        }
        out[12 + row] = (float)(-scale * at);
    }
    for (int k = 0; k < 4; ++k) out[4 * k + 3] = k == 3;
}

// Change the number of times that the size of voxels is doubled. What depends on the field is
// outdated then.
static void set_doublings(hair_instance* hair, uint32_t doublings)
{
    struct hair_field_detail* detail = &hair->field_detail;
    detail->spare_views = 0;
    if (doublings == detail->doublings) return;
    hair_field_set_voxel(&hair->field, hair->groom, ldexpf(detail->voxel, (int)doublings));
    detail->doublings = doublings;
    hair_geometry_set_blockers(&hair->geometry, NULL);
    hair_geometry_invalidate(&hair->geometry);
}

// Return how often voxels can be doubled in the view that is drawn next. A view so far away that it
// shows no push-out needs the field only for the light that colliders block.
static uint32_t find_doublings(const hair_instance* hair)
{
    float pixels = hair->renderer.pixels_per_metre * hair->field_detail.voxel;
    uint32_t doublings = 0;
    // Motion must not depend on views.
    if (!(pixels > 0) || hair->geometry.push_out_weight > 0 || hair_wind_coupling_is_on(&hair->sim)) return 0;
    while (doublings < MAX_DOUBLINGS && 2 * pixels <= MAX_PIXELS) pixels *= 2, ++doublings;
    return doublings;
}

void hair_choose_field_detail(hair_instance* hair)
{
    struct hair_field_detail* detail = &hair->field_detail;
    uint32_t wanted = find_doublings(hair);
    bool is_coarser = wanted > detail->doublings;
    if (is_coarser && hair->field.distance && !hair_gl_count_spare(&detail->spare_views, true)) return;
    set_doublings(hair, wanted);
}

// Finish an update that ended with `result`.
static hair_result finish_update(hair_instance* hair, hair_result result)
{
    if (result) {
        // A failure clears the field, so hits of strands and light that it blocked are outdated.
        hair_geometry_set_blockers(&hair->geometry, NULL);
        hair_geometry_invalidate(&hair->geometry);
    }
    return result;
}

hair_result hair_update_field_for_step(hair_instance* hair, const struct hair_pose* head)
{
    const struct hair_collider_list* colliders = hair_sim_colliders(&hair->sim);
    set_doublings(hair, 0);
    hair_field_want_numbers(&hair->field);
    return finish_update(
        hair, hair_field_update_for_step(&hair->field, colliders->collider, colliders->count, head));
}

hair_result hair_update_field(hair_instance* hair)
{
    set_doublings(hair, 0);
    return hair_update_view_field(hair);
}

hair_result hair_update_view_field(hair_instance* hair)
{
    const struct hair_collider_list* colliders = hair_sim_colliders(&hair->sim);
    return finish_update(hair, hair_field_update(&hair->field, colliders->collider, colliders->count,
                                                 &hair->sim.head_at_last_step));
}

hair_result hair_get_field(hair_instance* hair, hair_field_info* out)
{
    HAIR_TRY(hair_check_instance(hair));
    hair_context* context = hair->context;
    hair_field_info own = hair_field_info_default();
    HAIR_TRY(HAIR_COPY_OUT(&context->host, hair_field_info, &own, out));
    HAIR_TRY(hair_check_current(context));
    hair_enter(hair);
    hair_field_want_numbers(&hair->field);
    HAIR_TRY(hair_leave(context, hair_update_field(hair)));

    const struct hair_field_box* box = &hair->field.box;
    if (hair_field_is_near(&hair->field)) {
        own.distance_texture = hair->field.distance;
        own.collider_texture = hair->field.number;
    }
    for (int i = 0; i < 3; ++i) own.size[i] = HAIR_BRICK * box->bricks[i];
    own.voxel = box->voxel;
    own.far = box->far;
    write_transform(box, &hair->sim.head_at_last_step, own.transform);
    return HAIR_COPY_OUT(&context->host, hair_field_info, &own, out);
}
