// opacity_test.c - the opacity map of hair for a light. It agrees with counted rays for any size of
// texels, width of strands, level of detail and render path. Only hair before the first opaque
// surface counts. The application's state is kept.
#include "tests/support/render_paths.h"
#include "tests/support/scene.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "tests/reference/self_shadow.h"

#define HALF 0.2f // Half of the side of the visible square, in metres.
#define RAYS 4096
#define MAX 1024 // Maximum number of texels per side.

struct fixture {
    struct hair_test_scene scene;
    struct hair_reference_rays rays;
    GLuint framebuffer, opacity, depth;
    GLsizei texels;
    float pixels[MAX * MAX];
};

static struct fixture* start(void** state, uint32_t followers, float radius)
{
    struct fixture* f = calloc(1, sizeof *f);
    struct hair_test_handmade wanted = hair_test_handmade_default();
    hair_look look = hair_look_default();
    wanted.followers = followers;
    wanted.guides = 40;
    look.strand.segments = 12, look.strand.radius = radius;
    f->scene = hair_test_scene_of(*state, &wanted, &look);
    f->scene.view.pass = HAIR_PASS_OPACITY;
    hair_test_set_orthographic(&f->scene.view, 1 / HALF, -1, 0);
    glCreateFramebuffers(1, &f->framebuffer);
    return f;
}

static void finish(struct fixture* f)
{
    glDeleteFramebuffers(1, &f->framebuffer);
    glDeleteTextures(1, &f->opacity);
    glDeleteTextures(1, &f->depth);
    free(f->rays.stopped);
    hair_test_scene_free(&f->scene);
    free(f);
}

// Create a map with `texels` texels per side. hair.h permits its format.
static void make_map(struct fixture* f, GLsizei texels)
{
    glDeleteTextures(1, &f->opacity);
    glDeleteTextures(1, &f->depth);
    glCreateTextures(GL_TEXTURE_2D, 1, &f->opacity);
    glCreateTextures(GL_TEXTURE_2D, 1, &f->depth);
    glTextureStorage2D(f->opacity, 1, GL_R16F, texels, texels);
    glTextureStorage2D(f->depth, 1, GL_DEPTH_COMPONENT32F, texels, texels);
    glNamedFramebufferTexture(f->framebuffer, GL_COLOR_ATTACHMENT0, f->opacity, 0);
    glNamedFramebufferTexture(f->framebuffer, GL_DEPTH_ATTACHMENT, f->depth, 0);
    glBindFramebuffer(GL_FRAMEBUFFER, f->framebuffer);
    glViewport(0, 0, texels, texels);
    glEnable(GL_DEPTH_TEST);
    f->texels = texels;
}

// Draw the map. Opaque geometry at depth `bodies` covers the left half.
static void draw(struct fixture* f, float bodies)
{
    static const float far_away = 1, none = 0;
    glClearTexImage(f->opacity, 0, GL_RED, GL_FLOAT, &none);
    glClearTexImage(f->depth, 0, GL_DEPTH_COMPONENT, GL_FLOAT, &far_away);
    glClearTexSubImage(f->depth, 0, 0, 0, 0, f->texels / 2, f->texels, 1, GL_DEPTH_COMPONENT, GL_FLOAT,
                       &bodies);
    hair_test_ok(f->scene.test, hair_draw(f->scene.hair, &f->scene.view));
    glGetTextureImage(f->opacity, 0, GL_RED, GL_FLOAT, sizeof f->pixels, f->pixels);
}

// Count the rays that meet strands at z >= `behind`.
static void count_rays(struct fixture* f, double behind)
{
    uint32_t each = f->scene.hair->geometry.look.strand.segments + 1,
             count = f->scene.hair->geometry.followers * each;
    f->scene.view.render_path = HAIR_RENDER_PATH_CACHED; // Stores vertices and radii in a buffer.
    make_map(f, 16);
    draw(f, 1);
    hair_vec4* vertices = malloc(count * sizeof *vertices);
    glGetNamedBufferSubData(f->scene.hair->geometry.vertex_cache.position, 0,
                            (GLsizeiptr)(count * sizeof *vertices), vertices);
    free(f->rays.stopped);
    f->rays = (struct hair_reference_rays){.lower = {-(double)HALF, -(double)HALF},
                                           .side = 2 * (double)HALF,
                                           .count = RAYS,
                                           .stopped = calloc(RAYS, RAYS)};
    for (uint32_t v = 0; v < count; ++v) {
        if (v % each == each - 1) continue;
        const hair_vec4 *p = &vertices[v], *q = p + 1;
        double a[2] = {(double)p->x, (double)p->y}, b[2] = {(double)q->x, (double)q->y};
        if (0.5 * (double)(p->z + q->z) >= behind)
            hair_reference_stop(&f->rays, a, b, (double)p->w, (double)q->w);
    }
    free(vertices);
}

