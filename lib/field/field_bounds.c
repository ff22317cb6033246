// field_bounds.c - box of the field, and colliders placed in it.
#include "lib/field/field_bounds.h"
#include "lib/collide/distance.h"

#include <string.h>

#define SWING 0.25f // Margin around the rest shape, as a fraction of the longest strand.
// Movement of a collider that is ignored, in voxels. Rounding errors stay below it.
#define STILL 0.01f
#define EVERYWHERE 1e9f // Distance beyond everything, in metres.

// Compilers call a function for fminf() and fmaxf(), because of values that are not numbers.
static float lower_bound(float a, float b)
{
    return a < b ? a : b;
}

static float upper_bound(float a, float b)
{
    return a > b ? a : b;
}

static void include_ball(hair_vec3 at, float around, hair_vec3* lower, hair_vec3* upper)
{
    *lower = hair_v3(lower_bound(lower->x, at.x - around), lower_bound(lower->y, at.y - around),
                     lower_bound(lower->z, at.z - around));
    *upper = hair_v3(upper_bound(upper->x, at.x + around), upper_bound(upper->y, at.y + around),
                     upper_bound(upper->z, at.z + around));
}

// Compute the bounds of the field. They are those of the rest shape and SWING times the longest
// strand around it, but never beyond the reach of strands. Hair mostly stays near its rest shape. A
// box of everything in reach would be several times as long for long hair, and mostly empty. Hair
// that swings farther meets no collider there, but guides do not depend on the field.
static void find_groom_bounds(const struct hair_groom* groom, hair_vec3* lower, hair_vec3* upper)
{
    hair_vec3 reach[2] = {{EVERYWHERE, EVERYWHERE, EVERYWHERE}, {-EVERYWHERE, -EVERYWHERE, -EVERYWHERE}};
    float longest = 0;
    *lower = groom->lower, *upper = groom->upper;
    for (uint32_t i = 0; i < groom->info.guide_count; ++i) {
        const float length = groom->guides[i].arc_length;
        include_ball(hair_guide_root(groom, i), length, &reach[0], &reach[1]);
        longest = fmaxf(longest, length);
    }
    float around = SWING * longest;
    *lower = hair_v3(fmaxf(lower->x - around, reach[0].x), fmaxf(lower->y - around, reach[0].y),
                     fmaxf(lower->z - around, reach[0].z));
    *upper = hair_v3(fminf(upper->x + around, reach[1].x), fminf(upper->y + around, reach[1].y),
                     fminf(upper->z + around, reach[1].z));
}

static uint32_t count_bricks(float length, float voxel)
{
    uint32_t voxels = (uint32_t)fminf(fmaxf(ceilf(length / voxel - 1e-3f), 1), HAIR_FIELD_MAX_VOXELS);
    HAIR_ASSERT(1 <= voxels && voxels <= HAIR_FIELD_MAX_VOXELS);
    return (voxels + HAIR_BRICK - 1) / HAIR_BRICK;
}

struct hair_field_box hair_field_box_of(const struct hair_groom* groom, float voxel)
{
    hair_vec3 lower, upper;
    find_groom_bounds(groom, &lower, &upper);
    hair_vec3 size = hair_sub(upper, lower), middle = hair_lerp(lower, upper, 0.5f);
    float longest = fmaxf(size.x, fmaxf(size.y, size.z));
    struct hair_field_box box;
    box.voxel = fmaxf(fminf(fmaxf(voxel, longest / HAIR_FIELD_MAX_VOXELS), longest / HAIR_FIELD_MIN_VOXELS),
                      HAIR_FIELD_MIN_VOXEL);
    box.far = HAIR_FIELD_BAND * box.voxel;
    box.bricks[0] = count_bricks(size.x, box.voxel);
    box.bricks[1] = count_bricks(size.y, box.voxel);
    box.bricks[2] = count_bricks(size.z, box.voxel);
    HAIR_ASSERT(box.voxel >= HAIR_FIELD_MIN_VOXEL);
    float half = 0.5f * HAIR_BRICK * box.voxel;
    box.lower = hair_sub(middle, hair_v3(half * (float)box.bricks[0], half * (float)box.bricks[1],
                                         half * (float)box.bricks[2]));
    return box;
}

// Colliders ---------------------------------------------------------------------------------------

static hair_quat quat_of(hair_vec4 q)
{
    return (hair_quat){q.x, q.y, q.z, q.w};
}

// Compute the box around a collider in its own axes, without the margin `around` on all sides. A
// sphere is its centre with its radius as the margin, so that no rotation enlarges it.
static void find_extent(const struct hair_placed_collider* placed, hair_vec3* lower, hair_vec3* upper,
                        float* around)
{
    const struct hair_field_collider* collider = &placed->collider;
    hair_vec4 size = collider->size;
    *around = collider->position.w;
    *upper = hair_v3(size.x, size.y, size.z);
    switch ((hair_shape)collider->shape) {
    case HAIR_SHAPE_SPHERE:
    case HAIR_SHAPE_CAPSULE:
        *upper = hair_v3(0, collider->shape == HAIR_SHAPE_CAPSULE ? size.y : 0, 0);
        *around += size.x;
        break;
    case HAIR_SHAPE_CYLINDER:
    case HAIR_SHAPE_CONE: *upper = hair_v3(size.x, size.y, size.x); break;
    case HAIR_SHAPE_PLANE: *upper = hair_v3(EVERYWHERE, EVERYWHERE, EVERYWHERE); break;
    default: break;
    }
    *lower = hair_scale(*upper, -1);
    if (!placed->mesh) return;
    *lower = hair_scale(hair_load3(placed->mesh->info.lower), size.w);
    *upper = hair_scale(hair_load3(placed->mesh->info.upper), size.w);
}

