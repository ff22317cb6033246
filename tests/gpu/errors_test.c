// errors_test.c - every wrong argument is refused with the right code and one message that names
// it.
#include "tests/support/scene.h"

#include <math.h>
#include <string.h>

#define refused hair_test_refused

static void null_objects_are_argument_errors(void** state)
{
    (void)state;
    float transform[16] = {0}, positions[3];
    uint32_t count;
    size_t size;
    assert_int_equal(hair_context_reload(NULL), HAIR_ERROR_ARGUMENT);
    assert_int_equal(hair_create(NULL, NULL, NULL, NULL), HAIR_ERROR_ARGUMENT);
    assert_int_equal(hair_set_physics(NULL, NULL), HAIR_ERROR_ARGUMENT);
    assert_int_equal(hair_set_look(NULL, NULL), HAIR_ERROR_ARGUMENT);
    assert_int_equal(hair_set_transform(NULL, transform), HAIR_ERROR_ARGUMENT);
    assert_int_equal(hair_get_physics(NULL, NULL), HAIR_ERROR_ARGUMENT);
    assert_int_equal(hair_get_look(NULL, NULL), HAIR_ERROR_ARGUMENT);
    assert_int_equal(hair_get_wind(NULL, NULL), HAIR_ERROR_ARGUMENT);
    assert_int_equal(hair_get_transform(NULL, transform), HAIR_ERROR_ARGUMENT);
    assert_int_equal(hair_set_colliders(NULL, NULL, 0, 0), HAIR_ERROR_ARGUMENT);
    assert_int_equal(hair_step(NULL, 0.1f), HAIR_ERROR_ARGUMENT);
    assert_int_equal(hair_reset(NULL), HAIR_ERROR_ARGUMENT);
    assert_int_equal(hair_teleport(NULL, transform), HAIR_ERROR_ARGUMENT);
    assert_int_equal(hair_save(NULL, NULL, 0, &size), HAIR_ERROR_ARGUMENT);
    assert_int_equal(hair_load(NULL, transform, sizeof transform), HAIR_ERROR_ARGUMENT);
    assert_int_equal(hair_draw(NULL, NULL), HAIR_ERROR_ARGUMENT);
    assert_int_equal(hair_read_positions(NULL, HAIR_READ_GUIDES, positions, 1, &count), HAIR_ERROR_ARGUMENT);
    assert_int_equal(hair_get_solver_stats(NULL, NULL), HAIR_ERROR_ARGUMENT);
    assert_int_equal(hair_get_field(NULL, NULL), HAIR_ERROR_ARGUMENT);
    assert_int_equal(hair_get_timings(NULL, NULL, 0), 0);
    hair_destroy(NULL);
    hair_context_destroy(NULL);
    hair_groom_destroy(NULL);
    hair_asset_destroy(NULL);
}

