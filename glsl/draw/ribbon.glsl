// ribbon.glsl - the shape of a ribbon that faces the eye.
#include "eye.glsl"

// Return the vector from the middle of a ribbon to its side. strand.xyz is the middle from the
// head's origin, m. strand.w is half the width, m.
vec3 side_of(vec4 strand, vec3 tangent)
{
    vec3  side = cross(tangent, towards_eye(draw.eye, strand.xyz));
    float l    = length(side);
    return l > 1e-12 ? side * (strand.w / l) : vec3(0.0); // Seen end on, a ribbon has no width.
}
