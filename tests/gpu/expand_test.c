// expand_test.c - followers that are read back agree with the double-precision reference.
#include "tests/support/scene.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "lib/base/math.h"
#include "lib/strands/geometry.h"

struct fixture {
    struct hair_test_scene scene;
    struct hair_reference_sample* samples;
    double longest; // Length of the longest guide, in metres.
};

// Create a hair with scattered guides, and smooth them on the GPU and by the reference.
static struct fixture start(void** state)
{
    struct fixture f = {.longest = 0};
    struct hair_test_handmade wanted = hair_test_handmade_default();
    wanted.fewest = 5, wanted.max = 30, wanted.guides = 26, wanted.followers = 200;
    f.scene = hair_test_scene_of(*state, &wanted, NULL);
    f.samples = hair_test_scene_scatter(&f.scene);
    uint32_t each = 2 * f.scene.groom->max_vertices - 1;
    for (uint32_t g = 1; g <= wanted.guides; ++g)
        f.longest = fmax(f.longest, f.samples[g * each - 1].to_root);
    return f;
}

static void finish(struct fixture* f)
{
    free(f->samples);
    hair_test_scene_free(&f->scene);
}

// A sample is exact to 6 sqrt(20) 2^-24 m, and its frame to 8 / 5 mm of the same error
// (smooth_test.c gives the reasons). The frame rotates offsets of up to 15 mm. The errors of the
// offset and of up to three guides add up.
#define SAMPLE (6 * 4.5 / 16777216)
#define TOLERANCE (3 * SAMPLE + 0.015 * 8 * SAMPLE / 0.005)

static void compare(struct fixture* f, const hair_look* look)
{
    struct hair_gl* gl = &f->scene.test->context->gl;
    hair_vec4* vertices = NULL;
    double worst = 0;
    hair_test_ok(f->scene.test, hair_set_look(f->scene.hair, look));
    hair_gl_enter(gl);
    hair_result result = hair_geometry_read_vertex_cache(&f->scene.hair->geometry, &vertices);
    hair_gl_leave(gl);
    hair_test_ok(f->scene.test, result);
    for (uint32_t i = 0; i < f->scene.groom->info.follower_count * (look->strand.segments + 1); ++i) {
        struct hair_reference_point expected;
        double t = (double)(i % (look->strand.segments + 1)) / look->strand.segments;
        hair_reference_follower(&f->scene.groom->followers[i / (look->strand.segments + 1)], look,
                                2 * f->scene.groom->max_vertices - 1, f->samples, t, NULL, &expected);
        hair_test_near("x", i, vertices[i].x, expected.position[0], TOLERANCE);
        hair_test_near("y", i, vertices[i].y, expected.position[1], TOLERANCE);
        hair_test_near("z", i, vertices[i].z, expected.position[2], TOLERANCE);
        hair_test_near("radius", i, vertices[i].w, expected.radius, 32 * look->strand.radius / 16777216);
        worst = fmax(worst, fabs(vertices[i].x - expected.position[0]));
    }
    print_message("    %u segments: off by up to %.2g m of %.2g m\n", look->strand.segments, worst,
                  TOLERANCE);
    assert_true(worst < 1e-5 * f->longest);
    hair_free(&f->scene.test->host.host, vertices);
}

static void followers_equal_the_reference(void** state)
{
    static const uint32_t segments[] = {1, 2, 31, 64, 65, 256};
    struct fixture f = start(state);
    hair_look look = hair_look_default();
    for (size_t i = 0; i < sizeof segments / sizeof *segments; ++i) {
        look.strand.segments = segments[i];
        compare(&f, &look);
    }
    finish(&f);
}

static float between(uint32_t* random, float min, float max)
{
    return min + (max - min) * hair_random(random);
}

static hair_curve any_curve(uint32_t* random, float max)
{
    hair_curve curve;
    for (int i = 0; i < 8; ++i) curve.at[i] = between(random, 0, max);
    return curve;
}

