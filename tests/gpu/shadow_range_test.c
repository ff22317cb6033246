// shadow_range_test.c - shadow maps of any range and direction of depth give the same picture,
// whatever the range and direction of the view.
#include "tests/support/scene.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define SIZE 96
#define TEXELS 128
#define HALF 0.5f // Half of the side of the visible square, m.

// Range and direction of depth.
struct convention {
    bool is_zero_to_one, is_reversed;
};

static const struct convention conventions[] = {{false, false}, {false, true}, {true, false}, {true, true}};

struct fixture {
    struct hair_test_scene scene;
    hair_light light;
    float ours[16]; // Transform to the light's clip space, -1 near the light and 1 far from it.
    float pixels[4 * SIZE * SIZE], expected[4 * SIZE * SIZE];
};

static void set_depth(struct convention as)
{
    glClipControl(GL_LOWER_LEFT, as.is_zero_to_one ? GL_ZERO_TO_ONE : GL_NEGATIVE_ONE_TO_ONE);
    glDepthFunc(as.is_reversed ? GL_GREATER : GL_LESS);
}

// Convert a matrix of clip space from -1 near to 1 far.
static void convert(const float from[16], struct convention as, float to[16])
{
    memcpy(to, from, 16 * sizeof *to);
    for (int i = 0; i < 16; i += 4) {
        if (as.is_reversed) to[i + 2] = -to[i + 2];
        if (as.is_zero_to_one) to[i + 2] = 0.5f * (to[i + 3] + to[i + 2]);
    }
}

static void start(struct fixture* f, struct hair_test* test, hair_self_shadow method, bool is_lamp)
{
    struct hair_test_handmade wanted = hair_test_handmade_default();
    hair_look look = hair_look_default();
    float near = 0.2f, far = 2;
    memset(f, 0, sizeof *f);
    wanted.followers = 160;
    look.strand.segments = 8, look.strand.radius = 0.003f, look.self_shadow.method = method;
    f->scene = hair_test_scene_of(test, &wanted, &look);
    hair_test_set_orthographic(&f->scene.view, 1 / HALF, -0.5f, 0);
    hair_test_frame_make(&f->scene.frame, SIZE, SIZE, GL_RGBA32F, 0);
    for (int i = 0; i < 3; ++i) f->scene.view.ambient[i] = 0;
    f->light = hair_light_default();
    f->light.direction[0] = 1, f->light.direction[1] = f->light.direction[2] = 0;
    // The light is on +x. Columns of the map are along y, and rows along z.
    f->ours[4] = f->ours[9] = 1 / HALF, f->ours[2] = -1, f->ours[15] = 1;
    if (!is_lamp) return;
    f->light.kind = HAIR_LIGHT_SPOT;
    f->light.position[0] = 1;
    f->ours[3] = -1;
    f->ours[2] = -(far + near) / (far - near);
    f->ours[14] = -f->ours[2] - 2 * far * near / (far - near);
}

// Draw the map as the application would.
static void draw_map(struct fixture* f, struct convention as)
{
    GLuint framebuffer, map;
    hair_view view = hair_view_default();
    float clear = as.is_reversed ? 0 : 1;
    glCreateTextures(GL_TEXTURE_2D, 1, &map);
    glTextureStorage2D(map, 1, GL_DEPTH_COMPONENT32F, TEXELS, TEXELS);
    glCreateFramebuffers(1, &framebuffer);
    glNamedFramebufferTexture(framebuffer, GL_DEPTH_ATTACHMENT, map, 0);
    glClearNamedFramebufferfv(framebuffer, GL_DEPTH, 0, &clear);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glViewport(0, 0, TEXELS, TEXELS);
    set_depth(as);
    convert(f->ours, as, f->light.shadow_matrix);
    memcpy(view.projection, f->light.shadow_matrix, sizeof view.projection);
    view.pass = HAIR_PASS_DEPTH;
    hair_test_ok(f->scene.test, hair_draw(f->scene.hair, &view));
    f->light.hair_shadow_map = map;
    f->light.shadow_depth_range =
        as.is_zero_to_one ? HAIR_DEPTH_RANGE_ZERO_TO_ONE : HAIR_DEPTH_RANGE_NEGATIVE_ONE_TO_ONE;
    f->light.shadow_depth_reversed = as.is_reversed;
    glDeleteFramebuffers(1, &framebuffer);
}

static void draw(struct fixture* f, struct convention as, float* pixels)
{
    float black[4] = {0}, clear = as.is_reversed ? 0 : 1;
    hair_view view = f->scene.view;
    view.lights = &f->light;
    convert(f->scene.view.projection, as, view.projection);
    glBindFramebuffer(GL_FRAMEBUFFER, f->scene.frame.framebuffer);
    glViewport(0, 0, SIZE, SIZE);
    set_depth(as);
    glClearNamedFramebufferfv(f->scene.frame.framebuffer, GL_COLOR, 0, black);
    glClearNamedFramebufferfv(f->scene.frame.framebuffer, GL_DEPTH, 0, &clear);
    hair_test_ok(f->scene.test, hair_draw(f->scene.hair, &view));
    hair_test_frame_read(&f->scene.frame, pixels);
}

