// field_draw_test.c - colliders and a slice of the field as drawn by hair_draw.
#include "tests/support/fields.h"
#include "tests/support/scene.h"

#include <math.h>
#include <string.h>

#define SIDE 96
#define COLLIDERS 3

struct fixture {
    struct hair_test_scene scene;
    hair_collider colliders[COLLIDERS];
    float pixels[4 * SIDE * SIDE], depths[SIDE * SIDE];
};

static struct fixture f;

// Make a head rotated by half a turn at (0.2, 0, -1), with colliders at its sides, seen from the
// world's origin along -z.
static void start(void** state)
{
    const hair_collider colliders[COLLIDERS] = {
        {HAIR_SHAPE_SPHERE, {0.25f, 0.12f, -1}, {0, 0, 0, 1}, {0.05f}, .scale = 1, .friction = 1},
        {HAIR_SHAPE_CAPSULE,
         {0.15f, 0.08f, -1.05f},
         {0.6f, 0, 0, 0.8f},
         {0.03f, 0.06f},
         .scale = 1,
         .friction = 1},
        {HAIR_SHAPE_SPHERE, {0.2f, 0.22f, -0.9f}, {0, 0, 0, 1}, {0.02f}, .scale = 1, .friction = 1},
    };
    hair_desc desc = hair_desc_default();
    f.scene = hair_test_scene_make(*state, NULL);
    memcpy(f.colliders, colliders, sizeof colliders);
    desc.field_voxel = 0.004f;
    desc.transform[0] = desc.transform[10] = -1;
    desc.transform[12] = 0.2f;
    desc.transform[14] = -1;
    hair_test_scene_add(&f.scene, NULL, &desc);
    hair_test_ok(f.scene.test, hair_set_colliders(f.scene.hair, f.colliders, COLLIDERS, sizeof *f.colliders));
    hair_test_ok(f.scene.test, hair_step(f.scene.hair, 0.01f));
    f.scene.view.pass = HAIR_PASS_COLLIDERS;
    f.scene.view.projection[0] = f.scene.view.projection[5] = 3;
    f.scene.view.projection[8] = 0.6f; // Centres the colliders in the picture.
    f.scene.view.projection[9] = 0.3f;
    f.scene.view.projection[10] = -1.2f / 0.8f;
    f.scene.view.projection[11] = -1;
    f.scene.view.projection[14] = -2 * 0.4f * 2 / 1.6f;
    f.scene.view.projection[15] = 0;
}

static void draw(void)
{
    hair_test_draw(&f.scene, &f.scene.view, SIDE, SIDE, 0, f.pixels, f.depths);
}

// Find the point of the world at a distance of 1 along -z that the centre of a pixel shows.
static void find_ray(int i, double way[3])
{
    double x = (i % SIDE + 0.5) / SIDE * 2 - 1, y = (i / SIDE + 0.5) / SIDE * 2 - 1;
    way[0] = (x + (double)f.scene.view.projection[8]) / (double)f.scene.view.projection[0];
    way[1] = (y + (double)f.scene.view.projection[9]) / (double)f.scene.view.projection[5];
    way[2] = -1;
}

// Return the minimum distance of the ray to a collider. It is negative if the ray meets a collider,
// at z = *meets.
static double march(const double way[3], double from, double* meets)
{
    double min = INFINITY;
    for (double t = from; t < 1.5; t += 0.0005) {
        const double p[3] = {way[0] * t, way[1] * t, way[2] * t};
        uint32_t number;
        double distance = hair_test_nearest(f.colliders, COLLIDERS, p, &number);
        if (distance < min) min = distance;
        if (distance < 0) {
            *meets = -t;
            return distance;
        }
    }
    return min;
}

static double depth_at(double z)
{
    double clip = (double)f.scene.view.projection[10] * z + (double)f.scene.view.projection[14];
    return 0.5 + 0.5 * clip / -z;
}

