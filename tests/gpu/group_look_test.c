// group_look_test.c - groups of strands with radii and colours of their own in one instance.
#include "tests/support/scene.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tests/support/grooms.h"
#include "tests/support/render_paths.h"

#define SIDE 240
#define GROUPS 3

// Return the view of three vertical strands, each in a third of the picture.
static hair_view front(hair_render_path path)
{
    hair_view view = hair_test_view_by(path);
    hair_test_set_orthographic(&view, 10, 3, 0);
    return view;
}

static hair_look plain_look(void)
{
    hair_look look = hair_look_default();
    look.strand.radius = 5e-3f, look.strand.segments = 8;
    look.strand.taper = hair_curve_line(1, 1);
    look.color.spread = look.color.hue_spread = look.color.streaks = 0;
    look.shading.model = HAIR_SHADING_LINES;
    look.shading.specular[0] = look.shading.specular[1] = 0;
    return look;
}

// Add one strand of each group with a radius. All distances are multiplied by `size`. Green colours
// of the groom are optional.
static struct hair_test_scene start_with(struct hair_test* test, const hair_look* look, float size,
                                         const float radii[GROUPS], bool is_green)
{
    static const uint8_t groups[GROUPS] = {0, 1, 2};
    static const float green[3 * GROUPS] = {0, 1, 0, 0, 1, 0, 0, 1, 0};
    struct hair_test_scene scene = hair_test_scene_make(test, NULL);
    struct hair_test_strands strands = hair_test_strands_make(GROUPS, 4);
    for (int g = 0; g < GROUPS; ++g)
        for (int k = 0; k < 4; ++k)
            hair_store3(strands.positions + 3 * strands.vertex_count++,
                        hair_v3(0.06f * size * (float)(g - 1), size * (0.1f - 0.06f * (float)k), 0));
    for (int g = 0; g < GROUPS; ++g) strands.vertices[strands.count++] = 4;
    strands.groups = groups;
    hair_groom_desc desc = hair_test_groom_desc(&test->host, &strands);
    desc.strand_radii = radii, desc.guide_count = GROUPS;
    if (is_green) desc.colors = green, desc.color_count = 1;
    scene.groom = hair_test_groom_of(&desc);
    hair_desc of = hair_desc_default();
    of.look = look;
    hair_test_ok(test, hair_create(test->context, scene.groom, &of, &scene.hair));
    hair_test_strands_free(&strands);
    return scene;
}

static struct hair_test_scene start(struct hair_test* test, const hair_look* look, bool is_green)
{
    static const float radii[GROUPS] = {1, 1, 1};
    return start_with(test, look, 1, radii, is_green);
}

static void set_radius(const struct hair_test_scene* scene, uint32_t group, float radius)
{
    hair_group_look look = hair_group_look_default();
    look.radius = radius;
    hair_test_ok(scene->test, hair_set_group_look(scene->hair, group, &look));
}

static void set_color(const struct hair_test_scene* scene, uint32_t group, float red, float green, float blue)
{
    hair_group_look look = hair_group_look_default();
    look.color.enabled = true;
    hair_store3(look.color.root, hair_v3(red, green, blue));
    hair_store3(look.color.tip, hair_v3(red, green, blue));
    hair_test_ok(scene->test, hair_set_group_look(scene->hair, group, &look));
}

// Measure the widths of the strands in the middle row, in pixels.
static void measure_widths(const struct hair_test_scene* scene, int width[GROUPS])
{
    static uint32_t ids[4 * SIDE * SIDE];
    hair_view view = front(HAIR_RENDER_PATH_AUTO);
    hair_test_draw_ids(scene->test, scene->hair, &view, SIDE, ids);
    memset(width, 0, GROUPS * sizeof *width);
    for (int x = 0; x < SIDE; ++x)
        if (ids[4 * (SIDE / 2 * SIDE + x)]) ++width[GROUPS * x / SIDE];
}

