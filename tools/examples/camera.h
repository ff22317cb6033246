// camera.h - Cameras of the examples. Matrices are column-major, as in OpenGL.
#ifndef TOOLS_EXAMPLES_CAMERA_H
#define TOOLS_EXAMPLES_CAMERA_H

#include <math.h>
#include <string.h>

static const float identity[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};

struct camera {
    float view[16]; // world to view
    float projection[16]; // view to clip space
    float clip[16]; // projection times view
};

static inline void multiply(const float a[16], const float b[16], float out[16])
{
    for (int i = 0; i < 16; ++i) {
        out[i] = 0;
        for (int k = 0; k < 4; ++k) out[i] += a[4 * k + i % 4] * b[i / 4 * 4 + k];
    }
}

// Compute the view matrix of an eye that looks at a target. The up vector is +y.
static inline void look_at(const float eye[3], const float target[3], float out[16])
{
    float z[3] = {eye[0] - target[0], eye[1] - target[1], eye[2] - target[2]};
    float size = sqrtf(z[0] * z[0] + z[1] * z[1] + z[2] * z[2]);
    for (int i = 0; i < 3; ++i) z[i] /= size;
    float across = sqrtf(z[0] * z[0] + z[2] * z[2]);
    float x[3] = {z[2] / across, 0, -z[0] / across};
    float y[3] = {z[1] * x[2], z[2] * x[0] - z[0] * x[2], -z[1] * x[0]};
    for (int i = 0; i < 3; ++i) out[4 * i] = x[i], out[4 * i + 1] = y[i], out[4 * i + 2] = z[i];
    out[12] = -(x[0] * eye[0] + x[1] * eye[1] + x[2] * eye[2]);
    out[13] = -(y[0] * eye[0] + y[1] * eye[1] + y[2] * eye[2]);
    out[14] = -(z[0] * eye[0] + z[1] * eye[1] + z[2] * eye[2]);
    out[3] = out[7] = out[11] = 0, out[15] = 1;
}

// Return a camera in perspective. `field_of_view` is vertical, in radians.
static inline struct camera camera_perspective(const float eye[3], const float target[3], float field_of_view,
                                               float aspect)
{
    const float near = 0.1f, far = 20, scale = 1 / tanf(0.5f * field_of_view);
    struct camera camera;
    look_at(eye, target, camera.view);
    memset(camera.projection, 0, sizeof camera.projection);
    camera.projection[0] = scale / aspect;
    camera.projection[5] = scale;
    camera.projection[10] = (far + near) / (near - far);
    camera.projection[11] = -1;
    camera.projection[14] = 2 * far * near / (near - far);
    multiply(camera.projection, camera.view, camera.clip);
    return camera;
}

// Return an orthographic camera. It covers the sphere of radius `reach` around its target.
static inline struct camera camera_orthographic(const float eye[3], const float target[3], float reach)
{
    struct camera camera;
    look_at(eye, target, camera.view);
    float x = target[0] - eye[0], y = target[1] - eye[1], z = target[2] - eye[2];
    memset(camera.projection, 0, sizeof camera.projection);
    camera.projection[0] = camera.projection[5] = 1 / reach;
    camera.projection[10] = -1 / reach;
    camera.projection[14] = -sqrtf(x * x + y * y + z * z) / reach;
    camera.projection[15] = 1;
    multiply(camera.projection, camera.view, camera.clip);
    return camera;
}

#endif
