// field_scene.c - a field of colliders around hair, and a check of its voxels.
#include "tests/support/field_scene.h"

#include <math.h>

#include "lib/api/api.h"
#include "lib/collide/distance.h"
#include "tests/support/handmade.h"

void hair_test_field_begin(struct hair_test* test, struct hair_pose head, struct hair_test_field_scene* out)
{
    *out = (struct hair_test_field_scene){.test = test, .head = head, .random = 7};
    out->groom = hair_test_groom(&test->host.host, hair_test_handmade_default());
    hair_field_create(&out->field, &test->context->sdf_pool, out->groom, HAIR_TEST_FIELD_VOXEL);
    hair_field_want_numbers(&out->field);
    for (int i = 0; i < HAIR_TEST_FIELD_COLLIDERS; ++i)
        out->colliders[i] = hair_test_any_collider(&out->field.box, &head, 0.1f, &out->random);
}

void hair_test_field_end(struct hair_test_field_scene* f)
{
    hair_field_destroy(&f->field);
    hair_groom_destroy(f->groom);
}

void hair_test_field_update(struct hair_test_field_scene* f, uint32_t count)
{
    hair_test_ok(f->test, hair_field_update(&f->field, f->colliders, count, &f->head));
}

void hair_test_field_check(struct hair_test_field_scene* f, uint32_t count)
{
    const struct hair_field_box* box = &f->field.box;
    struct hair_test_field read = hair_test_field_read(&f->field);
    double max = 0, voxel = (double)box->voxel;
    size_t near = 0;
    for (size_t i = 0; i < hair_test_field_count(&read); ++i) {
        double point[3];
        uint32_t number, own = read.number[i];
        hair_test_voxel(box, &f->head, i, point);
        double right = fmin(hair_test_nearest(f->colliders, count, point, &number), (double)box->far);
        double off = fabs((double)read.distance[i] - right);
        max = fmax(max, off);
        if (!(off <= 0.05 * voxel))
            fail_msg("voxel %zu holds %g, not %g", i, (double)read.distance[i], right);
        near += own != HAIR_NO_COLLIDER;
        if (own == HAIR_NO_COLLIDER)
            assert_true(right > (double)box->far - 0.01 * voxel);
        else
            assert_true(own < count &&
                        hair_distance_to_collider(&f->colliders[own], point, NULL) < right + 0.01 * voxel);
    }
    print_message("    %zu voxels, %zu near, off by at most %.4f of one\n", hair_test_field_count(&read),
                  near, max / voxel);
    assert_true(near > 1000 && near < hair_test_field_count(&read));
    hair_test_field_free(&read);
}
