// strand.vert - one vertex of a strand without a tessellator: which strand of the list, and which segment, by its number.
#version 450 core
#include "strand.glsl"
#include "strand_out.glsl"

layout(binding = HAIR_UNIT_STRAND) uniform usamplerBuffer strand_texture;

void main()
{
    uint  each   = draw.segments + 1u, vertex = uint(gl_VertexID);
    uvec4 record = texelFetch(strand_texture, int(uint(gl_InstanceID) * HAIR_INSTANCE_STRANDS + vertex / each));
    // Beyond the last segment of its own a strand has none: all vertices are at its tip.
    vec3  own = uintBitsToFloat(record.yzw); // of hair_strand
    float t   = place_of(vertex % each, own.z);
    pass_on(strand_at(record.x, t, own.x, own.y));
}
