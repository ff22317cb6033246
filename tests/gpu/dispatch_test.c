// dispatch_test.c - a pass that is divided into many dispatches computes the same bits.
#include <stdio.h>
#include <string.h>

#include "tests/support/instances.h"
#include "tests/support/passes.h"
#include "tests/support/ways.h"

#define SIDE 64 // pixels
#define STEPS 4

struct result {
    struct hair_test_points points;
    float pixels[4 * SIDE * SIDE];
};

// Let each dispatch have at most `max` work groups.
static void limit_groups(struct hair_gl* gl, uint32_t max)
{
    for (uint32_t i = 0; i < gl->programs; ++i) gl->program[i]->max_groups = max;
}

// Simulate hair that touches a ball, and draw the hair with light and shadow.
static void simulate(struct hair_test* test, struct result* out)
{
    struct hair_test_handmade groom = hair_test_handmade_default();
    groom.guides = 100;
    hair_desc desc = hair_test_way(hair_test_instance_way);
    hair_physics physics = hair_physics_default();
    hair_look look = hair_look_default();
    physics.hair_hair.cohesion = 2;
    look.self_shadow.method = HAIR_SELF_SHADOW_STRANDS;
    desc.physics = &physics;
    desc.look = &look;
    struct hair_test_scene scene = hair_test_scene_make(test, NULL);
    hair_test_scene_add(&scene, &groom, &desc);
    hair_collider ball = hair_collider_default();
    ball.size[0] = 0.15f;
    ball.position[1] = -0.1f;
    hair_test_ok(test, hair_set_colliders(scene.hair, &ball, 1, sizeof ball));
    hair_test_instance_swing(test, scene.hair, 0, STEPS);
    hair_view view = hair_test_view_by(HAIR_RENDER_PATH_COMPUTE);
    hair_test_set_orthographic(&view, 4, 0.5f, 0);
    view.primitive = HAIR_PRIMITIVE_RIBBONS;
    hair_test_draw(&scene, &view, SIDE, SIDE, 1, out->pixels, NULL);
    hair_test_read_points(test, scene.hair, HAIR_READ_FOLLOWERS, &out->points);
    hair_test_scene_free(&scene);
}

static void divided_passes_compute_the_same_bits(void** state)
{
    static struct result whole, divided;
    struct hair_test* test = *state;
    struct hair_gl* gl = &test->context->gl;
    int software = gl->software;
    gl->software = 0;
    simulate(test, &whole);
    limit_groups(gl, 1);
    simulate(test, &divided);
    gl->software = software;
    limit_groups(gl, 0);
    double alpha = hair_test_mean_alpha(whole.pixels, sizeof whole.pixels / sizeof *whole.pixels);
    printf("    %u vertices, mean alpha %.4f\n", whole.points.count, alpha);
    assert_true(whole.points.count > 500 && alpha > 0.002);
    assert_int_equal(whole.points.count, divided.points.count);
    assert_memory_equal(whole.points.at, divided.points.at, 3 * whole.points.count * sizeof *whole.points.at);
    assert_memory_equal(whole.pixels, divided.pixels, sizeof whole.pixels);
}

int main(void)
{
    const struct CMUnitTest tests[] = {HAIR_TEST(divided_passes_compute_the_same_bits)};
    return hair_test_run_every_way(tests, 1);
}
