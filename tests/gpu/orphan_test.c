// orphan_test.c - instances and shaders that are left when their context is gone. They are inert:
// calls are refused, and destruction frees memory without OpenGL.
#include "tests/support/scene.h"

#include "tests/support/meshes.h"
#include "tests/support/refused_calls.h"
#include "tests/support/trace.h"
#include "tests/support/ways.h"
#include "tests/support/tessellated.h"

#define refused(result) hair_test_refused(f->test, result, HAIR_ERROR_ARGUMENT, words)

static const char* const words = "its context is destroyed or";

static const char frost[] = "vec4 hair_shade(hair_fragment f) { return vec4(f.t, 0.5, 0.5, 1.0); }\n";

// A context with an instance and a shader that have run and drawn.
struct fixture {
    struct hair_test* test;
    hair_context* context;
    hair_groom* groom;
    hair_instance* hair;
    hair_shader* shader;
    struct hair_test_frame frame;
    uint32_t objects, blocks;
};

static void draw(struct fixture* f)
{
    hair_view view = hair_test_tessellated();
    hair_test_ok(f->test, hair_draw(f->hair, &view));
    view.shader = f->shader;
    view.render_path = HAIR_RENDER_PATH_CACHED;
    hair_test_ok(f->test, hair_draw(f->hair, &view));
}

static hair_collision_mesh* make_ball(struct hair_test* test)
{
    struct hair_test_mesh ball = hair_test_ball_mesh(0.05f, 6, 8);
    hair_collision_mesh_desc desc = hair_collision_mesh_desc_default();
    hair_collision_mesh* mesh = NULL;
    desc.host = &test->host.host;
    desc.positions = ball.positions;
    desc.vertex_count = ball.vertex_count;
    desc.triangles = ball.triangles;
    desc.triangle_count = ball.triangle_count;
    hair_test_ok(test, hair_collision_mesh_create(&desc, &mesh));
    hair_test_mesh_free(&ball);
    return mesh;
}

static void start(struct fixture* f, struct hair_test* test, int way)
{
    hair_desc desc = hair_test_way(way);
    hair_shader_desc shader = hair_shader_desc_default();
    hair_collider collider = {HAIR_SHAPE_MESH, {0, 0.1f, 0}, {0, 0, 0, 1}, {0}, .scale = 1, .friction = 1};
    hair_look look = hair_look_default();
    shader.glsl = frost;
    look.self_shadow.method = HAIR_SELF_SHADOW_STRANDS;
    desc.look = &look;
    desc.label = "fringe";
    *f = (struct fixture){.test = test};
    f->groom = hair_test_groom(&test->host.host, hair_test_handmade_default());
    hair_test_frame_make(&f->frame, 16, 16, GL_RGBA8, 0);
    f->objects = hair_test_count_objects();
    f->blocks = hair_test_blocks(test);
    f->context = hair_test_context(test, hair_test_trace_proc);
    hair_test_ok(test, hair_create(f->context, f->groom, &desc, &f->hair));
    hair_test_ok(test, hair_shader_create(f->context, &shader, &f->shader));
    hair_collision_mesh* mesh = make_ball(test);
    collider.mesh = mesh;
    hair_test_ok(test, hair_set_colliders(f->hair, &collider, 1, sizeof collider));
    hair_collision_mesh_destroy(mesh);
    for (int i = 0; i < 3; ++i) hair_test_ok(test, hair_step(f->hair, 1.0f / 60));
    draw(f);
    hair_test_trace_clear();
}

