// shape.glsl - signed distance to a collider's surface, below 0 inside. With HAIR_FORMS colliders
// may be collision meshes.
#include "rotation.glsl"
#include "solid_distance.glsl"

#define SHAPE_FORM 6u // Value of hair_shape.

#ifdef HAIR_FORMS
layout(std430, binding = HAIR_BIND_NODE) readonly buffer node_buffer { float node[]; };

#define NODE(i) node[i]
#include "form_distance.glsl"
#endif

float solid_distance(hair_field_solid solid, vec3 position)
{
    vec3 p = rotate(quat_conjugate(solid.rotation), position - solid.position.xyz);
#ifdef HAIR_FORMS
    if (solid.shape == SHAPE_FORM) {
        vec3      gradient;
        form_grid form = form_grid(solid.grid, uvec3(solid.nodes_x, solid.nodes_y, solid.nodes_z), solid.first);
        return solid.size.w * form_distance(form, p / solid.size.w, gradient) - solid.position.w;
    }
#endif
    return shape_distance(solid.shape, solid.size.xyz, p) - solid.position.w;
}
