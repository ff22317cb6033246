// depth_shadow_test.c - light that HAIR_SELF_SHADOW_DEPTH estimates, against that of
// HAIR_SELF_SHADOW_STRANDS, which knows where all strands are. Levels of detail keep this light.
#include "tests/support/scene.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "tests/support/haircut.h"

enum { SIDE = 96, VALUES = 4 * SIDE * SIDE, MAP = 2048, FOLLOWERS = 3000, MANY = 12000, DENSE = 36000 };

#define WIDTH 1.2f // m, radii of all strands, as wide together as those of a head

static const float center[3] = {0, 1.52f, 0};

// Write a view from `turn` radians around the head, and from `rise` radians above.
static void look_from(float turn, float rise, float view[16])
{
    float s = sinf(turn), c = cosf(turn), u = sinf(rise), v = cosf(rise);
    const float rows[3][3] = {{c, 0, -s}, {-s * u, v, -c * u}, {s * v, u, c * v}};
    memset(view, 0, 16 * sizeof *view);
    view[15] = 1;
    for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k) {
            view[4 * k + i] = rows[i][k];
            view[12 + i] -= rows[i][k] * center[k];
        }
}

// Return an orthographic view of 0.7 m.
static hair_view view_from(float turn, float rise)
{
    hair_view view = hair_test_view_by(HAIR_RENDER_PATH_COMPUTE);
    hair_test_set_orthographic(&view, 1 / 0.35f, -1, 0);
    look_from(turn, rise, view.view);
    return view;
}

// Return a sun at `turn` radians from the eye, with a map of the hair.
static hair_light shine(const struct hair_test_scene* f, float turn, const hair_lod* lod, GLuint map)
{
    hair_light light = hair_light_default();
    hair_view view = view_from(turn, 0.44f);
    GLuint framebuffer;
    float clear = 1;
    light.direction[0] = view.view[2], light.direction[1] = view.view[6], light.direction[2] = view.view[10];
    memset(light.shadow_matrix, 0, sizeof light.shadow_matrix);
    for (int c = 0; c < 4; ++c)
        for (int r = 0; r < 4; ++r)
            for (int k = 0; k < 4; ++k)
                light.shadow_matrix[4 * c + r] += view.projection[4 * k + r] * view.view[4 * c + k];
    glCreateFramebuffers(1, &framebuffer);
    glNamedFramebufferTexture(framebuffer, GL_DEPTH_ATTACHMENT, map, 0);
    glClearNamedFramebufferfv(framebuffer, GL_DEPTH, 0, &clear);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glViewport(0, 0, MAP, MAP);
    view.pass = HAIR_PASS_DEPTH;
    view.lod = lod;
    hair_test_ok(f->test, hair_draw(f->hair, &view));
    glBindFramebuffer(GL_FRAMEBUFFER, f->frame.framebuffer);
    glViewport(0, 0, SIDE, SIDE);
    glDeleteFramebuffers(1, &framebuffer);
    light.hair_shadow_map = map;
    return light;
}

// Return a new shadow map.
static GLuint make_map(void)
{
    GLuint map;
    glCreateTextures(GL_TEXTURE_2D, 1, &map);
    glTextureStorage2D(map, 1, GL_DEPTH_COMPONENT32F, MAP, MAP);
    return map;
}

// Dress a head in the built-in long haircut with the curls of a preset.
static struct hair_test_scene start(void** state, hair_look_preset preset, uint32_t followers)
{
    struct hair_test_scene f = hair_test_scene_make(*state, NULL);
    hair_look look;
    float radius = WIDTH / (float)followers;
    f.hair = hair_test_wear(f.test, HAIR_STYLE_LONG, followers, radius, &f.groom);
    look = hair_look_default();
    hair_test_ok(f.test, hair_look_apply_preset(&look, preset));
    look.strand.radius = radius;
    hair_test_ok(f.test, hair_set_look(f.hair, &look));
    hair_test_ok(f.test, hair_step(f.hair, 0));
    hair_test_frame_make(&f.frame, SIDE, SIDE, GL_RGBA32F, 0);
    return f;
}

