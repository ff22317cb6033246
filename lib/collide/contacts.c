// contacts.c - colliders between two poses of the head, for guides: all of them or the nearest
// ones.
#include "lib/collide/collision_mesh.h"
#include "lib/collide/collider.h"

#define EVERYWHERE 1e7f // Radius of the sphere around a half-space, m.

static hair_vec3 from_head(const hair_collider* collider, const struct hair_pose* head)
{
    return (hair_vec3){(float)((double)collider->position[0] - head->position[0]),
                       (float)((double)collider->position[1] - head->position[1]),
                       (float)((double)collider->position[2] - head->position[2])};
}

static hair_quat turn_of(const hair_collider* collider)
{
    return hair_quat_normalize((hair_quat){collider->rotation[0], collider->rotation[1],
                                           collider->rotation[2], collider->rotation[3]});
}

// Compute the centre of a collider in its own axes, and half its sides.
void hair_collider_extent(const hair_collider* collider, hair_vec3* middle, hair_vec3* half)
{
    const float* size = collider->size;
    *middle = hair_v3(0, 0, 0);
    switch (collider->shape) {
    case HAIR_SHAPE_CAPSULE: *half = hair_v3(size[0], size[0] + size[1], size[0]); return;
    case HAIR_SHAPE_BOX:
    case HAIR_SHAPE_ELLIPSOID: *half = hair_load3(size); return;
    case HAIR_SHAPE_CYLINDER:
    case HAIR_SHAPE_CONE: *half = hair_v3(size[0], size[1], size[0]); return;
    case HAIR_SHAPE_PLANE: *half = hair_v3(EVERYWHERE, EVERYWHERE, EVERYWHERE); return;
    case HAIR_SHAPE_MESH: break;
    default: *half = hair_v3(size[0], size[0], size[0]); return;
    }
    HAIR_ASSERT(collider->mesh);
    hair_vec3 lower = hair_load3(collider->mesh->info.lower), upper = hair_load3(collider->mesh->info.upper);
    *middle = hair_scale(hair_lerp(lower, upper, 0.5f), collider->scale);
    *half = hair_scale(hair_sub(upper, lower), 0.5f * collider->scale);
}

// Return the radius of a sphere or capsule, or of a sphere around another collider, without
// rounding.
static float radius_around(const hair_collider* collider)
{
    const float* size = collider->size;
    hair_vec3 middle, half;
    switch (collider->shape) {
    case HAIR_SHAPE_MESH: hair_collider_extent(collider, &middle, &half); return hair_length(half);
    case HAIR_SHAPE_BOX: return hair_length(hair_load3(size));
    case HAIR_SHAPE_CYLINDER:
    case HAIR_SHAPE_CONE: return hypotf(size[0], size[1]);
    case HAIR_SHAPE_PLANE: return EVERYWHERE;
    case HAIR_SHAPE_ELLIPSOID: return fmaxf(size[0], fmaxf(size[1], size[2]));
    default: return size[0];
    }
}

// Compute the axis and radius of a sphere or capsule, or of a sphere around another collider.
static void compute_axis(const hair_collider* collider, const struct hair_pose* head, hair_vec4 ends[2])
{
    hair_vec3 center = from_head(collider, head), middle, sides;
    float half = collider->shape == HAIR_SHAPE_CAPSULE ? collider->size[1] : 0;
    float radius = radius_around(collider) + collider->rounding;
    hair_vec3 axis = hair_rotate(turn_of(collider), hair_v3(0, half, 0));
    if (collider->shape == HAIR_SHAPE_MESH) {
        hair_collider_extent(collider, &middle, &sides);
        center = hair_add(center, hair_rotate(turn_of(collider), middle));
    }
    hair_vec3 a = hair_sub(center, axis), b = hair_add(center, axis);
    ends[0] = (hair_vec4){a.x, a.y, a.z, radius};
    ends[1] = (hair_vec4){b.x, b.y, b.z, radius};
}

// Return the rotation from one pose of a collider to the next, except the part that a capsule's
// ends show.
static hair_vec4 spin_between(const hair_collider* from, const hair_collider* to)
{
    hair_quat a = turn_of(from), b = turn_of(to);
    hair_quat turn = hair_quat_multiply(b, hair_quat_conjugate(a));
    // The shorter rotation.
    hair_vec3 v = hair_scale(hair_v3(turn.x, turn.y, turn.z), turn.w < 0 ? -1.0f : 1.0f);
    float sine = hair_length(v);
    float angle = 2 * atan2f(sine, fabsf(turn.w));
    hair_vec3 spin = sine > 1e-9f ? hair_scale(v, angle / sine) : hair_v3(0, 0, 0);
    if (to->shape == HAIR_SHAPE_CAPSULE) {
        hair_vec3 axis = hair_rotate(b, hair_v3(0, 1, 0));
        spin = hair_scale(axis, hair_dot(spin, axis));
    }
    return (hair_vec4){spin.x, spin.y, spin.z, 0};
}

static float way_of(hair_vec4 from, hair_vec4 to)
{
    return hair_length(hair_v3(to.x - from.x, to.y - from.y, to.z - from.z));
}

static struct hair_capsule capsule_of(const hair_collider* before, const hair_collider* now,
                                      const struct hair_pose* head_before, const struct hair_pose* head_now)
{
    struct hair_capsule around = {.spin = spin_between(before, now)};
    compute_axis(before, head_before, around.start);
    compute_axis(now, head_now, around.end);
    around.spin.w = fmaxf(way_of(around.start[0], around.end[0]), way_of(around.start[1], around.end[1]));
    return around;
}

