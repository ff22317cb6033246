// style_body.h - signed distance of the bust of the built-in haircuts: skull, face, neck and
// shoulders.
#ifndef HAIR_GROOM_STYLE_BODY_H
#define HAIR_GROOM_STYLE_BODY_H

#include "lib/base/math.h"

// Semi-axes of the skull, as hair_asset.h promises them, m.
#define HAIR_SKULL_X 0.077f
#define HAIR_SKULL_Y 0.098f
#define HAIR_SKULL_Z 0.096f
#define HAIR_SKULL_HEIGHT 1.63f // Height of its centre, which is on the y axis, m.

// Return the point of the skull in direction `unit`, a point of the unit sphere that the skull is
// scaled from.
hair_vec3 hair_skull_point(hair_vec3 unit);
// Return the inverse of hair_skull_point(). Points off the skull are allowed.
hair_vec3 hair_skull_unit(hair_vec3 p);
hair_vec3 hair_skull_normal(hair_vec3 p);

// Return a bound of the distance to the bust, m. It is negative inside and accurate within a few
// centimetres.
float hair_body_distance(hair_vec3 p);
// Return the unit gradient of hair_body_distance().
hair_vec3 hair_body_normal(hair_vec3 p);
// Return the distance to the region in front of the face that is kept free of hair, m.
float hair_face_distance(hair_vec3 p);
hair_vec3 hair_face_normal(hair_vec3 p);

#endif