static void null_arguments_are_refused_by_name(void** state)
{
    struct hair_test_scene f = hair_test_scene_of(*state, NULL, NULL);
    hair_context* context;
    hair_instance* other;
    hair_desc desc = hair_desc_default();
    hair_context_desc of = hair_context_desc_default();
    float positions[3];
    uint32_t count;
    size_t size;
    of.host = &f.test->host.host;
    refused(f.test, hair_context_create(&of, &context), HAIR_ERROR_ARGUMENT,
            "hair_context_desc.get_proc is NULL");
    of.get_proc = hair_egl_get_proc;
    refused(f.test, hair_context_create(&of, NULL), HAIR_ERROR_ARGUMENT, "out is NULL");
    assert_int_equal(hair_context_create(NULL, &context), HAIR_ERROR_ARGUMENT);
    refused(f.test, hair_create(f.test->context, NULL, &desc, &other), HAIR_ERROR_ARGUMENT, "groom is NULL");
    refused(f.test, hair_create(f.test->context, f.groom, NULL, &other), HAIR_ERROR_ARGUMENT,
            "hair_desc is NULL");
    refused(f.test, hair_create(f.test->context, f.groom, &desc, NULL), HAIR_ERROR_ARGUMENT, "out is NULL");
    refused(f.test, hair_set_physics(f.hair, NULL), HAIR_ERROR_ARGUMENT, "hair_physics is NULL");
    refused(f.test, hair_set_look(f.hair, NULL), HAIR_ERROR_ARGUMENT, "hair_look is NULL");
    refused(f.test, hair_set_transform(f.hair, NULL), HAIR_ERROR_ARGUMENT, "transform is NULL");
    refused(f.test, hair_teleport(f.hair, NULL), HAIR_ERROR_ARGUMENT, "transform is NULL");
    refused(f.test, hair_get_physics(f.hair, NULL), HAIR_ERROR_ARGUMENT, "hair_physics is NULL");
    refused(f.test, hair_get_look(f.hair, NULL), HAIR_ERROR_ARGUMENT, "hair_look is NULL");
    refused(f.test, hair_get_wind(f.hair, NULL), HAIR_ERROR_ARGUMENT, "hair_wind is NULL");
    refused(f.test, hair_get_transform(f.hair, NULL), HAIR_ERROR_ARGUMENT, "transform is NULL");
    refused(f.test, hair_set_colliders(f.hair, NULL, 1, sizeof(hair_collider)), HAIR_ERROR_ARGUMENT,
            "colliders is NULL");
    refused(f.test, hair_save(f.hair, positions, sizeof positions, NULL), HAIR_ERROR_ARGUMENT,
            "size is NULL");
    refused(f.test, hair_save(f.hair, NULL, 7, &size), HAIR_ERROR_ARGUMENT,
            "bytes is NULL but capacity is 7");
    refused(f.test, hair_load(f.hair, NULL, 7), HAIR_ERROR_ARGUMENT, "bytes is NULL");
    refused(f.test, hair_draw(f.hair, NULL), HAIR_ERROR_ARGUMENT, "hair_view is NULL");
    refused(f.test, hair_read_positions(f.hair, HAIR_READ_GUIDES, positions, 1, NULL), HAIR_ERROR_ARGUMENT,
            "count is NULL");
    refused(f.test, hair_read_positions(f.hair, HAIR_READ_GUIDES, NULL, 1, &count), HAIR_ERROR_ARGUMENT,
            "positions is NULL");
    refused(f.test, hair_get_solver_stats(f.hair, NULL), HAIR_ERROR_ARGUMENT, "hair_solver_stats is NULL");
    refused(f.test, hair_get_field(f.hair, NULL), HAIR_ERROR_ARGUMENT, "hair_field_info is NULL");
    refused(f.test, hair_read_positions(f.hair, (hair_read_source)3, positions, 1, &count),
            HAIR_ERROR_ARGUMENT, "source is 3, not in [0, 2]");
    hair_test_scene_free(&f);
}

// Transforms that are not rigid, steps, colliders -------------------------------------------------

static void transforms_that_are_not_rigid_are_refused(void** state)
{
    struct hair_test_scene f = hair_test_scene_of(*state, NULL, NULL);
    hair_desc desc = hair_desc_default();
    for (int i = 0; i < 16; ++i) {
        float wrong[16];
        for (int kind = 0; kind < 3; ++kind) {
            // A position may be anywhere, if it is finite.
            if (kind == 0 && i >= 12 && i < 15) continue;
            memcpy(wrong, desc.transform, sizeof wrong);
            wrong[i] = kind == 0 ? wrong[i] + 0.01f : kind == 1 ? NAN : INFINITY;
            refused(f.test, hair_set_transform(f.hair, wrong), HAIR_ERROR_ARGUMENT, "not a rigid motion");
            refused(f.test, hair_teleport(f.hair, wrong), HAIR_ERROR_ARGUMENT, "not a rigid motion");
        }
    }
    desc.transform[0] = -1;
    refused(f.test, hair_set_transform(f.hair, desc.transform), HAIR_ERROR_ARGUMENT, "no mirror");
    hair_test_scene_free(&f);
}

