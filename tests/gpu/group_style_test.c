// group_style_test.c - curls, frizz, locks and highlights of groups of strands in one instance,
// measured in metres, turns per metre and radians.
#include "tests/support/passes.h"
#include "tests/support/scene.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tests/support/grooms.h"
#include "tests/support/render_paths.h"

#define FOLLOWERS 600
#define SEGMENTS 40u
#define EACH (SEGMENTS + 1)
#define SIDE 240
#define PI 3.14159265358979

// Create straight guides, of which every second is in group 1.
static struct hair_test_scene start(struct hair_test* test)
{
    struct hair_test_handmade wanted = hair_test_handmade_default();
    wanted.guides = 7, wanted.turn = 0, wanted.segment = 0.025f, wanted.followers = FOLLOWERS;
    struct hair_test_scene scene = hair_test_scene_of(test, &wanted, NULL);
    for (uint32_t g = 0; g < wanted.guides; ++g) scene.groom->guides[g].group = g % 2;
    return scene;
}

static hair_look plain_look(void)
{
    hair_look look = hair_look_default();
    look.strand.segments = SEGMENTS;
    look.strays.tip_fraction = look.strays.fraction = 0;
    look.clump.interpolation = HAIR_INTERPOLATION_SINGLE;
    return look;
}

static uint32_t group_of(const struct hair_test_scene* scene, size_t follower)
{
    return scene->groom->guides[scene->groom->followers[follower].guide0].group;
}

// Return the vertices of all followers with a look, and with the look of group 1.
static float* read_with(const struct hair_test_scene* scene, const hair_look* look,
                        const hair_group_look* group)
{
    uint32_t count = FOLLOWERS * EACH, there;
    float* positions = malloc(3 * sizeof *positions * count);
    hair_test_ok(scene->test, hair_set_look(scene->hair, look));
    hair_test_ok(scene->test, hair_set_group_look(scene->hair, 1, group));
    hair_test_ok(scene->test,
                 hair_read_positions(scene->hair, HAIR_READ_FOLLOWERS, positions, count, &there));
    assert_int_equal(there, count);
    return positions;
}

// Mean over the vertices of each group.
struct measured {
    double rms; // Distance from the plain strand, m.
    double turns; // Turns around the plain strand, 1/m.
};

static void measure(const struct hair_test_scene* scene, const float* plain, const float* moved,
                    struct measured out[2])
{
    double square[2] = {0}, angle[2] = {0}, along[2] = {0}, count[2] = {0};
    for (size_t n = 0; n < FOLLOWERS; ++n)
        for (size_t k = n * EACH; k < n * EACH + SEGMENTS; ++k) {
            uint32_t g = group_of(scene, n);
            hair_vec3 a = hair_sub(hair_load3(moved + 3 * k), hair_load3(plain + 3 * k));
            hair_vec3 b = hair_sub(hair_load3(moved + 3 * k + 3), hair_load3(plain + 3 * k + 3));
            hair_vec3 axis = hair_sub(hair_load3(plain + 3 * k + 3), hair_load3(plain + 3 * k));
            double step = (double)hair_length(axis);
            square[g] += (double)hair_dot(a, a);
            angle[g] += fabs(atan2((double)hair_dot(hair_cross(a, b), axis) / step, (double)hair_dot(a, b)));
            along[g] += step, ++count[g];
        }
    for (int g = 0; g < 2; ++g) {
        assert_true(count[g] > 1000);
        out[g] = (struct measured){sqrt(square[g] / count[g]), angle[g] / (2 * PI * along[g])};
    }
}