static void set_method(struct hair_test_scene* f, hair_self_shadow method)
{
    hair_look look = hair_look_default();
    hair_test_ok(f->test, hair_get_look(f->hair, &look));
    look.self_shadow.method = method;
    hair_test_ok(f->test, hair_set_look(f->hair, &look));
}

// Return the mean of green of the hair.
static double brightness(struct hair_test_scene* f, hair_self_shadow method, const hair_light* light,
                         const hair_lod* lod, float sky)
{
    static float pixels[VALUES];
    double sum = 0, covered = 0;
    hair_view view = view_from(0, 0);
    set_method(f, method);
    view.lights = light;
    view.lod = lod;
    view.light_count = 1;
    for (int k = 0; k < 3; ++k) view.ambient[k] = sky;
    hair_test_draw_in(&f->frame, f->test, f->hair, &view, pixels);
    for (int i = 0; i < VALUES; i += 4) sum += (double)pixels[i + 1], covered += (double)pixels[i + 3];
    assert_true(covered > 500);
    return sum / covered;
}

static const hair_look_preset presets[] = {HAIR_LOOK_NATURAL, HAIR_LOOK_CURLY};

static void light_is_near_that_of_counted_strands(void** state)
{
    // Maximum relative differences, with the sun beside the eye, to the side and behind the hair.
    static const double limit[3] = {0.25, 0.28, 0.3}, sky_limit = 0.25;
    for (int i = 0; i < 2; ++i) {
        struct hair_test_scene f = start(state, presets[i], FOLLOWERS);
        GLuint map = make_map();
        for (int k = 0; k < 3; ++k) {
            hair_light sun = shine(&f, 1.5707963f * (float)k, NULL, map);
            double lit = brightness(&f, HAIR_SELF_SHADOW_DEPTH, &sun, NULL, 0);
            double expected = brightness(&f, HAIR_SELF_SHADOW_STRANDS, &sun, NULL, 0);
            for (int c = 0; c < 3; ++c) sun.color[c] = 0;
            double sky = brightness(&f, HAIR_SELF_SHADOW_DEPTH, &sun, NULL, 1);
            double expected_sky = brightness(&f, HAIR_SELF_SHADOW_STRANDS, &sun, NULL, 1);
            print_message("    %s, sun at %d: %+.0f %%, sky %+.0f %%\n", hair_look_name(presets[i]), 90 * k,
                          100 * (lit / expected - 1), 100 * (sky / expected_sky - 1));
            assert_true(fabs(lit / expected - 1) < limit[k]);
            assert_true(fabs(sky / expected_sky - 1) < sky_limit);
        }
        glDeleteTextures(1, &map);
        hair_test_scene_free(&f);
    }
}

// Draw three tenths of the strands, in the picture and in the shadow map. Then draw a level by size
// on the screen, where the map has nearly all strands.
static void level_of_detail_keeps_light(void** state)
{
    // Maximum relative differences of both presets and levels, with the sun beside the eye, to the
    // side and behind the hair.
    static const double limit[2][2][3] = {{{0.04, 0.03, 0.04}, {0.04, 0.03, 0.03}},
                                          {{0.03, 0.07, 0.06}, {0.03, 0.07, 0.07}}};
    static const char* const names[2] = {"3 of 10 strands", "by size"};
    for (int i = 0; i < 2; ++i) {
        struct hair_test_scene f = start(state, presets[i], MANY);
        hair_lod lod[2] = {hair_lod_default(), hair_lod_default()};
        GLuint map = make_map();
        lod[0].strand_fraction = 0.3f, lod[0].per_patch = false;
        lod[1].importance = 2, lod[1].segment_pixels = 0.1f;
        for (int k = 0; k < 3; ++k) {
            hair_light sun = shine(&f, 1.5707963f * (float)k, NULL, map);
            double expected = brightness(&f, HAIR_SELF_SHADOW_STRANDS, &sun, NULL, 0);
            for (int n = 0; n < 2; ++n) {
                sun = shine(&f, 1.5707963f * (float)k, &lod[n], map);
                double lit = brightness(&f, HAIR_SELF_SHADOW_STRANDS, &sun, &lod[n], 0);
                print_message("    %s, sun at %d, %s: %+.1f %%\n", hair_look_name(presets[i]), 90 * k,
                              names[n], 100 * (lit / expected - 1));
                assert_true(fabs(lit / expected - 1) < limit[i][n][k]);
            }
        }
        glDeleteTextures(1, &map);
        hair_test_scene_free(&f);
    }
}

