// eye.glsl - the vector to the eye of a view. `eye` has its position and 1. For parallel views it
// has the unit vector to the eye and 0.
#ifndef HAIR_EYE_GLSL
#define HAIR_EYE_GLSL

// Return the vector from a position to the eye. Parallel views have a unit vector.
vec3 towards_eye(vec4 eye, vec3 at) { return eye.w > 0.0 ? eye.xyz - at : eye.xyz; }

#endif
