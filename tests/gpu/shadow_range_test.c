// shadow_range_test.c - shadow maps of any range and direction of depth give the same picture,
// whatever the range and direction of the view.
#include "tests/support/shadowed.h"
#include "tests/support/tessellated.h"

#include <stdlib.h>

// Depths round differently in each convention, and a few texels of the map then differ.
static void check(struct hair_test* test, hair_self_shadow method, bool is_lamp)
{
    struct hair_test_shadowed* f = malloc(sizeof *f);
    hair_test_shadowed_start(f, test, method, is_lamp);
    hair_test_shadowed_draw(f, hair_test_depths[0], f->expected);
    double lit = hair_test_shadowed_sum(f->expected);
    hair_test_shadowed_draw_map(f, hair_test_depths[0]);
    hair_test_shadowed_draw(f, hair_test_depths[0], f->expected);
    print_message("    %.3f of the light without a map\n", hair_test_shadowed_sum(f->expected) / lit);
    // There are shadows. The other method has them without a map.
    if (method == HAIR_SELF_SHADOW_DEPTH) assert_true(hair_test_shadowed_sum(f->expected) < 0.95 * lit);
    double max = 0;
    for (int map = 0; map < 4; ++map) {
        glDeleteTextures(1, &f->light.hair_shadow_map);
        hair_test_shadowed_draw_map(f, hair_test_depths[map]);
        for (int view = 0; view < 4; ++view) {
            hair_test_shadowed_draw(f, hair_test_depths[view], f->pixels);
            double wrong = hair_test_shadowed_difference(f->pixels, f->expected);
            if (wrong > max) max = wrong;
            if (!(wrong < 1e-4)) fail_msg("map %d and view %d differ by %g of the light", map, view, wrong);
        }
    }
    print_message("    at most %g of the light differs\n", max);
    glDeleteTextures(1, &f->light.hair_shadow_map);
    hair_test_shadowed_finish(f);
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
    struct hair_test_shadowed* f = malloc(sizeof *f);
    struct hair_test_depth unit = {true, false}, reversed = {true, true};
    hair_test_shadowed_start(f, *state, HAIR_SELF_SHADOW_DEPTH, false);
    hair_test_shadowed_draw_map(f, unit);
    hair_test_shadowed_draw(f, unit, f->expected);
    f->light.shadow_depth_range = HAIR_DEPTH_RANGE_CURRENT;
    hair_test_shadowed_draw(f, unit, f->pixels);
    assert_memory_equal(f->pixels, f->expected, sizeof f->pixels);
    hair_test_shadowed_draw(f, reversed, f->pixels);
    assert_true(hair_test_shadowed_difference(f->pixels, f->expected) < 1e-4);
    hair_test_shadowed_draw(f, hair_test_depths[0], f->pixels);
    // The range is wrong.
    assert_true(hair_test_shadowed_difference(f->pixels, f->expected) > 0.05);
    glDeleteTextures(1, &f->light.hair_shadow_map);
    hair_test_shadowed_finish(f);
}

// Opaque geometry beside the map, whose border is far away, blocks nothing.
static void places_beside_a_reversed_opaque_map_are_lit(void** state)
{
    struct hair_test_shadowed* f = malloc(sizeof *f);
    hair_test_shadowed_start(f, *state, HAIR_SELF_SHADOW_DEPTH, false);
    hair_test_shadowed_draw(f, hair_test_depths[0], f->expected);
    hair_test_shadowed_draw_map(f, hair_test_depths[3]);
    f->light.opaque_shadow_map = f->light.hair_shadow_map;
    f->light.hair_shadow_map = 0;
    f->light.shadow_matrix[12] = 100; // No hair is in the map.
    hair_test_shadowed_draw(f, hair_test_depths[0], f->pixels);
    assert_true(hair_test_shadowed_difference(f->pixels, f->expected) < 1e-6);
    glDeleteTextures(1, &f->light.opaque_shadow_map);
    hair_test_shadowed_finish(f);
}

static void depth_against_the_light_is_refused(void** state)
{
    for (int is_lamp = 0; is_lamp < 2; ++is_lamp)
        for (int i = 0; i < 4; ++i) {
            struct hair_test_shadowed* f = malloc(sizeof *f);
            hair_view view = hair_test_tessellated();
            hair_test_shadowed_start(f, *state, HAIR_SELF_SHADOW_DEPTH, is_lamp);
            hair_test_shadowed_draw_map(f, hair_test_depths[i]);
            f->light.shadow_depth_reversed = !f->light.shadow_depth_reversed;
            view.lights = &f->light;
            glBindFramebuffer(GL_FRAMEBUFFER, f->scene.frame.framebuffer);
            hair_test_refused(f->scene.test, hair_draw(f->scene.hair, &view), HAIR_ERROR_ARGUMENT,
                              "depth that grows away from the light");
            glDeleteTextures(1, &f->light.hair_shadow_map);
            hair_test_shadowed_finish(f);
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
