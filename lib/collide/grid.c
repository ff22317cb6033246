// grid.c - the contacts that guides can have in a step, and bounding boxes of their motion.
#include "lib/collide/grid.h"

// Iterations: BODY_STEPS of glsl/sim/shape_contact.glsl, plus the start and the end.
#define WALK 12

uint32_t hair_entry_rounds(uint32_t member)
{
    return member & HAIR_ENTRY_WALKED ? WALK : 0;
}

// Room --------------------------------------------------------------------------------------------

static hair_result reserve_grid(const hair_host* host, struct hair_collider_grid* grid, uint32_t count)
{
    if (count <= grid->room) return HAIR_OK;
    uint32_t room = count + count / 2;
    hair_free(host, grid->contact);
    hair_free(host, grid->collider);
    hair_free(host, grid->bounds);
    hair_free(host, grid->member);
    grid->contact = hair_alloc(host, room, sizeof *grid->contact);
    grid->collider = hair_alloc(host, room, sizeof *grid->collider);
    grid->bounds = hair_alloc(host, room, sizeof *grid->bounds);
    grid->member = hair_alloc(host, room, sizeof *grid->member);
    int whole = grid->contact && grid->collider && grid->bounds && grid->member;
    grid->room = whole ? room : 0;
    return whole ? HAIR_OK : hair_fail_memory(host, "what guides collide with");
}

void hair_collider_grid_free(const hair_host* host, struct hair_collider_grid* grid)
{
    hair_free(host, grid->contact);
    hair_free(host, grid->collider);
    hair_free(host, grid->bounds);
    hair_free(host, grid->member);
    hair_free(host, grid->entry);
    hair_free(host, grid->last);
    *grid = (struct hair_collider_grid){0};
}

// Contacts ----------------------------------------------------------------------------------------

// Return the bounding box at the start or the end of the step, without rounding.
static struct hair_cell_bounds box_around(const struct hair_contact* contact, const hair_collider* collider,
                                          int end)
{
    const hair_vec4 *at = &contact->body.position[end], *q = &contact->body.rotation[end];
    hair_quat turn = {q->x, q->y, q->z, q->w};
    hair_vec3 middle, half;
    if (collider->shape <= HAIR_SHAPE_CAPSULE) {
        const hair_vec4* ends = end ? contact->around.end : contact->around.start;
        return (struct hair_cell_bounds){
            {fminf(ends[0].x, ends[1].x) - collider->size[0], fminf(ends[0].y, ends[1].y) - collider->size[0],
             fminf(ends[0].z, ends[1].z) - collider->size[0]},
            {fmaxf(ends[0].x, ends[1].x) + collider->size[0], fmaxf(ends[0].y, ends[1].y) + collider->size[0],
             fmaxf(ends[0].z, ends[1].z) + collider->size[0]}};
    }
    hair_collider_extent(collider, &middle, &half);
    hair_vec3 x = hair_rotate(turn, hair_v3(half.x, 0, 0)), y = hair_rotate(turn, hair_v3(0, half.y, 0)),
              z = hair_rotate(turn, hair_v3(0, 0, half.z)), m = hair_rotate(turn, middle);
    const float c[3] = {at->x + m.x, at->y + m.y, at->z + m.z};
    const float h[3] = {fabsf(x.x) + fabsf(y.x) + fabsf(z.x), fabsf(x.y) + fabsf(y.y) + fabsf(z.y),
                        fabsf(x.z) + fabsf(y.z) + fabsf(z.z)};
    return (struct hair_cell_bounds){{c[0] - h[0], c[1] - h[1], c[2] - h[2]},
                                     {c[0] + h[0], c[1] + h[1], c[2] + h[2]}};
}

// Return the maximum deviation of a turning collider from the straight path between its ends.
static float bulge_of(const struct hair_contact* contact, const hair_collider* collider)
{
    const hair_vec4 *a = &contact->body.rotation[0], *b = &contact->body.rotation[1];
    float x = b->x - a->x, y = b->y - a->y, z = b->z - a->z, w = b->w - a->w;
    hair_vec3 middle, half;
    hair_collider_extent(collider, &middle, &half);
    return (hair_length(middle) + hair_length(half)) * fminf(4 * (x * x + y * y + z * z + w * w), 2);
}

