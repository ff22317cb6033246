// field_shadow_test.c - light that colliders block, after the field of the colliders has failed.
#include "tests/support/deforming.h"
#include "tests/support/scene.h"

#define SIDE 64
#define PIXELS (4 * SIDE * SIDE)

static void draw(const struct hair_test_scene* scene, const hair_light* light, float* pixels)
{
    hair_view view = scene->view;
    view.lights = light, view.light_count = 1;
    hair_test_draw(scene, &view, SIDE, SIDE, 0, pixels, NULL);
}

// Draw hair around a body, and draw it again after the body and the light have moved. Optionally
// refuse memory for the field in between.
static void draw_twice(struct hair_test* test, bool is_refused, float* pixels)
{
    struct hair_test_handmade groom = hair_test_handmade_default();
    struct hair_test_mesh mesh = hair_test_lump(12, 16, 0, 0), breathing = hair_test_lump(12, 16, 1, 0);
    hair_body* body = hair_test_deforming(test, &mesh, 0.16f, 16);
    hair_collider collider = hair_collider_default();
    hair_field_info info = hair_field_info_default();
    hair_look look = hair_look_default();
    hair_light light = hair_light_default();
    look.strand.segments = 8, look.strand.radius = 1e-3f;
    look.self_shadow.method = HAIR_SELF_SHADOW_STRANDS;
    look.followers.collision = HAIR_FOLLOWER_COLLISION_NONE;
    struct hair_test_scene scene = hair_test_scene_of(test, &groom, &look);
    hair_test_set_orthographic(&scene.view, 1 / 0.3f, -0.5f, 0);
    collider.shape = HAIR_SHAPE_MESH, collider.mesh = hair_body_get_mesh(body);
    collider.position[1] = 0.1f;
    hair_test_ok(test, hair_set_colliders(scene.hair, &collider, 1, sizeof collider));
    draw(&scene, &light, pixels);
    hair_test_deform(test, body, &breathing);
    test->host.refuse = is_refused ? test->host.allocations + 1 : 0;
    hair_result result = hair_get_field(scene.hair, &info);
    test->host.refuse = 0;
    if (is_refused)
        hair_test_refused(test, result, HAIR_ERROR_MEMORY, "out of memory for");
    else
        hair_test_ok(test, result);
    light.direction[0] += 0.5f;
    draw(&scene, &light, pixels);
    assert_true(hair_field_is_near(&scene.hair->field));
    hair_body_destroy(body);
    hair_test_scene_free(&scene);
    hair_test_mesh_free(&mesh);
    hair_test_mesh_free(&breathing);
}

static void shadows_of_bodies_return_after_a_failed_field(void** state)
{
    static float with[PIXELS], after[PIXELS];
    draw_twice(*state, false, with);
    draw_twice(*state, true, after);
    assert_true(hair_test_mean_alpha(with, PIXELS) > 0.01);
    assert_memory_equal(after, with, sizeof with);
}

int main(void)
{
    if (hair_test_skips()) return 0;
    const struct CMUnitTest tests[] = {HAIR_TEST(shadows_of_bodies_return_after_a_failed_field)};
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
