// view_memory_test.c - memory that follows the size of hair on the screen: the vertices of a view,
// and the field of colliders.
#include "tests/support/scene.h"

#include <math.h>
#include <string.h>

#include "lib/api/api.h"

#define SIDE 64
#define FOLLOWERS 4000
#define VIEWS 150

static struct hair_test_scene make_scene(struct hair_test* test)
{
    struct hair_test_handmade groom = hair_test_handmade_default();
    hair_look look = hair_look_default();
    groom.followers = FOLLOWERS;
    groom.each = 250;
    look.strand.radius = 2e-4f;
    look.strand.segments = 8;
    struct hair_test_scene scene = hair_test_scene_of(test, &groom, &look);
    scene.view.render_path = HAIR_RENDER_PATH_COMPUTE;
    hair_test_frame_make(&scene.frame, SIDE, SIDE, GL_RGBA32F, 0);
    return scene;
}

static void draw(const struct hair_test_scene* scene)
{
    hair_test_frame_clear(&scene->frame);
    hair_test_ok(scene->test, hair_draw(scene->hair, &scene->view));
}

// Return the number of strands that the GPU has listed for the last view.
static uint32_t count_listed(const struct hair_test_scene* scene)
{
    struct hair_draw_command command = {0};
    hair_gl_read(&scene->test->context->gl, scene->hair->renderer.strand_list.command, sizeof command,
                 &command);
    return command.strands;
}

static uint32_t find_room(const struct hair_test_scene* scene)
{
    return scene->hair->renderer.view_cache.room;
}

static void set_away(struct hair_test_scene* scene, float away)
{
    hair_test_set_perspective(&scene->view, 3, 1);
    scene->view.view[14] = -away;
}

static float any(uint32_t* random, float low, float high)
{
    *random = *random * 1664525u + 1013904223u;
    return low + (high - low) * (float)(*random >> 8) / (1u << 24);
}

static void views_never_list_more_strands_than_fit(void** state)
{
    struct hair_test_scene scene = make_scene(*state);
    uint32_t random = 1, part = 0, small = 0;
    for (int i = 0; i < VIEWS; ++i) {
        hair_lod lod = hair_lod_default();
        lod.strand_fraction = any(&random, 0, 1) < 0.5f ? 1 : any(&random, 0.1f, 1);
        lod.importance = powf(10, any(&random, -1, 1));
        lod.strand_pixels = powf(10, any(&random, -1.5f, 0.5f));
        lod.min_strand_fraction = any(&random, 0.001f, 0.2f);
        lod.per_patch = any(&random, 0, 1) < 0.8f;
        scene.view.lod = &lod;
        set_away(&scene, powf(10, any(&random, -1, 1.5f)));
        if (any(&random, 0, 1) < 0.3f)
            hair_test_set_orthographic(&scene.view, any(&random, 0.1f, 4), 0.01f, 0);
        hair_draw_free_view_cache(&scene.hair->renderer);
        hair_test_ok(scene.test, hair_step(scene.hair, 1.0f / 60));
        draw(&scene);
        uint32_t room = find_room(&scene);
        if (!room) continue; // Out of view.
        assert_true(count_listed(&scene) <= room);
        part += room < FOLLOWERS;
        small += room < FOLLOWERS / 8;
    }
    assert_true(part > VIEWS / 4); // The bound is of some use.
    assert_true(small > VIEWS / 10);
    hair_test_scene_free(&scene);
}

static void memory_follows_the_distance(void** state)
{
    struct hair_test_scene scene = make_scene(*state);
    hair_lod lod = hair_lod_default();
    scene.view.lod = &lod;
    set_away(&scene, 0.3f);
    draw(&scene);
    uint64_t near = hair_test_gpu_bytes(scene.test);
    assert_int_equal(find_room(&scene), FOLLOWERS);
    set_away(&scene, 10);
    for (int i = 0; i < 40; ++i) draw(&scene);
    assert_int_equal(find_room(&scene), FOLLOWERS); // A glance aside makes nothing anew.
    for (int i = 0; i < 40; ++i) draw(&scene);
    assert_true(find_room(&scene) <= FOLLOWERS / 8);
    assert_true(hair_test_gpu_bytes(scene.test) < near - 500000);
    set_away(&scene, 0.3f);
    draw(&scene);
    assert_int_equal(find_room(&scene), FOLLOWERS);
    hair_test_scene_free(&scene);
}

// Let a ball above the hair hide some of it from the light, and draw it from a distance.
static void draw_behind_ball(struct hair_test_scene* scene, float away)
{
    hair_collider ball = hair_collider_default();
    ball.size[0] = 0.1f;
    ball.position[0] = 0.1f, ball.position[1] = 0.3f, ball.position[2] = 0.1f;
    hair_test_ok(scene->test, hair_set_colliders(scene->hair, &ball, 1, sizeof ball));
    hair_test_ok(scene->test, hair_step(scene->hair, 1.0f / 60));
    set_away(scene, away);
    draw(scene);
}