static void curls_of_a_group_have_its_radius_and_frequency(void** state)
{
    struct hair_test_scene scene = start(*state);
    hair_look look = plain_look();
    hair_group_look group = hair_group_look_default();
    struct measured found[2];
    float* plain = read_with(&scene, &look, NULL);
    look.curl.radius = 0.004f, look.curl.wavelength = 0.2f, look.curl.spread = 0;
    look.curl.profile = hair_curve_line(1, 1);
    group.curl.radius = 2.5f, group.curl.frequency = 3;
    float* curled = read_with(&scene, &look, &group);
    measure(&scene, plain, curled, found);
    printf("%.4f and %.4f m, %.3f and %.3f turns per metre\n", found[0].rms, found[1].rms, found[0].turns,
           found[1].turns);
    hair_test_near("radius", 0, found[0].rms, 0.004, 4e-6);
    hair_test_near("radius", 1, found[1].rms, 0.01, 1e-5);
    hair_test_near("turns", 0, found[0].turns, 5, 0.05);
    hair_test_near("turns", 1, found[1].turns, 15, 0.15);
    // A group without curls is as straight as before.
    group.curl.radius = 0;
    float* straight = read_with(&scene, &look, &group);
    for (size_t n = 0; n < FOLLOWERS; ++n) {
        const size_t first = 3 * n * EACH;
        float error = hair_test_max_difference(straight + first, plain + first, 3 * EACH);
        assert_true(group_of(&scene, n) == 1 ? error < 1e-6f : error > 1e-3f);
    }
    free(plain), free(curled), free(straight);
    hair_test_scene_free(&scene);
}

static void frizz_of_a_group_moves_strands_as_much_more(void** state)
{
    struct hair_test_scene scene = start(*state);
    hair_look look = plain_look();
    hair_group_look group = hair_group_look_default();
    struct measured once[2], thrice[2];
    float* plain = read_with(&scene, &look, NULL);
    look.strays.frizz = hair_curve_line(0.002f, 0.002f), look.strays.frizz_wavelength = 0.1f;
    float* same = read_with(&scene, &look, &group);
    group.frizz = 3;
    float* more = read_with(&scene, &look, &group);
    measure(&scene, plain, same, once);
    measure(&scene, plain, more, thrice);
    printf("%.3f and %.3f mm become %.3f and %.3f mm\n", 1e3 * once[0].rms, 1e3 * once[1].rms,
           1e3 * thrice[0].rms, 1e3 * thrice[1].rms);
    assert_true(once[1].rms > 5e-4 && thrice[0].rms == once[0].rms);
    hair_test_near("displacement", 1, thrice[1].rms, 3 * once[1].rms, 1e-6);
    free(plain), free(same), free(more);
    hair_test_scene_free(&scene);
}

// A group that clumps by a fraction has the shape of a look with that fraction of the weight.
static void clump_of_a_group_is_a_fraction_of_the_weight(void** state)
{
    struct hair_test_scene scene = start(*state);
    hair_look look = plain_look();
    hair_group_look group = hair_group_look_default();
    look.clump.interpolation = HAIR_INTERPOLATION_MIXED;
    for (int step = 0; step < 3; ++step) {
        group.clump = (float)step / 2;
        look.clump.weight = hair_curve_line(0, group.clump);
        float* wanted = read_with(&scene, &look, NULL);
        look.clump.weight = hair_curve_line(0, 1);
        float* found = read_with(&scene, &look, &group);
        uint32_t differ = 0;
        for (size_t n = 0; n < FOLLOWERS; ++n) {
            const size_t first = 3 * n * EACH;
            float error = hair_test_max_difference(found + first, wanted + first, 3 * EACH);
            if (group_of(&scene, n) == 1) assert_true(error < 1e-6f);
            differ += error > 1e-4f;
        }
        assert_true(step == 2 ? differ == 0 : differ > FOLLOWERS / 10);
        free(wanted), free(found);
    }
    hair_test_scene_free(&scene);
}

