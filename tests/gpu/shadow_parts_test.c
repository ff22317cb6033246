// shadow_parts_test.c - a shadow map in a layer of an array, in a face of a cube map or in a
// rectangle of an atlas gives the picture of a map of its own.
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

// Make a texture of `layers` layers whose depth is 0, so that it shades everything.
static GLuint make_texture(GLenum target, GLsizei size, GLsizei layers)
{
    static const float nearest = 0;
    GLuint texture;
    glCreateTextures(target, 1, &texture);
    if (target == GL_TEXTURE_2D_ARRAY || target == GL_TEXTURE_CUBE_MAP_ARRAY)
        glTextureStorage3D(texture, 1, GL_DEPTH_COMPONENT32F, size, size, layers);
    else
        glTextureStorage2D(texture, 1, GL_DEPTH_COMPONENT32F, size, size);
    glClearTexImage(texture, 0, GL_DEPTH_COMPONENT, GL_FLOAT, &nearest);
    return texture;
}

// Make `to` the map of the light, hair or opaque.
static void use(struct fixture* f, GLuint to, uint32_t layer, bool is_opaque)
{
    f->light.hair_shadow_map = is_opaque ? 0 : to;
    f->light.opaque_shadow_map = is_opaque ? to : 0;
    f->light.hair_shadow_part.layer = is_opaque ? 0 : layer;
    f->light.opaque_shadow_part.layer = is_opaque ? layer : 0;
}

static void check_layer(struct fixture* f, GLenum target, GLuint map, GLsizei layers, GLint layer,
                        bool is_opaque)
{
    GLuint texture = make_texture(target, TEXELS, layers);
    glCopyImageSubData(map, GL_TEXTURE_2D, 0, 0, 0, 0, texture, target, 0, 0, 0, layer, TEXELS, TEXELS, 1);
    use(f, texture, (uint32_t)layer, is_opaque);
    draw(f, conventions[0], f->pixels);
    assert_memory_equal(f->pixels, f->expected, sizeof f->pixels);
    use(f, texture, (uint32_t)(layer ? layer - 1 : 1), is_opaque);
    draw(f, conventions[0], f->pixels);
    assert_true(difference(f->pixels, f->expected) > 0.05);
    assert_int_equal(glGetError(), GL_NO_ERROR);
    glDeleteTextures(1, &texture);
}

static void check_atlas(struct fixture* f, GLuint map, bool is_opaque)
{
    GLuint texture = make_texture(GL_TEXTURE_2D, 4 * TEXELS, 1);
    glCopyImageSubData(map, GL_TEXTURE_2D, 0, 0, 0, 0, texture, GL_TEXTURE_2D, 0, TEXELS, 2 * TEXELS, 0,
                       TEXELS, TEXELS, 1);
    use(f, texture, 0, is_opaque);
    float* offset = is_opaque ? f->light.opaque_shadow_part.offset : f->light.hair_shadow_part.offset;
    float* size = is_opaque ? f->light.opaque_shadow_part.size : f->light.hair_shadow_part.size;
    offset[0] = size[0] = size[1] = 0.25f, offset[1] = 0.5f;
    draw(f, conventions[0], f->pixels);
    assert_true(difference(f->pixels, f->expected) < 1e-5);
    offset[0] = 0.8f;
    hair_view view = f->scene.view;
    view.lights = &f->light;
    hair_test_refused(f->scene.test, hair_draw(f->scene.hair, &view), HAIR_ERROR_ARGUMENT, "ends at 1.05");
    offset[0] = offset[1] = 0, size[0] = size[1] = 1;
    glDeleteTextures(1, &texture);
}

static void check_all(struct hair_test* test, bool is_opaque)
{
    struct fixture* f = malloc(sizeof *f);
    start(f, test, HAIR_SELF_SHADOW_DEPTH, true);
    draw(f, conventions[0], f->expected);
    double lit = mean(f->expected);
    draw_map(f, conventions[0]);
    GLuint map = f->light.hair_shadow_map;
    use(f, map, 0, is_opaque);
    draw(f, conventions[0], f->expected);
    assert_true(mean(f->expected) < 0.95 * lit);
    check_layer(f, GL_TEXTURE_2D_ARRAY, map, 4, 2, is_opaque);
    check_layer(f, GL_TEXTURE_CUBE_MAP, map, 1, 3, is_opaque);
    check_layer(f, GL_TEXTURE_CUBE_MAP_ARRAY, map, 12, 8, is_opaque);
    check_atlas(f, map, is_opaque);
    glDeleteTextures(1, &map);
    finish(f);
}

static void parts_of_textures_shade_as_maps_of_their_own(void** state)
{
    check_all(*state, false);
    check_all(*state, true);
}

static void wrong_layers_are_refused(void** state)
{
    struct fixture* f = malloc(sizeof *f);
    GLuint array = make_texture(GL_TEXTURE_2D_ARRAY, 16, 3), loose;
    start(f, *state, HAIR_SELF_SHADOW_DEPTH, true);
    hair_view view = f->scene.view;
    view.lights = &f->light;
    convert(f->ours, conventions[0], f->light.shadow_matrix);
    use(f, array, 3, false);
    hair_test_refused(*state, hair_draw(f->scene.hair, &view), HAIR_ERROR_ARGUMENT, "which has 3 layers");
    glCreateTextures(GL_TEXTURE_2D_ARRAY, 1, &loose);
    glBindTexture(GL_TEXTURE_2D_ARRAY, loose);
    glTexImage3D(GL_TEXTURE_2D_ARRAY, 0, GL_DEPTH_COMPONENT32F, 16, 16, 3, 0, GL_DEPTH_COMPONENT, GL_FLOAT,
                 NULL);
    glBindTexture(GL_TEXTURE_2D_ARRAY, 0);
    use(f, loose, 0, true);
    hair_test_refused(*state, hair_draw(f->scene.hair, &view), HAIR_ERROR_ARGUMENT, "immutable storage");
    glDeleteTextures(1, &array);
    glDeleteTextures(1, &loose);
    finish(f);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        HAIR_TEST(parts_of_textures_shade_as_maps_of_their_own),
        HAIR_TEST(wrong_layers_are_refused),
    };
    if (hair_test_skips()) return 0;
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
