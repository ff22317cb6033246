// air.vert - the wind as arrows: one instance of three vertices, a triangle, per node of a lattice
// in a slice. An arrow points along the wind from its node. It reaches the next node at the
// reference speed of params.air.w.
#version 450 core
#include "draw/debug_params.glsl"
#include "wind/air.glsl"

layout(location = 0) out vec3 line_color;

void main()
{
    uint  columns = uint(params.air.x);
    vec2  at      = (vec2(gl_InstanceID % columns, gl_InstanceID / columns) + 0.5) / params.air.xy;
    vec3  p       = params.corner.xyz + at.x * params.side[0].xyz + at.y * params.side[1].xyz;
    vec3 from = rotate(params.rotation, p),
         u = rotate(quat_conjugate(params.rotation), air_then(from, from, 0.0));
    float speed   = length(u) / params.air.w;
    vec3  way     = direction_or(u, normalize(params.side[0].xyz));
    vec3  beside  = direction_or(cross(params.plane.xyz, way), normalize(params.side[1].xyz));
    if (gl_VertexID == 2) p += params.air.z * clamp(speed, 0.2, 2.0) * way;
    else p += params.air.z * (float(gl_VertexID) - 0.5) * 0.25 * beside;
    vec3 tone   = speed > 1.0 ? vec3(1.0, 0.1, 0.05) : vec3(0.05, 0.2, 1.0);
    line_color  = mix(vec3(0.5), tone, min(abs(speed - 1.0), 1.0));
    gl_Position = to_clip(p);
}