// Add strands of both groups that bend around the x axis towards the viewer, as arcs of 0.1 m.
static struct hair_test_scene start_arcs(struct hair_test* test, const hair_look* look)
{
    static const uint8_t groups[2] = {0, 1};
    struct hair_test_scene scene = hair_test_scene_make(test, NULL);
    struct hair_test_strands strands = hair_test_strands_make(2, 32);
    for (int g = 0; g < 2; ++g)
        for (int k = 0; k < 32; ++k) {
            float a = 1.2f - 2.4f * (float)k / 31;
            hair_store3(strands.positions + 3 * strands.vertex_count++,
                        hair_v3(0.05f * (float)g - 0.025f, 0.1f * sinf(a), 0.1f * cosf(a) - 0.1f));
        }
    for (int g = 0; g < 2; ++g) strands.vertices[strands.count++] = 32;
    strands.groups = groups;
    hair_groom_desc desc = hair_test_groom_desc(&test->host, &strands);
    desc.guide_count = 2;
    scene.groom = hair_test_groom_of(&desc);
    hair_desc of = hair_desc_default();
    of.look = look;
    hair_test_ok(test, hair_create(test->context, scene.groom, &of, &scene.hair));
    hair_test_strands_free(&strands);
    return scene;
}

// Return the width of the highlight at half its height, in radians of the strand's direction. The
// strand is in the left or in the right half of the picture.
static double measure_highlight(const float* pixels, int half, double metres)
{
    double row[SIDE] = {0}, max = 0, low = 0, high = 0;
    for (int y = 0; y < SIDE; ++y)
        for (int x = 0; x < SIDE / 2; ++x)
            row[y] = fmax(row[y], (double)pixels[4 * (y * SIDE + half * SIDE / 2 + x)]);
    for (int y = 0; y < SIDE; ++y) max = fmax(max, row[y]);
    for (int y = 1; y < SIDE; ++y) {
        double at = y - 1 + (max / 2 - row[y - 1]) / (row[y] - row[y - 1]);
        if (row[y - 1] < max / 2 && row[y] >= max / 2) low = at;
        if (row[y - 1] >= max / 2 && row[y] < max / 2) high = at;
    }
    assert_true(max > 0 && low > 2 && high > low && high < SIDE - 2);
    double middle = 0.5 * (SIDE - 1);
    return asin((high - middle) * metres / 0.1) - asin((low - middle) * metres / 0.1);
}

// Return a depth texture without occluders. Occlusion culling then runs, and hides nothing.
static GLuint make_far_depth(void)
{
    const float farthest = 1;
    GLuint texture;
    glCreateTextures(GL_TEXTURE_2D, 1, &texture);
    glTextureStorage2D(texture, 1, GL_DEPTH_COMPONENT32F, SIDE, SIDE);
    glClearTexImage(texture, 0, GL_DEPTH_COMPONENT, GL_FLOAT, &farthest);
    return texture;
}

static void highlight_is_as_wide_as_the_roughness_of_its_group(void** state)
{
    static float pixels[4 * SIDE * SIDE];
    for (int model = 0; model < 2; ++model) {
        hair_look look = plain_look();
        look.shading.model = model ? HAIR_SHADING_LINES : HAIR_SHADING_FIBRES;
        look.strand.segments = 256, look.strand.radius = 3e-3f, look.color.spread = 0;
        look.shading.cuticle_tilt_spread = look.shading.scattering = 0;
        look.shading.roughness[0] = 0.1f;
        look.shading.specular[0] = 0, look.shading.specular[1] = 4, look.shading.gloss[1] = 200;
        for (int c = 0; c < 3; ++c) look.color.root[c] = look.color.tip[c] = model ? 0.05f : 0;
        struct hair_test_scene scene = start_arcs(*state, &look);
        hair_group_look group = hair_group_look_default();
        hair_light light = hair_light_default();
        hair_view view = hair_test_view_by(HAIR_RENDER_PATH_AUTO);
        light.direction[0] = light.direction[1] = 0, light.direction[2] = 1;
        view.lights = &light;
        for (int c = 0; c < 3; ++c) view.ambient[c] = 0;
        hair_test_set_orthographic(&view, 16, 3, 0);
        view.occluder_depth = make_far_depth();
        const uint32_t culled = hair_test_runs_of(&scene.test->context->gl, "cull_patches");
        for (int path = 0; path < HAIR_TEST_PATHS; ++path) {
            view.render_path = hair_test_paths[path];
            group.roughness = 1;
            hair_test_ok(scene.test, hair_set_group_look(scene.hair, 1, &group));
            hair_test_draw(&scene, &view, SIDE, SIDE, 0, pixels, NULL);
            double metres = 2.0 / 16 / SIDE, own = measure_highlight(pixels, 1, metres);
            hair_test_near("width", 0, measure_highlight(pixels, 0, metres), own, 0.02 * own);
            group.roughness = 2;
            hair_test_ok(scene.test, hair_set_group_look(scene.hair, 1, &group));
            hair_test_draw(&scene, &view, SIDE, SIDE, 0, pixels, NULL);
            double other = measure_highlight(pixels, 0, metres), rough = measure_highlight(pixels, 1, metres);
            printf("model %d, path %d: %.4f rad, rough %.4f rad\n", model, path, own, rough);
            hair_test_near("width", 1, other, own, 0.02 * own);
            hair_test_near("width", 2, rough, 2 * own, 0.1 * own);
        }
        assert_true(hair_test_runs_of(&scene.test->context->gl, "cull_patches") > culled);
        glDeleteTextures(1, &view.occluder_depth);
        hair_test_scene_free(&scene);
    }
}

