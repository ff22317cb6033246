// shape.glsl - the distance to a solid's surface, below 0 inside.
#include "rotation.glsl"
#include "solid_distance.glsl"

float solid_distance(hair_field_solid solid, vec3 position)
{
    vec3 p = rotate(quat_conjugate(solid.rotation), position - solid.position.xyz);
    return shape_distance(solid.shape, solid.size.xyz, p) - solid.position.w;
}
