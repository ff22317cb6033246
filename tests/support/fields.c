// fields.c - the field read back, and closed forms of its expected values.
#include "tests/support/fields.h"

#include "lib/collide/distance.h"

#include <math.h>
#include <stdlib.h>

struct hair_test_field hair_test_field_read(const struct hair_collider_field* field)
{
    struct hair_test_field read;
    for (int i = 0; i < 3; ++i) read.size[i] = HAIR_BRICK * field->box.bricks[i];
    size_t count = hair_test_field_count(&read);
    read.distance = calloc(count, sizeof *read.distance);
    read.number = calloc(count, sizeof *read.number);
    glGetTextureImage(field->distance, 0, GL_RED, GL_FLOAT, (GLsizei)(count * sizeof *read.distance),
                      read.distance);
    if (field->number)
        glGetTextureImage(field->number, 0, GL_RED_INTEGER, GL_UNSIGNED_INT,
                          (GLsizei)(count * sizeof *read.number), read.number);
    return read;
}

void hair_test_field_free(struct hair_test_field* read)
{
    free(read->distance);
    free(read->number);
}

static void turn(const double q[4], const double v[3], double out[3])
{
    double t[3];
    for (int i = 0; i < 3; ++i) {
        int a = (i + 1) % 3, b = (i + 2) % 3;
        t[i] = 2 * (q[a] * v[b] - q[b] * v[a]);
    }
    for (int i = 0; i < 3; ++i) {
        int a = (i + 1) % 3, b = (i + 2) % 3;
        out[i] = v[i] + q[3] * t[i] + q[a] * t[b] - q[b] * t[a];
    }
}

double hair_test_nearest(const hair_collider* colliders, uint32_t count, const double point[3],
                         uint32_t* number)
{
    double nearest = INFINITY;
    *number = HAIR_NO_COLLIDER;
    for (uint32_t i = 0; i < count; ++i) {
        double distance = hair_distance_to_collider(&colliders[i], point, NULL);
        if (!(distance < nearest)) continue;
        nearest = distance;
        *number = i;
    }
    return nearest;
}

void hair_test_voxel(const struct hair_field_box* box, const struct hair_pose* head, size_t i,
                     double point[3])
{
    size_t nx = HAIR_BRICK * box->bricks[0], ny = HAIR_BRICK * box->bricks[1];
    const double at[3] = {(double)(i % nx), (double)(i / nx % ny), (double)(i / nx / ny)},
                 low[3] = {(double)box->lower.x, (double)box->lower.y, (double)box->lower.z},
                 q[4] = {(double)head->rotation.x, (double)head->rotation.y, (double)head->rotation.z,
                         (double)head->rotation.w};
    double own[3];
    for (int k = 0; k < 3; ++k) own[k] = low[k] + (at[k] + 0.5) * (double)box->voxel;
    turn(q, own, point);
    for (int k = 0; k < 3; ++k) point[k] += head->position[k];
}

static float between(uint32_t* random, float min, float max)
{
    return min + (max - min) * hair_random(random);
}

hair_collider hair_test_any_collider(const struct hair_field_box* box, const struct hair_pose* head,
                                     float reach, uint32_t* random)
{
    hair_collider collider = hair_collider_default();
    collider.shape = (hair_shape)(hair_random(random) * 6);
    if (collider.shape == HAIR_SHAPE_PLANE) collider.shape = HAIR_SHAPE_ELLIPSOID;
    hair_vec3 side = hair_scale(hair_v3((float)box->bricks[0], (float)box->bricks[1], (float)box->bricks[2]),
                                0.5f * HAIR_BRICK * box->voxel);
    hair_vec3 at = hair_add(hair_add(box->lower, side),
                            hair_v3(between(random, -reach, reach), between(random, -reach, reach),
                                    between(random, -reach, reach)));
    hair_vec3 turned = hair_rotate(head->rotation, at);
    hair_quat q = hair_quat_normalize((hair_quat){between(random, -1, 1), between(random, -1, 1),
                                                  between(random, -1, 1), between(random, -1, 1)});
    const float place[] = {turned.x, turned.y, turned.z}, way[] = {q.x, q.y, q.z, q.w};
    for (int i = 0; i < 3; ++i) collider.position[i] = (float)(head->position[i] + (double)place[i]);
    for (int i = 0; i < 4; ++i) collider.rotation[i] = way[i];
    for (int i = 0; i < 3; ++i) collider.size[i] = between(random, 2, 8) * box->voxel;
    if (hair_random(random) < 0.3f) collider.rounding = between(random, 0, 3) * box->voxel;
    return collider;
}