// Refuse every call on the instance.
static void check_refused(struct fixture* f)
{
    hair_desc desc = hair_desc_default();
    hair_physics physics = hair_physics_default();
    hair_look look = hair_look_default();
    hair_wind wind = hair_wind_default();
    hair_pin pin = hair_pin_default();
    hair_collider collider = hair_collider_default();
    hair_collider_contact contact;
    hair_report_info report = hair_report_info_default();
    hair_target_blend blend = hair_target_blend_default();
    hair_group_look group = hair_group_look_default();
    float positions[30] = {0};
    uint32_t count = 0;
    hair_test_refuse_calls(f->test, f->hair, HAIR_ERROR_ARGUMENT, words);
    refused(hair_set_physics(f->hair, &physics));
    refused(hair_get_physics(f->hair, &physics));
    refused(hair_set_look(f->hair, &look));
    refused(hair_get_look(f->hair, &look));
    refused(hair_set_wind(f->hair, &wind));
    refused(hair_get_wind(f->hair, &wind));
    refused(hair_set_transform(f->hair, desc.transform));
    refused(hair_get_transform(f->hair, desc.transform));
    refused(hair_set_colliders(f->hair, &collider, 1, sizeof collider));
    refused(hair_set_pins(f->hair, &pin, 1, sizeof pin));
    refused(hair_set_scalp(f->hair, positions, 3, 12, NULL));
    refused(hair_set_scalp_buffer(f->hair, 1, 0, 12, NULL));
    refused(hair_set_scalp_weights(f->hair, NULL, NULL, 0, 0));
    refused(hair_set_scalp_joints(f->hair, positions, 1, NULL));
    refused(hair_step(f->hair, 0));
    refused(hair_get_bounds(f->hair, positions, positions + 3));
    refused(hair_report(f->hair, false, &report, NULL, 0, 0, &count));
    refused(hair_get_lengths(f->hair, 0, 1, positions));
    refused(hair_get_contacts(f->hair, true, &contact, sizeof contact, 1, &count));
    refused(hair_set_targets(f->hair, positions, 10, 12, NULL));
    refused(hair_set_target_blend(f->hair, &blend));
    refused(hair_set_group_look(f->hair, 0, &group));
    refused(hair_get_group_look(f->hair, 0, &group));
    refused(hair_set_group_physics(f->hair, 0, &physics));
    refused(hair_get_group_physics(f->hair, 0, &physics));
}

// Destroy what is left, and check that nothing stays.
static void finish(struct fixture* f)
{
    hair_destroy(f->hair);
    hair_shader_destroy(f->shader);
    if (hair_test_trace_count("")) fail_msg("orphans called OpenGL:%s", hair_test_trace_list());
    assert_int_equal(hair_test_blocks(f->test), f->blocks);
    hair_test_frame_free(&f->frame);
    hair_groom_destroy(f->groom);
}

static void orphans_of_a_destroyed_context_are_inert(void** state)
{
    for (int way = 0; way < HAIR_TEST_WAYS; ++way) {
        struct fixture f;
        start(&f, *state, way);
        hair_context_destroy(f.context);
        // The host's OpenGL context goes on, and must not be left with objects of the library.
        assert_int_equal(hair_test_count_objects(), f.objects);
        hair_test_trace_clear();
        check_refused(&f);
        finish(&f);
    }
}

static void abandoned_context_is_inert_without_opengl(void** state)
{
    struct fixture f;
    hair_desc desc = hair_desc_default();
    hair_shader_desc shader = hair_shader_desc_default();
    hair_memory memory = hair_memory_default();
    hair_instance* other = NULL;
    hair_shader* other_shader = NULL;
    const char* said = "the context is abandoned";
    start(&f, *state, 0);
    shader.glsl = frost;
    hair_egl_make_current(NULL);
    hair_context_abandon(f.context);
    hair_context_abandon(f.context);
    hair_context_abandon(NULL);
    check_refused(&f);
    hair_test_refused(f.test, hair_context_reload(f.context), HAIR_ERROR_ARGUMENT, said);
    hair_test_refused(f.test, hair_get_memory(f.context, &memory), HAIR_ERROR_ARGUMENT, said);
    hair_test_refused(f.test, hair_set_memory_limit(f.context, 1), HAIR_ERROR_ARGUMENT, said);
    hair_test_refused(f.test, hair_set_budget(f.context, 1), HAIR_ERROR_ARGUMENT, said);
    hair_test_refused(f.test, hair_create(f.context, f.groom, &desc, &other), HAIR_ERROR_ARGUMENT, said);
    hair_test_refused(f.test, hair_shader_create(f.context, &shader, &other_shader), HAIR_ERROR_ARGUMENT,
                      said);
    assert_int_equal(hair_get_timings(f.context, NULL, 0), 0);
    hair_test_forgive(f.test);
    hair_context_destroy(f.context);
    if (hair_test_trace_count("")) fail_msg("abandoned objects called OpenGL:%s", hair_test_trace_list());
    hair_egl_make_current(f.test->egl);
    assert_true(hair_test_count_objects() > f.objects); // Nothing was deleted.
    finish(&f);
}

