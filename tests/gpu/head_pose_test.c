// head_pose_test.c - the bust that tools draw moves as the body that hair collides with.
#include "tests/support/support.h"

#include <math.h>
#include <stdarg.h>
#include <string.h>

#include "tools/common/file.h"

// Tools are not linked into tests.
#include "tools/common/head_pose.c"
#include "tools/common/shaders.c"

void hair_complain(const char* tool, const char* format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    print_error("%s: ", tool);
    vprint_error(format, arguments);
    va_end(arguments);
}

#define POINTS 4096

static GLuint make_program(void)
{
    static const char* const varying = "position";
    const char* text = hair_mesh_vert;
    GLuint shader = glCreateShader(GL_VERTEX_SHADER), program = glCreateProgram();
    GLint linked;
    glShaderSource(shader, 1, &text, NULL);
    glCompileShader(shader);
    glAttachShader(program, shader);
    glTransformFeedbackVaryings(program, 1, &varying, GL_INTERLEAVED_ATTRIBS);
    glLinkProgram(program);
    glDeleteShader(shader);
    glGetProgramiv(program, GL_LINK_STATUS, &linked);
    assert_true(linked);
    return program;
}

// Move points by the vertex shader.
static void draw(GLuint program, const struct hair_head_pose* pose, const float* points, float* out)
{
    GLuint array, buffer[2], empty;
    glCreateFramebuffers(1, &empty); // Commands that draw nothing need a complete framebuffer too.
    glNamedFramebufferParameteri(empty, GL_FRAMEBUFFER_DEFAULT_WIDTH, 1);
    glNamedFramebufferParameteri(empty, GL_FRAMEBUFFER_DEFAULT_HEIGHT, 1);
    glBindFramebuffer(GL_FRAMEBUFFER, empty);
    glCreateVertexArrays(1, &array);
    glCreateBuffers(2, buffer);
    glNamedBufferStorage(buffer[0], 3 * POINTS * sizeof(float), points, 0);
    glNamedBufferStorage(buffer[1], 3 * POINTS * sizeof(float), NULL, 0);
    glVertexArrayVertexBuffer(array, 0, buffer[0], 0, 3 * sizeof(float));
    glVertexArrayAttribFormat(array, 0, 3, GL_FLOAT, GL_FALSE, 0);
    glVertexArrayAttribBinding(array, 0, 0);
    glEnableVertexArrayAttrib(array, 0);
    glProgramUniformMatrix4fv(program, HAIR_AT_HEAD, 1, GL_FALSE, pose->transform);
    glProgramUniform4fv(program, HAIR_AT_HEIGHTS, 1, pose->heights);
    glProgramUniform4fv(program, HAIR_AT_BREATH, 1, pose->breath);
    glUseProgram(program);
    glBindVertexArray(array);
    glBindBufferBase(GL_TRANSFORM_FEEDBACK_BUFFER, 0, buffer[1]);
    glEnable(GL_RASTERIZER_DISCARD);
    glBeginTransformFeedback(GL_POINTS);
    glDrawArrays(GL_POINTS, 0, POINTS);
    glEndTransformFeedback();
    glDisable(GL_RASTERIZER_DISCARD);
    glGetNamedBufferSubData(buffer[1], 0, 3 * POINTS * sizeof(float), out);
    glBindVertexArray(0);
    glUseProgram(0);
    glDeleteBuffers(2, buffer);
    glDeleteVertexArrays(1, &array);
    glDeleteFramebuffers(1, &empty);
}

static void the_drawn_bust_moves_as_its_body(void** state)
{
    (void)state;
    static float points[3 * POINTS], drawn[3 * POINTS];
    const float c = cosf(0.5f), s = sinf(0.5f);
    const float transform[16] = {c, 0.1f, -s, 0, 0, 1, 0, 0, s, 0, c, 0, 0.1f, -0.02f, 0.3f, 1};
    GLuint program = make_program();
    uint32_t random = 1;
    for (uint32_t i = 0; i < 3 * POINTS; ++i) {
        random = 1664525 * random + 1013904223;
        points[i] = (float)(random >> 8) / 16777216 - 0.5f; // 1 m around 1.45 m
        if (i % 3 == 1) points[i] += 1.45f;
    }
    for (int whole = 0; whole < 2; ++whole) {
        struct hair_head_pose pose = hair_head_pose_at(transform, 0.02f, whole);
        draw(program, &pose, points, drawn);
        for (uint32_t i = 0; i < POINTS; ++i) {
            float moved[3];
            hair_head_pose_move(&pose, points + 3 * (size_t)i, moved);
            for (uint32_t k = 0; k < 3; ++k)
                hair_test_near("place", i, (double)drawn[3 * i + k], (double)moved[k], 2e-6);
        }
    }
    glDeleteProgram(program);
}

int main(void)
{
    const struct CMUnitTest tests[] = {HAIR_TEST(the_drawn_bust_moves_as_its_body)};
    if (hair_test_skips()) return 0;
    return cmocka_run_group_tests(tests, hair_test_start, hair_test_finish);
}