void hair_field_shown_extent(const struct hair_placed_collider* placed, hair_vec3* lower, hair_vec3* upper)
{
    float around;
    find_extent(placed, lower, upper, &around);
    if (placed->collider.shape == HAIR_SHAPE_PLANE)
        *upper = hair_v3(1, 0, 1), *lower = hair_v3(-1, -0.05f, -1);
    *upper = hair_add(*upper, hair_v3(around, around, around));
    *lower = hair_sub(*lower, hair_v3(around, around, around));
}

static void find_bricks(const struct hair_field_box* box, struct hair_placed_collider* placed)
{
    const struct hair_field_collider* collider = &placed->collider;
    hair_quat turn = quat_of(collider->rotation);
    HAIR_ASSERT(hair_quat_is_unit(turn));
    hair_vec3 lower, upper;
    float around;
    find_extent(placed, &lower, &upper, &around);
    hair_vec3 half = hair_scale(hair_sub(upper, lower), 0.5f);
    hair_vec3 middle = hair_rotate(turn, hair_lerp(lower, upper, 0.5f));
    hair_vec3 x = hair_rotate(turn, hair_v3(half.x, 0, 0)), y = hair_rotate(turn, hair_v3(0, half.y, 0)),
              z = hair_rotate(turn, hair_v3(0, 0, half.z));
    const float extent[] = {fabsf(x.x) + fabsf(y.x) + fabsf(z.x), fabsf(x.y) + fabsf(y.y) + fabsf(z.y),
                            fabsf(x.z) + fabsf(y.z) + fabsf(z.z)};
    const float at[] = {collider->position.x + middle.x - box->lower.x,
                        collider->position.y + middle.y - box->lower.y,
                        collider->position.z + middle.z - box->lower.z};
    float brick = HAIR_BRICK * box->voxel;
    int outside = collider->shape == HAIR_SHAPE_MESH && !placed->mesh;
    for (int i = 0; i < 3; ++i) {
        float first = (at[i] - extent[i] - around - box->far) / brick;
        float end = (at[i] + extent[i] + around + box->far) / brick;
        float max = (float)box->bricks[i];
        placed->first[i] = (uint16_t)fminf(fmaxf(floorf(first), 0), max);
        placed->end[i] = (uint16_t)fminf(fmaxf(floorf(end) + 1, 0), max);
        HAIR_ASSERT(placed->end[i] <= box->bricks[i]);
        outside |= placed->first[i] >= placed->end[i];
    }
    if (outside) memset(placed->first, 0, sizeof placed->first), memset(placed->end, 0, sizeof placed->end);
}

struct hair_placed_collider hair_field_place(const struct hair_field_box* box, const hair_collider* collider,
                                             uint32_t number, const struct hair_pose* head)
{
    hair_quat back = hair_quat_conjugate(head->rotation);
    hair_vec3 from = {(float)((double)collider->position[0] - head->position[0]),
                      (float)((double)collider->position[1] - head->position[1]),
                      (float)((double)collider->position[2] - head->position[2])};
    hair_vec3 at = hair_rotate(back, from);
    hair_quat own = {collider->rotation[0], collider->rotation[1], collider->rotation[2],
                     collider->rotation[3]};
    hair_quat turn = hair_quat_multiply(back, hair_quat_normalize(own));

    struct hair_placed_collider placed = {
        .collider = {.position = {at.x, at.y, at.z, collider->rounding},
                     .rotation = {turn.x, turn.y, turn.z, turn.w},
                     .size = {collider->size[0], collider->size[1], collider->size[2], 0},
                     .shape = (hair_uint)collider->shape,
                     .number = number}};
    if (collider->shape == HAIR_SHAPE_MESH && collider->mesh) {
        const hair_collision_mesh* mesh = collider->mesh;
        placed.mesh = mesh;
        placed.generation = mesh->generation;
        placed.collider.size = (hair_vec4){0, 0, 0, collider->scale};
        placed.collider.grid = (hair_vec4){mesh->origin[0], mesh->origin[1], mesh->origin[2], mesh->voxel};
        placed.collider.nodes_x = mesh->size[0];
        placed.collider.nodes_y = mesh->size[1];
        placed.collider.nodes_z = mesh->size[2];
    }
    find_bricks(box, &placed);
    return placed;
}

bool hair_field_differs(const struct hair_placed_collider* a, const struct hair_placed_collider* b)
{
    return a->mesh != b->mesh || a->generation != b->generation ||
           memcmp(&a->collider, &b->collider, sizeof a->collider) != 0;
}

