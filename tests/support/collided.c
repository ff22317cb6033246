// collided.c - hair whose followers are in colliders, on the GPU and in the reference.
#include "tests/support/collided.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static hair_collider collider_of(hair_shape shape, const float position[3], const float rotation[4],
                                 float radius)
{
    hair_collider collider = hair_collider_default();
    collider.shape = shape;
    collider.size[0] = radius;
    collider.size[1] = 0.1f;
    memcpy(collider.position, position, sizeof collider.position);
    memcpy(collider.rotation, rotation, sizeof collider.rotation);
    return collider;
}

struct hair_test_collided hair_test_collided_start(struct hair_test* test, int alone)
{
    struct hair_test_collided f = {.scene = hair_test_scene_make(test, NULL), .look = hair_look_default()};
    hair_desc desc = hair_desc_default();
    struct hair_test_handmade wanted = hair_test_handmade_default();
    wanted.fewest = 5, wanted.max = 30, wanted.guides = 26, wanted.followers = 400;
    f.scene.groom = hair_test_groom(&f.scene.test->host.host, wanted);
    for (uint32_t n = 0; n < wanted.followers && alone; ++n)
        f.scene.groom->followers[n].guide1 = f.scene.groom->followers[n].guide2 =
            f.scene.groom->followers[n].guide0;
    desc.field_voxel = 0.001f; // The minimum.
    hair_test_ok(f.scene.test, hair_create(f.scene.test->context, f.scene.groom, &desc, &f.scene.hair));
    f.samples = hair_test_scene_scatter(&f.scene);
    f.colliders[0] = collider_of(HAIR_SHAPE_SPHERE, (float[3]){0.15f, 0, 0}, (float[4]){0, 0, 0, 1}, 0.05f);
    f.colliders[1] = collider_of(HAIR_SHAPE_CAPSULE, (float[3]){-0.05f, 0.12f, 0.05f},
                                 (float[4]){0.6f, 0, 0, 0.8f}, 0.03f);
    f.colliders[2] =
        collider_of(HAIR_SHAPE_SPHERE, (float[3]){0, -0.1f, 0.14f}, (float[4]){0, 0, 0, 1}, 0.06f);
    hair_test_ok(f.scene.test, hair_set_colliders(f.scene.hair, f.colliders, HAIR_TEST_COLLIDED_COLLIDERS,
                                                  sizeof *f.colliders));
    return f;
}

void hair_test_collided_finish(struct hair_test_collided* f)
{
    free(f->samples);
    hair_test_scene_free(&f->scene);
}

void hair_test_collided_point(const struct hair_test_collided* f, uint32_t number, double t,
                              const struct hair_reference_repair* repair, struct hair_reference_point* out)
{
    hair_reference_follower(&f->scene.groom->followers[number], &f->look,
                            2 * f->scene.groom->max_vertices - 1, f->samples, t, repair, out);
}

static double distance_to(const hair_collider* collider, const double p[3])
{
    const float* q = collider->rotation;
    double x = (double)q[0], y = (double)q[1], z = (double)q[2], w = (double)q[3];
    // The second column of the rotation is the direction of the collider's y axis.
    double axis[3] = {2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w)}, arm[3], along = 0;
    double half = collider->shape == HAIR_SHAPE_CAPSULE ? (double)collider->size[1] : 0;
    for (int k = 0; k < 3; ++k) {
        arm[k] = p[k] - (double)collider->position[k];
        along += arm[k] * axis[k];
    }
    along = fmin(fmax(along, -half), half);
    for (int k = 0; k < 3; ++k) arm[k] -= along * axis[k];
    return sqrt(arm[0] * arm[0] + arm[1] * arm[1] + arm[2] * arm[2]) - (double)collider->size[0];
}

double hair_test_collided_distance(const struct hair_test_collided* f, const double p[3])
{
    double min = INFINITY;
    for (int i = 0; i < HAIR_TEST_COLLIDED_COLLIDERS; ++i) min = fmin(min, distance_to(&f->colliders[i], p));
    return min;
}

float* hair_test_collided_read(struct hair_test_collided* f, hair_follower_collision collision)
{
    uint32_t count = f->scene.groom->info.follower_count * (f->look.strand.segments + 1), there;
    float* vertices = malloc(3 * sizeof *vertices * count);
    f->look.followers.collision = collision;
    hair_test_ok(f->scene.test, hair_set_look(f->scene.hair, &f->look));
    hair_test_ok(f->scene.test,
                 hair_read_positions(f->scene.hair, HAIR_READ_FOLLOWERS, vertices, count, &there));
    assert_int_equal(there, count);
    return vertices;
}

void hair_test_collided_read_buffer(struct hair_test_collided* f, GLuint buffer, size_t each, void* out)
{
    glGetNamedBufferSubData(buffer, 0, (GLsizeiptr)(f->scene.groom->info.follower_count * each), out);
}
