// stage.comp - vertices of the strands that are listed, for a view that has them as it wants: fewer, wider, of fewer segments. In the
// order of the list, with room for all segments of each. One thread per vertex.
#version 450 core
#include "strand.glsl"
#include "workgroup.glsl"
#include "packed.glsl"
layout(local_size_x = HAIR_GROUP_SIZE) in;

layout(binding = HAIR_UNIT_STRAND) uniform usamplerBuffer strand_texture;
layout(std430, binding = HAIR_BIND_LISTED) readonly restrict buffer command_buffer { hair_draw_command command[]; };
layout(std430, binding = HAIR_BIND_EXPANDED) writeonly restrict buffer expanded_buffer { vec4 expanded[]; };
layout(std430, binding = HAIR_BIND_EXPANDED_TANGENT) writeonly restrict buffer expanded_tangent_buffer { uvec2 expanded_tangent[]; };
#ifndef HAIR_DEPTH
layout(std430, binding = HAIR_BIND_SHADED) writeonly restrict buffer shaded_buffer { uvec2 shaded[]; };
#endif

void main()
{
    uint i = hair_group() * HAIR_GROUP_SIZE + gl_LocalInvocationID.x, each = draw.segments + 1u;
    if (i / each >= command[0].strands) return;
    uvec4 record = texelFetch(strand_texture, int(i / each));
    vec3  own    = uintBitsToFloat(record.yzw); // of hair_strand
    if (float(i % each) >= own.z + 1.0) return;
    strand_vertex v     = strand_at(record.x, place_of(i % each, own.z), own.x, own.y);
    expanded[i]         = v.position;
    expanded_tangent[i] = pack_tangent(v.tangent);
#ifndef HAIR_DEPTH
    shaded[i] = pack_color(v.color);
#endif
}
