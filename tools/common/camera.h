// camera.h - matrices of the camera and of the light's shadow map, and how far off to see a haircut whole.
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

// For a scene without a camera: three-quarter front, all of the bounds in the picture.
void hair_camera_frame(struct hair_scene* scene, const struct hair_bounds* bounds);

// What the head can reach: a sphere about its pivot; and where that is under the head's transform.
float hair_camera_reach(const struct hair_scene* scene, const struct hair_bounds* bounds);
void hair_camera_pivot(const struct hair_scene* scene, const float transform[16], float out[3]);

// `transform` is the head's, `reach` the radius of its sphere.
void hair_camera_matrices(const struct hair_scene* scene, const float transform[16], float reach,
                          struct hair_matrices* out);
void hair_light_matrices(const struct hair_scene* scene, const float transform[16], float reach,
                         struct hair_matrices* out);

// Of any light: from a lamp's place in perspective. Returns how wide it sees where the head is, m.
float hair_lamp_matrices(const struct hair_scene* scene, const hair_light* lamp, const float transform[16],
                         float reach, struct hair_matrices* out);

// World to clip space, and to texture coordinates and depth in [0, 1], all times w.
void hair_light_clip(const struct hair_matrices* light, float out[16]);
void hair_light_texture(const struct hair_matrices* light, float out[16]);
void hair_light_direction(const struct hair_scene* scene, float out[3]); // unit, towards it

// The part of a projection that makes a rectangle of the picture: `at`, its upper left corner, and `size` are
// shares of the picture, from its own.
void hair_camera_crop(const float projection[16], const float at[2], const float size[2], float out[16]);

#endif
