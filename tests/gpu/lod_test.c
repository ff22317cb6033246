// lod_test.c - less is drawn of hair that is small or out of view, and the picture does not change
// visibly.
#include "tests/support/scene.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "tests/support/haircut.h"
#include "tests/support/tessellated.h"

// Tools are not linked into tests.
#include "tools/common/image_error.c"

enum { SIDE = 128, PIXELS = SIDE * SIDE, TURNS = 3 };

// Make a built-in haircut of few strands, each as wide as several.
static struct hair_test_scene start(void** state, hair_style style, uint32_t followers, float radius)
{
    struct hair_test_scene f = hair_test_scene_make(*state, NULL);
    f.hair = hair_test_wear(f.test, style, followers, radius, &f.groom);
    return f;
}

// Make a view of the head at a distance, from the front or `turn` radians from it. The picture is
// square.
static hair_view view_from(float distance, float turn)
{
    static const float target[3] = {0, 1.55f, 0};
    hair_view view = hair_test_tessellated();
    view.render_path = HAIR_RENDER_PATH_TESSELLATION; // The other paths draw segments of no length.
    float s = sinf(turn), c = cosf(turn);
    const float rows[3][3] = {{c, 0, -s}, {0, 1, 0}, {s, 0, c}};
    for (int i = 0; i < 3; ++i) {
        view.view[12 + i] = i == 2 ? -distance : 0;
        for (int k = 0; k < 3; ++k) {
            view.view[4 * k + i] = rows[i][k];
            view.view[12 + i] -= rows[i][k] * target[k];
        }
    }
    hair_test_set_perspective(&view, 4, 1); // 28 degrees.
    return view;
}

struct picture {
    float pixels[4 * PIXELS];
    uint64_t primitives; // Triangles, two per segment.
};

static void draw(struct hair_test_scene* f, const hair_view* view, const hair_view* before,
                 struct picture* out)
{
    struct hair_test_frame frame;
    hair_test_frame_make(&frame, SIDE, SIDE, GL_RGBA32F, 4);
    if (before) hair_test_ok(f->test, hair_draw(f->hair, before));
    GLuint query = hair_test_count_begin();
    hair_test_ok(f->test, hair_draw(f->hair, view));
    out->primitives = hair_test_count_end(query);
    hair_test_frame_read(&frame, out->pixels);
    hair_test_frame_free(&frame);
}

// Return the area that strands of one uniform colour cover, in pixels.
static double coverage_of(struct hair_test_scene* f, float distance, const hair_lod* lod)
{
    static struct picture picture;
    double sum = 0;
    for (int turn = 0; turn < TURNS; ++turn) {
        hair_view view = view_from(distance, 2.0f * (float)turn);
        view.lod = lod;
        draw(f, &view, NULL, &picture);
        sum += hair_test_mean_alpha(picture.pixels, 4 * PIXELS);
    }
    return sum / TURNS;
}

static void fewer_strands_cover_as_much_as_all(void** state)
{
    for (hair_style style = HAIR_STYLE_LONG; style < HAIR_STYLE_COUNT; ++style) {
        struct hair_test_scene f = start(state, style, 18000, 1.5e-4f);
        hair_lod lod = hair_lod_default();
        double full = coverage_of(&f, 1.4f, NULL);
        assert_true(full > 0.03);
        lod.per_patch = false;
        for (int k = 0; k < 4; ++k) {
            static const float fractions[] = {0.5f, 0.2f, 0.1f, 0.05f};
            lod.strand_fraction = fractions[k];
            double covered = coverage_of(&f, 1.4f, &lod);
            print_message("    %s, %2.0f %% of the strands: %.4f of the coverage\n", hair_style_name(style),
                          100.0 * (double)fractions[k], covered / full);
            // The worst is a tenth of the strands of a braid, which cover 2.5 % less.
            hair_test_near("coverage", (size_t)k, covered / full, 1, 0.03);
        }
        hair_test_scene_free(&f);
    }
}

// Draw so few curled strands that they hardly overlap. Their coverage is their length times their
// width, and segments that cut curls off are shorter.
static void curls_of_few_segments_cover_as_much_as_all(void** state)
{
    static const hair_look_preset presets[] = {HAIR_LOOK_WAVY, HAIR_LOOK_CURLY};
    for (int i = 0; i < 2; ++i) {
        struct hair_test_scene f = start(state, HAIR_STYLE_LONG, 300, 2e-4f);
        hair_lod lod = hair_lod_default();
        hair_look look = hair_look_default();
        hair_test_ok(f.test, hair_look_apply_preset(&look, presets[i]));
        look.strand.radius = 2e-4f, look.strand.segments = 64;
        hair_test_ok(f.test, hair_set_look(f.hair, &look));
        double full = coverage_of(&f, 1.4f, NULL);
        assert_true(full > 0.005);
        lod.per_patch = false;
        for (int k = 0; k < 3; ++k) {
            static const float fractions[] = {0.4f, 0.2f, 0.1f};
            lod.segment_fraction = fractions[k];
            double covered = coverage_of(&f, 1.4f, &lod);
            print_message("    %s, %2.0f %% of the segments: %.4f of the coverage\n",
                          hair_look_name(presets[i]), 100.0 * (double)fractions[k], covered / full);
            hair_test_near("coverage", (size_t)k, covered / full, 1, 0.07);
        }
        hair_test_scene_free(&f);
    }
}

