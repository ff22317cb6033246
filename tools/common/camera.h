// camera.h - Matrices of the camera and of shadow maps, and the distance that frames a whole
// haircut.
#ifndef HAIR_TOOLS_COMMON_CAMERA_H
#define HAIR_TOOLS_COMMON_CAMERA_H

#include "tools/common/scene.h"

struct hair_bounds {
    float lower[3], upper[3];
};

struct hair_matrices {
    float view[16], projection[16];
};

void hair_bounds_add(struct hair_bounds* bounds, const float lower[3], const float upper[3]);

// Set the camera of a scene that has none. The camera looks from three-quarter front and sees all
// of the bounds.
void hair_camera_frame(struct hair_scene* scene, const struct hair_bounds* bounds);

// Return the radius of the sphere about the head's pivot that contains everything the head can
// reach.
float hair_camera_reach(const struct hair_scene* scene, const struct hair_bounds* bounds);
// Return the bounds of a haircut at rest. Set the pivot of a scene without one, and the radius that
// the head and its swinging hair can reach.
struct hair_bounds hair_camera_measure(const hair_groom_info* info, struct hair_scene* scene, float* reach);
// Compute the centre of that sphere, the pivot under the head's transform.
void hair_camera_pivot(const struct hair_scene* scene, const float transform[16], float out[3]);

// Compute the camera's matrices. `transform` is the head's transform, `reach` the radius of its
// sphere.
void hair_camera_matrices(const struct hair_scene* scene, const float transform[16], float reach,
                          struct hair_matrices* out);
// Compute the matrices of the main light's shadow map.
void hair_light_matrices(const struct hair_scene* scene, const float transform[16], float reach,
                         struct hair_matrices* out);

// Compute the shadow map matrices of any light. A lamp sees in perspective from its position.
// Return the width of the map at the head, in m.
float hair_lamp_matrices(const struct hair_scene* scene, const hair_light* lamp, const float transform[16],
                         float reach, struct hair_matrices* out);

// Compute the matrix from world to clip space.
void hair_light_clip(const struct hair_matrices* light, float out[16]);
// Compute the matrix from world to texture coordinates and depth in [0, 1], all multiplied by w.
void hair_light_texture(const struct hair_matrices* light, float out[16]);
// Compute the unit vector towards the light.
void hair_light_direction(const struct hair_scene* scene, float out[3]);

// Compute the projection of a rectangle of the picture. `at` is the rectangle's upper left corner.
// `at` and `size` are fractions of the picture.
void hair_camera_crop(const float projection[16], const float at[2], const float size[2], float out[16]);

#endif
