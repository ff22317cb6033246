// distance_test.c - the distance to shapes: GLSL agrees with C, and C agrees with points of the
// surface.
#include "tests/support/support.h"

#include <math.h>
#include <stdlib.h>

#include "lib/collide/distance.h"
#include "lib/gl/gl.h"

#define POINTS 4000
#define SHAPES 8

// The sizes below make no mesh. There the functions have a plane.
static const char* const names[SHAPES] = {"sphere", "capsule", "box",  "cylinder",
                                          "cone",   "plane",   "mesh", "ellipsoid"};
static const float size[3] = {0.3f, 0.5f, 0.2f};

static void any_point(uint32_t* seed, float out[4])
{
    for (int k = 0; k < 3; ++k) out[k] = 2 * hair_random(seed) - 1;
    out[3] = 0;
}

static void run(struct hair_test* test, uint32_t shape, float (*points)[4], float (*found)[4])
{
    static const char rest[] = "layout(local_size_x = 50) in;\n"
                               "layout(std430, binding = 0) buffer point_block { vec4 point[]; };\n"
                               "layout(std430, binding = 1) buffer found_block { vec4 found[]; };\n"
                               "layout(location = 0) uniform uint shape;\n"
                               "layout(location = 1) uniform vec3 size;\n"
                               "void main()\n"
                               "{\n"
                               "    uint i = gl_GlobalInvocationID.x;\n"
                               "    vec3 gradient;\n"
                               "    float distance = shape_distance(shape, size, point[i].xyz, gradient);\n"
                               "    found[i] = vec4(gradient, distance);\n"
                               "}\n";
    struct hair_gl_source source;
    assert_int_equal(
        hair_gl_read_source(&test->host.host, NULL, "collide/collider_distance.glsl", "", &source), HAIR_OK);
    const char* text[] = {"#version 450 core\n", source.text, rest};
    GLuint program = glCreateShaderProgramv(GL_COMPUTE_SHADER, 3, text), buffer[2];
    hair_free(&test->host.host, source.text);
    glCreateBuffers(2, buffer);
    glNamedBufferStorage(buffer[0], POINTS * sizeof *points, points, 0);
    glNamedBufferStorage(buffer[1], POINTS * sizeof *found, NULL, 0);
    glBindBuffersBase(GL_SHADER_STORAGE_BUFFER, 0, 2, buffer);
    glUseProgram(program);
    glUniform1ui(0, shape);
    glUniform3fv(1, 1, size);
    glDispatchCompute(POINTS / 50, 1, 1);
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    glGetNamedBufferSubData(buffer[1], 0, POINTS * sizeof *found, found);
    glUseProgram(0);
    glDeleteProgram(program);
    glDeleteBuffers(2, buffer);
}

// Compare GLSL with C. Either gradient is right at points that are about equally near to two parts
// of the surface. There the distance at a small step along the gradient must be larger by the step.
static void distances_and_gradients_are_equal_in_glsl_and_c(void** state)
{
    static float points[POINTS][4], found[POINTS][4];
    uint32_t seed = 7;
    for (uint32_t shape = 0; shape < SHAPES; ++shape) {
        double max = 0, turned = 0;
        for (int i = 0; i < POINTS; ++i) any_point(&seed, points[i]);
        // One point is in the middle, and one on the axis.
        for (int k = 0; k < 4; ++k) points[0][k] = 0;
        points[1][0] = points[1][2] = 0;
        run(*state, shape, points, found);
        for (int i = 0; i < POINTS; ++i) {
            double p[3] = {(double)points[i][0], (double)points[i][1], (double)points[i][2]}, n[3], off = 0;
            double distance = hair_distance_to_shape((hair_shape)shape, size, p, n);
            max = fmax(max, fabs(distance - (double)found[i][3]));
            for (int k = 0; k < 3; ++k) off += pow(n[k] - (double)found[i][k], 2);
            if (off < 1e-6) continue;
            ++turned;
            for (int k = 0; k < 3; ++k) p[k] += 1e-4 * (double)found[i][k];
            double grown = hair_distance_to_shape((hair_shape)shape, size, p, NULL) - distance;
            hair_test_near(names[shape], (size_t)i, grown, 1e-4, 2e-6);
        }
        print_message("    %s: off by up to %.2g, %g of %d gradients are others\n", names[shape], max, turned,
                      POINTS);
        assert_true(max < 5e-7);
        assert_true(turned < 0.01 * POINTS);
    }
}