static void read_mean(const struct hair_test_scene* scene, double mean[4])
{
    static float pixels[4 * SIDE * SIDE];
    hair_test_frame_read(&scene->frame, pixels);
    for (int k = 0; k < 4; ++k) mean[k] = 0;
    for (int i = 0; i < 4 * SIDE * SIDE; ++i) mean[i % 4] += (double)pixels[i] / (SIDE * SIDE);
}

static struct hair_test_scene make_lit_scene(struct hair_test* test, const hair_lod* lod)
{
    struct hair_test_scene scene = make_scene(test);
    hair_look look = scene.hair->look;
    look.self_shadow.method = HAIR_SELF_SHADOW_STRANDS;
    hair_test_ok(test, hair_set_look(scene.hair, &look));
    scene.view.lod = lod;
    return scene;
}

// Tangents are only made for views that draw the vertex cache.
static void light_makes_no_tangents(void** state)
{
    hair_lod lod = hair_lod_default();
    struct hair_test_scene scene = make_lit_scene(*state, &lod);
    const struct hair_vertex_cache* cache = &scene.hair->geometry.vertex_cache;
    double before[4], after[4];
    scene.view.light_count = 1;
    set_away(&scene, 2);
    draw(&scene);
    assert_true(cache->position && !cache->tangent);
    scene.view.lod = NULL;
    draw(&scene);
    read_mean(&scene, before);
    assert_true(before[3] > 0 && cache->tangent);
    scene.view.lod = &lod;
    for (int i = 0; i < 80; ++i) {
        hair_test_ok(scene.test, hair_set_look(scene.hair, &scene.hair->look));
        draw(&scene);
    }
    assert_true(cache->position && !cache->tangent);
    scene.view.lod = NULL;
    draw(&scene);
    read_mean(&scene, after);
    for (int k = 0; k < 4; ++k) assert_true(fabs(after[k] - before[k]) < 1e-6);
    hair_test_scene_free(&scene);
}

// Draw moved hair, its depth first, as a list that both views share.
static void draw_depth_and_color(struct hair_test_scene* scene, double mean[4])
{
    hair_test_ok(scene->test, hair_step(scene->hair, 1.0f / 60));
    scene->view.pass = HAIR_PASS_DEPTH;
    draw(scene);
    scene->view.pass = HAIR_PASS_COLOR;
    draw(scene);
    read_mean(scene, mean);
}

// Light of few strands takes little memory, and is that of a cache with room for all strands. The
// list has room for few strands too.
static void expect_same_light(struct hair_test* test, const hair_lod* lod)
{
    struct hair_test_scene scene = make_lit_scene(test, lod);
    const struct hair_vertex_cache* cache = &scene.hair->geometry.vertex_cache;
    const uint32_t followers = scene.hair->geometry.followers;
    const uint32_t* listed = &scene.hair->renderer.strand_list.room;
    double few[4], all[4], again[4];
    scene.view.light_count = 1;
    set_away(&scene, 5);
    draw_depth_and_color(&scene, few);
    assert_true(few[0] > 1e-4);
    assert_true(cache->fraction > 0);
    assert_true(cache->vertices < hair_geometry_count_vertices(&scene.hair->geometry) / 2);
    assert_in_range(*listed, 1, followers / 2);
    uint64_t bytes = hair_test_gpu_bytes(test);
    scene.view.lod = NULL;
    draw(&scene);
    assert_int_equal(cache->fraction, 0);
    assert_int_equal(*listed, followers);
    assert_true(hair_test_gpu_bytes(test) > bytes);
    scene.view.lod = lod;
    draw_depth_and_color(&scene, all);
    assert_int_equal(cache->fraction, 0); // Another view may need all again.
    for (int i = 0; i < 70; ++i) draw_depth_and_color(&scene, again);
    assert_true(cache->fraction > 0);
    assert_in_range(*listed, 1, followers / 2);
    for (int k = 0; k < 4; ++k) {
        assert_float_equal(few[k], all[k], 1e-5);
        assert_float_equal(again[k], all[k], 1e-5);
    }
    hair_test_scene_free(&scene);
}

static void light_of_few_strands_is_the_same(void** state)
{
    hair_lod lod = hair_lod_default();
    lod.light_pixels = 0; // Each view computes its light.
    expect_same_light(*state, &lod);
    lod.per_patch = false; // All views share a list.
    lod.strand_fraction = 0.1f;
    expect_same_light(*state, &lod);
}