static double mean(const float* pixels)
{
    double sum = 0;
    for (int i = 0; i < 4 * SIZE * SIZE; ++i) sum += i % 4 < 3 ? (double)pixels[i] : 0;
    return sum;
}

static double difference(const float* a, const float* b)
{
    double sum = 0;
    for (int i = 0; i < 4 * SIZE * SIZE; ++i) sum += i % 4 < 3 ? fabs((double)a[i] - (double)b[i]) : 0;
    return sum / mean(b);
}

static void finish(struct fixture* f)
{
    set_depth(conventions[0]);
    hair_test_scene_free(&f->scene);
    free(f);
}

// Depths round differently in each convention, and a few texels of the map then differ.
static void check(struct hair_test* test, hair_self_shadow method, bool is_lamp)
{
    struct fixture* f = malloc(sizeof *f);
    start(f, test, method, is_lamp);
    draw(f, conventions[0], f->expected);
    double lit = mean(f->expected);
    draw_map(f, conventions[0]);
    draw(f, conventions[0], f->expected);
    print_message("    %.3f of the light without a map\n", mean(f->expected) / lit);
    // There are shadows. The other method has them without a map.
    if (method == HAIR_SELF_SHADOW_DEPTH) assert_true(mean(f->expected) < 0.95 * lit);
    double max = 0;
    for (int map = 0; map < 4; ++map) {
        glDeleteTextures(1, &f->light.hair_shadow_map);
        draw_map(f, conventions[map]);
        for (int view = 0; view < 4; ++view) {
            draw(f, conventions[view], f->pixels);
            double wrong = difference(f->pixels, f->expected);
            if (wrong > max) max = wrong;
            if (!(wrong < 1e-4)) fail_msg("map %d and view %d differ by %g of the light", map, view, wrong);
        }
    }
    print_message("    at most %g of the light differs\n", max);
    glDeleteTextures(1, &f->light.hair_shadow_map);
    finish(f);
}

static void every_depth_convention_gives_the_same_self_shadow(void** state)
{
    check(*state, HAIR_SELF_SHADOW_DEPTH, false);
    check(*state, HAIR_SELF_SHADOW_DEPTH, true);
    check(*state, HAIR_SELF_SHADOW_STRANDS, false);
    check(*state, HAIR_SELF_SHADOW_STRANDS, true);
}

// A map that was drawn under the view's clip control needs no range.
static void current_range_is_that_of_the_view(void** state)
{
    struct fixture* f = malloc(sizeof *f);
    struct convention unit = {true, false}, reversed = {true, true};
    start(f, *state, HAIR_SELF_SHADOW_DEPTH, false);
    draw_map(f, unit);
    draw(f, unit, f->expected);
    f->light.shadow_depth_range = HAIR_DEPTH_RANGE_CURRENT;
    draw(f, unit, f->pixels);
    assert_memory_equal(f->pixels, f->expected, sizeof f->pixels);
    draw(f, reversed, f->pixels);
    assert_true(difference(f->pixels, f->expected) < 1e-4);
    draw(f, conventions[0], f->pixels);
    assert_true(difference(f->pixels, f->expected) > 0.05); // The range is wrong.
    glDeleteTextures(1, &f->light.hair_shadow_map);
    finish(f);
}

// Opaque geometry beside the map, whose border is far away, blocks nothing.
static void places_beside_a_reversed_opaque_map_are_lit(void** state)
{
    struct fixture* f = malloc(sizeof *f);
    start(f, *state, HAIR_SELF_SHADOW_DEPTH, false);
    draw(f, conventions[0], f->expected);
    draw_map(f, conventions[3]);
    f->light.opaque_shadow_map = f->light.hair_shadow_map;
    f->light.hair_shadow_map = 0;
    f->light.shadow_matrix[12] = 100; // No hair is in the map.
    draw(f, conventions[0], f->pixels);
    assert_true(difference(f->pixels, f->expected) < 1e-6);
    glDeleteTextures(1, &f->light.opaque_shadow_map);
    finish(f);
}

static void depth_against_the_light_is_refused(void** state)
{
    for (int is_lamp = 0; is_lamp < 2; ++is_lamp)
        for (int i = 0; i < 4; ++i) {
            struct fixture* f = malloc(sizeof *f);
            hair_view view = hair_view_default();
            start(f, *state, HAIR_SELF_SHADOW_DEPTH, is_lamp);
            draw_map(f, conventions[i]);
            f->light.shadow_depth_reversed = !f->light.shadow_depth_reversed;
            view.lights = &f->light;
            glBindFramebuffer(GL_FRAMEBUFFER, f->scene.frame.framebuffer);
            hair_test_refused(f->scene.test, hair_draw(f->scene.hair, &view), HAIR_ERROR_ARGUMENT,
                              "depth that grows away from the light");
            glDeleteTextures(1, &f->light.hair_shadow_map);
            finish(f);
        }
}

int main(void)
{
    if (hair_test_skips()) return 0;
    const struct CMUnitTest tests[] = {
        HAIR_TEST(every_depth_convention_gives_the_same_self_shadow),
        HAIR_TEST(current_range_is_that_of_the_view),
        HAIR_TEST(places_beside_a_reversed_opaque_map_are_lit),
        HAIR_TEST(depth_against_the_light_is_refused),
    };
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