static void colliders_are_drawn_at_their_place_with_depth(void** state)
{
    start(state);
    draw();
    int covered = 0;
    for (int i = 0; i < SIDE * SIDE; ++i) {
        double way[3], z = 0;
        find_ray(i, way);
        double near = march(way, 0.5, &z);
        int hit = f.depths[i] < 1;
        if (fabs(near) > 0.002 && (near < 0) != hit) fail_msg("pixel %d: %g m off, drawn %d", i, near, hit);
        if (!hit || near > 0) continue;
        ++covered;
        if (near < -0.0002) hair_test_near("depth", (size_t)i, (double)f.depths[i], depth_at(z), 0.002);
        for (int c = 0; c < 3; ++c) assert_true(f.pixels[4 * i + c] > 0 && isfinite(f.pixels[4 * i + c]));
    }
    assert_true(covered > 300);
    hair_test_scene_free(&f.scene);
}

// Check a slice at z = 0 of the head, which is z = -1 of the world. Everything nearer to the eye is
// cut away.
static void field_slice_is_red_inside_and_blue_outside(void** state)
{
    start(state);
    hair_field_info info = hair_field_info_default();
    hair_test_ok(f.scene.test, hair_get_field(f.scene.hair, &info));
    const double height = (double)f.scene.hair->field.box.lower.z, length = (double)info.voxel * info.size[2];
    f.scene.view.slice = HAIR_SLICE_Z;
    f.scene.view.slice_at = (float)(-height / length);
    draw();
    int inside = 0, outside = 0;
    for (int i = 0; i < SIDE * SIDE; ++i) {
        double way[3];
        uint32_t number;
        find_ray(i, way);
        double distance = hair_test_nearest(f.colliders, COLLIDERS, way, &number);
        const float* color = &f.pixels[4 * i];
        if (fabs(distance) < (double)info.voxel || distance > 3 * (double)info.voxel) continue;
        hair_test_near("depth of the slice", (size_t)i, (double)f.depths[i], depth_at(-1), 1e-4);
        assert_true(distance < 0 ? color[0] > color[2] : color[2] > color[0]);
        inside += distance < 0;
        outside += distance > 0;
    }
    print_message("    %d pixels inside, %d outside\n", inside, outside);
    assert_true(inside > 100 && outside > 50);
    // Nothing remains of the ball before the slice.
    for (int i = 0; i < SIDE * SIDE; ++i)
        if (f.depths[i] < 1) assert_true((double)f.depths[i] > depth_at(-1) - 1e-4);
    hair_test_scene_free(&f.scene);
}

static void field_and_picture_are_empty_without_colliders(void** state)
{
    start(state);
    hair_test_ok(f.scene.test, hair_set_colliders(f.scene.hair, NULL, 0, sizeof *f.colliders));
    f.scene.view.slice = HAIR_SLICE_X;
    draw();
    for (int i = 0; i < SIDE * SIDE; ++i) assert_true(f.depths[i] == 1 && f.pixels[4 * i] == 0);
    assert_int_equal(f.scene.hair->field.distance, 0);
    hair_test_scene_free(&f.scene);
}

static void field_is_absent_without_a_slice(void** state)
{
    start(state);
    draw();
    assert_int_equal(f.scene.hair->field.distance, 0);
    f.scene.view.slice = HAIR_SLICE_Y;
    draw();
    assert_true(f.scene.hair->field.distance != 0);
    hair_test_scene_free(&f.scene);
}

int main(void)
{
    if (hair_test_skips()) return 0;
    const struct CMUnitTest tests[] = {
        HAIR_TEST(colliders_are_drawn_at_their_place_with_depth),
        HAIR_TEST(field_slice_is_red_inside_and_blue_outside),
        HAIR_TEST(field_and_picture_are_empty_without_colliders),
        HAIR_TEST(field_is_absent_without_a_slice),
    };
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
