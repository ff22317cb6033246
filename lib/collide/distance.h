// distance.h - the exact signed distance to colliders, which is the reference for fields and
// contacts.
#ifndef HAIR_COLLIDE_DISTANCE_H
#define HAIR_COLLIDE_DISTANCE_H

#include "lib/collide/collision_mesh.h"

// All functions return the distance from `point` to the surface, m. It is negative inside.
// `gradient` receives the unit vector along which the distance grows, or one of several such
// vectors. NULL disables it.

// Return the distance to a collider, with both in the world. A collision mesh without its data is
// infinitely far.
double hair_distance_to_collider(const hair_collider* collider, const double point[3], double gradient[3]);

// Return the distance to any shape except a collision mesh, in the shape's own space and without
// rounding.
double hair_distance_to_shape(hair_shape shape, const float size[3], const double point[3],
                              double gradient[3]);

// Return the distance to a collision mesh in its own space, trilinear between the nodes. Outside
// the grid, the distance is measured from the surface point nearest to the grid's edge, which is
// slightly too far.
double hair_distance_to_mesh(const hair_collision_mesh* mesh, const double point[3], double gradient[3]);

#endif