// Draw small hair by a shader of the application, `frames` frames after views that found light by
// their list.
static void expect_same_light_in_shader(struct hair_test* test, hair_shader* shader, int frames)
{
    hair_lod lod = hair_lod_default(); // Light is kept for some frames.
    struct hair_test_scene scene = make_lit_scene(test, &lod);
    double own[4], shaded[4];
    scene.view.light_count = 1;
    set_away(&scene, 5);
    for (int i = 0; i <= frames; ++i) draw_depth_and_color(&scene, own);
    assert_true(scene.hair->geometry.vertex_cache.fraction > 0);
    scene.view.shader = shader;
    draw_depth_and_color(&scene, shaded);
    for (int k = 0; k < 4; ++k) assert_float_equal(shaded[k], own[k], 0.25 * own[k]);
    hair_test_scene_free(&scene);
}

// Pixels are shaded with the light of a strand by its number. Pixels have more of the highlights
// than vertices, so the means differ.
static void shader_finds_the_light_of_few_strands(void** state)
{
    struct hair_test* test = *state;
    hair_shader_desc desc = hair_shader_desc_default();
    hair_shader* shader = NULL;
    desc.at = HAIR_SHADE_PIXELS;
    desc.glsl = "vec4 hair_shade(hair_fragment f) { return vec4(hair_shade_ours(f), 1.0); }";
    hair_test_ok(test, hair_shader_create(test->context, &desc, &shader));
    for (int i = 0; i < 4; ++i) expect_same_light_in_shader(test, shader, i);
    hair_shader_destroy(shader);
}

static void far_field_has_fewer_voxels_and_the_same_light(void** state)
{
    hair_lod lod = hair_lod_default();
    lod.light_pixels = 0; // The light changes from draw to draw.
    struct hair_test_scene scene = make_lit_scene(*state, &lod);
    hair_field_info info = hair_field_info_default();
    double coarse[4], fine[4], lit[4];
    hair_test_ok(scene.test, hair_step(scene.hair, 1.0f / 60));
    set_away(&scene, 5);
    draw(&scene);
    read_mean(&scene, lit);
    draw_behind_ball(&scene, 5);
    uint32_t doublings = scene.hair->field_detail.doublings;
    assert_true(doublings > 0);
    read_mean(&scene, coarse);
    assert_true(coarse[3] > 1e-4);
    assert_true(coarse[0] < 0.9 * lit[0]); // The ball matters.
    uint64_t bytes = hair_test_gpu_bytes(scene.test);
    hair_test_ok(scene.test, hair_get_field(scene.hair, &info)); // The application gets all voxels.
    assert_float_equal(info.voxel, scene.hair->field_detail.voxel, 0);
    uint64_t full = hair_test_gpu_bytes(scene.test);
    assert_true(full > bytes);
    draw(&scene);
    assert_int_equal(scene.hair->field_detail.doublings, 0);
    read_mean(&scene, fine);
    for (int k = 0; k < 4; ++k) assert_float_equal(coarse[k], fine[k], 0.02 * fine[k]);
    for (int i = 0; i < 70; ++i) draw_behind_ball(&scene, 5);
    assert_int_equal(scene.hair->field_detail.doublings, doublings);
    assert_true(hair_test_gpu_bytes(scene.test) < bytes + (full - bytes) / 2);
    hair_test_scene_free(&scene);
}

static void near_view_after_a_far_view_is_pushed_out(void** state)
{
    static float alone[4 * SIDE * SIDE], after[4 * SIDE * SIDE];
    hair_lod lod = hair_lod_default();
    for (int is_after = 0; is_after < 2; ++is_after) {
        struct hair_test_scene scene = make_lit_scene(*state, &lod);
        draw_behind_ball(&scene, is_after ? 5 : 0.3f);
        set_away(&scene, 0.3f);
        draw(&scene);
        assert_int_equal(scene.hair->field_detail.doublings, 0);
        hair_test_frame_read(&scene.frame, is_after ? after : alone);
        hair_test_scene_free(&scene);
    }
    assert_float_equal(hair_test_max_difference(alone, after, 4 * SIDE * SIDE), 0, 0);
}

int main(void)
{
    if (hair_test_skips()) return 0;
    const struct CMUnitTest tests[] = {HAIR_TEST(views_never_list_more_strands_than_fit),
                                       HAIR_TEST(memory_follows_the_distance),
                                       HAIR_TEST(light_makes_no_tangents),
                                       HAIR_TEST(light_of_few_strands_is_the_same),
                                       HAIR_TEST(shader_finds_the_light_of_few_strands),
                                       HAIR_TEST(far_field_has_fewer_voxels_and_the_same_light),
                                       HAIR_TEST(near_view_after_a_far_view_is_pushed_out)};
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