static void context_of_a_lost_opengl_context_can_be_replaced(void** state)
{
    struct hair_test* test = *state;
    hair_egl* lost = NULL;
    struct fixture f;
    hair_test_ok(test, hair_egl_create(&test->host.host, -1, &lost));
    start(&f, test, 0);
    hair_egl_destroy(lost);
    hair_context_abandon(f.context);
    hair_egl_make_current(test->egl);
    struct hair_test_scene scene = hair_test_scene_of(test, NULL, NULL);
    hair_test_ok(test, hair_step(scene.hair, 1.0f / 60));
    hair_test_scene_free(&scene);
    hair_context_destroy(f.context);
    hair_destroy(f.hair);
    hair_shader_destroy(f.shader);
    assert_int_equal(hair_test_blocks(test), f.blocks - 1); // hair_egl is gone too.
    hair_groom_destroy(f.groom);
}

static void orphaned_shader_is_of_another_context(void** state)
{
    struct hair_test_scene scene = hair_test_scene_of(*state, NULL, NULL);
    struct fixture f;
    start(&f, *state, 0);
    hair_context_destroy(f.context);
    hair_test_trace_clear();
    hair_view view = hair_test_tessellated();
    view.shader = f.shader;
    hair_test_refused(f.test, hair_draw(scene.hair, &view), HAIR_ERROR_ARGUMENT, "of another context");
    finish(&f);
    hair_test_scene_free(&scene);
}

static void objects_may_go_in_any_order(void** state)
{
    struct hair_test* test = *state;
    hair_groom* groom = hair_test_groom(&test->host.host, hair_test_handmade_default());
    hair_desc desc = hair_desc_default();
    uint32_t objects = hair_test_count_objects(), blocks = hair_test_blocks(test);
    for (int order = 0; order < 24; ++order) { // Four objects, in every order.
        hair_context* context = hair_test_context(test, hair_egl_get_proc);
        hair_instance* hair[3] = {NULL};
        for (int i = 0; i < 3; ++i) hair_test_ok(test, hair_create(context, groom, &desc, &hair[i]));
        int left[4] = {0, 1, 2, 3}, code = order;
        for (int count = 4; count > 0; code /= count--) {
            int at = code % count, object = left[at];
            left[at] = left[count - 1];
            if (object == 3)
                hair_context_destroy(context);
            else
                hair_destroy(hair[object]);
        }
        assert_int_equal(hair_test_count_objects(), objects);
        assert_int_equal(hair_test_blocks(test), blocks);
    }
    hair_groom_destroy(groom);
}

int main(void)
{
    if (hair_test_skips()) return 0;
    const struct CMUnitTest tests[] = {
        HAIR_TEST(orphans_of_a_destroyed_context_are_inert),
        HAIR_TEST(abandoned_context_is_inert_without_opengl),
        HAIR_TEST(context_of_a_lost_opengl_context_can_be_replaced),
        HAIR_TEST(orphaned_shader_is_of_another_context),
        HAIR_TEST(objects_may_go_in_any_order),
    };
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