static uint64_t gpu_bytes(struct hair_test* test)
{
    hair_memory memory = hair_memory_default();
    hair_test_ok(test, hair_get_memory(test->context, &memory));
    return memory.bytes;
}

static void factors_of_one_cost_no_memory_and_no_program(void** state)
{
    struct hair_test_scene scene = start(*state);
    struct hair_test* test = scene.test;
    hair_look look = plain_look();
    hair_group_look group = hair_group_look_default();
    look.curl.radius = 0.004f;
    const uint32_t runs = hair_test_runs_of(&test->context->gl, "_group_looks");
    float* plain = read_with(&scene, &look, NULL);
    const uint64_t bytes = gpu_bytes(test);
    float* same = read_with(&scene, &look, &group);
    assert_memory_equal(same, plain, 3 * sizeof *plain * FOLLOWERS * EACH);
    assert_int_equal(gpu_bytes(test), bytes);
    assert_int_equal(hair_test_runs_of(&test->context->gl, "_group_looks"), runs);
    group.curl.radius = 2;
    free(read_with(&scene, &look, &group));
    assert_int_equal(gpu_bytes(test), bytes + HAIR_STRAND_GROUPS * sizeof(struct hair_group_factors));
    assert_true(hair_test_runs_of(&test->context->gl, "_group_looks") > runs);
    free(same);
    same = read_with(&scene, &look, NULL);
    assert_memory_equal(same, plain, 3 * sizeof *plain * FOLLOWERS * EACH);
    assert_int_equal(gpu_bytes(test), bytes);
    free(plain), free(same);
    hair_test_scene_free(&scene);
}

static void wrong_factors_are_refused_by_name(void** state)
{
    struct hair_test_scene scene = start(*state);
    hair_group_look group = hair_group_look_default();
    group.curl.frequency = -1;
    hair_test_refused(scene.test, hair_set_group_look(scene.hair, 1, &group), HAIR_ERROR_ARGUMENT,
                      "hair_group_look.curl.frequency is -1, not in [0, 4]");
    group.curl.frequency = 1, group.roughness = 0;
    hair_test_refused(scene.test, hair_set_group_look(scene.hair, 1, &group), HAIR_ERROR_ARGUMENT,
                      "hair_group_look.roughness is 0, not in [0.2, 4]");
    hair_test_scene_free(&scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        HAIR_TEST(curls_of_a_group_have_its_radius_and_frequency),
        HAIR_TEST(frizz_of_a_group_moves_strands_as_much_more),
        HAIR_TEST(clump_of_a_group_is_a_fraction_of_the_weight),
        HAIR_TEST(highlight_is_as_wide_as_the_roughness_of_its_group),
        HAIR_TEST(factors_of_one_cost_no_memory_and_no_program),
        HAIR_TEST(wrong_factors_are_refused_by_name),
    };
    if (hair_test_skips()) return 0;
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
