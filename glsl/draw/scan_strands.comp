// scan_strands.comp - a prefix sum of the number of drawn strands over patches, and the commands
// that draw the list of strands. The sum gives each patch's first strand in the list. One work
// group, in which each thread counts a run of patches.
#version 450 core
#include "strands/patch.glsl"
#include "workgroup.glsl"
layout(local_size_x = HAIR_COUNT_THREADS) in;

layout(std430, binding = HAIR_BIND_START) restrict buffer start_buffer { uint start[]; };
layout(std430, binding = HAIR_BIND_COMMAND) writeonly restrict buffer command_buffer
{
    hair_draw_command command[];
};

shared uint sums[HAIR_COUNT_THREADS];
shared uint max_value; // Maximum segments of a strand.

// Return the smallest segment count that has indices and is enough for all strands. There are
// indices for all segments, half as many, and so on (lib/draw/strand_list.c). `before` is the
// number of indices before those, for one corner per segment.
uint find_indices(out uint before)
{
    uint each = draw.segments;
    before    = 0u;
    while (each > 1u && max_value <= (each + 1u) / 2u) {
        before += HAIR_INSTANCE_STRANDS * each;
        each = (each + 1u) / 2u;
    }
    return each;
}

// Write the commands of a kind that draw full instances of HAIR_INSTANCE_STRANDS strands, and the
// command `at` for the remaining strands. A segment has `corners` indices, and each of its ends has
// `ends` vertices.
void write_commands(uint kind, uint at, uint strands, uint each, uint before, uint corners, uint ends)
{
    uint indices = corners * each, first = corners * before;
    uint left = strands % HAIR_INSTANCE_STRANDS, whole = strands - left, at_once = draw.draw_instances;
    uint vertices = (draw.segments + 1u) * ends;
    uint all      = (draw.followers + HAIR_INSTANCE_STRANDS - 1u) / HAIR_INSTANCE_STRANDS;
    all           = (all + at_once - 1u) / at_once;
    for (uint k = gl_LocalInvocationID.x; k < all; k += HAIR_COUNT_THREADS) {
        uint from = min(k * at_once * HAIR_INSTANCE_STRANDS, whole);
        uint instances = min((whole - from) / HAIR_INSTANCE_STRANDS, at_once);
        command[HAIR_LIST_COMMANDS + HAIR_LIST_KINDS * k + kind] =
            hair_draw_command(HAIR_INSTANCE_STRANDS * indices, instances, first, from * vertices, 0u, 0u,
                              0u, 0u);
    }
    if (gl_LocalInvocationID.x == 0u)
        command[at] = hair_draw_command(left * indices, 1u, first, whole * vertices, 0u, strands, 0u, 0u);
}

// Write the dispatch of one thread per indexed vertex, in the dimensions of workgroup.glsl.
void write_expand_view_command(uint strands, uint each)
{
    // One group notes that there are no strands.
    uint  groups = max((strands * each + HAIR_GROUP_SIZE - 1u) / HAIR_GROUP_SIZE, 1u);
    uvec2 size = uvec2(min(groups, HAIR_MAX_GROUPS), (groups + HAIR_MAX_GROUPS - 1u) / HAIR_MAX_GROUPS);
    command[HAIR_EXPAND_VIEW_COMMAND] = hair_draw_command(size.x, size.y, 1u, 0u, 0u, strands, each, 0u);
}

void main()
{
    uint i       = gl_LocalInvocationID.x;
    uint patches = count_patches();
    uint each    = (patches + HAIR_COUNT_THREADS - 1u) / HAIR_COUNT_THREADS;
    uint first   = min(i * each, patches), end = min(first + each, patches), sum = 0u, longest = 0u;
    for (uint number = first; number < end; ++number) {
        hair_patch_lines lines = find_lines(number);
        start[number]          = sum;
        sum += lines.strands;
        if (lines.strands > 0u) longest = max(longest, lines.segments);
    }

    // Inclusive prefix sum over the threads (Hillis and Steele 1986).
    sums[i] = sum;
    if (i == 0u) max_value = 0u;
    for (uint reach = 1u; reach < HAIR_COUNT_THREADS; reach *= 2u) {
        synchronise();
        uint more = i >= reach ? sums[i - reach] : 0u;
        synchronise();
        sums[i] += more;
    }
    atomicMax(max_value, longest);
    synchronise();
    for (uint number = first; number < end; ++number) start[number] += sums[i] - sum;
    uint before, segments = find_indices(before), strands = sums[HAIR_COUNT_THREADS - 1u];
    write_commands(HAIR_LIST_LINES, 0u, strands, segments, before, 2u, 1u);
    write_commands(HAIR_LIST_PAIRED, HAIR_PAIRED_COMMAND, strands, segments, before, HAIR_PAIRED_INDICES, 2u);
    if (i == 0u) write_expand_view_command(strands, segments + 1u);
}
