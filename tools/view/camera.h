// camera.h - Motion of the camera of a scene around its target.
#ifndef HAIR_TOOLS_VIEW_CAMERA_H
#define HAIR_TOOLS_VIEW_CAMERA_H

#include "tools/view/common.h"

// Axes of the camera in the world, unit vectors, and its distance from the target.
struct view_axes {
    float right[3], up[3], back[3];
    float distance; // m
};
view_axes view_camera_axes(const hair_scene& scene);

// Turn the camera around the target, to the right and up, in radians.
void view_camera_orbit(hair_scene& scene, float right, float up);
// Move camera and target. `x` and `y` are fractions of the picture's height, to the right and down.
void view_camera_pan(hair_scene& scene, float x, float y);
// Multiply the distance from the target.
void view_camera_zoom(hair_scene& scene, float factor);

// Return the size of the picture at the target, m for the whole height.
float view_camera_height(const hair_scene& scene);

// Rotate a vector about an axis of any length by an angle, in radians.
void view_rotate(const float axis[3], float angle, float vector[3]);

// Compute a ray of the camera. `x` and `y` are fractions of the picture from its upper left.
void view_camera_ray(const hair_scene& scene, float x, float y, float aspect, float out[3]);

#endif
