// patch_bounds.comp - the bounding box of the cached vertices of each patch. A work group per
// patch.
#version 450 core
#include "shared.h"
#include "draw_params.glsl"
#include "workgroup.glsl"
layout(local_size_x = HAIR_GROUP_SIZE) in;

layout(std430, binding = HAIR_BIND_STORED_PATCH) readonly restrict buffer patch_buffer
{
    hair_patch patches[];
};
layout(std430, binding = HAIR_BIND_CACHED_POSITION) readonly restrict buffer cached_position_buffer
{
    vec4 cached_position[];
};
layout(std430, binding = HAIR_BIND_PATCH_BOUNDS) writeonly restrict buffer patch_bounds_buffer
{
    vec4 box[];
};

shared vec3 lower[HAIR_GROUP_SIZE], upper[HAIR_GROUP_SIZE];

void main()
{
    uint number = hair_group(), i = gl_LocalInvocationID.x;
    if (number >= uint(patches.length())) return;
    hair_patch own = patches[number];
    uint each = draw.segments + 1u, first = own.first * each, end = (own.first + own.count) * each;
    vec3  low = cached_position[first].xyz, high = low;
    for (uint k = first + i; k < end; k += HAIR_GROUP_SIZE) {
        low  = min(low, cached_position[k].xyz);
        high = max(high, cached_position[k].xyz);
    }
    lower[i] = low, upper[i] = high;
    for (uint half_ = HAIR_GROUP_SIZE / 2u; half_ > 0u; half_ /= 2u) {
        synchronise();
        if (i < half_) {
            lower[i] = min(lower[i], lower[i + half_]);
            upper[i] = max(upper[i], upper[i + half_]);
        }
    }
    if (i == 0u) {
        box[2u * number]      = vec4(lower[0], 0.0);
        box[2u * number + 1u] = vec4(upper[0], 0.0);
    }
}