// Check the closed form. From any point, one step of the distance along the gradient leads to the
// surface, and no shorter step in another direction does.
static void distance_is_the_shortest_way_to_the_surface(void** state)
{
    (void)state;
    uint32_t seed = 11;
    for (uint32_t shape = 0; shape < SHAPES; ++shape)
        for (int i = 0; i < 2000; ++i) {
            float point[4];
            double p[3], n[3], q[3];
            any_point(&seed, point);
            for (int k = 0; k < 3; ++k) p[k] = (double)point[k];
            double distance = hair_distance_to_shape((hair_shape)shape, size, p, n);
            hair_test_near("unit", (size_t)i, n[0] * n[0] + n[1] * n[1] + n[2] * n[2], 1, 1e-12);
            for (int k = 0; k < 3; ++k) q[k] = p[k] - distance * n[k];
            hair_test_near(names[shape], (size_t)i, hair_distance_to_shape((hair_shape)shape, size, q, NULL),
                           0, 1e-12);
            for (int other = 0; other < 20; ++other) {
                float way[4];
                double length = 0;
                any_point(&seed, way);
                for (int k = 0; k < 3; ++k) length += (double)way[k] * (double)way[k];
                for (int k = 0; k < 3; ++k) q[k] = p[k] + 0.999 * distance * (double)way[k] / sqrt(length);
                double there = hair_distance_to_shape((hair_shape)shape, size, q, NULL);
                assert_true(there * distance > 0);
            }
        }
}

// Compare the sign with the definition of the shape.
static void distance_is_negative_only_inside(void** state)
{
    (void)state;
    uint32_t seed = 13;
    const double r = (double)size[0], h = (double)size[1], z = (double)size[2];
    for (int i = 0; i < 20000; ++i) {
        float point[4];
        any_point(&seed, point);
        double p[3] = {(double)point[0], (double)point[1], (double)point[2]}, around = hypot(p[0], p[2]);
        double beyond = fmax(fabs(p[1]) - h, 0);
        int inside[SHAPES] = {hypot(around, p[1]) < r,
                              hypot(around, beyond) < r,
                              fabs(p[0]) < r && fabs(p[1]) < h && fabs(p[2]) < z,
                              around < r && fabs(p[1]) < h,
                              fabs(p[1]) < h && around < r * (h - p[1]) / (2 * h),
                              p[1] < 0,
                              p[1] < 0,
                              pow(p[0] / r, 2) + pow(p[1] / h, 2) + pow(p[2] / z, 2) < 1};
        for (int shape = 0; shape < SHAPES; ++shape)
            if ((hair_distance_to_shape((hair_shape)shape, size, p, NULL) < 0) != inside[shape])
                fail_msg("%s: point %d", names[shape], i);
    }
}

static void collider_distance_heeds_pose_and_rounding(void** state)
{
    (void)state;
    hair_collider collider = hair_collider_default();
    collider.shape = HAIR_SHAPE_BOX;
    collider.rounding = 0.05f;
    collider.rotation[2] = collider.rotation[3] = sqrtf(0.5f); // From x to y.
    for (int k = 0; k < 3; ++k) collider.size[k] = size[k], collider.position[k] = (float)(k + 1);
    const double above[3] = {1, 2.5, 3}, aside[3] = {1.5 + 0.3, 2, 3};
    double n[3];
    hair_test_near("above", 0, hair_distance_to_collider(&collider, above, n), 0.5 - 0.3 - 0.05, 1e-6);
    hair_test_near("upwards", 0, n[1], 1, 1e-6);
    hair_test_near("aside", 0, hair_distance_to_collider(&collider, aside, n), 0.8 - 0.5 - 0.05, 1e-6);
    hair_test_near("sideways", 0, n[0], 1, 1e-6);
    collider.shape = HAIR_SHAPE_MESH; // The collider has no mesh.
    assert_true(hair_distance_to_collider(&collider, above, n) == INFINITY);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        HAIR_TEST(distances_and_gradients_are_equal_in_glsl_and_c),
        cmocka_unit_test(distance_is_the_shortest_way_to_the_surface),
        cmocka_unit_test(distance_is_negative_only_inside),
        cmocka_unit_test(collider_distance_heeds_pose_and_rounding),
    };
    if (hair_test_skips()) return 0;
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