static void radius_of_a_group_is_a_factor_in_pixels(void** state)
{
    hair_look look = plain_look();
    struct hair_test_scene scene = start(*state, &look, false);
    int width[GROUPS];
    const int own = (int)(2 * 5e-3 * 10 * SIDE / 2 + 0.5);
    measure_widths(&scene, width);
    for (int g = 0; g < GROUPS; ++g) assert_in_range(width[g], own - 1, own + 1);
    set_radius(&scene, 1, 3);
    set_radius(&scene, 2, 0.5f);
    measure_widths(&scene, width);
    printf("%d, %d and %d pixels\n", width[0], width[1], width[2]);
    assert_in_range(width[0], own - 1, own + 1);
    assert_in_range(width[1], 3 * own - 1, 3 * own + 1);
    assert_in_range(width[2], own / 2 - 1, own / 2 + 1);
    hair_test_ok(scene.test, hair_set_group_look(scene.hair, 1, NULL));
    measure_widths(&scene, width);
    assert_in_range(width[1], own - 1, own + 1);
    hair_test_scene_free(&scene);
}

// Count the pixels of a picture by a view whose middle is `beside` metres from the middle strand.
static int count_pixels(const struct hair_test_scene* scene, hair_render_path path, const hair_lod* lod,
                        float beside)
{
    static float pixels[4 * SIDE * SIDE];
    hair_view view = front(path);
    view.view[12] = -beside, view.lod = lod;
    hair_test_draw(scene, &view, SIDE, SIDE, 0, pixels, NULL);
    int count = 0;
    for (int i = 0; i < SIDE * SIDE; ++i) count += pixels[4 * i + 3] > 0;
    return count;
}

// Draw a short strand beside the view that reaches into it, because taper, groom and group each
// widen it. The strand covers the left tenth of the view's width.
static void wide_groups_beside_the_view_are_drawn(void** state)
{
    static const float radii[GROUPS] = {0.1f, 0.1f, 2.8f};
    const float size = 0.1f, by_taper = 4, by_group = 4, by_groom = 2.8f;
    hair_look look = plain_look();
    look.strand.radius = 0.01f;
    look.strand.taper = hair_curve_line(by_taper, by_taper);
    struct hair_test_scene scene = start_with(*state, &look, size, radii, false);
    const float radius = by_taper * by_group * by_groom * look.strand.radius;
    hair_lod lod = hair_lod_default();
    lod.min_strand_fraction = 1;
    for (int path = 0; path < HAIR_TEST_PATHS; ++path)
        for (int detail = 0; detail < 2; ++detail) {
            const hair_lod* own = detail ? &lod : NULL;
            float beside = 0.06f * size + radius + 0.08f;
            set_radius(&scene, 2, 1);
            assert_int_equal(count_pixels(&scene, hair_test_paths[path], own, beside), 0);
            set_radius(&scene, 2, by_group);
            assert_true(count_pixels(&scene, hair_test_paths[path], own, beside) > 300);
        }
    hair_test_scene_free(&scene);
}

// Sum up the colours in the third of each strand.
static void sum_colors(const struct hair_test_scene* scene, hair_render_path path, double sum[GROUPS][3])
{
    static float pixels[4 * SIDE * SIDE];
    hair_view view = front(path);
    hair_test_draw(scene, &view, SIDE, SIDE, 0, pixels, NULL);
    memset(sum, 0, GROUPS * sizeof *sum);
    for (int i = 0; i < SIDE * SIDE; ++i)
        for (int c = 0; c < 3; ++c) sum[GROUPS * (i % SIDE) / SIDE][c] += (double)pixels[4 * i + c];
}

static void assert_is_only(const double sum[3], int color)
{
    for (int c = 0; c < 3; ++c)
        if (c == color ? !(sum[c] > 1) : sum[c] != 0)
            fail_msg("%g red, %g green and %g blue, not only colour %d", sum[0], sum[1], sum[2], color);
}