static void step_of_negative_or_nan_time_is_refused(void** state)
{
    struct hair_test_scene f = hair_test_scene_of(*state, NULL, NULL);
    refused(f.test, hair_step(f.hair, NAN), HAIR_ERROR_ARGUMENT, "dt is ");
    refused(f.test, hair_step(f.hair, -1e-6f), HAIR_ERROR_ARGUMENT, "dt is -1e-06, not 0 or more");
    refused(f.test, hair_step(f.hair, -INFINITY), HAIR_ERROR_ARGUMENT, "dt is -inf");
    hair_test_scene_free(&f);
}

static void substep_that_is_too_short_is_refused(void** state)
{
    struct hair_test_scene f = hair_test_scene_of(*state, NULL, NULL);
    hair_instance* other = NULL;
    hair_desc desc = hair_desc_default();
    desc.substep = 9e-6f;
    refused(f.test, hair_create(f.test->context, f.groom, &desc, &other), HAIR_ERROR_ARGUMENT,
            "hair_desc.substep is 9e-06, not 0 or in [1e-05, 0.1]");
    assert_null(other);
    desc.substep = 1e-5f;
    hair_test_ok(f.test, hair_create(f.test->context, f.groom, &desc, &other));
    hair_destroy(other);
    hair_test_scene_free(&f);
}

static void invalid_colliders_are_named_and_change_nothing(void** state)
{
    struct hair_test_scene f = hair_test_scene_of(*state, NULL, NULL);
    hair_collider good = {HAIR_SHAPE_CAPSULE, {0}, {0, 0, 0, 1}, {0.1f, 0.1f}, .scale = 1, .friction = 1};
    hair_collider many[2] = {good};
    hair_test_ok(f.test, hair_set_colliders(f.hair, &good, 1, sizeof good));
    refused(f.test, hair_set_colliders(f.hair, many, 1048577, sizeof good), HAIR_ERROR_ARGUMENT,
            "collider count is 1048577, not in [0, 1048576]");
    refused(f.test, hair_set_colliders(f.hair, many, 2, 8), HAIR_ERROR_ARGUMENT, "collider stride is 8");
    refused(f.test, hair_set_colliders(f.hair, many, 2, 0), HAIR_ERROR_ARGUMENT, "collider stride is 0");
    struct {
        const char* words;
        hair_collider collider;
    } wrong[] = {{"colliders[1].shape is 9", good},        {"colliders[1].position[2] is ", good},
                 {"colliders[1].rotation has norm", good}, {"colliders[1].size[0] is 0", good},
                 {"colliders[1].size[0] is ", good},       {"colliders[1].size[1] is -1", good}};
    wrong[0].collider.shape = (hair_shape)9;
    wrong[1].collider.position[2] = NAN;
    wrong[2].collider.rotation[3] = 0.5f;
    wrong[3].collider.size[0] = 0;
    wrong[4].collider.size[0] = NAN;
    wrong[5].collider.size[1] = -1;
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; ++i) {
        hair_collider two[2] = {good, wrong[i].collider};
        two[0].size[0] = 0.3f;
        refused(f.test, hair_set_colliders(f.hair, two, 2, sizeof good), HAIR_ERROR_ARGUMENT, wrong[i].words);
        assert_int_equal(f.hair->sim.colliders.current.count, 1);
        assert_memory_equal(&f.hair->sim.colliders.current.collider[0], &good, sizeof good);
    }
    hair_test_scene_free(&f);
}

