// shape.glsl - the distance to a solid's surface, below 0 inside.
#include "rotation.glsl"

#define SHAPE_CAPSULE 1u // as hair_shape

float solid_distance(hair_field_solid solid, vec3 position)
{
    vec3 p = rotate(quat_conjugate(solid.rotation), position - solid.position.xyz);
    if (solid.shape == SHAPE_CAPSULE) p.y -= clamp(p.y, -solid.size.y, solid.size.y);
    return length(p) - solid.size.x - solid.position.w;
}