// Draw a red group and a blue group beside one with the colours of the groom or of the look, by all
// paths.
static void color_of_a_group_replaces_those_of_groom_and_look(void** state)
{
    hair_look look = plain_look();
    for (int is_green = 0; is_green < 2; ++is_green) {
        struct hair_test_scene scene = start(*state, &look, is_green);
        double before[GROUPS][3], sum[GROUPS][3];
        sum_colors(&scene, HAIR_RENDER_PATH_CACHED, before);
        set_color(&scene, 1, 1, 0, 0);
        set_color(&scene, 2, 0, 0, 1);
        for (int path = 0; path < HAIR_TEST_PATHS; ++path) {
            if (!is_green && path != HAIR_TEST_CACHED) continue;
            sum_colors(&scene, hair_test_paths[path], sum);
            if (is_green) assert_is_only(sum[0], 1);
            assert_is_only(sum[1], 0);
            assert_is_only(sum[2], 2);
        }
        sum_colors(&scene, HAIR_RENDER_PATH_CACHED, sum);
        assert_memory_equal(sum[0], before[0], sizeof sum[0]);
        // Without the groom's colours, group 0 has the look's, and the others keep their own.
        look.color.groom_colors = 0;
        hair_test_ok(scene.test, hair_set_look(scene.hair, &look));
        sum_colors(&scene, HAIR_RENDER_PATH_CACHED, sum);
        assert_true(sum[0][0] > 1);
        assert_is_only(sum[1], 0);
        look.color.groom_colors = 1;
        hair_test_ok(scene.test, hair_set_look(scene.hair, &look));
        for (uint32_t g = 0; g < GROUPS; ++g)
            hair_test_ok(scene.test, hair_set_group_look(scene.hair, g, NULL));
        sum_colors(&scene, HAIR_RENDER_PATH_CACHED, sum);
        assert_memory_equal(sum, before, sizeof sum);
        hair_test_scene_free(&scene);
    }
}

// Check that the reflectance of hair_get_buffers() follows, and that default looks take no memory.
static void colors_of_groups_are_in_buffers_and_cost_nothing_unused(void** state)
{
    hair_look look = plain_look();
    struct hair_test_scene scene = start(*state, &look, false);
    uint64_t before = hair_test_gpu_bytes(scene.test);
    for (uint32_t g = 0; g < GROUPS; ++g) set_radius(&scene, g, 1);
    assert_int_equal(hair_test_gpu_bytes(scene.test), before);
    for (int is_red = 0; is_red < 2; ++is_red) {
        hair_buffers got = hair_buffers_default();
        uint16_t half[4 * 9 * GROUPS];
        got.attributes = HAIR_ATTRIBUTE_COLOR;
        hair_test_ok(scene.test, hair_get_buffers(scene.hair, HAIR_READ_FOLLOWERS, &got));
        assert_int_equal(got.color.count, 9 * GROUPS);
        glGetNamedBufferSubData(got.color.buffer, 0, sizeof half, half);
        uint32_t red = 0;
        for (uint32_t i = 0; i < 9 * GROUPS; ++i) red += half[4 * i] == 0x3c00 && half[4 * i + 1] == 0;
        assert_int_equal(red, is_red ? 9 : 0);
        set_color(&scene, 1, 1, 0, 0);
    }
    hair_test_scene_free(&scene);
}

// Check that the roots of followers on a skinned scalp stay where the scalp has moved them.
static void followers_on_a_skinned_scalp_stay_with_it(void** state)
{
    static struct hair_test_points before, after;
    struct hair_test* test = *state;
    struct hair_test_strands strands = hair_test_fur(20);
    struct hair_test_scalp scalp = hair_test_scalp_make(1, 1);
    struct hair_test_scene scene = hair_test_scene_make(test, NULL);
    hair_groom_desc desc = hair_test_groom_desc(&test->host, &strands);
    hair_desc of = hair_desc_default();
    hair_look look = plain_look();
    uint8_t groups[20];
    for (int i = 0; i < 20; ++i) groups[i] = (uint8_t)(i % 2);
    hair_test_set_scalp(&desc, &scalp);
    desc.follower_count = 100, desc.strand_groups = groups;
    scene.groom = hair_test_groom_of(&desc);
    of.look = &look;
    hair_test_ok(test, hair_create(test->context, scene.groom, &of, &scene.hair));
    float skinned[12];
    for (int i = 0; i < 12; ++i) skinned[i] = scalp.positions[i] * (i % 3 ? 1 : 1.3f);
    hair_test_ok(test, hair_set_scalp(scene.hair, skinned, 4, 12, NULL));
    hair_test_ok(test, hair_step(scene.hair, 1.0f / 60));
    hair_test_read_points(test, scene.hair, HAIR_READ_FOLLOWERS, &before);
    set_radius(&scene, 1, 2);
    hair_test_read_points(test, scene.hair, HAIR_READ_FOLLOWERS, &after);
    assert_int_equal(after.count, before.count);
    assert_true(hair_test_points_distance(&before, &after) < 1e-6);
    hair_test_scene_free(&scene);
    hair_test_scalp_free(&scalp);
    hair_test_strands_free(&strands);
}

