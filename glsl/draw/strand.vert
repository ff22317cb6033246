// strand.vert - one vertex of a strand without a tessellator. Its number gives the strand in the
// list and the segment.
#version 450 core
#include "draw/strand.glsl"
#include "draw/strand_out.glsl"
#ifdef HAIR_PAIRED
#include "draw/ribbon.glsl"
#endif

layout(binding = HAIR_UNIT_STRAND) uniform usamplerBuffer strand_texture;

void main()
{
#ifdef HAIR_PAIRED
    uint vertex = uint(gl_VertexID) / 2u;
#else
    uint vertex = uint(gl_VertexID);
#endif
    uint  each   = draw.segments + 1u;
    uint  place  = uint(gl_InstanceID) * HAIR_INSTANCE_STRANDS + vertex / each;
    uvec4 record = texelFetch(strand_texture, int(place) * HAIR_STRAND_TEXELS);
    // Vertices beyond the last segment of a strand lie at its tip.
    vec3  own = uintBitsToFloat(record.yzw); // width, widened and whole of hair_strand.
    float t   = place_of(vertex % each, own.z);

    strand_vertex v = strand_at(record.x, record.x, t, own.x, own.y);
    pass_on(v);
#ifdef HAIR_PAIRED
    float across = (gl_VertexID & 1) == 0 ? -1.0 : 1.0;
    gl_Position =
        draw.view_to_clip * (draw.view * vec4(v.position.xyz + across * side_of(v.position, v.tangent), 1.0));
#ifdef HAIR_NUMBERED
    strand_place.w = across;
#endif
#endif
}
