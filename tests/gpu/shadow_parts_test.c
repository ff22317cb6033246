// shadow_parts_test.c - a shadow map in a layer of an array, in a face of a cube map or in a
// rectangle of an atlas gives the picture of a map of its own.
#include "tests/support/shadowed.h"

#include <stdlib.h>

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
static void use(struct hair_test_shadowed* f, GLuint to, uint32_t layer, bool is_opaque)
{
    f->light.hair_shadow_map = is_opaque ? 0 : to;
    f->light.opaque_shadow_map = is_opaque ? to : 0;
    f->light.hair_shadow_part.layer = is_opaque ? 0 : layer;
    f->light.opaque_shadow_part.layer = is_opaque ? layer : 0;
}

static void check_layer(struct hair_test_shadowed* f, GLenum target, GLuint map, GLsizei layers, GLint layer,
                        bool is_opaque)
{
    GLuint texture = make_texture(target, HAIR_TEST_SHADOW_TEXELS, layers);
    glCopyImageSubData(map, GL_TEXTURE_2D, 0, 0, 0, 0, texture, target, 0, 0, 0, layer,
                       HAIR_TEST_SHADOW_TEXELS, HAIR_TEST_SHADOW_TEXELS, 1);
    use(f, texture, (uint32_t)layer, is_opaque);
    hair_test_shadowed_draw(f, hair_test_depths[0], f->pixels);
    assert_memory_equal(f->pixels, f->expected, sizeof f->pixels);
    use(f, texture, (uint32_t)(layer ? layer - 1 : 1), is_opaque);
    hair_test_shadowed_draw(f, hair_test_depths[0], f->pixels);
    assert_true(hair_test_shadowed_difference(f->pixels, f->expected) > 0.05);
    assert_int_equal(glGetError(), GL_NO_ERROR);
    glDeleteTextures(1, &texture);
}

static void check_atlas(struct hair_test_shadowed* f, GLuint map, bool is_opaque)
{
    GLuint texture = make_texture(GL_TEXTURE_2D, 4 * HAIR_TEST_SHADOW_TEXELS, 1);
    glCopyImageSubData(map, GL_TEXTURE_2D, 0, 0, 0, 0, texture, GL_TEXTURE_2D, 0, HAIR_TEST_SHADOW_TEXELS,
                       2 * HAIR_TEST_SHADOW_TEXELS, 0, HAIR_TEST_SHADOW_TEXELS, HAIR_TEST_SHADOW_TEXELS, 1);
    use(f, texture, 0, is_opaque);
    float* offset = is_opaque ? f->light.opaque_shadow_part.offset : f->light.hair_shadow_part.offset;
    float* size = is_opaque ? f->light.opaque_shadow_part.size : f->light.hair_shadow_part.size;
    offset[0] = size[0] = size[1] = 0.25f, offset[1] = 0.5f;
    hair_test_shadowed_draw(f, hair_test_depths[0], f->pixels);
    assert_true(hair_test_shadowed_difference(f->pixels, f->expected) < 1e-5);
    offset[0] = 0.8f;
    hair_view view = f->scene.view;
    view.lights = &f->light;
    hair_test_refused(f->scene.test, hair_draw(f->scene.hair, &view), HAIR_ERROR_ARGUMENT, "ends at 1.05");
    offset[0] = offset[1] = 0, size[0] = size[1] = 1;
    glDeleteTextures(1, &texture);
}

static void check_all(struct hair_test* test, hair_self_shadow method, bool is_opaque)
{
    struct hair_test_shadowed* f = malloc(sizeof *f);
    hair_test_shadowed_start(f, test, method, true);
    hair_test_shadowed_draw(f, hair_test_depths[0], f->pixels);
    hair_test_shadowed_draw_map(f, hair_test_depths[0]);
    GLuint map = f->light.hair_shadow_map;
    use(f, map, 0, is_opaque);
    hair_test_shadowed_draw(f, hair_test_depths[0], f->expected);
    double shade = hair_test_shadowed_difference(f->pixels, f->expected);
    print_message("    the map changes %.3f\n", shade);
    assert_true(shade > 0.01);
    check_layer(f, GL_TEXTURE_2D_ARRAY, map, 4, 2, is_opaque);
    check_layer(f, GL_TEXTURE_CUBE_MAP, map, 1, 3, is_opaque);
    check_layer(f, GL_TEXTURE_CUBE_MAP_ARRAY, map, 12, 8, is_opaque);
    check_atlas(f, map, is_opaque);
    glDeleteTextures(1, &map);
    hair_test_shadowed_finish(f);
}

static void parts_of_textures_shade_as_maps_of_their_own(void** state)
{
    check_all(*state, HAIR_SELF_SHADOW_DEPTH, false);
    check_all(*state, HAIR_SELF_SHADOW_DEPTH, true);
    check_all(*state, HAIR_SELF_SHADOW_STRANDS, false);
    check_all(*state, HAIR_SELF_SHADOW_STRANDS, true);
}

static void wrong_layers_are_refused(void** state)
{
    struct hair_test_shadowed* f = malloc(sizeof *f);
    GLuint array = make_texture(GL_TEXTURE_2D_ARRAY, 16, 3), loose;
    hair_test_shadowed_start(f, *state, HAIR_SELF_SHADOW_DEPTH, true);
    hair_view view = f->scene.view;
    view.lights = &f->light;
    hair_test_depth_convert(f->ours, hair_test_depths[0], f->light.shadow_matrix);
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
    hair_test_shadowed_finish(f);
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