static void wrong_looks_of_groups_are_refused(void** state)
{
    hair_look look = plain_look();
    struct hair_test_scene scene = start(*state, &look, false);
    struct hair_test* test = scene.test;
    hair_group_look own = hair_group_look_default(), got = own;
    own.color.enabled = true, own.radius = 2;
    hair_test_ok(test, hair_set_group_look(scene.hair, 5, &own));
    hair_test_ok(test, hair_get_group_look(scene.hair, 5, &got));
    assert_memory_equal(&got, &own, sizeof own);
    own.radius = 5;
    hair_test_refused(test, hair_set_group_look(scene.hair, 5, &own), HAIR_ERROR_ARGUMENT,
                      "hair_group_look.radius is 5, not in [0, 4]");
    own.radius = 1, own.color.tip[2] = NAN;
    hair_test_refused(test, hair_set_group_look(scene.hair, 5, &own), HAIR_ERROR_ARGUMENT,
                      "hair_group_look.color.tip[2] is nan, not in [0, 1]");
    hair_test_refused(test, hair_set_group_look(scene.hair, 8, NULL), HAIR_ERROR_ARGUMENT,
                      "group is 8, not in [0, 7]");
    hair_test_refused(test, hair_get_group_look(scene.hair, 9, &got), HAIR_ERROR_ARGUMENT,
                      "group is 9, not in [0, 7]");
    hair_test_ok(test, hair_get_group_look(scene.hair, 5, &got));
    assert_true(got.radius == 2 && got.color.enabled);
    // Without memory for the colours, the followers made for the radius are given up too.
    uint64_t bytes = hair_test_gpu_bytes(test), followers = 96 * GROUPS + 16 * HAIR_SHAPE_TEXELS(4) * GROUPS;
    own.radius = 3, own.color.tip[2] = 1;
    hair_test_ok(test, hair_set_memory_limit(test->context, bytes + followers));
    hair_test_refused(test, hair_set_group_look(scene.hair, 1, &own), HAIR_ERROR_MEMORY, "hair colours");
    hair_test_ok(test, hair_set_memory_limit(test->context, 0));
    hair_test_ok(test, hair_get_group_look(scene.hair, 1, &got));
    assert_true(got.radius == 1 && !got.color.enabled);
    assert_int_equal(hair_test_gpu_bytes(test), bytes);
    assert_int_equal(hair_set_group_look(NULL, 0, NULL), HAIR_ERROR_ARGUMENT);
    assert_int_equal(hair_get_group_look(NULL, 0, &got), HAIR_ERROR_ARGUMENT);
    hair_test_scene_free(&scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        HAIR_TEST(radius_of_a_group_is_a_factor_in_pixels),
        HAIR_TEST(wide_groups_beside_the_view_are_drawn),
        HAIR_TEST(color_of_a_group_replaces_those_of_groom_and_look),
        HAIR_TEST(colors_of_groups_are_in_buffers_and_cost_nothing_unused),
        HAIR_TEST(followers_on_a_skinned_scalp_stay_with_it),
        HAIR_TEST(wrong_looks_of_groups_are_refused),
    };
    if (hair_test_skips()) return 0;
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
