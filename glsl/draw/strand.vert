// strand.vert - one vertex of a strand without a tessellator: which strand of the list, and which segment, by its number.
#version 450 core
#include "strand.glsl"

layout(binding = HAIR_UNIT_STRAND) uniform usamplerBuffer strand_texture;

layout(location = 0) out vec4 strand_position; // xyz from the head's origin; w: radius
layout(location = 1) out vec3 strand_tangent;
layout(location = 2) out vec3 strand_color;

void main()
{
    uint  each   = draw.segments + 1u, vertex = uint(gl_VertexID);
    uvec4 record = texelFetch(strand_texture, int(uint(gl_InstanceID) * HAIR_INSTANCE_STRANDS + vertex / each));
    // Beyond the last segment of its own a strand has none: all vertices are at its tip.
    float t = place_of(min(vertex % each, record.y), uintBitsToFloat(record.w));

    strand_vertex v = strand_at(record.x, t, uintBitsToFloat(record.z));
    strand_position = v.position;
    strand_tangent  = v.tangent;
    strand_color    = v.color;
    gl_Position     = draw.view_to_clip * (draw.view * vec4(v.position.xyz, 1.0));
}
