// shape.glsl - the distance to a solid's surface, below 0 inside. With HAIR_FORMS also to that of a form.
#include "rotation.glsl"
#include "solid_distance.glsl"

#define SHAPE_FORM 6u // as hair_shape

#ifdef HAIR_FORMS
layout(std430, binding = HAIR_BIND_NODE) readonly buffer node_buffer { float node[]; };

// Trilinear between the nodes of its grid; beyond that as from the surface nearest to where it ends. The form's own
// space. lib/collide/distance.c says the same.
float form_distance(hair_field_solid solid, vec3 p)
{
    uvec3 size   = uvec3(solid.nodes_x, solid.nodes_y, solid.nodes_z);
    vec3  last   = vec3(size - 1u);
    vec3  at     = (p - solid.grid.xyz) / solid.grid.w, within = clamp(at, vec3(0.0), last);
    uvec3 corner = min(uvec3(within), size - 2u);
    vec3  t      = within - vec3(corner);
    uint  i      = solid.first + corner.x + size.x * (corner.y + size.y * corner.z), row = size.x, layer = size.x * size.y;
    vec4  near   = vec4(node[i], node[i + 1u], node[i + row], node[i + row + 1u]);
    vec4  far    = vec4(node[i + layer], node[i + layer + 1u], node[i + layer + row], node[i + layer + row + 1u]);
    vec4  flat_  = mix(near, far, t.z), steps = far - near;
    vec2  line   = mix(flat_.xy, flat_.zw, t.y), rise = flat_.zw - flat_.xy;
    float value  = mix(line.x, line.y, t.x);
    if (at == within) return value;
    vec3 slope = vec3(line.y - line.x, mix(rise.x, rise.y, t.x), mix(mix(steps.x, steps.y, t.x), mix(steps.z, steps.w, t.x), t.y));
    return length(solid.grid.w * (at - within) + value * direction_or(slope, vec3(0.0, 1.0, 0.0)));
}
#endif

float solid_distance(hair_field_solid solid, vec3 position)
{
    vec3 p = rotate(quat_conjugate(solid.rotation), position - solid.position.xyz);
#ifdef HAIR_FORMS
    if (solid.shape == SHAPE_FORM) return solid.size.w * form_distance(solid, p / solid.size.w) - solid.position.w;
#endif
    return shape_distance(solid.shape, solid.size.xyz, p) - solid.position.w;
}
