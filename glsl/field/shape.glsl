// shape.glsl - signed distance to a collider's surface, below 0 inside. With HAIR_FORMS colliders
// may be collision meshes.
#include "rotation.glsl"
#include "collider_distance.glsl"

#define SHAPE_MESH 6u // Value of hair_shape.

#ifdef HAIR_FORMS
layout(std430, binding = HAIR_BIND_NODE) readonly buffer node_buffer { float node[]; };

#define NODE(i) node[i]
#include "form_distance.glsl"
#endif

float collider_distance(hair_field_collider collider, vec3 position)
{
    vec3 p = rotate(quat_conjugate(collider.rotation), position - collider.position.xyz);
#ifdef HAIR_FORMS
    if (collider.shape == SHAPE_MESH) {
        vec3      gradient;
        form_grid form = form_grid(collider.grid, uvec3(collider.nodes_x, collider.nodes_y, collider.nodes_z), collider.first);
        return collider.size.w * form_distance(form, p / collider.size.w, gradient) - collider.position.w;
    }
#endif
    return shape_distance(collider.shape, collider.size.xyz, p) - collider.position.w;
}