static hair_look any_look(uint32_t* random)
{
    hair_look look = hair_look_default();
    look.strand.segments = 20;
    look.strand.taper = any_curve(random, 2);
    look.clump.weight = any_curve(random, 1);
    look.clump.width = any_curve(random, 1);
    look.clump.interpolation = (hair_interpolation)between(random, 0, 3);
    look.strays.tip_fraction = between(random, 0, 1);
    look.strays.fraction = between(random, 0, 1);
    look.strays.tip_distance = any_curve(random, 0.03f);
    look.strays.distance = any_curve(random, 0.03f);
    look.strand.length = between(random, 0.2f, 1);
    look.strand.length_variation = between(random, 0, 1);
    look.strays.frizz = any_curve(random, 0.004f);
    look.strays.frizz_wavelength = between(random, 0.01f, 0.1f);
    look.curl.radius = between(random, 0, 0.008f);
    look.curl.profile = any_curve(random, 1);
    look.curl.wavelength = between(random, 0.02f, 0.2f);
    look.curl.turns = between(random, 0, 4);
    look.curl.flatness = between(random, 0, 1);
    look.curl.left_fraction = between(random, 0, 1);
    look.curl.guide_phase = between(random, 0, 1);
    look.curl.strand_phase = between(random, 0, 1);
    look.curl.spread = between(random, 0, 0.9f);
    look.curl.guide_spread = between(random, 0, 0.5f);
    look.curl.variation = between(random, 0, 0.5f);
    look.strays.frizz_fraction = between(random, 0, 1);
    look.curl.shape = (hair_curl_shape)between(random, 0, 2);
    for (int i = 0; i < 16; ++i) {
        look.curl.profile_x[i] = between(random, -1, 1);
        look.curl.profile_z[i] = between(random, -1, 1);
    }
    return look;
}

static void followers_of_any_look_equal_the_reference(void** state)
{
    struct fixture f = start(state);
    uint32_t random = 7;
    for (int i = 0; i < 30; ++i) {
        hair_look look = any_look(&random);
        compare(&f, &look);
    }
    finish(&f);
}

// Link a program that computes the tangents of strands/evaluate.glsl, which draws use.
static GLuint link_tangents(const struct fixture* f)
{
    static const char main[] =
        "layout(local_size_x = 64) in;\n"
        "layout(std430, binding = 0) writeonly buffer tangent_buffer { vec4 tangents[]; };\n"
        "void main()\n"
        "{\n"
        "    uint i = gl_GlobalInvocationID.x, each = draw.segments + 1u;\n"
        "    if (i >= tangents.length()) return;\n"
        "    float t = float(i % each) / float(draw.segments);\n"
        "    tangents[i] = vec4(evaluate(fetch_follower(i / each), i / each, t).tangent, 0.0);\n"
        "}\n";
    struct hair_gl_source source;
    GLint linked = 0;
    assert_int_equal(
        hair_gl_read_source(&f->scene.test->host.host, NULL, "strands/evaluate.glsl", "", &source), HAIR_OK);
    const char* text[] = {"#version 450 core\n#define HAIR_STYLED 1\n", source.text, main};
    GLuint program = glCreateShaderProgramv(GL_COMPUTE_SHADER, 3, text);
    glGetProgramiv(program, GL_LINK_STATUS, &linked);
    hair_free(&f->scene.test->host.host, source.text);
    assert_true(linked);
    return program;
}

