// shape.glsl - signed distance to a collider's surface, below 0 inside. With HAIR_MESHES colliders
// may be collision meshes.
#include "rotation.glsl"
#include "collide/collider_distance.glsl"

#define SHAPE_MESH 6u // Value of hair_shape.

#ifdef HAIR_MESHES
layout(std430, binding = HAIR_BIND_NODE) readonly buffer node_buffer { float node[]; };

#define NODE(i) node[i]
#include "collide/mesh_distance.glsl"
#endif

float collider_distance(hair_field_collider collider, vec3 position)
{
    vec3 p = rotate(quat_conjugate(collider.rotation), position - collider.position.xyz);
#ifdef HAIR_MESHES
    if (collider.shape == SHAPE_MESH) {
        vec3      gradient;
        mesh_grid mesh = mesh_grid(collider.grid, uvec3(collider.nodes_x, collider.nodes_y, collider.nodes_z),
                                   collider.first);
        return collider.size.w * mesh_distance(mesh, p / collider.size.w, gradient) - collider.position.w;
    }
#endif
    return shape_distance(collider.shape, collider.size.xyz, p) - collider.position.w;
}
