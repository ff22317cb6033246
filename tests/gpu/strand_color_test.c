// strand_color_test.c - colours of strands in the shader: the number of streaks, in locks or
// single, and ramps and spreads of the look. The effect of wetness on a look is checked too.
#include "tests/support/support.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "lib/light/lighting.h"

#define STRANDS 8192u
#define LOCKS 512u // Each lock has 16 strands.

// A program that writes one row per property. xyz is the colour. w is the roughness, the tilt, 1
// for a streak, or the glitter.
static const char text_of_strands[] =
    "layout(local_size_x = 64) in;\n"
    "layout(std430, binding = 0) buffer found_block { vec4 found[]; };\n"
    "void main()\n"
    "{\n"
    "    uint  i = gl_GlobalInvocationID.x, seed = 7919u * i;\n"
    "    float t = draw.radius;\n"
    "    found[2u * i]      = vec4(tint_of(seed, i / 16u, t, random(seed + 7u), ramp_at(t)), "
    "variance_of(seed));\n"
    "    found[2u * i + 1u] = vec4(tilt_of(random(seed + 7u)), is_streak(seed, i / 16u), sparkle_at(seed, "
    "t), t);\n"
    "}\n";

struct strand {
    float color[3], variance, tilt, streak, sparkle, t;
};

struct fixture {
    struct hair_test* test;
    GLuint program;
};

static struct fixture start(void** state)
{
    struct fixture f = {.test = *state};
    struct hair_gl_source source;
    assert_int_equal(hair_gl_read_source(&f.test->host.host, NULL, "light/strand_color.glsl", "", &source),
                     HAIR_OK);
    const char* text[] = {"#version 450 core\n", source.text, text_of_strands};
    f.program = glCreateShaderProgramv(GL_COMPUTE_SHADER, 3, text);
    hair_free(&f.test->host.host, source.text);
    return f;
}

static const struct strand* look_at(const struct fixture* f, const hair_look* look, float t)
{
    static struct strand found[STRANDS];
    struct hair_draw_params params;
    GLuint buffer[2];
    memset(&params, 0, sizeof params);
    params.radius = t;
    hair_look_write_tint(look, &params.tint);
    glCreateBuffers(2, buffer);
    glNamedBufferStorage(buffer[0], sizeof found, NULL, 0);
    glNamedBufferStorage(buffer[1], sizeof params, &params, 0);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, buffer[0]);
    glBindBufferBase(GL_UNIFORM_BUFFER, HAIR_BIND_DRAW, buffer[1]);
    glUseProgram(f->program);
    glDispatchCompute(STRANDS / 64, 1, 1);
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    glGetNamedBufferSubData(buffer[0], 0, sizeof found, found);
    glUseProgram(0);
    glDeleteBuffers(2, buffer);
    return found;
}

static void finish(struct fixture* f)
{
    glDeleteProgram(f->program);
    assert_int_equal(glGetError(), GL_NO_ERROR);
}

static hair_look even_look(void)
{
    hair_look look = hair_look_default();
    look.color.spread = 0;
    return look;
}

static void colors_blend_from_root_to_tip_times_the_tint(void** state)
{
    struct fixture f = start(state);
    hair_look look = even_look();
    look.color.tint_red.at[4] = 3;
    look.color.tint_blue = hair_curve_line(0, 40.0f / 7);
    for (int i = 0; i <= 14; ++i) {
        float t = (float)i / 14;
        const struct strand* strand = look_at(&f, &look, t);
        for (int k = 0; k < 3; ++k) {
            double at[2];
            for (int end = 0; end < 2; ++end) { // The ends are two of the curve's eight points.
                int n = i / 2 + (i % 2 ? end : 0);
                double way = n / 7.0, factor = k == 0   ? look.color.tint_red.at[n]
                                               : k == 2 ? look.color.tint_blue.at[n]
                                                        : 1;
                double mixed = look.color.root[k] + way * (look.color.tip[k] - look.color.root[k]);
                at[end] = fmin(factor * mixed, 1);
            }
            hair_test_near("colour", (size_t)(3 * i + k), (double)strand[i].color[k], 0.5 * (at[0] + at[1]),
                           1e-5);
        }
    }
    look.color.root_darkening = 0.75f, look.color.root_darkening_length = 0.5f;
    double shaded = (double)look_at(&f, &look, 0)[0].color[1], whole = (double)look.color.root[1];
    hair_test_near("at the root", 0, shaded, 0.25 * whole, 1e-6);
    double half = (double)look_at(&f, &look, 0.25f)[0].color[1],
           beyond = (double)look_at(&f, &look, 0.5f)[0].color[1];
    look.color.root_darkening = 0;
    hair_test_near("half way", 0, half / (double)look_at(&f, &look, 0.25f)[0].color[1], 0.625, 1e-5);
    hair_test_near("beyond", 0, beyond, (double)look_at(&f, &look, 0.5f)[0].color[1], 1e-7);
    finish(&f);
}