// Dress a head in dense black hair, which shows the light that meets no strand.
static struct hair_test_scene start_black(void** state)
{
    struct hair_test_scene f = start(state, HAIR_LOOK_NATURAL, DENSE);
    hair_look look = hair_look_default();
    hair_test_ok(f.test, hair_get_look(f.hair, &look));
    look.strand.radius = 8e-5f;
    look.strand.taper = hair_curve_line(1, 1);
    for (int c = 0; c < 3; ++c) look.color.root[c] = look.color.tip[c] = 0.02f;
    hair_test_ok(f.test, hair_set_look(f.hair, &look));
    return f;
}

// Draw a twentieth of the strands, in the picture and in the shadow map, with the sun beside the
// eye, and in the light of a sky. Views of the same step would share the density grid of all
// strands.
static void a_twentieth_of_the_strands_keeps_light(void** state)
{
    static const double limit[2] = {0.04, 0.05}; // Maximum relative differences.
    struct hair_test_scene f = start_black(state);
    hair_lod lod = hair_lod_default();
    GLuint map = make_map();
    lod.strand_fraction = 0.05f, lod.per_patch = false;
    for (int k = 0; k < 2; ++k) {
        double light[2];
        for (int n = 0; n < 2; ++n) {
            const hair_lod* level = n ? &lod : NULL;
            hair_test_ok(f.test, hair_step(f.hair, 1e-4f)); // Discards the grid of the view before.
            hair_light sun = shine(&f, 0, level, map);
            for (int c = 0; c < 3 && k; ++c) sun.color[c] = 0;
            light[n] = brightness(&f, HAIR_SELF_SHADOW_STRANDS, &sun, level, k ? 1 : 0);
        }
        print_message("    %s: %+.1f %%\n", k ? "sky" : "sun", 100 * (light[1] / light[0] - 1));
        assert_true(fabs(light[1] / light[0] - 1) < limit[k]);
    }
    glDeleteTextures(1, &map);
    hair_test_scene_free(&f);
}

// Draw few wide strands by size on the screen, where the map has nearly all. A sun behind the hair
// lights its outline, where the eye sees the outer side of each strand.
static void wide_strands_have_the_light_of_their_outer_side(void** state)
{
    static const float importances[2] = {1, 0.7f};
    struct hair_test_scene f = start_black(state);
    hair_lod lod = hair_lod_default();
    GLuint map = make_map();
    for (int k = 0; k < 2; ++k) {
        hair_light sun = shine(&f, 3.1415927f, NULL, map);
        double expected = brightness(&f, HAIR_SELF_SHADOW_STRANDS, &sun, NULL, 0);
        lod.importance = importances[k];
        sun = shine(&f, 3.1415927f, &lod, map);
        double lit = brightness(&f, HAIR_SELF_SHADOW_STRANDS, &sun, &lod, 0);
        print_message("    importance %g: %+.1f %%\n", (double)lod.importance, 100 * (lit / expected - 1));
        assert_true(fabs(lit / expected - 1) < 0.09); // It is 0.12 without the outer side.
    }
    glDeleteTextures(1, &map);
    hair_test_scene_free(&f);
}