static float encode(float linear)
{
    float x = fminf(fmaxf(linear, 0), 1);
    return x <= 0.0031308f ? 12.92f * x : 1.055f * powf(x, 1 / 2.4f) - 0.055f;
}

// Average four pixels of a picture into one.
static void develop(const struct picture* picture, float* rgb, unsigned char* mask)
{
    for (int y = 0; y < SIDE / 2; ++y)
        for (int x = 0; x < SIDE / 2; ++x) {
            float sum[4] = {0};
            for (int i = 0; i < 4; ++i)
                for (int k = 0; k < 4; ++k)
                    sum[k] += picture->pixels[4 * ((2 * y + i / 2) * SIDE + 2 * x + i % 2) + k] / 4;
            int at = y * SIDE / 2 + x;
            for (int k = 0; k < 3; ++k) rgb[3 * at + k] = encode(sum[k]);
            mask[at] |= sum[3] > 0;
        }
}

// Return the FLIP error over the hair of both pictures, with a border of 8 pixels.
static double flip_between(const struct picture* a, const struct picture* b)
{
    static float rgb[2][3 * PIXELS / 4];
    unsigned char mask[PIXELS / 4] = {0};
    struct hair_image_error error;
    develop(a, rgb[0], mask);
    develop(b, rgb[1], mask);
    assert_true(hair_mask_dilate(mask, SIDE / 2, SIDE / 2, 8));
    assert_true(hair_image_error(rgb[0], rgb[1], mask, SIDE / 2, SIDE / 2, &error));
    return error.flip;
}

// Check pairs of consecutive frames. Every tenth of 300 frames from 0.9 m to 27 m starts a pair.
static void level_of_detail_changes_smoothly_with_distance(void** state)
{
    enum { FRAMES = 300, EVERY = 10 };
    static struct picture full[2], low[2];
    struct hair_test_scene f = start(state, HAIR_STYLE_LONG, 1500, 1e-3f);
    hair_lod lod = hair_lod_default();
    double max = -1, far = 0;
    uint64_t first = 0;
    for (int i = 0; i < FRAMES; i += EVERY) {
        for (int k = 0; k < 2; ++k) {
            hair_view view = view_from(0.9f * powf(30, (float)(i + k) / FRAMES), 0.5f);
            draw(&f, &view, NULL, &full[k]);
            view.lod = &lod;
            draw(&f, &view, NULL, &low[k]);
        }
        if (i == 0) first = low[0].primitives;
        double more = flip_between(&low[0], &low[1]) - flip_between(&full[0], &full[1]);
        if (more > max) max = more;
        far = flip_between(&full[1], &low[1]);
    }
    print_message("    %u segments become %u, a frame's FLIP at most %.4f more, the last one's %.4f\n",
                  (unsigned)(first / 2), (unsigned)(low[1].primitives / 2), max, far);
    assert_true(max <= 0.005);
    assert_true(10 * low[1].primitives <= first);
    assert_true(far <= 0.03);
    hair_test_scene_free(&f);
}

// Check both sides of a change in the number of segments or strands. The pictures differ by little.
static void strands_and_segments_are_reduced_without_popping(void** state)
{
    static struct picture picture[2];
    struct hair_test_scene f = start(state, HAIR_STYLE_LONG, 600, 2e-3f);
    hair_view view = view_from(1.2f, 0);
    hair_lod lod = hair_lod_default();
    view.lod = &lod;
    lod.per_patch = false;
    for (int k = 0; k < 2; ++k)
        for (int i = 0; i < 2; ++i) {
            float fraction = 0.5f + (i ? 1e-6f : -1e-6f);
            if (k == 0) lod.segment_fraction = fraction;
            if (k == 1) lod.segment_fraction = 1, lod.strand_fraction = fraction;
            draw(&f, &view, NULL, &picture[i]);
            if (i == 0) continue;
            assert_true(picture[0].primitives != picture[1].primitives);
            double sum = 0;
            for (int j = 0; j < 4 * PIXELS; ++j)
                sum += (double)fabsf(picture[0].pixels[j] - picture[1].pixels[j]);
            print_message("    %s: %.2g of a pixel's value\n", k ? "strands" : "segments",
                          sum / (4 * PIXELS));
            assert_true(sum / (4 * PIXELS) < 1e-4);
        }
    hair_test_scene_free(&f);
}