static void compare_tangents(struct fixture* f, const hair_look* look, GLuint program)
{
    struct hair_geometry* geometry = &f->scene.hair->geometry;
    struct hair_gl* gl = geometry->gl;
    GLuint buffer = 0;
    uint32_t count = f->scene.groom->info.follower_count * (look->strand.segments + 1);
    hair_vec4* got = malloc(count * sizeof *got);
    struct hair_draw_params params;
    double worst = 0, square = 0;
    hair_test_ok(f->scene.test, hair_set_look(f->scene.hair, look));
    hair_gl_enter(gl);
    hair_test_ok(f->scene.test,
                 hair_gl_storage(gl, HAIR_GL_NO_CATEGORY, "tangents", count * sizeof *got, NULL, &buffer));
    hair_geometry_write_params(geometry, &params);
    hair_gl_write_uniform(gl, geometry->params, sizeof params, &params);
    hair_geometry_bind(geometry);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, buffer);
    glUseProgram(program);
    glDispatchCompute((count + 63) / 64, 1, 1);
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    glGetNamedBufferSubData(buffer, 0, (GLsizeiptr)(count * sizeof *got), got);
    hair_gl_leave(gl);
    hair_gl_free_buffer(gl, &buffer);
    for (uint32_t i = 0; i < count; ++i) {
        struct hair_reference_point expected;
        hair_reference_follower(&f->scene.groom->followers[i / (look->strand.segments + 1)], look,
                                2 * f->scene.groom->max_vertices - 1, f->samples,
                                (double)(i % (look->strand.segments + 1)) / look->strand.segments, NULL,
                                &expected);
        double off[3] = {(double)got[i].x - expected.tangent[0], (double)got[i].y - expected.tangent[1],
                         (double)got[i].z - expected.tangent[2]};
        for (int k = 0; k < 3; ++k) {
            worst = fmax(worst, fabs(off[k]));
            square += off[k] * off[k] / count;
        }
    }
    print_message("    tangents off by %.2g, up to %.2g\n", sqrt(square), worst);
    // These guides point in all directions. Rounding decides the tangent if three of them cancel
    // out.
    assert_true(sqrt(square) < 1e-3 && worst < 0.05);
    free(got);
}

static void tangents_of_any_look_equal_the_reference(void** state)
{
    struct fixture f = start(state);
    uint32_t random = 70;
    GLuint program = link_tangents(&f);
    for (int i = 0; i < 6; ++i) {
        hair_look look = any_look(&random);
        compare_tangents(&f, &look, program);
    }
    glDeleteProgram(program);
    finish(&f);
}

// Check positions far from the origin of the world, to the rounding of floats there.
static void positions_are_read_in_world_space(void** state)
{
    struct fixture f = start(state);
    hair_look look = hair_look_default();
    look.strand.segments = 3;
    uint32_t count = f.scene.groom->info.follower_count * 4, there;
    float* near = malloc(3 * sizeof *near * count);
    float* far = malloc(3 * sizeof *far * count);
    hair_test_ok(f.scene.test, hair_set_look(f.scene.hair, &look));
    hair_test_ok(f.scene.test, hair_read_positions(f.scene.hair, HAIR_READ_FOLLOWERS, near, count, &there));
    assert_int_equal(there, count);
    float away[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 1000, -2000, 500, 1};
    hair_test_ok(f.scene.test, hair_teleport(f.scene.hair, away));
    hair_test_ok(f.scene.test, hair_read_positions(f.scene.hair, HAIR_READ_FOLLOWERS, far, count, &there));
    for (uint32_t i = 0; i < 3 * count; ++i)
        hair_test_near("coordinate", i, far[i] - (double)away[12 + i % 3], near[i], 2000.0 / 16777216);
    free(near);
    free(far);
    finish(&f);
}

static void read_positions_writes_at_most_the_capacity(void** state)
{
    static const hair_read_source whats[] = {HAIR_READ_GUIDES, HAIR_READ_SMOOTH, HAIR_READ_FOLLOWERS};
    struct fixture f = start(state);
    for (int i = 0; i < 3; ++i) {
        float some[3 * 8];
        uint32_t all, count;
        hair_test_ok(f.scene.test, hair_read_positions(f.scene.hair, whats[i], NULL, 0, &all));
        memset(some, 0xff, sizeof some);
        hair_test_ok(f.scene.test, hair_read_positions(f.scene.hair, whats[i], some, 7, &count));
        assert_int_equal(all, count);
        assert_true(all > 8);
        for (int k = 0; k < 24; ++k) assert_true(isnan(some[k]) == (k >= 21));
    }
    finish(&f);
}

int main(void)
{
    if (hair_test_skips()) return 0;
    const struct CMUnitTest tests[] = {
        HAIR_TEST(followers_equal_the_reference),
        HAIR_TEST(followers_of_any_look_equal_the_reference),
        HAIR_TEST(tangents_of_any_look_equal_the_reference),
        HAIR_TEST(positions_are_read_in_world_space),
        HAIR_TEST(read_positions_writes_at_most_the_capacity),
    };
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