struct found {
    // Opacity: mean over the map, expected mean, and root mean square error over texels that have
    // any.
    double mean, expected, off;
};

static struct found compare(const struct fixture* f)
{
    struct found found = {0};
    double fraction = 1.0 / f->texels, square = 0;
    uint32_t count = 0;
    for (int i = 0; i < f->texels * f->texels; ++i) {
        double taken = (double)f->pixels[i];
        double expected =
            hair_reference_stopped(&f->rays, i % f->texels * fraction, i / f->texels * fraction, fraction);
        assert_true(taken >= 0 && taken <= 1);
        found.mean += taken * fraction * fraction;
        found.expected += expected * fraction * fraction;
        if (expected <= 0 && taken <= 0) continue;
        square += pow(taken - expected, 2);
        ++count;
    }
    found.off = sqrt(square / count);
    return found;
}

// Compare opacity with rays, for hair that blocks nearly all light at some places. Strands in a
// texel are taken as independent of each other, and clumps are not. Texels of 12.5 mm are as wide
// as a whole lock.
static void check_any_texel_size(void** state, hair_render_path path)
{
    static const float radii[] = {4e-5f, 2e-4f, 1e-3f};
    static const GLsizei texels[] = {32, 128, 512, 1024};
    for (int r = 0; r < 3; ++r) {
        struct fixture* f = start(state, 1500, radii[r]);
        count_rays(f, -1);
        f->scene.view.render_path = path;
        for (int t = 0; t < 4; ++t) {
            make_map(f, texels[t]);
            draw(f, 1);
            struct found found = compare(f);
            double error = found.mean / found.expected - 1;
            print_message(
                "    strands of %g mm, texels of %.2f mm: %.4f, by rays %.4f: %+.1f %%; texels %.3f off\n",
                2e3 * (double)radii[r], 2e3 * (double)HALF / texels[t], found.mean, found.expected,
                100 * error, found.off);
            hair_test_near("opacity", (size_t)(4 * r + t), error, 0, t ? 0.01 : 0.05);
        }
        finish(f);
    }
}

static void opacity_equals_counted_rays_at_any_texel_size(void** state)
{
    check_any_texel_size(state, HAIR_RENDER_PATH_TESSELLATION);
}

static void computed_opacity_equals_counted_rays(void** state)
{
    check_any_texel_size(state, HAIR_RENDER_PATH_COMPUTE);
}

static void opacity_is_equal_by_every_path_and_level_of_detail(void** state)
{
    struct fixture* f = start(state, 1500, 2e-4f);
    hair_lod part = hair_lod_default();
    double all = 0;
    part.per_patch = false;
    count_rays(f, -1);
    make_map(f, 256);
    for (int path = 0; path < HAIR_TEST_PATHS; ++path)
        for (int k = 0; k < 4; ++k) {
            static const float fractions[] = {1, 0.5f, 0.2f, 0.1f};
            part.strand_fraction = fractions[k], part.segment_fraction = k ? 0.5f : 1.0f;
            f->scene.view.render_path = hair_test_paths[path];
            f->scene.view.lod = k ? &part : NULL;
            // The pass draws ribbons with both settings.
            f->scene.view.primitive = k % 2 ? HAIR_PRIMITIVE_LINES : HAIR_PRIMITIVE_RIBBONS;
            draw(f, 1);
            struct found found = compare(f);
            double error = found.mean / found.expected - 1;
            print_message("    path %d, %g of the strands: %+.1f %%\n", path, (double)fractions[k],
                          100 * error);
            hair_test_near("opacity", (size_t)(4 * path + k), error, 0, k ? 0.05 : 0.01);
            if (!path && !k) all = found.mean;
            // Computed sums are rounded at random, and framebuffers of half floats to the nearest.
            double max = path == HAIR_TEST_COMPUTE ? 5e-3 : 1e-4;
            if (!k) hair_test_near("path", (size_t)path, found.mean, all, max * all);
        }
    f->scene.view.opacity = 0.25f, f->scene.view.lod = NULL;
    draw(f, 1);
    double weak = compare(f).mean;
    // A single strand has a quarter of the opacity. Two strands have a little less than twice that.
    assert_true(weak > 0.25 * all && weak < 0.5 * all);
    finish(f);
}

