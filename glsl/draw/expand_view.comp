// expand_view.comp - the per-view vertices of listed strands, with the number, width and segments
// that a view wants. They are in the order of the list, with room for all segments of each strand.
// With HAIR_SIDES they are written in clip space, ready to be drawn. One thread per vertex.
#version 450 core
#include "draw/strand.glsl"
#include "workgroup.glsl"
#if defined(HAIR_SIDES) && !defined(HAIR_LINES)
#include "draw/ribbon.glsl"
#endif
layout(local_size_x = HAIR_GROUP_SIZE) in;

layout(std430, binding = HAIR_BIND_LISTED_STRAND) readonly restrict buffer strand_buffer
{
    hair_strand strand[];
};
layout(std430, binding = HAIR_BIND_LIST_COMMAND) readonly restrict buffer command_buffer
{
    hair_draw_command command[];
};
#ifdef HAIR_SIDES
layout(std430, binding = HAIR_BIND_CACHED_POSITION) writeonly restrict buffer clip_buffer { vec4 clip[]; };
#else
layout(std430, binding = HAIR_BIND_CACHED_POSITION) writeonly restrict buffer cached_position_buffer
{
    vec4 expanded[];
};
layout(std430, binding = HAIR_BIND_CACHED_TANGENT) writeonly restrict buffer cached_tangent_buffer
{
    uvec2 cached_tangent[];
};
#endif
#ifndef HAIR_DEPTH
layout(std430, binding = HAIR_BIND_SHADED) writeonly restrict buffer shaded_buffer { uvec2 shaded[]; };
#endif

#ifdef HAIR_SIDES
vec4 to_clip(vec3 position) { return draw.view_to_clip * (draw.view * vec4(position, 1.0)); }

void write_place(uint at, strand_vertex v)
{
#ifdef HAIR_LINES
    clip[at] = to_clip(v.position.xyz);
#else
    vec3 side         = side_of(v.position, v.tangent);
    clip[2u * at]     = to_clip(v.position.xyz - side);
    clip[2u * at + 1] = to_clip(v.position.xyz + side);
#endif
}
#else
void write_place(uint at, strand_vertex v)
{
    expanded[at]         = v.position;
    cached_tangent[at] = pack_tangent(v.tangent);
}
#endif

void main()
{
    uint i = hair_group() * HAIR_GROUP_SIZE + gl_LocalInvocationID.x,
         each = command[HAIR_EXPAND_VIEW_COMMAND].each;
    uint place = i / each, k = i % each, at = place * (draw.segments + 1u) + k;
#ifndef HAIR_SIDES
    if (i == 0u && draw.strands_at > 0u)
        expanded[draw.strands_at] = vec4(command[HAIR_EXPAND_VIEW_COMMAND].strands, each, 0.0, 0.0);
#endif
    if (place >= command[HAIR_EXPAND_VIEW_COMMAND].strands) return;
    hair_strand own = strand[place];
    // Vertices beyond the last segment of a strand lie at its tip.
    strand_vertex v =
        strand_at(own.follower, own.cached, place_of(k, own.whole), own.width, own.widened);
    write_place(at, v);
#ifndef HAIR_DEPTH
    shaded[at] = pack_color(v.color);
#endif
}
