// bust.h - A mannequin for the built-in haircuts, drawn by OpenGL, and its colliders. The library
// draws hair only, therefore an application brings its own head.
#ifndef TOOLS_EXAMPLES_BUST_H
#define TOOLS_EXAMPLES_BUST_H

#include "common.h"
#include <math.h>

// Ellipses that the surface runs through, from the top down. Each has its height y, half width,
// half depth, and the z of its centre, in metres.
static const float bust_rings[][4] = {
    {1.729f, 0, 0, 0},
    {1.720f, 0.030f, 0.038f, 0},
    {1.700f, 0.053f, 0.066f, 0},
    {1.670f, 0.069f, 0.086f, 0},
    {1.630f, 0.075f, 0.094f, 0},
    {1.590f, 0.070f, 0.089f, 0.004f},
    {1.560f, 0.062f, 0.080f, 0.012f},
    {1.535f, 0.051f, 0.068f, 0.022f},
    {1.517f, 0.036f, 0.052f, 0.034f},
    {1.502f, 0.044f, 0.052f, 0.004f},
    {1.480f, 0.046f, 0.047f, -0.015f},
    {1.450f, 0.052f, 0.050f, -0.022f},
    {1.430f, 0.090f, 0.056f, -0.026f},
    {1.415f, 0.140f, 0.062f, -0.024f},
    {1.390f, 0.185f, 0.070f, -0.020f},
    {1.350f, 0.203f, 0.082f, -0.014f},
    {1.250f, 0.195f, 0.090f, -0.004f},
};

enum { BUST_KEYS = sizeof bust_rings / sizeof *bust_rings, BUST_STEPS = 4, BUST_SIDES = 48 };
enum { BUST_ROWS = (BUST_KEYS - 1) * BUST_STEPS + 1, BUST_INDICES = 6 * (BUST_ROWS - 1) * BUST_SIDES };

struct bust {
    GLuint vertex_array, buffers[2], program;
};

static const char bust_vertex_text[] = "#version 450 core\n"
                                       "layout(location = 0) uniform mat4 transform;\n"
                                       "layout(location = 1) uniform mat4 clip;\n"
                                       "layout(location = 0) in vec3 rest_position;\n"
                                       "layout(location = 1) in vec3 rest_normal;\n"
                                       "layout(location = 0) out vec3 position;\n"
                                       "layout(location = 1) out vec3 normal;\n"
                                       "void main()\n"
                                       "{\n"
                                       "    position = (transform * vec4(rest_position, 1.0)).xyz;\n"
                                       "    normal = mat3(transform) * rest_normal;\n"
                                       "    gl_Position = clip * vec4(position, 1.0);\n"
                                       "}\n";

// The light is the default light of a hair_view.
static const char bust_fragment_text[] =
    "#version 450 core\n"
    "layout(location = 1) in vec3 normal;\n"
    "layout(location = 0) out vec4 color;\n"
    "void main()\n"
    "{\n"
    "    vec3 n = normalize(normal);\n"
    "    float facing = max(dot(n, normalize(vec3(0.4, 0.8, 0.45))), 0.0);\n"
    "    color = vec4(vec3(0.50, 0.38, 0.31) / 3.14159 * (3.0 * facing + 0.35 * (1.5 + 0.5 * n.y)), 1.0);\n"
    "}\n";

// Evaluate a row of the surface by Catmull-Rom splines through the rings.
static inline void bust_row(int row, float out[4])
{
    int last = BUST_KEYS - 1, k = row / BUST_STEPS < last ? row / BUST_STEPS : last - 1;
    const float *a = bust_rings[k > 0 ? k - 1 : 0], *b = bust_rings[k], *c = bust_rings[k + 1];
    const float* d = bust_rings[k + 2 < last ? k + 2 : last];
    float t = (float)(row - k * BUST_STEPS) / BUST_STEPS;
    for (int i = 0; i < 4; ++i)
        out[i] =
            b[i] + 0.5f * t *
                       (c[i] - a[i] +
                        t * (2 * a[i] - 5 * b[i] + 4 * c[i] - d[i] + t * (3 * (b[i] - c[i]) + d[i] - a[i])));
}

// Compute the position and the normal of a vertex.
static inline void bust_vertex(int row, int side, float out[6])
{
    float above[4], ring[4], below[4], angle = 6.2831853f * (float)side / BUST_SIDES;
    float s = sinf(angle), c = cosf(angle);
    bust_row(row > 0 ? row - 1 : 0, above);
    bust_row(row, ring);
    bust_row(row < BUST_ROWS - 1 ? row + 1 : row, below);
    float down[3] = {(below[1] - above[1]) * s, below[0] - above[0],
                     (below[2] - above[2]) * c + below[3] - above[3]};
    float around[3] = {ring[1] * c, 0, -ring[2] * s};
    float normal[3] = {down[1] * around[2], down[2] * around[0] - down[0] * around[2], -down[1] * around[0]};
    float size = sqrtf(normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]);
    out[0] = ring[1] * s, out[1] = ring[0], out[2] = ring[2] * c + ring[3];
    out[3] = 0, out[4] = 1, out[5] = 0; // The pole has no tangent around.
    for (int i = 0; i < 3 && size > 0; ++i) out[3 + i] = normal[i] / size;
}