// Return the distance from the head to the surface.
static float distance_of(const hair_collider* collider, const struct hair_pose* head)
{
    hair_vec4 end[2];
    compute_axis(collider, head, end);
    hair_vec3 a = {end[0].x, end[0].y, end[0].z}, b = {end[1].x, end[1].y, end[1].z}, axis = hair_sub(b, a);
    float t = -hair_dot(a, axis) / fmaxf(hair_dot(axis, axis), 1e-20f);
    return hair_length(hair_add(a, hair_scale(axis, fminf(fmaxf(t, 0), 1)))) - end[0].w;
}

// Choose the nearest colliders, spheres and capsules or all but collision meshes, preserving order.
// At equal distances the first one stays.
static uint32_t choose_nearest(const struct hair_colliders* colliders, const struct hair_pose* head,
                               bool only_capsules, uint32_t chosen[HAIR_STEP_COLLIDERS])
{
    float distance[HAIR_STEP_COLLIDERS];
    uint32_t count = 0, farthest = 0;
    for (uint32_t i = 0; i < colliders->current.count; ++i) {
        const hair_collider* collider = &colliders->current.collider[i];
        if (only_capsules ? collider->shape > HAIR_SHAPE_CAPSULE : collider->shape == HAIR_SHAPE_MESH)
            continue;
        float far = distance_of(collider, head);
        if (count == HAIR_STEP_COLLIDERS) {
            if (far >= distance[farthest]) continue;
            for (uint32_t k = farthest; k + 1 < count; ++k)
                chosen[k] = chosen[k + 1], distance[k] = distance[k + 1];
            --count;
        }
        HAIR_ASSERT(count < HAIR_STEP_COLLIDERS);
        chosen[count] = i, distance[count++] = far;
        farthest = 0;
        for (uint32_t k = 1; k < count && count == HAIR_STEP_COLLIDERS; ++k)
            if (distance[k] >= distance[farthest]) farthest = k;
    }
    return count;
}

static struct hair_contact_body body_of(const hair_collider* before, const hair_collider* now,
                                        const struct hair_pose* head_before, const struct hair_pose* head_now)
{
    hair_vec3 a = from_head(before, head_before), b = from_head(now, head_now);
    hair_quat p = turn_of(before), q = turn_of(now);
    float side = p.x * q.x + p.y * q.y + p.z * q.z + p.w * q.w < 0 ? -1.0f : 1.0f;
    return (struct hair_contact_body){
        .position = {{a.x, a.y, a.z, now->rounding}, {b.x, b.y, b.z, now->friction}},
        .rotation = {{side * p.x, side * p.y, side * p.z, side * p.w}, {q.x, q.y, q.z, q.w}},
        .size = {now->size[0], now->size[1], now->size[2], (float)now->shape}};
}

static uint32_t fill_contacts(const struct hair_colliders* colliders, const struct hair_pose* head_before,
                              const struct hair_pose* head_now, bool only_capsules,
                              struct hair_capsule* around, struct hair_contact_body* out)
{
    uint32_t chosen[HAIR_STEP_COLLIDERS], count = choose_nearest(colliders, head_now, only_capsules, chosen);
    for (uint32_t i = 0; i < count; ++i) {
        const hair_collider *now = &colliders->current.collider[chosen[i]],
                            *before = hair_colliders_previous(colliders, chosen[i]);
        around[i] = capsule_of(before, now, head_before, head_now);
        if (out) out[i] = body_of(before, now, head_before, head_now);
    }
    return count;
}

uint32_t hair_colliders_capsules(const struct hair_colliders* colliders, const struct hair_pose* head_before,
                                 const struct hair_pose* head_now,
                                 struct hair_capsule out[HAIR_STEP_COLLIDERS])
{
    return fill_contacts(colliders, head_before, head_now, true, out, NULL);
}

uint32_t hair_colliders_bodies(const struct hair_colliders* colliders, const struct hair_pose* head_before,
                               const struct hair_pose* head_now,
                               struct hair_capsule around[HAIR_STEP_COLLIDERS],
                               struct hair_contact_body out[HAIR_STEP_COLLIDERS])
{
    return fill_contacts(colliders, head_before, head_now, false, around, out);
}

uint32_t hair_colliders_nearest(const struct hair_colliders* colliders, const struct hair_pose* head_now,
                                uint32_t index[HAIR_STEP_COLLIDERS])
{
    return choose_nearest(colliders, head_now, false, index);
}

struct hair_contact hair_colliders_contact(const struct hair_colliders* colliders, uint32_t i,
                                           const struct hair_pose* head_before,
                                           const struct hair_pose* head_now)
{
    HAIR_ASSERT(i < colliders->current.count);
    const hair_collider* now = &colliders->current.collider[i];
    hair_collider before = *hair_colliders_previous(colliders, i);
    before.mesh = now->mesh, before.scale = now->scale; // The collision mesh may have been another.
    struct hair_contact contact = {.around = capsule_of(&before, now, head_before, head_now),
                                   .body = body_of(&before, now, head_before, head_now)};
    if (now->shape != HAIR_SHAPE_MESH) return contact;
    const hair_collision_mesh* mesh = now->mesh;
    HAIR_ASSERT(mesh && (mesh->distance || mesh->home));
    float deforms = hair_colliders_has_deformed(colliders, i) ? 1 : 0;
    contact.body.size = (hair_vec4){now->scale, deforms, 0, HAIR_SHAPE_MESH};
    contact.mesh = (struct hair_contact_mesh){
        .grid = {mesh->origin[0], mesh->origin[1], mesh->origin[2], mesh->voxel},
        .nodes_x = mesh->size[0],
        .nodes_y = mesh->size[1],
        .nodes_z = mesh->size[2],
    };
    return contact;
}
