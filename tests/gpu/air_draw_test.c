// air_draw_test.c - wind drawn by hair_draw: arrows whose length and colour show the speed.
#include "tests/support/live_hair.h"
#include "tests/support/scene.h"
#include "tests/support/tessellated.h"

#include <math.h>

#define SIDE 500 // Pixels. An arrow is three pixels wide.
#define SPEED 2.0f

struct picture {
    float color[4 * SIDE * SIDE];
};

static struct hair_test_living start(void** state)
{
    struct hair_test_living living;
    hair_physics physics = hair_physics_default();
    struct hair_test_strands strands = hair_test_straight(8, hair_v3(0, 0.1f, 0), hair_v3(0, 1, 0), 0.2f);
    hair_desc desc = hair_test_rods(HAIR_SOLVER_DIRECT, HAIR_THREAD_MAPPING_WORKGROUP_PER_GUIDE, 0, &physics);
    hair_test_live(*state, &strands, &desc, &living);
    hair_test_strands_free(&strands);
    return living;
}

// Draw a slice through the middle of the field's box. The picture shows the box and a margin of a
// quarter of its length at both ends.
static void look(struct hair_test_living* living, hair_slice slice, struct picture* out)
{
    const struct hair_field_box* box = &living->hair->field.box;
    const struct hair_test_scene scene = {.test = living->test, .hair = living->hair};
    hair_view view = hair_test_tessellated();
    double brick = HAIR_BRICK * (double)box->voxel;
    const double lower[3] = {(double)box->lower.x, (double)box->lower.y, (double)box->lower.z};
    int axes[2] = {slice == HAIR_SLICE_X ? 1 : 0, slice == HAIR_SLICE_Y || slice == HAIR_SLICE_X ? 2 : 1};
    view.pass = HAIR_PASS_WIND, view.slice = slice;
    for (int i = 0; i < 16; ++i) view.projection[i] = i == 15;
    for (int i = 0; i < 16; ++i) view.view[i] = i % 5 == 0;
    for (int row = 0; row < 2; ++row) {
        double length = brick * box->bricks[axes[row]], middle = lower[axes[row]] + 0.5 * length;
        view.projection[4 * axes[row] + row] = (float)(2 / (1.5 * length));
        view.projection[12 + row] = (float)(-2 * middle / (1.5 * length));
    }
    hair_test_draw(&scene, &view, SIDE, SIDE, 0, out->color, NULL);
}

struct seen {
    // Pixels of arrows, of arrows bluer than grey, and of arrows redder than grey.
    int covered, slow, fast;
};

// Count the pixels in a part of the picture, whose bounds are fractions of its sides.
static struct seen count(const struct picture* picture, double left, double right, double below, double above)
{
    struct seen seen = {0, 0, 0};
    for (int i = 0; i < SIDE * SIDE; ++i) {
        const float* c = &picture->color[4 * i];
        double x = (i % SIDE + 0.5) / SIDE, y = (i / SIDE + 0.5) / SIDE;
        if (x < left || x > right || y < below || y > above || c[0] + c[1] + c[2] <= 0) continue;
        for (int k = 0; k < 3; ++k) assert_true(isfinite(c[k]) && c[k] >= 0 && c[k] <= 1);
        ++seen.covered;
        seen.slow += c[2] > c[0] + 0.1f;
        seen.fast += c[0] > c[2] + 0.1f;
    }
    return seen;
}

static struct picture picture;

// Check the drawn area. An arrow is a quarter of the spacing wide and as long as the spacing, so it
// covers an eighth.
static void uniform_wind_draws_grey_arrows_of_the_grid_spacing(void** state)
{
    struct hair_test_living living = start(state);
    hair_wind wind = hair_wind_default();
    wind.velocity[0] = SPEED, wind.shelter = 0;
    hair_test_wind_coupling(&living, &wind);
    hair_test_wait(&living, 1);
    for (hair_slice slice = HAIR_SLICE_NONE; slice <= HAIR_SLICE_Z; ++slice) {
        look(&living, slice, &picture);
        struct seen seen = count(&picture, 0, 1, 0, 1);
        double fraction = (double)seen.covered / (SIDE * SIDE);
        print_message("    slice %d: %.3f covered\n", (int)slice, fraction);
        assert_true(seen.slow == 0 && seen.fast == 0);
        if (slice == HAIR_SLICE_X) continue; // The wind is perpendicular to this slice.
        assert_true(fabs(fraction - 0.125) < 0.03);
    }
    hair_test_die(&living);
}

// Check the colours around a ball of 3 cm, in the middle of a picture of 18 by 42 cm.
static void arrows_are_blue_behind_a_ball_and_red_beside_it(void** state)
{
    for (int model = 0; model < 2; ++model) {
        struct hair_test_living living = start(state);
        hair_wind wind = hair_wind_default();
        hair_collider ball = hair_test_body(HAIR_SHAPE_SPHERE, 0, 0.175f, 0);
        ball.size[0] = 0.03f;
        wind.model = (hair_wind_model)model, wind.velocity[0] = SPEED;
        hair_test_set_colliders(&living, &ball, 1);
        hair_test_wind_coupling(&living, &wind);
        hair_test_wait(&living, model ? 12 : 1);
        look(&living, HAIR_SLICE_Z, &picture);
        struct seen before = count(&picture, 0, 0.2, 0.45, 0.55),
                    behind = count(&picture, 0.7, 0.9, 0.45, 0.55);
        struct seen beside = count(&picture, 0.4, 0.6, 0.58, 0.62);
        print_message("    model %d: slow %d of %d before, %d of %d behind; fast beside: %d of %d\n", model,
                      before.slow, before.covered, behind.slow, behind.covered, beside.fast, beside.covered);
        assert_true(before.slow < before.covered / 2 && behind.slow > 0.9 * behind.covered);
        assert_true(beside.fast > beside.covered / 10 && before.fast < before.covered / 50);
        assert_true(behind.covered > 100 && beside.covered > 100);
        hair_test_die(&living);
    }
}

static void arrows_are_absent_when_no_step_had_wind(void** state)
{
    struct hair_test_living living = start(state);
    hair_wind wind = hair_wind_default();
    wind.velocity[0] = SPEED;
    look(&living, HAIR_SLICE_Z, &picture);
    assert_int_equal(count(&picture, 0, 1, 0, 1).covered, 0);
    hair_test_wind_coupling(&living, &wind); // The wind is drawn only after a step has used it.
    look(&living, HAIR_SLICE_Z, &picture);
    assert_int_equal(count(&picture, 0, 1, 0, 1).covered, 0);
    hair_test_wait(&living, 1);
    look(&living, HAIR_SLICE_Z, &picture);
    assert_true(count(&picture, 0, 1, 0, 1).covered > 0);
    hair_test_wind_coupling(&living, NULL);
    hair_test_wait(&living, 1);
    look(&living, HAIR_SLICE_Z, &picture);
    assert_int_equal(count(&picture, 0, 1, 0, 1).covered, 0);
    hair_test_die(&living);
}

int main(void)
{
    if (hair_test_skips()) return 0;
    const struct CMUnitTest tests[] = {
        HAIR_TEST(uniform_wind_draws_grey_arrows_of_the_grid_spacing),
        HAIR_TEST(arrows_are_blue_behind_a_ball_and_red_beside_it),
        HAIR_TEST(arrows_are_absent_when_no_step_had_wind),
    };
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
