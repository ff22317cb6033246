// distance.h - the exact signed distance to solids: what fields and contacts are held to.
#ifndef HAIR_COLLIDE_DISTANCE_H
#define HAIR_COLLIDE_DISTANCE_H

#include "lib/collide/form.h"

// From `point` to the surface, m, below 0 inside. `gradient`: the unit vector along which it grows, where there are
// several one of them; may be NULL.

// Of a solid, both in the world. A form without its mesh is infinitely far.
double hair_distance_to_solid(const hair_solid* solid, const double point[3], double gradient[3]);

// Of any shape but a form, in its own space, without rounding.
double hair_distance_to_shape(hair_shape shape, const float size[3], const double point[3],
                              double gradient[3]);

// Of a form in its own space: trilinear between the nodes. Beyond the grid as from the point of the surface that is
// nearest to where it ends: a little too far.
double hair_distance_to_form(const hair_form* form, const double point[3], double gradient[3]);

#endif
