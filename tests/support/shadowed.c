// shadowed.c - hair under one light with a shadow map.
#include "tests/support/shadowed.h"
#include "tests/support/tessellated.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define HALF 0.5f // Half of the side of the visible square, m.

const struct hair_test_depth hair_test_depths[4] = {
    {false, false}, {false, true}, {true, false}, {true, true}};

static void set_depth(struct hair_test_depth as)
{
    glClipControl(GL_LOWER_LEFT, as.is_zero_to_one ? GL_ZERO_TO_ONE : GL_NEGATIVE_ONE_TO_ONE);
    glDepthFunc(as.is_reversed ? GL_GREATER : GL_LESS);
}

void hair_test_depth_convert(const float from[16], struct hair_test_depth as, float to[16])
{
    memcpy(to, from, 16 * sizeof *to);
    for (int i = 0; i < 16; i += 4) {
        if (as.is_reversed) to[i + 2] = -to[i + 2];
        if (as.is_zero_to_one) to[i + 2] = 0.5f * (to[i + 3] + to[i + 2]);
    }
}

void hair_test_shadowed_start(struct hair_test_shadowed* f, struct hair_test* test, hair_self_shadow method,
                              bool is_lamp)
{
    struct hair_test_handmade wanted = hair_test_handmade_default();
    hair_look look = hair_look_default();
    float near = 0.2f, far = 2;
    memset(f, 0, sizeof *f);
    wanted.followers = 160;
    look.strand.segments = 8, look.strand.radius = 0.003f, look.self_shadow.method = method;
    f->scene = hair_test_scene_of(test, &wanted, &look);
    hair_test_set_orthographic(&f->scene.view, 1 / HALF, -0.5f, 0);
    hair_test_frame_make(&f->scene.frame, HAIR_TEST_SHADOWED_SIZE, HAIR_TEST_SHADOWED_SIZE, GL_RGBA32F, 0);
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

void hair_test_shadowed_draw_map(struct hair_test_shadowed* f, struct hair_test_depth as)
{
    GLuint framebuffer, map;
    hair_view view = hair_test_tessellated();
    float clear = as.is_reversed ? 0 : 1;
    glCreateTextures(GL_TEXTURE_2D, 1, &map);
    glTextureStorage2D(map, 1, GL_DEPTH_COMPONENT32F, HAIR_TEST_SHADOW_TEXELS, HAIR_TEST_SHADOW_TEXELS);
    glCreateFramebuffers(1, &framebuffer);
    glNamedFramebufferTexture(framebuffer, GL_DEPTH_ATTACHMENT, map, 0);
    glClearNamedFramebufferfv(framebuffer, GL_DEPTH, 0, &clear);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glViewport(0, 0, HAIR_TEST_SHADOW_TEXELS, HAIR_TEST_SHADOW_TEXELS);
    set_depth(as);
    hair_test_depth_convert(f->ours, as, f->light.shadow_matrix);
    memcpy(view.projection, f->light.shadow_matrix, sizeof view.projection);
    view.pass = HAIR_PASS_DEPTH;
    hair_test_ok(f->scene.test, hair_draw(f->scene.hair, &view));
    f->light.hair_shadow_map = map;
    f->light.shadow_depth_range =
        as.is_zero_to_one ? HAIR_DEPTH_RANGE_ZERO_TO_ONE : HAIR_DEPTH_RANGE_NEGATIVE_ONE_TO_ONE;
    f->light.shadow_depth_reversed = as.is_reversed;
    glDeleteFramebuffers(1, &framebuffer);
}

void hair_test_shadowed_draw(struct hair_test_shadowed* f, struct hair_test_depth as, float* pixels)
{
    float black[4] = {0}, clear = as.is_reversed ? 0 : 1;
    hair_view view = f->scene.view;
    view.lights = &f->light;
    hair_test_depth_convert(f->scene.view.projection, as, view.projection);
    glBindFramebuffer(GL_FRAMEBUFFER, f->scene.frame.framebuffer);
    glViewport(0, 0, HAIR_TEST_SHADOWED_SIZE, HAIR_TEST_SHADOWED_SIZE);
    set_depth(as);
    glClearNamedFramebufferfv(f->scene.frame.framebuffer, GL_COLOR, 0, black);
    glClearNamedFramebufferfv(f->scene.frame.framebuffer, GL_DEPTH, 0, &clear);
    hair_test_ok(f->scene.test, hair_draw(f->scene.hair, &view));
    hair_test_frame_read(&f->scene.frame, pixels);
}

double hair_test_shadowed_sum(const float* pixels)
{
    double sum = 0;
    for (int i = 0; i < 4 * HAIR_TEST_SHADOWED_SIZE * HAIR_TEST_SHADOWED_SIZE; ++i)
        sum += i % 4 < 3 ? (double)pixels[i] : 0;
    return sum;
}

double hair_test_shadowed_difference(const float* a, const float* b)
{
    double sum = 0;
    for (int i = 0; i < 4 * HAIR_TEST_SHADOWED_SIZE * HAIR_TEST_SHADOWED_SIZE; ++i)
        sum += i % 4 < 3 ? fabs((double)a[i] - (double)b[i]) : 0;
    return sum / hair_test_shadowed_sum(b);
}

void hair_test_shadowed_finish(struct hair_test_shadowed* f)
{
    set_depth(hair_test_depths[0]);
    hair_test_scene_free(&f->scene);
    free(f);
}