// Check pushing followers out at a distance. A displacement of one pixel starts the effect, and a
// displacement of two pixels shows all of it. On either side of both limits the pictures differ by
// little. Below the first limit no follower is tested.
static void push_out_fades_without_popping(void** state)
{
    static struct picture picture[4];
    // Sizes of 5 mm in the picture.
    static const float pixels[4] = {0.99999f, 1.00001f, 1.99999f, 2.00001f};
    struct hair_test_scene f = start(state, HAIR_STYLE_LONG, 600, 2e-3f);
    hair_view view = view_from(0.9f, 0.5f);
    hair_lod lod = hair_lod_default();
    hair_collider collider = hair_collider_default();
    hair_vec4 head_sphere = f.groom->head_sphere;
    collider.position[0] = head_sphere.x, collider.position[1] = head_sphere.y,
    collider.position[2] = head_sphere.z;
    collider.size[0] = 1.3f * head_sphere.w;
    hair_test_ok(f.test, hair_set_colliders(f.hair, &collider, 1, sizeof collider));
    lod.strand_pixels = 0.01f; // Draws all strands.
    lod.segment_pixels = 0.1f; // Draws all segments.
    view.lod = &lod;
    for (int i = 0; i < 4; ++i) {
        lod.importance = 1;
        draw(&f, &view, NULL, &picture[i]); // Computes the number of pixels per metre.
        lod.importance = pixels[i] / (0.005f * f.hair->renderer.pixels_per_metre);
        hair_test_ok(f.test, hair_set_colliders(f.hair, NULL, 0, sizeof collider));
        hair_test_ok(f.test, hair_set_colliders(f.hair, &collider, 1, sizeof collider));
        uint32_t met = f.hair->geometry.follower_collision.generation;
        draw(&f, &view, NULL, &picture[i]);
        assert_int_equal(f.hair->geometry.follower_collision.generation - met, i > 0);
    }
    for (int i = 0; i < 3; ++i) {
        double sum = 0;
        for (int j = 0; j < 4 * PIXELS; ++j)
            sum += (double)fabsf(picture[i].pixels[j] - picture[i + 1].pixels[j]) / (4 * PIXELS);
        print_message("    from %g to %g pixels: %.2g of a pixel's value\n", (double)pixels[i],
                      (double)pixels[i + 1], sum);
        assert_true(i == 1 ? sum > 1e-3 : sum < 1e-4);
    }
    hair_test_scene_free(&f);
}

static int differ(const struct picture* a, const struct picture* b)
{
    return memcmp(a->pixels, b->pixels, sizeof a->pixels) != 0;
}

// Return a level of detail so important that only culling removes strands.
static hair_lod only_culling(void)
{
    hair_lod lod = hair_lod_default();
    lod.strand_pixels = 0.01f;
    lod.segment_pixels = 0.1f;
    lod.importance = 1000;
    return lod;
}

// Move the view over a shaking head, so that hair is away from its rest pose. Test with and without
// levels of detail. With free roots, nothing may be left out.
static void only_patches_out_of_view_are_missing(void** state)
{
    static struct picture full, plain, culled;
    hair_physics held = hair_physics_default(), lets_go = held;
    lets_go.root = HAIR_ROOT_FREE;
    struct hair_test_scene f = start(state, HAIR_STYLE_LONG, 2000, 1e-3f);
    hair_lod lod = only_culling();
    uint64_t all = 0, left = 0, undetailed = 0;
    for (int i = -8; i <= 8; ++i) {
        hair_view view = view_from(0.7f, 0.4f);
        float s = sinf(0.9f * (float)i);
        view.view[12] += 0.12f * (float)i;
        view.view[13] += 0.05f * (float)i;
        float head[16] = {cosf(s), 0, -sinf(s), 0, 0, 1, 0, 0, sinf(s), 0, cosf(s), 0, 0, 0, 0, 1};
        hair_test_ok(f.test, hair_set_transform(f.hair, head));
        hair_test_ok(f.test, hair_step(f.hair, 0.1f));
        hair_test_ok(f.test, hair_set_physics(f.hair, &lets_go));
        draw(&f, &view, NULL, &full);
        hair_test_ok(f.test, hair_set_physics(f.hair, &held));
        draw(&f, &view, NULL, &plain);
        view.lod = &lod;
        draw(&f, &view, NULL, &culled);
        assert_false(differ(&full, &plain));
        assert_false(differ(&full, &culled));
        all += full.primitives, left += culled.primitives, undetailed += plain.primitives;
    }
    print_message("    %.2f of the segments left, without levels of detail %.2f\n",
                  (double)left / (double)all, (double)undetailed / (double)all);
    assert_true(left < 0.8 * all);
    assert_true(undetailed < 0.8 * all);

    hair_view away = view_from(-3, 0);
    away.lod = &lod;
    draw(&f, &away, NULL, &culled);
    assert_int_equal(culled.primitives, 0);

    hair_physics physics = hair_physics_default();
    physics.root = HAIR_ROOT_FREE; // The bounds of hair with free roots are unknown.
    hair_test_ok(f.test, hair_set_physics(f.hair, &physics));
    draw(&f, &away, NULL, &culled);
    assert_int_equal(culled.primitives, full.primitives);
    hair_test_scene_free(&f);
}