static void invalid_views_are_refused(void** state)
{
    struct hair_test_scene f = hair_test_scene_of(*state, NULL, NULL);
    hair_view view = hair_view_default();
    hair_light light[5];
    for (int i = 0; i < 5; ++i) light[i] = hair_light_default();
    view.lights = light;
    memset(light[0].direction, 0, sizeof light[0].direction);
    refused(f.test, hair_draw(f.hair, &view), HAIR_ERROR_ARGUMENT, "lights[0].direction has no direction");
    light[0].kind = HAIR_LIGHT_POINT; // A point light needs no direction.
    refused(f.test, hair_draw(f.hair, &view), HAIR_ERROR_OPENGL, "framebuffer is not complete");
    light[0] = hair_light_default();
    view.light_count = 2;
    light[1].kind = HAIR_LIGHT_SPOT;
    light[1].inner_angle = light[1].outer_angle;
    refused(f.test, hair_draw(f.hair, &view), HAIR_ERROR_ARGUMENT,
            "lights[1].inner_angle is 0.5, not below its outer_angle");
    light[1] = hair_light_default();
    light[1].color[2] = NAN;
    refused(f.test, hair_draw(f.hair, &view), HAIR_ERROR_ARGUMENT, "hair_light.color[2] is nan");
    light[1] = (hair_light){0};
    refused(f.test, hair_draw(f.hair, &view), HAIR_ERROR_VERSION, "hair_light.header");
    view.light_count = 1;
    light[0].hair_shadow_map = 1;
    light[0].shadow_matrix[3] = 0.5f;
    refused(f.test, hair_draw(f.hair, &view), HAIR_ERROR_ARGUMENT, "shadow_matrix is not orthographic");
    for (int i = 0; i < 5; ++i) {
        light[i] = hair_light_default();
        light[i].hair_shadow_map = 1;
    }
    view.light_count = 5;
    refused(f.test, hair_draw(f.hair, &view), HAIR_ERROR_ARGUMENT,
            "5 of hair_view.lights have a hair_shadow_map");
    float sky[27] = {[26] = INFINITY};
    view = hair_view_default();
    view.sky = sky;
    refused(f.test, hair_draw(f.hair, &view), HAIR_ERROR_ARGUMENT, "hair_view.sky[26] is inf");

    GLuint cube;
    glCreateTextures(GL_TEXTURE_CUBE_MAP, 1, &cube);
    view = hair_view_default();
    view.lights = light;
    light[0].hair_shadow_map = cube;
    refused(f.test, hair_draw(f.hair, &view), HAIR_ERROR_ARGUMENT, "not a 2D texture");
    glDeleteTextures(1, &cube);
    refused(f.test, hair_draw(f.hair, &view), HAIR_ERROR_ARGUMENT, "not a 2D texture");
    GLuint flat;
    glCreateTextures(GL_TEXTURE_2D, 1, &flat);
    light[0].hair_shadow_map = flat;
    refused(f.test, hair_draw(f.hair, &view), HAIR_ERROR_ARGUMENT, "not a 2D texture of depth");
    glTextureStorage2D(flat, 1, GL_R8, 8, 8);
    refused(f.test, hair_draw(f.hair, &view), HAIR_ERROR_ARGUMENT, "not a 2D texture of depth");
    glDeleteTextures(1, &flat);
    hair_test_scene_free(&f);
}

static void a_failed_call_leaves_the_instance_as_it_was(void** state)
{
    struct hair_test_scene f = hair_test_scene_of(*state, NULL, NULL);
    hair_instance before = *f.hair;
    hair_physics physics = hair_physics_default();
    hair_look look = hair_look_default();
    physics.damping = -1, look.strand.segments = 0;
    hair_set_physics(f.hair, &physics);
    hair_set_look(f.hair, &look);
    hair_set_transform(f.hair, (float[16]){0});
    hair_teleport(f.hair, (float[16]){0});
    hair_step(f.hair, -1);
    hair_load(f.hair, &look, sizeof look);
    assert_int_equal(hair_test_forgive(f.test), 6);
    assert_memory_equal(f.hair, &before, sizeof before);
    hair_test_scene_free(&f);
}

int main(void)
{
    if (hair_test_skips()) return 0;
    const struct CMUnitTest tests[] = {
        HAIR_TEST(null_objects_are_argument_errors),
        HAIR_TEST(null_arguments_are_refused_by_name),
        HAIR_TEST(transforms_that_are_not_rigid_are_refused),
        HAIR_TEST(step_of_negative_or_nan_time_is_refused),
        HAIR_TEST(substep_that_is_too_short_is_refused),
        HAIR_TEST(invalid_colliders_are_named_and_change_nothing),
        HAIR_TEST(invalid_views_are_refused),
        HAIR_TEST(a_failed_call_leaves_the_instance_as_it_was),
    };
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
