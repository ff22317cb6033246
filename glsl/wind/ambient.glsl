// ambient.glsl - the wind at a place that is given as in fluid.glsl.
#include "wind/fluid.glsl"

vec3 ambient_at(vec3 place) { return fluid.wind.xyz; }