// Draw the head in front as a collider. The picture then must not miss the strands behind.
static void hair_behind_the_head_is_not_drawn(void** state)
{
    static struct picture full, culled;
    struct hair_test_scene f = start(state, HAIR_STYLE_SHORT, 6000, 3e-4f);
    hair_lod lod = only_culling();
    hair_collider collider = hair_collider_default();
    hair_vec4 head_sphere = f.groom->head_sphere;
    double min = 1;
    print_message("    a skull of %.3f m at (%.3f, %.3f, %.3f)\n", (double)head_sphere.w,
                  (double)head_sphere.x, (double)head_sphere.y, (double)head_sphere.z);
    assert_true(head_sphere.w > 0.05f && head_sphere.w < 0.1f);
    collider.position[0] = head_sphere.x, collider.position[1] = head_sphere.y,
    collider.position[2] = head_sphere.z;
    collider.size[0] = head_sphere.w;
    hair_test_ok(f.test, hair_set_colliders(f.hair, &collider, 1, sizeof collider));
    for (int i = 0; i < 4; ++i) {
        hair_view view = view_from(0.9f, 1.5f * (float)i), before = view;
        before.pass = HAIR_PASS_COLLIDERS;
        view.lod = &lod;
        lod.occluded_importance = 1;
        draw(&f, &view, &before, &full);
        lod.occluded_importance = 0;
        draw(&f, &view, &before, &culled);
        double error = flip_between(&full, &culled),
               left = (double)culled.primitives / (double)full.primitives;
        print_message("    %.2f of the segments left, FLIP %.4f\n", left, error);
        assert_true(error < 0.01);
        if (left < min) min = left;
    }
    assert_true(min < 0.85); // In the view from behind, nothing is occluded.
    hair_test_scene_free(&f);
}

// Return the mean light of the hair in a view. `before` is drawn first in the same step.
static double light_of(struct hair_test_scene* f, const hair_view* view, const hair_view* before)
{
    static struct picture picture;
    double light = 0, alpha = 0;
    hair_test_ok(f->test, hair_step(f->hair, 1e-4f)); // Discards what earlier views have computed.
    draw(f, view, before, &picture);
    for (int i = 0; i < 4 * PIXELS; i += 4)
        light += (double)picture.pixels[i + 1], alpha += (double)picture.pixels[i + 3];
    assert_true(alpha > 20);
    return light / alpha;
}

// Draw hair far away with levels of detail, alone and after a view of all of it, which shares the
// density grid.
static void light_of_a_level_is_the_same_after_a_full_view(void** state)
{
    struct hair_test_scene f = start(state, HAIR_STYLE_LONG, 6000, 2e-4f);
    hair_lod lod = hair_lod_default();
    hair_light light = hair_light_default();
    hair_look look = hair_look_default();
    hair_view full = view_from(6, 0.5f);
    hair_test_ok(f.test, hair_get_look(f.hair, &look));
    look.self_shadow.method = HAIR_SELF_SHADOW_STRANDS;
    hair_test_ok(f.test, hair_set_look(f.hair, &look));
    full.lights = &light;
    full.light_count = 1;
    hair_view level = full;
    level.lod = &lod;
    double alone = light_of(&f, &level, NULL), after = light_of(&f, &level, &full);
    print_message("    mean light %.4f, %.4f after a full view\n", alone, after);
    hair_test_near("light", 0, after / alone, 1, 0.3); // The shared grid has smaller cells.
    hair_test_scene_free(&f);
}

int main(void)
{
    if (hair_test_skips()) return 0;
    const struct CMUnitTest tests[] = {
        HAIR_TEST(fewer_strands_cover_as_much_as_all),
        HAIR_TEST(curls_of_few_segments_cover_as_much_as_all),
        HAIR_TEST(level_of_detail_changes_smoothly_with_distance),
        HAIR_TEST(strands_and_segments_are_reduced_without_popping),
        HAIR_TEST(push_out_fades_without_popping),
        HAIR_TEST(only_patches_out_of_view_are_missing),
        HAIR_TEST(hair_behind_the_head_is_not_drawn),
        HAIR_TEST(light_of_a_level_is_the_same_after_a_full_view),
    };
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