static double half_of(uint32_t h)
{
    uint32_t exponent = h >> 10 & 31, fraction = h & 1023;
    return exponent ? ldexp(1024 + fraction, (int)exponent - 25) : ldexp(fraction, -24);
}

// Return the mean over all vertices of how parallel strands are, which passes measure.
static double measured_order(struct hair_test_scene* f)
{
    const struct hair_self_shadow_state* own = &f->hair->lighting.self_shadow;
    hair_light light = hair_light_default();
    GLint size;
    double sum = 0;
    brightness(f, HAIR_SELF_SHADOW_STRANDS, &light, NULL, 1);
    glGetNamedBufferParameteriv(own->light, GL_BUFFER_SIZE, &size);
    uint32_t* numbers = malloc((size_t)size);
    assert_non_null(numbers);
    glGetNamedBufferSubData(own->light, 0, size, numbers);
    size_t vertices = FOLLOWERS * (f->hair->geometry.look.strand.segments + 1);
    assert_true(2 * vertices * sizeof *numbers <= (size_t)size);
    for (size_t i = 0; i < vertices; ++i) sum += half_of(numbers[2 * i] >> 16);
    free(numbers);
    return sum / (double)vertices;
}

static void order_is_near_that_of_vertices(void** state)
{
    static const hair_look_preset all[] = {HAIR_LOOK_WAVY, HAIR_LOOK_CURLY, HAIR_LOOK_FRIZZY};
    for (size_t i = 0; i < sizeof all / sizeof *all; ++i) {
        struct hair_test_scene f = start(state, all[i], FOLLOWERS);
        double order = (double)hair_lighting_order(&f.hair->lighting, &f.hair->geometry.look);
        double expected = measured_order(&f);
        print_message("    %s: %.3f, measured %.3f\n", hair_look_name(all[i]), order, expected);
        assert_true(fabs(order - expected) < 0.12);
        hair_test_scene_free(&f);
    }
}

// A small picture does not show that a collider pushes hair out, but a detailed map does. Light
// must not pass beside the hair.
static void hair_is_lit_where_its_map_has_it(void** state)
{
    struct hair_test_scene f = start(state, HAIR_LOOK_NATURAL, FOLLOWERS);
    hair_collider skull = hair_collider_default();
    hair_lod lod = hair_lod_default();
    GLuint map;
    skull.size[0] = 1.1f * f.groom->head_sphere.w;
    for (int k = 0; k < 3; ++k) skull.position[k] = (&f.groom->head_sphere.x)[k];
    hair_test_ok(f.test, hair_set_colliders(f.hair, &skull, 1, sizeof skull));
    hair_test_ok(f.test, hair_step(f.hair, 1e-4f));
    map = make_map();
    lod.strand_pixels = 0.01f, lod.segment_pixels = 0.1f; // Draws all strands and segments.
    for (int k = 0; k < 3; ++k) {
        hair_light sun = shine(&f, 0.7853982f * (float)k, NULL, map);
        double expected = brightness(&f, HAIR_SELF_SHADOW_STRANDS, &sun, NULL, 0);
        sun = shine(&f, 0.7853982f * (float)k, &lod, map);
        double lit = brightness(&f, HAIR_SELF_SHADOW_STRANDS, &sun, &lod, 0);
        print_message("    sun at %d: %+.1f %%\n", 45 * k, 100 * (lit / expected - 1));
        assert_true(fabs(lit / expected - 1) < 0.03);
    }
    glDeleteTextures(1, &map);
    hair_test_scene_free(&f);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        HAIR_TEST(hair_is_lit_where_its_map_has_it),
        HAIR_TEST(light_is_near_that_of_counted_strands),
        HAIR_TEST(level_of_detail_keeps_light),
        HAIR_TEST(a_twentieth_of_the_strands_keeps_light),
        HAIR_TEST(wide_strands_have_the_light_of_their_outer_side),
        HAIR_TEST(order_is_near_that_of_vertices),
    };
    if (hair_test_skips()) return 0;
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
