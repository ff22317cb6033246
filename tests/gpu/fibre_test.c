// fibre_test.c - light scattered by a fibre, as the shader computes it: energy is conserved, and
// the function is symmetric.
#include "tests/support/support.h"

#include <math.h>
#include <stdlib.h>

#include "lib/light/fibre.h"
#include "lib/gl/gl.h"

#define EYES 16

static const char text_of_sums[] = // One eye per thread, lit from all directions.
    "layout(local_size_x = 16) in;\n"
    "layout(std430, binding = 0) buffer found_block { vec4 found[]; };\n"
    "const int ALONG = 120, ROUND = 180;\n"
    "vec3 direction(float sine, float phi) { return vec3(sqrt(1.0 - sine * sine) * vec2(cos(phi), sin(phi)), "
    "sine).xzy; }\n"
    "void main()\n"
    "{\n"
    "    uint i = gl_GlobalInvocationID.x;\n"
    "    float eye = -0.9375 + 0.125 * float(i), sum = 0.0, worst = 0.0, least = 1e9;\n"
    "    for (int a = 0; a < ALONG; ++a)\n"
    "        for (int r = 0; r < ROUND; ++r) {\n"
    "            float theta = 3.14159265 * ((float(a) + 0.5) / float(ALONG) - 0.5), phi = 6.2831853 * "
    "(float(r) + 0.5) / float(ROUND);\n"
    "            vec3  l = direction(sin(theta), phi), e = direction(eye, 0.0);\n"
    "            float f = scatter_once(measure_angles(vec3(0, 1, 0), l, e), vec3(0.0), draw.fibre.z).x;\n"
    "            float g = scatter_once(measure_angles(vec3(0, 1, 0), e, l), vec3(0.0), draw.fibre.z).x;\n"
    "            sum += f * cos(theta) * cos(theta);\n"
    "            worst = max(worst, abs(f - g) / max(f, g));\n"
    "            least = min(least, f);\n"
    "        }\n"
    "    found[i] = vec4(sum * 3.14159265 * 6.2831853 / float(ALONG * ROUND), worst, least, eye);\n"
    "}\n";

static void light_everywhere(struct hair_test* test, const struct hair_fibre* fibre, float tilt,
                             float found[EYES][4])
{
    static hair_fibre_table table;
    struct hair_gl_source source;
    struct hair_draw_params params = {.view = {{{0}}}};
    float variance[3];
    GLuint buffer[2], texture;
    hair_fibre_fill(fibre, table);
    hair_fibre_variances(fibre->along, variance);
    params.fibre = (hair_vec4){variance[0], 0, tilt, 0};
    assert_int_equal(hair_gl_read_source(&test->host.host, NULL, "light/fibre.glsl", "", &source), HAIR_OK);
    const char* text[] = {"#version 450 core\n", source.text, text_of_sums};
    GLuint program = glCreateShaderProgramv(GL_COMPUTE_SHADER, 3, text);
    hair_free(&test->host.host, source.text);
    glCreateBuffers(2, buffer);
    glNamedBufferStorage(buffer[0], EYES * 16, NULL, 0);
    glNamedBufferStorage(buffer[1], sizeof params, &params, 0);
    glCreateTextures(GL_TEXTURE_3D, 1, &texture);
    glTextureStorage3D(texture, 1, GL_RGBA32F, HAIR_FIBRE_COLUMNS, HAIR_FIBRE_ROWS, HAIR_FIBRE_LAYERS);
    glTextureSubImage3D(texture, 0, 0, 0, 0, HAIR_FIBRE_COLUMNS, HAIR_FIBRE_ROWS, HAIR_FIBRE_LAYERS, GL_RGBA,
                        GL_FLOAT, table);
    glTextureParameteri(texture, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    for (GLenum wrap = 0; wrap < 3; ++wrap)
        glTextureParameteri(texture,
                            wrap == 0   ? GL_TEXTURE_WRAP_S
                            : wrap == 1 ? GL_TEXTURE_WRAP_T
                                        : GL_TEXTURE_WRAP_R,
                            GL_CLAMP_TO_EDGE);
    glBindTextureUnit(HAIR_UNIT_FIBRE, texture);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, buffer[0]);
    glBindBufferBase(GL_UNIFORM_BUFFER, HAIR_BIND_DRAW, buffer[1]);
    glUseProgram(program);
    glDispatchCompute(EYES / 16, 1, 1);
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    glGetNamedBufferSubData(buffer[0], 0, EYES * 16, found);
    glUseProgram(0);
    glDeleteProgram(program);
    glDeleteBuffers(2, buffer);
    glDeleteTextures(1, &texture);
    assert_int_equal(glGetError(), GL_NO_ERROR);
}

// Check a white furnace. A fibre that absorbs nothing, lit with a radiance of 1 from all
// directions, is invisible against its background.
static void white_fibre_is_invisible_in_a_white_furnace(void** state)
{
    static const float along[] = {0.1f, 0.3f, 0.6f, 1};
    for (int r = 0; r < 4; ++r) {
        struct hair_fibre fibre = {0.3f, along[r], 1.55f, 1};
        float found[EYES][4];
        double max = 0;
        light_everywhere(*state, &fibre, 0, found);
        for (int i = 0; i < EYES; ++i) {
            max = fmax(max, fabs((double)found[i][0] - 1));
            hair_test_near("radiance", (size_t)i, (double)found[i][0], 1, 0.01);
        }
        print_message("    roughness %g: off by up to %.2g\n", (double)along[r], max);
    }
}

// Check tilted scales. They gain in some directions what they lose in others, which is the price of
// a symmetric function.
static void cuticle_tilt_moves_light_and_loses_none(void** state)
{
    struct hair_fibre fibre = {0.3f, 0.3f, 1.55f, 1};
    float found[EYES][4];
    double sum = 0, weight = 0;
    light_everywhere(*state, &fibre, 0.05f, found);
    for (int i = 0; i < EYES; ++i) {
        double cosine = sqrt(1 - (double)found[i][3] * (double)found[i][3]);
        sum += cosine * (double)found[i][0];
        weight += cosine;
        hair_test_near("radiance", (size_t)i, (double)found[i][0], 1, 0.1);
    }
    print_message("    mean %.4f\n", sum / weight);
    hair_test_near("radiance over all directions", 0, sum / weight, 1, 0.01);
}

static void scattering_is_reciprocal(void** state)
{
    static const float tilts[] = {0, 0.05f, 0.3f};
    for (int t = 0; t < 3; ++t) {
        struct hair_fibre fibre = {0.3f, 0.3f, 1.55f, 1};
        float found[EYES][4];
        light_everywhere(*state, &fibre, tilts[t], found);
        for (int i = 0; i < EYES; ++i) {
            assert_true(found[i][2] >= 0);
            hair_test_near("fraction by which both differ", (size_t)i, (double)found[i][1], 0, 0.02);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        HAIR_TEST(white_fibre_is_invisible_in_a_white_furnace),
        HAIR_TEST(cuticle_tilt_moves_light_and_loses_none),
        HAIR_TEST(scattering_is_reciprocal),
    };
    if (hair_test_skips()) return 0;
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