static inline struct bust bust_create(void)
{
    static float vertices[BUST_ROWS * BUST_SIDES][6];
    static GLuint indices[BUST_INDICES];
    struct bust bust;
    int count = 0;
    for (int i = 0; i < BUST_ROWS * BUST_SIDES; ++i) bust_vertex(i / BUST_SIDES, i % BUST_SIDES, vertices[i]);
    for (int row = 0; row + 1 < BUST_ROWS; ++row)
        for (int side = 0; side < BUST_SIDES; ++side) {
            int next = (side + 1) % BUST_SIDES, upper = row * BUST_SIDES, lower = upper + BUST_SIDES;
            const int corners[6] = {upper + side, lower + side, lower + next,
                                    upper + side, lower + next, upper + next};
            for (int i = 0; i < 6; ++i) indices[count++] = (GLuint)corners[i];
        }
    bust.program = make_program(bust_vertex_text, bust_fragment_text);
    glCreateBuffers(2, bust.buffers);
    glNamedBufferStorage(bust.buffers[0], sizeof vertices, vertices, 0);
    glNamedBufferStorage(bust.buffers[1], sizeof indices, indices, 0);
    glCreateVertexArrays(1, &bust.vertex_array);
    glVertexArrayVertexBuffer(bust.vertex_array, 0, bust.buffers[0], 0, 6 * sizeof(float));
    glVertexArrayElementBuffer(bust.vertex_array, bust.buffers[1]);
    for (GLuint i = 0; i < 2; ++i) {
        glVertexArrayAttribFormat(bust.vertex_array, i, 3, GL_FLOAT, GL_FALSE, i * 3 * (GLuint)sizeof(float));
        glVertexArrayAttribBinding(bust.vertex_array, i, 0);
        glEnableVertexArrayAttrib(bust.vertex_array, i);
    }
    return bust;
}

static inline void bust_destroy(struct bust* bust)
{
    glDeleteProgram(bust->program);
    glDeleteVertexArrays(1, &bust->vertex_array);
    glDeleteBuffers(2, bust->buffers);
}

// Draw the bust with a program whose vertex shader is bust_vertex_text.
static inline void bust_draw(const struct bust* bust, GLuint program, const float transform[16],
                             const float clip[16])
{
    glProgramUniformMatrix4fv(program, 0, 1, GL_FALSE, transform);
    glProgramUniformMatrix4fv(program, 1, 1, GL_FALSE, clip);
    glUseProgram(program);
    glBindVertexArray(bust->vertex_array);
    glDrawElements(GL_TRIANGLES, BUST_INDICES, GL_UNSIGNED_INT, NULL);
}

// Capsules that fill the bust: both ends of the axis and the radius, in metres.
static const float bust_capsules[][7] = {
    {0, 1.655f, 0.016f, 0, 1.654f, -0.017f, 0.067f}, // skull
    {0, 1.637f, -0.001f, 0, 1.629f, 0.007f, 0.075f},
    {0, 1.637f, -0.028f, 0, 1.612f, -0.024f, 0.065f},
    {-0.018f, 1.574f, 0.043f, 0.018f, 1.574f, 0.043f, 0.042f}, // cheeks
    {0, 1.380f, -0.020f, 0, 1.550f, -0.004f, 0.047f}, // neck
    {-0.045f, 1.390f, -0.026f, -0.150f, 1.360f, -0.020f, 0.056f}, // shoulders
    {0.045f, 1.390f, -0.026f, 0.150f, 1.360f, -0.020f, 0.056f},
    {-0.085f, 1.350f, -0.020f, 0.085f, 1.350f, -0.020f, 0.070f}, // chest
};
enum { BUST_COLLIDERS = sizeof bust_capsules / sizeof *bust_capsules };

// Place the colliders of a bust that is moved by `transform`.
static inline void bust_colliders(const float transform[16], hair_collider out[BUST_COLLIDERS])
{
    for (int i = 0; i < BUST_COLLIDERS; ++i) {
        const float* capsule = bust_capsules[i];
        float axis[3], size = 0;
        out[i] = hair_collider_default();
        out[i].shape = HAIR_SHAPE_CAPSULE;
        for (int k = 0; k < 3; ++k) {
            const float* t = transform + k;
            float a = t[0] * capsule[0] + t[4] * capsule[1] + t[8] * capsule[2] + t[12];
            float b = t[0] * capsule[3] + t[4] * capsule[4] + t[8] * capsule[5] + t[12];
            out[i].position[k] = 0.5f * (a + b);
            axis[k] = b - a;
            size += axis[k] * axis[k];
        }
        size = sqrtf(size);
        // The smallest rotation from +y to the axis. No axis here points straight down.
        float x = axis[2] / size, z = -axis[0] / size, w = 1 + axis[1] / size;
        float norm = sqrtf(x * x + z * z + w * w);
        out[i].rotation[0] = x / norm, out[i].rotation[2] = z / norm, out[i].rotation[3] = w / norm;
        out[i].size[0] = capsule[6], out[i].size[1] = 0.5f * size;
    }
}

#endif