// Check hair in front of the head's origin. Then put opaque geometry there, in the left half of the
// map only.
static void check_before_opaque_geometry(void** state, hair_render_path path)
{
    struct fixture* f = start(state, 1500, 1e-4f);
    count_rays(f, 0);
    f->scene.view.render_path = path;
    make_map(f, 128);
    draw(f, 0.5f);
    struct found found = {0};
    double all = 0, fraction = 1.0 / 128;
    for (int i = 0; i < 128 * 128; ++i) {
        if (i % 128 >= 64) continue;
        found.mean += (double)f->pixels[i];
        found.expected += hair_reference_stopped(&f->rays, i % 128 * fraction, i / 128 * fraction, fraction);
    }
    print_message("    %+.2f %% off where a body is\n", 100 * (found.mean / found.expected - 1));
    hair_test_near("before the body", 0, found.mean / found.expected, 1, 0.02);
    draw(f, 1);
    for (int i = 0; i < 128 * 128; ++i) all += i % 128 < 64 ? (double)f->pixels[i] : 0;
    assert_true(all > 1.3 * found.mean);
    draw(f, 0);
    for (int i = 0; i < 128 * 128; ++i)
        if (i % 128 < 64) assert_true(f->pixels[i] == 0);
    finish(f);
}

static void opacity_counts_only_hair_before_opaque_geometry(void** state)
{
    check_before_opaque_geometry(state, HAIR_RENDER_PATH_TESSELLATION);
}

static void computed_opacity_counts_only_hair_before_opaque_geometry(void** state)
{
    check_before_opaque_geometry(state, HAIR_RENDER_PATH_COMPUTE);
}

// Check that a computed map equals a drawn one, whatever the application's depth test is.
static void computed_opacity_obeys_the_depth_test(void** state)
{
    static const struct {
        GLenum function;
        float from, to, bodies;
    } hosts[] = {{GL_LESS, 0, 1, 0.5f},   {GL_LEQUAL, 1, 0, 0.5f}, {GL_GREATER, 0, 1, 0.5f},
                 {GL_GEQUAL, 1, 0, 0.4f}, {GL_ALWAYS, 0, 1, 0.5f}, {GL_LESS, 0.2f, 0.6f, 0.4f}};
    struct fixture* f = start(state, 500, 1e-4f);
    make_map(f, 64);
    for (size_t i = 0; i < sizeof hosts / sizeof *hosts; ++i) {
        double sum[2] = {0}, off = 0;
        static float drawn[64 * 64];
        glDepthFunc(hosts[i].function);
        glDepthRangef(hosts[i].from, hosts[i].to);
        for (int made = 0; made < 2; ++made) {
            f->scene.view.render_path = made ? HAIR_RENDER_PATH_COMPUTE : HAIR_RENDER_PATH_CACHED;
            draw(f, hosts[i].bodies);
            for (int k = 0; k < 64 * 64; ++k) sum[made] += (double)f->pixels[k];
            if (!made) memcpy(drawn, f->pixels, sizeof drawn);
        }
        for (int k = 0; k < 64 * 64; ++k) off = fmax(off, fabs((double)(f->pixels[k] - drawn[k])));
        print_message("    %zu: %.2f drawn, %.2f computed, at most %.3f off\n", i, sum[0], sum[1], off);
        assert_true(sum[0] > 1 && fabs(sum[1] / sum[0] - 1) < 0.01 && off < 0.2);
    }
    glDepthFunc(GL_LESS);
    glDepthRangef(0, 1);
    finish(f);
}

static void check_blending_and_depth(void** state, hair_render_path path)
{
    static const float near = 0.7f;
    static float depths[64 * 64];
    struct fixture* f = start(state, 64, 1e-3f);
    f->scene.view.render_path = path;
    make_map(f, 64);
    hair_test_blend_begin();
    draw(f, near);
    assert_true(hair_test_blend_end());
    glGetTextureImage(f->depth, 0, GL_DEPTH_COMPONENT, GL_FLOAT, sizeof depths, depths);
    double taken = 0;
    for (int i = 0; i < 64 * 64; ++i) {
        assert_true(depths[i] == (i % 64 < 32 ? near : 1));
        taken += (double)f->pixels[i];
    }
    assert_true(taken > 1);
    finish(f);
}