// Return the bounds of everything that hair in reach can touch in the step.
static struct hair_cell_bounds bounds_of(const struct hair_contact* contact, const hair_collider* collider,
                                         const struct hair_collider_grid_desc* desc)
{
    struct hair_cell_bounds a = box_around(contact, collider, 0), b = box_around(contact, collider, 1);
    float around = bulge_of(contact, collider) + contact->body.position[0].w + desc->margin + desc->slack;
    for (int k = 0; k < 3; ++k) {
        float lower = a.lower[k] + desc->fraction_start * (b.lower[k] - a.lower[k]);
        float upper = a.upper[k] + desc->fraction_start * (b.upper[k] - a.upper[k]);
        b.lower[k] = fminf(lower, b.lower[k]) - around;
        b.upper[k] = fmaxf(upper, b.upper[k]) + around;
    }
    return b;
}

// Return a sphere around a contact during the rest of the step.
static hair_vec4 ball_of(const struct hair_capsule* around, const struct hair_collider_grid_desc* desc)
{
    hair_vec4 ball = {0, 0, 0, 0};
    float half = 0, moved = 0;
    ball.x = 0.5f * (around->end[0].x + around->end[1].x);
    ball.y = 0.5f * (around->end[0].y + around->end[1].y);
    ball.z = 0.5f * (around->end[0].z + around->end[1].z);
    for (int k = 0; k < 2; ++k) {
        const hair_vec4 *a = &around->start[k], *b = &around->end[k];
        half = fmaxf(half, hair_length(hair_v3(b->x - ball.x, b->y - ball.y, b->z - ball.z)));
        moved = fmaxf(moved, hair_length(hair_v3(b->x - a->x, b->y - a->y, b->z - a->z)));
    }
    ball.w = half + fmaxf(around->start[0].w, around->end[0].w) + (1 - desc->fraction_start) * moved +
             desc->margin;
    return ball;
}

hair_result hair_collider_grid_gather(const hair_host* host, struct hair_collider_grid* grid,
                                      const struct hair_colliders* colliders,
                                      const struct hair_pose* head_before, const struct hair_pose* head_now,
                                      const struct hair_collider_grid_desc* desc)
{
    grid->contacts = 0;
    grid->bodies = 0;
    hair_result result = reserve_grid(host, grid, colliders->current.count);
    for (uint32_t i = 0; i < colliders->current.count && !result; ++i) {
        const hair_collider* collider = &colliders->current.collider[i];
        if (collider->shape == HAIR_SHAPE_MESH && !collider->mesh) continue;
        struct hair_contact contact = hair_colliders_contact(colliders, i, head_before, head_now);
        struct hair_cell_bounds bounds = bounds_of(&contact, collider, desc);
        int far = 0;
        for (int k = 0; k < 3; ++k)
            far |= !(bounds.lower[k] <= desc->reach && bounds.upper[k] >= -desc->reach);
        if (far) continue;
        contact.ball = ball_of(&contact.around, desc);
        HAIR_ASSERT(grid->contacts < grid->room && grid->contacts <= HAIR_ENTRY_NUMBER);
        for (int k = 0; k < 3; ++k) HAIR_ASSERT(bounds.lower[k] <= bounds.upper[k]);
        grid->contact[grid->contacts] = contact;
        grid->bounds[grid->contacts] = bounds;
        grid->collider[grid->contacts] = i;
        int walked = collider->shape > HAIR_SHAPE_CAPSULE, is_long = collider->shape > HAIR_SHAPE_SPHERE;
        grid->member[grid->contacts] =
            grid->contacts | (walked ? HAIR_ENTRY_WALKED : 0) | (is_long ? HAIR_ENTRY_LONG : 0);
        grid->bodies += (uint32_t)walked;
        ++grid->contacts;
    }
    return result;
}