static void streak_fraction_is_the_fraction_of_streaks(void** state)
{
    struct fixture f = start(state);
    hair_look look = even_look();
    look.color.streaks = 0.3f;
    for (int locks = 0; locks < 2; ++locks) {
        look.color.streak_clumping = (float)locks;
        const struct strand* strand = look_at(&f, &look, 0.5f);
        double sum = 0, mixed = 0;
        for (uint32_t i = 0; i < STRANDS; i += 16) {
            uint32_t of_lock = 0;
            for (uint32_t k = i; k < i + 16; ++k) {
                int is = strand[k].streak > 0;
                of_lock += (uint32_t)is;
                for (int c = 0; c < 3; ++c)
                    assert_true(is == (fabsf(strand[k].color[c] - look.color.streak_color[c]) < 1e-6f));
            }
            sum += of_lock;
            mixed += of_lock > 0 && of_lock < 16;
        }
        print_message("    locks %d: %.4f are streaks, %.3f of the locks mixed\n", locks, sum / STRANDS,
                      mixed / LOCKS);
        // Tolerances are three standard deviations: 1.5 % for 8,192 strands, and 6.1 % for 512
        // locks.
        hair_test_near("streaks", (size_t)locks, sum / STRANDS, 0.3, locks ? 0.061 : 0.016);
        hair_test_near("locks that are mixed", (size_t)locks, mixed / LOCKS, locks ? 0 : 1, locks ? 0 : 0.02);
    }
    finish(&f);
}

static void spread_of_strand_colors_has_the_set_width(void** state)
{
    struct fixture f = start(state);
    hair_look look = even_look();
    look.color.spread = 0.4f;
    look.color.hue_spread = 0;
    look.shading.roughness_spread = 0.5f;
    look.shading.sparkle = 0.8f;
    double min[4] = {9, 9, 9, 9}, max[4] = {0}, mean[4] = {0};
    const struct strand* strand = look_at(&f, &look, 0.37f);
    double green = (double)(look.color.root[1] + 0.37f * (look.color.tip[1] - look.color.root[1]));
    for (uint32_t i = 0; i < STRANDS; ++i) {
        double found[4] = {(double)strand[i].color[1] / green, sqrt((double)strand[i].variance),
                           (double)strand[i].tilt, (double)strand[i].sparkle};
        for (int k = 0; k < 4; ++k) {
            min[k] = fmin(min[k], found[k]), max[k] = fmax(max[k], found[k]);
            mean[k] += found[k] / STRANDS;
        }
    }
    static const double by[4] = {0.4, 0.5, 0.25, 0.8};
    for (size_t k = 0; k < 4; ++k) {
        assert_true(min[k] >= 1 - by[k] - 1e-5 && max[k] <= 1 + by[k] + 1e-5);
        hair_test_near("least", k, min[k], 1 - by[k], 0.02);
        hair_test_near("most", k, max[k], 1 + by[k], 0.02);
        hair_test_near("mean", k, mean[k], 1, 0.01);
    }
    look.color.hue_spread = 1, look.color.spread = 0;
    strand = look_at(&f, &look, 1);
    for (uint32_t i = 0; i < STRANDS; ++i) {
        double red = (double)(strand[i].color[0] / look.color.tip[0]),
               blue = (double)(strand[i].color[2] / look.color.tip[2]);
        hair_test_near("red and blue", i, red + blue, 2, 1e-5);
        assert_true(red >= 0 && blue >= 0);
    }
    finish(&f);
}

static void wet_hair_is_darker_smoother_and_clumped(void** state)
{
    (void)state;
    hair_look dry = hair_look_default(), same = dry, wet = dry;
    hair_look_apply_wetness(&same);
    assert_memory_equal(&same, &dry, sizeof dry);
    wet.wetness = 1;
    hair_look_apply_wetness(&wet);
    for (int k = 0; k < 3; ++k)
        assert_true(wet.color.root[k] < dry.color.root[k] && wet.color.tip[k] < dry.color.tip[k]);
    for (int i = 1; i < 8; ++i)
        assert_true(wet.clump.weight.at[i] > dry.clump.weight.at[i] &&
                    wet.clump.width.at[i] < dry.clump.width.at[i]);
    assert_true(wet.shading.roughness[0] < dry.shading.roughness[0] &&
                wet.strays.fraction < dry.strays.fraction);
    hair_look steep = dry;
    steep.wetness = 1, steep.shading.gloss[0] = 1000, steep.shading.specular[0] = 4,
    steep.shading.roughness[0] = 0.05f;
    hair_look_apply_wetness(&steep);
    assert_true(steep.shading.gloss[0] <= 1000 && steep.shading.specular[0] <= 4 &&
                steep.shading.roughness[0] >= 0.05f);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        HAIR_TEST(colors_blend_from_root_to_tip_times_the_tint),
        HAIR_TEST(streak_fraction_is_the_fraction_of_streaks),
        HAIR_TEST(spread_of_strand_colors_has_the_set_width),
        HAIR_TEST(wet_hair_is_darker_smoother_and_clumped),
    };
    if (hair_test_skips()) return 0;
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