void hair_field_keep_pose(const struct hair_field_box* box, const struct hair_placed_collider* earlier,
                          struct hair_placed_collider* placed)
{
    placed->collider.position = earlier->collider.position;
    placed->collider.rotation = earlier->collider.rotation;
    find_bricks(box, placed);
}

int hair_field_has_moved(const struct hair_field_box* box, const struct hair_placed_collider* from,
                         const struct hair_placed_collider* to)
{
    const struct hair_field_collider *a = &from->collider, *b = &to->collider;
    if (from->mesh != to->mesh || from->generation != to->generation || a->shape != b->shape ||
        a->number != b->number || a->position.w != b->position.w ||
        memcmp(&a->size, &b->size, sizeof a->size))
        return 1;
    // A point moves at most by the centre's translation plus the rotation times its distance from
    // the centre. Only points in the box count.
    hair_vec3 half = hair_scale(hair_v3((float)box->bricks[0], (float)box->bricks[1], (float)box->bricks[2]),
                                0.5f * HAIR_BRICK * box->voxel);
    hair_vec3 centre = hair_v3(a->position.x, a->position.y, a->position.z);
    hair_vec3 lower, upper;
    float around, arm = hair_distance(centre, hair_add(box->lower, half)) + hair_length(half);
    find_extent(from, &lower, &upper, &around);
    float longest =
        hair_length(hair_v3(fmaxf(upper.x, -lower.x), fmaxf(upper.y, -lower.y), fmaxf(upper.z, -lower.z)));
    arm = fminf(arm, longest + around);

    float sign = a->rotation.x * b->rotation.x + a->rotation.y * b->rotation.y +
                             a->rotation.z * b->rotation.z + a->rotation.w * b->rotation.w <
                         0
                     ? -1.0f
                     : 1.0f;
    float turn = 0; // Squared. A sphere may turn.
    hair_vec3 way =
        hair_v3(b->position.x - a->position.x, b->position.y - a->position.y, b->position.z - a->position.z);
    const float d[] = {b->rotation.x - sign * a->rotation.x, b->rotation.y - sign * a->rotation.y,
                       b->rotation.z - sign * a->rotation.z, b->rotation.w - sign * a->rotation.w};
    for (int i = 0; i < 4 && a->shape != HAIR_SHAPE_SPHERE; ++i) turn += d[i] * d[i];
    return !(hair_length(way) + 2 * sqrtf(turn) * arm <= STILL * box->voxel);
}

// Return bounds of the distance to a body from a point, in its own space. The CPU knows only the
// box of the body.
static struct hair_field_span span_of_body(const hair_collision_mesh* mesh, const double point[3])
{
    double square = 0;
    for (int k = 0; k < 3; ++k) {
        double lower = (double)mesh->info.lower[k], upper = (double)mesh->info.upper[k];
        double off = fmax(fmax(lower - point[k], point[k] - upper), 0);
        square += off * off;
    }
    return (struct hair_field_span){square > 0 ? (float)sqrt(square) : -EVERYWHERE, EVERYWHERE};
}

// Return bounds of a collider's distance to the voxels of a brick. Distances are 1-Lipschitz,
// except slightly between the nodes of a collision mesh.
struct hair_field_span hair_field_find_span(const struct hair_field_box* box,
                                            const struct hair_placed_collider* placed, uint32_t x, uint32_t y,
                                            uint32_t z)
{
    HAIR_ASSERT(x < box->bricks[0] && y < box->bricks[1] && z < box->bricks[2]);
    const struct hair_field_collider* collider = &placed->collider;
    float brick = HAIR_BRICK * box->voxel;
    float radius = 0.5f * (HAIR_BRICK - 1 + 0.1f) * 1.7320508f * box->voxel;
    hair_vec3 middle =
        hair_add(box->lower, hair_scale(hair_v3((float)x + 0.5f, (float)y + 0.5f, (float)z + 0.5f), brick));
    hair_vec3 p = hair_sub(middle, hair_v3(collider->position.x, collider->position.y, collider->position.z));
    p = hair_rotate(hair_quat_conjugate(quat_of(collider->rotation)), p);
    double own[] = {(double)p.x, (double)p.y, (double)p.z}, distance;
    const float size[] = {collider->size.x, collider->size.y, collider->size.z};
    if (placed->mesh) {
        double scale = (double)collider->size.w;
        for (int k = 0; k < 3; ++k) own[k] /= scale;
        if (placed->mesh->home) {
            struct hair_field_span span = span_of_body(placed->mesh, own);
            radius = 1.25f * radius + 2 * collider->size.w * collider->grid.w + collider->position.w;
            return (struct hair_field_span){(float)scale * span.min - radius, (float)scale * span.max};
        }
        distance = scale * hair_distance_to_mesh(placed->mesh, own, NULL);
        radius = 1.25f * radius + 2 * collider->size.w * collider->grid.w;
    } else {
        distance = hair_distance_to_shape((hair_shape)collider->shape, size, own, NULL);
    }
    float from = (float)distance - collider->position.w;
    return (struct hair_field_span){from - radius, from + radius};
}
