// style_body.h - the bust that the built-in haircuts are made for: skull, face, neck, shoulders, as a distance.
#ifndef HAIR_GROOM_STYLE_BODY_H
#define HAIR_GROOM_STYLE_BODY_H

#include "lib/base/math.h"

// The skull, as hair_asset.h promises it. m.
#define HAIR_SKULL_X 0.077f
#define HAIR_SKULL_Y 0.098f
#define HAIR_SKULL_Z 0.096f
#define HAIR_SKULL_HEIGHT 1.63f // of its centre, on the y axis

// The point of the skull in the direction that `unit` maps to when the skull is scaled to the unit sphere.
hair_vec3 hair_skull_point(hair_vec3 unit);
// The inverse: also for points off the skull.
hair_vec3 hair_skull_unit(hair_vec3 p);
hair_vec3 hair_skull_normal(hair_vec3 p);

// Distance to the bust, negative inside; a bound that is near the truth within a few centimetres. m.
float hair_body_distance(hair_vec3 p);
// Its gradient, unit.
hair_vec3 hair_body_normal(hair_vec3 p);
// Distance to the room in front of the face that hair is combed out of. m.
float hair_face_distance(hair_vec3 p);
hair_vec3 hair_face_normal(hair_vec3 p);

#endif