static void opacity_pass_keeps_blending_and_depth(void** state)
{
    check_blending_and_depth(state, HAIR_RENDER_PATH_TESSELLATION);
    check_blending_and_depth(state, HAIR_RENDER_PATH_COMPUTE);
}

// Check that strands thicker than a texel block all light, however many there are.
static void opacity_of_many_thick_strands_is_one(void** state)
{
    struct fixture* f = start(state, 20000, 0.01f);
    int full[2] = {0};
    make_map(f, 64);
    for (int made = 0; made < 2; ++made) {
        f->scene.view.render_path = made ? HAIR_RENDER_PATH_COMPUTE : HAIR_RENDER_PATH_CACHED;
        draw(f, 1);
        for (int i = 0; i < 64 * 64; ++i) full[made] += f->pixels[i] > 0.99f;
    }
    print_message("    %d texels are full if drawn, %d if computed\n", full[0], full[1]);
    assert_true(full[0] > 1000 && abs(full[1] - full[0]) < full[0] / 20);
    finish(f);
}

// Check that depth which no shader can read is tested by drawing.
static void opacity_before_a_renderbuffer_is_drawn(void** state)
{
    struct fixture* f = start(state, 64, 1e-3f);
    GLuint depth;
    f->scene.view.render_path = HAIR_RENDER_PATH_COMPUTE;
    make_map(f, 64);
    assert_int_equal(hair_test_path_of(&f->scene.hair->renderer, &f->scene.view), HAIR_RENDER_PATH_COMPUTE);
    glCreateRenderbuffers(1, &depth);
    glNamedRenderbufferStorage(depth, GL_DEPTH_COMPONENT24, 64, 64);
    glNamedFramebufferRenderbuffer(f->framebuffer, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth);
    assert_int_equal(hair_test_path_of(&f->scene.hair->renderer, &f->scene.view), HAIR_RENDER_PATH_CACHED);
    draw(f, 1);
    glDeleteRenderbuffers(1, &depth);
    finish(f);
}

static hair_report_row find_row(const struct fixture* f, const char* work)
{
    return hair_test_report_row(f->scene.test, f->scene.hair, work);
}

static void opacity_is_reported_and_costs_nothing_unused(void** state)
{
    struct fixture* f = start(state, 64, 1e-3f);
    hair_memory before = hair_memory_default(), after = hair_memory_default();
    make_map(f, 64);
    f->scene.view.pass = HAIR_PASS_DEPTH;
    hair_test_ok(f->scene.test, hair_step(f->scene.hair, 1.0f / 60));
    draw(f, 1);
    assert_int_equal(find_row(f, "opacity").runs, 0);
    assert_int_equal(find_row(f, "opacity").skip_reason, HAIR_SKIP_REASON_NOT_CALLED);
    hair_test_ok(f->scene.test, hair_get_memory(f->scene.test->context, &before));
    f->scene.view.pass = HAIR_PASS_OPACITY;
    draw(f, 1);
    assert_int_equal(find_row(f, "opacity").runs, 1);
    assert_int_equal(find_row(f, "depth").runs, 1);
    hair_test_ok(f->scene.test, hair_get_memory(f->scene.test->context, &after));
    assert_int_equal(before.bytes, after.bytes);
    f->scene.view.view[12] = 9;
    hair_test_ok(f->scene.test, hair_step(f->scene.hair, 1.0f / 60));
    draw(f, 1);
    assert_int_equal(find_row(f, "opacity").skip_reason, HAIR_SKIP_REASON_OUT_OF_VIEW);
    finish(f);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        HAIR_TEST(opacity_equals_counted_rays_at_any_texel_size),
        HAIR_TEST(computed_opacity_equals_counted_rays),
        HAIR_TEST(opacity_is_equal_by_every_path_and_level_of_detail),
        HAIR_TEST(opacity_counts_only_hair_before_opaque_geometry),
        HAIR_TEST(computed_opacity_counts_only_hair_before_opaque_geometry),
        HAIR_TEST(computed_opacity_obeys_the_depth_test),
        HAIR_TEST(opacity_pass_keeps_blending_and_depth),
        HAIR_TEST(opacity_of_many_thick_strands_is_one),
        HAIR_TEST(opacity_before_a_renderbuffer_is_drawn),
        HAIR_TEST(opacity_is_reported_and_costs_nothing_unused),
    };
    if (hair_test_skips()) return 0;
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
