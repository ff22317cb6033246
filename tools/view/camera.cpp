// camera.cpp - Motion of the camera of a scene around its target.
#include "tools/view/camera.h"

#include <math.h>

#include <algorithm>

namespace
{

constexpr float nearest = 0.02f, farthest = 1e4f; // m
constexpr float steepest = 1.55f; // radians above the horizon

float dot(const float a[3], const float b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

void normalize(float v[3])
{
    float length = sqrtf(dot(v, v));
    for (int i = 0; i < 3 && length > 0; ++i) v[i] /= length;
}

void cross(const float a[3], const float b[3], float out[3])
{
    for (int i = 0; i < 3; ++i) out[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
}

} // namespace

view_axes view_camera_axes(const hair_scene& scene)
{
    view_axes axes;
    for (int i = 0; i < 3; ++i) axes.back[i] = scene.eye[i] - scene.target[i];
    axes.distance = sqrtf(dot(axes.back, axes.back));
    normalize(axes.back);
    // hair_camera_matrices() takes +z for the upward direction of a vertical view.
    bool is_vertical = fabsf(axes.back[1]) > 0.999f;
    const float up[3] = {0, is_vertical ? 0.0f : 1.0f, is_vertical ? 1.0f : 0.0f};
    cross(up, axes.back, axes.right);
    normalize(axes.right);
    cross(axes.back, axes.right, axes.up);
    return axes;
}

void view_rotate(const float axis[3], float angle, float vector[3])
{
    float unit[3] = {axis[0], axis[1], axis[2]}, side[3], c = cosf(angle), s = sinf(angle);
    normalize(unit);
    cross(unit, vector, side);
    float along = dot(unit, vector) * (1 - c);
    for (int i = 0; i < 3; ++i) vector[i] = vector[i] * c + side[i] * s + unit[i] * along;
}

void view_camera_orbit(hair_scene& scene, float right, float up)
{
    view_axes axes = view_camera_axes(scene);
    float yaw = atan2f(axes.back[0], axes.back[2]) + right;
    float pitch = std::clamp(asinf(std::clamp(axes.back[1], -1.0f, 1.0f)) + up, -steepest, steepest);
    const float back[3] = {sinf(yaw) * cosf(pitch), sinf(pitch), cosf(yaw) * cosf(pitch)};
    for (int i = 0; i < 3; ++i) scene.eye[i] = scene.target[i] + axes.distance * back[i];
}

float view_camera_height(const hair_scene& scene)
{
    return 2 * view_camera_axes(scene).distance * tanf(scene.field_of_view * 0.00872664626f);
}

void view_camera_pan(hair_scene& scene, float x, float y)
{
    view_axes axes = view_camera_axes(scene);
    float height = view_camera_height(scene);
    for (int i = 0; i < 3; ++i) {
        float by = height * (y * axes.up[i] - x * axes.right[i]);
        by = std::clamp(by, -1e3f, 1e3f);
        scene.eye[i] = std::clamp(scene.eye[i] + by, -1e5f, 1e5f);
        scene.target[i] = std::clamp(scene.target[i] + by, -1e5f, 1e5f);
    }
}

void view_camera_zoom(hair_scene& scene, float factor)
{
    view_axes axes = view_camera_axes(scene);
    float distance = std::clamp(axes.distance * factor, nearest, farthest);
    for (int i = 0; i < 3; ++i) scene.eye[i] = scene.target[i] + distance * axes.back[i];
}

void view_camera_ray(const hair_scene& scene, float x, float y, float aspect, float out[3])
{
    view_axes axes = view_camera_axes(scene);
    float half = tanf(scene.field_of_view * 0.00872664626f);
    for (int i = 0; i < 3; ++i)
        out[i] = half * ((2 * x - 1) * aspect * axes.right[i] + (1 - 2 * y) * axes.up[i]) - axes.back[i];
    normalize(out);
}
